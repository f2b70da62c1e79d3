"""Finds combinations of rates that move no mass, for configurations with a singular mass matrix.

Every rate is scaled by the largest mass that it moves here or at a few other configurations, so that kg and kg m² can
be compared, and a part that is always light compared with the rest does not count as singular.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from lagrangian.dynamics.notices import configurations
from lagrangian.dynamics.programs import mass_matrix
from lagrangian.graph import evaluate
from lagrangian.model import Model

Array = NDArray[np.float64]

ROUNDING = 1e-13
"""M is singular if its smallest eigenvalue, relative to the largest among a few configurations, is below this."""

OTHERS = 6
"""The number of configurations with which M is compared."""

TAKES_PART = 1e-4
"""A rate belongs to a combination if its entry is at least this fraction of the largest."""


def loose(
    model: Model, q: Sequence[float], u: Sequence[float], p: Sequence[float], t: float, near: float = ROUNDING
) -> str:
    """The rates that move no mass at a configuration, in words; empty if M is regular.

    It is also empty for systems with constraints, which may decide what moves no mass.

    ``near``: M counts as singular if its smallest eigenvalue is at most this, relative to the largest one elsewhere.
    """
    if model.constraints:
        return ""
    program = model._memo.get("loose")
    if program is None:
        program = model._memo["loose"] = mass_matrix(model)

    def at(place: Sequence[float]) -> Array:
        zeros = [0.0] * len(program.inputs["v"])
        given = {"q": list(place), "v": zeros, "u": list(u), "p": list(p), "t": [t]}
        return np.array(evaluate(program, given)["M"], float).reshape(len(zeros), len(zeros))

    M, key = at(q), (tuple(u), tuple(p), t)
    if not np.isfinite(M).all():
        return ""
    known, others = model._memo.get("loose elsewhere", (None, []))
    if known != key:
        others = [N for N in map(at, islice(configurations(model), OTHERS)) if np.isfinite(N).all()]
        model._memo["loose elsewhere"] = key, others
    values, rows = _least(np.array([M, *others]))
    bound = max(near * values[:, 0].max(), 4 * len(M) * np.finfo(float).eps)  # it may be singular everywhere
    rows = rows[0][np.abs(values[0]) <= bound]
    return moving_no_mass([v.name for v in model.velocities], rows) if len(rows) else ""


def _least(M: Array) -> tuple[Array, Array]:
    """The eigenvalues of several M (k, n, n) with scaled rates, the smallest first, and the corresponding rates in
    rows."""
    size = np.diagonal(M, axis1=1, axis2=2).max(axis=0)
    unit = np.sqrt(np.where(size > 0, size, 1.0))
    values, columns = np.linalg.eigh(M / np.outer(unit, unit))
    return values, columns.transpose(0, 2, 1) / unit


def moving_no_mass(velocities: Sequence[str], rows: Array) -> str:
    """``moving 'a' and 'b' together, 1 : −2, moves no mass``: the rates in each row, in words."""
    names = [name.removesuffix("'") for name in velocities]
    taking = (np.abs(rows) > TAKES_PART * np.abs(rows).max(axis=1, keepdims=True)).any(axis=0)
    involved = np.flatnonzero(taking).tolist()
    listed = [f"'{names[k]}'" for k in involved]
    if len(listed) == 1:
        return f"{listed[0]} moves no mass"
    together = f"{', '.join(listed[:-1])} and {listed[-1]}"
    if len(rows) > 1:
        return f"{len(rows)} combinations of {together} move no mass"
    ratio = " : ".join(f"{x + 0.0:.4g}" for x in rows[0][involved] / rows[0][involved[0]])
    return f"moving {together} together, {ratio}, moves no mass"
