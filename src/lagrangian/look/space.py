"""Arcs in space: an angle is drawn in the plane across its axis, from where it counts to where things are."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lagrangian.look.board import BEHIND, MEASURE
from lagrangian.look.cast import BodyGlyph
from lagrangian.look.shapes import line
from lagrangian.look.space_bodies import SpaceBodies
from lagrangian.look.space_solids import across, cross
from lagrangian.look.space_supports import curved_arrow
from lagrangian.look.space_turns import Spin, axis_now

Array = NDArray[np.float64]

ARC = 52.0
"""The radius of an arc in space [px]."""
SMALL = 0.12
"""A smaller angle [rad] is shown by an arrow around its axis."""


def rotated(n: Array, angles: Array, d: Array) -> Array:
    """A vector after turns about the unit vector n (Rodrigues), (angles, 3)."""
    sine, cosine = np.sin(angles)[:, None], np.cos(angles)[:, None]
    return cosine * d + sine * cross(n, d) + (1 - cosine) * (n @ d) * n


class ArcArtist:
    """Draws the angles of a system in space."""

    def __init__(self, bodies: SpaceBodies) -> None:
        self.bodies, self.board, self.solids = bodies, bodies.board, bodies.solids
        self.levels: dict[int, int] = {}
        """The axis of every arc [fixed axes], by the number of its coordinate."""

    def arc(self, spin: Spin, name: str) -> None:
        """The arc of one angle: dashed lines are where it counts from and, where no body shows it, where it is."""
        board = self.board
        n = axis_now(spin, self.solids.views)
        now, shown = self._direction(spin, n)
        centre, radius = self._place(spin, n)
        angle = float(board.q[spin.coordinate])
        origin = board.scale * (board.view @ centre)

        def spots(angles: Array, size: float) -> list[Array]:
            return [*(origin + size * (rotated(n, angles, now) @ board.view.T))]

        if abs(angle) < SMALL:
            path = spots(np.linspace(-0.9, 0.9, 25), 0.75 * radius)
        else:
            path = spots(np.linspace(-angle, 0.0, 33), radius)
            start, end = spots(np.array([-angle, 0.0]), radius + 20.0)
            self._reference(origin, start)
            if not shown:
                self._reference(origin, end)
        curved_arrow(board, path, "coordinate", (name,), kind="coordinate", layer=MEASURE)
        middle = path[len(path) // 2]
        board.wish((name,), middle, middle - origin, "coordinate", (name,), distance=4.0)
        if spin.frame is None and spin.axis is not None and spin.tip is not None:
            self._shadow(spin, n)

    def _reference(self, start: Array, end: Array) -> None:
        board = self.board
        board.put(
            line((float(start[0]), float(start[1])), (float(end[0]), float(end[1]))), "thin", kind="reference",
            width=1.1, dashed=True, layer=BEHIND, moves=False,
        )  # fmt: skip
        board.fence(start, end)

    def _direction(self, spin: Spin, n: Array) -> tuple[Array, bool]:
        """The direction that turns, across the axis, as a unit vector, and whether a body shows it."""
        r = self.board.r
        if spin.tip is not None:
            d = r[spin.tip] - r[spin.joint]
            flat = d - (d @ n) * n
            size = float(np.linalg.norm(flat))
            if size > 0.05 * float(np.linalg.norm(d)):
                return flat / size, size > 0.98 * float(np.linalg.norm(d))
        if spin.frame is None:
            return across(n)[0], False
        axes = self.solids.axes(spin.frame)
        options = [axes[:, i] for i in range(3) if abs(float(axes[:, i] @ n)) < 1e-6] or [across(n)[0]]
        disc = self._disc_of(spin)
        return options[0], disc is not None

    def _disc_of(self, spin: Spin) -> BodyGlyph | None:
        """What a body that turns about its own middle is drawn as."""
        for x in self.bodies.players:
            if x.frame == spin.frame and x.point == spin.joint and x.glyph in (BodyGlyph.WHEEL, BodyGlyph.DISC):
                return x.glyph
        return None

    def _place(self, spin: Spin, n: Array) -> tuple[Array, float]:
        """The centre of an arc [m] and its radius [px]."""
        board = self.board
        centre = board.r[spin.joint]
        player = next((x for x in self.bodies.players if x.frame == spin.frame and x.point == spin.joint), None)
        foot = self.bodies.feet.get(spin.joint)
        if player is not None and player.glyph is BodyGlyph.STAND and foot is not None:
            return board.r[foot], ARC
        if player is not None and player.name in self.bodies.reach:
            size = self.bodies.reach[player.name] * board.scale
            if player.glyph in (BodyGlyph.WHEEL, BodyGlyph.DISC):
                lift = player.thickness if float(n @ self.solids.eye) > 0 else -player.thickness
                return centre + lift * n, 0.62 * size if size > 62 else size + 9.0
            return centre, size + 12.0
        if not board.motions.still(spin.joint) and spin.frame is not None:
            centre = centre + self._height(spin, n) * n
        level = self.levels[spin.joint] = self.levels.get(spin.joint, -1) + 1
        return centre, ARC + 9.0 * level

    def _height(self, spin: Spin, n: Array) -> float:
        """How far along its axis an arc lies from its joint [m]: at the middle of a body that is far up the axis."""
        r = self.board.r
        heights = [
            float((r[x.point] - r[spin.joint]) @ n) for x in self.bodies.players if self._turned_by(spin, x.point)
        ]
        best = max(heights, key=abs, default=0.0)
        return best if abs(best) * self.board.scale > 36.0 else 0.0

    def _turned_by(self, spin: Spin, k: int) -> bool:
        """Whether a body hangs on the joint of a spin itself, a little off its axis."""
        r = self.board.r
        d = r[k] - r[spin.joint]
        off = float(np.linalg.norm(cross(axis_now(spin, self.solids.views), d))) > 1e-6 * float(np.linalg.norm(d))
        return off and k not in (spin.joint, spin.tip) and self.board.motions.carried(k, spin.joint, spin.frame)

    def _shadow(self, spin: Spin, n: Array) -> None:
        """From the end of a rod along the axis down to the plane of its direction."""
        board, r = self.board, self.board.r
        assert spin.tip is not None
        d = r[spin.tip] - r[spin.joint]
        foot = r[spin.joint] + d - (d @ n) * n
        a, b = (board.scale * (board.view @ x) for x in (r[spin.joint], foot))
        self._reference(a, b)
        self._reference(board.at(spin.tip), b)
