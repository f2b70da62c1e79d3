"""Multiplies out sums of products as SymPy's expand does, in a fraction of its time, where that needs no other rule."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeAlias, cast

import sympy as sp

Monomial: TypeAlias = tuple[tuple[int, int], ...]
"""The numbers of the factors of a product, each with its exponent, in their order."""
Sum: TypeAlias = Mapping[Monomial, Any]
"""The coefficients of products."""


class _OutOfReachError(Exception):
    """An expression that needs other rules than those of sums and products."""


def multiplied_out(expr: sp.Expr) -> sp.Expr | None:
    """Return the sum of products that an expression of sums, products and powers with whole exponents equals; None
    where sums stand in a denominator or in a function, or where numbers are not exact."""
    factors: dict[sp.Basic, int] = {}
    try:
        found = _sum(expr, factors)
    except _OutOfReachError:
        return None
    bases = list(factors)
    terms = [sp.Mul(c, *[cast("Any", bases[k]) ** e for k, e in product]) for product, c in found.items()]
    return cast("sp.Expr", sp.Add(*terms))


def _sum(node: sp.Basic, factors: dict[sp.Basic, int]) -> Sum:
    """A node as a sum of products of ``factors``, to which its own are added."""
    if isinstance(node, sp.Add):
        total: dict[Monomial, Any] = {}
        for part in node.args:
            for product, c in _sum(part, factors).items():
                total[product] = total[product] + c if product in total else c
        return {product: c for product, c in total.items() if c != 0}
    if isinstance(node, sp.Mul):
        result: Sum = {(): sp.S.One}
        for part in node.args:
            result = _times(result, _sum(part, factors))
        return result
    if isinstance(node, sp.Rational):
        return {(): node}
    if isinstance(node, sp.Pow):
        base, exponent = node.args
        if isinstance(base, sp.Add):
            if exponent.p < 0:  # type: ignore[attr-defined]
                raise _OutOfReachError
            below = result = _sum(base, factors)
            for _ in range(int(cast("Any", exponent)) - 1):
                result = _times(result, below)
            return result
        return {((_place(base, factors), int(cast("Any", exponent))),): sp.S.One}
    return {((_place(node, factors), 1),): sp.S.One}


def _place(node: sp.Basic, factors: dict[sp.Basic, int]) -> int:
    """The number of a factor, in which nothing is to be multiplied out."""
    if node not in factors:
        if isinstance(node, sp.Number) or not node.is_commutative or any(map(_has_products, node.args)):
            raise _OutOfReachError
        factors[node] = len(factors)
    return factors[node]


def _has_products(node: sp.Basic) -> bool:
    """Whether an argument of a function holds a product or a power of a sum."""
    if isinstance(node, (sp.Mul, sp.Pow)) and any(isinstance(x, sp.Add) for x in node.args):
        return True
    return any(map(_has_products, node.args))


def _times(a: Sum, b: Sum) -> Sum:
    """The product of two sums."""
    if len(a) == 1 and () in a and a[()] == 1:
        return b
    total: dict[Monomial, Any] = {}
    for one, c in a.items():
        for other, d in b.items():
            powers = dict(one)
            for k, e in other:
                powers[k] = powers.get(k, 0) + e
            product = tuple(sorted((k, e) for k, e in powers.items() if e))
            value = c * d
            total[product] = total[product] + value if product in total else value
    return {product: c for product, c in total.items() if c != 0}
