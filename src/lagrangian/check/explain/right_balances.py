"""Marks balances of bodies that are right beside a line that is none: a wrong constraint, or a result without forces.

I ψ″ = τ − N s, J φ″ = H r − c φ′, φ″ = s ψ″/r: the balances hold along the right motion with the forces that they give
each other; what was solved from them holds for the wrong relation.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TypeAlias

from lagrangian import bounded
from lagrangian.check.explain.constraint_slips import NAMES, WrongConstraint, wrong_constraints
from lagrangian.check.explain.solved_forces import Balances, hold, is_true, place_of
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Finding, Status, Verdict, inserted
from lagrangian.model import time
from lagrangian.page.formula import text
from lagrangian.read.letters import key

Judge: TypeAlias = Callable[[Sequence[AnsweredLine]], Verdict]
"""The verdict on some lines of an answer."""

NOTE = text("right with the forces that the other lines give")


def with_right_balances(
    truth: Reference,
    balances: Balances,
    lines: Sequence[AnsweredLine],
    later: Sequence[AnsweredLine],
    verdict: Verdict,
    judge: Judge | None,
) -> Verdict | None:
    """The verdict on an answer of which a constraint or a result without forces is wrong, with its balances right, each
    of which the others check; what went wrong is sought in its other ``lines`` alone.

    ``later`` lines were solved from the balances. None if no other line is wrong, or the balances do not hold.
    """
    every = range(len(balances.lines))
    u = balances.solved(every) if balances.compared(every) else None
    if u is None:
        return None
    values = truth.accelerations | dict(zip(balances.forces, u.T, strict=True))
    right = [*balances.lines, *(x for x in later if is_true(truth, x, values))]
    own = {place_of(x) for x in (*balances.lines, *later)}
    roots = [f for f in verdict.open_findings if place_of(f.line) not in own]
    if not roots:
        return None
    slips = [x for x in wrong_constraints(truth, verdict.findings) if place_of(x.finding.line) not in own]
    below = [x for x in later if x not in right]
    holds = hold(truth, [*balances.lines, *map(_of_accelerations, slips)], balances.forces, below)
    follow = [x for x, follows in zip(below, holds, strict=True) if follows]
    changed = replace(verdict, findings=marked(verdict.findings, right, (), follow))
    names = {name for name, _ in NAMES}
    blamed = any(f.status is Status.WRONG and place_of(f.line) in own for f in verdict.findings)
    explained = bool(verdict.mistakes) and not blamed  # no balance was called wrong
    if explained or any(m.name in names for m in verdict.mistakes) or judge is None:
        return changed if verdict.mistakes else None
    forces = {key(str(x)) for x in balances.forces}
    rest = [x for x in lines if place_of(x) not in own and not (x.kind == "definition" and key(str(x.name)) in forces)]
    again = judge(rest)
    if again.status is not Status.WRONG:
        return None
    known = {place_of(f.line): f for f in again.findings}
    findings = tuple(known.get(place_of(f.line), f) if f.status is Status.WRONG else f for f in changed.findings)
    return replace(
        changed, findings=findings, mistakes=again.mistakes, alternatives=again.alternatives, sure=again.sure
    )


def _of_accelerations(wrong: WrongConstraint) -> AnsweredLine:
    """A wrong constraint, differentiated until it has accelerations."""
    expr = wrong.expr
    for _ in range(wrong.order, 2) if wrong.order >= 0 else ():
        expr = bounded.diff(expr, time)
    return replace(wrong.finding.line, expr=expr)


def marked(
    findings: Sequence[Finding],
    right: Sequence[AnsweredLine],
    blamed: Sequence[Finding],
    follow: Sequence[AnsweredLine],
) -> tuple[Finding, ...]:
    """The findings with some lines blamed, others right, and what follows from it marked so."""
    said = {place_of(x): Finding(x, Status.WRONG, follows=True) for x in follow}
    held = {place_of(f.line) for f in findings if f.status is not Status.WRONG and f.line.kind != "definition"}
    said = {at: x for at, x in said.items() if at not in held}
    said |= {place_of(x): Finding(x, Status.RIGHT, NOTE) for x in right}
    said |= {place_of(x.line): x for x in blamed}
    found = [f for f in findings if place_of(f.line) not in said]
    for new in sorted(said.values(), key=lambda f: f.line.number):
        found = inserted(found, new)
    return tuple(found)
