"""Draws the bodies of systems in space."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

import itertools
from math import pi

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.look.board import BODY, Board
from lagrangian.look.bodies import cog, mass_names
from lagrangian.look.cast import BodyGlyph
from lagrangian.look.holds import HoldKind
from lagrangian.look.pose import up_axis
from lagrangian.look.shapes import BOB, INK, arc, line
from lagrangian.look.space_cast import SpacePlayer
from lagrangian.look.space_solids import CIRCLE, Solids, across
from lagrangian.look.space_turns import Spin, axis_now
from lagrangian.page.scene import Disc, Placement, Trace
from lagrangian.records import dataclass

Array = NDArray[np.float64]

WIDE, SLIM = 13.0, 8.0
"""The width of a link, and of a rod that slides in one [px]."""
PEDESTAL = 46.0
"""The height of a turntable [px]."""
LEAST = 16.0
"""The least half edge of a body's box [px]."""


@dataclass(frozen=True)
class Track:
    """A point that slides along a direction of a frame: ``foot`` is where it is at 0, ``way`` the direction there."""

    point: int
    foot: int
    coordinate: int
    frame: int
    way: Array


def tracks_of(board: Board, solids: Solids) -> list[Track]:
    """The sliding joints of a system in space."""
    found: list[Track] = []
    motions, stage = board.motions, board.stage
    for hold in list(motions.holds):
        if hold.how is not HoldKind.TRACK or hold.along is None or hold.frame is None:
            continue
        _, X = motions.local(hold.point, hold.holder, hold.frame)
        way = X[0, :, hold.along]
        symbol = stage.model.coordinates[hold.along].symbol
        foot = stage.add(hold.point, [-symbol * _neat(x) for x in way], stage.frames[hold.frame])
        board.extend(board.r[hold.point] - solids.axes(hold.frame) @ way * float(board.q[hold.along]))
        found.append(Track(hold.point, foot, hold.along, hold.frame, way / np.linalg.norm(way)))
    return found


def _neat(x: float) -> sp.Expr:
    return sp.Integer(round(x)) if abs(x - round(x)) < 1e-12 else sp.Float(x, 17)


class SpaceBodies:
    """Draws bodies as solids; ``feet`` are the lower ends of turntables by their joints."""

    def __init__(
        self, board: Board, solids: Solids, players: list[SpacePlayer], spins: list[Spin], tracks: list[Track]
    ) -> None:
        self.board, self.solids, self.players, self.spins, self.tracks = board, solids, players, spins, tracks
        self.up = up_axis(board.motions)
        self.feet: dict[int, int] = {}
        self.reach: dict[str, float] = {}
        """How far a body reaches from its centre [m]."""
        self.said: set[tuple[str, ...]] = set()

    def draw(self) -> None:
        """Draw all bodies."""
        for x in sorted(self.players, key=lambda x: x.level):
            glyph = x.glyph
            if glyph is BodyGlyph.NONE:
                continue
            if glyph is BodyGlyph.BALL:
                self._ball(x)
            elif glyph in (BodyGlyph.WHEEL, BodyGlyph.DISC, BodyGlyph.PULLEY) and x.radius is not None:
                self._disc(x)
            elif glyph is BodyGlyph.STAND:
                self._stand(x)
            elif glyph is BodyGlyph.RING:
                self._ring(x)
            elif glyph is BodyGlyph.STAR:
                self._star(x)
            elif glyph is BodyGlyph.PLATE and len(x.points) > 1:
                self._plate(x)
            elif glyph in (BodyGlyph.LINK, BodyGlyph.BAR, BodyGlyph.PLATE, BodyGlyph.BEAM) and self._link(x):
                pass
            else:
                self._box(x)
            self.board.handles.append(self.board.anchor(x.point))

    def _say(self, x: SpacePlayer, near: Array, away: Array, distance: float) -> None:
        names = mass_names(x)
        alike = sum(mass_names(y) == names for y in self.players)
        if alike < 3 or names not in self.said:  # the same letter for many bodies is written once
            self.board.wish(names, near, away, "body", (x.name,), distance=distance)
        self.said.add(names)

    # -- small and round ------------------------------------------------------------------------------------------

    def _ball(self, x: SpacePlayer) -> None:
        board = self.board
        with self.solids.item(x.point, radius=BOB, lift=1.0):
            board.put(Disc((0.0, 0.0), BOB), "body", board.placed(x.point), of=(x.name,), kind="ball", filled=True)
        board.block(board.at(x.point), 2 * BOB, 2 * BOB)
        self._say(x, board.at(x.point), np.array([1.0, 0.25]), BOB + 4)

    def _disc(self, x: SpacePlayer) -> None:
        board, solids = self.board, self.solids
        assert x.direction is not None and x.radius is not None
        radius = solids.value(x.radius)
        self.reach[x.name] = radius
        u, _ = across(x.direction)
        if x.stem is not None:
            self._stem(x, x.stem)
        with solids.item(x.point, radius=radius * board.scale * 0.8):
            solids.drum(
                x.point, x.frame, x.direction, 1.0, x.thickness, factor=x.radius, of=(x.name,),
                kind=x.glyph.value, spoke=u,
            )  # fmt: skip
        self._round_fence(x.point, x.frame, x.direction, radius)
        cog_at = board.at(x.point)
        down = board.seen(-self.up)
        side = np.array([1.0, 0.4]) if cog_at[0] >= board.at(0)[0] else np.array([-1.0, 0.4])
        near = cog_at + self._edge(x.frame, x.direction, radius, side) if np.linalg.norm(down) else cog_at
        self._say(x, near, side, 4.0)

    def _edge(self, frame: int | None, axis: Array, radius: float, side: Array) -> Array:
        """From the middle of a disc to its edge on one side [px]."""
        u, v = (self.solids.axes(frame) @ w for w in across(axis))
        best = max(
            (self.board.seen(radius * (np.cos(a) * u + np.sin(a) * v)) for a in np.linspace(0, 2 * np.pi, 24)),
            key=lambda w: float(w @ side),
        )
        return self.board.scale * best

    def _round_fence(self, k: int, frame: int | None, axis: Array, radius: float) -> None:
        board = self.board
        u, v = (self.solids.axes(frame) @ w for w in across(axis))
        turns = np.linspace(0, 2 * np.pi, 13)
        spots = [board.at(k) + board.scale * radius * board.seen(np.cos(a) * u + np.sin(a) * v) for a in turns]
        for a, b in itertools.pairwise(spots):
            board.fence(a, b)

    def _stem(self, x: SpacePlayer, foot: int) -> None:
        """The axle of a disc that stands on a point, to the other side as well."""
        board, solids = self.board, self.solids
        gap = board.r[x.point] - board.r[foot]
        inside = solids.axes(x.frame).T @ gap
        top = solids.point(x.point, 0.75 * inside, x.frame)
        for a, b in ((foot, x.point), (x.point, top)):
            with solids.item(a, b, radius=3.0):
                self.bar(a, b, 6.0, (x.name,), "axle")

    def bar(self, a: int, b: int, width: float, of: tuple[str, ...], kind: str = "link") -> None:
        """A round bar between two points."""
        board, place, shape = self.board, self.board.towards(a, b), line((0.0, 0.0), (1.0, 0.0))
        board.put(shape, "body", place, of=of, kind=kind, width=width, layer=BODY)
        board.put(shape, "body", place, of=of, kind=kind, width=width - 2 * INK, layer=BODY, inside=True)
        start, end = board.at(a), board.at(b)
        e = (end - start) / (np.linalg.norm(end - start) or 1.0)
        n = width / 2 * np.array([-e[1], e[0]])
        board.fence(start + n, end + n)
        board.fence(start - n, end - n)

    # -- long -----------------------------------------------------------------------------------------------------

    def _link(self, x: SpacePlayer) -> bool:
        """A bar through its joints, as far as what slides in it; one that ends at its centre goes on as far again."""
        board, solids = self.board, self.solids
        ends = self._ends(x)
        if ends is None:
            return False
        a, b = ends
        thin = board.motions.holds[x.point].how is HoldKind.TRACK
        with solids.item(a, b, radius=SLIM / 2 if thin else WIDE / 2, lift=-3.0 if thin else 0.0):
            self.bar(a, b, SLIM if thin else WIDE, (x.name,))
        x.glyph = BodyGlyph.LINK
        if not thin:
            cog(board, x, 4.5)
        e = board.at(b) - board.at(a)
        n = np.array([e[1], -e[0]]) if e[0] > 0 else np.array([-e[1], e[0]])
        self._say(x, board.at(x.point), -n, WIDE / 2 + 4)
        return True

    def _ends(self, x: SpacePlayer) -> tuple[int, int] | None:
        """The two ends of a link, from its joint outward, and back to what lies beyond the joint."""
        board, solids, r = self.board, self.solids, self.board.r
        own = next((t for t in self.tracks if t.point == x.point), None)
        if own is not None and not x.points:
            beyond = solids.point(own.foot, -44.0 * solids.pixel * self._outward(own), own.frame)
            return beyond, x.point
        inside = [t.foot for t in self.tracks if self.carries(x, t)]
        everything = [x.point, *x.points, *inside]
        if len(everything) < 2:
            return None
        holder = board.motions.holds[x.point].holder
        joint = holder if holder in x.points else x.points[0] if x.points else inside[0]
        far = max(everything, key=lambda k: float(np.linalg.norm(r[k] - r[joint])))
        if far == x.point:
            frame = solids.axes(x.frame)
            far = solids.point(joint, frame.T @ (2 * (r[x.point] - r[joint])), x.frame)
        back = {k: float((r[k] - r[joint]) @ (self.board.r[far] - r[joint])) for k in everything}
        return min([joint, *everything], key=lambda k: back.get(k, 0.0)), far

    def _outward(self, track: Track) -> Array:
        return track.way if float(self.board.q[track.coordinate]) >= 0 else -track.way

    def carries(self, x: SpacePlayer, track: Track) -> bool:
        """Whether a body is what something slides in: the foot of the track is at rest in it."""
        if x.point == track.point or x.frame != track.frame or x.frame is None:
            return False
        return not any(y is not x and y.point == track.point and y.frame == x.frame for y in self.players)

    def _plate(self, x: SpacePlayer) -> None:
        """A flat body through its points, in the order in which they lie around its middle."""
        board, solids = self.board, self.solids
        points = list(x.points) if len(x.points) > 2 else [x.point, *x.points]
        spots = board.r[points]
        middle = spots.mean(axis=0)
        _, _, basis = np.linalg.svd(spots - middle)
        flat = (spots - middle) @ basis[:2].T
        order = np.argsort(np.arctan2(flat[:, 1], flat[:, 0]))
        anchors = tuple(board.anchor(points[i]) for i in order)
        shape = Trace(anchors, True)
        with solids.item(x.point, radius=20.0, lift=0.0 if len(x.points) < 3 else 2.0):
            board.put(shape, "body", of=(x.name,), kind="plate", width=12.0, layer=BODY)
            board.put(
                shape, "body", of=(x.name,), kind="plate", width=12.0 - 2 * INK, filled=True, layer=BODY, inside=True
            )
        for i, j in zip(order, [*order[1:], order[0]], strict=True):
            board.fence(board.at(points[i]), board.at(points[j]))
        cog(board, x, 4.5)
        self._say(x, board.at(x.point), np.array([1.0, 0.5]), 9.0)

    # -- solid ----------------------------------------------------------------------------------------------------

    def _box(self, x: SpacePlayer) -> None:
        """A box with the inertia of the body; only its edges where another body is inside."""
        board, solids = self.board, self.solids
        half = x.half * max(1.0, LEAST / board.scale / float(x.half.max()))
        half = np.maximum(half, 5.0 * solids.pixel)
        self.reach[x.name] = float(half.max())
        if x.stem is not None:
            with solids.item(x.stem, x.point, radius=3.0, lift=-2.0):
                self.bar(x.stem, x.point, 7.0, (x.name,), "link")
        hollow = any(y.point == x.point and y is not x for y in self.players)
        x.glyph = BodyGlyph.BLOCK
        size = float(np.linalg.norm(half)) * board.scale
        with solids.item(x.point, radius=0.5 * size, lift=1.0):
            solids.box(x.point, x.frame, half, of=(x.name,), kind="box", filled=not hollow)
        corners = [
            board.at(x.point) + board.scale * board.seen(solids.axes(x.frame) @ (half * np.array(s)))
            for s in (
                (1, 1, 1),
                (1, 1, -1),
                (1, -1, 1),
                (1, -1, -1),
                (-1, 1, 1),
                (-1, 1, -1),
                (-1, -1, 1),
                (-1, -1, -1),
            )
        ]
        low, high = np.min(corners, axis=0), np.max(corners, axis=0)
        board.block((low + high) / 2, *(0.8 * (high - low)))
        cog(board, x, 4.5)
        self._say(x, max(corners, key=lambda c: float(c[0] - 0.6 * c[1])), np.array([1.0, 0.3]), 3.0)
        self.body_axes(x, half)

    def body_axes(self, x: SpacePlayer, half: Array) -> None:
        """The axes of a floating body, a little longer than itself."""
        board, solids = self.board, self.solids
        if x.frame is None or board.stage.frames[x.frame].floating is None:
            return
        for i, name in enumerate(("x_b", "y_b", "z_b")):
            long = float(half[i]) + 26.0 * solids.pixel
            self.axis_arrow(x.point, long * np.eye(3)[i], x.frame, name)

    def axis_arrow(self, k: int, offset: Array, frame: int | None, name: str) -> None:
        """A thin arrow along an axis with its letter."""
        board, solids = self.board, self.solids
        end = solids.point(k, offset, frame)
        start, tip = board.at(k), board.at(end)
        size = float(np.linalg.norm(tip - start))
        if size < 8.0:
            return
        place = board.towards(k, end)
        board.put(line((0.0, 0.0), (1.0, 0.0)), "thin", place, kind="axis", width=1.1, layer=BODY + 5)
        e = (tip - start) / size
        point = Placement(board.anchor(end), board.anchor(k), "none")
        head = line((0.0, 0.0), (7.0, 2.6), (7.0, -2.6), closed=True)
        board.put(head, "thin", point, kind="axis", width=0.0, solid=True, layer=BODY + 5)
        board.fence(start, tip)
        board.wish((name,), tip, e, "thin", distance=2.0)

    def _star(self, x: SpacePlayer) -> None:
        """Arms from the middle to where forces act, each with a rotor across its force."""
        board, solids = self.board, self.solids
        reach = min(float(np.linalg.norm(board.r[k] - board.r[x.point])) for k in x.tips)
        self.reach[x.name] = reach
        normal = np.eye(3)[int(np.argmax(x.moments[:3]))] if x.moments is not None else np.array([0.0, 0.0, 1.0])
        u, v = across(normal)
        for k in x.tips:
            with solids.item(x.point, k, radius=4.0):
                self.bar(x.point, k, 7.0, (x.name,), "arm")
            hub = solids.point(k, 7.0 * solids.pixel * normal, x.frame)
            radius = 0.45 * reach
            with solids.item(hub, radius=radius * board.scale * 0.7, lift=6.0):
                rotor = solids.plane(hub, radius * u, radius * v, x.frame)
                board.put(CIRCLE, "body", rotor, of=(x.name,), kind="rotor", width=1.2, layer=BODY, filled=True)
            self._round_fence(hub, x.frame, normal, radius)
        half = reach * (0.18 * u + 0.18 * v + 0.09 * normal)
        with solids.item(x.point, radius=10.0, lift=4.0):
            solids.box(x.point, x.frame, np.abs(half), of=(x.name,), kind="box")
        board.block(board.at(x.point), 24, 18)
        self._say(x, board.at(x.point) + np.array([0.0, 10.0]), np.array([0.2, 1.0]), 8.0)
        self.body_axes(x, np.full(3, 0.3 * reach))

    def _stand(self, x: SpacePlayer) -> None:
        """A turntable: a short column below its joint."""
        board, solids = self.board, self.solids
        spin = next((s for s in self.spins if s.frame == x.frame), None)
        axis = self.up if spin is None else axis_now(spin, self.solids.views)
        inside = solids.axes(x.frame).T @ axis
        if float(axis @ self.up) < 0:
            inside = -inside
        top = solids.point(x.point, -9.0 * solids.pixel * inside, x.frame)
        foot = solids.point(x.point, -PEDESTAL * solids.pixel * inside, x.frame)
        with solids.item(foot, top, radius=17.0, lift=-4.0):
            solids.cylinder(foot, top, x.frame, inside, 17.0, of=(x.name,), kind="turntable")
        self.feet[x.point] = foot
        middle = (board.at(foot) + board.at(top)) / 2
        board.block(middle, 34, abs(board.at(foot)[1] - board.at(top)[1]) + 8)
        self._say(x, middle + np.array([-17.0, 8.0]), np.array([-1.0, 0.4]), 5.0)

    def _ring(self, x: SpacePlayer) -> None:
        """A gimbal: a ring in the plane of its own axis and of that of the body in it, with pins along the latter."""
        board, solids = self.board, self.solids
        nest = sorted((y for y in self.players if y.point == x.point and y.frame is not None), key=lambda y: y.level)
        inner = nest[x.level - 1]
        own = next((s for s in self.spins if s.frame == x.frame), None)
        child = next((s for s in self.spins if s.frame == inner.frame), None)
        base = max(self.reach.get(inner.name, 0.0), 30.0 * solids.pixel)
        radius = 1.3 * base + 4.0 * solids.pixel
        self.reach[x.name] = radius
        axes = solids.axes(x.frame).T
        n = np.array([0.0, 0.0, 1.0]) if own is None else axes @ axis_now(own, solids.views)
        c = across(n)[0] if child is None else axes @ axis_now(child, solids.views)
        normal = np.cross(n, c)
        size = float(np.linalg.norm(normal))
        normal = across(n)[0] if size < 1e-6 else normal / size
        for side in (-1.0, 1.0):
            inside = base if x.level > 1 else 0.0
            a = solids.point(x.point, side * inside * c, x.frame)
            b = solids.point(x.point, side * radius * c, x.frame)
            with solids.item(a, b, radius=2.0):
                board.put(
                    line((0.0, 0.0), (1.0, 0.0)), "rod", board.towards(a, b), of=(x.name,), kind="pin", width=3.4,
                    layer=BODY,
                )  # fmt: skip
        self._half_rings(x, normal, radius)
        self._round_fence(x.point, x.frame, normal, radius)
        spot = board.at(x.point) + self._edge(x.frame, normal, radius, np.array([-1.0, 0.6]))
        self._say(x, spot, np.array([-1.0, 0.6]), 5.0)

    def _half_rings(self, x: SpacePlayer, normal: Array, radius: float) -> None:
        """A ring as eight arcs, so that what is in it lies before one half and behind the other."""
        board, solids = self.board, self.solids
        u, v = across(normal)
        place = solids.plane(x.point, radius * u, radius * v, x.frame)
        pieces = [(n * pi / 4, (n + 1) * pi / 4) for n in range(8)]
        more = 4.0 * solids.pixel / radius  # the inside covers the round end of the line
        for start, end in pieces:
            a, b = (solids.point(x.point, radius * (np.cos(t) * u + np.sin(t) * v), x.frame) for t in (start, end))
            with solids.item(a, b, radius=4.0):
                for width, by, inside in ((7.0, 0.0, False), (7.0 - 2 * INK, more, True)):
                    shape = arc(1.0, start - by, end + by)
                    board.put(shape, "body", place, of=(x.name,), kind="ring", width=width, layer=BODY, inside=inside)
