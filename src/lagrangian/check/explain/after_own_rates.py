"""Rates of names of the answer's own: which term is wrong in İ = m ρ ṡ cos β, and what follows from it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any, TypeAlias, cast

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.align import alignments
from lagrangian.check.explain.at_places import changes, proportional_at_places
from lagrangian.check.explain.derivative_lines import LONGEST, WHY, product_rule, replaced
from lagrangian.check.explain.energy_theorem import is_energy_theorem
from lagrangian.check.explain.free_bodies import proportional
from lagrangian.check.explain.own_terms import term_replaced
from lagrangian.check.explain.said_wrongly import said_of_rate
from lagrangian.check.reference import Reference
from lagrangian.check.rows import same_values, zero_everywhere
from lagrangian.check.stated import right_value
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake
from lagrangian.derive.sampling import CompiledExpressions
from lagrangian.page.formula import Name, Total, text

Way: TypeAlias = Callable[[Reference, Finding, Sequence[AnsweredLine]], bool]
STEP = 5
"""The step of the derivatives."""
WHY_SECOND = text(
    "An acceleration is d/dt of a velocity: differentiate each factor in turn, and mind the sign that each brings."
)
SMALL = 1e-9
"""The relative size of a difference that is rounding."""


def _is_own_rate(truth: Reference, line: AnsweredLine) -> bool:
    """Whether a line says what the rate of a name is whose value the answer has stated."""
    return _is_rate(line) and line.name not in truth.model.symbols


def _is_rate(line: AnsweredLine) -> bool:
    """Whether a line says what the rate of a name is, of the system or of the answer."""
    return (
        line.kind == "identity"
        and line.name is not None
        and line.sides is not None
        and line.sides[0].has(sp.Derivative)
    )


def _is_acceleration(line: AnsweredLine) -> bool:
    """Whether a line says what the second rate of a name is, y'' = …, and not its first."""
    first = line.sides[0] if line.sides is not None else sp.S.Zero
    return (line.name or "").endswith("''") or any(d.derivative_count > 1 for d in first.atoms(sp.Derivative))  # type: ignore[attr-defined]


def slip_in_own_rate(truth: Reference, line: AnsweredLine) -> Mistake | None:
    """The one term of such a rate that is wrong; None if it is more."""
    if not _is_own_rate(truth, line) or line.sides is None or line.name is None:
        return None
    if not line.sides[1].has(sp.Derivative):  # q' may be meant as a slope
        return None
    right = [x for x in sp.Add.make_args(bounded.expand(truth.expand(line.sides[0]))) if x != 0]
    rest = [x for x in sp.Add.make_args(bounded.expand(cast("sp.Expr", -line.expr))) if x != 0]
    pair = replaced(rest, right) if rest and len(right) <= LONGEST else None
    if pair is None:
        return None
    written, meant = (cast("sp.Expr", sp.factor_terms(x)) for x in pair)
    title = line.title if _is_acceleration(line) else Total(Name(line.name))
    name, said = term_replaced(written, meant)
    first, *others = said.parts
    words = str(first)
    what = text("In ", title, ": " if words.startswith("In ") else ", ", words[:1].lower() + words[1:], *others)
    why = product_rule.WHY if written == 0 else WHY_SECOND if _is_acceleration(line) else WHY
    return Mistake(name, what, why, STEP, None, None, text("A term of ", title, " is not right."))


def follow_from_own_rates(truth: Reference, findings: Sequence[Finding]) -> list[Finding]:
    """The findings, with those marked that hold with wrong rates that the answer states above, or that have what these
    have too much, times a rate."""
    for is_root, ways in ((_is_rate, _WAYS), (partial(_is_square, truth), (_has_excess_of_squares,))):
        findings = _following(truth, findings, is_root, ways)
    return list(findings)


def _following(
    truth: Reference, findings: Sequence[Finding], is_root: Callable[[AnsweredLine], bool], ways: Sequence[Way]
) -> Sequence[Finding]:
    """The findings, with those marked that follow in one of some ways from wrong lines above them."""
    roots = [f for f in findings if f.is_open and is_root(f.line)]
    if not roots:
        return findings
    found: list[Finding] = []
    for f in findings:
        above = [x.line for x in roots if x.line.number <= f.line.number and x is not f]
        sought = f.is_open and not any(f is x for x in roots)
        follows = sought and bool(above) and any(x(truth, f, above) for x in ways)
        found.append(replace(f, follows=True, differences=()) if follows else f)
    return found


def _holds_with(truth: Reference, finding: Finding, said: Sequence[AnsweredLine]) -> bool:
    """Whether a line is true where the rates have the values that are said of them."""
    line = finding.line
    table: dict[Any, Any] = {x.sides[0]: x.sides[1] for x in said if x.sides is not None}
    if line.sides is None or line.kind not in ("equation", "identity"):
        return False
    left, right = (cast("sp.Expr", x.xreplace(table)) for x in line.sides)
    return (left, right) != line.sides and zero_everywhere(truth, truth.expand(left - right))


def _has_its_excess(truth: Reference, finding: Finding, said: Sequence[AnsweredLine]) -> bool:
    """Whether an equation is wrong by what a rate has too much, times a rate of a coordinate or 1."""
    line = finding.line
    if line.kind != "equation" or len(finding.differences) > 1:
        return False
    rates = [truth.states.of(c.rate) for c in truth.model.coordinates]
    own, *extra = CompiledExpressions([line.expr, *(x.expr for x in said)]).at(truth.states)
    if not (np.isfinite(own).all() and all(np.isfinite(x).all() for x in extra)):
        return False
    factors = [np.ones_like(own), *rates]
    wrong = [sign * x * r for x in extra for r in factors for sign in (1, -1)]
    return any(same_values(a.rest[0], x, SMALL) for a in alignments(truth, [line.expr], own[None]) for x in wrong)


def _has_its_acceleration(truth: Reference, finding: Finding, said: Sequence[AnsweredLine]) -> bool:
    """Whether an equation is wrong by what an acceleration has too much, times something without rates: m r sin φ."""
    line, wrong = finding.line, [x for x in said if _is_acceleration(x)]
    if line.kind != "equation" or not wrong:
        return False
    own, *extra = CompiledExpressions([line.expr, *(x.expr for x in wrong)]).at(truth.states)
    if not (np.isfinite(own).all() and all(np.isfinite(x).all() for x in extra)):
        return False
    rests = [a.rest[0].reshape(-1, truth.states.motions) for a in alignments(truth, [line.expr], own[None])]
    blocks = [x.reshape(-1, truth.states.motions) for x in extra]
    return any(changes(x) and proportional_at_places(r, x) for r in rests for x in blocks)


def _has_its_square(truth: Reference, finding: Finding, said: Sequence[AnsweredLine]) -> bool:
    """Whether T*, L or D is wrong by a constant times what the square of a rate has too much."""
    line = finding.line
    right = right_value(truth, line, None) if line.kind in ("T", "L", "D") else None
    if right is None or (line.kind != "D" and any(_is_along_an_axis(truth, x, line.expr - right) for x in said)):
        return False
    pairs = [tuple(cast("sp.Expr", truth.expand(y)) for y in x.sides) for x in said if x.sides is not None]
    values = CompiledExpressions([line.expr - right, *(b**2 - a**2 for a, b in pairs)]).at(truth.states)
    return bool(np.isfinite(values).all()) and any(proportional(values[0], x) for x in values[1:])


def _is_square(truth: Reference, line: AnsweredLine) -> bool:
    """Whether an equation may say what the square of a speed is: it has rates, and no acceleration and no input."""
    held = [*(c.acceleration for c in truth.model.coordinates), *(u.symbol for u in truth.model.inputs)]
    if line.kind != "equation" or line.sides is None or line.expr.has(*held):
        return False
    return all(x.has(sp.Derivative) for x in line.sides) and not is_energy_theorem(truth, line.expr)


def _has_excess_of_squares(truth: Reference, finding: Finding, said: Sequence[AnsweredLine]) -> bool:
    """Whether T* or L is wrong by a constant times what the square of a speed has too much: ẏ² = ż² + 2 L ż θ̇ cos θ."""
    line = finding.line
    right = right_value(truth, line, None) if line.kind in ("T", "L") else None
    if right is None:
        return False
    values = CompiledExpressions([line.expr - right, *(x.expr for x in said)]).at(truth.states)
    return bool(np.isfinite(values).all()) and any(proportional(values[0], x) for x in values[1:])


def _is_along_an_axis(truth: Reference, rate: AnsweredLine, more: sp.Expr) -> bool:
    """Whether a rate is a velocity along a fixed axis, which is told as such, with all that follows from it."""
    return any(zero_everywhere(truth, sp.Add(p.T, -more)) for p in said_of_rate(truth, rate))


_WAYS = (_holds_with, _has_its_excess, _has_its_acceleration, _has_its_square)
