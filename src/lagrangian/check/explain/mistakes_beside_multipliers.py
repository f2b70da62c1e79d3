"""Mistakes in equations with multipliers: sought in what is written, or where the constraints hold."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TypeAlias

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.constraints.exchanged_factors import with_exchanged
from lagrangian.check.constraints.multipliers import with_own_multipliers
from lagrangian.check.explain.below_wrong_constraints import where_held, with_consequences, with_reduced
from lagrangian.check.explain.consequences import SMALL
from lagrangian.check.explain.constraint_mistakes import beside_constraints, taken_as_fits
from lagrangian.check.explain.constraint_slips import WrongConstraint, wrong_constraints
from lagrangian.check.explain.definitions import with_wrong_definitions
from lagrangian.check.explain.mistakes import NamedMistakes, mistakes
from lagrangian.check.explain.put_in_terms import with_terms_put_in
from lagrangian.check.held import OnConstraints, held
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Finding, Status, Verdict, inserted, keys_of
from lagrangian.derive.sampling import Array, CompiledExpressions

Lines: TypeAlias = Sequence[AnsweredLine]
Findings: TypeAlias = Sequence[Finding]


def named_beside_multipliers(
    truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict, judge: Callable[[Lines], Findings]
) -> Verdict:
    """The verdict on a wrong answer with multipliers, with the mistakes that its equations, taken one by one, show.

    ``judge`` judges lines one by one.
    """
    if verdict.status is not Status.WRONG:
        return verdict
    verdict = replace(verdict, findings=_with_left_sides(lines, verdict.findings))
    wrong = wrong_constraints(truth, verdict.findings)
    keys = keys_of([f.line for f in verdict.findings])
    aside = {k: x for k, f in zip(keys, verdict.findings, strict=True) for x in wrong if x.finding is f}
    kept = [(k, x) for k, x in zip(keys_of(lines), lines, strict=True) if k not in aside]
    again = _repeated([x for _, x in kept])
    again = {kept[j][0]: kept[k][0] for j, k in again.items()}
    kept = [x for x in kept if x[0] not in again]
    lines = [x for _, x in kept]
    read = with_own_multipliers(truth, lines, clashes=not wrong)
    if read is None and not wrong:
        return verdict
    if read is None:
        found = tuple(
            replace(f, follows=aside[k].follows if k in aside else f.follows)
            for k, f in zip(keys, verdict.findings, strict=True)
        )
        return replace(verdict, findings=found, mistakes=tuple(x.mistake for x in wrong if not x.follows))
    read = with_exchanged(truth, read, lines)
    own = where_held(truth, wrong)
    judged = _below(truth, own, wrong, with_terms_put_in(truth, judge(read.lines)))
    true = [f.line for f in verdict.findings if f.status.right]
    named = _named(truth, read.lines, judged, true) if own is None else mistakes(own, read.lines, judged, true)
    of_constraints = beside_constraints(truth, lines, wrong, judged, read.mistakes)
    above = own is not None or _are_above(wrong, [lines[j].number for j in read.wrong], judged)
    told = (*of_constraints, *named.told) if above else (*named.told, *of_constraints)
    if not told:
        return verdict
    origin = {k: kept[j][0] for k, j in zip(keys_of(read.lines), read.sources, strict=True)}
    better = {origin[k]: f for k, f in zip(keys_of([f.line for f in judged]), judged, strict=True)}
    follow = bool(wrong) and not any(x is y for x in read.mistakes for y in told)  # a wrong constraint explains them
    odd = taken_as_fits(truth, read) if follow and read.mistakes else ()
    amiss = {kept[j][0] for j in {*read.wrong, *odd}}
    better |= {
        k: replace(better[k], status=Status.WRONG, note=None, follows=follow and wrong[0].finding.line.number < k[0])
        for k in amiss
    }
    at = [kept[j][0] for j in read.clashing]
    better |= {k: _clashing(better[k], better[other]) for k, other in zip(at, at[::-1], strict=True)}
    better |= {k: replace(x.finding, follows=x.follows) for k, x in aside.items()}
    forces = [*(m.symbol for m in truth.derivation.multipliers.values()), *read.own]
    for k, f in zip(keys, verdict.findings, strict=True):
        if f.line.kind == "equation" and f.status.right and not f.line.expr.has(*forces):
            better[k] = f  # true without any multiplier, however these are read
    found = {k: _without_forces(truth, better.get(k, f)) for k, f in zip(keys, verdict.findings, strict=True)}
    findings = tuple(_as_above(f, found[again[k]] if again.get(k) in found else None) for k, f in found.items())
    findings = with_wrong_definitions(findings, named.blamed)
    notes = () if odd else read.notes
    return replace(verdict, findings=findings, mistakes=told, alternatives=named.others, notes=notes, sure=named.sure)


def _below(truth: Reference, own: OnConstraints | None, wrong: Sequence[WrongConstraint], judged: Findings) -> Findings:
    """The findings, of which those follow that are right with the answer's own constraints."""
    judged = judged if own is None else with_consequences(truth, own, wrong[0].finding.line.number, judged)
    judged = with_reduced(truth, wrong, judged)
    return _below_constraints(truth, judged, [x.finding.line for x in wrong if x.order == SECOND])


def _with_left_sides(lines: Lines, findings: Findings) -> tuple[Finding, ...]:
    """The findings with the definitions f = … that are the left side of a wrong equation f = 0 of positions below."""
    found = list(findings)
    judged = [f.line for f in findings if f.line.kind == "equation" and f.status is Status.WRONG]
    roots = [bounded.expand(x.expr) for x in judged if not x.expr.has(sp.Derivative)]
    said = {(x.number, x.text) for x in judged}  # f = … = 0 is one statement
    for line in lines if roots else ():
        if (
            line.kind == "definition"
            and (line.number, line.text) not in said
            and bounded.expand(line.expr) in {*roots, *(-x for x in roots)}
        ):
            found = inserted(found, Finding(line, Status.WRONG))
    return tuple(found)


def _are_above(wrong: Sequence[WrongConstraint], slipped: Sequence[int], findings: Findings) -> bool:
    """Whether what is wrong with constraints, or else the multipliers that ``slipped``, stands above all else that is
    wrong."""
    others = [f.line.number for f in findings if f.is_open]
    first = min((x.finding.line.number for x in wrong if not x.follows), default=None)
    if first is not None:
        return first <= min(others, default=first)
    return not wrong and min(slipped, default=0) < min(others, default=0)


def _clashing(finding: Finding, other: Finding) -> Finding:
    """The finding of a line that does not fit another one, which may stand in the same line, as of matrices."""
    title = other.line.title if other.line.title != finding.line.title else f"the equation of {other.coordinate}"
    return replace(finding, clash=title)


SECOND = 2
"""How often a constraint is differentiated where it holds accelerations."""


def _below_constraints(truth: Reference, findings: Findings, wrong: Lines) -> Findings:
    """The findings, in which equations follow that are one above them with what wrong lines ask of the accelerations:
    λ = m g + 2 m a x ẍ, below m ÿ + m g = λ and ÿ = 2 a x ẍ."""
    rows = [f for f in findings if f.line.kind == "equation"]
    if not wrong or all(f.status is not Status.WRONG or f.follows for f in rows):
        return findings
    by = [
        *(c.acceleration for c in truth.model.coordinates),
        *(m.symbol for m in truth.derivation.multipliers.values()),
    ]
    exprs = [*(f.line.expr for f in rows), *(line.expr for line in wrong)]
    truth = held(truth) or truth  # places may be put in
    compiled = CompiledExpressions(exprs)
    slopes = compiled.slopes(by).at(truth.states).reshape(len(exprs), len(by), truth.states.size)
    values = compiled.at(truth.states, {x: np.zeros(truth.states.size) for x in by})
    told = np.moveaxis(np.concatenate([slopes, values[:, None]], axis=1), -1, 0)
    if not np.isfinite(told).all():
        return findings
    roots = {k: line.number for k, line in enumerate(wrong, len(rows))}
    above, found = list[int](), dict[int, Finding]()
    for j, f in enumerate(rows):
        if f.is_open:
            before = [
                k
                for k, number in roots.items()
                if number < f.line.number or (k >= len(rows) and number == f.line.number)
            ]
            if not any(_in_span(told[:, j], told[:, [k, i]]) for k in before for i in above if i != k):
                continue
            found[id(f)], roots[j] = replace(f, follows=True), f.line.number
        above.append(j)
    return [found.get(id(f), f) for f in findings]


def _in_span(row: Array, rows: Array) -> bool:
    """Whether a row (S, k) is a combination of others (S, r, k) at every state."""
    factors = np.einsum("sk,skr->sr", row, np.linalg.pinv(rows, rcond=1e-10))
    left = np.abs(row - np.einsum("sr,srk->sk", factors, rows)).max(axis=1)
    return bool((left <= SMALL * np.abs(row).max(axis=1)).all())


def _repeated(lines: Lines) -> dict[int, int]:
    """The places of the equations that stand above once more, with the place of the first."""
    first: dict[sp.Expr, int] = {}
    found: dict[int, int] = {}
    for j, line in enumerate(lines):
        if line.kind == "equation":
            expr = bounded.expand(line.expr)
            same = first.setdefault(-expr if expr.could_extract_minus_sign() else expr, j)
            if same != j:
                found[j] = same
    return found


def _as_above(finding: Finding, first: Finding | None) -> Finding:
    """The finding of an equation that stands above once more."""
    if first is None:
        return finding
    return replace(first, line=finding.line, follows=first.status is Status.WRONG, differences=())


def _without_forces(truth: Reference, finding: Finding) -> Finding:
    """A finding, without the terms that differ where a multiplier was eliminated: they are those of several rows."""
    forces = [m.symbol for m in truth.derivation.multipliers.values()]
    eliminated = finding.line.kind == "equation" and not finding.line.expr.has(*forces)
    return replace(finding, differences=()) if eliminated and _lacks(finding, forces) else finding


def _lacks(finding: Finding, forces: Sequence[sp.Expr]) -> bool:
    return any(d.kind == "missing" and d.term.has(*forces) for d in finding.differences)


def _named(truth: Reference, lines: Lines, findings: Findings, right: Lines) -> NamedMistakes:
    """The mistakes behind the wrong equations of a system with constraints.

    Where a constraint is put in, terms vanish, and what is missing then may seem more than what was left out. So one
    mistake that explains equations into which none was put goes first.
    """
    forces = [m.symbol for m in truth.derivation.multipliers.values()]
    wrong = [f.line for f in findings if f.status is Status.WRONG and f.line.kind == "equation"]
    if all(line.expr.has(*forces) for line in wrong):
        named = mistakes(truth, lines, findings, right)
        if len(named.told) == 1 and named.sure and not named.left:
            return named
    return mistakes(held(truth) or truth, lines, findings, right)
