"""∂L/∂ξ̇ is not differentiated in time at all, or only its partial derivative is taken."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, Variant, put
from lagrangian.model import time
from lagrangian.page.formula import Partial, Total, text

STEP = 5
WHY = text("d/dt ∂L/∂ξ̇ is a total derivative: every rate in ∂L/∂ξ̇ becomes an acceleration, every coordinate a rate.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """∂/∂t instead of d/dt, which leaves no inertia; ∂L/∂ξ̇ itself instead of its derivative."""
    rates = [s.rate(p) for p in s.momenta]
    hidden = {x: sp.Dummy() for x in (*s.a, *s.v, *s.q)}
    back = {d: x for x, d in hidden.items()}
    explicit = [put(bounded.diff(put(p, hidden), time), back) for p in s.momenta]
    what = text(Total(Partial(sp.Symbol("L"), sp.Symbol("ξ̇"))), " was taken as a partial derivative by time.")
    yield Variant(what=what, rows={i: e - r for i, (e, r) in enumerate(zip(explicit, rates, strict=True))})
    for i, (p, r) in enumerate(zip(s.momenta, rates, strict=True)):
        what = text(Partial(sp.Symbol("L"), s.v[i]), " was not differentiated in time.")
        yield Variant(what=what, rows={i: p - r}, coordinate=i)
