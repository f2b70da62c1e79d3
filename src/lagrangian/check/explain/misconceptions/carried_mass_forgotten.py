"""A mass that is carried along is left out of the equation of what carries it."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import text

STEP = 5
WHY = text(
    "Everything that is carried along must be accelerated too: add all masses, and of bodies that turn the moments of "
    "inertia, that move with this coordinate."
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Yield every body that several coordinates move, left out of one equation: its inertia, then also its weight."""
    for body in s.bodies:
        energy = s.kinetic(body)
        moving = [i for i, v in enumerate(s.v) if energy.has(v)]
        if len(moving) < 2 and not (moving and any(s.moves(x) for x in s.parent(body))):
            continue
        weight = sum((V for _, b, V in s.weights() if b is body), start=energy * 0)
        for i in moving:
            what = text(
                f"{body.title[:1].upper() + body.title[1:]} is missing from the equation of ",
                s.q[i],
                ", which moves it.",
            )
            yield Variant(what=what, T=-energy, only=frozenset({i}), element=body, coordinate=i)
            translation, rotation = s.coupling(body, i, i)
            own = (translation + rotation) * s.a[i]
            inertia = "mass" if rotation == 0 else "moment of inertia" if translation == 0 else "inertia"
            lacking = text(f"The {inertia} of {body.title} is missing before ", s.a[i], ".")
            yield Variant(what=lacking, rows={i: -own}, element=body, coordinate=i, stated=frozenset())
            if weight != 0:
                yield Variant(what=what, T=-energy, V=-weight, only=frozenset({i}), element=body, coordinate=i)
