"""Draws forces, torques, springs and dampers in space."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import pi
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.look.board import EFFORT, GROUND, JOINT
from lagrangian.look.cast import Player
from lagrangian.look.effort_glyphs import LENGTH, EffortArtist
from lagrangian.look.holds import Motions
from lagrangian.look.space_bodies import SpaceBodies, Track
from lagrangian.look.space_solids import CIRCLE, across, round_axis
from lagrangian.look.space_supports import curved_arrow
from lagrangian.look.space_turns import axis_now
from lagrangian.look.tie_glyphs import TieArtist, names_in, symbol_names
from lagrangian.look.ties import Resolver, Tie
from lagrangian.look.turning import Turn
from lagrangian.model import Element, Force, Frame, Torque
from lagrangian.page.scene import Role

Array = NDArray[np.float64]

SEEN = 0.22
"""An arrow whose seen part of its length is less than this points at the eye."""


class SpaceTies(TieArtist):
    """Ties in space: rings around the axes of joints, and patches of ground."""

    def __init__(self, bodies: SpaceBodies, ties: list[Tie]) -> None:
        super().__init__(bodies.board, list(bodies.players), ties)
        self.bodies = bodies
        self.said: set[tuple[str, ...]] = set()
        many = [t.way for t in ties].count("telescope") > 4
        self.crowded = many

    def _one(self, tie: Tie, offset: float) -> None:
        names = symbol_names(tie.element)
        if self.crowded and tie.way == "telescope" and isinstance(tie.a, int) and isinstance(tie.b, int):
            shown = () if names in self.said else names
            self.said.add(names)
            self._between(tie, tie.a, tie.b, 1.3 * offset, shown, ROLE[tie.element.kind])
            return
        beside = any(t.point == tie.b for t in self.bodies.tracks) and tie.way == "telescope"
        super()._one(tie, offset - 20.0 if beside else offset)

    def _anchorage(self, k: int, towards: Array) -> None:
        if not self.crowded:
            self.bodies.solids.patch(k, self.bodies.up, 18.0, layer=GROUND)

    def _at_joint(self, tie: Tie, turn: Turn, names: tuple[str, ...], role: Role) -> None:
        """A dashed ring across the axis of a joint: a spiral would need its plane."""
        board, solids, of = self.board, self.bodies.solids, (tie.element.name,)
        spin = next((s for s in self.bodies.spins if turn.slopes[s.coordinate]), None)
        if spin is None or spin.axis is None:
            super()._at_joint(tie, turn, names, role)
            return
        level = self.rings[turn.joint] = self.rings.get(turn.joint, -1) + 1
        u, v = across(spin.axis)
        size = (15.0 + 5.0 * level) * solids.pixel
        place = solids.plane(turn.joint, size * u, size * v, spin.base)
        spring = tie.element.kind == "spring"
        board.put(CIRCLE, role, place, of=of, kind=tie.element.kind, dashed=not spring, width=2.2, layer=JOINT + 1)
        at = board.at(turn.joint)
        board.block(at, 22 + 8 * level, 22 + 8 * level)
        tip = board.at(turn.tip) - at
        board.wish(names, at, -tip + (-8.0, 0.0), role, of, distance=16.0 + 5 * level)


class TrackResolver(Resolver):
    """What a deflection ties together, where sliding joints are counted from where they are at 0."""

    def __init__(self, motions: Motions, parts: list[Player], turns: list[Turn], tracks: Sequence[Track]) -> None:
        super().__init__(motions, parts, turns)
        self.tracks = tracks

    def along(self, element: Element, deflection: Any) -> Tie:
        """What a deflection ties together."""
        tie = super().along(element, deflection)
        for track in self.tracks:
            if tie.way == "telescope" and tie.b == track.point:
                return replace(tie, a=track.foot)
        return tie


ROLE: dict[str, Role] = {"spring": "stiffness", "damper": "damping", "friction": "friction"}


class SpaceEfforts(EffortArtist):
    """Efforts in space: arrows in their true direction, arcs across the axis of a torque."""

    def __init__(self, bodies: SpaceBodies, turns: list[Turn], ties: list[Tie], resolver: Resolver) -> None:
        super().__init__(bodies.board, list(bodies.players), turns, ties, resolver)
        self.bodies = bodies
        self.rounds: dict[int, int] = {}

    # -- forces -------------------------------------------------------------------------------------------------

    def _force(self, element: Force) -> None:
        if element.at is None or not isinstance(element.value, tuple):
            super()._force(element)
            return
        board, k = self.board, self.board.stage.index(element.at)
        components: Any = element.value
        if isinstance(element.axes, Frame):
            components = element.axes.in_fixed_axes(components)
        F = np.array([self._unit_value(x) for x in components])
        size = float(np.linalg.norm(F))
        if not np.isfinite(F).all() or size < 1e-9:
            board.lacks(f"{element.title} is not drawn, because it is nothing at rest", "")
            return
        seen = board.seen(F / size)
        if float(np.linalg.norm(seen)) < SEEN:
            board.lacks(f"{element.title} is not drawn, because it points at the eye", "choose another azimuth")
            return
        part = self.by_point.get(k)
        start = (10.0 if part is not None else 4.0) * seen
        place, of = board.placed(k), (element.name,)
        end = start + (LENGTH + 10.0) * seen
        board.arrow(start, end, "input", place, of=of, kind="force")
        at = board.at(k)
        board.fence(at + start, at + end)
        board.wish(symbol_names(element), at + end, (1.0, -0.2), "input", of, distance=4.0)

    # -- torques ------------------------------------------------------------------------------------------------

    def _torque(self, element: Torque) -> None:
        if isinstance(element.value, tuple):
            self._about_axes(element)
            return
        turn = self._turned(element)
        if turn is None:
            self.board.lacks(f"{element.title} is not drawn, because nothing was found that turns by its angle", "")
            return
        self._around(element, turn, 1.0 if self._unit_value(element.value) >= 0 else -1.0)

    def _about_axes(self, element: Torque) -> None:
        """A torque with three components: an arc about each axis that has one, at the body's centre."""
        board = self.board
        frames = board.stage.frames
        on = frames.index(element.on) if isinstance(element.on, Frame) else None
        part = next((x for x in self.parts if x.frame == on), None)
        joint = 0 if part is None else part.point
        axes = self.bodies.solids.axes(frames.index(element.axes) if isinstance(element.axes, Frame) else None)
        reach = 0.0 if part is None else self.bodies.reach.get(part.name, 0.0)
        for i, x in enumerate(element.value):
            value = self._unit_value(x)
            if abs(value) < 1e-12:
                continue
            centre = board.r[joint] + (reach + 14.0 * self.bodies.solids.pixel) * axes[:, i]
            self._bow(element, centre, axes[:, i], 15.0, float(np.sign(value)), tuple(names_in(x)[:1]))

    def _around(self, element: Element, turn: Turn, sense: float) -> None:
        """An arc about the axis of what turns, open towards it."""
        board, bodies = self.board, self.bodies
        spin = next((s for s in bodies.spins if s.frame is not None and s.frame == turn.frame), None)
        if spin is None:
            spin = next((s for s in bodies.spins if turn.slopes[s.coordinate]), None)
        if spin is None:
            super()._around(element, turn, sense)
            return
        n = axis_now(spin, bodies.solids.views)
        player = next((x for x in bodies.players if x.point == spin.joint and x.frame == spin.frame), None)
        centre = board.r[spin.joint]
        level = self.rounds[spin.joint] = self.rounds.get(spin.joint, -1) + 1
        radius, pixel = 24.0 + 7.0 * level, bodies.solids.pixel
        if spin.joint in bodies.feet and player is not None:
            foot = board.r[bodies.feet[spin.joint]]
            centre, radius = 0.45 * foot + 0.55 * centre, 27.0
        elif player is not None and player.name in bodies.reach:
            reach = bodies.reach[player.name]
            if player.radius is not None:  # at the end of an axle, beside the disc
                side = 1.0 if float(n @ bodies.solids.eye) > 0 else -1.0
                centre, radius = centre + (player.thickness + 12.0 * pixel) * side * n, min(22.0, 0.5 * reach / pixel)
            else:
                centre = centre + (reach + 14.0 * pixel) * n
                radius = 15.0
        elif abs(float(n @ bodies.up)) > 0.9 and board.motions.still(spin.joint):
            centre, radius = centre - 24.0 * pixel * bodies.up, 21.0  # about the post
        self._bow(element, centre, n, radius, sense, symbol_names(element))

    def _bow(
        self, element: Element, centre: Array, n: Array, radius: float, sense: float, names: tuple[str, ...]
    ) -> None:
        """Three quarters of a circle about an axis, with its gap away from the eye."""
        board, pixel = self.board, self.bodies.solids.pixel
        u, v = across(n)
        towards = np.array([u @ self.bodies.solids.eye, v @ self.bodies.solids.eye])
        front = float(np.arctan2(towards[1], towards[0])) if np.linalg.norm(towards) > 1e-6 else 0.0
        turns = (front - 0.72 * pi, front + 0.72 * pi)
        start, end = turns if sense > 0 else turns[::-1]
        path = [board.scale * (board.view @ (centre + radius * pixel * w)) for w in round_axis(n, start, end)]
        curved_arrow(board, path, "input", (element.name,), kind="torque", width=2.0, layer=EFFORT)
        middle = board.scale * (board.view @ centre)
        spot = max(path, key=lambda x: float(-x[0] - 0.3 * x[1]))
        board.wish(names, spot, spot - middle, "input", (element.name,), distance=4.0)
