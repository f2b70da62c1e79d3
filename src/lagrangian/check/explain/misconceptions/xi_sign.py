"""Ξ has the wrong sign: in its own line, or because it stands on the wrong side of the equation."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import Name, text

STEP = 6
WHY = text("d/dt ∂L/∂ξ̇ − ∂L/∂ξ = Ξ: the generalized forces are on the right, with their own sign.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Reverse every Ξ to which more than one element contributes."""
    held = {i: -2 * x for i, x in enumerate(s.Xi) if x != 0}
    if held and len(s.acting) > 1:
        yield Variant(what=text("Every ", Name("Xi"), " has the wrong sign."), Xi=held)
        for i, x in held.items() if len(held) > 1 else ():
            what = text("All of ", Name("Xi", str(i + 1)), " has the wrong sign.")
            yield Variant(what=what, Xi={i: x}, coordinate=i)
