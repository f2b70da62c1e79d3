"""One part of the rate of a body is taken for the whole: θ̇₂ for θ̇₁ + θ̇₂."""

from __future__ import annotations

from collections.abc import Iterator
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, Variant, half_square, put
from lagrangian.model import time
from lagrangian.page.formula import text

STEP = 2
WHY = text(
    "Everything that turns the body counts: a relative angle is measured from its parent, and a rope or a gear turns a "
    "wheel from both of its sides."
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """For every body that is turned by a sum of coordinates: only one of the rates, in v, in ω, or in both."""
    for body in s.bodies:
        for k, q in enumerate(s.q):
            moved = _velocity(s, body, q)
            turned = _omega(s, body, k)
            translation = half_square(s.expand(body.mass), moved) - s.translation(body) if moved else sp.S.Zero
            rotation = s.rotating(body, turned) - s.rotation(body) if turned else sp.S.Zero
            speed = turned[0] if turned else s.v[k]
            what = text(f"{body.title[:1].upper() + body.title[1:]} turns with ", speed, " alone.")
            said = text(f"In the velocity of {body.title}, ", s.v[k], " alone stands in place of the sum of the rates.")
            for change, words in ((translation + rotation, what), (rotation, what), (translation, said)):
                if change != 0:
                    yield Variant(what=words, T=change, element=body, coordinate=k)


def _velocity(s: Ingredients, body: object, q: sp.Expr) -> tuple[sp.Expr, ...]:
    """The velocity if every sum of angles that contains ``q`` turned only with the rate of ``q``; () if there is no
    sum."""
    position = s.position(body)
    sums = [a for x in position for a in s.angles(x) if a.has(q) and sum(a.has(p) for p in s.q) > 1]
    if not sums:
        return ()
    stand_in = {a: sp.Function(f"angle{i}")(time) for i, a in enumerate(dict.fromkeys(sums))}
    back = {f: a for a, f in stand_in.items()}
    rates = {sp.Derivative(f, time): bounded.diff(a, q) * bounded.diff(q, time) for a, f in stand_in.items()}
    moved = []
    for x in position:
        hidden = x.replace(
            lambda e: isinstance(e, (sp.sin, sp.cos)) and e.args[0] in stand_in,
            lambda e: e.func(stand_in[e.args[0]]),
        )
        moved.append(put(put(bounded.diff(cast("sp.Expr", hidden), time), rates), back))
    return tuple(moved)


def _omega(s: Ingredients, body: object, k: int) -> tuple[sp.Expr, ...]:
    omega = s.omega(body)
    held = [v for v in s.v if any(w.has(v) for w in omega)]
    if len(omega) != 1 or len(held) < 2 or s.v[k] not in held:
        return ()
    return tuple(put(w, {v: sp.S.Zero for v in held if v != s.v[k]}) for w in omega)
