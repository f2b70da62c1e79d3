"""A damper is counted in V, as if it stored energy."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant, negative
from lagrangian.model import Damper
from lagrangian.page.formula import Name, text

STEP = 3
WHY = text("A damper stores nothing: it has no potential energy, and belongs only to Ξ.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Add ½ b δ² or ½ b δ̇² to V, instead of the damper's Ξ or in addition to it."""
    for element in s.acting:
        if not isinstance(element, Damper) or element.b is None:
            continue
        b, shares = s.expand(element.b), s.shares(element)
        delta, rate = s.expand(element.displacement(s.model)), s.expand(element.rate(s.model))
        what = text(f"{element.title[:1].upper() + element.title[1:]} is counted in ", Name("V"), ".")
        for gone in (negative(shares), {}):
            yield Variant(what=what, V=b * delta**2 / 2, Xi=gone, element=element)
            yield Variant(what=what, T=-b * rate**2 / 2, Xi=gone, element=element, stated=frozenset({"L", "Xi"}))
        yield Variant(what=what, V=b * rate**2 / 2, element=element)
