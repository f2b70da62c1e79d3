"""Names a wrong determinant where it stands: Δ = A I + B², by which both accelerations are divided further down."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import cast

import numpy as np
import sympy as sp

from lagrangian.check.explain import solved
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake, Status, TermDifference, Verdict, inserted
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.page.formula import Text, text
from lagrangian.read.letters import key

WHY = text("The determinant of a symmetric matrix with the rows (A, B) and (B, I) is A I − B².")
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
        if all(key(line.name or "") in f.line.names for f in rows) and _explains(truth, line.expr, rows):
            return _told(truth, line, rows, verdict)
    return verdict


def _explains(truth: Reference, below: sp.Expr, rows: Sequence[Finding]) -> bool:
    """Whether all rows are right but for being divided by ``below`` in place of the determinant."""
    accelerations = [c.acceleration for c in truth.model.coordinates]
    values = CompiledExpressions([below, truth.determinant, *(f.line.expr for f in rows)]).at(truth.states)
    slopes = CompiledExpressions([f.line.expr for f in rows]).slopes(accelerations).at(truth.states)
    slopes = slopes.reshape(len(rows), truth.n, -1)
    for f, value, slope in zip(rows, values[2:], slopes, strict=True):
        own = [i for i, a in enumerate(accelerations) if f.line.expr.has(a)]
        if len(own) != 1:
            return False
        a = accelerations[own[0]]
        with np.errstate(all="ignore"):
            written = truth.states.of(a) - value / slope[own[0]]
            right = written * values[0] / values[1]
        if not _is_near(right, truth.accelerations[a]):
            return False
    return True


def _is_near(one: Array, other: Array) -> bool:
    return bool(np.isfinite(one).all() and np.abs(one - other).max() <= 1e3 * NEAR * (1 + np.abs(other).max()))


def _told(truth: Reference, line: AnsweredLine, rows: Sequence[Finding], verdict: Verdict) -> Verdict:
    wrong = _sign(truth, line.expr)
    what = _words(line, wrong)
    findings = [replace(f, follows=True) if f in rows else f for f in verdict.findings]
    differing = () if wrong is None else (TermDifference("sign", -wrong, wrong, None),)
    why = WHY if truth.n == 2 else solved.WHY
    mistake = Mistake(solved.NAME, what, why, 5, brief=text(f"{line.opening} is not right."))
    told = inserted(findings, Finding(line, Status.WRONG, None, None, differing))
    return replace(verdict, findings=tuple(told), mistakes=(mistake,), alternatives=())


def _words(line: AnsweredLine, wrong: sp.Expr | None) -> Text:
    first = f"{line.opening} is not right: {line.name} is not the determinant of the mass matrix"
    return text(f"{first}.") if wrong is None else text(f"{first}: the term ", wrong, " in it has the wrong sign.")


def _sign(truth: Reference, below: sp.Expr) -> sp.Expr | None:
    """The term of a wrong determinant that has the wrong sign, if that is all."""
    parts = [cast("sp.Expr", x) for x in sp.Add.make_args(below)]
    values = CompiledExpressions([below, truth.determinant, *parts]).at(truth.states)
    found = [x for x, v in zip(parts, values[2:], strict=True) if _is_near(values[0] - 2 * v, values[1])]
    return found[0] if len(parts) > 1 and len(found) == 1 else None
