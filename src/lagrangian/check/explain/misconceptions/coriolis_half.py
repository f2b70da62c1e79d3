"""The factor 2 of a Coriolis term is missing."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.check.explain.misconceptions.velocity_terms_forgotten import turned_terms, velocity_terms
from lagrangian.page.formula import text

STEP = 5
WHY = text("d/dt of a product: the square in it moves, too, and its derivative brings a factor two.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Halve the products of two rates, those of one rate and a given rotation too: in all equations, and in each."""
    products = {i: velocity_terms(s, i)[1] + turned_terms(s, i) for i in range(s.n)}
    held = {i: x for i, x in products.items() if x != 0}
    if len(held) > 1:
        yield Variant(
            what=text("The factor 2 of the Coriolis terms is missing."), rows={i: -x / 2 for i, x in held.items()}
        )
    for i, x in held.items():
        what = text("The factor 2 of the Coriolis term is missing in the equation of ", s.q[i], ".")
        yield Variant(what=what, rows={i: -x / 2}, coordinate=i)
