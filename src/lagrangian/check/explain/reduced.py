"""Explains an equation from which the multiplier was eliminated: Σ α_i W_i with Aα = 0, which holds no λ.

For one equation fewer than coordinates α is unique but for a factor, and depends on the position alone.
"""

from __future__ import annotations

from itertools import product
from typing import cast

import numpy as np
import sympy as sp

from lagrangian.check.align import LARGEST, agreed, slopes_of_equations
from lagrangian.check.explain.changes.pool import Pool
from lagrangian.check.explain.search import EXOTIC, SMALL, Explanation, Vectors, singles
from lagrangian.check.held import OnConstraints
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import Mistake
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.page.formula import text

WHY = text("A multiplier is gone only if its factors cancel in the sum: put them in and add them.")
WHAT = text("The multiplier does not cancel: one of the equations stands in the sum with the wrong sign.")
BRIEF = text("The equations were not combined so that the multiplier cancels.")


def of_reduced(pool: Pool, expr: sp.Expr) -> tuple[list[Explanation], Mistake | None]:
    """The mistakes that lead to an equation without multipliers, or the mistake of its elimination.

    Nothing unless there is one equation fewer than coordinates.
    """
    truth = pool.truth
    alpha = _combination(truth)
    if alpha is None:
        return [], None
    P = CompiledExpressions([expr]).at(truth.states)[0]
    if not np.isfinite(P).all() or np.abs(P).max() > LARGEST:
        return [], None
    rows = [truth.put_in(x) for x in (expr, *truth.rows)] if isinstance(truth, OnConstraints) else [expr, *truth.rows]
    mine, *each = slopes_of_equations(truth, rows)
    forces = dict.fromkeys(_forces(truth), sp.S.Zero)
    W = CompiledExpressions([cast("sp.Expr", row.xreplace(forces)) for row in truth.rows]).at(truth.states)
    found: list[Explanation] = []
    for signs in product((-1.0, 1.0), repeat=truth.n - 1):  # the right ones last
        combined = alpha * np.array([1.0, *signs])[:, None]
        right = np.einsum("is,is->s", combined, W)
        slopes = np.einsum("is,ims->ms", combined, np.array(each))
        for f, _ in agreed(truth, mine, slopes):
            rest = P / f - right
            if min(signs) < 0 and np.abs(rest).max() <= SMALL * np.abs(right).max():
                return [], Mistake("elimination", WHAT, WHY, 5, brief=BRIEF)
            if min(signs) > 0:
                found += _explained(pool, np.einsum("is,cis->cs", combined, pool.W), rest)
    return sorted(found, key=lambda e: e.cost), None


def _explained(pool: Pool, effects: Array, rest: Array) -> list[Explanation]:
    found = singles(pool, [effects], rest)
    if not found or found[0].cost > EXOTIC:
        found += Vectors(pool, effects).pairs(rest)
    return found


def _forces(truth: Reference) -> list[sp.Expr]:
    return [m.symbol for m in truth.derivation.multipliers.values()]


def _combination(truth: Reference) -> Array | None:
    """α with Aα = 0 at every state, the same in all motions at one place, (n, S); None if it is not unique."""
    forces = _forces(truth)
    columns = CompiledExpressions([cast("sp.Expr", r.diff(x)) for r in truth.rows for x in forces]).at(truth.states)
    A = columns.reshape(truth.n, len(forces), -1).transpose(2, 1, 0)
    if not np.isfinite(A).all():
        return None
    first = A[:: truth.states.motions]
    _, sizes, right = np.linalg.svd(first)
    if len(forces) != truth.n - 1 or sizes.min() <= 1e-9 * sizes.max():
        return None
    return np.repeat(right[:, -1], truth.states.motions, axis=0).T
