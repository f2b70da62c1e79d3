"""Slips on the way from right equations to a line below them: whatever was derived is right, so no cause lies there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lagrangian.check.align import alignments
from lagrangian.check.explain.changes.pool import Pool
from lagrangian.check.explain.line_mistakes import stated
from lagrangian.check.explain.numerators import own_in_numerator, said_of
from lagrangian.check.explain.own_terms import own_terms
from lagrangian.check.explain.solved import TERM_NAME, denominator
from lagrangian.check.explain.undivided import undivided
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake, Status
from lagrangian.page.formula import text

WHY = text("The equations above it are right: go from these to this line once more, step by step.")


def below_right_equations(truth: Reference, findings: Sequence[Finding]) -> set[int]:
    """The wrong equations, by the identity of their lines, above which the equation of every coordinate is right."""
    left = {c.name for c in truth.model.coordinates}
    accelerations = [c.acceleration for c in truth.model.coordinates]
    found: set[int] = set()
    for f in findings:
        if f.line.kind != "equation" or not f.line.expr.has(*accelerations):
            continue
        if f.status.right:
            left -= {f.coordinate} if f.coordinate is not None else set()
        elif f.status is Status.WRONG and not left:
            found.add(id(f.line))
    return found


def of_slip(pool: Pool, line: AnsweredLine) -> list[Mistake]:
    """The one term of such a line that is wrong, in its own words; nothing if it is more than one."""
    exprs, P = stated(pool.truth, [line])
    found = alignments(pool.truth, exprs, P)
    if not found or np.abs(found[0].rest).max() <= 1e-9:
        return []
    told: list[tuple[float, Mistake]] = []
    if (row := own_in_numerator(pool, line.expr)) is not None:
        told.append((row.cost, said_of(pool.truth, row.mistake(pool.truth), line.expr)))
    if (forgotten := undivided(pool, found)) is not None:
        told.append((forgotten.cost, forgotten.mistake(pool.truth)))
    if (own := own_terms(pool, exprs, P, found)) is not None:
        told.append((own[0].cost, own[0].mistake(pool.truth)))
    if (under := denominator(pool.truth, exprs, P)) is not None and (not told or under.name == TERM_NAME):
        told = [(0.0, under)]  # all that stands above it is right
    told.sort(key=lambda x: x[0])
    return [replace(mistake, why=WHY, step=5) for _, mistake in told[:1]]
