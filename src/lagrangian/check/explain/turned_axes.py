"""The components of a body's velocity and position along axes that turn: v_r = ṙ and v_φ = r φ̇, r_c = e + r/2."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import islice, permutations
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.changes.ring import SumRing, TooLong
from lagrangian.check.explain.misconceptions import Ingredients
from lagrangian.page.formula import Left

MOST_AXES = 6
"""The largest number of sets of axes that are tried for a body."""
LONGEST = 120
"""The largest number of operations of a velocity whose components along other axes are sought."""


def turned_velocities(s: Ingredients, b: Any) -> Iterator[tuple[tuple[str | Left, ...], sp.Expr]]:
    """The components of a velocity along the axes of frames, and along those that the angles in it turn."""
    if bounded.operations(*s.velocity(b)) > LONGEST:
        return
    seen = {bounded.expand(sign * x) for x in s.velocity(b) for sign in (1, -1)}
    for words, axes in islice(_axes(s, b), MOST_AXES):
        for _, x in _along(s, axes, s.velocity(b)):
            if x != 0 and not {x, -x} & seen:
                seen.add(x)
                yield words, x


def turned_places(
    s: Ingredients, b: Any
) -> Iterator[tuple[tuple[str | Left, ...], sp.Expr, Callable[[sp.Expr], list[sp.Expr]]]]:
    """The components of a position along such axes, from the fixed point or from that by which it is carried, that
    change; each with the position that another value in its place leads to. Only along axes that no coordinate turns
    do they hold angles: a + l sin θ from the axis of a crown."""
    if bounded.operations(*s.velocity(b)) > LONGEST:
        return
    seen = {bounded.expand(sign * x) for x in s.position(b) for sign in (1, -1)}
    zero = (sp.S.Zero,) * s.model.dimension
    for base in dict.fromkeys((zero, s.parent(b))):
        for words, axes in islice(_axes(s, b), MOST_AXES):
            way = [x - y for x, y in zip(s.position(b), base, strict=True)]
            for k, x in _along(s, axes, way):
                plain = not x.has(sp.sin, sp.cos) or not axes.has(*s.q)
                if s.moves(x) and plain and not {x, -x} & seen:
                    seen.add(x)
                    yield words, x, partial(_placed, s.position(b), axes, k, x)


def _placed(position: Sequence[sp.Expr], axes: sp.Matrix, k: int, right: sp.Expr, said: sp.Expr) -> list[sp.Expr]:
    """A position with another component along one of the axes."""
    return [x + axes[c, k] * (said - right) for c, x in enumerate(position)]


def _along(s: Ingredients, axes: sp.Matrix, vector: Sequence[sp.Expr]) -> Iterator[tuple[int, sp.Expr]]:
    """The components of a vector along axes, each with the place of its axis, without cos² + sin²."""
    ring: SumRing = s.kept("ring", lambda: SumRing(s.model))
    for k, component in enumerate(cast("Any", axes.T * sp.Matrix(vector)).flat()):
        try:
            yield k, ring.expr(ring.fold(ring.of(bounded.expand(component))))
        except TooLong:
            continue


def _axes(s: Ingredients, b: Any) -> Iterator[tuple[tuple[str | Left, ...], sp.Matrix]]:
    """The axes, in the fixed ones, and what they are called."""
    plane = s.model.dimension == 2
    frames = [f for f in s.model.frames if f.floating is None]
    if not plane:
        yield from (((f" along the axes of {f.name}",), sp.Matrix(f.rotation)) for f in frames)
    angles = [s.expand(f.total_angle) for f in frames] if plane else []
    angles += [a for x in (*s.position(b), *s.velocity(b)) for a in s.angles(x)]
    angles = [a for a in dict.fromkeys(angles) if a.has(*s.q) or a.free_symbols]
    if plane:
        yield from (((" along axes turned by ", a), cast("sp.Matrix", _turn(a)[:2, :2])) for a in angles)
        return
    yield from (((" along axes turned by ", a, " about z"), _turn(a)) for a in angles)
    for a, c in permutations(angles, 2):  # first about z, then about y, as those of a sphere
        cosine, sine = sp.cos(c), sp.sin(c)
        lean = sp.Matrix([[cosine, 0, sine], [0, 1, 0], [-sine, 0, cosine]])
        yield (" along axes turned by ", a, " and ", c), cast("sp.Matrix", _turn(a) * lean)


def _turn(angle: sp.Expr) -> sp.Matrix:
    """A rotation about z."""
    c, x = sp.cos(angle), sp.sin(angle)
    return sp.Matrix([[c, -x, 0], [x, c, 0], [0, 0, 1]])
