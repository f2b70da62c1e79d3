"""The lecture's equations (3) to (12) for one system: both sides of each, by coordinate, and whether they agree.

All sides are normal forms, so that equality is decided exactly. With the sums over everything that has mass,

    (3)  Σ F·∂r/∂ξ = Σ m r̈·∂r/∂ξ
    (5)  Σ m r̈·∂r/∂ξ = d/dt(Σ m ṙ·∂r/∂ξ) − Σ m ṙ·∂ṙ/∂ξ
    (7)  Σ m ṙ·∂r/∂ξ = ∂T/∂ξ̇         (8)  Σ m ṙ·∂ṙ/∂ξ = ∂T/∂ξ
    (10) Σ F_c·∂r/∂ξ = −∂V/∂ξ         (12) Σ F_nc·∂r/∂ξ = Ξ
"""

# SymPy and mpmath have no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownArgumentType=false
# pyright: reportUnknownVariableType=false

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, TypeAlias

import mpmath

from lagrangian.derive.algebra import Form
from lagrangian.derive.context import Context
from lagrangian.derive.derived import Derived
from lagrangian.derive.reasons.loads import AppliedLoads, load_work, on_body, passed_work
from lagrangian.derive.reasons.motion import Column, Moving, dot
from lagrangian.derive.sampling import DIGITS, CompiledExpressions, States
from lagrangian.page.formula import Check, Name, Partial, Text, Total, text
from lagrangian.records import dataclass


@dataclass(frozen=True, eq=False)
class Law:
    """The sides for one coordinate.

    ``inertia`` is Σ m r̈·∂r/∂ξ, ``momentum`` Σ m ṙ·∂r/∂ξ, ``slope`` Σ m ṙ·∂ṙ/∂ξ; ``by_rate`` and ``by_place`` are
    ∂T/∂ξ̇ and ∂T/∂ξ; ``conservative`` and ``others`` the virtual work of the forces that have a potential and of those
    that have none, each with what massless parts pass on; ``held`` is Σ R·∂r/∂ξ of the constraint forces, ``passed``
    what massless parts pass on in them; ``fall`` is −∂V/∂ξ, ``Xi`` the generalized force, ``left`` the left-hand side
    of the equation of motion; ``rows`` the virtual work of the multipliers.
    """

    inertia: Form
    momentum: Form
    slope: Form
    by_rate: Form
    by_place: Form
    conservative: Form
    others: Form
    held: Form
    passed: Form
    fall: Form
    Xi: Form
    left: Form
    rows: Form

    @property
    def rest(self) -> Form:
        """The virtual work of the constraint forces themselves: Σ R·∂r/∂ξ without what is only passed on."""
        return self.held - self.passed


def reaction(context: Context, applied: AppliedLoads, m: Moving) -> Column:
    """R = ṗ − the loads: the force that holds a body, or the moment, in terms of ξ, ξ̇ and ξ̈."""
    loads = on_body(context, applied.loads, m)
    return tuple(p - f for p, f in zip(m.momentum_rate, loads, strict=True))


def laws(d: Derived, moving: tuple[Moving, ...], applied: AppliedLoads) -> tuple[Law, ...]:
    """Both sides of every equation, for every coordinate."""
    context: Context = d.shares.context
    total, form = context.algebra.total, context.form
    T, V = form(d.T), form(d.V)
    reactions = [reaction(context, applied, m) for m in moving]
    found: list[Law] = []
    for j, c in enumerate(d.model.coordinates):
        loads = [(load.element.ledger, load_work(context, moving, load, j)) for load in applied.loads]
        passed = [(item.element.ledger, passed_work(context, item, j)) for item in applied.passed]
        by_rate, by_place, fall, Xi = T.diff(c.rate), T.diff(c.symbol), -V.diff(c.symbol), form(d.Xi[c.symbol])
        found.append(
            Law(
                total([dot(context, m.momentum_rate, m.columns[j]) for m in moving]),
                total([dot(context, m.momentum, m.columns[j]) for m in moving]),
                total([dot(context, m.momentum, m.slopes[j]) for m in moving]),
                by_rate,
                by_place,
                total([work for ledger, work in (*loads, *passed) if ledger == "V"]),
                total([work for ledger, work in (*loads, *passed) if ledger == "Ξ"]),
                total([dot(context, R, m.columns[j]) for R, m in zip(reactions, moving, strict=True)]),
                total([work for _, work in passed]),
                fall,
                Xi,
                by_rate.total_derivative() - by_place - fall,
                total([row.pushes[j] for row in d.shares.rows]),
            )
        )
    return tuple(found)


# -- checks ---------------------------------------------------------------------------------------------------------

EXACT = "exact"

AGREE = 30
"""The digits to which two sides must agree where the normal form does not decide."""

Pair: TypeAlias = "tuple[Form, Form]"


def wiggle_check(context: Context, moving: tuple[Moving, ...]) -> Check:
    """∂ṙ/∂ξ̇ = ∂r/∂ξ, and d/dt(∂r/∂ξ) = ∂ṙ/∂ξ, for every place."""
    pairs = [
        pair
        for m in moving
        for columns in zip(m.by_place, m.columns, m.slopes, strict=not m.turning)
        for x, by_rate, slope in zip(*columns, strict=True)
        for pair in ((x, by_rate), (x.total_derivative(), slope))
    ]
    place, velocity, xi = Name("r", "i"), Name("r", "i", 1), Name("xi", "j")
    by_place = Partial(place, xi)
    first, second = Partial(velocity, Name("xi", "j", 1)), Partial(velocity, xi)
    words = text(first, " = ", by_place, " and ", Total(by_place), " = ", second, " for every mass")
    return agree(context, words, pairs)


def agree(context: Context, what: Text, pairs: Iterable[Pair]) -> Check:
    """Whether the two sides of all pairs agree: exactly, or where normal forms differ, to `AGREE` digits.

    Normal forms of equal expressions may differ where they hold functions that the algebra does not relate, such as
    tan and sin/cos; then both sides are evaluated with 50 digits at random states.
    """
    differ = [(a, b) for a, b in pairs if not (a - b).is_zero]
    if not differ:
        return Check(what, True, EXACT)
    digits = _digits(context, differ)
    if digits is None:
        return Check(what, None, "no random state was found at which both sides have a value")
    return Check(what, digits >= AGREE, f"{digits} of {DIGITS} digits agree at random states; {AGREE} are asked for")


def _digits(context: Context, pairs: Iterable[Pair]) -> int | None:
    """The digits to which the sides agree at all random states where they have values; None if there is none."""
    sides = [context.model.expand(form.raw(), constants=True) for pair in pairs for form in pair]
    compiled, states = CompiledExpressions(sides), States(context.model, 1)
    worst: Any = None
    with mpmath.workdps(DIGITS):
        for index in range(states.size):
            try:
                values = [mpmath.mpmathify(x) for x in compiled.exactly(states, index)]
            except (ZeroDivisionError, ValueError, OverflowError):
                continue
            if not all(isinstance(x, mpmath.mpf) and mpmath.isfinite(x) for x in values):
                continue
            apart = [abs(a - b) / (1 + abs(a)) for a, b in zip(values[::2], values[1::2], strict=True)]
            worst = max([*apart, *([] if worst is None else [worst])])
        if worst is None:
            return None
        return DIGITS if worst == 0 else max(0, int(mpmath.floor(-mpmath.log10(worst))))


def chain_check(context: Context, found: tuple[Law, ...]) -> Check:
    """(5): the chain rule."""
    words = text("(4) to (6): both sides agree for every coordinate")
    return agree(context, words, [(x.inertia, x.momentum.total_derivative() - x.slope) for x in found])


def kinetic_check(context: Context, found: tuple[Law, ...]) -> Check:
    """(7) and (8)."""
    pairs = [pair for x in found for pair in ((x.momentum, x.by_rate), (x.slope, x.by_place))]
    return agree(context, text("(7) and (8) hold for every coordinate"), pairs)


def potential_check(context: Context, found: tuple[Law, ...]) -> Check:
    """(10)."""
    return agree(context, text("(10) holds for every coordinate"), [(x.conservative, x.fall) for x in found])


def work_check(context: Context, found: tuple[Law, ...]) -> Check:
    """What is left is Ξ."""
    words = text("(12): what is left is ", Name("Xi"), " for every coordinate")
    return agree(context, words, [(x.others, x.Xi) for x in found])


def held_check(context: Context, found: tuple[Law, ...]) -> Check:
    """Σ R·∂r/∂ξ − what is passed on = left-hand side − Ξ, which the equation of motion makes zero."""
    words = text("the sum is the left-hand side of the equation minus ", Name("Xi"), ", for every coordinate")
    return agree(context, words, [(x.rest, x.left - x.Xi) for x in found])
