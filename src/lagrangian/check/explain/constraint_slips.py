"""Finds the slip in a line that says what a constraint asks: f = 0, its derivative by time, or its second derivative.

A line is compared term by term with the constraint that it resembles most, in the line's own scale.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import product as pairs_of
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.constraints.counted_together import integrated
from lagrangian.check.explain.changes.ring import Monomial, Sum, SumRing, TooLong, minus, product, scaled
from lagrangian.check.explain.identity_slips import identity_slip
from lagrangian.check.explain.own_terms import term_replaced
from lagrangian.check.explain.virtual_displacements import MOVES
from lagrangian.check.reading.line_forms import accelerates
from lagrangian.check.reference import Reference
from lagrangian.check.terms.sides import on_side
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake, Status, TermDifference
from lagrangian.model import time
from lagrangian.model.rows import Row, rows_of
from lagrangian.page.formula import Variation, text
from lagrangian.records import dataclass

MOST_TERMS = 24
"""The largest number of terms of a line, and of a constraint, that are compared."""
NAMES = (("constraint_wrong", ""), ("constraint_rate_wrong", "first "), ("constraint_acceleration_wrong", "second "))
WHY = (
    text("Put in a position that the sketch shows, and see whether the line holds there."),
    text("Differentiate by time, term by term: every coordinate in a product or a function has its own rate."),
    text("Differentiate the rates and what multiplies them: the product rule leaves squares and products of rates."),
)
"""Why, for a constraint, its first and its second derivative."""
WHY_SLOPE = text(
    "Change one coordinate alone, hold the others, and mind the sign of the derivative of a sine or cosine."
)
WHY_SENSE = text("Let one coordinate grow a little, and see in the sketch whether the other one grows, too.")
SLOPE = -1
"""The order of a line ∂f/∂ξ = …"""


@dataclass(frozen=True, eq=False)
class WrongConstraint:
    """A line that does not say what the constraints do, the mistake, and by what it is differentiated for λ.

    ``order`` is how often the constraint was differentiated by time, or `SLOPE`. ``follows``: the line is the
    derivative of another such line.
    """

    finding: Finding
    mistake: Mistake
    order: int
    follows: bool = False

    @property
    def expr(self) -> sp.Expr:
        """What the line says is 0."""
        return self.finding.line.expr

    @property
    def key(self) -> tuple[int, str]:
        """Which line it is."""
        return self.finding.line.number, self.finding.line.text


def wrong_constraints(truth: Reference, findings: Sequence[Finding]) -> tuple[WrongConstraint, ...]:
    """The wrong lines that state constraints or derivatives of these, each with what is wrong in it."""
    model = truth.model
    moving = [x for c in model.coordinates for x in (c.rate, c.acceleration)]
    places = [c.symbol for c in model.coordinates]
    found: list[WrongConstraint] = []
    for f in findings:
        expr = f.line.expr
        if f.line.kind not in ("equation", "definition") or f.status is not Status.WRONG:
            continue
        if not bounded.letters(expr) <= truth.names or not expr.has(*places):
            continue
        above = next((x for x in found if _derived(x.expr, expr)), None)
        if above is not None:
            found.append(replace(above, finding=f, follows=True))
            continue
        if not expr.has(*moving) and any(x in f.line.text.partition("=")[0] for x in ("∂", "partial", "/d")):
            found.append(WrongConstraint(f, _slope(truth, f.line), SLOPE))
            continue
        slip = identity_slip(truth, f.line) or _slip(truth, f.line)
        if slip is not None or not expr.has(*moving):
            found.append(WrongConstraint(f, *(slip or (_elsewhere(truth, f.line), 0))))
    return tuple(found)


def _slope(truth: Reference, line: AnsweredLine) -> Mistake:
    """A line that says wrongly how a constraint changes with one coordinate."""
    element = _only(truth)
    what = text(line.opening, f" is not right: it is no derivative of {element or 'a constraint'} by a coordinate.")
    return Mistake("constraint_slope_wrong", what, WHY_SLOPE, 6, element, None, what)


def _elsewhere(truth: Reference, line: AnsweredLine) -> Mistake:
    """A line of positions alone that resembles no constraint."""
    element = _only(truth)
    what = text(line.opening, f" does not hold for the positions that {element or 'the constraints'} allows.")
    return Mistake(NAMES[0][0], what, WHY[0], 1, element, None, what)


def _only(truth: Reference) -> str | None:
    """The element that all constraints are of; None if there are several."""
    elements = {m.element.title for m in truth.derivation.multipliers.values()}
    return elements.pop() if len(elements) == 1 else None


def _derived(of: sp.Expr, expr: sp.Expr) -> bool:
    """Whether an expression is another one or its first or second derivative, in any scale."""
    rate = bounded.diff(of, time)
    for made in (of, rate, bounded.diff(rate, time)):
        quotient = bounded.cancel(bounded.expand(expr) / bounded.expand(made)) if made != 0 else sp.nan
        if quotient is not sp.nan and not quotient.atoms(AppliedUndef):
            return True
    return False


@dataclass(frozen=True, eq=False)
class _Compared:
    """A line beside a constraint in its scale: what both have, and what is missing, too much or otherwise."""

    row: Row
    order: int
    right: Sum
    written: Sum
    same: int

    @property
    def difference(self) -> Sum:
        return minus(self.written, self.right)


def _slip(truth: Reference, line: AnsweredLine) -> tuple[Mistake, int] | None:
    """The one slip in a line of which the rest is a constraint, and how often that was differentiated."""
    ring = SumRing(truth.model)
    try:
        written = ring.fold(ring.of(bounded.expand(line.expr)))
        best = max(_all(truth, ring, written, line.expr), key=lambda x: x.same - len(x.difference), default=None)
    except TooLong:
        return None
    if best is None or best.same < max(1, len(best.right) // 2):
        return None
    opposed = _opposed(ring, best, line) or _opposed_rates(truth, ring, best)
    said = opposed or _said(ring, best, line)
    if said is None:
        return None
    title, of = best.row.element.title, NAMES[best.order]
    if line.name == MOVES:
        is_not = f" does not hold for the virtual displacements that {title} allows"
        said = _of_displacements(truth, said)
    elif best.row.position is None and best.order < 2:  # ẋ = R φ̇, and x = R φ if both are counted from the same place
        is_not = f" does not hold for {title}"
    else:
        which = "" if best.row.position is None else of[1]  # of a constraint on velocities, the first one
        is_not = f" is not {title}" if best.order == 0 else f" is not the {which}derivative of {title}"
    what = text(line.opening, f"{is_not}: ", *said)
    brief = text(line.opening, f"{is_not}.")
    why = WHY_SENSE if opposed else WHY[best.order]
    return Mistake(of[0], what, why, 1, title, None, brief), best.order


def _of_displacements(truth: Reference, said: Sequence[Any]) -> tuple[Any, ...]:
    """Words with δξ for ξ̇, or with a remark where a rate stands in a longer term."""
    rates: dict[Any, Any] = {c.rate: Variation(c.symbol) for c in truth.model.coordinates}
    put = [rates.get(x, x) if isinstance(x, sp.Expr) else x for x in said]
    longer = any(isinstance(x, sp.Expr) and x.has(*rates) for x in put)
    return ("with rates in place of displacements, " if longer else "", *put)


def _all(truth: Reference, ring: SumRing, written: Sum, expr: sp.Expr) -> Iterator[_Compared]:
    """A line beside every constraint and its derivatives, each in the scale in which most terms agree."""
    model = truth.model
    lengths = {*expr.free_symbols} - {time}
    for row in rows_of(model):
        exprs = [row.rate, bounded.diff(row.rate, time)]
        if (place := integrated(truth, row)) is not None:
            exprs = [place, *exprs]
        ordered = [*enumerate(exprs, 3 - len(exprs))]
        if place is not None and (squared := _squared(truth, place)) is not None:
            rate = bounded.diff(squared, time)
            ordered = [*enumerate((squared, rate, bounded.diff(rate, time))), *ordered]
        for order, one in ordered:
            whole = bounded.expand(truth.expand(one))
            right = ring.fold(ring.of(whole))
            if not lengths <= _alike(truth, whole) or max(len(right), len(written)) > MOST_TERMS:
                continue
            if _highest(truth, expr) == _highest(truth, whole):
                yield from _scaled(ring, row, order, right, written)


def _squared(truth: Reference, place: sp.Expr) -> sp.Expr | None:
    """A distance √A − l = 0 without its root, A − l² = 0; None for a constraint with none, or with several."""
    moving = truth.derivation.coordinates
    roots = [x for x in place.atoms(sp.Pow) if x.exp == sp.S.Half and x.has(*moving)]
    if len(roots) != 1:
        return None
    root = sp.Dummy()
    flat = cast("sp.Expr", place.xreplace({roots[0]: root}))
    factor = bounded.diff(flat, root)
    rest = bounded.expand(flat - factor * root)
    if factor == 0 or factor.has(root, *moving) or rest.has(root, *moving):
        return None
    return bounded.expand(factor**2 * roots[0].base - rest**2)


def _alike(truth: Reference, expr: sp.Expr) -> set[Any]:
    """The letters of a constraint, and those of the same unit, one of which may stand in place of another."""
    own = {p for p in truth.model.parameters if expr.has(p.symbol)}
    units = {str(p.unit) for p in own}
    return {p.symbol for p in truth.model.parameters if p in own or str(p.unit) in units}


def _highest(truth: Reference, expr: sp.Expr) -> int:
    """How often a coordinate is differentiated in an expression."""
    c = truth.model.coordinates
    return 2 if expr.has(*(x.acceleration for x in c)) else 1 if expr.has(*(x.rate for x in c)) else 0


def _scaled(ring: SumRing, row: Row, order: int, right: Sum, written: Sum) -> Iterator[_Compared]:
    """A constraint in the scale of a line: the number and product of letters with which most of its terms agree."""
    votes: dict[tuple[Monomial, Fraction], list[int]] = {}
    for (m, c), (n, d) in pairs_of(right.items(), written.items()):
        ratio = product([n, tuple((a, -e) for a, e in m)])
        if not any(ring.changes(a) for a, _ in ratio):
            counted = votes.setdefault((ratio, d / c), [0, 0])
            counted[0] += 1
            counted[1] += _accelerates(ring, n)
    if not votes:
        return
    (ratio, number), (same, _) = max(votes.items(), key=lambda x: (*x[1], not x[0][0], abs(x[0][1]) == 1))
    there = {product([m, ratio]): c * number for m, c in right.items()}
    yield _Compared(row, order, there, written, same)


def _opposed(ring: SumRing, found: _Compared, line: AnsweredLine) -> tuple[Any, ...] | None:
    """Of two terms that are 0 together, ẋ + R θ̇ = 0, neither has the wrong sign: they have, against each other."""
    whole = line.text.rstrip(" )$.,;&}\\").replace(" ", "").endswith(("=0", ",0"))
    if not whole or len(found.right) != 2 or found.written.keys() != found.right.keys():
        return None
    if any(sum(ring.changes(a) for a, _ in m) != 1 for m in found.right):
        return None  # both terms of x ẋ + y ẏ = 0 come from a sum of squares, which has signs
    turned = [m for m, c in found.right.items() if found.written[m] == -c]
    if len(turned) != 1 or len(found.difference) != 1:
        return None
    terms = [ring.expr({m: abs(found.written[m])}) for m in sorted(found.written, key=len)]
    first, second = found.written.values()
    are, must = ("the same sign", "opposite ones") if first * second > 0 else ("opposite signs", "the same one")
    return ("the terms ", terms[0], " and ", terms[1], f" have {are} and must have {must}.")


def _opposed_rates(truth: Reference, ring: SumRing, found: _Compared) -> tuple[Any, ...] | None:
    """All that multiplies one rate, in place of −, in a relation of two rates with several terms each."""
    if found.order != 1 or found.written.keys() != found.right.keys() or len(found.right) < 3:
        return None
    rates = [c.rate for c in truth.model.coordinates]
    groups = [[m for m in found.right if ring.product(m).has(x)] for x in rates]
    held = [(x, g) for x, g in zip(rates, groups, strict=True) if g]
    if len(held) != 2 or sum(len(g) for _, g in held) != len(found.right):
        return None
    signs = [{found.written[m] / found.right[m] for m in g} for _, g in held]
    if sorted(map(tuple, signs)) != [(-1,), (1,)]:
        return None
    (one, _), (other, _) = held
    return ("what multiplies ", one, " has the wrong sign beside what multiplies ", other, ".")


def _said(ring: SumRing, found: _Compared, line: AnsweredLine) -> tuple[Any, ...] | None:
    """What is wrong in a line: the squares of the rates, or one term; None for more."""
    difference = found.difference
    missing = {m: c for m, c in found.right.items() if difference.get(m) == -c and m not in found.written}
    if missing and len(missing) == len(difference):
        what = ring.expr(missing)
        if len(missing) == 1:
            side, as_written = on_side(line, TermDifference("missing", what, sp.S.Zero, None))
            return (f"{side}, " if side else "", "the term ", as_written.term, " is missing.")
        if found.order == 2 and not any(_accelerates(ring, m) for m in missing):
            return ("the terms with products of rates, ", what, ", are missing.")
    if left_out := _left_out(ring, found):
        return (left_out, " is left out.")
    turned = {m: c for m, c in found.right.items() if difference.get(m) == -2 * c}
    if turned and len(turned) == len(difference):
        if len(turned) > 1 and (found.order < 2 or any(_accelerates(ring, m) for m in turned)):
            return None
        be = "has" if len(turned) == 1 else "have"
        term = ring.expr(scaled(turned, -1))
        if be == "has":  # as it stands in the line
            _, as_written = on_side(line, TermDifference("sign", -term, term, None))
            term = as_written.written
        return ("the term " if be == "has" else "the terms ", term, f" {be} the wrong sign.")
    return _one(ring, found, line)


def _left_out(ring: SumRing, found: _Compared) -> sp.Expr | None:
    """The coordinate without which a constraint is what is written."""
    for a in {a for m in found.right for a, _ in m}:
        if isinstance(ring.atoms[a], AppliedUndef) and found.written == {
            m: c for m, c in found.right.items() if all(x != a for x, _ in m)
        }:
            return ring.atoms[a]
    return None


def _one(ring: SumRing, found: _Compared, line: AnsweredLine) -> tuple[Any, ...] | None:
    """One term with another number, too much, or in place of another, as it stands in the line."""
    difference = found.difference
    more = [m for m in difference if m in found.written]
    less = [m for m in difference if m in found.right]
    if len(more) > 1 or len(less) > 1 or not more:
        return None
    term = ring.expr({more[0]: found.written[more[0]]})
    right = ring.expr({less[0]: found.right[less[0]]}) if less else sp.S.Zero
    _, as_written = on_side(line, TermDifference("", right, term, None))
    _, what = term_replaced(as_written.written, as_written.term)
    first, *rest = what.parts
    return (str(first)[:1].lower() + str(first)[1:], *rest)


def _accelerates(ring: SumRing, m: Monomial) -> bool:
    expr = cast("sp.Expr", ring.product(m))
    return accelerates(expr)
