"""What `System.optimize` returns: the best values, their cost, and the run with them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.model import Model
from lagrangian.page.figures import figure
from lagrangian.page.formula import Check, Item, Table, Verbatim, text
from lagrangian.page.report import Part, Report
from lagrangian.records import dataclass, field
from lagrangian.simulate.guesses import checks_data, lettered
from lagrangian.simulate.trajectory import Trajectory
from lagrangian.write.written import Written

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Optimum(Written):
    """The values that make a run best, by name; a table has one for each of its values, ``F[0]``, ``F[1]``, …

    ``cost`` is what was minimized, ``first_cost`` that of the first guess, ``gradient`` its derivatives in the order of
    ``names``. ``params``, ``initial`` and ``inputs`` contain the same values in the form that `simulate` takes.
    ``missing`` is by how much each quantity of ``reach`` misses its value, ``at_bound`` names what lies on a bound, and
    ``run`` is the best run. ``success`` says whether the search ended at a minimum, and ``message`` how. ``checks``
    hold the cost and the gradient against runs that were integrated without variational equations.
    """

    model: Model = field(repr=False)
    names: tuple[str, ...]
    values: Mapping[str, float]
    cost: float
    first_cost: float
    gradient: Array = field(repr=False)
    missing: Mapping[str, float]
    at_bound: tuple[str, ...]
    params: Mapping[str, float] = field(repr=False)
    initial: Mapping[str, float] = field(repr=False)
    inputs: Mapping[str, Any] = field(repr=False)
    run: Trajectory = field(repr=False)
    evaluations: int
    success: bool
    message: str
    checks: tuple[Check, ...] = field(default=(), repr=False)

    def report(self) -> Report[Model]:
        """Return the report: the values, the cost, and what was to be reached."""
        return optimum_report(self)

    def __repr__(self) -> str:
        """Name the cost and the first values."""
        shown = ", ".join(f"{name} = {self.values[name]:.6g}" for name in self.names[:8])
        more = ", …" if len(self.names) > 8 else ""
        failed = "" if self.success else f"; FAILED: {self.message}"
        failed += "".join(f"; {c.what}: DOES NOT HOLD" for c in self.checks if c.holds is False)
        return f"<Optimum {self.model.name!r}: cost {self.cost:.6g} at {shown}{more}{failed}>"


def optimum_report(found: Optimum) -> Report[Model]:
    """The report of an optimization."""
    rows = [
        (
            lettered(found.model, name),
            text(figure(found.values[name])),
            text("on a bound" if name in found.at_bound else ""),
        )
        for name in found.names
    ]
    header = (text("unknown"), text("value"), text(""))
    said = f"The cost is {figure(found.cost)}; with the first guess it was {figure(found.first_cost)}."
    items: list[Item] = [Table(header, tuple(rows)), text(said)]
    if found.missing:
        ends = [(text(Verbatim(name)), text(figure(value))) for name, value in found.missing.items()]
        items.append(Table((text("at the end"), text("misses its value by")), tuple(ends)))
    if not found.success:
        items.append(text(f"The search did not end at a minimum: {found.message}."))
    data: dict[str, Any] = {
        "system": found.model.name,
        "values": {name: found.values[name] for name in found.names},
        "cost": found.cost,
        "first_cost": found.first_cost,
        "gradient": found.gradient.tolist(),
        "missing": dict(found.missing.items()),
        "at_bound": list(found.at_bound),
        "success": found.success,
        "message": found.message,
        "checks": checks_data(found.checks),
    }
    parts = (Part(text("The best values"), tuple(items)),)
    parts += (Part(text("What was checked"), (), found.checks),) if found.checks else ()
    return Report(f"{found.model.name}: optimal run", found.model, parts, data)
