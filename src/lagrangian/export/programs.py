"""The programs that exported files contain, by name, and the units of their entries."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from lagrangian import dynamics
from lagrangian.codegen.labels import comment
from lagrangian.graph import Program
from lagrangian.model import Model

SHORT = ("forward", "inverse", "mass_matrix", "energy")
"""The programs that every export contains."""


def _multipliers(model: Model) -> Program:
    """λ alone: how well it is determined is a question to the compiled system."""
    made = dynamics.multipliers(model)
    return replace(made, outputs={"lam": made.outputs["lam"]})


_MADE: dict[str, Callable[[Model], Program]] = {
    "forward": dynamics.forward,
    "inverse": dynamics.inverse,
    "mass_matrix": dynamics.mass_matrix,
    "energy": dynamics.energy,
    "rates": dynamics.rates,
    "rhs": dynamics.rhs,
    "multipliers": _multipliers,
    "residual": dynamics.residual,
}


def exported(model: Model, *, whole: bool = False) -> tuple[str, ...]:
    """Return the names of the programs that an exported file contains.

    ``whole``: also the right-hand side for solvers and, with constraints, multipliers and residuals.
    """
    names = (*SHORT, "rates") if model.floating else SHORT
    if not whole:
        return names
    return (*names, "rhs", "multipliers", "residual") if model.constraints else (*names, "rhs")


def program_of(model: Model, name: str) -> Program:
    """Return the program of a model by its name."""
    return model.remembered(("exported", name), lambda: _MADE[name](model))


def named_programs(model: Model, stem: str, *, whole: bool = False) -> dict[str, Program]:
    """Return the programs of an exported file by the names of their functions, ``stem_forward``, …."""
    return {f"{stem}_{name}": program_of(model, name) for name in exported(model, whole=whole)}


def coordinates_listed(model: Model) -> str:
    """The names of the coordinates for a comment."""
    names = ", ".join(comment(c.name) for c in model.coordinates[:20])
    return names + (", ..." if len(model.coordinates) > 20 else "")


def unit_table(model: Model) -> dict[str, str]:
    """Return the SI units of all entries by name, as far as they are known."""
    from lagrangian.simulate.plot import Units  # imported here because plain source names no units

    units, table = Units(model), dict[str, str]()
    for c in model.coordinates:
        table |= {c.name: units.of(c.symbol), f"{c.name}''": units.of(c.acceleration)}
    return table | {x.name: units.of(x.symbol) for x in (*model.velocities, *model.inputs, *model.parameters)}
