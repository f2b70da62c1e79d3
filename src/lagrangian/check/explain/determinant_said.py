"""Names a wrong determinant where it stands: Δ = A I + B², by which both accelerations are divided further down."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import cast

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain import solved
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake, Status, TermDifference, Verdict, inserted
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.page.formula import Text, text
from lagrangian.read.letters import key

WHY = text("The determinant of a symmetric matrix with the rows (A, B) and (B, I) is A I − B².")
WHAT_MULTIPLIES = "what multiplies the acceleration once the others are eliminated"
NEAR = 1e-9
"""The relative difference of values that is rounding."""


def with_determinant(truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict) -> Verdict:
    """The verdict on accelerations whose denominator alone is wrong, with the definition of this denominator as what is
    wrong, if there is one, and the accelerations as what follows."""
    if not verdict.mistakes or any(m.name not in (solved.NAME, solved.TERM_NAME) for m in verdict.mistakes):
        return verdict
    rows = verdict.open_findings
    if truth.n < 2 or not all(f.line.kind == "equation" for f in rows):
        return verdict
    above = [x for x in lines if x.kind == "definition" and x.name and x.number < min(f.line.number for f in rows)]
    for line in above:
        right = _right(truth, line.expr, rows) if all(key(line.name or "") in f.line.names for f in rows) else None
        if right is None:
            continue
        if _is_near(right, CompiledExpressions([truth.determinant]).at(truth.states)[0]):
            return _told(truth, line, rows, verdict, right, "the determinant of the mass matrix")
        known = _sign(truth, line.expr, right) is not None or any(m.name == solved.TERM_NAME for m in verdict.mistakes)
        if known and all(_is_below(truth, f.line.expr, line.expr) for f in rows):  # no factor of the whole row
            return _told(truth, line, rows, verdict, right, WHAT_MULTIPLIES)
    return verdict


def _right(truth: Reference, below: sp.Expr, rows: Sequence[Finding]) -> Array | None:
    """What all rows should be divided by in place of ``below``, at every state; None if it is not the same for all."""
    accelerations = [c.acceleration for c in truth.model.coordinates]
    values = CompiledExpressions([below, *(f.line.expr for f in rows)]).at(truth.states)
    slopes = CompiledExpressions([f.line.expr for f in rows]).slopes(accelerations).at(truth.states)
    slopes = slopes.reshape(len(rows), truth.n, -1)
    found: Array | None = None
    for f, value, slope in zip(rows, values[1:], slopes, strict=True):
        own = [i for i, a in enumerate(accelerations) if f.line.expr.has(a)]
        if len(own) != 1:
            return None
        a = accelerations[own[0]]
        with np.errstate(all="ignore"):
            written = truth.states.of(a) - value / slope[own[0]]
            right = written * values[0] / truth.accelerations[a]
        if not np.isfinite(right).all() or (found is not None and not _is_near(right, found)):
            return None
        found = right
    return found


def _is_below(truth: Reference, expr: sp.Expr, below: sp.Expr) -> bool:
    """Whether all that an equation has of a sum in a denominator is a value."""
    bases = {f.base for f in expr.atoms(sp.Pow) if f.exp == -1 and f.base.is_Add}
    return len(bases) == 1 and bounded.expand(truth.expand(bases.pop() - below)) == 0


def _is_near(one: Array, other: Array) -> bool:
    return bool(np.isfinite(one).all() and np.abs(one - other).max() <= 1e3 * NEAR * (1 + np.abs(other).max()))


def _told(
    truth: Reference, line: AnsweredLine, rows: Sequence[Finding], verdict: Verdict, right: Array, of: str
) -> Verdict:
    wrong = _sign(truth, line.expr, right)
    what = _words(line, wrong, of)
    parts = verdict.mistakes[0].what.parts
    place = next((k for k, x in enumerate(parts) if solved.IN_IT in str(x)), None)
    if wrong is None and place is not None:
        what = text(*what.parts, str(parts[place])[str(parts[place]).index(solved.IN_IT) :], *parts[place + 1 :])
    findings = [replace(f, follows=True) if f in rows else f for f in verdict.findings]
    differing = () if wrong is None else (TermDifference("sign", -wrong, wrong, None),)
    why = solved.WHY_BELOW if of == WHAT_MULTIPLIES else WHY if truth.n == 2 else solved.WHY
    mistake = Mistake(solved.NAME, what, why, 5, brief=text(f"{line.opening} is not right."))
    told = inserted(findings, Finding(line, Status.WRONG, None, None, differing))
    return replace(verdict, findings=tuple(told), mistakes=(mistake,), alternatives=())


def _words(line: AnsweredLine, wrong: sp.Expr | None, of: str) -> Text:
    first = f"{line.opening} is not right: {line.name} is not {of}"
    return text(f"{first}.") if wrong is None else text(f"{first}: the term ", wrong, " in it has the wrong sign.")


def _sign(truth: Reference, below: sp.Expr, right: Array) -> sp.Expr | None:
    """The term of a wrong determinant that has the wrong sign, if that is all."""
    parts = [cast("sp.Expr", x) for x in sp.Add.make_args(below)]
    values = CompiledExpressions([below, *parts]).at(truth.states)
    found = [x for x, v in zip(parts, values[1:], strict=True) if _is_near(values[0] - 2 * v, right)]
    return found[0] if len(parts) > 1 and len(found) == 1 else None
