"""Says of a wrong sine or cosine in an equation in which of its terms, as it is written, it stands."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.narrowed import FUNCTIONS
from lagrangian.check.explain.own_terms import LINES
from lagrangian.check.verdict import Finding, Mistake, Status
from lagrangian.page.formula import text


def in_written_terms(told: Sequence[Mistake], findings: Sequence[Finding]) -> tuple[Mistake, ...]:
    """The mistakes; a wrong function in an equation is told of the one term that has it as a factor."""
    wrong = [f for f in findings if f.status is Status.WRONG and not f.follows and f.line.kind == "equation"]
    return tuple(_in_its_term(m, [f for f in wrong if f.coordinate == m.coordinate]) for m in told)


def _in_its_term(mistake: Mistake, wrong: Sequence[Finding]) -> Mistake:
    """A mistake in an equation that is ``wrong``: sin θ in place of cos θ as a factor of its only different term."""
    if mistake.step != LINES["equation"] or mistake.name not in FUNCTIONS or len(wrong) != 1:
        return mistake
    if any(isinstance(x, sp.Mul) for x in mistake.what.parts):  # its term is told
        return mistake
    differing = wrong[0].differences
    if len(differing) != 1 or 0 in (differing[0].written, differing[0].term):
        return mistake
    more, less = sp.fraction(bounded.cancel(differing[0].written / differing[0].term))
    if not all(isinstance(x, (sp.sin, sp.cos)) for x in (more, less)):
        return mistake
    said = ("In the term ", differing[0].written, ", the factor ", more, " stands in place of ", less, ".")
    return replace(mistake, what=text(*said))
