"""A force or torque on a relative coordinate is also counted in an equation in which it does no work."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import Name, text

STEP = 6
WHY = text(
    "Change only this coordinate a little. What the force or torque acts on does not move, or both its ends move "
    "together: it does no work, so it is not in this Ξ. A reaction on the ground does no work either, as the ground "
    "does not move."
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
