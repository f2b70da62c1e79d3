"""A damper has the wrong sign, so that it would drive the motion."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant, negative
from lagrangian.page.formula import text

STEP = 6
WHY = text("Does this damper take energy out, or put it in? Its force is against the motion of its ends.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Reverse every damper: completely, in each equation, or only its coupling; and all dampers together."""
    dampers = s.resisting
    every: dict[int, object] = {}
    for element in dampers:
        shares = s.shares(element)
        for i, x in shares.items():
            every[i] = every.get(i, 0) - 2 * x  # type: ignore[operator]
        what = text(f"{element.title[:1].upper() + element.title[1:]} has the wrong sign.")
        yield Variant(what=what, Xi=negative(shares, 2), element=element)
        for i, x in shares.items() if len(shares) > 1 else ():
            what = text(
                f"{element.title[:1].upper() + element.title[1:]} has the wrong sign in the equation of ", s.q[i], "."
            )
            yield Variant(what=what, Xi={i: -2 * x}, element=element, coordinate=i)
    if len(dampers) > 1:
        yield Variant(what=text("Every damper has the wrong sign."), Xi=every)  # type: ignore[arg-type]
