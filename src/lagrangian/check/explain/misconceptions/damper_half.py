"""−½bξ̇: the factor ½ of Rayleigh's function is left in the force."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import Name, text

STEP = 6
WHY = text("D is differentiated by the rate to get Ξ: what becomes of the factor before it and of the square?")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Halve the force of every damper."""
    for element in s.resisting:
        what = text(f"{element.title[:1].upper() + element.title[1:]} adds half its force to ", Name("Xi"), ".")
        shares = s.shares(element)
        yield Variant(what=what, Xi={i: -x / 2 for i, x in shares.items()}, element=element)
        for i, x in shares.items() if len(shares) > 1 else ():
            what = text(
                f"{element.title[:1].upper() + element.title[1:]} adds half its force to the equation of ", s.q[i], "."
            )
            yield Variant(what=what, Xi={i: -x / 2}, element=element, coordinate=i)
