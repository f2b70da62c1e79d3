"""+∂L/∂ξ instead of −∂L/∂ξ."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import Partial, text

STEP = 5
WHY = text("The left-hand side is d/dt ∂L/∂ξ̇ minus ∂L/∂ξ.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Reverse ∂T*/∂ξ, and the whole ∂L/∂ξ: in all equations, and in each one."""
    L = sp.Symbol("L")
    for energy in (s.T - s.V, s.T):
        slopes = [bounded.diff(energy, q) for q in s.q]
        part = "What T* adds to " if energy == s.T and s.V != 0 else ""
        if sum(x != 0 for x in slopes) > 1:
            what = text(f"{part}∂L/∂ξ has the wrong sign in every equation.")
            yield Variant(what=what, rows={i: 2 * x for i, x in enumerate(slopes) if x != 0})
        for i, x in enumerate(slopes):
            if x != 0:
                what = text(*([part] if part and s.V.has(s.q[i]) else []), Partial(L, s.q[i]), " has the wrong sign.")
                yield Variant(what=what, rows={i: 2 * x}, coordinate=i, doubt=_of_one(s, i))


def _of_one(s: Ingredients, i: int) -> int:
    """A doubt if ∂L/∂ξ_i comes from one spring or from gravity alone: then that has the wrong sign, which says more."""
    q = s.q[i]
    parts = [s.expand(e.potential(s.model)) for e in s.model.elements if e.ledger == "V"]
    return 2 * int(bounded.diff(s.T, q) == 0 and sum(x.has(q) for x in parts) == 1)
