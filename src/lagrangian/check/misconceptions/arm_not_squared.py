"""A length or radius that comes with the square of a rate, not squared itself: ½ m L θ̇²."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian.check.misconceptions.base import Ingredients, Variant, letters
from lagrangian.page.formula import Name, text

STEP = 2
WHY = text("The velocity is Lθ̇ and the deflection Lθ, and it is squared as a whole: the arm comes squared as well.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Every body and every spring, with each parameter that stands squared in its energy."""
    for body in s.bodies:
        parts = [s.kinetic(body)]
        parts += [s.rotation(body), s.translation(body)] if s.rotation(body) != 0 else []
        for p, change in dict.fromkeys(x for part in parts for x in _unsquared(part)):
            what = text(p, f" is not squared in the energy of {body.title}, ", Name("T*"), ".")
            yield Variant(what=what, T=change, element=body)
    for spring, _, energy in s.springs():
        for p, change in _unsquared(energy):
            yield Variant(what=text(p, f" is not squared in the energy of {spring.title}."), V=change, element=spring)


def _unsquared(energy: sp.Expr) -> Iterator[tuple[sp.Expr, sp.Expr]]:
    """c₀ + c₁ p + c₂ p² with c₂ p in place of c₂ p²: the change, for every p; c₂ (1 − p²) besides."""
    for p in letters(energy):
        if not (energy * p**2).has(p):
            yield p, energy * (p - 1)
            yield p, energy * (p**2 - 1)
        second = energy.diff(p, 2)
        if second == 0 or second.has(p):
            continue
        yield p, second / 2 * (p - p**2)
        yield p, second / 2 * (1 - p**2)
