"""The terms of a sum as they were written, and the pieces of which each consists when its products are multiplied out.

m (R − r) φ̈ + k (x − l) is two terms with four pieces: m R φ̈, −m r φ̈, k x and −k l. Functions stay as they are.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import product
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.records import dataclass

MOST_PIECES = 150
"""Sums with more pieces are not compared term by term in their own writing."""
HIGHEST = 4
"""Higher powers of sums are not multiplied out."""


@dataclass(frozen=True, eq=False)
class Summand:
    """A piece of the term with the place ``of`` in its sum."""

    of: int
    expr: sp.Expr


@dataclass(frozen=True, eq=False)
class WrittenTerm:
    """A term with its pieces, and its ``parts`` if it is a product with a sum: k x and −k l of k (x − l)."""

    expr: sp.Expr
    pieces: tuple[Summand, ...]
    parts: tuple[WrittenTerm, ...] = ()


def partner(f: sp.Expr) -> sp.Expr:
    """The cosine of the same angle for a sine, and the other way round."""
    return sp.cos(f.args[0]) if isinstance(f, sp.sin) else sp.sin(f.args[0])


def written_terms(expr: sp.Expr) -> tuple[sp.Expr, ...]:
    """The terms of a sum as they were written; those of a product in which the sum stands in brackets."""
    terms = [_signed(t) for t in sp.Add.make_args(expr) if t != 0]
    parts = _parts(terms[0]) if len(terms) == 1 else []
    return tuple(cast("sp.Expr", t) for t in (parts if len({*map(motion, parts)}) > 1 else terms))


def _signed(term: sp.Expr) -> sp.Expr:
    """A product with its sign in front: −(a + b) c for (−a − b) c."""
    factors = sp.Mul.make_args(term)
    negative = [f for f in factors if isinstance(f, sp.Add) and all(x.as_coeff_Mul()[0] < 0 for x in f.args)]
    rest = [f for f in factors if f not in negative]
    return sp.Mul((-1) ** len(negative), *rest, *[-f for f in negative]) if negative else term


def pieces(terms: Sequence[sp.Expr]) -> list[WrittenTerm] | None:
    """The terms with their pieces; None if these are too many."""
    found: list[WrittenTerm] = []
    count = 0
    for of, term in enumerate(terms):
        own = _divided(term, of)
        if own is None or (count := count + len(own.pieces)) > MOST_PIECES:
            return None
        found.append(own)
    return found


def _divided(term: sp.Expr, of: int) -> WrittenTerm | None:
    if not (parts := _parts(term)):
        products = _multiplied_out(term)
        if products is None:
            return None
        return WrittenTerm(term, tuple(Summand(of, x) for x in sp.Add.make_args(sp.Add(*products)) if x != 0))
    each = [_divided(p, of) for p in parts]
    known = [x for x in each if x is not None]
    if len(known) < len(each):
        return None
    return WrittenTerm(term, tuple(p for x in known for p in x.pieces), tuple(known))


def _parts(term: sp.Expr) -> list[sp.Expr]:
    """The terms of the sum with which a product is written, times the rest; a sum that moves comes first."""
    factors = sp.Mul.make_args(term)
    sums = [f for f in factors if isinstance(f, sp.Add)]
    if not sums:
        return []
    chosen = next((f for f in sums if f.has(AppliedUndef)), sums[0])
    rest = sp.Mul(*[f for f in factors if f is not chosen])
    return [_signed(cast("sp.Expr", rest * t)) for t in chosen.args]


def _multiplied_out(expr: sp.Expr) -> list[sp.Expr] | None:
    """The products of which a term is the sum; a sum in a denominator stays."""
    if isinstance(expr, sp.Add):
        parts = [_multiplied_out(cast("sp.Expr", x)) for x in expr.args]
        return None if None in parts else [x for p in parts if p is not None for x in p]
    if isinstance(expr, sp.Pow) and expr.exp.is_Integer and 1 < expr.exp <= HIGHEST and not expr.base.is_Symbol:
        factors = [expr.base] * int(expr.exp)
    elif isinstance(expr, sp.Mul):
        factors = list(expr.args)
    else:
        return [expr]
    if all(f.is_Atom or not f.has(sp.Add) for f in factors):
        return [expr]
    each = [_multiplied_out(cast("sp.Expr", f)) for f in factors]
    count = 1
    for x in each:
        if x is None or (count := count * len(x)) > MOST_PIECES:
            return None
    return [cast("sp.Expr", sp.Mul(*x)) for x in product(*(x for x in each if x is not None))]


def denominator(exprs: Iterable[sp.Expr]) -> sp.Expr:
    """What all products are to be multiplied by so that none has a denominator; numbers stay."""
    powers: dict[Any, Any] = {}
    for expr in exprs:
        for factor in sp.Mul.make_args(expr):
            base, exponent = factor.as_base_exp()
            if isinstance(exponent, sp.Rational) and exponent.p < 0 and not base.is_number:
                powers[base] = max(powers.get(base, 0), -exponent)
    return cast("sp.Expr", sp.Mul(*[b**e for b, e in powers.items()]))


def motion(expr: sp.Expr) -> sp.Expr:
    """The factors of a product that move: rates, accelerations, inputs and functions of coordinates."""
    moving = [f for f in sp.Mul.make_args(expr) if f.has(AppliedUndef)]
    return cast("sp.Expr", sp.Mul(*moving))


def rates(expr: sp.Expr) -> sp.Expr:
    """The rates, accelerations, coordinates and inputs that are factors of a product, without functions of them."""
    return cast("sp.Expr", sp.Mul(*[f for f in sp.Mul.make_args(motion(expr)) if not f.has(sp.sin, sp.cos, sp.tan)]))
