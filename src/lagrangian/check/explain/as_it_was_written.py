"""Tells "in the term …" of the term that stands in the answer, not of the right one in its place.

m r Ω² cos ψ for m r Ω² sin ψ     Sine and cosine are exchanged in the term m r Ω² cos ψ.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import cast

import sympy as sp

from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.verdict import Mistake, Status, TermDifference, Verdict
from lagrangian.page.formula import text

OPENINGS = ("In the term ", "in the term ")


def with_terms_as_written(truth: Reference, verdict: Verdict) -> Verdict:
    """The verdict, in which sentences on what is wrong in a term name it as it stands in a wrong line."""
    roots = [f for f in verdict.findings if f.status is Status.WRONG and not f.follows]
    differences = [d for f in roots for d in f.differences if d.written != 0 and d.kind not in ("missing", "extra")]
    if not differences:
        return verdict
    told, others = (tuple(_said(truth, m, differences) for m in x) for x in (verdict.mistakes, verdict.alternatives))
    return replace(verdict, mistakes=told, alternatives=others)


def _said(truth: Reference, mistake: Mistake, differences: Sequence[TermDifference]) -> Mistake:
    """A mistake whose first term is the right one of a difference, with the one that was written."""
    first, *more = mistake.what.parts
    term = more[0] if more else None
    if not (isinstance(first, str) and first.endswith(OPENINGS) and isinstance(term, sp.Expr)):
        return mistake
    own = [d for d in differences if mistake.coordinate in (None, d.coordinate)]
    signs = (sp.S.One, sp.S.NegativeOne)
    if any(zero_everywhere(truth, d.written - s * term) for d in differences for s in signs):
        return mistake
    found = [cast("sp.Expr", s * d.written) for d in own for s in signs if zero_everywhere(truth, d.term - s * term)]
    return replace(mistake, what=text(first, found[0], *more[1:])) if len(found) == 1 else mistake
