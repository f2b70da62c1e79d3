"""The rest length of a spring is forgotten."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.model.elements.spring import DELTA
from lagrangian.page.formula import text

STEP = 3
WHY = text("The energy of a spring is proportional to the square of its deflection from its neutral point.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Drop the rest length of every spring that has one; also reverse its sign."""
    for spring, extension, V in s.springs():
        rest = s.expand(spring.rest)
        if rest == 0:
            continue
        for changed, words in (
            (extension + rest, "is missing"),
            (extension + 2 * rest, "has the wrong sign"),
        ):
            energy = spring.k * changed**2 / 2 if spring.k is not None else spring.energy.subs(DELTA, changed)
            yield Variant(
                what=text("The rest length ", rest, f" of {spring.title} {words}."),
                V=s.expand(energy) - V,
                element=spring,
            )
