"""The units of constraints: a multiplier times its f is an energy, and times its c a power."""

from __future__ import annotations

from lagrangian.errors import ModelError
from lagrangian.model import Model
from lagrangian.model.elements.answers import ENERGY as TORQUE
from lagrangian.model.elements.answers import FORCE
from lagrangian.model.rows import named_conditions
from lagrangian.values.dimensions import ENERGY, NONE, check_dimensions, multiplier_dimension


def units_of_multipliers(model: Model) -> dict[str, str]:
    """The units of the multipliers of rows that are expressions, by the names of the rows, where they are known.

    Raises `ModelError` if units do not agree.
    """
    dims = check_dimensions(model)
    if dims is None:
        return {}
    rows = [row for row in named_conditions(model) if row.condition.unit is None]
    found = {row.name: multiplier_dimension(dims, row) for row in rows}
    return {name: str(dim) for name, dim in found.items() if dim is not None and not dim.unknown and dim != NONE}


def units_of_gaps(model: Model) -> dict[str, str]:
    """The units of f of all rows f(q, t) = 0 by their names, where they are known; those of angles are "rad".

    An expression without a unit, or in a system without units, has none.
    """
    try:
        dims = check_dimensions(model)
    except ModelError:
        dims = None
    found: dict[str, str] = {}
    for row in named_conditions(model):
        if not row.condition.on_positions:
            continue
        if row.condition.unit is not None:
            found[row.name] = {FORCE: "m", TORQUE: "rad"}[row.condition.unit]
        elif dims is not None and (force := multiplier_dimension(dims, row)) is not None:
            gap = ENERGY.times(force, -1)
            found[row.name] = "" if gap.unknown or gap == NONE else str(gap)
    return found
