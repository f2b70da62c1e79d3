"""Sums of products that have no factor but a number and letters, which is seen without a search."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownArgumentType=false

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from functools import reduce
from math import gcd, lcm
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

_PLAIN = (sp.Symbol, AppliedUndef, sp.Derivative, sp.sin, sp.cos)


def split(expr: sp.Expr) -> tuple[sp.Rational, dict[sp.Expr, int], sp.Expr] | None:
    """The number, the powers of letters and the irreducible sum whose product an expression is; None if this is not
    seen at once.

    A sum in which a letter stands once, in one term, is a·x + b with a product a: its only factors are those of both.
    The sum has whole numbers and the sign that `sympy.factor` gives it.
    """
    read = [_product(t) for t in expr.args] if isinstance(expr, sp.Add) else []
    if not read or any(x is None for x in read):
        return None
    listed = cast("list[tuple[sp.Rational, Counter[sp.Expr]]]", read)
    shared = reduce(lambda a, b: a & b, (powers for _, powers in listed))
    rest = [(c, powers - shared) for c, powers in listed]
    times = Counter(x for _, powers in rest for x in powers)
    if not any(n == 1 and any(powers[x] == 1 for _, powers in rest) for x, n in times.items()):
        return None
    above, below = (gcd(*[int(c.p) for c, _ in listed]), lcm(*[int(c.q) for c, _ in listed]))
    number = sp.Rational(above, below) * _sign(expr)
    terms = [sp.Mul(c / number, *[x**e for x, e in powers.items()]) for c, powers in rest]
    return number, dict(shared), cast("sp.Expr", sp.Add(*terms))


def _product(term: Any) -> tuple[sp.Rational, Counter[sp.Expr]] | None:
    """A number and the powers of letters; None if a term is anything else."""
    number, factors = cast("tuple[Any, Sequence[Any]]", term.as_coeff_mul())
    powers: Counter[sp.Expr] = Counter()
    for f in factors:
        base, exponent = f.as_base_exp()
        if not isinstance(base, _PLAIN) or not isinstance(exponent, sp.Integer) or int(exponent) < 1:
            return None
        powers[base] += int(exponent)
    return (number, powers) if isinstance(number, sp.Rational) else None


def _sign(expr: sp.Expr) -> int:
    """The sign of the term that SymPy counts as the leading one."""
    return 1 if sp.Poly(expr).LC() > 0 else -1


def product(expr: sp.Expr) -> sp.Expr | None:
    """What `sympy.factor` makes of an expression that `split` splits; None if it is to be sought."""
    found = split(expr)
    if found is None:
        return None
    number, letters, whole = found
    if not letters:
        return expr if abs(number) == 1 else None  # SymPy would multiply 2 (x + y) out again
    return cast("sp.Expr", sp.Mul(number, *[x**e for x, e in letters.items()], whole))
