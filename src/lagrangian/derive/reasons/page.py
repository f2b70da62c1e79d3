"""Why Lagrange's equations hold for a system: the lecture's equations (1) to (12), carried out on it."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import sympy as sp

from lagrangian.derive.derived import Derived
from lagrangian.derive.energies import indices
from lagrangian.derive.reasons.at_a_state import NumbersAt, numbers
from lagrangian.derive.reasons.circuits_page import circuit_parts
from lagrangian.derive.reasons.constraint_page import constraint_work
from lagrangian.derive.reasons.energy_page import forces, in_numbers, kinetic, spared_part
from lagrangian.derive.reasons.forces_page import newton, wiggle
from lagrangian.derive.reasons.held import holds
from lagrangian.derive.reasons.laws import laws, reaction
from lagrangian.derive.reasons.loads import applied_loads
from lagrangian.derive.reasons.motion import moving
from lagrangian.derive.reasons.result import EquationCount, Reasoning, spared
from lagrangian.errors import ModelError
from lagrangian.model import Model
from lagrangian.page.formula import Check
from lagrangian.page.plain import plain
from lagrangian.page.report import Part, Report
from lagrangian.records import dataclass
from lagrangian.write.written import Written


@dataclass(frozen=True, eq=False)
class Why(Written):
    """Why Lagrange's equations hold for a system: F = ma for every mass, and how the constraint forces drop out.

    ``constraint_forces`` is R = m a − F on every body by its name, in the fixed axes [N], in terms of ξ, ξ̇ and ξ̈;
    ``constraint_moments`` the same for the moments [N m] about centres of mass, of bodies that turn. ``checks`` are the
    equalities of the page, each decided exactly or with 50 digits; ``numbers`` are those of the page, None if there is
    no state at which everything has a value. ``spared`` counts equations and unknowns.

    Of a system with coils the page has Kirchhoff's voltage law of every loop, and the forces of coils and capacitors by
    an energy balance; constraint forces and numbers are not on it then.
    """

    model: Model
    parts: tuple[Part, ...]
    constraint_forces: Mapping[str, tuple[sp.Expr, ...]]
    constraint_moments: Mapping[str, tuple[sp.Expr, ...]]
    numbers: NumbersAt | None
    spared: EquationCount

    @property
    def checks(self) -> tuple[Check, ...]:
        """All checks of the page, in reading order."""
        return tuple(check for part in self.parts for check in part.checks)

    def report(self) -> Report[Model]:
        """Return the page."""
        return Report(f"{self.model.name}: why Lagrange's equations hold", self.model, self.parts, _data(self))


def why(d: Derived) -> Why:
    """Carry out the lecture's equations (1) to (12) on a derived system; of one with coils, Kirchhoff's laws instead.

    Raises `ModelError` for a system whose masses are not described: one that is given by its energies. Source: lecture
    9, "Lagrangian mechanics: brief overview".
    """
    context = d.shares.context
    if any(e.ledger == "T*" for e in d.model.branches):
        context.algebra.renew()
        return Why(d.model, circuit_parts(d), {}, {}, None, spared(d))
    _check_masses(d.model)
    context.algebra.renew()
    parts = moving(context)
    loads = applied_loads(context, parts)
    reactions = tuple(reaction(context, loads, m) for m in parts)
    found = Reasoning(
        d,
        parts,
        loads,
        reactions,
        laws(d, parts, loads),
        holds(context, parts, loads, d.shares.rows),
        numbers(d, parts, loads),
        spared(d),
        indices(d.model),
    )
    page = (newton, wiggle, constraint_work, kinetic, forces, in_numbers, spared_part)
    vectors = [(m, tuple(x.expr() for x in R)) for m, R in zip(parts, reactions, strict=True)]
    return Why(
        d.model,
        tuple(part(found) for part in page),
        {m.body.name: R for m, R in vectors if not m.turning},
        {m.body.name: R for m, R in vectors if m.turning},
        found.numbers,
        found.spared,
    )


def _check_masses(model: Model) -> None:
    """Raise an error for a system whose kinetic energy does not come from masses."""
    given = next((e for e in model.elements if e.ledger == "T*" and e not in model.bodies), None)
    if given is None:
        return
    raise ModelError(
        "it is given as an energy, which does not say which masses move and where: there is no F = ma to begin with",
        element=given.title,
        place=given.place,
        fix="describe particles and rigid bodies at their points; derive() without why works from energies",
        code="E412",
    )


def _data(w: Why) -> dict[str, Any]:
    """The page as plain data."""
    n = w.numbers
    return {
        "system": w.model.name,
        "constraint_forces": {name: [plain(x) for x in R] for name, R in w.constraint_forces.items()},
        "constraint_moments": {name: [plain(x) for x in R] for name, R in w.constraint_moments.items()},
        "checks": [{"what": str(c.what), "holds": c.holds, "figure": c.figure} for c in w.checks],
        "spared": dict(vars(w.spared)),
        "digits": None if n is None else n.digits,
        "state": None if n is None else {plain(s): float(x) for s, x in n.state.items()},
        "parts": [{"title": str(part.title), "items": [str(item) for item in part.items]} for part in w.parts],
    }
