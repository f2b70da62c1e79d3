"""A cosine or sine in T* has the wrong angle: θ₁ + θ₂ for θ₁ − θ₂, or one angle for the difference."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant, put
from lagrangian.page.formula import Name, text

STEP = 2
WHY = text(
    "The angle between two velocities is the difference of their absolute directions; with a relative angle that "
    "difference is the relative angle itself."
)

WHY_HEIGHT = text(
    "The angle in a height or a deflection is counted from a fixed direction: an absolute angle is the sum of the "
    "relative ones."
)
"""For V."""


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Replace every angle of T* and of V by others."""
    for energy, key in ((s.T, "T"), (s.V, "V")):
        for angle in s.angles(energy):
            for other in _others(s, angle):
                changed = put(energy, {sp.sin(angle): sp.sin(other), sp.cos(angle): sp.cos(other)})
                if changed == energy:
                    continue
                name = Name("T*" if key == "T" else "V")
                what = text(name, " contains the angle ", other, " where ", angle, " belongs.")
                if key == "T":
                    yield Variant(what=what, T=changed - energy)
                else:
                    yield Variant(what=what, V=changed - energy, why=WHY_HEIGHT)


def _others(s: Ingredients, angle: sp.Expr) -> list[sp.Expr]:
    """The angle with the sign of one coordinate reversed, without it, or with another one added or subtracted."""
    found: list[sp.Expr] = []
    turning = [q for q in s.q if any(a.has(q) for a in (*s.angles(s.T), *s.angles(s.V)))]
    held = [q for q in turning if angle.has(q)]
    for q in held if len(held) > 1 else ():
        found += [put(angle, {q: -q}), put(angle, {q: sp.S.Zero})]
    found += [angle + sign * q for q in turning if q not in held for sign in (1, -1)]
    return [a for a in dict.fromkeys(found) if a != 0 and a != -angle]
