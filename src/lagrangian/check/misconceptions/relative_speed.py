"""The speed relative to the parent is used in T* instead of the total velocity."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import sympy as sp

from lagrangian.check.misconceptions.base import Ingredients, Variant, half_square, put
from lagrangian.page.formula import Name, text

STEP = 2
WHY = text(
    "Be careful: the total velocity counts. A body on a relative coordinate is carried by its parent, and its "
    "velocity is the sum of the parent's and its own."
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """For every body whose velocity contains several rates: the velocity from one of them, or from all but one."""
    for body in s.bodies:
        yield from _alone(s, body)
        yield from _carried(s, body)


def _alone(s: Ingredients, body: Any) -> Iterator[Variant]:
    """The velocity that results from one rate only, or from all but one."""
    velocity = s.velocity(body)
    rates = [v for v in s.v if any(x.has(v) for x in velocity)]
    if all(sum(x.has(v) for v in rates) < 2 for x in velocity):
        return
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
            " alone: the speed relative to its parent instead of the total one.",
        )
        yield Variant(what=what, T=change, element=body)
        if s.omega(body):
            turned = tuple(put(x, gone) for x in s.omega(body))
            yield Variant(what=what, T=change + s.rotating(body, turned) - s.rotation(body), element=body)


def _carried(s: Ingredients, body: Any) -> Iterator[Variant]:
    """The velocity relative to the parent of the body, and relative to every other body."""
    own = s.velocity(body)
    others = [(tuple(s.rate(x) for x in s.parent(body)), "its parent", 0)]
    others += [(s.velocity(b), b.title, 1) for b in s.bodies if b is not body]
    for other, words, doubt in others:
        if any(x != 0 for x in other) and other != own:
            relative = tuple(a - b for a, b in zip(own, other, strict=True))
            what = text(f"The velocity of {body.title} in ", Name("T*"), f" is the one relative to {words}.")
            change = half_square(s.expand(body.mass), relative) - s.translation(body)
            yield Variant(what=what, T=change, element=body, doubt=doubt)


def _listed(rates: list[sp.Expr]) -> list[sp.Expr | str]:
    parts: list[sp.Expr | str] = [p for v in rates for p in (v, ", ")]
    return parts[:-1]
