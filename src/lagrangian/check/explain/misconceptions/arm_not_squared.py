"""A length or radius that belongs with the square of a rate is not squared, or missing: ½ m L θ̇² for ½ m L² θ̇²."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, Variant, letters
from lagrangian.page.formula import Name, text

STEP = 2
WHY = text(
    "An arm makes a velocity of an angular velocity, and a deflection of an angle; of what rolls, the radius does. The "
    "whole is squared, and the arm with it."
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Yield every body and every spring with each parameter that is squared in its energy."""
    for body in s.bodies:
        parts = [s.kinetic(body)]
        parts += [s.rotation(body), s.translation(body)] if s.rotation(body) != 0 else []
        for p, change, absent in dict.fromkeys(x for part in parts for x in _unsquared(part)):
            what = text(*_said(p, absent), f" in the energy of {body.title}, ", Name("T*"), ".")
            yield Variant(what=what, T=change, element=body)
    for spring, _, energy in s.springs():
        for p, change, absent in _unsquared(energy):
            what = text(*_said(p, absent), f" in the energy of {spring.title}.")
            yield Variant(what=what, V=change, element=spring)


def _said(p: sp.Symbol, absent: bool) -> tuple[str | sp.Expr, ...]:
    return ("The arm ", p, " is missing") if absent else (p, " is not squared")


def _unsquared(energy: sp.Expr) -> Iterator[tuple[sp.Symbol, sp.Expr, bool]]:
    """For each p in c₀ + c₁ p + c₂ p², the change if c₂ p replaces c₂ p², or c₂ (p is absent); so for c/p²."""
    for p in letters(energy):
        if not (energy * p**2).has(p):
            yield p, energy * (p - 1), False
            yield p, energy * (p**2 - 1), True
        second = bounded.diff(energy, p, p)
        if second == 0 or second.has(p):
            continue
        yield p, second / 2 * (p - p**2), False
        yield p, second / 2 * (1 - p**2), True
