"""Draws springs, dampers and friction: between bodies, to walls, at joints, along ropes."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Sequence
from math import pi

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.look.board import GROUND, JOINT, TIE, Board
from lagrangian.look.cast import BodyGlyph, Player
from lagrangian.look.driven import moved_by_time, moving_names, to_and_fro
from lagrangian.look.holds import HoldKind
from lagrangian.look.shaft_glyphs import draw_shaft, on_shaft
from lagrangian.look.shapes import BLOCK, CART, arc, coil, dashpot, floor, heading, line, spiral, turned
from lagrangian.look.spread import slide_along, wall_side
from lagrangian.look.supports import WALL, sole_of
from lagrangian.look.ties import Tie
from lagrangian.look.turning import Turn
from lagrangian.model import Element
from lagrangian.page.scene import Disc, Path, Placement, Role

Array = NDArray[np.float64]

APART = 20.0
"""The distance of parallel ties [px]."""
ARM = 105.0
"""How far the wall is from a lever [px]."""

ROLES: dict[str, Role] = {"spring": "stiffness", "damper": "damping", "friction": "friction"}


class TieArtist:
    """Draws the ties of a system, those between the same bodies side by side."""

    def __init__(self, board: Board, parts: list[Player], ties: list[Tie]) -> None:
        self.board, self.parts = board, parts
        self.by_point = {part.point: part for part in parts}
        self.ties = [t for t in ties if t.element.kind in ROLES and t.element.name not in board.hidden]
        self.springs = {t.b for t in self.ties if t.element.kind == "spring" and t.way == "slides" and t.a is None}
        self.walls: set[tuple[float, float]] = set()
        self.right: dict[int, int] = {}
        self.arms = 0
        self.measured: set[tuple[int, str]] = set()
        self.rings: dict[int, int] = {}

    def draw(self) -> None:
        """Draw all ties."""
        draw_shaft(self.board)
        groups: dict[object, list[Tie]] = {}
        for tie in self.ties:
            groups.setdefault(self._pair(tie), []).append(tie)
        for group in groups.values():
            for n, tie in enumerate(group):
                self._one(tie, (n - (len(group) - 1) / 2) * APART)

    def _pair(self, tie: Tie) -> object:
        if tie.way == "slides" and tie.a is None:
            if self._is_friction(tie):
                return ("friction", tie.element.name)
            return ("wall", tie.b, self._side(tie))
        ends = tuple(id(x) if isinstance(x, Turn) else x for x in (tie.a, tie.b))
        return (tie.way, frozenset(ends) if tie.way != "arm" else tie.element.name)

    def _is_friction(self, tie: Tie) -> bool:
        part = self.by_point.get(tie.b) if isinstance(tie.b, int) else None
        wheels = part is not None and part.glyph in (BodyGlyph.CART, BodyGlyph.BLOCK, BodyGlyph.WHEEL)
        return wheels and tie.element.kind != "spring" and tie.b not in self.springs and self.board.stage.dimension == 2

    def _one(self, tie: Tie, offset: float) -> None:
        board = self.board
        names = symbol_names(tie.element)
        role = ROLES[tie.element.kind]
        if tie.way in ("points", "telescope") and isinstance(tie.a, int) and isinstance(tie.b, int):
            self._between(tie, tie.a, tie.b, offset, names, role)
        elif tie.way == "stop" and isinstance(tie.b, int):
            self._stop(tie, tie.b, offset, names, role)
        elif tie.way == "slides" and isinstance(tie.b, int):
            if isinstance(tie.a, int):
                self._between_slides(tie, tie.a, tie.b, offset, names, role)
            elif self._is_friction(tie):
                self._friction(tie, tie.b, names, role)
            else:
                self._to_wall(tie, tie.b, offset, names, role)
        elif tie.way == "arm" and isinstance(tie.b, Turn):
            self._lever(tie, tie.b, names, role)
        elif tie.way == "joint" and isinstance(tie.b, Turn):
            self._at_joint(tie, tie.b, names, role)
        else:
            board.lacks(
                f"{tie.element.title} is not drawn, because its deflection belongs to no pair of points or bodies",
                'a [[look.line]] with kind = "string" shows where it runs',
            )

    # -- along a line -------------------------------------------------------------------------------------------

    def _glyph(self, tie: Tie, length: float) -> Path:
        if tie.element.kind == "spring":
            return coil(int(np.clip(length / 14.0, 4, 10)))
        return dashpot()

    def _strung(self, tie: Tie, place: Placement, start: Array, end: Array, names: tuple[str, ...], role: Role) -> None:
        """A spring or dashpot between two seen places, with its label beside the middle."""
        length = float(np.linalg.norm(end - start))
        kind = tie.element.kind
        self.board.put(self._glyph(tie, length), role, place, of=(tie.element.name,), kind=kind, layer=TIE, width=1.7)
        n = np.array([end[1] - start[1], start[0] - end[0]]) / (length or 1.0)
        n = -n if n[1] > 0 or (abs(n[1]) < 1e-9 and n[0] < 0) else n
        owner = tie.a if isinstance(tie.a, int) else tie.b
        aside = float((start - self.board.at(owner)) @ n) if isinstance(owner, int) else 0.0
        n = -n if aside < -APART / 4 else n  # of two side by side, each has its label on its own side
        middle = (start + end) / 2
        for side in (-6.0, 6.0):
            self.board.fence(start + 0.15 * (end - start) + side * n, end - 0.15 * (end - start) + side * n)
        self.board.wish(names, middle, n, role, (tie.element.name,), distance=12.0)

    def _between(self, tie: Tie, a: int, b: int, offset: float, names: tuple[str, ...], role: Role) -> None:
        board = self.board
        start, end = board.at(a), board.at(b)
        length = float(np.linalg.norm(end - start)) or 1.0
        e = (end - start) / length
        n = np.array([e[1], -e[0]])
        da, db = offset * n + self._edge(a, e) * e, offset * n - self._edge(b, -e) * e
        place = Placement(board.anchor(a), board.anchor(b), "along", self._shifted(a, da), self._shifted(b, db))
        self._strung(tie, place, start + da, end + db, names, role)
        for k in (a, b):
            if board.motions.still(k) and tie.way == "points" and not self._supported(k):
                self._anchorage(k, end - start if k == a else start - end)

    def _edge(self, k: int, e: Array) -> float:
        """How far the edge of a block that only slides is from its point, in a direction."""
        part = self.by_point.get(k)
        if part is None or part.glyph is not BodyGlyph.BLOCK or self._lift(k, slide_along(self.board, part)).any():
            return 0.0
        w, h = BLOCK
        return min(w / 2 / max(abs(float(e[0])), 1e-9), h / 2 / max(abs(float(e[1])), 1e-9))

    def _supported(self, k: int) -> bool:
        """Whether a link or a rod has its support at a point."""
        turning = (HoldKind.ROD, HoldKind.TELESCOPE)
        held = any(h.holder == k and h.how in turning and h.point != k for h in self.board.motions.holds)
        return held or any(k in part.points for part in self.parts)

    def _anchorage(self, k: int, towards: Array) -> None:
        """The piece of wall at which a tie ends, across its direction."""
        board = self.board
        key = (float(round(board.at(k)[0])), float(round(board.at(k)[1])))
        if key in self.walls:
            return
        self.walls.add(key)
        steep = abs(towards[1]) > abs(towards[0])
        angle = (pi if towards[1] > 0 else 0.0) if steep else (pi / 2 if towards[0] > 0 else -pi / 2)
        board.put(turned(floor(-20.0, 20.0), angle), "ground", board.placed(k), kind="wall", layer=GROUND)
        board.put(Disc((0.0, 0.0), 2.2), "ground", board.placed(k), kind="wall", solid=True, filled=True, layer=JOINT)
        board.block(board.at(k), 30, 20)

    # -- sliding bodies -----------------------------------------------------------------------------------------

    def _half(self, k: int, e: Array) -> float:
        part = self.by_point.get(k)
        if part is None or k in self.board.faces:
            return 0.0
        w, h = CART if part.glyph is BodyGlyph.CART else BLOCK if part.glyph is BodyGlyph.BLOCK else (16.0, 16.0)
        if part.glyph is BodyGlyph.WHEEL:
            return 0.0
        if part.glyph is BodyGlyph.BLOCK and 0.1 < abs(e[1]) < 0.95:
            return 22.0
        return w / 2 if abs(e[0]) > 0.5 else h / 2

    def _rim(self, k: int) -> float:
        """The radius of a wheel [px]; 0 for other bodies."""
        part = self.by_point.get(k)
        if part is None or part.glyph is not BodyGlyph.WHEEL or part.radius is None:
            return 0.0
        return self.board.pixels(part.radius)

    def _shifted(self, k: int, by: Array) -> tuple[float, float]:
        x, y = self.board.shift(k)
        return x + float(by[0]), y + float(by[1])

    def _lift(self, k: int, e: Array) -> Array:
        """From a body's point to where ties hold it: a block on a slope lies above its point, a wedge has its side."""
        part = self.by_point.get(k)
        if k in self.board.faces:
            return np.array(self.board.faces[k][:2])
        if part is not None and part.glyph is BodyGlyph.BLOCK and 0.1 < abs(e[1]) < 0.95:
            n = np.array([-e[1], e[0]])
            return (n if n[1] < 0 else -n) * BLOCK[1] / 2
        return np.zeros(2)

    def _between_slides(self, tie: Tie, a: int, b: int, offset: float, names: tuple[str, ...], role: Role) -> None:
        board = self.board
        e = slide_along(board, self.by_point[a])
        if float((board.at(b) - board.at(a)) @ e) < 0:
            a, b = b, a
        n = np.array([-e[1], e[0]])
        da = self._half(a, e) * e + offset * n + self._lift(a, e)
        db = -self._half(b, e) * e + offset * n + self._lift(b, e)
        place = Placement(board.anchor(a), board.anchor(b), "along", self._shifted(a, da), self._shifted(b, db))
        self._strung(tie, place, board.at(a) + da, board.at(b) + db, names, role)

    def _side(self, tie: Tie) -> float:
        """On which side of a body its wall is: −1 for the left or below, 1 for the right or above."""
        board, k = self.board, tie.b
        assert isinstance(k, int)
        part = self.by_point[k]
        e = slide_along(board, part)
        if k in board.faces:
            return board.faces[k][2] * float(np.sign(e[0]))
        others = [p for p in self.parts if p is not part and p.direction is not None and p.glyph is part.glyph]
        before = [p for p in others if (board.at(p.point) - board.at(k)) @ e < -30.0]
        after = [p for p in others if (board.at(p.point) - board.at(k)) @ e > 30.0]
        if before != after and not (before and after):
            return 1.0 if before else -1.0
        side = wall_side(board, part, tie)
        springs = [
            t for t in self.ties if t.way == "slides" and t.a is None and t.b == k and t.element.kind == "spring"
        ]
        same = [t for t in springs if wall_side(board, part, t) == side]
        return -side if tie in same[1::2] else side

    def _to_wall(self, tie: Tie, k: int, offset: float, names: tuple[str, ...], role: Role) -> None:
        board, side = self.board, self._side(tie)
        if isinstance(tie.b, int):
            board.walled.add((tie.b, side))
        e = slide_along(board, self.by_point[k])
        n = np.array([-e[1], e[0]])
        offset *= 0.7 if self._lift(k, e).any() else 1.0  # a block on a slope has its floor just below
        edge = side * self._half(k, e) * e + offset * n + self._lift(k, e)
        wall_at = self._half(k, e) + WALL + self._rim(k)
        away = side * wall_at * e + offset * n + self._lift(k, e)
        base = self._tied_to_rest(tie, k, edge, away, names, role)
        key = (float(round(board.at(k)[0])), side)
        if key not in self.walls:
            self.walls.add(key)
            self._wall(k, base, side * wall_at * e + self._lift(k, e), side * e, 29.0)
            if moved_by_time(board, tie.element):
                at = board.at(k) + side * (wall_at + 8.0) * e + self._lift(k, e) + 48.0 * n
                to_and_fro(board, at, e, moving_names(board, [getattr(tie.element, "deflection")]))  # noqa: B009

    def _stop(self, tie: Tie, k: int, offset: float, names: tuple[str, ...], role: Role) -> None:
        """A tie from a point of a body to the ground, along x or y."""
        board = self.board
        e = np.array([-tie.sign, 0.0]) if tie.axis == 0 else np.array([0.0, tie.sign])
        n = np.array([-e[1], e[0]])
        base = self._tied_to_rest(tie, k, offset * n, offset * n + WALL * e, names, role)
        key = (float(round(board.at(k)[0])), float(round(board.at(k)[1])) + 0.5)
        if key not in self.walls:
            self.walls.add(key)
            self._wall(k, base, WALL * e, e, 26.0)
            if moved_by_time(board, tie.element):
                names = moving_names(board, [getattr(tie.element, "deflection")])  # noqa: B009
                to_and_fro(board, board.at(k) + (WALL + 8.0) * e + 44.0 * n, e, names)

    def _tied_to_rest(self, tie: Tie, k: int, near: Array, far: Array, names: tuple[str, ...], role: Role) -> int:
        """A tie between two places, both by their steps from a point [px]; the far one is at rest, at this point."""
        board = self.board
        base = board.stage.fixed(board.r[k])
        ends = self._shifted(k, near), self._shifted(k, far)
        place = Placement(board.anchor(k), board.anchor(base), "along", *ends)
        self._strung(tie, place, board.at(k) + near, board.at(k) + far, names, role)
        return base

    def _wall(self, k: int, base: int, foot: Array, e: Array, half: float) -> None:
        """Hatched ground at a step from a point, across the direction in which it lies."""
        board = self.board
        angle = heading((float(e[0]), float(e[1]))) - pi / 2
        place = Placement(board.anchor(base), shift=self._shifted(k, foot))
        board.put(turned(floor(-half, half), angle), "ground", place, kind="wall", layer=GROUND)
        long = 2 * half - 14
        board.block(board.at(k) + foot + 4 * e, 16 + long * abs(e[1]), 16 + long * abs(e[0]))

    def _friction(self, tie: Tie, k: int, names: tuple[str, ...], role: Role) -> None:
        """A thick dashed line where the body meets its floor, or a wall on its left where it moves up and down."""
        board = self.board
        e = slide_along(board, self.by_point[k])
        n = np.array([-e[1], e[0]])
        upright = abs(n[0]) > 0.95
        n = n if n[1] > 0.05 or (upright and n[0] < 0) else -n
        beside = BLOCK[0] / 2 + 1.0 if upright else sole_of(board, self.by_point[k]) or 0.0
        foot = (beside + 3.0) * n
        angle = heading((float(e[0]), float(e[1])))
        if upright:
            edge = Placement(board.anchor(board.stage.fixed(board.r[k])), shift=self._shifted(k, (beside + 5.0) * n))
            board.put(turned(floor(-38.0, 38.0), pi / 2), "ground", edge, kind="floor", layer=GROUND)
        place = board.placed(k, float(foot[0]), float(foot[1]))
        shape = turned(line((-32.0, 0.0), (32.0, 0.0)), angle)
        board.put(shape, role, place, of=(tie.element.name,), kind="friction", width=4.0, dashed=True, layer=GROUND + 1)
        board.wish(names, board.at(k) + foot - 38.0 * e, n - e, role, (tie.element.name,), distance=5.0)

    # -- what turns ---------------------------------------------------------------------------------------------

    def _lever(self, tie: Tie, turn: Turn, names: tuple[str, ...], role: Role) -> None:
        """A tie from a point of a lever to a wall beside it, and the length of the arm."""
        board, stage = self.board, self.board.stage
        assert tie.arm is not None
        length = board.motions.length(turn.joint, turn.tip)
        gap = [
            tie.arm / length * (x - y)
            for x, y in zip(
                stage.model.position(stage.points[turn.tip]),
                stage.model.position(stage.points[turn.joint]),
                strict=True,
            )
        ]
        k = stage.add(turn.joint, gap)
        side = -1.0 if self.arms % 2 == 0 else 1.0
        self.arms += 1
        out = np.array([side, 0.0])
        base = self._tied_to_rest(tie, k, 0 * out, ARM * out, names, role)
        self._wall(k, base, ARM * out, out, 22.0)
        board.put(Disc((0.0, 0.0), 3.0), "body", board.placed(k), kind="joint", filled=True, layer=JOINT)
        if isinstance(tie.arm, sp.Symbol) and (turn.joint, tie.arm.name) not in self.measured:
            self.measured.add((turn.joint, tie.arm.name))
            board.measure(turn.joint, k, tie.arm.name, 14.0 * len(self.measured))

    def _at_joint(self, tie: Tie, turn: Turn, names: tuple[str, ...], role: Role) -> None:
        board, of = self.board, (tie.element.name,)
        if turn.name in board.shaft_spots:
            on_shaft(board, tie, turn, names, role)
            return
        at = board.at(turn.joint)
        rings = self.rings[turn.joint] = self.rings.get(turn.joint, -1) + 1
        place = board.placed(turn.joint)
        if tie.element.kind == "spring":
            board.put(spiral(outer=15.0 + 4 * rings), role, place, of=of, kind="spring", layer=JOINT + 1)
        else:
            ring = arc(9.0 + 4.5 * rings, 0.0, 2 * pi)
            board.put(ring, role, place, of=of, kind=tie.element.kind, dashed=True, width=2.2, layer=JOINT + 1)
        tip = board.at(turn.tip) - at
        board.block(at, 22 + 9 * rings, 22 + 9 * rings)
        board.wish(names, at, -tip + (-8.0, 0.0), role, of, distance=14.0 + 5 * rings)


LONGEST = 12
"""An element whose law is more than a letter is labelled by its own name, if that is not longer."""
LOCAL = ("delta", "current", "charge", "t")
"""What laws say with letters of their own, and time."""


def symbol_names(element: Element) -> tuple[str, ...]:
    """The symbols by which an element is known in a picture: its stiffness, its coefficient, its value, its law."""
    for key in ("k", "b", "mu", "limit", "value", "law", "energy"):
        value = getattr(element, key, None)
        values = value if isinstance(value, tuple) else (value,)
        found = [name for x in values if isinstance(x, sp.Expr) for name in names_in(x)]
        if found:
            return tuple(dict.fromkeys(found))[:2]
    return own_name(element)


def own_name(element: Element) -> tuple[str, ...]:
    """The name that was given to an element, if it is short; not its number or its kind."""
    name = element.name
    given = not name.isdigit() and not name.startswith(element.kind.partition("_")[0])
    return (name,) if given and 0 < len(name) <= LONGEST else ()


def names_in(expr: sp.Expr) -> list[str]:
    """The names of the symbols by which an expression is known in a picture."""
    listed = _main_symbols(expr) or sorted((a for a in expr.free_symbols if str(a) not in LOCAL), key=str)
    return [str(getattr(a, "name", None) or getattr(a.func, "__name__", a)) for a in listed]


def _main_symbols(expr: sp.Expr) -> Sequence[sp.Expr]:
    """An expression that is a symbol, a function of time, or a number times one; otherwise nothing of it."""
    _, bare = expr.as_coeff_Mul()
    if isinstance(bare, sp.Symbol) and str(bare) not in LOCAL:
        return [bare]
    inputs = sorted(expr.atoms(sp.core.function.AppliedUndef), key=str)
    return [x for x in inputs if not expr.has(sp.Derivative)][:1]
