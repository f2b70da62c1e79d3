"""In which equations words say the sign of a force of the answer's own: λ to the right on the reel, where x grows."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.reading.said.senses import OPPOSITE, ways_in
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine
from lagrangian.model import Model, time
from lagrangian.model.elements.base import Body
from lagrangian.model.symbols import Coordinate

_AXES = {"right": (0, 1), "left": (0, -1), "up": (1, 1), "down": (1, -1)}
"""The component of a position in the plane that grows, and its sign."""
_TURNS = {"counterclockwise": 1, "clockwise": -1}
"""The sign with which an angle in the plane grows."""


def stated_signs(truth: Reference, lines: Sequence[AnsweredLine], name: Any) -> dict[int, int]:
    """The sign with which a force pushes in the equations of some coordinates, as words say; nothing where these
    contradict each other."""
    said = {(way, on) for line in lines for of, way, on in line.senses if of == str(name)}
    found: dict[int, set[int]] = {}
    for i, c in enumerate(truth.model.coordinates):
        found[i] = {sign for way, on in said for sign in [sign_along(truth.model, c, way, on)] if sign}
    return {i: signs.pop() for i, signs in found.items() if len(signs) == 1}


def sign_along(model: Model, c: Coordinate, way: str, on: str) -> int:
    """Return the sign of a push or a turn in some way on something along a coordinate; 0 where that is not known."""
    named = [b for b in model.bodies if _speaks_of(b.name, on) or any(_speaks_of(x, on) for x in _places(model, b))]
    if on and not named and not _speaks_of(c.description, on):
        return 0
    if on and named and not any(_moves(model, b, c) for b in named):
        return 0
    if (ways := ways_in(c.description)) and (way in ways) != (OPPOSITE[way] in ways):
        return 1 if way in ways else -1
    bodies = named if on and named else model.bodies
    if model.dimension != 2 or way not in (*_AXES, *_TURNS):
        return 0
    if way in _TURNS:
        sense, slopes = _TURNS[way], [_turn(model, b, c) for b in bodies]
    else:
        axis, sense = _AXES[way]
        slopes = [_slope(model, b, c)[axis] for b in bodies]
    signs = {sense * _ordinary(x) for x in slopes if x != 0}
    return signs.pop() if len(signs) == 1 else 0


def _places(model: Model, body: Body) -> Iterator[str]:
    """The names of the points at which a body is."""
    yield from (p.name for p in model.points if p.name and model.position(p) == model.position(body.at))


def _speaks_of(words: str | None, on: str) -> bool:
    """Whether a word stands among others, in the singular or the plural."""
    own = {x.strip(".,;:()").lower().removesuffix("s") for x in (words or "").replace("_", " ").split()}
    return bool(on) and on.removesuffix("s") in own


def _slope(model: Model, body: Body, c: Coordinate) -> list[sp.Expr]:
    """How the centre of a body moves with a coordinate in the fixed axes."""
    return [bounded.diff(model.expand(x, constants=True), c.symbol) for x in model.position(body.at)]


def _turn(model: Model, body: Body, c: Coordinate) -> sp.Expr:
    """How the angle of a body in the plane grows with a coordinate."""
    axes = body.axes
    if axes is None or axes.dimension != 2:
        return sp.S.Zero
    return bounded.diff(model.expand(axes.total_angle, constants=True), c.symbol)


def _moves(model: Model, body: Body, c: Coordinate) -> bool:
    return any(x != 0 for x in _slope(model, body, c))


def _ordinary(slope: sp.Expr) -> int:
    """The sign of a slope that no coordinate changes, with small positive parameters; 0 for another."""
    if slope.has(time):
        return 0
    value = cast("sp.Expr", slope.xreplace({x: sp.Rational(3, 10) for x in slope.free_symbols}))
    return int(sp.sign(value.evalf())) if value.is_number else 0
