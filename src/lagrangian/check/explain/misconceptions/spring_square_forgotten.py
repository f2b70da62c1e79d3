"""V = ½ k δ: the deflection is not squared."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import text

STEP = 3
WHY = text("The potential energy of a spring is proportional to the square of its deflection.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """For every linear spring; with and without the factor ½."""
    for spring, extension, V in s.springs():
        if spring.k is None:
            continue
        k = s.expand(spring.k)
        what = text(f"The deflection of {spring.title} is not squared in its energy.")
        yield Variant(what=what, V=k * extension / 2 - V, element=spring)
        yield Variant(what=what, V=k * extension - V, element=spring)
