"""What differs as a whole is told as a whole.

Of n = R/r, where n is (R − r)/r, no term does not belong there, and the term that is missing in it is written nowhere.
Of m g e sin nφ, where m g e n sin nφ belongs, no other two terms are missing that make the difference together.
"""

from __future__ import annotations

from dataclasses import replace

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.terms_alone import term_mistake
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import IS_MISSING, Finding, Mistake, Verdict


def told_as_a_whole(truth: Reference, verdict: Verdict) -> Verdict:
    """The verdict with both."""
    return _with_one_difference(truth, _with_values_of_names(truth, verdict))


def _with_one_difference(truth: Reference, verdict: Verdict) -> Verdict:
    """The verdict with the one term that stands where another one belongs, in place of mistakes one of which says that
    it is missing."""
    roots = verdict.open_findings
    if len(roots) != 1 or len(roots[0].differences) != 1 or not all(map(_misses_term, verdict.mistakes)):
        return verdict
    (difference,) = roots[0].differences
    if difference.written == 0 or not any(_stands(truth, m, difference.written) for m in verdict.mistakes):
        return verdict
    told, first = term_mistake(roots[0], difference), verdict.mistakes[0]
    told = told if difference.origins else replace(told, step=first.step, element=first.element)
    return replace(verdict, mistakes=(told,), alternatives=())


def _misses_term(mistake: Mistake) -> bool:
    """Whether a mistake says of a whole term that it is missing."""
    said = str(mistake.what)
    return said.startswith("The term ") and IS_MISSING in said


def _stands(truth: Reference, mistake: Mistake, written: sp.Expr) -> bool:
    """Whether the term that is said to be missing is what is written with the other sign."""
    term = next(x for x in mistake.what.parts if isinstance(x, sp.Expr))
    return bool(bounded.cancel(truth.expand(term) / truth.expand(written)).is_negative)


def _with_values_of_names(truth: Reference, verdict: Verdict) -> Verdict:
    """The verdict, in which what a line says that a name of the system is differs from it as a whole, unless a term of
    it is what differs."""
    values: dict[sp.Basic, sp.Expr] = {d.symbol: d.expression for d in truth.model.definitions}
    changed = {id(f): made for f in verdict.open_findings if (made := _of_name(values, f)) is not None}
    if not changed:
        return verdict
    numbers = {made.line.number for made in changed.values()}
    told = [term_mistake(made, made.differences[0]) for made in changed.values()]
    alone = all(m.name == "term_alone" for m in verdict.mistakes) and len(told) == len(numbers) == len(verdict.mistakes)
    findings = tuple(changed.get(id(f), f) for f in verdict.findings)
    return replace(verdict, findings=findings, mistakes=tuple(told) if alone else verdict.mistakes)


def _of_name(values: dict[sp.Basic, sp.Expr], finding: Finding) -> Finding | None:
    """A finding whose one difference is in no term that stands there, with the whole value as what differs."""
    sides = finding.line.sides
    if sides is None or sides[0] not in values or len(finding.differences) != 1:
        return None
    (difference,), stands = finding.differences, sp.Add.make_args(bounded.expand(sides[1]))
    if difference.term in stands or -difference.term in stands or difference.kind not in ("missing", "extra"):
        return None
    whole = replace(difference, kind="factor", term=-values[sides[0]], written=-sides[1])
    return replace(finding, differences=(whole,))
