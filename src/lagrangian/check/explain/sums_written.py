"""Explanations that quote a sum of rates: likelier where such a sum stands in the answer, less likely where none does.

((R + r) α̇ + R β̇)² shows how ω was taken; the sign of a product α̇ β̇ alone does not.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import sympy as sp

from lagrangian.check.explain.changes.pool import Pool
from lagrangian.check.explain.search import Explanation
from lagrangian.check.verdict import AnsweredLine
from lagrangian.derive.sampling import SETS, Array, CompiledExpressions

UNSEEN = 0.15
"""What it costs that nobody wrote the sum that is quoted."""
MOST_SUMS = 60
"""The largest number of sums of an answer that are compared."""
NEAR = 1e-9
"""The relative difference of values that is rounding."""


def by_sums(pool: Pool, found: Sequence[Explanation], lines: Sequence[AnsweredLine]) -> list[Explanation]:
    """The explanations, those less likely that quote an angular velocity which stands nowhere, the cheapest first."""
    quoted = {id(e): x for e in found if len(e.told) == 1 and (x := _quoted(pool, e)) is not None}
    if not quoted:
        return list(found)
    v = [c.rate for c in pool.truth.model.coordinates]
    every = dict.fromkeys(x for line in lines for x in line.expr.atoms(sp.Add) if x.has(*v))
    written = CompiledExpressions(list(every)[:MOST_SUMS]).at(pool.truth.states) if every else []
    said = dict(zip(quoted, CompiledExpressions(list(quoted.values())).at(pool.truth.states), strict=True))
    unseen = {k for k, x in said.items() if not any(_alike(x, y) for y in written)}
    costly = [replace(e, cost=e.cost + UNSEEN) if id(e) in unseen else e for e in found]
    return sorted(costly, key=lambda e: e.cost)


def _quoted(pool: Pool, explanation: Explanation) -> sp.Expr | None:
    """The sum of rates that an explanation says was taken for an angular velocity."""
    change = explanation.told[0].mistake.change
    if change is None or change.kind != "omega" or not isinstance(change.written, sp.Expr):
        return None
    held = [c.rate for c in pool.truth.model.coordinates if change.written.has(c.rate)]
    return pool.truth.put(change.written) if len(held) > 1 else None


def _alike(one: Array, other: Array) -> bool:
    """Whether one of two values is the other times a constant."""
    if not np.isfinite(other).all():
        return False
    a, b = one.reshape(SETS, -1), other.reshape(SETS, -1)
    first, second = a * b[:, :1], b * a[:, :1]
    return bool(np.abs(first - second).max() <= NEAR * max(np.abs(first).max(), np.abs(second).max()))
