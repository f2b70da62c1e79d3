"""Tells a term that differs as it is written, where it was told by the sines and cosines of the parts of its angle.

τ (b/r) cos(π/4 + θ/2) has the wrong sign, and not τ √2 b cos(½ θ)/(2 r) − τ √2 b sin(½ θ)/(2 r).
"""

from __future__ import annotations

from dataclasses import replace
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.combined_rows import MOST_TERMS, own_terms_of
from lagrangian.check.reference import Reference, terms
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.terms.pieces import partner
from lagrangian.check.verdict import Finding, Status, TermDifference, Verdict


def with_whole_terms(truth: Reference, verdict: Verdict) -> Verdict:
    """The verdict, with sums that differ as the one term of the line that they are."""
    findings = tuple(_whole(truth, f) for f in verdict.findings)
    return verdict if findings == verdict.findings else replace(verdict, findings=findings)


def _whole(truth: Reference, finding: Finding) -> Finding:
    if finding.status is not Status.WRONG or not any(isinstance(d.written, sp.Add) for d in finding.differences):
        return finding
    expr = finding.line.expr
    summed = any(isinstance(f.args[0], sp.Add) for f in expr.atoms(sp.sin, sp.cos))
    if not summed or terms(expr) > MOST_TERMS:
        return finding
    own = [t for t in own_terms_of(expr) if not isinstance(t, sp.Add) and t.has(sp.sin, sp.cos)]
    return replace(finding, differences=tuple(_as_term(truth, d, own) for d in finding.differences))


def _as_term(truth: Reference, difference: TermDifference, own: list[sp.Expr]) -> TermDifference:
    """A difference with the one of some terms that is what was written, and what should be in its place."""
    if not isinstance(difference.written, sp.Add):
        return difference
    letters = bounded.letters(difference.written)
    for term in (t for t in own if bounded.letters(t) == letters):
        for whole in (term, cast("sp.Expr", -term)):
            if zero_everywhere(truth, cast("sp.Expr", difference.written - whole)):
                right = _like(truth, whole, difference)
                return difference if right is None else replace(difference, written=whole, term=right)
    return difference


def _like(truth: Reference, whole: sp.Expr, difference: TermDifference) -> sp.Expr | None:
    """What should be in the place of a term, as a multiple of it or with the other function of the same angle."""
    ratio = bounded.cancel(cast("sp.Expr", difference.term / difference.written))
    if not ratio.atoms(sp.sin, sp.cos):
        return cast("sp.Expr", ratio * whole)
    turned = [whole.xreplace({f: sign * partner(f)}) for f in whole.atoms(sp.sin, sp.cos) for sign in (1, -1)]
    found = (x for x in turned if zero_everywhere(truth, cast("sp.Expr", difference.term - x)))
    return cast("sp.Expr | None", next(found, None))
