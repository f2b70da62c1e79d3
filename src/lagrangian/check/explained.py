"""The verdict on a wrong answer with the mistakes that explain it, and what is told of a long system."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from lagrangian.check.coordinates.tried import new_names
from lagrangian.check.explain.advice import without_lagrange
from lagrangian.check.explain.candidates import too_long
from lagrangian.check.explain.combinations_meant import MeantCombination, as_combinations
from lagrangian.check.explain.definitions import with_wrong_definitions
from lagrangian.check.explain.divided_by_a_part import divided_by_a_part
from lagrangian.check.explain.mistakes import NamedMistakes, mistakes
from lagrangian.check.explain.numerators import without_other_terms
from lagrangian.check.explain.reasoned import with_bodies
from lagrangian.check.explain.terms_alone import LEFT_OVER
from lagrangian.check.judged import Judged
from lagrangian.check.names.spelling import Spelling, not_there
from lagrangian.check.reading import is_placeholder
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import Status, Verdict
from lagrangian.page.formula import Text, text

OF_ANOTHER_EQUATION = ("force_wrong_equation", "input_everywhere", "counted_without_work")
"""Mistakes that a force between two bodies seems to be in the balance of one: it does no work in a Ξ."""


def explained(truth: Reference, spelling: Spelling, judged: Judged, verdict: Verdict) -> Verdict:
    """The verdict, with the mistakes that explain the answer, unless its hint level tells none."""
    notes = (
        *verdict.notes,
        *(not_there(truth.model, x) for x in new_names(truth, spelling.lines) if not is_placeholder(x)),
    )
    if verdict.hint == 0:
        return replace(verdict, notes=notes)
    named = mistakes(truth, spelling.lines, judged.findings)
    open_ones = verdict.open_equations if not named.told or named.left or not named.sure else []
    unexplained = open_ones if not named.sure else [f for f in open_ones if any(f.line is x for x in named.left)]
    elsewhere = any(m.name in OF_ANOTHER_EQUATION for m in named.told)
    several = len(named.told) > 1 and elsewhere and without_lagrange(spelling.lines)
    compared = verdict.open_equations if several else unexplained or open_ones
    findings, meant = as_combinations(truth, verdict.findings, compared, half=several)
    if meant:
        return _with_combinations(truth, spelling, replace(verdict, findings=findings), meant, notes)
    if named.blamed is None and (part := divided_by_a_part(truth, verdict.findings)) is not None:
        found = [replace(f, differences=()) if f.status is Status.WRONG else f for f in verdict.findings]
        return replace(verdict, findings=tuple(found), mistakes=(part,), alternatives=(), notes=notes, sure=True)
    if too_long(truth) or not truth.tried_all:
        every = "" if too_long(truth) else "all "
        said = f"The system is too long for {every}well-known mistakes to be tried; its terms are compared."
        notes = (*notes, text(said))
    if named.told and named.left:
        lines = [x for line in named.left for x in (line.title, ", ")][:-1]
        notes = (*notes, text(*lines, LEFT_OVER[0] if len(named.left) == 1 else LEFT_OVER[1]))
    findings = with_wrong_definitions(without_other_terms(verdict.findings, named.told), named.blamed)
    told = with_bodies(truth, findings, named.told)
    told = replace(verdict, findings=findings, mistakes=told, alternatives=named.others)
    return replace(told, notes=notes, sure=named.sure)


def _with_combinations(
    truth: Reference,
    spelling: Spelling,
    verdict: Verdict,
    meant: Sequence[MeantCombination],
    notes: tuple[Text, ...],
) -> Verdict:
    """The verdict with the terms of equations that are meant as sums of two, and the mistakes of the other lines."""
    own = [x.finding for x in meant]
    lines = [x for x in spelling.lines if not any(x is f.line for f in own)]
    others = [f for f in verdict.findings if not any(f is x for x in own)]
    wrong = any(f.is_open for f in others)
    named = mistakes(truth, lines, others) if wrong else NamedMistakes()
    told = with_bodies(truth, others, named.told)
    first = min(f.line.number for f in own)
    above = any(f.line.number < first for f in others if f.is_open)
    terms = tuple(m for x in meant for m in x.mistakes)
    listed = (*told, *terms) if above else (*terms, *told)
    return replace(verdict, mistakes=listed, notes=notes, sure=named.sure)
