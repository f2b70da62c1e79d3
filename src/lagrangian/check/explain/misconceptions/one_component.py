"""The square of a velocity lacks a component."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant, half_square
from lagrangian.page.formula import Name, text

STEP = 2
WHY = text("All components of the velocity of a mass count in its energy.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Drop one component of the velocity of every body."""
    for body in s.bodies:
        velocity = s.velocity(body)
        moving = [k for k, v in enumerate(velocity) if v != 0]
        for k in moving if len(moving) > 1 else ():
            what = text(f"The {'xyz'[k]} component of the velocity of {body.title} is missing in ", Name("T*"), ".")
            yield Variant(what=what, T=-half_square(s.expand(body.mass), (velocity[k],)), element=body)
