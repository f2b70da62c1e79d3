"""Both ends of a pair of forces have the same sign."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import NO_D, Ingredients, Variant
from lagrangian.check.explain.misconceptions.ends import both_ends, is_outer
from lagrangian.page.formula import text

STEP = 6
WHY = text(
    "Action and reaction are opposite: two bodies are pushed in opposite directions, and where a motor drives, its "
    "voltage is against the current."
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Reverse one end of every pair; reverse each of two opposite contributions."""
    for element in s.acting:
        for _, turned in both_ends(s, element):
            what = text(f"The reaction of {element.title} on ", *turned.on, " has the wrong sign.")
            change = {i: -2 * s.xi((turned,), i) for i in range(s.n)}
            yield Variant(what=what, Xi={i: x for i, x in change.items() if x != 0}, element=element, stated=NO_D)
        shares = s.shares(element)
        for i, x in shares.items() if not is_outer(s, element) else ():
            if any(bounded.expand(s.expand(x + y)) == 0 for j, y in shares.items() if j != i):
                what = text(f"The reaction of {element.title} has the wrong sign in the equation of ", s.q[i], ".")
                yield Variant(what=what, Xi={i: -2 * x}, element=element, coordinate=i)
