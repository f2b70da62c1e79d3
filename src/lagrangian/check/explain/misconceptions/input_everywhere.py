"""A force is put into every equation."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import NO_D, Ingredients, Variant
from lagrangian.page.formula import Name, text

STEP = 6
WHY = text("A force belongs to Ξ_i only where it does work when ξ_i alone moves.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Use the contribution to one Ξ in all of them, of an element that some do not have, and the others with the same
    factor but for a number."""
    if s.n < 2:
        return
    for element in s.acting:
        shares = s.shares(element)
        parts = dict.fromkeys(shares.values())
        if len(shares) == s.n or not all(bounded.cancel(x / y).is_number for x in parts for y in parts):
            continue
        for x in parts:
            change = {i: x - shares.get(i, 0) for i in range(s.n)}
            held = {i: c for i, c in change.items() if c != 0}
            what = text(f"{element.title[:1].upper() + element.title[1:]} is counted in every ", Name("Xi"), ".")
            if held:
                yield Variant(what=what, Xi=held, element=element, stated=NO_D)
