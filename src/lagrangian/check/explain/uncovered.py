"""The one term of a derivative that no mistake speaks of: it is a mistake of its own.

V = −m g l cos θ + ½ k (e + a θ)²           the sign of the weight is wrong, and told
∂L/∂θ = −m g l sin θ − k (e + a θ)          that the factor a is lost belongs to no weight: it is told, too
"""

from __future__ import annotations

from dataclasses import replace

from lagrangian.check.explain.terms_alone import LEFT_OVER, MOST_TOLD, term_mistake
from lagrangian.check.readings_compared import open_findings
from lagrangian.check.verdict import DERIVED, Finding, Mistake, Status, TermDifference, Verdict

KINDS = ("p", *DERIVED)
"""The lines that are compared term by term with what belongs there."""
BLAMES = "Line "
"""How words begin on a definition, of which more may follow than is found."""


def with_uncovered_terms(verdict: Verdict) -> Verdict:
    """The verdict on a wrong answer, with the one or two terms of such lines of which no mistake speaks."""
    told = verdict.mistakes
    if verdict.status is not Status.WRONG or verdict.hint == 0 or not told or any(m.element is None for m in told):
        return verdict
    blamed = any(str(m.what).startswith(BLAMES) for m in told)
    if blamed or any(str(note).endswith(LEFT_OVER) for note in verdict.notes):
        return verdict
    found = [(f, d) for f in open_findings(verdict) if f.line.kind in KINDS for d in f.differences]
    open_ones = [(f, d) for f, d in found if d.origins and not any(_speaks_of(m, f, d) for m in told)]
    if not 0 < len(open_ones) <= MOST_TOLD:
        return verdict
    return replace(verdict, mistakes=(*told, *(term_mistake(f, d) for f, d in open_ones)))


def _speaks_of(mistake: Mistake, finding: Finding, difference: TermDifference) -> bool:
    """Whether a mistake is in an element from which a term comes, or names the line in which it stands."""
    said = str(mistake.what)
    names = {o.element for o in difference.origins}
    here = finding.line.number is not None and f"ine {finding.line.number}" in said
    return here or any(x in said or x in (mistake.element or "") for x in names)
