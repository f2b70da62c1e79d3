"""A force or torque has the wrong sign."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant, negative
from lagrangian.page.formula import text

STEP = 6
WHY = text("A force counts positive in Ξ if it pushes towards larger ξ.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Reverse every force and torque, completely and in each equation."""
    for element in s.acting:
        if element in s.resisting:
            continue
        shares = s.shares(element)
        what = text(f"{element.title[:1].upper() + element.title[1:]} has the wrong sign.")
        yield Variant(what=what, Xi=negative(shares, 2), element=element)
        for i, x in shares.items() if len(shares) > 1 else ():
            what = text(
                f"{element.title[:1].upper() + element.title[1:]} has the wrong sign in the equation of ", s.q[i], "."
            )
            yield Variant(what=what, Xi={i: -2 * x}, element=element, coordinate=i)
