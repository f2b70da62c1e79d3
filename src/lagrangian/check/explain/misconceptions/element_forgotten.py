"""An element is left out completely."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant, negative
from lagrangian.model import Gravity
from lagrangian.model.elements.raw import Energy
from lagrangian.page.formula import text

STEP = 2
WHY = text("Every element belongs to exactly one of T*, V and Ξ: go through the sketch and count each once.")
WHY_ROW = text(
    "It belongs in the equation of every coordinate that moves one of its ends, or the point on which it acts, not in "
    "one of them alone. Change the coordinate of this equation alone: does the element do work then?"
)
"""For what is missing in one equation and stands in another."""


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Drop every element, every body with its weight, and every element in one equation only."""
    weight: dict[object, object] = {}
    for _, body, V in s.weights():
        weight[body] = weight.get(body, 0) + V  # type: ignore[operator]
    for element in s.model.elements:
        title = element.title[:1].upper() + element.title[1:]
        what = text(f"{title} is missing.")
        if isinstance(element, Gravity):
            continue
        if element.ledger == "T*":
            if element in weight:
                yield Variant(what=what, T=-s.kinetic(element), V=-weight[element], element=element)  # type: ignore[operator]
            own = s.kinetic(element)
            raw = text("The part ", own, " of T* is missing.")  # an energy that is given has no other name
            whole = raw if isinstance(element, Energy) else text(f"{title} is missing in T*.")
            yield Variant(what=whole, T=-own, element=element)
        elif element.ledger == "V":
            V = s.expand(element.potential(s.model))
            yield Variant(what=what, V=-V, element=element)
            rows = [i for i, q in enumerate(s.q) if V.has(q)]
            for i in rows if len(rows) > 1 else ():
                what = text(f"{title} is missing in the equation of ", s.q[i], ".")
                yield Variant(what=what, V=-V, only=frozenset({i}), element=element, coordinate=i, why=WHY_ROW)
        else:
            shares = s.shares(element)
            yield Variant(what=what, Xi=negative(shares), element=element)
            for i, x in shares.items() if len(shares) > 1 else ():
                what = text(f"{title} is missing in the equation of ", s.q[i], ".")
                yield Variant(what=what, Xi={i: -x}, element=element, coordinate=i, why=WHY_ROW)
