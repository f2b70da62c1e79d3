"""Ξ on the wrong side of the equation."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.check.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import Name, text

STEP = 6
WHY = text("d/dt ∂L/∂ξ̇ − ∂L/∂ξ = Ξ: the generalized forces stand on the right, with their own sign.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Every Ξ with the other sign, where more than one element acts."""
    held = {i: -2 * x for i, x in enumerate(s.Xi) if x != 0}
    if held and len(s.acting) > 1:
        yield Variant(what=text("Every ", Name("Xi"), " stands on the wrong side."), Xi=held)
        for i, x in held.items() if len(held) > 1 else ():
            what = text(Name("Xi", str(i + 1)), " stands on the wrong side.")
            yield Variant(what=what, Xi={i: x}, coordinate=i)
