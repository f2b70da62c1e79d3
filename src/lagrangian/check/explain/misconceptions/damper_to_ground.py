"""A damper between two bodies is treated as one between a body and the ground."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, Variant, put
from lagrangian.model import Damper
from lagrangian.page.formula import text

STEP = 6
WHY = text("A damper feels how fast its own two ends move apart, and acts on every coordinate that changes this.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """For every linear damper with several rates: only one of them, for one body or as a force on both."""
    for element in s.acting:
        if not isinstance(element, Damper) or element.b is None:
            continue
        rate, b, shares = s.expand(element.rate(s.model)), s.expand(element.b), s.shares(element)
        held = [v for v in s.v if rate.has(v)]
        for v in held if len(held) > 1 else ():
            own = put(rate, {w: sp.S.Zero for w in held if w != v})
            what = text(f"The rate of {element.title} is taken as ", v, " alone; it is ", rate, ".")
            grounded = {i: -b * own * bounded.diff(own, s.v[i]) - shares.get(i, 0) for i in range(s.n)}
            yield Variant(what=what, Xi={i: x for i, x in grounded.items() if x != 0}, element=element)
        for v, w in ((v, w) for v in held for w in s.v if w not in held):
            own = put(rate, {v: v + w})
            what = text(f"The rate of {element.title} is taken as ", own, ", as if to the ground; it is ", rate, ".")
            grounded = {i: -b * own * bounded.diff(own, s.v[i]) - shares.get(i, 0) for i in range(s.n)}
            yield Variant(what=what, Xi={i: x for i, x in grounded.items() if x != 0}, element=element)
        if len(held) > 1:
            each = {i: -b * (bounded.diff(rate, v) ** 2) * v - shares.get(i, 0) for i, v in enumerate(s.v)}
            what = text(
                f"{element.title[:1].upper() + element.title[1:]} is taken to act on each body as if to the ground."
            )
            yield Variant(what=what, Xi={i: x for i, x in each.items() if x != 0}, element=element)
