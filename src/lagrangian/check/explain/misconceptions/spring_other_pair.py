"""The deflection of a spring is computed from the wrong coordinates."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, Variant, put
from lagrangian.page.formula import text

STEP = 3
WHY = text(
    "The deflection is the change of the spring's length. If a coordinate is relative, the deflection of a spring "
    "to what carries the body is just that coordinate; if both are absolute, it is their difference."
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """For every linear spring with a linear deflection: reverse, add or replace a coordinate."""
    for spring, extension, V in s.springs():
        if spring.k is None or any(bounded.diff(extension, q).has(*s.q) for q in s.q):
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
