"""A force between two bodies is counted on only one of them."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import NO_D, Ingredients, Variant
from lagrangian.check.explain.misconceptions.ends import both_ends, is_outer
from lagrangian.page.formula import text

STEP = 6
WHY = text("What pushes two bodies apart acts on both, with opposite signs; so does a damper or a motor between them.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Drop one end of every pair; drop each contribution to a Ξ if there are two of opposite sign.

    Where this leaves what belongs to one relative coordinate in every Ξ, that is likelier what was done.
    """
    for element in s.acting:
        shares = s.shares(element)
        for kept, lost in both_ends(s, element):
            what = text(f"Only one end of {element.title} is counted: its reaction on ", *lost.on, " is missing.")
            change = {i: s.xi((kept,), i) - shares.get(i, 0) for i in range(s.n)}
            changed = {i: x for i, x in change.items() if x != 0}
            everywhere = len(shares) == 1 and len(changed) == s.n - 1 and {*changed.values()} == {*shares.values()}
            yield Variant(what=what, Xi=changed, element=element, stated=NO_D, doubt=int(everywhere))
        for i, x in shares.items() if not is_outer(s, element) else ():
            if any(bounded.expand(s.expand(x + y)) == 0 for j, y in shares.items() if j != i):
                what = text(f"The reaction of {element.title} is missing in the equation of ", s.q[i], ".")
                yield Variant(what=what, Xi={i: -x}, element=element, coordinate=i)
