"""A force is counted in the Ξ of another coordinate."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import permutations

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import Name, text

STEP = 6
WHY = text(
    "Ξ_i contains the forces on everything that moves when ξ_i alone changes: change one coordinate a little, and see "
    "which forces do work."
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Move every contribution to one Ξ to another, with both signs; exchange the contributions to two Ξ.

    "In place of" is said of two Ξ only where the element belongs to one of them alone, and stands in the other alone.
    """
    for element in s.acting:
        shares = s.shares(element)
        for i, j in permutations(range(s.n), 2):
            if i not in shares:
                continue
            here, other, own = Name("Xi", str(i + 1)), Name("Xi", str(j + 1)), shares[i]
            if j not in shares:
                what = text(f"{element.title} is counted in ", other, " in place of ", here, ".")
                yield Variant(what=what, Xi={i: -own, j: own}, element=element, coordinate=j)
                yield Variant(what=what, Xi={i: -own, j: -own}, element=element, coordinate=j)
                continue
            there, share = shares[j], f"What {element.title} adds to "
            what = text(
                share, here, " stands in ", other, " instead of what it adds there, and is missing in ", here, "."
            )
            for moved in (own, -own):
                if (more := bounded.expand(moved - there)) != 0:  # else the other Ξ is as it should be
                    yield Variant(what=what, Xi={i: -own, j: more}, element=element, coordinate=j)
            if bounded.expand(own + there) != 0:
                what = text(share, here, " is counted in ", other, " beside what it adds there.")
                yield Variant(what=what, Xi={i: -own, j: own}, element=element, coordinate=j)
            if i < j:
                what = text(share, here, " and what it adds to ", other, " are exchanged.")
                yield Variant(what=what, Xi={i: there - own, j: own - there}, element=element, coordinate=j, doubt=1)
