"""The sign of one term of an equation turned."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.analyze.check.misconceptions.base import Ingredients, Variant
from lagrangian.derive.formula import text

STEP = 5
WHY = text("A sign was lost on the way: differentiate this term once more, and mind −∂L/∂ξ.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Every readable term of every equation."""
    for i, row in enumerate(s.derivation.terms):
        for term in row:
            expr = s.expand(term.expr) * (-1 if term.kind == "input" else 1)
            what = text("In the equation of ", s.q[i], " the term ", term.expr, " has the wrong sign.")
            yield Variant(what=what, rows={i: -2 * expr}, coordinate=i, stated=frozenset())
