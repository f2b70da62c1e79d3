"""Centrifugal or Coriolis terms are left out."""

from __future__ import annotations

from collections.abc import Iterator
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, Variant, put
from lagrangian.page.formula import text

STEP = 5
WHY = text(
    "If T* depends on the coordinates, the equations contain squares of rates (centrifugal terms) and products of two "
    "rates (Coriolis terms)."
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Drop all of them, the squares, or the products, everywhere and in each equation; halve the products."""
    squares, products = zip(*[velocity_terms(s, i) for i in range(s.n)], strict=True)
    both = tuple(a + b for a, b in zip(squares, products, strict=True))
    kinds = ((both, "products of rates"), (squares, "centrifugal terms"), (products, "Coriolis terms"))
    for parts, words in kinds:
        held = {i: x for i, x in enumerate(parts) if x != 0}
        if parts is not both and tuple(parts) == both:
            continue
        if len(held) > 1:
            yield Variant(what=text(f"The {words} are missing."), rows={i: -x for i, x in held.items()})
        for i, x in held.items():
            what = text(f"The {words} are missing in the equation of ", s.q[i], ".")
            yield Variant(what=what, rows={i: -x}, coordinate=i)


def velocity_terms(s: Ingredients, i: int) -> tuple[sp.Expr, sp.Expr]:
    """The result of `_velocity_terms`, computed once."""
    return s.kept(("velocity terms", i), lambda: _velocity_terms(s, i))


def _velocity_terms(s: Ingredients, i: int) -> tuple[sp.Expr, sp.Expr]:
    """The squares of rates and the products of two rates in equation i: Σ_jk (∂²T/∂ξ̇_i∂ξ̇_j)_k ξ̇_j ξ̇_k − ∂T/∂ξ_i."""
    whole = _with_rates(s, i)
    squares: list[sp.Expr] = []
    products: list[sp.Expr] = []
    for j in range(s.n):
        slope = bounded.diff(whole, s.v[j])
        for k in range(j, s.n):
            factor = bounded.diff(slope, s.v[k])
            if factor == 0:
                continue
            (squares if j == k else products).append(factor * s.v[j] * s.v[k] / (2 if j == k else 1))
    return sp.Add(*squares), sp.Add(*products)


def turned_terms(s: Ingredients, i: int) -> sp.Expr:
    """The terms of one rate in equation i that a given rotation brings, such as −2mΩẏ in rotating axes."""
    whole, still = _with_rates(s, i), dict.fromkeys(s.v, sp.S.Zero)
    return sp.Add(*[put(bounded.diff(whole, v), still) * v for v in s.v])


def _with_rates(s: Ingredients, i: int) -> sp.Expr:
    """Σ_k ∂p_i/∂ξ_k ξ̇_k − ∂T/∂ξ_i."""
    moved = sp.Add(*[bounded.diff(s.momenta[i], s.q[k]) * s.v[k] for k in range(s.n)])
    return cast("sp.Expr", moved - bounded.diff(s.T, s.q[i]))
