"""Mistakes in equations with multipliers: sought in what is written, or where the constraints hold."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TypeAlias

import sympy as sp

from lagrangian.check.constraints.multipliers import with_own_multipliers
from lagrangian.check.explain.constraint_mistakes import beside_constraints
from lagrangian.check.explain.constraint_slips import wrong_constraints
from lagrangian.check.explain.mistakes import NamedMistakes, mistakes
from lagrangian.check.held import held
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Finding, Status, Verdict

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
    wrong = wrong_constraints(truth, verdict.findings)
    aside = {x.key: x.follows for x in wrong}
    lines = [line for line in lines if (line.number, line.text) not in aside]
    read = with_own_multipliers(truth, lines)
    if read is None and not wrong:
        return verdict
    if read is None:
        found = tuple(replace(f, follows=aside.get((f.line.number, f.line.text), f.follows)) for f in verdict.findings)
        return replace(verdict, findings=found, mistakes=tuple(x.mistake for x in wrong if not x.follows))
    judged = judge(read.lines)
    named = _named(truth, read.lines, judged)
    told = (*named.told, *beside_constraints(truth, lines, wrong, judged, read.mistakes))
    if not told:
        return verdict
    better = {f.line.number: f for f in judged}
    better |= {k: replace(better[k], status=Status.WRONG, follows=False) for k in read.wrong}
    for x in wrong:
        better[x.finding.line.number] = replace(x.finding, follows=x.follows)
    findings = tuple(_without_forces(truth, better.get(f.line.number, f)) for f in verdict.findings)
    return replace(
        verdict, findings=findings, mistakes=told, alternatives=named.others, notes=read.notes, sure=named.sure
    )


def _without_forces(truth: Reference, finding: Finding) -> Finding:
    """A finding, without the terms that differ where a multiplier was eliminated: they are those of several rows."""
    forces = [m.symbol for m in truth.derivation.multipliers.values()]
    eliminated = finding.line.kind == "equation" and not finding.line.expr.has(*forces)
    return replace(finding, differences=()) if eliminated and _lacks(finding, forces) else finding


def _lacks(finding: Finding, forces: Sequence[sp.Expr]) -> bool:
    return any(d.kind == "missing" and d.term.has(*forces) for d in finding.differences)


def _named(truth: Reference, lines: Lines, findings: Findings) -> NamedMistakes:
    """The mistakes behind the wrong equations of a system with constraints.

    Where a constraint is put in, terms vanish, and what is missing then may seem more than what was left out. So one
    mistake that explains equations into which none was put goes first.
    """
    forces = [m.symbol for m in truth.derivation.multipliers.values()]
    wrong = [f.line for f in findings if f.status is Status.WRONG and f.line.kind == "equation"]
    if all(line.expr.has(*forces) for line in wrong):
        named = mistakes(truth, lines, findings)
        if len(named.told) == 1 and named.sure and not named.left:
            return named
    return mistakes(held(truth) or truth, lines, findings)
