"""Speeds of bodies that move along one line, told by themselves and not by their squares: ẋ, not ẋ − ½ R θ̇."""

from __future__ import annotations

from dataclasses import replace
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.sayable import Sayable


def plain_speed(q: Sayable, written: sp.Expr) -> tuple[Sayable, sp.Expr]:
    """A speed whose square is that of one term or sum, and what is written of it, as it is counted there; the square
    of the speed and what is written of that, if either is no such square."""
    right, own = root(q.right) or root(bounded.expand(q.right)), root(written)
    if right is None or own is None or q.owner is None:
        return q, written
    away = [len(sp.Add.make_args(bounded.expand(own - sign * right))) for sign in (1, -1)]
    counted = right if away[0] <= away[1] else -right
    title = " and ".join((q.owner.title, *q.also))
    return replace(q, words=(f"speed of {title}",), right=cast("sp.Expr", counted)), own


def root(square: sp.Expr) -> sp.Expr | None:
    """What is squared in a product of squares; None for anything else."""
    number, factors = square.as_coeff_mul()
    own = sp.sqrt(number)
    powers = [f.as_base_exp() for f in factors]
    if not own.is_Rational or not powers or any(not n.is_Integer or n % 2 for _, n in powers):
        return None
    return cast("sp.Expr", sp.Mul(own, *[x ** (n / 2) for x, n in powers]))
