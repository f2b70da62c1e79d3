"""Solids in space: discs with a rim, boxes, cylinders, rings and patches of ground, each right from every side.

The outline of a solid is that of the union of its sections: all of them are drawn with a line, and then again without
one. Faces that show only one side lie on top. So a solid may turn, and the eye may move, without a new shape.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from math import hypot, pi

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.look.board import BODY, Board
from lagrangian.look.shapes import INK, arc, line, lines
from lagrangian.page.scene import Disc, Pair, Path, Placement, Role
from lagrangian.records import dataclass

Array = NDArray[np.float64]

CIRCLE = arc(1.0, 0.0, 2 * pi)
SECTIONS = (-1.0, -0.5, 0.0, 0.5, 1.0)
"""Where a disc is cut, in halves of its thickness."""


@dataclass(frozen=True)
class Item:
    """What is drawn at one depth: the numbers of its parts, and the line [m] about which it lies, ``radius`` [px].

    ``points`` are the ends of that line.
    """

    first: int
    last: int
    points: tuple[int, int]
    a: Array
    b: Array
    radius: float
    lift: float


class Solids:
    """Draws solids on a board, and sorts them by their distance from the eye."""

    def __init__(self, board: Board) -> None:
        self.board, self.items = board, list[Item]()
        self.views = board.views
        self.rotations = self.views.R[0]
        self.pixel = 1.0 / board.scale
        self.eye = np.cross(board.view[0], -board.view[1])
        self._factors: dict[sp.Expr, float] = {}

    # -- points ---------------------------------------------------------------------------------------------------

    def axes(self, frame: int | None) -> Array:
        """The rotation of a frame in the pose, (3, 3)."""
        return np.eye(3) if frame is None else self.rotations[frame]

    def point(
        self, parent: int, offset: Sequence[float] | Array, frame: int | None = None, factor: sp.Expr | None = None
    ) -> int:
        """Add a point at ``factor`` · offset [m] from another in the axes of a frame, and return its number."""
        board, stage = self.board, self.board.stage
        known = board.r
        size = 1.0 if factor is None else self.value(factor)
        by = [sp.Float(float(x), 17) if abs(x) > 1e-14 else sp.S.Zero for x in offset]
        number = stage.add(
            parent, by if factor is None else [factor * x for x in by], None if frame is None else stage.frames[frame]
        )
        board.extend(known[parent] + self.axes(frame) @ (size * np.asarray(offset, float)))
        return number

    def value(self, expression: sp.Expr) -> float:
        """The value of an expression in parameters."""
        if expression not in self._factors:
            self._factors[expression] = self.board.stage.value(expression, self.board.q, self.board.p)
        return self._factors[expression]

    def plane(self, k: int, u: Array, v: Array, frame: int | None = None, factor: sp.Expr | None = None) -> Placement:
        """The plane through a point along two vectors [m]."""
        a, b = self.point(k, u, frame, factor), self.point(k, v, frame, factor)
        return Placement(self.board.anchor(k), self.board.anchor(a), across=self.board.anchor(b))

    # -- depth ----------------------------------------------------------------------------------------------------

    @contextmanager
    def item(self, a: int, b: int | None = None, radius: float = 8.0, lift: float = 0.0) -> Iterator[None]:
        """What is drawn within lies about the line between two points; ``lift`` [px] brings it towards the eye."""
        first = len(self.board.parts)
        yield
        r = self.board.r
        end = a if b is None else b
        self.items.append(Item(first, len(self.board.parts), (a, end), r[a], r[end], radius, lift))

    def sort(self) -> None:
        """Put what is nearer to the eye on top."""
        parts = self.board.parts
        order = self._order()
        inside = {n for item in self.items for n in range(item.first, item.last)}
        sorted_parts = [
            replace(parts[n], group=number) for number, item in enumerate(order) for n in range(item.first, item.last)
        ]
        for item in order:
            a, b = (self.board.anchor(k) for k in item.points)
            self.board.solids.append((a, b, item.radius, item.lift))
        self.board.parts = [x for n, x in enumerate(parts) if n not in inside] + sorted_parts
        self.items = []

    def _order(self) -> list[Item]:
        """From back to front: each after all that it covers; where that goes in a circle, by the middle."""
        items, eye = self.items, self.eye
        behind: list[set[int]] = [set() for _ in items]
        for i, j, s, t in self._meeting():
            one, two = items[i], items[j]
            di = float(eye @ (one.a + s * (one.b - one.a))) + one.lift * self.pixel
            dj = float(eye @ (two.a + t * (two.b - two.a))) + two.lift * self.pixel
            if di > dj + 0.75 * self.pixel:
                behind[i].add(j)
            elif dj > di + 0.75 * self.pixel:
                behind[j].add(i)
        depth = [float(eye @ (x.a + x.b)) / 2 + x.lift * self.pixel for x in items]
        waiting, order = set(range(len(items))), list[Item]()
        while waiting:
            ready = [i for i in waiting if not behind[i] & waiting] or list(waiting)
            n = min(ready, key=lambda i: depth[i])
            waiting.remove(n)
            order.append(items[n])
        return order

    def _meeting(self) -> Iterator[tuple[int, int, float, float]]:
        """The pairs of items i > j whose lines are seen nearer than their radii, and where: see `nearest`."""
        if not self.items:
            return
        ends = np.array([(x.a, x.b) for x in self.items]) @ (self.board.scale * self.board.view.T)
        radii = np.array([x.radius for x in self.items])
        low, high = ends.min(axis=1), ends.max(axis=1)
        apart = np.maximum(low[:, None] - high, low - high[:, None]).max(axis=2)  # of the boxes around the lines
        lines = [((a[0], a[1]), (b[0], b[1])) for a, b in ends.tolist()]
        for i, j in np.argwhere(np.tril(apart <= np.add.outer(radii, radii), -1)).tolist():
            s, t, gap = nearest(lines[i], lines[j])
            if gap <= self.items[i].radius + self.items[j].radius:
                yield i, j, s, t

    # -- solids ---------------------------------------------------------------------------------------------------

    def union(
        self, shapes: Sequence[tuple[Path | Disc, Placement]], role: Role = "body", *, of: Sequence[str] = (), kind: str
    ) -> None:
        """Several shapes as one: with a line around all of them."""
        for width in (2 * INK, 0.0):
            for shape, place in shapes:
                self.board.put(shape, role, place, of=of, kind=kind, width=width, filled=True, layer=BODY)

    def drum(
        self,
        k: int,
        frame: int | None,
        axis: Array,
        radius: float,
        half: float,
        *,
        factor: sp.Expr | None = None,
        of: Sequence[str] = (),
        kind: str = "disc",
        spoke: Array | None = None,
    ) -> None:
        """A disc about a point across an axis [axes of the frame]; ``radius`` · factor and half its thickness [m]."""
        u, v = across(axis) if spoke is None else (spoke, cross(axis, spoke))
        put = self.board.put
        places = list[Placement]()
        for s in SECTIONS if half > 0 else (0.0,):
            centre = self.point(k, s * half * axis, frame) if s else k
            places.append(self.plane(centre, radius * u, radius * v, frame, factor))
        self.union([(CIRCLE, place) for place in places], of=of, kind=kind)
        for place in (swapped(places[0]), places[-1]):
            put(CIRCLE, "body", place, of=of, kind=kind, width=1.2, layer=BODY, facing=True)
            if spoke is not None:
                ray = line((0.0, 0.0), (1.0, 0.0)) if place is places[-1] else line((0.0, 0.0), (0.0, 1.0))
                put(ray, "thin", place, of=of, kind=kind, width=1.0, layer=BODY, facing=True)

    def box(
        self, k: int, frame: int | None, half: Array, *, of: Sequence[str] = (), kind: str = "box", filled: bool = True
    ) -> None:
        """A box about a point, with half its edges [m] along the axes of a frame."""
        corners = {
            signs: self.point(k, half * np.array(signs), frame)
            for signs in ((x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1))
        }
        square = line((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), closed=True)
        anchor = self.board.anchor
        for i in range(3):
            j, l = (i + 1) % 3, (i + 2) % 3
            for side in (-1, 1):
                base, u, v = [-1, -1, -1], [-1, -1, -1], [-1, -1, -1]
                base[i] = u[i] = v[i] = side
                first, second = (j, l) if side > 0 else (l, j)
                u[first], v[second] = 1, 1
                a, b, c = (anchor(corners[(x[0], x[1], x[2])]) for x in (base, u, v))
                place = Placement(a, b, across=c)
                self.board.put(
                    square, "body", place, of=of, kind=kind, filled=filled, layer=BODY, facing=filled,
                    width=INK if filled else 1.0,
                )  # fmt: skip

    def cylinder(
        self, a: int, b: int, frame: int | None, axis: Array, radius: float, *, of: Sequence[str] = (), kind: str,
    ) -> None:  # fmt: skip
        """A cylinder between two points along an axis [axes of the frame], ``radius`` [px]."""
        u, v = across(axis)
        size = radius * self.pixel
        start, end = (self.plane(k, size * u, size * v, frame) for k in (a, b))
        sides = line((0.0, -radius), (1.0, -radius), (1.0, radius), (0.0, radius), closed=True)
        self.union([(CIRCLE, start), (sides, self.board.towards(a, b)), (CIRCLE, end)], "body", of=of, kind=kind)
        for place in (swapped(start), end):
            self.board.put(CIRCLE, "body", place, of=of, kind=kind, width=1.0, layer=BODY, facing=True)

    def ring(self, k: int, frame: int | None, axis: Array, radius: float, width: float, *, of: Sequence[str]) -> None:
        """A ring about a point across an axis, ``radius`` [m]."""
        u, v = across(axis)
        place = self.plane(k, radius * u, radius * v, frame)
        for outline, inside in ((width, False), (width - 2 * INK, True)):
            self.board.put(CIRCLE, "body", place, of=of, kind="ring", width=outline, layer=BODY, inside=inside)

    def patch(self, k: int, normal: Array, radius: float, *, layer: int) -> None:
        """A hatched ellipse of ground [px] about a fixed point."""
        u, v = across(normal)
        size = radius * self.pixel
        place = self.plane(k, size * u, size * v)
        chords: list[list[tuple[float, float]]] = []
        c = np.sqrt(0.5)
        for s in np.linspace(-0.8, 0.8, 7):
            h = float(np.sqrt(1 - s * s))
            chords.append([(float(c * (s - h)), float(c * (s + h))), (float(c * (s + h)), float(c * (s - h)))])
        seen = self.board.view @ normal
        flat = float(np.sqrt(max(0.0, 1.0 - seen @ seen)))
        self.board.block(self.board.at(k), 1.9 * radius, 1.9 * radius * flat + 4.0)
        put = self.board.put
        put(CIRCLE, "ground", place, kind="pin", width=0.0, filled=True, layer=layer)
        put(lines(*chords), "ground", place, kind="pin", width=0.8, layer=layer)
        put(CIRCLE, "ground", place, kind="pin", width=1.4, layer=layer)


def across(axis: Array) -> tuple[Array, Array]:
    """Two unit vectors across a unit vector, u × v = axis; the first is along a coordinate axis where one is across."""
    least = int(np.argmin(np.abs(axis)))
    flat = -axis[least] * axis
    flat[least] += 1.0
    u: Array = flat / float(np.linalg.norm(flat))
    return u, cross(axis, u)


def cross(a: Array, b: Array) -> Array:
    """a × b of two vectors, without what NumPy does for arrays of them."""
    (ax, ay, az), (bx, by, bz) = a.tolist(), b.tolist()
    return np.array([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx])


def round_axis(n: Array, start: float, end: float) -> list[Array]:
    """Unit vectors around an axis, by angles from the first of the vectors across it."""
    u, v = across(n)
    return [np.cos(a) * u + np.sin(a) * v for a in np.linspace(start, end, 31)]


def swapped(place: Placement) -> Placement:
    """The other side of a plane."""
    return Placement(place.at, place.across, place.scaling, place.shift, place.shift, place.towards)


def nearest(one: tuple[Pair, Pair], two: tuple[Pair, Pair]) -> tuple[float, float, float]:
    """Where two pieces of lines are nearest to each other, by their parameters in [0, 1], and how far they are."""
    best = (0.5, 0.5, float("inf"))
    ((ax, ay), (bx, by)), ((cx, cy), (dx, dy)) = one, two
    ex, ey, fx, fy, gx, gy = bx - ax, by - ay, dx - cx, dy - cy, cx - ax, cy - ay
    cross = ex * fy - ey * fx
    tried: list[Pair] = []
    if abs(cross) > 1e-9:
        tried.append(((gx * fy - gy * fx) / cross, (gx * ey - gy * ex) / cross))
    for s in (0.0, 1.0):
        tried.append((s, _foot(fx, fy, s * ex - gx, s * ey - gy)))
    for t in (0.0, 1.0):
        tried.append((_foot(ex, ey, gx + t * fx, gy + t * fy), t))
    for s, t in tried:
        s, t = min(1.0, max(0.0, s)), min(1.0, max(0.0, t))
        gap = hypot(s * ex - t * fx - gx, s * ey - t * fy - gy)
        if gap < best[2] - 1e-9:
            best = (s, t, gap)
    return best


def _foot(ex: float, ey: float, px: float, py: float) -> float:
    """The parameter of the foot of the perpendicular from p on the line along e; both begin at 0."""
    square = ex * ex + ey * ey
    return (px * ex + py * ey) / square if square > 1e-12 else 0.5
