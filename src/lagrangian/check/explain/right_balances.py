"""Marks balances of bodies that are right beside a line that is none: a wrong constraint, or a derivative of one.

I ψ″ = τ − N s, J φ″ = H r − c φ′, φ″ = s ψ″/r: the balances hold along the right motion with the forces that they give
each other; what was solved from them holds for the wrong relation.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from lagrangian import bounded
from lagrangian.check.explain.constraint_slips import NAMES, wrong_constraints
from lagrangian.check.explain.solved_forces import Balances, hold, is_true, place_of
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Finding, Status, Verdict, inserted
from lagrangian.model import time
from lagrangian.page.formula import text

NOTE = text("right with the forces that the other lines give")


def with_right_balances(
    truth: Reference, balances: Balances, later: Sequence[AnsweredLine], verdict: Verdict
) -> Verdict | None:
    """The verdict on an answer of which a constraint is wrong, with its balances right, each of which the others check.

    ``later`` lines were solved from these. None if no constraint is wrong, or the balances do not hold.
    """
    every = range(len(balances.lines))
    names = {name for name, _ in NAMES}
    if not any(m.name in names for m in verdict.mistakes) or not balances.compared(every):
        return None
    if (u := balances.solved(every)) is None:
        return None
    values = truth.accelerations | dict(zip(balances.forces, u.T, strict=True))
    right = [*balances.lines, *(x for x in later if is_true(truth, x, values))]
    own = {place_of(x) for x in (*balances.lines, *later)}
    slips = [x for x in wrong_constraints(truth, verdict.findings) if place_of(x.finding.line) not in own]
    relations: list[AnsweredLine] = []
    for x in slips:
        expr = x.expr
        for _ in range(x.order, 2) if x.order >= 0 else ():
            expr = bounded.diff(expr, time)
        relations.append(replace(x.finding.line, expr=expr))
    below = [x for x in later if x not in right]
    holds = hold(truth, [*balances.lines, *relations], balances.forces, below)
    follow = [x for x, follows in zip(below, holds, strict=True) if follows]
    return replace(verdict, findings=marked(verdict.findings, right, None, follow)) if slips else None


def marked(
    findings: Sequence[Finding],
    right: Sequence[AnsweredLine],
    blamed: Finding | None,
    follow: Sequence[AnsweredLine],
) -> tuple[Finding, ...]:
    """The findings with one line blamed, others right, and what follows from it marked so."""
    said = {place_of(x): Finding(x, Status.WRONG, follows=True) for x in follow}
    held = {place_of(f.line) for f in findings if f.status is not Status.WRONG and f.line.kind != "definition"}
    said = {at: x for at, x in said.items() if at not in held}
    said |= {place_of(x): Finding(x, Status.RIGHT, NOTE) for x in right}
    said |= {} if blamed is None else {place_of(blamed.line): blamed}
    found = [f for f in findings if place_of(f.line) not in said]
    for new in sorted(said.values(), key=lambda f: f.line.number):
        found = inserted(found, new)
    return tuple(found)
