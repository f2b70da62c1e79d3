"""The term of a denominator that is wrong: m b² sin²(φ − θ) in (J + m b² sin²(φ − θ)), where m b² cos²(φ − θ) belongs.

The right denominator is the factor of the acceleration in its own equation, or the determinant of some rows and columns
of the mass matrix, in the scale of what is written.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from itertools import combinations
from typing import Any, cast

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.reference import Reference
from lagrangian.derive.sampling import Array, CompiledExpressions

NEAR = 1e-7
"""The relative difference of values that is rounding."""
MOST_TERMS, LONGEST = 24, 400
"""The most terms of a denominator, and the most operations of a right one."""


def wrong_term_below(truth: Reference, expr: sp.Expr, i: int, ratio: Array) -> tuple[sp.Expr, sp.Expr] | None:
    """What stands in the one denominator of an equation that is solved for acceleration i, and what belongs there.

    ``ratio`` is the right denominator by the written one at every state. Either term may be 0; None if more than one
    term is wrong. In an equation that is not solved it is what multiplies the acceleration.
    """
    factor = bounded.diff(expr, truth.model.coordinates[i].acceleration)
    bases = {f.base for f in expr.atoms(sp.Pow) if f.exp == -1 and f.base.is_Add}
    whole = [b for b in bases if not any(x is not b and x.has(b) for x in bases)]
    if not bases:
        whole = list({sp.fraction(x)[1] for x in sp.Add.make_args(expr)} - {sp.S.One})
    whole = whole if factor.is_number else [factor]
    if len(whole) != 1:
        return None
    below = cast("sp.Expr", bounded.expand(truth.expand(whole[0])))
    written = [cast("sp.Expr", x) for x in sp.Add.make_args(below)]
    if len(written) > MOST_TERMS:
        return None
    for right in _right_ones(truth, i):
        for scale in _scales(written, right):
            own = bounded.expand(scale * right)
            values = CompiledExpressions([own, below]).at(truth.states)
            if (
                not np.isfinite(values).all()
                or np.abs(values[0] - values[1] * ratio).max() > NEAR * np.abs(values).max()
            ):
                continue
            theirs, ours = set(written), set(cast("tuple[sp.Expr, ...]", sp.Add.make_args(own)))
            pair = sp.Add(*(theirs - ours)), bounded.trigsimp(sp.Add(*(ours - theirs)))
            if not any(x.is_Add for x in pair):
                return pair
    return None


def _scales(written: list[sp.Expr], right: sp.Expr) -> list[sp.Expr]:
    """The factors by which one term of the right denominator is one that is written, products of letters and numbers;
    those of most terms first."""
    votes: dict[sp.Expr, int] = {}
    for a in written:
        for b in sp.Add.make_args(right):
            scale = cast("sp.Expr", a / b)
            if not scale.has(sp.Function, sp.Derivative):
                votes[scale] = votes.get(scale, 0) + 1
    return sorted(votes, key=lambda x: -votes[x])[:MOST_TERMS]


@lru_cache(maxsize=64)
def _right_ones(truth: Reference, i: int) -> tuple[sp.Expr, ...]:
    """What may multiply acceleration i once some others are eliminated, multiplied out: the determinants of the rows
    and columns of M with i, and M_ii − M_io M_oo⁻¹ M_oi."""
    return tuple(x for x in _factors(truth, i) if bounded.operations(x) <= LONGEST)


def _factors(truth: Reference, i: int) -> Iterator[sp.Expr]:
    M: Any = truth.mass_matrix
    others = [k for k in range(truth.n) if k != i]
    for count in range(len(others) + 1):
        for more in combinations(others, count):
            held = sorted((i, *more))
            yield bounded.expand(M.extract(held, held).det(method="berkowitz"))
            if count == 1:  # of more, it has no terms that are written so
                (k,) = more
                yield bounded.expand(M[i, i] - M[i, k] * M[k, i] / M[k, k])
