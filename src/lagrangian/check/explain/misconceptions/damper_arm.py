"""A damper lacks its arm: bLθ̇ or bθ̇ instead of bL²θ̇."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, Variant, letters
from lagrangian.model import Damper
from lagrangian.page.formula import text

STEP = 6
WHY = text(
    "The damper mimics a spring in its place: one arm gives the rate of its ends, and another turns its "
    "force into a torque. Both count."
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Yield every damper in which a length occurs once, or not at all, in its contribution."""
    for element in s.acting:
        if not isinstance(element, Damper):
            continue
        shares = s.shares(element)
        own = s.expand(element.b if element.b is not None else element.law).free_symbols
        for p in [p for p in letters(sp.Add(*[abs(x) for x in shares.values()])) if p not in own]:
            for power in (1, 2):
                changed = {
                    i: y for i, x in shares.items() if x.has(p) and not (y := bounded.expand(x / p**power)).has(p)
                }
                changed |= {i: bounded.expand(x / p) for i, x in shares.items() if power == 1 and x.has(p)}
                if changed:
                    once = any(c.has(p) for c in changed.values())
                    missing, there = (
                        ("with its arm ", " once; it belongs there squared.") if once else ("without its arm ", ".")
                    )
                    what = text(f"{element.title[:1].upper() + element.title[1:]} comes {missing}", p, there)
                    yield Variant(what=what, Xi={i: c - shares[i] for i, c in changed.items()}, element=element)
