"""A way that a rope or a lever halves is taken in full by all that moves along it: r φ for ½ r φ of a pulley."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, Variant, half_square
from lagrangian.model import Body, Damper, RigidBody
from lagrangian.page.formula import text
from lagrangian.records import dataclass

STEP = 2
WHY = text(
    "Move the coordinate a little, and see how far this body goes. A pulley in the loop of a rope goes half as "
    "far as the rope that is drawn in; a point in the middle of a lever goes half as far as its end."
)


@dataclass(frozen=True)
class _Way:
    """The way κ q of a body along an axis, and the one that is taken for it, f κ q."""

    i: int
    slope: sp.Expr
    times: sp.Expr


def wrong(s: Ingredients) -> Iterator[Variant]:
    """For every body that moves by a number times a length, along an axis, where a spring or another element moves with
    it; with its rotation or without."""
    seen = set[tuple[int, sp.Expr]]()
    for body in s.bodies:
        for way in _ways(s, body):
            if (way.i, way.slope) in seen:
                continue
            seen.add((way.i, way.slope))
            if not any(_of(way, x) for x in _others(s, body, way.i)):
                continue  # the body alone: other words are found for that
            right = cast("sp.Expr", way.slope * s.q[way.i])
            what = text(f"The way of {body.title} is taken as ", way.times * right, "; it is ", right, ".")
            turning = s.rotation(body).has(s.v[way.i])
            for turned in (True, False) if turning else (False,):
                yield Variant(what=what, T=_T(s, way, turned), V=_V(s, way), Xi=_Xi(s, way), element=body)


def _ways(s: Ingredients, body: Body) -> Iterator[_Way]:
    """The ways of a body that are a number times lengths times a coordinate, in full."""
    for i, q in enumerate(s.q):
        for x in s.position(body):
            slope = bounded.diff(x, q)
            number, rest = slope.as_coeff_Mul()
            if slope == 0 or s.moves(slope) or abs(number) == 1 or rest.is_Add:
                continue
            signed = -slope if number.is_negative else slope
            yield _Way(i, cast("sp.Expr", signed), cast("sp.Expr", 1 / abs(number)))


def _of(way: _Way, slope: sp.Expr) -> bool:
    return bounded.expand(slope - way.slope) == 0 or bounded.expand(slope + way.slope) == 0


def _others(s: Ingredients, body: Body, i: int) -> Iterator[sp.Expr]:
    """How far all but a body move with coordinate i."""
    yield from (bounded.diff(x, s.q[i]) for b in s.bodies if b is not body for x in s.position(b))
    yield from (bounded.diff(extension, s.q[i]) for _, extension, _ in s.springs())
    yield from (bounded.diff(s.expand(a.rate), s.v[i]) for e in s.acting for a in s.actions(e))


def _moving(s: Ingredients, way: _Way) -> list[Any]:
    """The bodies that move along the way and not otherwise with its coordinate."""
    slopes = {b: [x for p in s.position(b) if (x := bounded.diff(p, s.q[way.i])) != 0] for b in s.bodies}
    return [b for b, own in slopes.items() if own and all(_of(way, x) for x in own)]


def _T(s: Ingredients, way: _Way, turned: bool) -> sp.Expr:
    v, more = s.v[way.i], way.times - 1
    found: list[sp.Expr] = []
    for b in _moving(s, way):
        moved = tuple(cast("sp.Expr", x + more * bounded.diff(x, v) * v) for x in s.velocity(b))
        found.append(half_square(s.expand(b.mass), moved) - s.translation(b))
        if turned and isinstance(b, RigidBody):
            omega = tuple(cast("sp.Expr", x + more * bounded.diff(x, v) * v) for x in s.omega(b))
            found.append(s.rotating(b, omega) - s.rotation(b))
    return sp.Add(*found)


def _V(s: Ingredients, way: _Way) -> sp.Expr:
    q, more, moving = s.q[way.i], way.times - 1, _moving(s, way)
    found = [more * bounded.diff(V, q) * q for _, b, V in s.weights() if any(b is x for x in moving)]
    for spring, extension, V in s.springs():
        slope = bounded.diff(extension, q)
        if spring.k is not None and _of(way, slope):
            found.append(s.expand(spring.k) * (extension + more * slope * q) ** 2 / 2 - V)
    return sp.Add(*found)


def _Xi(s: Ingredients, way: _Way) -> dict[int, sp.Expr]:
    v, more = s.v[way.i], way.times - 1
    found = dict.fromkeys(range(s.n), cast("sp.Expr", sp.S.Zero))
    for e in s.acting:
        for a in s.actions(e):
            rate = s.expand(a.rate)
            slope = bounded.diff(rate, v)
            if not _of(way, slope):
                continue
            if isinstance(e, Damper) and e.b is not None:
                moved = rate + more * slope * v
                shares = s.shares(e)
                for i in range(s.n):
                    found[i] += -s.expand(e.b) * moved * bounded.diff(moved, s.v[i]) - shares.get(i, sp.S.Zero)
            else:
                found[way.i] += s.expand(a.effort) * more * slope
    return {i: x for i, x in found.items() if x != 0}
