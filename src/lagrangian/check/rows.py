"""Compares an answer's equations with the right ones: which are true, and how much of each right equation they contain.

P_j are the answer's equations and W_i the right ones, left minus right. The factors A in P_j = Σ_i A_ji W_i are sought
at each position from many motions. P_j is true if it vanishes for the true accelerations.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from enum import Enum
from fractions import Fraction
from math import gcd
from typing import Any

import mpmath
import numpy as np
import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.reference import Reference
from lagrangian.derive.algebra import Form
from lagrangian.derive.sampling import DIGITS, PLACES, SETS, Array, CompiledExpressions, States
from lagrangian.errors import ModelError
from lagrangian.records import dataclass

DOUBLE_TOLERANCE = 1e-8
"""The relative size below which a double may be zero; a decision based on it is confirmed exactly."""
VISIBLE = 1e-6
"""The size above which a value of what may be 0 is no rounding."""
EXACTLY = mpmath.mpf(10) ** -30
EXACT_STATES = 4
"""The number of states at which 50 digits are compared."""


class Kind(Enum):
    """How a true equation is composed of the right ones."""

    SAME = "a right equation"
    SCALED = "a right equation times a factor"
    COMBINED = "a sum of right equations with constant factors"
    TURNED = "a sum of right equations with factors that depend on the place"
    CONSEQUENCE = "true whenever the right equations hold"
    NOTHING = "0 = 0"
    WRONG = "not true"


@dataclass(frozen=True)
class ReferenceRow:
    """One equation of an answer: ``factors`` are its A_ji in SymPy if they were found; ``index`` is its right
    equation."""

    kind: Kind
    factors: tuple[sp.Expr, ...] | None = None
    index: int | None = None

    @property
    def true(self) -> bool:
        """Whether it holds for the right motion and is not trivial."""
        return self.kind not in (Kind.WRONG, Kind.NOTHING)


@dataclass(frozen=True)
class RowComparison:
    """All equations of an answer: the kind of each, and how many of the true ones are independent."""

    rows: tuple[ReferenceRow, ...]
    rank: int


def same_values(one: Array, other: Array, near: float = 1e-9) -> bool:
    """Whether values are those of another expression: their largest difference is at most ``near`` of its largest."""
    return bool(np.abs(one - other).max() <= near * np.abs(other).max())


def compare(
    truth: Reference, exprs: Sequence[sp.Expr], *, instead: Mapping[sp.Basic, Array] | None = None
) -> RowComparison:
    """Return how each expression, which is left minus right of an equation, is composed of the right equations."""
    compiled = CompiledExpressions(exprs)
    P = compiled.at(truth.states, instead)
    A, spanned = factors_of(truth, P, truth.W)
    moving = _on_motion(truth, compiled, P if instead is None else compiled.at(truth.states))
    rows = []
    for j, expr in enumerate(exprs):
        rows.append(_row(truth, expr, compiled, j, P[j], A[:, j, :], bool(spanned[j]), bool(moving[j])))
    return RowComparison(tuple(rows), _rank(truth, compiled, [r.true for r in rows]))


def small(values: Array, scale: Array | float) -> bool:
    """Whether every value is finite and negligible compared with the scale."""
    return bool(np.isfinite(values).all() and (np.abs(values) <= DOUBLE_TOLERANCE * np.maximum(scale, 1e-300)).all())


def differs_somewhere(truth: Reference, expr: sp.Expr) -> bool:
    """Whether an expression, which may have names of the answer's own, is seen at the states not to be 0: then nobody
    needs to multiply it out."""
    if any(not isinstance(d.expr, AppliedUndef) for d in expr.atoms(sp.Derivative)):
        return False
    try:
        values = CompiledExpressions([expr]).at(truth.states)[0]
    except ModelError:
        return False
    return bool((np.abs(values[np.isfinite(values)]) > VISIBLE).any())


def zero_everywhere(truth: Reference, expr: sp.Expr) -> bool:
    """Whether an expression vanishes identically: in normal form, otherwise with 50 digits at several states."""
    if expr == 0:
        return True
    compiled = CompiledExpressions([expr])
    values = compiled.at(truth.states)[0]
    values = values[np.isfinite(values)]
    if not len(values) or np.abs(values).max() > VISIBLE:
        return False
    form = truth.form(expr)
    if form is not None and (form.is_zero or not form.opaque()):
        return form.is_zero
    step = max(1, truth.states.size // EXACT_STATES)
    found = [compiled.exactly(truth.states, i)[0] for i in range(0, truth.states.size, step)]
    far, indices = truth.wide([expr])
    found += [compiled.exactly(far, i)[0] for i in indices]
    return all(abs(x) < EXACTLY for x in found if mpmath.isfinite(x))


def factors_of(truth: Reference, P: Array, W: Array) -> tuple[Array, Array]:
    """A (blocks, k, n) in P = A W by least squares at every position, and which rows of P lie in the span of W."""
    k = len(P)
    found, holds = [], np.ones(k, bool)
    for block in truth.states.blocks():
        w, p = W[:, block], P[:, block]
        good = np.isfinite(w).all(axis=0) & np.isfinite(p).all(axis=0)
        if good.sum() < len(W) + 2:
            found.append(np.zeros((k, len(W))))
            holds &= np.isfinite(p).all(axis=1) & False
            continue
        w, p = w[:, good], p[:, good]
        a = np.linalg.lstsq(w.T, p.T, rcond=None)[0].T
        found.append(a)
        scale = np.abs(p).max(axis=1)
        holds &= np.abs(p - a @ w).max(axis=1) <= DOUBLE_TOLERANCE * np.maximum(scale, 1e-300)
    return np.array(found), holds


def _on_motion(truth: Reference, compiled: CompiledExpressions, other: Array) -> Array:
    """Which expressions vanish along the true motion, compared with their size elsewhere."""
    truly = compiled.at(truth.states, truth.accelerations)
    good = np.isfinite(truly) & np.isfinite(other)
    holds = []
    for t, o, g in zip(truly, other, good, strict=True):
        holds.append(bool(g.sum() >= SETS * PLACES and small(t[g], float(np.abs(o[g]).max()))))
    return np.array(holds)


def _rank(truth: Reference, compiled: CompiledExpressions, true: list[bool]) -> int:
    """The number of independent true equations: the rank of ∂P/∂ξ̈ for the true motion.

    It must be computed for the true motion: the product of two equations is also true there, but says nothing.
    """
    if not any(true):
        return 0
    slopes = compiled.slopes([c.acceleration for c in truth.model.coordinates])
    found = slopes.at(truth.states, truth.accelerations).reshape(len(true), truth.n, truth.states.size)[np.array(true)]
    off = slopes.at(truth.states).reshape(len(true), truth.n, truth.states.size)[np.array(true)]
    scale = np.abs(np.where(np.isfinite(off), off, 0)).max(axis=(1, 2), keepdims=True)
    found = np.where(np.abs(found) > DOUBLE_TOLERANCE * scale, found, 0)
    ranks = [0]
    for s in range(0, truth.states.size, truth.states.motions):
        if np.isfinite(found[:, :, s]).all():
            ranks.append(int(np.linalg.matrix_rank(_normed(found[:, :, s]), tol=1e-7)))
    return max(ranks)


def _normed(rows: Array) -> Array:
    size = np.abs(rows).max(axis=1, keepdims=True)
    return rows / np.where(size > 0, size, 1.0)


def _row(
    truth: Reference,
    expr: sp.Expr,
    compiled: CompiledExpressions,
    j: int,
    p: Array,
    A: Array,
    spanned: bool,
    moving: bool,
) -> ReferenceRow:
    form = truth.form(expr)
    if (form is not None and form.is_zero) or small(p, 1.0):
        return ReferenceRow(Kind.NOTHING)
    if not spanned and not moving:
        return ReferenceRow(Kind.WRONG)
    factors = proved = _proportional(truth, form, A) if spanned else None
    if spanned and proved is None:
        factors = _symbolic(truth, expr, A)
    exact = True if proved is not None else _exact(truth, form, factors) if factors is not None else None
    if factors is not None and exact:
        return _named(factors, truth)
    if exact is False or not _surely(truth, compiled, j, expr):
        return ReferenceRow(Kind.WRONG)
    if not spanned:
        return ReferenceRow(Kind.CONSEQUENCE)
    if factors is not None:
        return _named(factors, truth)
    used = _used(truth, A)
    if len(used) == 1:
        return ReferenceRow(Kind.SCALED, None, used[0])
    return ReferenceRow(Kind.TURNED)


def _named(factors: tuple[sp.Expr, ...], truth: Reference) -> ReferenceRow:
    used = [i for i, f in enumerate(factors) if f != 0]
    if len(used) == 1:
        i = used[0]
        return ReferenceRow(Kind.SAME if abs(factors[i]) == 1 else Kind.SCALED, factors, i)
    moving = any(f.free_symbols and f.has(*truth.derivation.coordinates) for f in factors)
    return ReferenceRow(Kind.TURNED if moving else Kind.COMBINED, factors)


def _exact(truth: Reference, form: Form | None, factors: Sequence[sp.Expr]) -> bool | None:
    """Whether P − Σ A W = 0 in normal form; None if that is undecided, as with unknown functions."""
    if form is None:
        return None
    rest = form
    for factor, right in zip(factors, truth.forms, strict=True):
        if factor == 0:
            continue
        own = truth.form(factor)
        if own is None or right is None:
            return None
        rest = rest - own * right
    return True if rest.is_zero else None if rest.opaque() else False


def _surely(truth: Reference, compiled: CompiledExpressions, j: int, expr: sp.Expr) -> bool:
    """Whether expression j vanishes along the true motion, with 50 digits, at states near and far."""
    step = max(1, truth.states.size // EXACT_STATES)
    near = [_vanishes(truth, compiled, j, truth.states, i) for i in range(0, truth.states.size, step)]
    far_out, indices = truth.wide([expr])
    far = [_vanishes(truth, compiled, j, far_out, i) for i in indices]
    return False not in (*near, *far) and near.count(True) >= 2


def _vanishes(truth: Reference, compiled: CompiledExpressions, j: int, states: States, index: int) -> bool | None:
    """Whether expression j vanishes at one state; None if the right equations have no value there."""
    try:
        motion = truth.accelerations_exactly(states, index)
    except (ZeroDivisionError, ValueError):
        return None
    if not all(mpmath.isfinite(x) for x in motion.values()):
        return None
    truly, off = compiled.exactly(states, index, motion)[j], compiled.exactly(states, index)[j]
    if not (mpmath.isfinite(truly) and mpmath.isfinite(off)):
        return False
    with mpmath.workdps(DIGITS):
        return bool(abs(truly) <= EXACTLY * (1 + abs(off)))


# -- factors as expressions -----------------------------------------------------------------------------------------


def _used(truth: Reference, A: Array) -> list[int]:
    """The right equations that have a part in one row."""
    return [i for i in range(truth.n) if np.abs(A[:, i]).max() > DOUBLE_TOLERANCE * np.abs(A).max()]


def _proportional(truth: Reference, form: Form | None, A: Array) -> tuple[sp.Expr, ...] | None:
    """The factors of one row that is a number times a product of letters times a right one, as normal forms prove."""
    used = _used(truth, A)
    if len(used) == 1 and (right := truth.forms[used[0]]) is not None and form is not None:
        found = ratio(form, right)
        if found is not None and _exact(truth, form, _only(truth, used[0], found[0])):
            return _only(truth, used[0], found[0])
    return None


def _symbolic(truth: Reference, expr: sp.Expr, A: Array) -> tuple[sp.Expr, ...] | None:
    """The factors of one row as expressions, found from their values at every position; None if they are not found."""
    size, used = np.abs(A).max(), _used(truth, A)
    factors: list[sp.Expr] = [sp.S.Zero] * truth.n
    if np.abs(A - A[0]).max() <= DOUBLE_TOLERANCE * size:
        for i in used:
            number = Fraction(float(A[0, i])).limit_denominator(10_000)
            if abs(float(number) - A[0, i]) > DOUBLE_TOLERANCE * size:
                return None
            factors[i] = sp.Rational(number.numerator, number.denominator)
        return tuple(factors)
    if len(used) == 1:
        return _quotient(truth, expr, used[0])
    if truth.n <= 3 and terms_of(expr) <= 60:
        return _solved(truth, expr, A)
    return None


def _only(truth: Reference, i: int, factor: sp.Expr) -> tuple[sp.Expr, ...]:
    """The factors of a row that is a multiple of equation i."""
    return tuple(factor if k == i else sp.S.Zero for k in range(truth.n))


def terms_of(expr: sp.Expr) -> int:
    """How many operations an expression has."""
    return bounded.operations(expr)


_ONES = ((1, 1), (-1, 1))


def ratio(form: Form, right: Form, *, unlike: float = 1.0) -> tuple[sp.Expr, int] | None:
    """Return the factor c, a number times a monomial, for which most terms of ``form`` are c times a term of ``right``.

    Also return how many terms agree; None if no terms do. A term with a factor other than ±1 counts only ``unlike``.
    """
    votes: Counter[tuple[int, int, int]] = Counter()
    for h, mine in form.parts.items():
        theirs = right.parts.get(h)
        if theirs is None or len(mine) * len(theirs) > 250_000:
            continue
        for m, c in mine.items():
            for o, d in theirs.items():
                above, below = c * right.den, d * form.den
                shared = gcd(above, below) if below > 0 else -gcd(above, below)
                votes[above // shared, below // shared, m - o] += 1
    if not votes:
        return None
    (above, below, monomial), count = max(
        votes.items(),
        key=lambda v: (
            v[1] * (1.0 if v[0][2] == 0 and v[0][:2] in _ONES else unlike),
            v[0][2] == 0,
            v[0][:2] == (1, 1),
            v[0][:2] in _ONES,
            -abs(v[0][2]),
        ),
    )
    factor = sp.Rational(above, below) * form.algebra.generators.expr(monomial)
    return factor, count


def _quotient(truth: Reference, expr: sp.Expr, i: int) -> tuple[sp.Expr, ...] | None:
    """The factor of a row that is a multiple of one right equation, from the coefficient of an acceleration."""
    if terms_of(expr) > 200:
        return None
    for c in truth.model.coordinates:
        above, below = bounded.diff(expr, c.acceleration), bounded.diff(truth.rows[i], c.acceleration)
        if below != 0 and above != 0:
            plain = above.is_number or above == below
            factor = above / below if plain else bounded.cancel(bounded.together(above / below))
            if terms_of(factor) <= 30:
                return _only(truth, i, factor)
    return None


def _solved(truth: Reference, expr: sp.Expr, A: Array) -> tuple[sp.Expr, ...] | None:
    """The factors from A M = ∂P/∂ξ̈, if they do not depend on the position."""
    by_set = A.reshape(SETS, PLACES, -1)
    if np.abs(by_set - by_set[:, :1]).max() > DOUBLE_TOLERANCE * np.abs(A).max():
        return None
    M = truth.derivation.mass_matrix
    slope = sp.Matrix([[bounded.diff(expr, c.acceleration) for c in truth.model.coordinates]])
    if slope.has(*truth.derivation.coordinates) or M.has(*truth.derivation.coordinates):
        return None
    if M.det() == 0:
        return None
    solved: Any = (slope * M.inv()).applyfunc(bounded.cancel)
    return tuple(solved)
