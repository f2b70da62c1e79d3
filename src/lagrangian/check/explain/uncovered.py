"""The one term that no mistake speaks of: it is a mistake of its own.

V = −m g l cos θ + ½ k (e + a θ)²           the sign of the weight is wrong, and told
∂L/∂θ = −m g l sin θ − k (e + a θ)          that the factor a is lost belongs to no weight: it is told, too

J φ̈ = τ + F R − S r                         where S has a wrong sign, that b φ̇ is missing is told as well
"""

from __future__ import annotations

from dataclasses import replace

import sympy as sp

from lagrangian.check.explain.after_own_rates import slip_in_own_rate
from lagrangian.check.explain.quoted import LINE, letters_in
from lagrangian.check.explain.terms_alone import LEFT_OVER, MOST_TOLD, term_mistake
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.terms.sides import differs, on_side
from lagrangian.check.verdict import DERIVED, Finding, Mistake, Status, TermDifference, Verdict
from lagrangian.page.formula import text

KINDS = ("p", *DERIVED)
"""The lines that are compared term by term with what belongs there."""
MOST_COLUMN = 3
"""The most terms that are told in the rates of a column."""
BLAMES = "Line "
"""How words begin on a definition, of which more may follow than is found."""


def with_uncovered_terms(truth: Reference, verdict: Verdict) -> Verdict:
    """The verdict on a wrong answer, with the one or two terms of such lines of which no mistake speaks."""
    told = verdict.mistakes
    if verdict.status is not Status.WRONG or verdict.hint == 0 or not told:
        return verdict
    return _with_rates(truth, _with_absent(_with_terms_of_derivatives(verdict)))


def _with_terms_of_derivatives(verdict: Verdict) -> Verdict:
    told = verdict.mistakes
    if any(m.element is None for m in told):
        return verdict
    blamed = any(str(m.what).startswith(BLAMES) for m in told)
    if blamed or any(str(note).endswith(LEFT_OVER) for note in verdict.notes):
        return verdict
    found = [(f, d) for f in verdict.open_findings if f.line.kind in KINDS for d in f.differences]
    open_ones = [(f, d) for f, d in found if d.origins and not any(_speaks_of(m, f, d) for m in told)]
    if not 0 < len(open_ones) <= MOST_TOLD:
        return verdict
    return replace(verdict, mistakes=(*told, *(term_mistake(f, d) for f, d in open_ones)))


def _with_absent(verdict: Verdict) -> Verdict:
    """The verdict with the terms of elements of which no mistake speaks, and of which an equation has nothing at all:
    a term of one element alone, with a letter that the equation lacks."""
    told = verdict.mistakes
    if any(m.element is None for m in told):
        return verdict
    found: dict[str, tuple[Finding, TermDifference]] = {}
    right = {f.coordinate for f in verdict.findings if f.line.kind == "equation" and f.status.right}
    for f in verdict.open_findings:
        if f.line.kind != "equation" or f.coordinate in {None, *right}:
            continue  # or it is compared with what another line says
        for d in f.differences:
            own = {o.element for o in d.origins}
            if d.kind == "missing" and len(own) == 1 and not letters_in(d.term) <= letters_in(f.line.expr):
                found.setdefault(own.pop(), (f, d))
    absent = [(f, d) for f, d in found.values() if not any(_is_of(m, d) for m in told)]
    if not 0 < len(absent) <= MOST_TOLD:
        return verdict
    return replace(verdict, mistakes=(*told, *(term_mistake(f, d) for f, d in absent)))


def _with_rates(truth: Reference, verdict: Verdict) -> Verdict:
    """The verdict with the one term that is wrong in a rate of which no mistake speaks, ÿ = …, before what is told of
    the lines below it."""
    told = list(verdict.mistakes)
    numbers = [int(x["number"]) for m in told if (x := LINE.search(str(m.what))) is not None]
    for f in verdict.open_findings:
        if f.line.kind != "identity" or not numbers or any(f.line.number >= k for k in numbers):
            continue
        if len(numbers) == len(told) and (slip := slip_in_own_rate(truth, f.line)) is not None:
            told.insert(0, slip)
            break
    return _with_columns(truth, replace(verdict, mistakes=tuple(told)))


def _with_columns(truth: Reference, verdict: Verdict) -> Verdict:
    """The verdict with the terms that are wrong in the rates of a column, d/dt r = (…), in place of the square of the
    speed that follows from them."""
    first = verdict.mistakes[0]
    blamed = _of_line(verdict, first)
    if blamed is None or blamed.line.kind != "definition" or first.element is None:
        return verdict
    rates = [f for f in verdict.findings if f.line.kind == "identity" and f.line.name is None and f.line.sides]
    for number in dict.fromkeys(f.line.number for f in rates if f.is_open and f.line.number < blamed.line.number):
        column = [f for f in rates if f.line.number == number]
        wrong = [(f, d) for f in column for d in f.differences]
        square = sp.Add(*(f.line.sides[1] ** 2 for f in column if f.line.sides is not None))
        right = 0 < len(wrong) <= MOST_COLUMN and all(f.differences for f in column if f.is_open)
        if right and zero_everywhere(truth, truth.put(truth.expand(square - blamed.line.expr))):
            said = [x for f, d in wrong for x in (", and ", *differs(on_side(f.line, d)[1]))][1:]
            what = text(f"In {wrong[0][0].line.title}, ", *said, ".")
            told = replace(first, name="term_alone", what=what)
            findings = tuple(replace(f, follows=True) if f is blamed else f for f in verdict.findings)
            return replace(verdict, findings=findings, mistakes=(told, *verdict.mistakes[1:]))
    return verdict


def _of_line(verdict: Verdict, mistake: Mistake) -> Finding | None:
    """The wrong line that the words of a mistake name first."""
    named = LINE.match(str(mistake.what))
    number = int(named["number"]) if named is not None else 0
    return next((f for f in verdict.open_findings if f.line.number == number), None)


def _speaks_of(mistake: Mistake, finding: Finding, difference: TermDifference) -> bool:
    """Whether a mistake is in an element from which a term comes, or names the line in which it stands."""
    here = finding.line.number is not None and f"ine {finding.line.number}" in str(mistake.what)
    return here or _is_of(mistake, difference)


def _is_of(mistake: Mistake, difference: TermDifference) -> bool:
    """Whether a mistake is in an element from which a term comes."""
    said = str(mistake.what)
    return any(o.element in said or o.element in (mistake.element or "") for o in difference.origins)
