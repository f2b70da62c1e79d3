"""One term of an equation has the wrong sign."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.check.misconceptions.base import Ingredients, Variant, pieces
from lagrangian.page.formula import text

STEP = 5
WHY = text("A sign was lost on the way: differentiate this term once more, and mind −∂L/∂ξ.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Reverse every readable term of every equation."""
    for p in pieces(s):
        what = text("In the equation of ", s.q[p.row], " the term ", p.shown, " has the wrong sign.")
        yield Variant(what=what, rows={p.row: -2 * p.expr}, coordinate=p.row, stated=frozenset())
