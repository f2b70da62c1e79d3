"""The speed relative to the parent put into T* where the total velocity belongs."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian.analyze.check.misconceptions.base import Ingredients, Variant, half_square, put
from lagrangian.derive.formula import Name, text

STEP = 2
WHY = text(
    "Be careful: the total velocity counts. A body on a relative coordinate is carried by its parent, and its velocity "
    "is the parent's and its own together."
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Every body whose velocity holds several rates, with the velocity that one of them, or all but one, would give."""
    for body in s.bodies:
        velocity = s.velocity(body)
        rates = [v for v in s.v if any(x.has(v) for x in velocity)]
        if len(rates) < 2:
            continue
        kept = [[v] for v in rates] + ([[w for w in rates if w != v] for v in rates] if len(rates) > 2 else [])
        for keep in kept:
            gone = {v: sp.S.Zero for v in rates if v not in keep}
            own = tuple(put(x, gone) for x in velocity)
            change = half_square(s.expand(body.mass), own) - s.translation(body)
            what = text(
                f"The velocity of {body.title} in ",
                Name("T*"),
                " holds ",
                *_listed(keep),
                " alone: the speed relative to what carries it instead of the total one.",
            )
            yield Variant(what=what, T=change, element=body)
            if s.omega(body):
                turned = tuple(put(x, gone) for x in s.omega(body))
                yield Variant(what=what, T=change + s.rotating(body, turned) - s.rotation(body), element=body)


def _listed(rates: list[sp.Expr]) -> list[sp.Expr | str]:
    parts: list[sp.Expr | str] = [p for v in rates for p in (v, ", ")]
    return parts[:-1]
