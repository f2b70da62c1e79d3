"""Draws what holds bodies in space: rods, hinges, stands on hatched ground, sleeves, hoops, floors, the fixed axes."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

import itertools
from math import pi

import numpy as np
from numpy.typing import NDArray

from lagrangian.look.board import BEHIND, BODY, GROUND, MEASURE, Board
from lagrangian.look.cast import BodyGlyph
from lagrangian.look.couplers import couplers
from lagrangian.look.holds import HoldKind
from lagrangian.look.shapes import INK, head, line, lines
from lagrangian.look.space_bodies import SpaceBodies
from lagrangian.look.space_cast import SpacePlayer
from lagrangian.look.space_solids import CIRCLE, across, round_axis
from lagrangian.look.space_turns import Spin, axis_now
from lagrangian.model import Ball, Rolling, time
from lagrangian.page.scene import Disc, Placement

Array = NDArray[np.float64]

POST = 44.0
"""How high a joint stands above its ground [px]."""


class SpaceSupports:
    """Draws supports; ``floor`` is the height of the ground on which wheels roll [m], None where there is none."""

    def __init__(self, bodies: SpaceBodies, holes: set[int]) -> None:
        self.bodies, self.board, self.solids = bodies, bodies.board, bodies.solids
        self.players, self.spins, self.up = bodies.players, bodies.spins, bodies.up
        self.floor: float | None = None
        self.holes = holes
        self.hung: dict[int, list[Array]] = {}

    def draw(self) -> None:
        """Draw everything that holds."""
        self._rods()
        self._hoops()
        self._joints()
        self._sleeves()
        self._grounds()
        self._floor()

    # -- rods -----------------------------------------------------------------------------------------------------

    def _rods(self) -> None:
        board, motions = self.board, self.board.motions
        contacts = {board.stage.index(e.at) for e in board.stage.model.elements if isinstance(e, Rolling)}
        for k in self._needed():
            hold = motions.holds[k]
            h = hold.holder
            if hold.how not in (HoldKind.ROD, HoldKind.TELESCOPE) or h in contacts or k in contacts:
                continue
            if (
                any(x.frame is not None and {k, h} <= {x.point, *x.points} for x in self.players)
                or self._hoop(k) is not None
            ):
                continue
            if float(np.linalg.norm(board.at(k) - board.at(h))) < 1.0 or self._on_track(k):
                continue
            rope = hold.how is HoldKind.TELESCOPE
            names = [b.name for b in board.stage.model.bodies if board.stage.index(b.at) == k]
            with self.solids.item(h, k, radius=2.0):
                board.put(
                    line((0.0, 0.0), (1.0, 0.0)), "rod", board.towards(h, k), of=names, kind="rope" if rope else "rod",
                    width=1.6 if rope else 3.0, layer=BODY,
                )  # fmt: skip
            board.fence(board.at(h), board.at(k))
            self.hung.setdefault(h, []).append(board.r[k] - board.r[h])
        for a, b in couplers(motions, self.players):
            with self.solids.item(a, b, radius=2.0):
                board.put(line((0.0, 0.0), (1.0, 0.0)), "rod", board.towards(a, b), kind="rod", width=3.0)
            board.fence(board.at(a), board.at(b))

    def _on_track(self, k: int) -> bool:
        return any(t.point == k for t in self.bodies.tracks)

    def _needed(self) -> list[int]:
        """The points of bodies and elements, and all that hold them."""
        board, found = self.board, set[int]()
        waiting = [x.point for x in self.players]
        for element in board.stage.model.elements:
            waiting += [board.stage.index(p) for _, p in element.points()]
        while waiting:
            k = waiting.pop()
            if k not in found and k < len(board.motions.holds):
                found.add(k)
                waiting.append(board.motions.holds[k].holder)
        return sorted(found)

    # -- hoops ----------------------------------------------------------------------------------------------------

    def _hoop(self, k: int) -> int | None:
        return hooped(self.board, k)

    def _hoops(self) -> None:
        """The circle on which a point runs in a plane that time turns, and the axis of that turn."""
        board, solids = self.board, self.solids
        for k, hold in enumerate(list(board.motions.holds)):
            if hold.how is not HoldKind.ROD or (frame := self._hoop(k)) is None:
                continue
            d, D = board.motions.local(k, hold.holder, frame)
            normal = np.cross(d[0], D[0][:, hold.moving[0]])
            normal /= np.linalg.norm(normal)
            radius = float(np.linalg.norm(board.r[k] - board.r[hold.holder]))
            factor = board.motions.length(k, hold.holder)
            u, v = across(normal)
            place = solids.plane(hold.holder, u, v, frame, factor)
            for width, inside in ((6.0, False), (6.0 - 2 * INK, True)):
                board.put(CIRCLE, "body", place, kind="hoop", width=width, layer=GROUND + 5, inside=inside)
            turns = np.linspace(0, 2 * pi, 17)
            spots = [
                board.at(hold.holder)
                + board.scale * radius * board.seen(solids.axes(frame) @ (np.cos(a) * u + np.sin(a) * v))
                for a in turns
            ]
            for a, b in itertools.pairwise(spots):
                board.fence(a, b)
            name = getattr(factor, "name", None)
            if name:
                self._radius(k, hold.holder, name)
            self._driven(frame, hold.holder, radius)

    def _radius(self, k: int, centre: int, name: str) -> None:
        board = self.board
        a, b = board.at(centre), board.at(k)
        board.put(line((0.0, 0.0), (1.0, 0.0)), "thin", board.towards(centre, k), kind="radius", width=1.0, layer=BODY)
        board.fence(a, b)
        e = b - a
        board.wish((name,), (a + b) / 2, (e[1], -e[0]), "thin", distance=3.0)

    def _driven(self, frame: int, k: int, radius: float) -> None:
        """The axis about which time turns a frame, with the letter of its speed."""
        board, solids = self.board, self.solids
        given = board.stage.frames[frame]
        assert given.axis is not None
        axis = np.array([float(x) for x in given.axis])
        long = radius + 30.0 * solids.pixel
        low, high = solids.point(k, -long * axis, frame), solids.point(k, long * axis, frame)
        board.put(
            line((0.0, 0.0), (1.0, 0.0)), "thin", board.towards(low, high), kind="axis", width=1.1, dashed=True,
            layer=BEHIND,
        )  # fmt: skip
        for side in (-1.0, 1.0):
            a = solids.point(k, side * radius * axis, frame)
            b = solids.point(k, side * (radius + 22.0 * solids.pixel) * axis, frame)
            board.put(
                line((0.0, 0.0), (1.0, 0.0)), "rod", board.towards(a, b), kind="axle", width=3.4, layer=GROUND + 6
            )
        foot = solids.point(k, -(radius + 22.0 * solids.pixel) * axis)
        solids.patch(foot, self.up, 26.0, layer=GROUND)
        names = tuple(sorted(str(s) for s in given.angle.free_symbols if s is not time))
        centre = board.r[k] + (radius + 20.0 * solids.pixel) * (solids.axes(frame) @ axis)
        path = [
            board.scale * (board.view @ (centre + 19.0 * solids.pixel * w))
            for w in round_axis(solids.axes(frame) @ axis, -0.35 * pi, 1.15 * pi)
        ]
        curved_arrow(board, path, "thin", names, kind="prescribed")
        board.wish(names, path[-1], (1.0, -0.5), "thin", distance=4.0)

    # -- joints ---------------------------------------------------------------------------------------------------

    def _joints(self) -> None:
        """A hinge along each axis about which something turns at a joint."""
        board = self.board
        groups: dict[int, list[Spin]] = {}
        for spin in self.spins:
            if not self._own_axle(spin):
                groups.setdefault(spin.joint, []).append(spin)
        stands = [x.point for x in self.players if x.glyph is BodyGlyph.STAND]
        for k, spins in groups.items():
            hinged = [s for s in spins if s.axis is not None and s.frame is not None]
            pedestal = next((x for x in self.players if x.point == k and x.glyph is BodyGlyph.STAND), None)
            if pedestal is not None:
                hinged = [s for s in hinged if s.frame != pedestal.frame]
            if self._contact(k) or self._tip(k):
                continue
            if len(hinged) == 1:
                self._hinge(k, hinged[0], 7.5, 11.0)
            elif len(hinged) == 2 and board.motions.still(k) and k not in stands:
                for spin in hinged:
                    self._hinge(k, spin, 4.5, 8.0)
            else:
                self._ball(k)
            board.block(board.at(k), 16, 16)
        for element in board.stage.model.constraints:
            if isinstance(element, Ball):
                self._ball(board.stage.index(element.between[0]), element.name)
        for frame in board.stage.model.floating:
            if frame.floating is not None and frame.floating.held:
                self._ball(board.stage.index(frame.origin), radius=7.5)

    def _tip(self, k: int) -> bool:
        """Whether a top stands on a point."""
        return any(x.stem == k and x.glyph is BodyGlyph.DISC for x in self.players) and self.board.motions.still(k)

    def _contact(self, k: int) -> bool:
        return any(
            isinstance(e, Rolling) and self.board.stage.index(e.at) == k for e in self.board.stage.model.elements
        )

    def _own_axle(self, spin: Spin) -> bool:
        """Whether a body turns about its own middle: its axle needs no hinge."""
        return any(
            x.point == spin.joint and (x.frame == spin.frame or spin.tip is None) and x.glyph is not BodyGlyph.STAND
            for x in self.players
        )

    def _hinge(self, k: int, spin: Spin, radius: float, half: float) -> None:
        """A short cylinder along an axis."""
        solids = self.solids
        assert spin.axis is not None
        a = solids.point(k, -half * solids.pixel * spin.axis, spin.base)
        b = solids.point(k, half * solids.pixel * spin.axis, spin.base)
        with solids.item(k, radius=radius, lift=7.0):
            solids.cylinder(a, b, spin.base, spin.axis, radius, kind="hinge")

    def _ball(self, k: int, name: str = "", radius: float = 5.2) -> None:
        board = self.board
        with self.solids.item(k, radius=6.0, lift=7.0):
            board.put(
                Disc((0.0, 0.0), radius), "body", board.placed(k), of=(name,) if name else (), kind="ball joint",
                filled=True, layer=BODY,
            )  # fmt: skip
        board.block(board.at(k), 12, 12)

    def _sleeves(self) -> None:
        """A guide where something slides through a body."""
        solids = self.solids
        for track in self.bodies.tracks:
            carrier = next((x for x in self.players if self.bodies.carries(x, track)), None)
            if carrier is None or track.foot == carrier.point or self._within(carrier, track.foot):
                continue
            a = solids.point(track.foot, -15.0 * solids.pixel * track.way, track.frame)
            b = solids.point(track.foot, 15.0 * solids.pixel * track.way, track.frame)
            with solids.item(a, b, radius=9.0, lift=6.0):
                solids.cylinder(a, b, track.frame, track.way, 9.5, of=(carrier.name,), kind="sleeve")

    def _within(self, carrier: SpacePlayer, foot: int) -> bool:
        """Whether a foot is a joint of its carrier, such as that of a telescope."""
        r = self.board.r
        return any(float(np.linalg.norm(r[foot] - r[k])) < 1e-9 for k in carrier.points)

    # -- ground ---------------------------------------------------------------------------------------------------

    def _grounds(self) -> None:
        """Hatched ground under, or over, every joint that does not move."""
        board, solids, motions = self.board, self.solids, self.board.motions
        for spin in self.spins:
            if motions.still(spin.joint) and not self._hooped(spin.joint):
                tips = [spin.tip] if spin.tip is not None else []
                tips += [x.point for x in self.players if spin.joint in x.points]
                self.hung.setdefault(spin.joint, []).extend(board.r[t] - board.r[spin.joint] for t in tips)
        for k, directions in self.hung.items():
            if not motions.still(k) or self._hooped(k) or k in self.holes:
                continue
            if k in self.bodies.feet:
                solids.patch(self.bodies.feet[k], self.up, 34.0, layer=GROUND)
                continue
            if any(x.point == k and x.glyph is BodyGlyph.RING for x in self.players):
                self._fork(k)
                continue
            total = np.sum(directions, axis=0) if directions else np.zeros(3)
            rise = float(total @ self.up) / (float(np.linalg.norm(total)) or 1.0)
            tip = self._tip(k) or sum(s.joint == k for s in self.spins) > 2 or self._leg(k)
            if rise < -0.3:
                self._post(k, 14.0, 24.0, 1.0)
            elif tip:
                solids.patch(k, self.up, 16.0 if self._leg(k) else 30.0, layer=GROUND)
            else:
                self._post(k, POST, 26.0, -1.0)

    def _leg(self, k: int) -> bool:
        """Whether a joint is one of many on the ground."""
        return sum(self.board.motions.still(j) for j in {s.joint for s in self.spins}) > 2 and k > 0

    def _hooped(self, k: int) -> bool:
        return any(h.holder == k and self._hoop(n) is not None for n, h in enumerate(self.board.motions.holds))

    def _post(self, k: int, height: float, radius: float, side: float) -> None:
        """A post between a joint and its ground, below it or above."""
        board, solids = self.board, self.solids
        foot = solids.point(k, side * height * solids.pixel * self.up)
        solids.patch(foot, self.up, radius, layer=GROUND)
        with solids.item(foot, k, radius=4.0, lift=-8.0):
            if height > 30:
                solids.cylinder(foot, k, None, -side * self.up, 6.0, kind="post")
            else:
                board.put(
                    line((0.0, 0.0), (1.0, 0.0)), "ground", board.towards(foot, k), kind="post", width=3.0, layer=BODY
                )
        board.block(board.at(foot), 2 * radius, 14)

    def _fork(self, k: int) -> None:
        """What holds the outermost gimbal: pins along its axis, the lower one on the ground."""
        solids = self.solids
        outer = max((x for x in self.players if x.point == k), key=lambda x: x.level)
        spin = next((s for s in self.spins if s.frame == outer.frame), None)
        if spin is None or spin.axis is None:
            return
        axis = axis_now(spin, self.solids.views)
        radius = self.bodies.reach[outer.name]
        down = axis if float(axis @ self.up) < 0 else -axis
        vertical = abs(float(axis @ self.up)) > 0.7
        for way in (down, -down):
            a = solids.point(k, radius * way)
            b = solids.point(k, (radius + 24.0 * solids.pixel) * way)
            with solids.item(a, b, radius=3.0):
                solids.cylinder(a, b, None, way, 4.5, kind="bearing")
            if way is down or not vertical:
                solids.patch(b, self.up, 28.0 if vertical else 14.0, layer=GROUND)

    # -- floor and fixed axes -------------------------------------------------------------------------------------

    def _floor(self) -> None:
        """A thin grid under what rolls."""
        board, solids = self.board, self.solids
        contacts = [board.stage.index(e.at) for e in board.stage.model.elements if isinstance(e, Rolling)]
        if not contacts:
            return
        r = board.r
        self.floor = float(r[contacts[0]] @ self.up)
        u, v = across(self.up)
        spots = np.array([[r[k] @ u, r[k] @ v] for k in [0, *contacts]])
        step = 44.0 * solids.pixel
        low = np.floor((spots.min(axis=0) - 46.0 * solids.pixel) / step) * step
        high = np.ceil((spots.max(axis=0) + 60.0 * solids.pixel) / step) * step
        base = board.stage.fixed(low[0] * u + low[1] * v + self.floor * self.up)
        size = high - low
        place = solids.plane(base, size[0] * u, size[1] * v)
        counts = [round(float(x / step)) for x in size]
        grid = [((n / counts[0], 0.0), (n / counts[0], 1.0)) for n in range(counts[0] + 1)]
        grid += [((0.0, n / counts[1]), (1.0, n / counts[1])) for n in range(counts[1] + 1)]
        board.put(lines(*grid), "thin", place, kind="grid", width=0.5, layer=GROUND)


def hooped(board: Board, k: int) -> int | None:
    """The frame that time turns and in which a point runs on a circle."""
    point = board.stage.points[k]
    if point.frame is None or k >= len(board.motions.holds) or len(board.motions.holds[k].moving) != 1:
        return None
    frame = board.stage.frames.index(point.frame)
    return frame if not board.motions.turns(frame) and time in point.frame.angle.free_symbols else None


def curved_arrow(
    board: Board, path: list[Array], role: str, names: tuple[str, ...], *, kind: str, width: float = 1.8,
    layer: int = MEASURE,
) -> None:  # fmt: skip
    """A curve through places [px] with an arrow's head at its end, for the picture at rest."""
    if len(path) == 2:
        a, b = path
        path = [a, b - 8.0 * (b - a) / max(9.0, float(np.linalg.norm(b - a))), b]
    lengths = np.cumsum([0.0, *(float(np.linalg.norm(b - a)) for a, b in itertools.pairwise(path))])
    last = int(np.searchsorted(lengths, lengths[-1] - 8.0))
    foot = path[max(0, min(last, len(path) - 2))]
    spots = [(float(x), float(y)) for x, y in path]
    board.put(
        line(*spots[: max(2, last + 1)]), role, of=names, kind=kind, width=width, layer=layer, moves=False,  # type: ignore[arg-type]
    )  # fmt: skip
    e = path[-1] - foot
    if float(np.linalg.norm(e)) > 1e-6:
        board.put(
            head(spots[-1], (float(e[0]), float(e[1]))), role, of=names, kind=kind, width=0.0, solid=True,  # type: ignore[arg-type]
            layer=layer, moves=False,
        )  # fmt: skip
    for a, b in zip(path[::2], path[2::2], strict=False):
        board.fence(a, b)


def draw_fixed_axes(board: Board, corner: Array) -> None:
    """The fixed axes in a corner of the picture."""
    pixel = 1.0 / board.scale
    at = board.at(0)
    shift = (float(corner[0] - at[0]), float(corner[1] - at[1]))
    for i, name in enumerate(("x", "y", "z")):
        end = board.stage.fixed(list(34.0 * pixel * np.eye(3)[i]))
        tip = corner + board.scale * board.seen(34.0 * pixel * np.eye(3)[i])
        e = tip - corner
        size = float(np.linalg.norm(e))
        place = Placement(board.anchor(0), board.anchor(end), "along", shift, shift)
        board.put(line((0.0, 0.0), (1.0, 0.0)), "thin", place, kind="axis", width=1.2, layer=MEASURE)
        point = Placement(board.anchor(end), board.anchor(0), "none", shift, shift)
        if size > 9.0:
            board.put(
                line((-3.0, 0.0), (5.0, 2.8), (5.0, -2.8), closed=True), "thin", point, kind="axis", width=0.0,
                solid=True, layer=MEASURE,
            )  # fmt: skip
        board.fence(corner, tip)
        board.wish((name,), tip, e if size > 3 else np.array([-1.0, 1.0]), "thin", distance=3.0)
