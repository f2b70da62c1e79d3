"""Explains rows that are solved for one acceleration each, where the mass matrix or the determinant is wrong.

Rows P that are solved from wrong rows W + ΔW are A(W + ΔW) with a matrix A that depends on the place. So W + ΔW is in
the span of P at every place: with the projection N that removes this span, N ΔW = −N W, which is linear in ΔW.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import cast

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.align import CONSTANT, LARGEST, solved
from lagrangian.check.explain.changes.pool import Pool
from lagrangian.check.explain.denominator_terms import wrong_term_below
from lagrangian.check.explain.own_terms import term_replaced
from lagrangian.check.explain.search import EXOTIC, Explanation, Vectors, simple_number, singles
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import Mistake
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.page.formula import Text, text

NAME, TERM_NAME = "denominator", "denominator_term"
"""The names of a mistake in a denominator, and of one of which the term is known."""
_DENOMINATOR = " is right; the denominator is not."
_FACTOR, _IS_NOT = (
    "All other terms are right; what multiplies ",
    ", once the other accelerations are eliminated, is not.",
)
"""How words on a line begin and end that is not solved for its acceleration: no fraction stands in it."""
IN_IT = " In it, "
"""What stands before its wrong term."""
_SOLVED = "What is solved for "
"""How words begin that give a number."""
WHY_BELOW = text("The denominator is what multiplies the acceleration once the others are eliminated: do it once more.")
WHY_FACTOR = text(
    "What moves along has inertia, too: go through what is put in for the other accelerations, and forces."
)
WHY = text("With M ξ̈ = h, ξ̈ = adj(M) h / det M: every acceleration has the same denominator, det M.")


def solved_from_wrong(pool: Pool, exprs: Sequence[sp.Expr], P: Array) -> list[Explanation]:
    """The mistakes, or pairs of them, with which the rows were set up before they were solved, the likeliest first."""
    truth = pool.truth
    if not solved(truth, exprs) or solved(truth, truth.rows):  # M is diagonal: rows are only scaled
        return []
    blocks = P.reshape(truth.n, -1, truth.states.motions).transpose(1, 2, 0)  # (places, motions, n)
    size = np.linalg.norm(blocks, axis=1, keepdims=True)
    if not np.isfinite(blocks).all() or size.min() == 0:
        return []
    basis, corner = np.linalg.qr(blocks / size)
    if np.abs(np.diagonal(corner, axis1=1, axis2=2)).min() < 1e-8:
        return []

    def projected(rows: Array) -> Array:
        """N · rows, for rows (…, S)."""
        shaped = rows.reshape(*rows.shape[:-1], *blocks.shape[:2])
        inside = np.einsum("...bm,bmk->...bk", shaped, basis)
        return (shaped - np.einsum("...bk,bmk->...bm", inside, basis)).reshape(rows.shape)

    rest, effects = -projected(truth.W), projected(pool.W)
    if np.abs(rest).max() <= 1e-9 * np.abs(truth.W).max():
        return []
    effects[np.abs(effects).max(axis=(1, 2)) <= 1e-9 * (1 + np.abs(pool.W).max(axis=(1, 2)))] = 0.0
    found = [e for e in singles(pool, [effects[:, i] for i in range(truth.n)], rest) if _solvable(pool, e)]
    if found and found[0].cost <= EXOTIC:
        return found
    pairs = [e for e in Vectors(pool, effects).pairs(rest) if _solvable(pool, e)]
    return sorted([*found, *pairs], key=lambda e: e.cost)


def _solvable(pool: Pool, explanation: Explanation) -> bool:
    """Whether the rows with the mistakes are still independent: without that they could not have been solved."""
    truth = pool.truth
    rows = truth.W + sum(float(t.times) * pool.W[pool.places[id(t.mistake)]] for t in explanation.told)
    blocks = rows.reshape(truth.n, -1, truth.states.motions).transpose(1, 0, 2)
    size = np.linalg.norm(blocks, axis=2, keepdims=True)
    gone = size.min() <= 1e-9 * np.abs(truth.W).max()
    return bool(not gone and np.linalg.svd(blocks / size, compute_uv=False).min() > 1e-6)


def denominator(truth: Reference, exprs: Sequence[sp.Expr], P: Array) -> Mistake | None:
    """The mistake if the accelerations are the true ones, times a factor that depends on the place alone.

    Of a single coordinate only the term of a denominator that is written is told: its equation may have another factor.
    """
    accelerations = [c.acceleration for c in truth.model.coordinates]
    if not exprs or any(sum(e.has(a) for a in accelerations) != 1 for e in exprs):
        return None
    if truth.n == 1 and (len(exprs) > 1 or not bounded.diff(exprs[0], accelerations[0]).is_number):
        return None
    own = [next(i for i, a in enumerate(accelerations) if e.has(a)) for e in exprs]
    slopes = CompiledExpressions(exprs).slopes(accelerations).at(truth.states)
    slopes = slopes.reshape(len(exprs), truth.n, -1)
    ratios: dict[int, Array] = {}
    for j, i in enumerate(own):
        with np.errstate(all="ignore"):
            written = truth.states.of(accelerations[i]) - P[j] / slopes[j, i]
            ratio = written / truth.accelerations[accelerations[i]]
        blocks = ratio.reshape(-1, truth.states.motions)
        if not np.isfinite(ratio).all() or np.abs(ratio).max() > LARGEST:
            return None
        if (np.abs(blocks - blocks[:, :1]) > CONSTANT * np.abs(blocks[:, :1])).any():
            return None
        ratios[i] = ratio
    wrong = [i for i, r in ratios.items() if np.abs(r - 1).max() > CONSTANT]
    if len(set(own)) < len(exprs) or not wrong:
        return None
    rows = {i: exprs[own.index(i)] for i in wrong}
    symbols = [x for i in wrong for x in (cast("sp.Expr", accelerations[i]), ", ")][:-1]
    common = len(wrong) == truth.n > 1 and all(np.allclose(r, ratios[wrong[0]], rtol=CONSTANT) for r in ratios.values())
    words = _words(symbols, ratios[wrong[0]], common=common)
    name = truth.model.coordinates[wrong[0]].name if len(wrong) == 1 else None
    brief = text("A denominator of a solved equation is not right.")
    told = Mistake(NAME, words, WHY, 5, None, name, brief)
    if words.parts[0] == _SOLVED:
        return None if truth.n == 1 else told
    if not any(_is_solved(e, accelerations[i]) for i, e in rows.items()):
        what, brief = text(_FACTOR, *symbols, _IS_NOT), text("What multiplies an acceleration is not right.")
        told = replace(told, what=what, why=WHY_FACTOR, brief=brief)
    if len(wrong) == 1:
        with np.errstate(all="ignore"):
            pair = wrong_term_below(truth, rows[wrong[0]], wrong[0], ratios[wrong[0]])
        if pair is not None and pair[0] != pair[1]:
            one = 0 in pair or pair[0] == -pair[1]
            first, *more = term_replaced(*pair)[1].parts if one else ("", pair[0], " should be ", pair[1], ".")
            what = text(*told.what.parts, f"{IN_IT}{str(first)[:1].lower()}{str(first)[1:]}", *more)
            return replace(told, name=TERM_NAME, what=what, why=WHY_BELOW if told.why is WHY else told.why)
    return None if truth.n == 1 else told


def _is_solved(expr: sp.Expr, acceleration: sp.Expr) -> bool:
    """Whether an equation is solved for an acceleration, so that what belongs before it stands in a denominator."""
    return bool(bounded.diff(expr, acceleration).is_number)


def _words(symbols: Sequence[sp.Expr | str], ratio: Array, *, common: bool) -> Text:
    number = simple_number(float(ratio[0])) if np.ptp(ratio) <= CONSTANT * np.abs(ratio).max() else None
    if number is not None:
        times = sp.Rational(number.numerator, number.denominator)
        return text(_SOLVED, *symbols, " is ", times, " times what it should be.")
    if common:
        return text("The numerators are right; the common denominator, the determinant of the mass matrix, is not.")
    return text("The numerator of ", *symbols, _DENOMINATOR)
