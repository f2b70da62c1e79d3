"""Finds a row that was divided by its inertia, but of which some terms were divided by another part of it.

(J + m r²) ψ̈ + 2 m r ṙ ψ̇ + κ ψ = 0     ψ̈ = −κ ψ/(J + m r²) − 2 ṙ ψ̇/r     2 m r ṙ ψ̇ was divided by m r² alone
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from typing import cast

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.align import LARGEST, Alignment
from lagrangian.check.explain.changes.pool import Pool
from lagrangian.check.explain.right_terms import RightTerm
from lagrangian.check.explain.search import SMALL
from lagrangian.check.rows import same_values
from lagrangian.derive.sampling import Array, CompiledExpressions

MOST_PARTS = 5
"""The most terms of an inertia of which some are taken for it."""
MOST_TERMS = 16
"""The most terms of an equation of which some may have been divided otherwise."""


def divided_otherwise(pool: Pool, a: Alignment, j: int, by: sp.Expr) -> tuple[RightTerm, sp.Expr] | None:
    """The terms of row ``j`` that were divided by a part of the sum ``by`` alone, as one, and this part."""
    truth, i = pool.truth, a.rows[j]
    acceleration = truth.model.coordinates[i].acceleration
    shown = [cast("sp.Expr", truth.expand(t.expr)) for t in truth.derivation.terms[i]]
    shown = [-x if t.kind == "input" else x for t, x in zip(truth.derivation.terms[i], shown, strict=True)]
    listed = [x for x in shown if not x.has(acceleration)]
    parts = list(_parts(by))
    if not parts or not 0 < len(listed) <= MOST_TERMS:
        return None
    values = CompiledExpressions([truth.put(x) for x in (*listed, *(by / p for p in parts))]).at(truth.states)
    right, ratios = values[: len(listed)], values[len(listed) :]
    if not np.isfinite(right).all() or np.abs(right).max() > LARGEST:
        return None
    for part, ratio in zip(parts, ratios, strict=True):
        if np.isfinite(ratio).all() and (np.abs(ratio - 1.0) > SMALL).all():
            held = _chosen(right, a.rest[j] / (ratio - 1.0))
            if held:
                chosen = [listed[k] for k in held]
                return RightTerm(cast("sp.Expr", sp.Add(*chosen)), 5, 0.2 * len(chosen)), part
    return None


def _parts(by: sp.Expr) -> Iterator[sp.Expr]:
    """The parts of a sum: the single terms, and sums of some of them."""
    terms = sp.Add.make_args(bounded.expand(by))
    for count in range(1, len(terms)) if 1 < len(terms) <= MOST_PARTS else ():
        for chosen in combinations(terms, count):
            yield cast("sp.Expr", sp.Add(*chosen))


def _chosen(right: Array, rest: Array) -> list[int]:
    """The places of the terms that add up to ``rest``; none if no sum of them, or every sum, does."""
    numbers, _, rank, _ = np.linalg.lstsq(right.T, rest, rcond=None)
    held = np.round(numbers)
    sums = rank == len(right) and np.isin(held, (0.0, 1.0)).all()
    close = sums and same_values(held @ right, rest, SMALL)
    return [int(k) for k in np.flatnonzero(held)] if close else []
