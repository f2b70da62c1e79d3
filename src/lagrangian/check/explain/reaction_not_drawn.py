"""Finds the reaction that the balance of a body lacks: its force stands in the balance of the other body alone.

m (ẍ + s̈) = H − b ẋ      the force H between the two, at one of them
M ẍ = −k x               and at the other one it was not drawn: −H is missing
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import cast

import numpy as np
import sympy as sp

from lagrangian.check.explain.balance_terms import arms
from lagrangian.check.explain.combined_rows import WrongTerm, difference
from lagrangian.check.explain.free_bodies import free_bodies
from lagrangian.check.explain.meant import owner_of
from lagrangian.check.explain.right_balances import marked
from lagrangian.check.explain.solved_forces import balances_of, hold, place_of
from lagrangian.check.held import held
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake, Status, Verdict
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.page.formula import text

NAME = "balance_of_a_body"
"""The name of a mistake that is somewhere in the balance of one body."""
WHY = text(
    "Draw a free-body diagram of this body alone: its own mass times its acceleration, and every force on it, also "
    "those with which the other bodies act."
)
MOST_TOLD = 2
"""With no more terms, a balance is told by these."""
MOST_TIMES = 4
"""How often a force may act on the body that lacks it: once by each of so many equal bodies."""
NEAR = 1e-8
"""The relative size of what is rounding."""


def with_reaction(truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict) -> tuple[Verdict, Finding] | None:
    """The verdict, and its finding, on balances of bodies of which the first wrong line has no force of the answer's
    own, and would be right with one that others have; None if there is none, or if it may be another force.

    Such a line is no equation of motion as a whole: it has the accelerations of some bodies alone.
    """
    on = held(truth) if truth.derivation.multipliers else truth
    roots = verdict.open_equations
    line = next((x for x in lines if roots and place_of(x) == place_of(roots[0].line)), None)
    if on is None or line is None or line.kind != "equation" or not free_bodies(truth).is_of_some(line.expr):
        return None
    balances = balances_of(on, lines, few=True)
    if balances is None or line.expr.has(*balances.forces):
        return None
    every = range(len(balances.lines))
    u = balances.solved(every)
    if u is None or balances.rank(every) < len(balances.forces):
        return None
    values = on.accelerations | dict(zip(balances.forces, u.T, strict=True))
    if (term := _missing(on, line.expr, values, balances.forces)) is None:
        return None
    blamed = Finding(line, Status.WRONG, differences=(difference(on, WrongTerm(term, sp.oo), None),))
    wrong = {place_of(f.line) for f in verdict.findings if f.status is Status.WRONG}
    below = [x for x in lines if x.kind == "equation" and x is not line and place_of(x) in wrong]
    rest = [x for x in lines if x.kind == "equation" and place_of(x) not in wrong]
    holds = hold(on, [line, *rest], balances.forces, below)
    follow = [x for x, follows in zip(below, holds, strict=True) if follows]
    return replace(verdict, findings=marked(verdict.findings, (), [blamed], follow)), blamed


def as_balances_of_bodies(truth: Reference, verdict: Verdict) -> Verdict:
    """The verdict on balances that nothing explains, without the terms in which one that words call that of a body, and
    that has the accelerations of this body alone, differs from the equation of all."""
    if verdict.mistakes or verdict.status is not Status.WRONG or verdict.hint == 0:
        return verdict
    if any(f.line.kind in ("T", "V", "L") for f in verdict.findings):
        return verdict
    findings, told = list(verdict.findings), list[Mistake]()
    for k, f in enumerate(findings):
        body = owner_of(f"{f.line.words} ", truth.model) if f.line.words and f.is_open else None
        balance = f.line.kind == "equation" and len(f.differences) > MOST_TOLD
        if body is None or not balance or not free_bodies(truth).is_of_some(f.line.expr):
            continue
        findings[k] = replace(f, differences=(), coordinate=None, elements=())
        what = text(f"{f.line.opening}, the balance of {body.title}, does not hold.")
        told.append(Mistake(NAME, what, WHY, 5, body.title, None, what))
    return replace(verdict, findings=tuple(findings), mistakes=tuple(told), sure=True) if told else verdict


def _missing(
    truth: Reference, expr: sp.Expr, values: Mapping[sp.Basic, Array], forces: Sequence[sp.Basic]
) -> sp.Expr | None:
    """The force, with its arm and how often it acts, without which alone a line does not hold; None if there is none,
    or if several are as plain."""
    levers = list(arms(truth, expr))
    wrong, *of = CompiledExpressions([expr, *cast("Sequence[sp.Expr]", forces)]).at(truth.states, values)
    factors = CompiledExpressions([x for _, x in levers]).at(truth.states)
    if not np.isfinite(wrong).all() or not np.abs(wrong).max():
        return None
    found: list[tuple[float, sp.Expr]] = []
    for force, acting in zip(forces, of, strict=True):
        for (cost, arm), factor in zip(levers, factors, strict=True):
            product = acting * factor
            times = float((wrong * product).sum() / max(float((product * product).sum()), 1e-300))
            count = round(times)
            near = np.abs(wrong - count * product).max() <= NEAR * np.abs(wrong).max()
            if 0 < abs(count) <= MOST_TIMES and near:
                found.append((cost, cast("sp.Expr", -count * cast("sp.Expr", force) * arm)))
    found.sort(key=lambda x: x[0])
    return found[0][1] if found and (len(found) == 1 or found[1][0] > found[0][0]) else None
