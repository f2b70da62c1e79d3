"""A prescribed motion is left out of the velocities."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant, half_square, put
from lagrangian.page.formula import text

STEP = 2
WHY = text(
    "A velocity is d/dt of a position: a motion that is prescribed in time, such as that of a shaken pivot, is "
    "part of it."
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Yield every body whose velocity does not vanish when all rates do."""
    for body in s.bodies:
        zero = dict.fromkeys(s.v, 0)
        velocity = s.velocity(body)
        free = tuple(put(x, zero) for x in velocity)
        if any(x != 0 for x in free):
            own = tuple(x - f for x, f in zip(velocity, free, strict=True))
            change = half_square(s.expand(body.mass), own) - s.translation(body)
            yield Variant(
                what=text(f"The prescribed motion is missing in the velocity of {body.title}."), T=change, element=body
            )
    yield from _everywhere(s)


def _everywhere(s: Ingredients) -> Iterator[Variant]:
    """Yield the same for all bodies together."""
    zero = dict.fromkeys(s.v, 0)
    change: sp.Expr = sp.S.Zero
    count = 0
    for body in s.bodies:
        velocity = s.velocity(body)
        own = tuple(x - put(x, zero) for x in velocity)
        count += own != velocity
        change = change + half_square(s.expand(body.mass), own) - s.translation(body)
    if count > 1:
        yield Variant(what=text("The prescribed motion is missing in the velocities of all bodies."), T=change)
