"""Draws forces, torques and gravity."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from math import pi
from typing import Any

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.look.board import EFFORT, Board
from lagrangian.look.cast import BodyGlyph, Player
from lagrangian.look.shapes import BLOCK, BOB, CART
from lagrangian.look.spread import slide_along
from lagrangian.look.tie_glyphs import symbol_names
from lagrangian.look.ties import Resolver, Tie
from lagrangian.look.turning import Turn
from lagrangian.model import Element, Force, Frame, Torque, Transducer

Array = NDArray[np.float64]

LENGTH = 46.0
"""The length of the arrow of a force [px]."""


class EffortArtist:
    """Draws the forces and torques of a system."""

    def __init__(
        self, board: Board, parts: list[Player], turns: list[Turn], ties: list[Tie], resolver: Resolver
    ) -> None:
        self.board, self.parts, self.turns, self.ties, self.resolver = board, parts, turns, ties, resolver
        self.by_point = {part.point: part for part in parts}
        self.around: dict[int, int] = {}

    def draw(self) -> None:
        """Draw all forces and torques."""
        for element in self.board.stage.model.elements:
            if element.name in self.board.hidden:
                continue
            if isinstance(element, Force):
                self._force(element)
            elif isinstance(element, Torque):
                self._torque(element)
            elif isinstance(element, Transducer):
                self._winding(element)

    # -- forces -------------------------------------------------------------------------------------------------

    def _force(self, element: Force) -> None:
        if element.at is None or not isinstance(element.value, tuple):
            self._along(element, self.resolver.resolve(element), self._unit_value(element.value))
            return
        board, k = self.board, self.board.stage.index(element.at)
        components = element.value
        frame = getattr(element, "axes", None)
        if isinstance(frame, Frame):
            components = frame.in_fixed_axes(components)
        F = np.array([self._unit_value(x) for x in components])
        seen = board.seen(F) if len(F) == board.stage.dimension else np.zeros(2)
        if not np.isfinite(seen).all() or np.linalg.norm(seen) < 1e-9:
            board.lacks(f"{element.title} is not drawn, because it is nothing at rest", "")
            return
        self._arrow(element, k, seen / np.linalg.norm(seen))

    def _unit_value(self, expr: Any) -> float:
        """The value of a component in the pose, at rest, with every input 1."""
        return self.board.stage.value(expr, self.board.q, self.board.p, u=1.0)

    def _arrow(self, element: Element, k: int, e: Array, *, pull: bool | None = None) -> None:
        """An arrow at a point: it pushes from behind where that side is free, otherwise it pulls."""
        board, part = self.board, self.by_point.get(k)
        reach = self._reach(part, e)
        at = board.at(k)
        push = (
            part is not None and part.glyph in (BodyGlyph.CART, BodyGlyph.BLOCK, BodyGlyph.WEDGE)
            if pull is None
            else not pull
        )
        if push and pull is None and self._taken(k, -e):
            push = False
        beside = not push and part is not None and part.direction is not None and self._taken(k, e)
        if beside and part is not None:
            w, h = CART if part.glyph is BodyGlyph.CART else BLOCK
            across = np.array([-abs(e[1]), -abs(e[0])])
            at, reach = at + ((w if abs(e[1]) > 0.7 else h) / 2 + 9.0) * across, 0.0
        if part is not None and part.glyph is BodyGlyph.WEDGE:
            at = at + board.faces[k][:2]
            reach = 0.0
        tip = -reach * e if push else (reach + LENGTH) * e
        start, end = (at + tip - LENGTH * e, at + tip) if push else (at + reach * e, at + tip)
        shift = at - board.at(k)
        place = board.placed(k, float(shift[0]), float(shift[1]))
        of = (element.name,)
        board.arrow(start - at, end - at, "input", place, of=of, kind="force", moves=False)
        board.fence(start, end)
        n = np.array([-e[1], e[0]])
        n = n if n[1] < 0 or (n[1] == 0 and n[0] > 0) else -n
        board.wish(
            symbol_names(element), (start if push else end) * 0.75 + (end if push else start) * 0.25, n, "input", of
        )

    def _reach(self, part: Player | None, e: Array) -> float:
        """From the middle of a body to its edge."""
        if part is None:
            return 4.0
        if part.glyph is BodyGlyph.BALL:
            return BOB
        if part.glyph in (BodyGlyph.CART, BodyGlyph.BLOCK):
            w, h = CART if part.glyph is BodyGlyph.CART else BLOCK
            return min(w / 2 / max(abs(e[0]), 1e-9), h / 2 / max(abs(e[1]), 1e-9))
        return 8.0

    def _taken(self, k: int, side: Array) -> bool:
        """Whether a spring or dashpot is on that side of a sliding body."""
        board = self.board
        part = self.by_point[k]
        if part.direction is None:
            return False
        e = slide_along(board, part)
        if abs(float(side @ e)) < 0.7:
            return False
        if any(point == k and float(wall * (e @ side)) > 0 for point, wall in board.walled):
            return True
        pairs = [(t.a, t.b) for t in self.ties if t.way == "slides" and t.element.kind in ("spring", "damper")]
        others = [b if a == k else a for a, b in pairs if k in (a, b)]
        return any(float((board.at(x) - board.at(k)) @ side) > 0 for x in others if isinstance(x, int))

    def _along(self, element: Force | Transducer, tie: Tie, value: float) -> None:
        """An effort along a deflection: on one body, or a pair; the sign of its value says in which sense."""
        board = self.board
        sense = 1.0 if value >= 0 else -1.0
        if isinstance(element, Transducer) and tie.way in ("slides", "points", "telescope"):
            board.straight.add(element.name)
        if tie.way == "slides" and isinstance(tie.b, int):
            eb = self._positive(tie.b)
            if tie.a is None:
                self._arrow(element, tie.b, sense * tie.sign * eb)
            else:
                assert isinstance(tie.a, int)
                self._arrow(element, tie.b, sense * tie.sign * eb, pull=True)
                self._arrow(element, tie.a, -sense * tie.sign * eb, pull=True)
            return
        if tie.way in ("points", "telescope") and isinstance(tie.a, int) and isinstance(tie.b, int):
            e = board.at(tie.b) - board.at(tie.a)
            e = sense * tie.sign * e / (np.linalg.norm(e) or 1.0)
            self._beside(element, tie.b, e)
            if tie.way == "points" and not board.motions.still(tie.a):
                self._beside(element, tie.a, -e)
            return
        if tie.way in ("joint", "arm") and isinstance(tie.b, Turn):
            self._around(element, tie.b, sense * tie.sign)
            return
        board.lacks(f"{element.title} is not drawn, because its deflection belongs to no pair of points or bodies", "")

    def _winding(self, element: Transducer) -> None:
        """The effort of a winding in a magnet's field on what it moves, for a positive current."""
        if not isinstance(element.on, Frame):
            self._along(element, self.resolver.driven(element, element.on), self._unit_value(element.k))
            return
        turn = self._turned(element)
        if turn is None:
            self.board.lacks(f"{element.title} is not drawn, because nothing was found that turns by its angle", "")
            return
        self._around(element, turn, 1.0 if self._unit_value(element.k) >= 0 else -1.0)

    def _positive(self, k: int) -> Array:
        """The direction on the screen in which the slide of a body counts positive in `Tie.sign`."""
        part = self.by_point[k]
        assert part.direction is not None
        e = self.board.seen(part.direction)
        return e / np.linalg.norm(e)

    def _beside(self, element: Element, k: int, e: Array) -> None:
        """An arrow along a rope or between two points, beside the line."""
        board = self.board
        n = np.array([-e[1], e[0]])
        n = n if n[0] < 0 else -n
        at = board.at(k) + 13.0 * n
        start, end = at + 12.0 * e, at + (12.0 + LENGTH) * e
        board.arrow(start - board.at(k), end - board.at(k), "input", board.placed(k), of=(element.name,), kind="force")
        board.fence(start, end)
        board.wish(symbol_names(element), (start + end) / 2, n, "input", (element.name,))

    # -- torques ------------------------------------------------------------------------------------------------

    def _torque(self, element: Torque) -> None:
        turn = self._turned(element)
        if turn is None:
            self.board.lacks(f"{element.title} is not drawn, because nothing was found that turns by its angle", "")
            return
        value = element.value if isinstance(element.value, sp.Expr) else sum(element.value, sp.S.Zero)
        self._around(element, turn, 1.0 if self._unit_value(value) >= 0 else -1.0)

    def _turned(self, element: Torque | Transducer) -> Turn | None:
        if isinstance(element.on, Frame):
            number = self.board.stage.frames.index(element.on)
            return next((t for t in self.turns if t.frame == number), None) or self._joint_of(number)
        tie = self.resolver.along(element, element.on)
        if tie.way in ("joint", "arm") and isinstance(tie.b, Turn):
            return tie.b if tie.sign > 0 else Turn(tie.b.joint, tie.b.tip, -tie.b.slopes, tie.b.frame, tie.b.name)
        return None

    def _joint_of(self, frame: int) -> Turn | None:
        """What turns with a frame that no body has: a body of a frame above it."""
        frames = self.board.stage.frames
        for turn in self.turns:
            at = frames[turn.frame] if turn.frame is not None else None
            while at is not None:
                if at is frames[frame]:
                    return turn
                at = at.parent
        return None

    def _around(self, element: Element, turn: Turn, sense: float) -> None:
        """An arc with an arrow around a joint, on the side away from what turns."""
        board, of = self.board, (element.name,)
        if turn.name in board.shaft_spots:
            spot = board.shaft_spots[turn.name] + (-34.0, 0.0)
            start, end = (1.25 * pi, 0.75 * pi) if sense > 0 else (0.75 * pi, 1.25 * pi)
            board.bow(spot, 15.0, start, end, "input", of=of, kind="torque", width=2.0, layer=EFFORT)
            board.wish(symbol_names(element), spot + (-8.0, -16.0), (-0.6, -1.0), "input", of)
            return
        at = board.at(turn.joint)
        radius = 22.0 + 8.0 * self.around.get(turn.joint, 0)
        self.around[turn.joint] = self.around.get(turn.joint, 0) + 1
        part = next((p for p in self.parts if p.name == turn.name), None)
        if (
            part is not None
            and part.radius is not None
            and part.point == turn.joint
            and part.glyph is not BodyGlyph.BEAM
        ):
            radius = board.pixels(part.radius) + 9.0
        tip = board.at(turn.tip) - at
        back = float(np.arctan2(-tip[1], -tip[0])) if np.linalg.norm(tip) > 1 else pi
        if board.motions.still(turn.joint) and np.linalg.norm(tip) > 1:  # beside its support
            back = pi if tip[0] >= 0 else 0.0
        if turn.slopes[np.flatnonzero(turn.slopes)].sum() < 0 and board.stage.dimension == 2 and turn.frame is None:
            sense = -sense
        half = 65 * pi / 180
        start, end = (back + half, back - half) if sense > 0 else (back - half, back + half)
        board.bow(at, radius, start, end, "input", of=of, kind="torque", width=2.0, layer=EFFORT)
        out = np.array([np.cos(back), np.sin(back)])
        board.wish(symbol_names(element), at + radius * out, out, "input", of)


def draw_gravity(board: Board, corner: Array) -> None:
    """The arrow of gravity in a corner of the picture."""
    for element in board.stage.model.elements:
        if element.kind != "gravity" or element.name in board.hidden:
            continue
        components = [board.stage.value(x, board.q, board.p) for x in getattr(element, "direction")]  # noqa: B009
        e = board.seen(components)
        size = float(np.linalg.norm(e))
        if size < 0.2:
            board.lacks("gravity is not drawn, because it points away from the eye", "[look] view = another elevation")
            continue
        e = e / size
        start, end = corner, corner + 46.0 * e
        board.arrow(start, end, "gravity", of=(element.name,), kind="gravity")
        board.block((start + end) / 2, 14, 14)
        strength = sp.sympify(getattr(element, "g"))  # noqa: B009
        names = tuple(s.name for s in strength.free_symbols)[:1] or ("g",)
        board.wish(names, (start + end) / 2 + 6.0 * e, (1.0, 0.0), "gravity", (element.name,))
