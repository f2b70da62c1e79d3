"""Whether an equation follows from the equations of motion in a special case: at rest, for θ = 90°, with b = 0.

A case gives some coordinates, rates, accelerations, inputs or constants values. The motions in which it holds are where
the rows of the system vanish with these values, r(z) = 0, in all else that moves or is constant, z. Random z are taken
there by Newton's steps of least length, z − J⁺ r, with J = ∂r/∂z, that rather change what moves than constants; an
equation follows if it holds at all of them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, cast

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.reference import Reference
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.errors import ModelError

STEPS = 60
"""The most steps of Newton's method."""
LONGEST_STEP = 0.7
"""The longest step, compared with what it changes, or with one."""
CLOSE = 1e-11
"""At which size, compared with its terms, a row vanishes."""
EXACT = 1e-8
"""At which size, compared with its terms, an equation in letters holds."""
ROUNDED = 0.006
"""The same of one with rounded numbers."""
FEWEST = 6
"""The fewest states at which an equation has to hold."""
STIFF = 0.2
"""How far a constant is moved, compared with what moves."""
LEAST = 0.05
"""Smaller values of constants, which are positive, are those of another case."""
_MOVES = "moves "
"""How the symbols begin that stand for what moves."""
INFINITE = sp.Integer(10**8)
"""What stands for an infinite constant."""
NEAR = 1e-5
"""Up to which size an equation holds where a constant is infinite."""
LONG = 2_000
"""The size of rows and equations above which nothing is sought."""


def follows(truth: Reference, expr: sp.Expr, given: Mapping[Any, sp.Expr]) -> bool:
    """Whether an expression is 0 in all motions in which what moves and constants have the values that are ``given``.

    It has to follow from the equations of motion, not from these values alone; with decimal numbers, it does with the
    values of the system, within what is rounded.
    """
    if truth.derivation.multipliers or bounded.hard([expr], LONG) or bounded.hard(truth.rows, LONG):
        return False
    names = _names(truth, expr)
    if names is None:
        return False
    rounded, limit = bool(expr.atoms(sp.Float)), any(abs(x) == INFINITE for x in given.values())
    values = {p.symbol: sp.Float(p.value) for p in truth.model.parameters if rounded and p.value is not None}
    put = names | values | {x: cast("sp.Expr", v.xreplace(names).xreplace(values)) for x, v in given.items()}
    rows = [x for x in (bounded.expand(_put(row, put)) for row in truth.rows) if x != 0]
    own = bounded.expand(_put(expr, put))
    if own == 0:
        return False  # it only says the case
    terms = [cast("sp.Expr", x) for x in sp.Add.make_args(own)]
    if any(x.has(sp.nan, sp.zoo, sp.oo) for x in (*rows, *terms)):
        return False
    symbols = sorted(set[Any]().union(*(x.free_symbols for x in (*rows, *terms))), key=str)
    try:
        found = _where_all_vanish(truth, rows, symbols)
        at = dict(zip(symbols, found, strict=True))
        T = CompiledExpressions(terms).at(truth.states, at) if symbols else np.array([[float(sp.N(x))] for x in terms])
    except (ModelError, TypeError):
        return False
    good = np.isfinite(T).all(axis=0) & np.isfinite(found).all(axis=0) if symbols else np.isfinite(T).all(axis=0)
    near = np.maximum((ROUNDED if rounded else EXACT) * np.abs(T).sum(axis=0), NEAR if limit else 0.0)
    holds = np.abs(T.sum(axis=0)) <= near
    return bool(good.sum() >= min(FEWEST, good.size) and holds[good].all())


def _names(truth: Reference, expr: sp.Expr) -> dict[Any, sp.Expr] | None:
    """A symbol for everything that moves; None if the expression holds what the system does not have."""
    moving = [x for c in truth.model.coordinates for x in (c.acceleration, c.rate, c.symbol)]
    moving += [u.symbol for u in truth.model.inputs]
    if not bounded.letters(expr) <= truth.names or not expr.atoms(sp.Derivative) <= set(moving):
        return None
    return {x: sp.Symbol(f"{_MOVES}{k}") for k, x in enumerate(moving)}


def _put(expr: sp.Expr, put: Mapping[Any, sp.Expr]) -> sp.Expr:
    """An expression with values, those of derivatives first."""
    rates = {x: v for x, v in put.items() if isinstance(x, sp.Derivative)}
    return cast("sp.Expr", expr.xreplace(rates).xreplace(dict(put)))


def _where_all_vanish(truth: Reference, rows: Sequence[sp.Expr], symbols: Sequence[Any]) -> Array:
    """Values of the symbols, shape (symbols, size), at which all rows vanish; NaN where none were found."""
    source = np.random.default_rng(len(symbols))
    size = truth.states.size
    constant = np.array([not str(x).startswith(_MOVES) for x in symbols], bool)
    z = np.array([source.uniform(0.4 if fixed else -1.6, 1.6, size) for fixed in constant])
    if not rows:
        return z
    compiled = CompiledExpressions(rows)
    slopes = compiled.slopes(symbols)
    n, m = len(rows), len(symbols)
    weights = np.where(constant, STIFF, 1.0)
    for _ in range(STEPS):
        at = dict(zip(symbols, z, strict=True))
        r, J = compiled.at(truth.states, at), slopes.at(truth.states, at).reshape(n, m, size)
        J = np.where(np.isfinite(J), J, 0.0).transpose(2, 0, 1) * weights
        known = np.where(np.isfinite(r), r, 0.0)
        step = -np.einsum("smn,ns->ms", np.linalg.pinv(J, rcond=1e-12), known) * weights[:, None]
        length = (np.abs(step) / np.maximum(np.abs(z), 1.0)).max(axis=0)
        z = z + step * np.minimum(1.0, LONGEST_STEP / np.maximum(length, 1e-300))
        if length.max() < 1e-14:
            break
    at = dict(zip(symbols, z, strict=True))
    r, J = compiled.at(truth.states, at), slopes.at(truth.states, at).reshape(n, m, size)
    scale = np.maximum(np.abs(J * z[None]).max(axis=1), 1e-6)
    there = (np.abs(r) <= CLOSE * np.maximum(scale, 1.0)).all(axis=0) & (z[constant] > LEAST).all(axis=0)
    z[:, ~there] = np.nan
    return z
