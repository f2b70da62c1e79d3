"""Explains a single wrong row among rows that are solved for one acceleration each: a slip in its numerator.

The right row is ξ̈_i − a_i with a = −M⁻¹h, and W = M ξ̈ + h. So a change of h alone by ΔW_k adds (M⁻¹)_ik ΔW_k to it.
A term of h stands in the numerator times (adj M)_ik, if the denominator is det M or a multiple of it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any, cast

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.align import CONSTANT, LARGEST
from lagrangian.check.explain.changes.pool import Pool
from lagrangian.check.explain.own_terms import OwnTerm, foreign_names, in_place
from lagrangian.check.explain.right_terms import RightTerm, RightTerms, right_terms
from lagrangian.check.explain.search import EXOTIC, SMALL, Explanation, simple_number, singles
from lagrangian.check.explain.solved import NAME as BELOW
from lagrangian.check.explain.solved import TERM_NAME as TERM_BELOW
from lagrangian.check.reference import Reference, terms
from lagrangian.check.verdict import Finding, Mistake
from lagrangian.derive.sampling import SETS, Array, CompiledExpressions
from lagrangian.page.formula import text
from lagrangian.records import dataclass

MOST_COORDINATES = 3
"""The adjugate of a larger mass matrix has more terms than anybody writes."""
LONGEST = 400
"""The largest number of terms of a numerator that is examined."""
MOST_RIGHT_TERMS = 300
MOST_PIECES = 12
"""The most terms of a bracket of which one may be wrong."""
SOLVED = "In what is solved for "
"""How a mistake begins that is told of a row solved for one acceleration."""
SURE = 3.0
"""A term that is missing, has the wrong sign, number or a factor too much is told before a cause further above."""


@dataclass(frozen=True, eq=False)
class SolvedRow:
    """A row ξ̈_i − N/D of the answer: ``expr`` is N, ``below`` is D."""

    i: int
    acceleration: sp.Expr
    expr: sp.Expr
    below: sp.Expr
    rest: Array
    """How much the written acceleration is too large, at every state."""


def solved_row(truth: Reference, expr: sp.Expr, *, single: bool = False) -> SolvedRow | None:
    """A row that holds one acceleration, alone and linear, while the right one holds several; None for any other.

    ``single``: or while the right one holds that one alone, times a sum.
    """
    held = [i for i, c in enumerate(truth.model.coordinates) if expr.has(c.acceleration)]
    if len(held) != 1 or truth.n > MOST_COORDINATES or terms(expr) > 4 * LONGEST or foreign_names(truth, expr):
        return None
    i = held[0]
    acceleration = cast("sp.Expr", truth.model.coordinates[i].acceleration)
    several = sum(truth.rows[i].has(c.acceleration) for c in truth.model.coordinates) > 1
    if not several and not single:
        return None
    slope = bounded.diff(expr, acceleration)
    if slope.has(acceleration) or slope == 0:
        return None
    quotient = -cast("sp.Expr", expr.xreplace({acceleration: sp.S.Zero})) / slope
    above, below = _fraction(quotient)
    if max(map(terms, (expr, above) if several else (above, below))) > LONGEST:
        return None
    if not several and (not slope.is_number or not below.has(sp.Add) or len(sp.Add.make_args(quotient)) > 1):
        return None  # no numerator was written, or the equation itself was divided
    written = CompiledExpressions([cast("sp.Expr", above / below)]).at(truth.states)[0]
    rest = written - truth.accelerations[acceleration]
    if not np.isfinite(rest).all() or np.abs(rest).max() > LARGEST:
        return None
    return SolvedRow(i, acceleration, above, below, rest)


def _fraction(quotient: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
    """Numerator and denominator as they were written: a sum of fractions whose denominators are products has none."""
    parts = [sp.fraction(t) for t in sp.Add.make_args(quotient)]
    denominators = {below for _, below in parts}
    if len(denominators) == 1:
        return cast("sp.Expr", sp.Add(*[above for above, _ in parts])), cast("sp.Expr", parts[0][1])
    if not any(below.has(sp.Add) for below in denominators):
        return quotient, sp.S.One
    above, below = sp.fraction(bounded.together(quotient))
    return cast("sp.Expr", above), cast("sp.Expr", below)


def in_numerator(pool: Pool, expr: sp.Expr) -> tuple[list[Explanation], list[OwnTerm]]:
    """The mistakes of which one solved row is the consequence, the likeliest first, or a term of its numerator."""
    row = solved_row(pool.truth, expr)
    if row is None or np.abs(row.rest).max() <= 1e-9:
        return [], []
    inverse = _inverse(pool.truth)[row.i]  # (n, S)
    effects = np.einsum("ks,cks->cs", inverse, pool.W)
    explained = singles(pool, [effects], -row.rest)
    own = _own(pool, row)
    if own is not None and (own.cost <= SURE or not explained or own.cost < explained[0].cost):
        return [], [own]
    return [e for e in explained if e.cost <= EXOTIC], []  # a pair that fits one row alone may be an accident


def own_in_numerator(pool: Pool, expr: sp.Expr) -> OwnTerm | None:
    """The term of the numerator of a solved row that is wrong."""
    row = solved_row(pool.truth, expr, single=True)
    return _own(pool, row) if row is not None and np.abs(row.rest).max() > 1e-9 else None


def multiplied(truth: Reference, expr: sp.Expr) -> tuple[sp.Expr, sp.Expr] | None:
    """A solved row times its denominator, D ξ̈_i − N, and the right one in the same scale, to be compared by terms.

    None if it is no solved row, or if D is not det M times a number or a product of letters.
    """
    row = solved_row(truth, expr)
    if row is None:
        return None
    scale = _scale(truth, row, _ratio(truth, row))
    if scale is None:
        return None
    still = {c.acceleration: sp.S.Zero for c in truth.model.coordinates}
    minors: Any = truth.mass_matrix.adjugate()
    h = [cast("sp.Expr", r.xreplace(still)) for r in truth.rows]
    right = truth.determinant * row.acceleration + sp.Add(*[minors[row.i, k] * h[k] for k in range(truth.n)])
    return row.below * row.acceleration - row.expr, cast("sp.Expr", scale * right)


def _ratio(truth: Reference, row: SolvedRow) -> Array:
    """The denominator of a row divided by det M at every state."""
    values = CompiledExpressions([row.below, truth.determinant]).at(truth.states)
    with np.errstate(all="ignore"):
        return np.asarray(values[0] / values[1])


def said_of(truth: Reference, mistake: Mistake, expr: sp.Expr) -> Mistake:
    """A mistake of a solved row, with the row named in its words."""
    row = solved_row(truth, expr, single=True)
    if row is None:
        return mistake
    first, *more = mistake.what.parts
    words = (first[:1].lower() + first[1:], *more) if isinstance(first, str) and first[:2] != "T*" else (first, *more)
    name = truth.model.coordinates[row.i].name
    several = solved_row(truth, expr) is not None
    where = (SOLVED, row.acceleration, " alone: ") if several else ("In the numerator of ", row.acceleration, ": ")
    what = text(*where, *words)
    return replace(mistake, what=what, coordinate=name)


def _inverse(truth: Reference) -> Array:
    """M⁻¹ at every state, (n, n, S)."""
    compiled = CompiledExpressions(truth.rows).slopes([c.acceleration for c in truth.model.coordinates])
    M = compiled.at(truth.states).reshape(truth.n, truth.n, -1).transpose(2, 0, 1)
    inverse: Array = np.asarray(np.linalg.inv(M), dtype=np.float64)
    return inverse.transpose(1, 2, 0)


def _own(pool: Pool, row: SolvedRow) -> OwnTerm | None:
    """A term of the numerator that is wrong, if the denominator is right: but for a factor of letters, it is det M."""
    truth = pool.truth
    ratio = _ratio(truth, row)
    below = CompiledExpressions([row.below]).at(truth.states)[0]
    if not np.isfinite(ratio).all() or np.ptp(ratio.reshape(SETS, -1), axis=1).max() > CONSTANT * np.abs(ratio).max():
        return None
    parts = [*sp.Add.make_args(row.expr), *sp.Add.make_args(bounded.expand(row.expr)), *_pieces(row.expr)]
    written = [t for t in dict.fromkeys(parts) if t != 0]
    values = CompiledExpressions(written).at(truth.states)
    listed = [(t, v) for t, v in zip(written, values, strict=True) if np.isfinite(v).all()]
    rest = row.rest * below
    scale = _scale(truth, row, ratio)
    found = in_place(pool, listed, rest, "numerator", row.i, _right(pool, row, scale)) if scale is not None else None
    if found is not None and found.instead is not None and found.term == 0:
        gone = _values(truth, found.instead[0])
        left = next((t for t, v in listed if np.abs(v + gone).max() <= SMALL * np.abs(v).max()), None)
        found = found if left is None else OwnTerm(row.i, 5, left)  # both cancel in the right one
    if found is not None and found.cost <= SURE:
        return found
    for t, v in listed:
        c = float(v @ rest) / float(v @ v) if v.any() else 0.0
        number = simple_number(c)
        if t != row.expr and number is not None and np.abs(rest - c * v).max() <= SMALL * np.abs(rest).max():
            return OwnTerm(row.i, 5, t, number)
    return found


def _values(truth: Reference, expr: sp.Expr) -> Array:
    """An expression at every state."""
    values: Array = CompiledExpressions([expr]).at(truth.states)[0]
    return values


def _pieces(expr: sp.Expr) -> Iterator[sp.Expr]:
    """The terms of one bracket in a product, with the rest of this as it stands: of what was put in for another one."""
    for term in sp.Add.make_args(expr):
        for bracket in [x for x in sp.Mul.make_args(term) if x.is_Add]:
            yield from (cast("sp.Expr", x * term / bracket) for x in sp.Add.make_args(bracket)[:MOST_PIECES])


def _scale(truth: Reference, row: SolvedRow, ratio: Array) -> sp.Expr | None:
    """D / det M, a number or a product of powers of letters."""
    if not np.isfinite(ratio).all() or np.ptp(ratio.reshape(-1, truth.states.motions), axis=1).max() > 1e-6:
        return None
    if np.ptp(ratio) <= CONSTANT * np.abs(ratio).max():
        number = sp.nsimplify(float(np.round(ratio[0], 9)), rational=True)
        return number if isinstance(number, sp.Rational) and number.q <= 144 else None
    found: Any = bounded.cancel(row.below / truth.determinant)
    if terms(found) > 1:
        return None
    values = CompiledExpressions([found]).at(truth.states)[0]
    return cast("sp.Expr", found) if np.allclose(values, ratio, rtol=SMALL) else None


def _right(pool: Pool, row: SolvedRow, scale: sp.Expr) -> RightTerms:
    """The terms of the right numerator, as products with the minors of M, and written out."""
    minors: Any = pool.truth.mass_matrix.adjugate()
    listed: list[RightTerm] = []
    for k in range(pool.truth.n):
        minor = cast("sp.Expr", minors[row.i, k])
        if minor != 0:
            listed += _products(pool, k, cast("sp.Expr", scale * minor))
    ordered = sorted(listed, key=lambda t: t.cost)[:MOST_RIGHT_TERMS]
    values = CompiledExpressions([t.expr for t in ordered]).at(pool.truth.states)
    good = [j for j, v in enumerate(values) if np.isfinite(v).all() and np.abs(v).max() > 1e-12]
    return RightTerms(tuple(ordered[j] for j in good), values[good])


def _products(pool: Pool, k: int, factor: sp.Expr) -> Iterator[RightTerm]:
    """The terms of equation k without accelerations, times −``factor``; those of the product one by one as well."""
    accelerations = [c.acceleration for c in pool.truth.model.coordinates]
    for t in right_terms(pool, "equation", k).terms:
        expr = pool.truth.put(t.expr)
        if expr.has(*accelerations):
            continue
        product = factor * expr
        yield replace(t, expr=cast("sp.Expr", -product))
        single = sp.Add.make_args(bounded.expand(-product))
        for part in single if 1 < len(single) <= 12 else ():
            yield replace(t, expr=part, cost=t.cost + 0.3)


def by_numerators(pool: Pool, exprs: Sequence[sp.Expr]) -> list[tuple[sp.Expr, Explanation | OwnTerm]]:
    """For every wrong solved row what explains it; nothing unless all that are wrong are explained."""
    found: list[tuple[sp.Expr, Explanation | OwnTerm]] = []
    for expr in exprs:
        row = solved_row(pool.truth, expr)
        if row is None:
            return []
        if np.abs(row.rest).max() <= 1e-9 * (1 + np.abs(pool.truth.accelerations[row.acceleration]).max()):
            continue
        explained, own = in_numerator(pool, expr)
        best = (explained or own)[:1]
        if not best:
            return []
        found += [(expr, x) for x in best]
    return found


def of_solved(told: Sequence[Mistake]) -> list[Mistake]:
    """The mistakes in rows that are solved for one acceleration alone, and in what multiplies that."""
    return [m for m in told if m.what.parts[:1] == (SOLVED,) or m.name in (BELOW, TERM_BELOW)]


def without_other_terms(findings: Sequence[Finding], told: Sequence[Mistake]) -> tuple[Finding, ...]:
    """The findings; where a row is explained as solved for one acceleration alone, or by what multiplies that, no terms
    are told in which it differs from an equation with several: the row is none."""
    if not of_solved(told):
        return tuple(findings)
    several = [f.line.kind == "equation" and len(f.differences) > 1 and not f.status.right for f in findings]
    return tuple(replace(f, differences=()) if x else f for f, x in zip(findings, several, strict=True))
