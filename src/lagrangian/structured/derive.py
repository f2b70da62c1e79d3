"""A derivation in named quantities."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.derive import Derived, LedgerRow, Step
from lagrangian.derive.algebra import Algebra
from lagrangian.derive.circuits import has_coils
from lagrangian.derive.constraints.page import Constraints
from lagrangian.derive.constraints.page import constraints as step_of_constraints
from lagrangian.derive.context import Context
from lagrangian.derive.coordinates import coordinates
from lagrangian.derive.forces import contributions, forces
from lagrangian.derive.holonomy import constrained, holonomic
from lagrangian.derive.multipliers.rows import NO_UNITS, with_multipliers
from lagrangian.derive.multipliers.step import missing_equations
from lagrangian.derive.result import ledger_items
from lagrangian.derive.wiggle import study
from lagrangian.dynamics.christoffel import coriolis
from lagrangian.model import Model
from lagrangian.page.formula import Elided, EquationTerm, Heading, Item, Left, formula, text
from lagrangian.records import dataclass, field
from lagrangian.structured.constants import constants
from lagrangian.structured.floating import by_power, check_speeds, free, held_floating, moved_by, speeds
from lagrangian.structured.listing import Listing, listing
from lagrangian.structured.shares import ListedShares
from lagrangian.structured.steps import ListedSteps
from lagrangian.structured.writing import ListingWriter, equalities

_log = logging.getLogger(__name__)


def derive_structured(model: Model, units: Mapping[str, str] = NO_UNITS) -> Derived:
    """Return the equations of motion of a model in named quantities, with the seven steps that lead to them.

    Raises `ModelError` where a row of a constraint contradicts others; `refusal` says which models it does not take.
    """
    described, model = model, with_multipliers(model)
    _log.info("deriving: which coordinates move what")
    known = step_of_constraints(model, _as_given) if model.constraints else None
    early = _in_speeds(model, known) if model.floating else _in_coordinates(model, known)
    step0, step1 = early[:2]
    _log.info("deriving: velocities, momenta and forces")
    found = listing(model, known.holonomy.independent if known is not None else ())
    write = ListingWriter(found)
    steps = ListedSteps(found, write, units)
    step2, step3, step4, step5 = steps.kinetic(), steps.potential(), steps.lagrangian(), steps.left_hand_sides()
    _log.info("deriving: step 6, the generalized forces")
    step6 = early[2] or by_power(found, write)
    book = _ledger(steps)
    equations = equalities(found, write)
    lasting = constants(found) if not found.ties else ()
    return Derived(
        model=described,
        steps=(step0, steps.families.step(step1), step2, step3, step4, step5, steps.families.step(step6)),
        T=step2.expressions["T"],
        V=step3.expressions["V"],
        L=step4.expressions["L"],
        Xi={q: write(x) for q, x in zip(moved_by(model).values(), found.forces, strict=True)},
        equations=equations,
        terms=tuple(_terms(found, equation) for equation in equations),
        matrices=ListedMatrices(found),
        result=(
            *_closing(steps, equations),
            *_lasting(steps, lasting),
            *steps.families([item] for item in ledger_items(book)),
        ),
        ledger=book,
        shares=ListedShares(found, write),
        form="structured",
        definitions=steps.definitions(),
        constants=lasting,
        patterns=steps.families.patterns(steps.definitions()),
        multipliers=steps.multipliers,
        no_minimal=text("the equations are written in named quantities") if found.ties else None,
        constraint_step=steps.constraints(),
        constraints=known,
    )


def _as_given(expr: sp.Expr) -> Left:
    """A row as it was described, in few words where it is long: the step of the constraints has it in named quantities.

    In normal form it may be too long.
    """
    operations = bounded.operations(expr)
    return expr if operations <= MOST_GIVEN else Elided(expr, operations)


MOST_GIVEN = 40
"""Operations above which a row is written in named quantities alone."""


def _in_coordinates(model: Model, known: Constraints | None) -> tuple[Step, Step, Step | None]:
    """Steps 0, 1 and 6 of a system whose speeds are the rates of its coordinates."""
    efforts = [x for e in model.elements for action in e.works(model) for x in (action.effort, action.rate)]
    context = Context(model, Algebra(model, efforts), study(model))
    step1 = coordinates(context)
    step0 = holonomic(context) if known is None else constrained(context, known)
    return step0, step1, forces(context, contributions(context), step1.expressions["relative"])


def _in_speeds(model: Model, known: Constraints | None) -> tuple[Step, Step, Step | None]:
    """Steps 0 and 1 of a system with floating frames; step 6 follows from the powers of the listing."""
    if known is None:
        check_speeds(model)
        return free(model), speeds(model), None
    return held_floating(model, known), speeds(model), None


def _terms(found: Listing, equation: sp.Eq) -> tuple[EquationTerm, ...]:
    bodies = tuple(b.body.title for b in found.bodies)
    left = tuple(EquationTerm(x, "inertia", bodies) for x in _summands(equation.lhs))
    pressed = {drag.friction.title for drag, _ in found.slips}
    acting = tuple(t for t, added in found.mechanics.added.items() if added.efforts or t in pressed)
    multipliers = {tie.symbol: tie.row.element.title for tie in found.ties}
    right: list[EquationTerm] = []
    for x in (x for x in _summands(equation.rhs) if x != 0):
        holding = tuple(dict.fromkeys(title for symbol, title in multipliers.items() if x.has(symbol)))
        right.append(EquationTerm(x, "constraint", holding) if holding else EquationTerm(x, "input", acting))
    return left + tuple(right)


def _summands(side: sp.Basic) -> tuple[sp.Expr, ...]:
    return tuple(sp.Add.make_args(cast("sp.Expr", side)))


def _closing(steps: ListedSteps, equations: Sequence[sp.Eq]) -> list[Item]:
    model = steps.model
    changes = [(name, row.second_rate) for name, row in steps.multipliers.items()]
    slipping = [
        text(f"These hold while {friction.title} slips; step 6 says what takes its place while it sticks.")
        for friction in model.frictions
    ]
    rate = "ξ̈ⱼ" if not model.floating else "the rate of speed j"
    return [
        Heading(text("Equations of motion")),
        *(formula(cast("sp.Expr", e.lhs), cast("sp.Expr", e.rhs), brief=True, boxed=True) for e in equations),
        *missing_equations(len(equations), changes),
        *slipping,
        text(
            "The quantities in them are defined in steps 2 and 5. Column j of the mass matrix consists of the factors "
            f"of {rate} in these lines.",
            brief=not steps.brief,
        ),
    ]


def _lasting(steps: ListedSteps, constants: Sequence[sp.Expr]) -> Iterator[Item]:
    """The constants of T* and of the weights under their heading."""
    if not constants:
        return
    many = len(constants) > 1
    yield Heading(text("Constants of the motion's equations"))
    coils = has_coils(steps.model)
    yield text(
        f"{'Parameters' if coils else 'Masses, inertias and lengths'} enter T* and the weights in "
        f"{'these' if many else 'this'} {len(constants)} constant{'s' if many else ''} alone. "
        f"{'Systems with other parameters' if coils else 'Bodies that have other masses and lengths'}, but the same "
        "constants, move in the same way, and no measured motion tells more about them."
    )
    lines = [sp.Symbol(steps.write.names.take("kappa", str(k)), real=True) for k in range(1, len(constants) + 1)]
    yield from steps.families([formula(name, x)] for name, x in zip(lines, constants, strict=True))


def _ledger(steps: ListedSteps) -> tuple[LedgerRow, ...]:
    """All elements, each exactly once in T*, V or Ξ, and the reason."""
    energies: dict[str, sp.Expr] = {element.title: value for element, value in steps.V}
    energies |= steps.given
    energies |= {b.body.title: value for b, (_, value) in zip(steps.found.bodies, steps.T, strict=True)}
    return tuple(LedgerRow(e.title, e.ledger, energies.get(e.title), text(*e.because)) for e in steps.model.elements)


@dataclass(frozen=True, eq=False)
class ListedMatrices:
    """M ξ̈ + C ξ̇ + G = Ξ of a listing in the coordinates alone, computed when they are asked for."""

    found: Listing
    _made: dict[str, sp.ImmutableMatrix] = field(default_factory=dict[str, sp.ImmutableMatrix])

    @property
    def M(self) -> sp.ImmutableMatrix:
        """The mass matrix."""
        return self._matrix("M", self.found.mechanics.mass_matrix)

    @property
    def C(self) -> sp.ImmutableMatrix:
        """The matrix of Christoffel symbols and rates."""
        return self._matrix("C", lambda: coriolis(self.found.mechanics))

    @property
    def G(self) -> sp.ImmutableMatrix:
        """∂V/∂ξ."""
        return self._matrix("G", lambda: [[x] for x in self.found.mechanics.potential_force()])

    @property
    def Xi(self) -> sp.ImmutableMatrix:
        """The generalized forces."""
        return self._matrix("Xi", lambda: [[x] for x in self.found.forces])

    def _matrix(self, name: str, rows: Callable[[], list[list[int]]]) -> sp.ImmutableMatrix:
        if name not in self._made:
            write = ListingWriter(self.found, names=False)
            self._made[name] = sp.ImmutableMatrix([[write(x) for x in row] for row in rows()])
        return self._made[name]
