"""The deflection of a spring made of the wrong coordinates."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian import bounded
from lagrangian.check.misconceptions.base import Ingredients, Variant, put
from lagrangian.page.formula import text

STEP = 3
WHY = text(
    "The deflection is what changes the length of the spring. Where a coordinate is relative, the deflection of a "
    "spring to the parent is that coordinate alone; where both are absolute, it is their difference."
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Every linear spring on a linear deflection: the sign of one coordinate turned, one added, one for another."""
    for spring, extension, V in s.springs():
        if spring.k is None or any(extension.diff(q).has(*s.q) for q in s.q):
            continue
        for changed in dict.fromkeys(_deflections(s, extension)):
            if bounded.expand(changed**2 - extension**2) != 0:
                what = text(f"The deflection of {spring.title} is taken as ", changed, " in place of ", extension, ".")
                yield Variant(what=what, V=s.expand(spring.k) * changed**2 / 2 - V, element=spring)


def _deflections(s: Ingredients, extension: sp.Expr) -> Iterator[sp.Expr]:
    held = [q for q in s.q if extension.has(q)]
    free = [q for q in s.q if q not in held]
    for q in held:
        if len(held) > 1:
            yield put(extension, {q: -q})
        for p in free:
            yield put(extension, {q: p})
            yield put(extension, {q: q - p})
