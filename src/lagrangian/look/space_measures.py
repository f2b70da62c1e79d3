"""Draws the lengths among the coordinates of a system in space, and tells what is not drawn."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lagrangian.look.board import BEHIND, GROUND
from lagrangian.look.holds import HoldKind
from lagrangian.look.shapes import line
from lagrangian.look.space import ArcArtist
from lagrangian.look.space_bodies import SpaceBodies
from lagrangian.look.space_supports import curved_arrow
from lagrangian.look.space_turns import Spin
from lagrangian.page.scene import Disc

Array = NDArray[np.float64]

SEEN = 40.0
"""A length that is seen well [px], which the advice for one that is too short asks for."""

MANY = 9
"""So many angles of like legs are not drawn."""


def floating_coordinates(bodies_model: object) -> frozenset[int]:
    """The numbers of the coordinates of floating frames."""
    model = bodies_model
    names = [c.name for c in model.coordinates]  # type: ignore[attr-defined]
    floats = [f.floating for f in model.floating if f.floating is not None]  # type: ignore[attr-defined]
    return frozenset(names.index(c.name) for f in floats for c in f.coordinates)


def shifts_of(motions) -> dict[int, list[tuple[int, Array]]]:  # type: ignore[no-untyped-def]
    """By point: the coordinates that move it along constant directions of the fixed axes, with these directions."""
    found: dict[int, list[tuple[int, Array]]] = {}
    known: set[int] = set()
    J = motions.views.J
    for k in range(1, J.shape[1]):
        for i in motions.coordinates(k):
            column = J[:, k, :, i]
            steady = float(np.abs(column - column[0]).max()) < 1e-9
            if i not in known and steady and abs(float(np.linalg.norm(column[0])) - 1.0) < 1e-9:
                found.setdefault(k, []).append((i, column[0]))
                known.add(i)
    return found


class SpaceMeasures:
    """Draws coordinates in space: arcs of angles, arrows of lengths."""

    def __init__(self, bodies: SpaceBodies, floating: frozenset[int], floor: float | None) -> None:
        self.bodies, self.board, self.floating, self.floor = bodies, bodies.board, floating, floor
        self.arcs = ArcArtist(bodies)

    def draw(self) -> None:
        """Draw every coordinate; what cannot be drawn is told."""
        board = self.board
        shifts = {i: (k, e) for k, ways in shifts_of(board.motions).items() for i, e in ways}
        spins = {s.coordinate: s for s in self.bodies.spins}
        legs = self._legs(list(spins.values()))
        if legs:
            board.lacks("angles of the legs are not drawn", "hide=[…] leaves this line out")
        chains: dict[int, list[tuple[int, Array]]] = {}
        circuits = {i for i, c in enumerate(board.stage.model.coordinates) if c in board.stage.model.charges}
        for i, coordinate in enumerate(board.stage.model.coordinates):
            name = coordinate.name
            if name in board.hidden or i in circuits or (i in self.floating and i not in shifts) or i in legs:
                continue
            if i in spins:
                self.arcs.arc(spins[i], name)
            elif i in shifts and not (self._joint(i) and self._along(i, name)):
                chains.setdefault(shifts[i][0], []).append((i, shifts[i][1]))
            elif i not in shifts and not self._along(i, name):
                board.lacks(f"coordinate {name} is not drawn", "[look] pose may show what it moves")
        for k, ways in chains.items():
            self._chain(k, ways)

    def _joint(self, i: int) -> bool:
        """Whether a coordinate is the length of a rope or the way of a sliding joint, whatever else it moves."""
        return any(t.coordinate == i for t in self.bodies.tracks) or any(
            h.how is HoldKind.TELESCOPE and h.along == i for h in self.board.motions.holds
        )

    def _legs(self, spins: list[Spin]) -> set[int]:
        """The angles at the joints of many like legs."""
        joints = {s.joint for s in spins if self.board.motions.still(s.joint)}
        found = {s.coordinate for s in spins if s.joint in joints}
        return found if len(found) >= MANY and len(joints) > 3 else set()

    # -- lengths --------------------------------------------------------------------------------------------------

    def _chain(self, k: int, ways: list[tuple[int, Array]]) -> None:
        """Arrows one after another from the origin to a point, on the floor if there is one."""
        board = self.board
        up = self.bodies.up
        names = [c.name for c in board.stage.model.coordinates]
        at = board.r[k] - sum(float(board.q[i]) * e for i, e in ways)
        if self.floor is not None and all(abs(float(e @ up)) < 1e-9 for _, e in ways):
            at = at + (self.floor - float(at @ up)) * up
        for i, e in ways:
            start, end = (board.scale * (board.view @ x) for x in (at, at + float(board.q[i]) * e))
            at = at + float(board.q[i]) * e
            length = float(np.linalg.norm(end - start))
            if length < 14.0:
                seen = board.scale * float(np.linalg.norm(board.view @ e))  # pixels of a metre
                way = f'pose = {{ {names[i]} = "{SEEN / max(seen, 1e-3 * board.scale):.1g} m" }}'
                board.lacks(f"coordinate {names[i]} is not drawn, because it is too short here", f"[look] {way}")
                continue
            curved_arrow(board, [start, end], "coordinate", (names[i],), kind="coordinate", layer=GROUND + 2)
            n = np.array([start[1] - end[1], end[0] - start[0]]) / length
            n = n if n[1] > 0 else -n
            board.wish((names[i],), (start + end) / 2, n, "coordinate", (names[i],), distance=4.0)
        spot = board.scale * (board.view @ at)
        board.put(
            Disc((float(spot[0]), float(spot[1])), 2.4), "coordinate", kind="coordinate", solid=True, width=0.0,
            layer=GROUND + 2, moves=False,
        )  # fmt: skip

    def _along(self, i: int, name: str) -> bool:
        """An arrow beside a sliding joint or a rope."""
        board = self.board
        start = end = None
        for track in self.bodies.tracks:
            if track.coordinate == i:
                start, end = board.at(track.foot), board.at(track.point)
        for hold in board.motions.holds:
            if start is None and hold.how is HoldKind.TELESCOPE and hold.along == i:
                start, end = board.at(hold.holder), board.at(hold.point)
        if start is None or end is None:
            return False
        length = float(np.linalg.norm(end - start))
        if length < 12.0:
            board.lacks(f"coordinate {name} is not drawn, because it points at the eye", "choose another azimuth")
            return True
        e = (end - start) / length
        n = np.array([-e[1], e[0]])
        n = n if n[0] > 0 else -n
        off = 24.0
        a, b = start + off * n, end + off * n
        for spot, mark in ((start, a), (end, b)):
            board.put(
                line((float(spot[0]), float(spot[1])), (float((mark + 4 * n)[0]), float((mark + 4 * n)[1]))), "thin",
                kind="measure", width=0.8, layer=BEHIND, moves=False,
            )  # fmt: skip
        board.arrow(a, b, "coordinate", of=(name,), kind="coordinate", width=1.8)
        board.wish((name,), (a + b) / 2, n, "coordinate", (name,), distance=4.0)
        return True
