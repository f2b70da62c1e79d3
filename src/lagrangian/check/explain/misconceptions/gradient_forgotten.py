"""−∂L/∂ξ is dropped although T* depends on the coordinate."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import Minus, Partial, text

STEP = 5
WHY = text("The left-hand side is d/dt ∂L/∂ξ̇ − ∂L/∂ξ, and T* often depends on the coordinates themselves, too.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Drop ∂T*/∂ξ in all equations and in each one; drop the whole ∂L/∂ξ in each one and in all."""
    slopes = [bounded.diff(s.T, q) for q in s.q]
    whole = [bounded.diff(s.T - s.V, q) for q in s.q]
    L = sp.Symbol("L")
    if sum(x != 0 for x in slopes) > 1:
        yield Variant(
            what=text("What T* adds to ∂L/∂ξ is missing in every equation."),
            rows={i: x for i, x in enumerate(slopes) if x != 0},
        )
    for i, x in enumerate(slopes):
        if x != 0:
            what = text("What T* adds to ", Minus(Partial(L, s.q[i])), " is missing.")
            yield Variant(what=what, rows={i: x}, coordinate=i)
    for i, x in enumerate(whole):
        if x != 0:
            yield Variant(what=text(Minus(Partial(L, s.q[i])), " is missing."), rows={i: x}, coordinate=i)
    yield Variant(what=text("−∂L/∂ξ is missing in every equation."), rows=dict(enumerate(whole)))
