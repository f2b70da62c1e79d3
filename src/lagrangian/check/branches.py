"""Distances are positive: √(p²) is simplified to p, and states are chosen with p > 0.

This is done for p = ±q + c, with one coordinate q, if the model contains the root of p², or if its mass matrix is
singular at p = 0, as in polar coordinates, and if p has the same sign at all ordinary states.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import reduce
from typing import Any, cast

import numpy as np
import sympy as sp
from sympy.polys.polyerrors import PolynomialError

from lagrangian import bounded
from lagrangian.derive.sampling import Array, CompiledExpressions, States
from lagrangian.records import dataclass

LONGEST = 80
"""The largest number of operations of an expression whose factors are examined."""


@dataclass(frozen=True)
class Branch:
    """A distance ``p`` = ±``q`` + c, which is positive; ``root`` says whether the model contains the root of its
    square."""

    q: sp.Expr
    p: sp.Expr
    root: bool

    def put(self, values: Array, states: States) -> Array:
        """Values of the coordinate, reflected at p = 0 where p would be negative; multiples of 2⁻¹², as in every
        state."""
        slope = int(_slope(self.p, self.q))
        c = CompiledExpressions([self.p - slope * self.q]).at(states)[0]
        p = np.abs(slope * values + c)
        return np.round((p - c) * slope * 4096) / 4096


def sides_of(exprs: Sequence[sp.Expr], M: sp.Matrix, states: States, q: Sequence[sp.Expr]) -> tuple[Branch, ...]:
    """The distances that can be recognized from expressions with roots and from a mass matrix, one for each
    coordinate."""
    found: dict[sp.Expr, Branch] = {}
    for root, p in (*((True, p) for p in _rooted(exprs)), *((False, p) for p in _singular(M, states, q))):
        of = [x for x in q if p.has(x)]
        if len(of) != 1 or of[0] in found or abs(_slope(p, of[0])) != 1 or (p - _slope(p, of[0]) * of[0]).has(*q):
            continue
        values = CompiledExpressions([p]).at(states)[0]
        if (values > 0).all() or (values < 0).all():
            found[of[0]] = Branch(of[0], p if values[0] > 0 else -p, root)
    return tuple(found.values())


def natural(expr: sp.Expr, sides: Sequence[Branch]) -> sp.Expr:
    """The expression with √(p²) and |p| replaced by p, for every distance p."""
    if not sides:
        return expr
    table: dict[sp.Basic, sp.Expr] = {}
    for f in expr.atoms(sp.Pow, sp.Abs):
        if isinstance(f, sp.Abs):
            if (p := _positive(cast("sp.Expr", f.args[0]), sides)) is not None:
                table[f] = p
        elif _is_root(f) and (factors := _squares(f.base)) is not None:
            number, parts = factors
            whole: sp.Expr = sp.sqrt(number)
            for part, power in parts:
                p = _positive(part, sides)
                whole *= (p if p is not None else sp.sqrt(part**2)) ** (power // 2)
            table[f] = whole ** (2 * f.exp)
    return cast("sp.Expr", expr.xreplace(table)) if table else expr


def _slope(p: sp.Expr, q: sp.Expr) -> sp.Expr:
    """The factor of q in p."""
    return cast("sp.Expr", p.coeff(q))


def _positive(p: sp.Expr, sides: Sequence[Branch]) -> sp.Expr | None:
    for side in sides:
        if bounded.expand(p - side.p) == 0 or bounded.expand(p + side.p) == 0:
            return side.p
    return None


def _is_root(f: sp.Basic) -> bool:
    return isinstance(f, sp.Pow) and isinstance(f.exp, sp.Rational) and f.exp.q == 2


def _squares(base: sp.Expr) -> tuple[sp.Expr, list[tuple[sp.Expr, int]]] | None:
    """A positive number and factors with even powers whose product is the base; None if it is not a square."""
    if bounded.operations(base) > LONGEST or not base.free_symbols or not base.is_polynomial(*_letters(base)):
        return None
    number, parts = _factors(base)
    if not number.is_positive or any(power % 2 for _, power in parts):
        return None
    return number, parts


def _factors(expr: sp.Expr) -> Any:
    """A number and factors with their powers; the expression itself if none are found in reasonable time."""

    def looked_for() -> Any:
        try:
            return sp.factor_list(expr)
        except PolynomialError:
            return None

    found = bounded.split(expr)
    if found is not None and not found[1]:
        return found[0], [(found[2], 1)]
    return bounded.searched(looked_for) or (sp.S.One, [(expr, 1)])


def _letters(expr: sp.Expr) -> list[sp.Basic]:
    return sorted(expr.free_symbols | expr.atoms(sp.Function), key=sp.default_sort_key)


def _rooted(exprs: Sequence[sp.Expr]) -> Iterator[sp.Expr]:
    roots: set[Any] = reduce(set.union, ({f for f in e.atoms(sp.Pow) if _is_root(f)} for e in exprs), set())
    for f in sorted(roots, key=sp.default_sort_key):
        for part, _ in (_squares(f.base) or (0, []))[1]:
            yield part


def _singular(M: sp.Matrix, states: States, q: Sequence[sp.Expr]) -> Iterator[sp.Expr]:
    """Factors ±q + c of the diagonal of the mass matrix at whose zeros the matrix is singular."""
    tried: dict[sp.Expr, None] = {}
    for i in range(M.rows):
        entry: Any = M[i, i]
        if entry.has(*q) and bounded.operations(entry) <= LONGEST:
            tried |= {part: None for part, _ in _factors(entry)[1] if any(_slope(part, x) in (1, -1) for x in q)}
    for p in tried:
        of = [x for x in q if p.has(x)]
        if len(of) != 1 or (rest := p - _slope(p, of[0]) * of[0]).has(of[0]):
            continue
        there = {of[0]: -rest / _slope(p, of[0])}
        flat, usual = _determinants(sp.Matrix(M.xreplace(there)), states), _determinants(M, states)
        if np.isfinite(flat).all() and (np.abs(flat) <= 1e-12 * np.abs(usual)).all():
            yield p


def _determinants(M: sp.Matrix, states: States) -> Array:
    """det M at every state."""
    entries: list[Any] = list(M.flat())
    values = CompiledExpressions(entries).at(states).reshape(M.rows, M.rows, states.size).transpose(2, 0, 1)
    return np.linalg.det(np.where(np.isfinite(values), values, np.nan))
