"""A generalized force lacks the arm (or the direction) that converts the force."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian import bounded
from lagrangian.check.misconceptions.base import Ingredients, Variant, letters
from lagrangian.page.formula import text

STEP = 6
WHY = text("Ξ = F·∂r/∂ξ: for an angle, that is the force times its arm, a torque.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Replace every contribution of a force by the force itself; drop its angle; drop each length."""
    for element in s.acting:
        if element.resists:
            continue
        shares = s.shares(element)
        efforts = list(dict.fromkeys(s.expand(a.effort) for a in s.actions(element)))
        for i, x in shares.items():
            others = (
                [sign * e for e in efforts for sign in (1, -1)] if x not in (*efforts, *(-e for e in efforts)) else []
            )
            others += [y for p in letters(x) if not (y := bounded.expand(x / p)).has(p)]
            for other in dict.fromkeys(others):
                if other != x:
                    what = text(f"What {element.title} adds to the equation of ", s.q[i], " comes without its arm.")
                    yield Variant(what=what, Xi={i: other - x}, element=element, coordinate=i)
        changed = {i: bounded.expand(x / p) for p in _lengths(shares) for i, x in shares.items() if x.has(p)}
        if len(changed) > 1:
            what = text(f"What {element.title} adds to the equations comes without its arm.")
            yield Variant(what=what, Xi={i: c - shares[i] for i, c in changed.items()}, element=element)


def _lengths(shares: dict[int, sp.Expr]) -> list[sp.Symbol]:
    return [p for x in shares.values() for p in letters(x) if not bounded.expand(x / p).has(p)][:1]
