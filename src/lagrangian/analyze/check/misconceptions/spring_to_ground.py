"""A spring between two bodies taken as one between a body and the ground."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian.analyze.check.misconceptions.base import Ingredients, Variant, put
from lagrangian.derive.formula import text

STEP = 3
WHY = text("Be careful: the Δx of a spring between two bodies is the motion of one relative to the other.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Every linear spring whose deflection holds several coordinates, with one of them alone."""
    for spring, extension, V in s.springs():
        held = [q for q in s.q if extension.has(q)]
        if spring.k is None or len(held) < 2:
            continue
        if not any(extension.diff(q).has(*s.q) for q in held):
            each = sp.Add(*[(extension.diff(q) * q) ** 2 for q in held])
            what = text(f"{spring.title[:1].upper() + spring.title[1:]} pulls each body as if to the ground.")
            yield Variant(what=what, V=s.expand(spring.k) * each / 2 - V, element=spring)
        for q in held:
            own = put(extension, {p: sp.S.Zero for p in held if p != q})
            if own.has(sp.nan, sp.zoo):
                continue
            what = text(f"{spring.title[:1].upper() + spring.title[1:]} is stretched by ", q, " alone in ", "your V.")
            yield Variant(what=what, V=s.expand(spring.k) * own**2 / 2 - V, element=spring)
