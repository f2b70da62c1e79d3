"""Draws coordinates: arrows for lengths, arcs for angles, from where they count to where things are."""

from __future__ import annotations

from math import pi

import numpy as np
from numpy.typing import NDArray

from lagrangian.look.board import BEHIND, MEASURE, Board
from lagrangian.look.cast import BodyGlyph, Player
from lagrangian.look.holds import HoldKind
from lagrangian.look.labels import crosses
from lagrangian.look.shapes import line
from lagrangian.look.turning import Turn
from lagrangian.page.scene import Pair

Array = NDArray[np.float64]

ABOVE = 44.0
"""How far the arrow of a length is from the middle of its body [px]."""
LEVEL = 24.0
"""The distance of parallel arrows [px]."""
ARC = 42.0
"""The radius of the arc of an angle [px]."""


def _crossing(a: Pair, b: Pair, c: Pair, d: Pair) -> bool:
    """Whether two pieces of line cross."""

    def side(p: Pair, q: Pair, r: Pair) -> float:
        return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])

    return side(a, b, c) * side(a, b, d) < 0 and side(c, d, a) * side(c, d, b) < 0


def _alike(slopes: Array, unit: Array) -> NDArray[np.bool_]:
    """Which rows of slopes, up to their signs, are those of a coordinate itself."""
    return np.asarray(np.all(np.abs(np.abs(slopes) - unit) < 1e-8 + 1e-5 * unit, axis=-1))


class MeasureArtist:
    """Draws the coordinates of a system."""

    def __init__(self, board: Board, parts: list[Player], turns: list[Turn], pulleys: list[int]) -> None:
        self.board, self.parts, self.turns, self.pulleys = board, parts, turns, pulleys
        self.arrows: list[tuple[Array, Array]] = []
        self.arcs: dict[int, int] = {}

    def draw(self) -> None:
        """Draw every coordinate that the rules know; what they do not know is told."""
        floating = [f.floating for f in self.board.stage.model.floating if f.floating is not None]
        skipped = {c.name for f in floating for c in f.coordinates} | {c.name for c in self.board.stage.model.charges}
        for i, coordinate in enumerate(self.board.stage.model.coordinates):
            name = coordinate.name
            if name in self.board.hidden or name in skipped:
                continue
            rules = [self._slide, self._telescope, self._angle, self._position]
            if any(h.how is HoldKind.TELESCOPE and h.along == i for h in self.board.motions.holds):
                rules = [self._telescope, *rules]
            if not any(rule(i, name) for rule in rules):
                self.board.lacks(f"coordinate {name} is not drawn", "[look] pose may show what it moves")

    # -- lengths ------------------------------------------------------------------------------------------------

    def _slide(self, i: int, name: str) -> bool:
        """An arrow to a sliding body from its reference, or from the body that it is counted from."""
        motions = self.board.motions
        sliders = [p for p in self.parts if motions.holds[p.point].how is HoldKind.SLIDE]
        points = [(p.point, p) for p in sliders]
        points += [
            (k, None)
            for k, h in enumerate(motions.holds)
            if h.how is HoldKind.SLIDE and k not in [p.point for p in sliders]
        ]
        for k, part in points:
            for h in (0, *self.pulleys, *(p.point for p in sliders if p.point != k)):
                known = motions.coordinates(k)
                if any(turn.slopes[i] for turn in self.turns) and (not motions.even(k, h, i) or self._turned_by(i)):
                    continue  # it is an angle that moves this body, too
                if motions.coordinates(k, h) == (i,) and i in known and (h == 0 or i not in motions.coordinates(h)):
                    J = motions.views.J[0, k] - motions.views.J[0, h]
                    if h and part is None:
                        continue
                    e = self.board.seen(J[:, i])
                    size = float(np.linalg.norm(e))
                    if size < 1e-9:
                        continue
                    self._length(i, name, k, h, e / size, part)
                    return True
        return False

    def _turned_by(self, i: int) -> bool:
        """Whether a body turns by a coordinate itself, not by a multiple of it."""
        return any(turn.frame is not None and _alike(turn.slopes, np.eye(len(turn.slopes))[i]) for turn in self.turns)

    def _length(self, i: int, name: str, k: int, h: int, e: Array, part: Player | None) -> None:
        board = self.board
        end = board.at(k)
        q = board.q[i] * board.scale
        start = board.at(h) if h else end - q * e
        along = (end - start) @ e
        start = end - along * e
        if abs(along) < 12.0:
            start = end - 40.0 * e
        n, off = self._side(k, start, end, e, part, bool(h))
        mark_a, mark_b = start + off * n, end + off * n
        self._arrow(mark_a, mark_b, name)
        if h:
            self._thin(board.at(h), mark_a + 5 * n)
        self._thin(end, mark_b + 5 * n)

    def _side(
        self, k: int, start: Array, end: Array, e: Array, part: Player | None, relative: bool
    ) -> tuple[Array, float]:
        """On which side of a body the arrow of its length lies, and how far away: where it meets the least.

        Only an arrow that counts from another body may go on where one ends.
        """
        inward = 0.1 * (end - start) if relative else -8.0 * e
        vertical = abs(e[1]) > 0.96
        n = np.array([1.0, 0.0]) if vertical else np.array([e[1], -e[0]]) if e[0] > 0 else np.array([-e[1], e[0]])
        near, far = self._distances(k, vertical, abs(e[1]) > 0.04, part)
        options = [(n, near + LEVEL * level, 0.6 * level) for level in range(3)]
        options += [(-n, far + LEVEL * level, 1.0 + 0.6 * level) for level in range(2)]
        if part is not None and part.glyph is BodyGlyph.WEDGE:
            options = [(-n, far + LEVEL * level, 0.6 * level) for level in range(3)]

        def cost(option: tuple[Array, float, float]) -> float:
            m, off, price = option
            return price + self._met(start + off * m, end + off * m, inward)

        m, off, _ = min(options, key=cost)
        self.arrows.append((start + off * m, end + off * m))
        return m, off

    def _distances(self, k: int, vertical: bool, sloped: bool, part: Player | None) -> tuple[float, float]:
        """How far the arrow is from the middle of a body on its near (upper or right) side and on the other."""
        if part is None:
            return (54.0, 54.0) if vertical else (ABOVE, ABOVE)
        if part.glyph is BodyGlyph.WHEEL and part.radius is not None:
            radius = self.board.pixels(part.radius)
            return radius + 22.0, radius + 26.0
        if part.glyph is BodyGlyph.WEDGE:
            return 30.0, self.board.sole.get(k, 100.0) + 28.0
        if vertical:
            return 54.0, 54.0
        if part.glyph is BodyGlyph.BLOCK:
            return (52.0, 30.0) if sloped else (ABOVE, ABOVE)
        return ABOVE, 58.0

    def _met(self, a: Array, b: Array, inward: Array) -> float:
        """What an arrow would lie on: lines, bodies, and arrows that are there, which its part from ``a + inward`` to
        ``b - inward`` must not meet."""
        p, q = (float(a[0]), float(a[1])), (float(b[0]), float(b[1]))
        found = sum(2.0 for s, t in self.board.segments if _crossing(p, q, s, t))
        found += sum(3.0 for box in self.board.boxes if crosses(box, p, q))
        for s, t in self.arrows:
            box = (min(s[0], t[0]) - 6, min(s[1], t[1]) - 10, abs(t[0] - s[0]) + 12, abs(t[1] - s[1]) + 20)
            inner = [(float(x), float(y)) for x, y in (a + inward, b - inward)]
            found += 4.0 if crosses(box, *inner) else 0.0
        return found

    def _thin(self, start: Array, end: Array) -> None:
        """A thin line from what is measured to its arrow."""
        ends = line((float(start[0]), float(start[1])), (float(end[0]), float(end[1])))
        self.board.put(ends, "thin", kind="measure", width=0.9, layer=BEHIND, moves=False)

    def _arrow(self, start: Array, end: Array, name: str, *, label: Array | None = None) -> None:
        board = self.board
        e = (end - start) / (np.linalg.norm(end - start) or 1.0)
        n = np.array([-e[1], e[0]])
        board.put(
            line(tuple(start - 6 * n), tuple(start + 6 * n)),
            "coordinate",
            kind="measure",
            width=1.8,
            layer=MEASURE,
            moves=False,
        )
        board.arrow(start, end, "coordinate", kind="coordinate", of=(name,), width=1.8)
        n = n if n[1] < 0 or (abs(n[1]) < 1e-9 and n[0] > 0) else -n
        board.wish((name,), (start + end) / 2, n if label is None else label, "coordinate", (name,), distance=4.0)

    def _telescope(self, i: int, name: str) -> bool:
        """An arrow beside a rope from its holder to its end, or along a track from its middle."""
        board = self.board
        for hold in board.motions.holds:
            if hold.along != i or hold.how not in (HoldKind.TELESCOPE, HoldKind.TRACK):
                continue
            start, end = board.at(hold.holder), board.at(hold.point)
            if hold.how is HoldKind.TRACK:
                views = board.views
                e = board.seen(views.J[0, hold.point, :, i])
                size = float(np.linalg.norm(e))
                if size < 1e-9:
                    continue
                start = end - e / size * board.q[i] * board.scale
            e = (end - start) / (np.linalg.norm(end - start) or 1.0)
            n = np.array([-e[1], e[0]])
            n = n if n[0] > 0 or (n[0] == 0 and n[1] < 0) else -n
            off = 22.0 if hold.how is HoldKind.TELESCOPE else 34.0
            if hold.how is HoldKind.TRACK:
                n = n if n[1] < 0 else -n
            self._thin(end, end + (off + 5) * n)
            self._arrow(start + off * n, end + off * n, name, label=n)
            return True
        return False

    # -- angles -------------------------------------------------------------------------------------------------

    def _angle(self, i: int, name: str) -> bool:
        """An arc from the direction at 0 to the direction now: absolute, or against another turn."""
        if not self.turns:
            return False
        slopes = np.array([turn.slopes for turn in self.turns])
        unit = np.eye(len(self.board.q))[i]
        found = np.flatnonzero(_alike(slopes, unit))
        if not found.size:
            others = slopes[slopes[:, i] == 0.0]
            found = np.flatnonzero([_alike(own - others, unit).any() for own in slopes])
        if not found.size:
            return False
        turn = self.turns[found[0]]
        self._arc(i, name, turn, float(turn.slopes[i]))
        return True

    def _arc(self, i: int, name: str, turn: Turn, sense: float) -> None:
        board = self.board
        if turn.name in board.shaft_spots:
            spot, half = board.shaft_spots[turn.name] + (8.0, 0.0), 0.7 if sense >= 0 else -0.7
            board.bow(spot, 30.0, pi + half, pi - half, "coordinate", of=(name,), kind="coordinate", width=1.8)
            board.wish((name,), spot - (22.0, 24.0), (-0.3, -1.0), "coordinate", (name,), distance=2.0)
            return
        at, tip = board.at(turn.joint), board.at(turn.tip)
        d = tip - at
        length = float(np.linalg.norm(d))
        now = float(np.arctan2(d[1], d[0])) if length > 1.0 else 0.0
        turned = -sense * float(board.q[i])  # the screen's angles count clockwise
        start = now - turned
        n = self.arcs[turn.joint] = self.arcs.get(turn.joint, -1) + 1
        radius = min(ARC, max(26.0, 0.6 * length)) + 16.0 * n
        part = next(
            (p for p in self.parts if p.point == turn.joint and p.radius is not None and p.glyph is not BodyGlyph.BEAM),
            None,
        )
        if (
            part is not None
            and part.radius is not None
            and part.glyph in (BodyGlyph.WHEEL, BodyGlyph.DISC, BodyGlyph.PULLEY)
        ):
            edge = board.pixels(part.radius)
            outside = turn.frame != part.frame and length > edge + 30.0
            radius = edge + 16.0 if outside else max(20.0, 0.6 * edge)
        reference = radius + 26.0
        foot = at + reference * np.array([np.cos(start), np.sin(start)])
        board.put(
            line(tuple(at), tuple(foot)),
            "thin",
            kind="reference",
            width=1.1,
            dashed=True,
            layer=BEHIND + 12,
            moves=False,
        )
        board.fence(at, foot)
        if any(p.point == turn.tip and p.glyph is BodyGlyph.WHEEL for p in self.parts) and length > 1.0:
            ends = line((float(at[0]), float(at[1])), (float(tip[0]), float(tip[1])))  # no rod is there
            board.put(ends, "thin", kind="reference", width=1.1, dashed=True, layer=BEHIND + 12, moves=False)
            board.fence(at, tip)
        board.bow(at, radius, start, now, "coordinate", of=(name,), kind="coordinate", width=1.8)
        middle = (start + now) / 2
        out = np.array([np.cos(middle), np.sin(middle)])
        board.wish((name,), at + radius * out, out, "coordinate", (name,), distance=4.0)

    # -- free points ----------------------------------------------------------------------------------------------

    def _position(self, i: int, name: str) -> bool:
        """An arrow at a free point in the direction in which the coordinate moves it."""
        board = self.board
        J = board.views.J[0]
        order = [p.point for p in self.parts] + list(range(1, len(board.motions.holds)))
        candidates = [k for k in order if i in board.motions.coordinates(k)]
        candidates.sort(key=lambda k: len(board.motions.coordinates(k)))
        for k in candidates:
            if k >= len(J):
                continue
            hold = board.motions.holds[k]
            e = board.seen(J[k, :, i])
            size = float(np.linalg.norm(e))
            if size < 1e-6 or hold.how not in (HoldKind.FREE, HoldKind.WIRE):
                continue
            e = e / size if hold.how is HoldKind.FREE else np.array([np.sign(e[0]) or 1.0, 0.0])
            at = board.at(k)
            start = at + 14.0 * e if hold.how is HoldKind.FREE else at
            if hold.how is HoldKind.WIRE:
                origin = board.at(0)
                low = max(float(at[1]), float(origin[1])) + 30.0
                self._arrow(np.array([origin[0], low]), np.array([at[0], low]), name)
                self._thin(at, np.array([at[0], low + 5]))
                return True
            board.arrow(start, start + 34.0 * e, "coordinate", kind="coordinate", of=(name,), width=1.8)
            n = np.array([-e[1], e[0]])
            board.wish((name,), start + 30.0 * e, n + e, "coordinate", (name,), distance=4.0)
            return True
        return False
