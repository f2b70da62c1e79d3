"""The speed relative to the parent is used in T* instead of the total velocity."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, Variant, half_square, put
from lagrangian.page.formula import Name, text

STEP = 2
WHY = text(
    "T* needs the total velocity, seen from the ground. What carries the body moves too, and the velocity of the body "
    "is the sum of both."
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
    relative = _relative(s, body)
    kept = [[v] for v in rates] + ([[w for w in rates if w != v] for v in rates] if len(rates) > 2 else [])
    for keep in kept:
        gone = {v: sp.S.Zero for v in rates if v not in keep}
        own = tuple(put(x, gone) for x in velocity)
        change = half_square(s.expand(body.mass), own) - s.translation(body)
        parents = all(bounded.expand(a - b) == 0 for a, b in zip(own, relative, strict=True))
        tail = "the speed relative to what carries it instead of the total one" if parents else "it depends on "
        others = [] if parents else _listed([v for v in rates if v not in keep])
        what = text(
            f"The velocity of {body.title} in ",
            Name("T*"),
            " holds ",
            *_listed(keep),
            f" alone: {tail}",
            *others,
            "." if parents else ", too.",
        )
        yield Variant(what=what, T=change, element=body, doubt=0 if parents else 1)
        if s.omega(body):
            turned = tuple(put(x, gone) for x in s.omega(body))
            turning = s.rotating(body, turned) - s.rotation(body)
            yield Variant(what=what, T=change + turning, element=body, doubt=0 if parents else 1)


def _carried(s: Ingredients, body: Any) -> Iterator[Variant]:
    """The velocity relative to the parent of the body, and relative to every other body."""
    own, parent = s.velocity(body), tuple(s.rate(x) for x in s.parent(body))
    carrying = {v for v in s.v if any(x.has(v) for x in parent)}
    doubt = 1 if any(x.has(*carrying) for x in _relative(s, body)) and carrying else 0  # the parent turns, too
    others = [(parent, "what carries it", doubt)]
    others += [(s.velocity(b), b.title, 2) for b in s.bodies if b is not body]
    for other, words, doubt in others:
        if any(x != 0 for x in other) and other != own:
            relative = tuple(a - b for a, b in zip(own, other, strict=True))
            what = text(f"The velocity of {body.title} in ", Name("T*"), f" is the one relative to {words}.")
            change = half_square(s.expand(body.mass), relative) - s.translation(body)
            yield Variant(what=what, T=change, element=body, doubt=doubt)


def _relative(s: Ingredients, body: Any) -> tuple[sp.Expr, ...]:
    """The velocity of a body less that of the point from which its position is measured."""
    return tuple(bounded.expand(a - s.rate(b)) for a, b in zip(s.velocity(body), s.parent(body), strict=True))


def _listed(rates: list[sp.Expr]) -> list[sp.Expr | str]:
    parts: list[sp.Expr | str] = [p for v in rates for p in (v, ", ")]
    return parts[:-1]
