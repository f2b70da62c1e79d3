"""Mistakes in derivatives that nobody wrote down, told by the terms of the equation that are wrong.

What T* adds to ∂L/∂θ has the wrong sign.        The term −m r l φ̇² sin θ has the wrong sign.
What ṡ adds to d/dt (∂T*/∂φ̇) counts half.       The term m s ṡ φ̇ should be 2 m s ṡ φ̇.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from lagrangian.check.explain.own_terms import term_replaced
from lagrangian.check.explain.term_said import with_reason
from lagrangian.check.explain.without_energies import silent_energies
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import DERIVED, AnsweredLine, Finding, Mistake, TermDifference, Verdict
from lagrangian.page.formula import Left, Minus, Partial, Text, Total, text

STEP, KINETIC = 5, 2
"""The step of the left-hand sides, and that of the kinetic energy, from which their terms come."""
LEFT_OVER = "left_over"
"""What cancels in the derivation, and stands in the equation: it says which derivative cancels it."""
MOST_TOLD = 3
"""The most terms that are told in one sentence."""


def with_terms_of_equations(truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict) -> Verdict:
    """The verdict on an answer without derivatives, in which mistakes in these are told by the terms that differ.

    The derivative is a possible reason where an energy is stated.
    """
    if not {line.kind for line in lines}.isdisjoint(("p", *DERIVED)):
        return verdict
    stated = silent_energies(lines) != {"T*", "V"}
    told = tuple(_by_terms(truth, m, verdict, stated) for m in verdict.mistakes)
    return replace(verdict, mistakes=told)


def _by_terms(truth: Reference, mistake: Mistake, verdict: Verdict, stated: bool) -> Mistake:
    """A mistake in a derivative by the terms of the one wrong equation of its coordinate that come from T*."""
    if (
        mistake.name == LEFT_OVER
        or mistake.step != STEP
        or mistake.coordinate is None
        or not _speaks_of_derivatives(mistake.what)
    ):
        return mistake
    if sum(m.coordinate in (mistake.coordinate, None) and m.step in (KINETIC, STEP) for m in verdict.mistakes) > 1:
        return mistake
    wrong = verdict.open_equations
    own = [f for f in wrong if f.coordinate == mistake.coordinate]
    said = _said(truth, own[0]) if len(own) == 1 else None
    if said is None:
        return mistake
    return with_reason(said, mistake) if stated else replace(mistake, what=said)


def _speaks_of_derivatives(what: Text) -> bool:
    """Whether words begin with a derivative of an energy, and not with a term of an equation."""
    first = what.parts[0] if what.parts else ""
    if isinstance(first, str) and first.lower().startswith(("the term ", "in the term ")):
        return False
    return any(isinstance(x.of if isinstance(x, Minus) else x, (Partial, Total)) for x in what.parts)


def _said(truth: Reference, finding: Finding) -> Text | None:
    """The terms of an equation from T* that differ, if one is or if all are wrong in the same way."""
    found = [d for d in finding.differences if {o.step for o in d.origins} <= {KINETIC}]
    kinds = {d.kind for d in found}
    if not found or len(found) > MOST_TOLD or len(kinds) > 1 or (len(found) > 1 and kinds == {"coefficient"}):
        return None
    if len(found) == 1:
        d = found[0]
        return term_replaced(d.written, 0 * d.term if d.kind == "extra" else d.term)[1]
    said = {"sign": " have the wrong sign.", "missing": " are missing.", "extra": " do not belong there."}[kinds.pop()]
    return text("The terms ", *_listed(found), said)


def _listed(found: Sequence[TermDifference]) -> Sequence[str | Left]:
    """The terms of several differences: a, b and c."""
    terms = [d.term if d.written == 0 else d.written for d in found]
    between = [", "] * (len(terms) - 2) + [" and "]
    return [x for pair in zip(terms, [*between, ""], strict=True) for x in pair][:-1]
