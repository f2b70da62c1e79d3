"""A force is counted in the Ξ of another coordinate."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import permutations

from lagrangian import bounded
from lagrangian.check.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import Name, text

STEP = 6
WHY = text(
    "Ξ_i contains the forces on the box of everything that moves when only ξ_i does: wiggle one coordinate, and see "
    "which forces do work."
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Move every contribution to one Ξ to another, with both signs; exchange the contributions to two Ξ."""
    for element in s.acting:
        shares = s.shares(element)
        for i, j in permutations(range(s.n), 2):
            if i not in shares:
                continue
            what = text(
                f"{element.title} is counted in ", Name("Xi", str(j + 1)), " in place of ", Name("Xi", str(i + 1)), "."
            )
            own = shares[i]
            there = shares.get(j, own * 0)
            yield Variant(what=what, Xi={i: -own, j: own - there}, element=element, coordinate=j)
            yield Variant(what=what, Xi={i: -own, j: -own - there}, element=element, coordinate=j)
            if there != 0 and bounded.expand(own + there) != 0:
                yield Variant(what=what, Xi={i: -own, j: own}, element=element, coordinate=j)
            if there != 0 and i < j:
                yield Variant(what=what, Xi={i: there - own, j: own - there}, element=element, coordinate=j)
