"""A force or torque on a relative coordinate is also counted on the parent."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import Name, text

STEP = 6
WHY = text(
    "The box of the parent includes its children: both ends of a force between parent and child are inside it, so "
    "the force cancels. The parent's Ξ contains the reaction only if the coordinates are absolute."
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Add the contribution to one Ξ to another that has none, with both signs."""
    for element in s.acting:
        shares = s.shares(element)
        for i, x in shares.items():
            for j in range(s.n):
                if j in shares:
                    continue
                what = text(
                    f"{element.title} acts on ", s.q[i], ", and is counted in ", Name("Xi", str(j + 1)), " as well."
                )
                yield Variant(what=what, Xi={j: -x}, element=element, coordinate=j)
                yield Variant(what=what, Xi={j: x}, element=element, coordinate=j)
