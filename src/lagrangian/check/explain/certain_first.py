"""What is certain of a wrong line before what may be the reason for it.

½ m (ẋ² + e² φ̇²) + ½ (J − m e²) φ̇²      the term −½ m e² φ̇² does not belong there; no ½ m e² φ̇² is missing
M12 = (J/ρ² + m) r²/4                    ¼ m r² has the wrong sign; that a velocity has it is a possible reason
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.second_choices import MADE_IN
from lagrangian.check.explain.term_said import REASON, with_reason
from lagrangian.check.explain.terms_alone import MOST_TOLD, term_mistake
from lagrangian.check.verdict import IS_MISSING, Finding, Mistake, Status, TermDifference, Verdict

ENERGIES = ("T", "V", "L")
"""The kinds of lines that are energies."""
OF_ENERGY = 3
"""The step of weights and springs."""
MOST = 200
"""The most terms of a line, as they are written, that are compared."""


def with_certain_terms(verdict: Verdict) -> Verdict:
    """The verdict, in which a term that another one cancels is too much, and in which the one term that is wrong in an
    answer without energies stands before the motion that may be the reason."""
    return _with_one_term(_with_cancelled(_without_turned_rows(verdict)))


def _without_turned_rows(verdict: Verdict) -> Verdict:
    """The verdict without the terms of an equation that was compared with its negative, or with a multiple: ẍ, for
    which it is solved, is not what has the wrong sign, and not all but one term count half."""
    findings = tuple(replace(f, differences=()) if _is_turned(f) else f for f in verdict.findings)
    return replace(verdict, findings=findings) if verdict.mistakes and findings != verdict.findings else verdict


def _is_turned(finding: Finding) -> bool:
    solved = finding.line.sides[0] if finding.line.sides is not None else None
    if len(finding.differences) < 2 or finding.line.kind != "equation":
        return False
    ratios = {bounded.cancel(d.written / d.term) for d in finding.differences if d.term != 0}
    if len(finding.differences) > 2 and len(ratios) == 1 and all(r.is_number and r not in (0, 1) for r in ratios):
        return any(x.derivative_count > 1 for d in finding.differences for x in d.term.atoms(sp.Derivative))
    return isinstance(solved, sp.Derivative) and any(
        d.kind == "sign" and d.written in (solved, -solved) for d in finding.differences
    )


def _with_cancelled(verdict: Verdict) -> Verdict:
    """The verdict, in which no term is missing that is written, and taken away by another one of the line."""
    found: list[Finding] = []
    changed: list[tuple[Finding, TermDifference, TermDifference]] = []
    for f in verdict.findings:
        told = [_as_too_much(f, d) for d in f.differences] if f.line.kind in ENERGIES else list(f.differences)
        found.append(replace(f, differences=tuple(told)) if told != list(f.differences) else f)
        changed += [(found[-1], old, new) for old, new in zip(f.differences, told, strict=True) if old is not new]
    if not changed:
        return verdict
    mistakes = tuple(_too_much(m, changed) for m in verdict.mistakes)
    return replace(verdict, findings=tuple(found), mistakes=mistakes)


def _as_too_much(finding: Finding, difference: TermDifference) -> TermDifference:
    """A missing term as the one that takes it away, if the line has both."""
    if difference.kind != "missing" or finding.status is not Status.WRONG or finding.follows:
        return difference
    terms = set(_terms(finding))
    if {difference.term, -difference.term} <= terms:
        return replace(difference, kind="extra", term=-difference.term, written=-difference.term)
    return difference


def _terms(finding: Finding) -> Iterator[sp.Expr]:
    """The terms of a line as they are written, multiplied out one by one."""
    products = [product for ways in finding.line.summands for product in ways]
    for product in products[:MOST]:
        yield from sp.Add.make_args(bounded.expand(sp.Mul(*product)))  # type: ignore[misc]


def _too_much(mistake: Mistake, changed: list[tuple[Finding, TermDifference, TermDifference]]) -> Mistake:
    """A mistake that a term is missing, told as the one that takes it away."""
    if IS_MISSING not in str(mistake.what):
        return mistake
    formulas = [x for x in mistake.what.parts if isinstance(x, sp.Expr)]
    for finding, old, new in changed:
        if formulas and bounded.expand(formulas[0] - old.term) == 0:
            return replace(term_mistake(finding, new), element=mistake.element)
    return mistake


def _with_one_term(verdict: Verdict) -> Verdict:
    """The verdict with the one term that is wrong first, or with two of different elements, where a velocity, height or
    position of which nothing is written is all that is told."""
    if len(verdict.mistakes) != 1 or any(f.line.kind in ENERGIES for f in verdict.findings):
        return verdict
    (mistake,) = verdict.mistakes
    made = MADE_IN.match(str(mistake.what))
    if made is None or REASON in str(mistake.what):
        return verdict
    roots = [f for f in verdict.open_findings if f.differences or not f.clash]
    terms = {(f.line.number, d.kind, d.term, d.written): (f, d) for f in roots for d in f.differences}
    if not all(f.differences for f in roots) or not 0 < len(terms) <= MOST_TOLD:
        return verdict
    told = [term_mistake(f, d) for f, d in terms.values()]
    if len(told) > 1:
        return replace(verdict, mistakes=tuple(told)) if _are_of_others([d for _, d in terms.values()]) else verdict
    [(_, difference)] = terms.values()
    if made["what"] == "position" and {o.step for o in difference.origins} == {OF_ENERGY}:
        return replace(verdict, mistakes=tuple(told))  # what it adds to the inertia is right
    return replace(verdict, mistakes=(with_reason(told[0].what, mistake),))


def _are_of_others(differences: Sequence[TermDifference]) -> bool:
    """Whether no two terms have an origin in common: one motion is not the reason for all of them."""
    own = [{o.element for o in d.origins} for d in differences]
    return all(own) and sum(map(len, own)) == len(set[str]().union(*own))
