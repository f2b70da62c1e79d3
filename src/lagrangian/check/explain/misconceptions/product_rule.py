"""d/dt of a product is applied only to the rate: the factors before it, such as cos θ, also change in time."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, Variant, put
from lagrangian.page.formula import Partial, Total, text

STEP = 5
WHY = text(
    "d/dt is the total derivative: by the product rule each factor is differentiated in turn. Everything that moves "
    "is a function of time."
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """In all equations, in each one, and forgotten only for the rates of other coordinates."""
    momenta = [p - put(p, dict.fromkeys(s.v, sp.S.Zero)) for p in s.momenta]  # m(ẋ − Ωy): no factor before Ωy
    lost = [_lost(s, p, range(s.n)) for p in momenta]
    if sum(x != 0 for x in lost) > 1:
        what = text("The factors before the rates were not differentiated in time: the product rule is missing.")
        yield Variant(what=what, rows={i: -x for i, x in enumerate(lost) if x != 0})
    for i, x in enumerate(lost):
        if x == 0:
            continue
        what = text(
            "In ", Total(Partial(sp.Symbol("L"), s.v[i])), " the factors before the rates were not differentiated."
        )
        yield Variant(what=what, rows={i: -x}, coordinate=i)
        for k in range(s.n):
            part = _lost(s, momenta[i], [k])
            if part not in (0, x):
                what = text(
                    "In ", Total(Partial(sp.Symbol("L"), s.v[i])), " the change of ", s.q[k], " in time is missing."
                )
                yield Variant(what=what, rows={i: -part}, coordinate=i, doubt=1)


def _lost(s: Ingredients, momentum: sp.Expr, by: object) -> sp.Expr:
    """Σ_k ∂p/∂ξ_k ξ̇_k: the part of d/dt that comes from the factors."""
    return sp.Add(*[bounded.diff(momentum, s.q[k]) * s.v[k] for k in by])  # type: ignore[attr-defined]
