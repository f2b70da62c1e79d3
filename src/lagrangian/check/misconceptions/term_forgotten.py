"""One term of an equation is left out, or is wrong by a factor of two."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian.check.misconceptions.base import Ingredients, Variant, pieces
from lagrangian.page.formula import text

STEP = 5
WHY = text("Go through ∂L/∂ξ̇, its d/dt and ∂L/∂ξ once more, term by term.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Drop, halve and double every readable term of every equation."""
    for p in pieces(s):
        for share, words in (
            (sp.Integer(-1), "is missing"),
            (sp.Integer(1), "comes twice"),
            (-sp.S.Half, "comes half"),
        ):
            what = text("In the equation of ", s.q[p.row], " the term ", p.shown, f" {words}.")
            yield Variant(what=what, rows={p.row: share * p.expr}, coordinate=p.row, stated=frozenset())
