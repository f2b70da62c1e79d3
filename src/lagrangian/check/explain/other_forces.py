"""Explains an answer by Newton's laws with more forces than constraints: those between its bodies are eliminated first.

m₁ ẍ = F − N and m₃ ẍ = N − S d/l beside the force S of a rod: N is no force of a constraint of the system, and what the
two lines say together is compared with its equations.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import combinations, islice

import sympy as sp

from lagrangian.check.constraints.constrained import expanded, unknown_names
from lagrangian.check.constraints.eliminated import without_forces
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Status, Verdict
from lagrangian.records import dataclass

MOST = 6
"""The largest number of choices of forces that stay."""


@dataclass(frozen=True, eq=False)
class WithoutOthers:
    """The lines without the forces between bodies, and the verdict on them."""

    lines: tuple[AnsweredLine, ...]
    verdict: Verdict


def without_other_forces(
    truth: Reference,
    lines: Sequence[AnsweredLine],
    verdict: Verdict,
    judge: Callable[[Sequence[AnsweredLine]], Verdict],
) -> WithoutOthers:
    """The wrong answer without all but as many unknown forces as the system has multipliers, those of which most lines
    are right; as it is if there are not more.

    Of several such choices, that counts whose forces stand in the equations of all coordinates of the constraints.
    """
    found, fits = WithoutOthers(tuple(lines), verdict), -1
    equations = [line for line in lines if line.kind == "equation"]
    unknown = unknown_names(expanded(truth), equations) if verdict.status is Status.WRONG else []
    own = {m.symbol for m in truth.derivation.multipliers.values()}
    if len(unknown) <= len(own):
        return found
    for kept in islice(combinations(unknown, len(own)), MOST):
        read = without_forces(truth, lines, {*kept, *own})
        other = judge(read.lines) if read is not None else None
        if read is None or other is None or other.status is not Status.WRONG:
            continue
        standing = sum(_may_be_of_constraint(truth, equations, x) for x in kept)
        if (other.right_lines, standing) < (found.verdict.right_lines, fits):
            continue
        fits = standing
        found = WithoutOthers(read.lines, replace(other, notes=(*other.notes, read.note)))
    return found


def _may_be_of_constraint(truth: Reference, equations: Sequence[AnsweredLine], force: sp.Basic) -> bool:
    """Whether a force stands in equations of as many coordinates as a multiplier of the system does."""
    moving = [c.acceleration for c in truth.model.coordinates]
    mine = [x for x in moving if any(line.expr.has(force) and line.expr.has(x) for line in equations)]
    held = [sum(row.has(m.symbol) for row in truth.rows) for m in truth.derivation.multipliers.values()]
    return len(mine) >= min(held, default=0)
