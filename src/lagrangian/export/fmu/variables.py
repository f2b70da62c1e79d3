"""The variables of an FMU: their names, value references, units and starts, the same in both versions."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.errors import ModelError
from lagrangian.export.equations import check_values
from lagrangian.export.programs import unit_table
from lagrangian.export.start import Start, start_of
from lagrangian.model import Model
from lagrangian.model.names import multiplier_symbol
from lagrangian.model.rows import named_conditions
from lagrangian.records import dataclass


@dataclass(frozen=True)
class FmuVariable:
    """A variable. Its value reference is its place in the list, and ``derivative`` is that of its state."""

    name: str
    role: str
    unit: str = ""
    start: float | None = None
    derivative: int | None = None
    description: str = ""


def variables_of(model: Model) -> tuple[FmuVariable, ...]:
    """Time, states x = [q; v], their derivatives, inputs, parameters, T, V and multipliers, in this order.

    Raises `ModelError` for a parameter without a value: an FMU needs a start of every parameter.
    """
    check_values(model, "an FMU")
    found = list(_listed(model, start_of(model)))
    seen: dict[str, int] = {}
    for k, variable in enumerate(found):
        if variable.name in seen:
            raise ModelError(
                f"two variables of the FMU would be called '{variable.name}'", fix="rename one of them", code="E404"
            )
        seen[variable.name] = k
    return tuple(found)


def _listed(model: Model, start: Start) -> Iterator[FmuVariable]:
    from lagrangian.simulate.plot import Units  # imported here with everything that knows dimensions

    units, table = Units(model), unit_table(model)
    n, m = len(model.coordinates), len(model.velocities)
    yield FmuVariable("time", "time", "s")
    for k, c in enumerate(model.coordinates):
        yield FmuVariable(c.name, "state", table[c.name], start.x[k], description=c.description or "")
    for k, v in enumerate(model.velocities):
        yield FmuVariable(v.name, "state", table[v.name], start.x[n + k])
    for k, c in enumerate(model.coordinates):
        yield FmuVariable(f"der({c.name})", "derivative", _rate(table[c.name]), derivative=1 + k)
    for k, v in enumerate(model.velocities):
        yield FmuVariable(f"der({v.name})", "derivative", _rate(table[v.name]), derivative=1 + n + k)
    for k, u in enumerate(model.inputs):
        yield FmuVariable(u.name, "input", table[u.name], start.u[k], description=u.description or "")
    for k, p in enumerate(model.parameters):
        yield FmuVariable(p.name, "parameter", table[p.name], start.p[k], description=p.description or "")
    yield FmuVariable("energy.kinetic", "output", "J", description="kinetic co-energy T*")
    yield FmuVariable("energy.potential", "output", "J", description="potential energy V")
    for row in named_conditions(model):
        unit = units.of(multiplier_symbol(row.name))
        yield FmuVariable(f"multiplier.{row.name}", "output", unit, description="multiplier of a constraint")
    assert m == len(model.velocities)


def _rate(unit: str) -> str:
    """The unit of a rate."""
    base, _, power = unit.partition("/s")
    if not unit:
        return ""
    if not power and unit.endswith("/s"):
        return f"{base}/s^2"
    return f"{unit}/s" if "/" not in unit else ""
