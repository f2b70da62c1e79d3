"""Explanations that quote a sum: likelier where such a sum stands in the answer, less likely where none does.

((R + r) α̇ + R β̇)² shows how ω was taken; the sign of a product α̇ β̇ alone does not. And −h cos β − s sin β stands in
place of s sin β − h cos β where somebody wrote both; of + M g s sin β alone, all that is known is its sign.
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
from lagrangian.model import time

UNSEEN = 0.15
"""What it costs that nobody wrote the sum of rates that is quoted."""
UNSEEN_LENGTH = 1.5
"""The same of a sum of lengths, which the letters of one term do not show."""
MOST_SUMS = 60
"""The largest number of sums of an answer that are compared."""
NEAR = 1e-9
"""The relative difference of values that is rounding."""


def by_sums(pool: Pool, found: Sequence[Explanation], lines: Sequence[AnsweredLine]) -> list[Explanation]:
    """The explanations, those less likely that quote a sum which stands nowhere, the cheapest first."""
    quoted = {id(e): x for e in found if len(e.told) == 1 and (x := _quoted(pool, e)) is not None}
    lengths = {id(e): x for e in found if len(e.told) == 1 and (x := _length(e)) is not None}
    if not quoted and not lengths:
        return list(found)
    surcharges = dict.fromkeys(_unseen(pool, quoted, lines), UNSEEN) if quoted else dict[int, float]()
    surcharges |= {k: UNSEEN_LENGTH for k, x in lengths.items() if not _is_written(pool, *x, lines)}
    costly = [replace(e, cost=e.cost + surcharges.get(id(e), 0.0)) for e in found]
    return sorted(costly, key=lambda e: e.cost)


def _unseen(pool: Pool, quoted: dict[int, sp.Expr], lines: Sequence[AnsweredLine]) -> set[int]:
    """Those of the quoted sums of rates that stand nowhere."""
    v = [c.rate for c in pool.truth.model.coordinates]
    every = dict.fromkeys(x for line in lines for x in line.expr.atoms(sp.Add) if x.has(*v))
    written = CompiledExpressions(list(every)[:MOST_SUMS]).at(pool.truth.states) if every else []
    said = dict(zip(quoted, CompiledExpressions(list(quoted.values())).at(pool.truth.states), strict=True))
    return {k for k, x in said.items() if not any(_alike(x, y) for y in written)}


def _length(explanation: Explanation) -> tuple[sp.Expr, sp.Expr] | None:
    """The sum of lengths in whose place another stands, and the other."""
    change = explanation.told[0].mistake.change
    if change is None or change.kind != "sum":
        return None
    right, written = change.right, change.written
    return (right, written) if isinstance(right, sp.Expr) and isinstance(written, sp.Expr) else None


def _is_written(pool: Pool, right: sp.Expr, written: sp.Expr, lines: Sequence[AnsweredLine]) -> bool:
    """Whether a sum of lengths stands in a line, with a factor or without; one term does, unless a factor of the right
    sum itself made a product of a sum that nobody measures, as e makes e² − 2 e r of e (e − 2 r)."""
    terms = sp.Add.make_args(written)
    if len(terms) == 1:
        return not _is_made(pool, right)
    return any(_holds(node, terms) for line in lines for node in line.expr.atoms(sp.Add))


def _is_made(pool: Pool, right: sp.Expr) -> bool:
    """Whether a sum stands in the energies only beside one of its own letters."""
    own = right.free_symbols - {time}
    d = pool.truth.derivation
    products = [x for e in (d.T, d.V) for x in sp.sympify(e).atoms(sp.Mul) if right in x.args]
    return bool(products) and all(any(f.free_symbols & own for f in x.args if f != right) for x in products)


def _holds(node: sp.Basic, terms: Sequence[sp.Expr]) -> bool:
    """Whether a sum has some terms, all times the same factor."""
    listed = set(node.args)
    factors = (x / terms[0] for x in node.args)
    return any(all(f * t in listed for t in terms) for f in factors)


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
