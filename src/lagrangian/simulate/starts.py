"""The starts of constrained systems: guesses are moved onto the constraints, and a notice says by how much."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian import dynamics
from lagrangian.assembly.assemble import assembler_of, consistent, fixed_names
from lagrangian.codes import Code
from lagrangian.errors import Notice, RunError
from lagrangian.graph import Program, evaluate
from lagrangian.integrate.closing import Closing
from lagrangian.model import Model
from lagrangian.simulate.integrating import remembered

Array = NDArray[np.float64]

MOVED = 1e-9
"""There is a notice if a start was moved by more than this, in SI units."""


def held(model: Model, fixed: Iterable[Any] | str | None) -> tuple[str, ...]:
    """The names of the fixed coordinates: those of the call, otherwise those of the model file."""
    given = model.settings.get("fixed", ()) if fixed is None else fixed
    names = fixed_names(model, given)
    if names and not model.constraints:
        raise RunError(
            f"system '{model.name}' has no constraints, so every start is taken as given",
            fix="leave fixed out",
            code="E501",
        )
    return names


def onto_constraints(
    model: Model, x: Array, p: Array, t: float, fixed: Sequence[str], *, told: Iterable[str] = (), compiled: bool = True
) -> tuple[Array, tuple[Notice, ...]]:
    """The start nearest to x that satisfies every constraint, and a notice about coordinates that were moved.

    The notice has all values that the call ``told``, and of the others the one that moved most.
    ``compiled`` is that of `consistent`.
    """
    if not model.constraints:
        return x, ()
    _check_divisors(model, p, t)
    n, m = len(model.coordinates), len(model.velocities)
    q, v = consistent(model, x[:n], x[n : n + m], p, t, fixed=fixed, compiled=compiled)
    found = np.concatenate([q, v, x[n + m :]])
    change = np.abs(found - x)
    moved = [int(k) for k in np.argsort(-change) if change[k] > MOVED]
    if not moved:
        return found, ()
    names = [*(c.name for c in model.coordinates), *(v.name for v in model.velocities)]
    given = set(told)
    shown = [k for k in moved if names[k] in given] or moved[:1]
    others = f", and {len(moved) - len(shown)} more" if len(moved) > len(shown) else ""
    listed = ", ".join(f"{names[k]} from {x[k]:.6g} to {found[k]:.6g}" for k in shown)
    said = f"moved onto the constraints: {listed}{others}; coordinates in fixed stay as given"
    return found, (Notice(Code.E303, "start of the run", said),)


def _check_divisors(model: Model, p: Array, t: float) -> None:
    """Raise an error for parameters that make a coefficient 0 by which the accelerations are divided."""
    program: Program = remembered(model, "divisors", lambda: dynamics.divisors(dynamics.slips(model)))
    if not program.outputs:
        return
    sizes = {"q": len(model.coordinates), "v": len(model.velocities), "u": len(model.inputs)}
    rest = {group: [0.0] * size for group, size in sizes.items()}
    values = evaluate(program, {**rest, "p": p.tolist(), "t": [t]})
    for name, found in values.items():
        if not all(x and np.isfinite(x) for x in np.ravel(found)):
            raise RunError(
                f"with these parameters the constraint '{name}' does not restrict what it is about: a coefficient of "
                "its rates is 0",
                fix="give its lengths and radii values other than 0",
                code="E501",
            )


def starts_of_runs(model: Model, fixed: Sequence[str]) -> Closing | None:
    """The programs that move the starts of an ensemble onto the constraints; None without constraints."""
    if not model.constraints:
        return None
    return assembler_of(model, fixed).closing
