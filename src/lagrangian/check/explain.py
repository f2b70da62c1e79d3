"""Finds the misconception that explains an answer: the one that leads to the same equations.

A variant with equations W + ΔW explains the equations P of an answer if every P_j is a sum of them with factors that do
not depend on rates and accelerations or, less plainly, do depend on the position. The effects of two mistakes add up,
because Lagrange's equations are linear in T*, V and Ξ.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import sympy as sp

from lagrangian.check.candidates import Effects, Wrong, effects_of
from lagrangian.check.difference import likeness
from lagrangian.check.reference import Reference
from lagrangian.check.rows import DOUBLE_TOLERANCE
from lagrangian.derive.sampling import SETS, Array, CompiledExpressions


@dataclass(frozen=True, eq=False)
class Explanation:
    """One mistake, or two together, and how directly it leads to the answer.

    0: row by row, 1: with factors, 2: mixed, 3: with factors that depend on the position.
    """

    wrongs: tuple[Wrong, ...]
    plainness: int


def explain_rows(truth: Reference, exprs: Sequence[sp.Expr]) -> list[Explanation]:
    """The variants that lead to all of these equations, the most likely first."""
    P = CompiledExpressions(exprs).at(truth.states) * np.array([[_side(truth, e)] for e in exprs])
    said = np.isfinite(P).all(axis=1) & (np.abs(P).max(axis=1) > 1e-12)
    P = P[said]
    if not len(P) or not np.isfinite(truth.W).all():
        return []
    effects = effects_of(truth)
    size = truth.states.size // SETS
    sets = [slice(k * size, (k + 1) * size) for k in range(SETS)]
    return _alone(truth, effects, P, sets) or _together(truth, effects, P) or _by_place(truth, effects, P)


def _side(truth: Reference, expr: sp.Expr) -> int:
    """−1 if most terms of an equation are on the opposite side compared with the right equation that it resembles."""
    best = max(likeness(truth.form(expr), truth.forms), key=lambda x: x.score)
    return -1 if best.factor.could_extract_minus_sign() else 1


def _by_place(truth: Reference, effects: Effects, P: Array) -> list[Explanation]:
    """The variants that lead to the answer with factors that depend on the position, as when r was divided out."""
    found = _alone(truth, effects, P, list(truth.states.blocks()))
    return [Explanation(e.wrongs, 3) for e in found]


def _alone(truth: Reference, effects: Effects, P: Array, parts: Sequence[slice]) -> list[Explanation]:
    """The single variants that lead to the answer with factors that are constant in each set of states."""
    candidates = np.flatnonzero(np.logical_and(effects.usable, effects.felt))
    if not len(candidates):
        return []
    W = truth.W[None] + effects.W[candidates]
    plain = np.zeros(len(candidates), int)
    fits = np.ones(len(candidates), bool)
    for part in parts:
        fit, how = _spanned(P[:, part], W[:, :, part])
        fits &= fit
        plain = np.maximum(plain, how)
    found = [Explanation((effects.wrongs[candidates[i]],), int(plain[i])) for i in np.flatnonzero(fits)]
    return sorted(found, key=lambda e: (e.plainness, e.wrongs[0].general, e.wrongs[0].variant.doubt, e.wrongs[0].rank))


def _spanned(P: Array, W: Array) -> tuple[Array, Array]:
    """Which W (variants, n, s) span every row of P (k, s), and how directly: same rows 0, scaled 1, mixed 2."""
    scale = np.abs(W).max(axis=2, keepdims=True)
    unit = W / np.where(scale > 0, scale, 1.0)
    A = np.einsum("ks,vsn->vkn", P, np.linalg.pinv(unit, rcond=1e-10))
    left = np.abs(P[None] - np.einsum("vkn,vns->vks", A, unit)).max(axis=2)
    fits = (left <= DOUBLE_TOLERANCE * np.abs(P).max(axis=1)[None]).all(axis=1)
    A = A / np.where(scale > 0, scale, 1.0).transpose(0, 2, 1)
    big = np.abs(A * scale.transpose(0, 2, 1)) > DOUBLE_TOLERANCE * np.abs(P).max(axis=1)[None, :, None]
    mixed = (big.sum(axis=2) > 1).any(axis=1)
    ones = np.where(big, np.abs(A - 1), 0).max(axis=(1, 2)) < 1e-6
    return fits, np.where(mixed, 2, np.where(ones, 0, 1))


def _together(truth: Reference, effects: Effects, P: Array) -> list[Explanation]:
    """Pairs of mistakes whose effects add up to that of the answer, row by row."""
    if len(P) != truth.n:
        return []
    usable = [i for i in np.flatnonzero(np.logical_and(effects.usable, effects.felt)) if not effects.wrongs[i].general]
    if len(usable) < 2:
        return []
    dW = effects.W[usable].reshape(len(usable), -1)
    found: list[Explanation] = []
    for sign in (1, -1):
        D = (sign * P - truth.W).reshape(-1)
        scale = max(float(np.abs(D).max()), 1e-300)
        probe = np.random.default_rng(7).standard_normal(len(D))
        sums, target = dW @ probe, D @ probe
        order = np.argsort(sums)
        near = np.searchsorted(sums[order], target - sums - 1e-6 * scale)
        for i, start in enumerate(near):
            for k in order[start : start + 8]:
                if k > i and np.abs(dW[i] + dW[k] - D).max() <= DOUBLE_TOLERANCE * scale:
                    pair = sorted((effects.wrongs[usable[i]], effects.wrongs[usable[k]]), key=lambda w: w.rank)
                    found.append(Explanation(tuple(pair), 0))
    return sorted(found, key=lambda e: sum(w.rank for w in e.wrongs))
