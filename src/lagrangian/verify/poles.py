"""Holds the poles and modes of linearizations against routes that solve no eigenvalue problem.

The sums of powers of the poles are traces of powers of A,

    Σᵢ λᵢᵏ = tr Aᵏ,   k = 1 … n,

which fixes all of them (Newton's identities). Every eigenvector satisfies A x = λ x, and the shape φ of a mode, as it
is printed, the equations of second order: λ² φ = A₂₁ φ + λ A₂₂ φ where the states are coordinates and their rates.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from lagrangian.linear.linear_model import LinearModel
from lagrangian.linear.modes import balanced
from lagrangian.page.formula import Check, Name, text

Array: TypeAlias = NDArray[np.float64]

TOLERANCE = 1e-9
"""Two numbers are equal if their difference, relative to the norm of A, is at most this: no more than rounding."""

LOOSEST = 1e-5
"""The largest bound of a pole's rounding error, relative to the norm of A, that is believed."""


def poles(found: Sequence[LinearModel]) -> Check:
    """Return the check of the poles and modes of some linearizations; ``holds`` is None if there is none."""
    A = Name("A")
    what = text("the poles have the traces of powers of ", A, ", and modes are motions of the linear system")
    if not found:
        return Check(what, None, "not checked: there is no linearization")
    found = [linear for linear in found if _is_known(linear)]
    if not found:
        return Check(what, None, "not checked: all terms cancel in A, and rounding is what is left")
    worst = float(np.max([off for linear in found for off in (_traces(linear), _vectors(linear))]))
    shapes = float(np.max([_shapes(linear) for linear in found]))
    at = f"{len(found)} random state{'s' if len(found) != 1 else ''}"
    figure = f"largest relative difference {worst:.1e}, of shapes {shapes:.1e}, at {at}"
    return Check(what, max(worst, shapes) < TOLERANCE, figure)


def _is_known(linear: LinearModel) -> bool:
    """Whether the balanced A is more than its rounding errors, of which poles are made where all terms cancel."""
    if not linear.A.size:
        return True
    A, sizes = balanced(linear.A, 0.0)
    noise = float(np.max(linear.noise[0] * sizes / sizes[:, None]))
    return noise == 0.0 or noise <= TOLERANCE * float(np.linalg.norm(A))


def _traces(linear: LinearModel) -> float:
    """The largest difference of Σ λᵏ from tr Aᵏ, relative to ‖A‖ᵏ of the balanced A."""
    A = balanced(linear.A, linear.noise[0])[0] if linear.A.size else linear.A
    size = float(np.linalg.norm(A)) or 1.0
    scaled, roots = A / size, linear.poles / size
    power, worst = np.eye(len(A)), float(abs(len(A) - len(roots)))
    for k in range(1, len(A) + 1):
        power = power @ scaled
        worst = float(np.maximum(worst, abs(np.sum(roots**k) - np.trace(power))))
    return worst


def _vectors(linear: LinearModel) -> float:
    """The largest part of A x − λ x beyond the stated error of λ, relative to ‖A‖ ‖x‖, of the balanced A."""
    if not linear.A.size:
        return 0.0
    A, sizes = balanced(linear.A, linear.noise[0])
    size, found = float(np.linalg.norm(A)) or 1.0, linear.spectrum
    x = found.vectors / sizes[:, None]
    off = np.linalg.norm(A @ x - x * found.poles, axis=0) / (size * np.linalg.norm(x, axis=0))
    return _beyond(np.asarray(off, float), found.errors / size)


def _shapes(linear: LinearModel) -> float:
    """The same of the printed shapes in the equations of second order, relative to their largest matrix.

    It is 0 where states are no coordinates and rates.
    """
    n = len(linear.coordinates)
    if linear.basis is not None or len(linear.states) != 2 * n or not n:
        return 0.0
    stiff, damped = linear.A[n:, :n], linear.A[n:, n:]
    worst = 0.0
    for mode in linear.modes:
        shape = np.array([mode.shape[name] for name in linear.coordinates])
        size = max(abs(mode.pole) ** 2, np.linalg.norm(stiff), abs(mode.pole) * np.linalg.norm(damped)) or 1.0
        terms = mode.pole**2 / size * shape, stiff / size @ shape, mode.pole / size * (damped @ shape)
        off = np.linalg.norm(terms[0] - terms[1] - terms[2])
        error = linear.spectrum.errors[np.flatnonzero(linear.poles == mode.pole)[0]]
        slack = (2 * abs(mode.pole) + np.linalg.norm(damped)) * error / size
        worst = float(np.maximum(worst, _beyond(np.array([off], float), np.array([slack], float))))
    return worst


def _beyond(off: Array, bounds: Array) -> float:
    """The largest difference less the bound of its rounding error, as far as that is believed."""
    return float(np.max(np.maximum(off - np.minimum(bounds, LOOSEST), 0.0), initial=0.0))
