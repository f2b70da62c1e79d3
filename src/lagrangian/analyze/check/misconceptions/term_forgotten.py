"""One term of an equation left out, or with a factor of two too much or too little."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian.analyze.check.misconceptions.base import Ingredients, Variant
from lagrangian.derive.formula import text

STEP = 5
WHY = text("Go through ∂L/∂ξ̇, its d/dt and ∂L/∂ξ once more, term by term.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Every readable term of every equation: gone, halved, doubled."""
    for i, row in enumerate(s.derivation.terms):
        for term in row:
            expr = s.expand(term.expr) * (-1 if term.kind == "input" else 1)
            for share, words in (
                (sp.Integer(-1), "is missing"),
                (sp.Integer(1), "comes twice"),
                (-sp.S.Half, "comes half"),
            ):
                what = text("In the equation of ", s.q[i], " the term ", term.expr, f" {words}.")
                yield Variant(what=what, rows={i: share * expr}, coordinate=i, stated=frozenset())
