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
from lagrangian.model import time
from lagrangian.page.formula import Left

MOST_AXES = 6
"""The largest number of sets of axes that are tried for a body."""
LONGEST = 120
"""The largest number of operations of a velocity whose components along other axes are sought."""


def turned_velocities(s: Ingredients, b: Any) -> Iterator[tuple[tuple[str | Left, ...], sp.Expr]]:
    """The components of a velocity along the axes of frames, and along those that the angles in it turn."""
    for words, x, _ in _turned(s, b, s.velocity(b)):
        yield words, x


def velocities_along_axes(s: Ingredients, b: Any) -> Iterator[tuple[tuple[str | Left, ...], list[sp.Expr]]]:
    """All components of a velocity along such axes, in their order, with what the axes are called."""
    if bounded.operations(*s.velocity(b)) <= LONGEST:
        for words, axes in islice(_axes(s, b), MOST_AXES):
            found = [x for _, x in _along(s, axes, s.velocity(b))]
            if len(found) == s.model.dimension:
                yield words, found


def turned_accelerations(s: Ingredients, b: Any) -> Iterator[tuple[tuple[str | Left, ...], sp.Expr, list[sp.Expr]]]:
    """The components of an acceleration along such axes, r̈ − r φ̇² and r φ̈ + 2 ṙ φ̇, each with its axis."""
    yield from _turned(s, b, [s.rate(v) for v in s.velocity(b)])


def _turned(
    s: Ingredients, b: Any, vector: Sequence[sp.Expr]
) -> Iterator[tuple[tuple[str | Left, ...], sp.Expr, list[sp.Expr]]]:
    """The components of a vector of a body along axes that turn, each with its words and its axis."""
    if bounded.operations(*s.velocity(b)) > LONGEST:
        return
    seen = {bounded.expand(sign * x) for x in vector for sign in (1, -1)}
    for words, axes in islice(_axes(s, b), MOST_AXES):
        for k, x in _along(s, axes, vector):
            if x != 0 and not {x, -x} & seen:
                seen.add(x)
                yield _axis(words, k), x, [cast("sp.Expr", axes[c, k]) for c in range(len(vector))]


def turned_places(
    s: Ingredients, b: Any
) -> Iterator[tuple[tuple[str | Left, ...], sp.Expr, Callable[[sp.Expr], list[sp.Expr]]]]:
    """The components of a position along such axes, from the fixed point or from that by which it is carried, that
    change; each with the position that another value in its place leads to. They hold no angles that turn the axes:
    a + l sin θ from the axis of a crown, and not l sin φ along axes turned by φ."""
    if bounded.operations(*s.velocity(b)) > LONGEST:
        return
    seen = {bounded.expand(sign * x) for x in s.position(b) for sign in (1, -1)}
    zero = (sp.S.Zero,) * s.model.dimension
    for base in dict.fromkeys((zero, s.parent(b))):
        for words, axes in islice(_axes(s, b), MOST_AXES):
            way = [x - y for x, y in zip(s.position(b), base, strict=True)]
            for k, x in _along(s, axes, way):
                plain = not x.has(sp.sin, sp.cos) or not any(axes.has(q) and x.has(q) for q in s.q)
                if s.moves(x) and plain and not {x, -x} & seen:
                    seen.add(x)
                    yield _axis(words, k), x, partial(_placed, s.position(b), axes, k, x)


def _axis(words: tuple[str | Left, ...], k: int) -> tuple[str | Left, ...]:
    """The words for one of several axes: along the x axis turned by φ, along the z axis of crown."""
    first, *others = words
    return (f" along the {'xyz'[k]} axis{first}", *others)


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
        yield from (((f" of {f.name}",), sp.Matrix(f.rotation)) for f in frames)
    angles = [s.expand(f.total_angle) for f in frames] if plane else []
    angles += [a for x in (*s.position(b), *s.velocity(b)) for a in s.angles(x)]
    angles += _driven(s, b) if plane else []
    angles = [a for a in dict.fromkeys(angles) if a.has(*s.q) or a.free_symbols]
    if plane:
        yield from (((" turned by ", a), cast("sp.Matrix", _turn(a)[:2, :2])) for a in angles)
        return
    yield from (((" turned by ", a, " about z"), _turn(a)) for a in angles)
    for a, c in permutations(angles, 2):  # first about z, then about y, as those of a sphere
        cosine, sine = sp.cos(c), sp.sin(c)
        lean = sp.Matrix([[cosine, 0, sine], [0, 1, 0], [-sine, 0, cosine]])
        yield (" turned by ", a, " and ", c), cast("sp.Matrix", _turn(a) * lean)


def _driven(s: Ingredients, b: Any) -> list[sp.Expr]:
    """The angles in a place that time alone gives: Ω t of a table."""
    found = {cast("sp.Expr", f.args[0]) for x in s.position(b) for f in x.atoms(sp.sin, sp.cos)}
    return sorted((a for a in found if a.has(time) and not a.has(*s.q)), key=sp.default_sort_key)


def _turn(angle: sp.Expr) -> sp.Matrix:
    """A rotation about z."""
    c, x = sp.cos(angle), sp.sin(angle)
    return sp.Matrix([[c, -x, 0], [x, c, 0], [0, 0, 1]])
