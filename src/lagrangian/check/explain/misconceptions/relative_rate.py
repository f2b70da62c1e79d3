"""One part of the rate of a body is taken for the whole: θ̇₂ for θ̇₁ + θ̇₂, ψ̇ for Ω + ψ̇ on what turns at a given rate."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, Variant, half_square, put
from lagrangian.model import time
from lagrangian.page.formula import text

STEP = 2
WHY = text(
    "Everything that turns the body counts: a relative angle is measured from what carries it, and a rope or a gear "
    "turns a wheel from both of its sides."
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """For every body that is turned by a sum of coordinates and of what is given: only one of the rates, in v, in ω, or
    in both; for a given rate in one equation, too."""
    for body in s.bodies:
        for k, q in enumerate(s.q):
            moved = _velocity(s, body, q)
            turned = _omega(s, body, k)
            translation = half_square(s.expand(body.mass), moved) - s.translation(body) if moved else sp.S.Zero
            rotation = s.rotating(body, turned) - s.rotation(body) if turned else sp.S.Zero
            speed = _unsigned(turned[0]) if turned else s.v[k]
            given = _given(s, body, q)
            whole: tuple[str | sp.Expr, ...] = (s.v[k] + given,) if given != 0 else ("the sum of the rates",)
            what = text(f"{body.title[:1].upper() + body.title[1:]} turns with ", speed, " alone.")
            said = text(f"In the velocity of {body.title}, ", s.v[k], " alone stands in place of ", *whole, ".")
            both = what if turned else said
            told = sum(any(w.has(v) for w in s.omega(body)) for v in s.v) == 1  # as another angular velocity
            for change, words in ((translation + rotation, both), (rotation, what), (translation, said)):
                if change != 0 and not (told and change == rotation):
                    yield Variant(what=words, T=change, element=body, coordinate=k)
            if given != 0:
                yield from _in_one_equation(s, body, k, given)


def _unsigned(rate: sp.Expr) -> sp.Expr:
    """A rate without the sign, which its square does not show: (R − r) φ̇/r for −(R − r) φ̇/r."""
    factors = [f for f in sp.Mul.make_args(rate) if f != -1]
    plain = [-f if isinstance(f, sp.Add) and f.could_extract_minus_sign() else f for f in factors]
    return cast("sp.Expr", sp.Mul(*plain))


def _given(s: Ingredients, body: object, q: sp.Expr) -> sp.Expr:
    """The given rate that stands beside that of ``q`` in every sum of angles of a body, as Ω in Ω + ψ̇; 0 if none."""
    sums = dict.fromkeys(a for x in s.position(body) for a in s.angles(x) if a.has(q) and s.is_carried(a))
    still = dict.fromkeys([*s.q, *s.v], sp.S.Zero)
    rates = {bounded.expand(put(bounded.diff(a, time), still) / bounded.diff(a, q)) for a in sums}
    rate = rates.pop() if len(rates) == 1 else sp.S.Zero
    return sp.S.Zero if rate.has(*s.q) else rate


def _in_one_equation(s: Ingredients, body: Any, k: int, given: sp.Expr) -> Iterator[Variant]:
    """The relative rate in place of the whole one in the velocity terms that a body adds to one equation."""
    for i, v in enumerate(s.v):
        T = s.kinetic(body)
        row = bounded.diff(bounded.diff(T, v), time) - bounded.diff(T, s.q[i])
        change = put(row, {s.v[k]: s.v[k] - given}) - row
        if not change.has(*s.v, *s.q):
            continue
        what = text("In the equation of ", s.q[i], ", ", s.v[k], " stands in place of ", s.v[k] + given, ".")
        yield Variant(what=what, rows={i: change}, element=body, coordinate=i, step=5)


def _velocity(s: Ingredients, body: object, q: sp.Expr) -> tuple[sp.Expr, ...]:
    """The velocity if every sum of angles that contains ``q`` turned only with the rate of ``q``; () if there is no
    sum."""
    position = s.position(body)
    sums = [a for x in position for a in s.angles(x) if a.has(q)]
    sums = [a for a in sums if s.is_carried(a) or sum(a.has(p) for p in s.q) > 1]
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
    if len(omega) != 1 or s.v[k] not in held:
        return ()
    turned = tuple(s.v[k] * bounded.diff(w, s.v[k]) for w in omega)
    return () if bounded.expand(turned[0] - omega[0]) == 0 else turned
