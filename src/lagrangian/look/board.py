"""The board on which a picture is drawn: where points are seen, which shapes lie there, and which labels are wanted."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Sequence

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.look.holds import Motions
from lagrangian.look.kinematics import Kinematics, Views
from lagrangian.look.shapes import INK, arc, arc_end, head, line
from lagrangian.page.scene import FIXED, Disc, Flow, Pair, Path, Placement, Role, ScenePart, Trace
from lagrangian.records import dataclass, field

Array = NDArray[np.float64]

GROUND, BEHIND, BODY, TIE, JOINT, EFFORT, MEASURE = 0, 10, 20, 21, 30, 40, 50
"""The layers, from back to front."""


@dataclass
class Wish:
    """A label that wants a place: near ``near`` [px], best in the direction ``away``, or within a body."""

    names: tuple[str, ...]
    near: Pair
    away: Pair
    role: Role
    elements: tuple[str, ...] = ()
    inside: bool = False
    distance: float = 6.0


@dataclass
class Board:
    """A picture while it is drawn.

    ``q`` and ``p`` are the pose and the parameters; ``r`` (points, d) are positions [m]. ``shifts`` moves a point [px]
    away from where it would be seen, together with the points that it holds.
    """

    stage: Kinematics
    motions: Motions
    q: Array
    p: Array
    view: Array
    scale: float = 100.0
    shifts: dict[int, Pair] = field(default_factory=dict[int, Pair])
    parts: list[ScenePart] = field(default_factory=list[ScenePart])
    wishes: list[Wish] = field(default_factory=list[Wish])
    boxes: list[tuple[float, float, float, float]] = field(default_factory=list[tuple[float, float, float, float]])
    segments: list[tuple[Pair, Pair]] = field(default_factory=list[tuple[Pair, Pair]])
    missing: list[str] = field(default_factory=list[str])
    anchors: dict[int, int] = field(default_factory=dict[int, int])
    handles: list[int] = field(default_factory=list[int])
    sole: dict[int, float] = field(default_factory=dict[int, float])
    """How far below a body's point its floor is [px]."""
    faces: dict[int, tuple[float, float, float]] = field(default_factory=dict[int, tuple[float, float, float]])
    """The middle of a wedge's upright side from its body's point [px]; −1 if that is the left one, else 1."""
    tips: dict[int, int] = field(default_factory=dict[int, int])
    """The far end of a link or beam, by the point of its body."""
    shaft_spots: dict[str, Array] = field(default_factory=dict[str, Array])
    """Where a disc on a shaft is seen, by the name of its body."""
    walled: set[tuple[int, float]] = field(default_factory=set[tuple[int, float]])
    """Bodies' points with the sides on which they are tied to walls: −1 for the left or below, 1 for the others."""
    solids: list[tuple[int, int, float, float]] = field(default_factory=list[tuple[int, int, float, float]])
    """In space: the solids from back to front, as `Scene.solids`."""
    pinned: frozenset[int] = frozenset()
    """The points at which joints close loops."""
    straight: set[str] = field(default_factory=set[str])
    """The windings that move something along a line, by name."""
    flows: list[Flow] = field(default_factory=list[Flow])
    """The charges that flow around loops of circuits."""
    sizeless: bool = False
    """Whether nothing has a size [m], as where bodies only slide."""
    hidden: frozenset[str] = frozenset()
    """The names of elements that are not to be drawn."""
    _views: Views | None = None
    _r: Array | None = None

    # -- where ----------------------------------------------------------------------------------------------------

    @property
    def r(self) -> Array:
        """The positions [m] of all points in the pose."""
        found = np.zeros((0, self.stage.dimension)) if self._r is None else self._r
        if len(found) != len(self.stage.points):
            found = self._r = np.concatenate([found, self.stage.positions(self.q, self.p, len(found))])
        return found

    @property
    def views(self) -> Views:
        """The stage in the pose, with all points that there are, and with derivatives (`r` is had for less)."""
        found = self._views
        if found is None or found.r.shape[1] != len(self.stage.points):
            found = self._views = self.stage.views([self.q], self.p, known=found)
        return found

    def posed(self, q: Array) -> None:
        """Take another pose."""
        self.q, self._views, self._r = q, None, None

    def extend(self, r: Array) -> None:
        """Tell where the point is that was added last [m], so that it need not be computed."""
        if self._r is not None and len(self._r) == len(self.stage.points) - 1:
            self._r = np.vstack([self._r, r])

    def anchor(self, k: int) -> int:
        """The number of a point among the anchors of the scene."""
        return self.anchors.setdefault(k, len(self.anchors))

    def shift(self, k: int) -> Pair:
        """The shift [px] of a point: its own, and that of what holds it."""
        x, y = self.shifts.get(k, (0.0, 0.0))
        hold = self.motions.holds[k] if k < len(self.motions.holds) else None
        parent = self.stage.points[k].parent
        above = hold.holder if hold is not None else self.stage.index(parent) if parent is not None else k
        if above != k:
            dx, dy = self.shift(above)
            return x + dx, y + dy
        return x, y

    def pixels(self, length: sp.Expr) -> float:
        """A length [m] of parameters as seen from straight ahead [px]."""
        return self.scale * self.stage.value(length, self.q, self.p)

    def at(self, k: int) -> Array:
        """Where a point is seen [px], before the picture is moved into its frame."""
        return self.scale * (self.view @ self.r[k]) + np.array(self.shift(k))

    def seen(self, direction: Sequence[float] | Array) -> Array:
        """A direction of the fixed axes as seen on the screen, not normalized."""
        return self.view @ np.asarray(direction, float)

    def placed(self, k: int, dx: float = 0.0, dy: float = 0.0) -> Placement:
        """Axes at a point, parallel to the picture's."""
        x, y = self.shift(k)
        return Placement(self.anchor(k), shift=(x + dx, y + dy))

    def towards(self, k: int, other: int, scaling: str = "along", by: Pair = (0.0, 0.0)) -> Placement:
        """Axes at a point with x towards another; ``by`` [px] shifts both."""
        a, b = self.shift(k), self.shift(other)
        return Placement(
            self.anchor(k),
            self.anchor(other),
            scaling,  # type: ignore[arg-type]
            (a[0] + by[0], a[1] + by[1]),
            (b[0] + by[0], b[1] + by[1]),
        )

    # -- what ---------------------------------------------------------------------------------------------------

    def put(
        self,
        shape: Path | Disc | Trace,
        role: Role,
        placement: Placement = FIXED,
        *,
        of: Iterable[str] = (),
        kind: str = "",
        width: float = INK,
        filled: bool = False,
        dashed: bool = False,
        solid: bool = False,
        layer: int = BODY,
        moves: bool = True,
        inside: bool = False,
        facing: bool = False,
    ) -> None:
        """Add a shape."""
        self.parts.append(
            ScenePart(
                shape,
                role,
                placement,
                tuple(of),
                kind,
                width,
                filled,
                dashed,
                layer,
                moves,
                solid,
                "inside" if inside else "line",
                facing=facing,
            )
        )

    def wish(
        self,
        names: Sequence[str],
        near: Sequence[float] | Array,
        away: Sequence[float] | Array,
        role: Role,
        of: Iterable[str] = (),
        *,
        inside: bool = False,
        distance: float = 6.0,
    ) -> None:
        """Ask for a label."""
        if names:
            x, y = (float(v) for v in near)
            ax, ay = (float(v) for v in away)
            self.wishes.append(Wish(tuple(names), (x, y), (ax, ay), role, tuple(of), inside, distance))

    def block(self, centre: Sequence[float] | Array, width: float, height: float) -> None:
        """Keep labels out of a rectangle."""
        x, y = (float(v) for v in centre)
        self.boxes.append((x - width / 2, y - height / 2, width, height))

    def fence(self, start: Sequence[float] | Array, end: Sequence[float] | Array) -> None:
        """Keep labels off a line."""
        a, b = tuple(float(v) for v in start), tuple(float(v) for v in end)
        self.segments.append(((a[0], a[1]), (b[0], b[1])))

    def arrow(
        self,
        start: Sequence[float] | Array,
        end: Sequence[float] | Array,
        role: Role,
        placement: Placement = FIXED,
        *,
        of: Iterable[str] = (),
        kind: str = "arrow",
        moves: bool = False,
        width: float = 2.0,
    ) -> None:
        """An arrow between two places in the axes of a placement; fixed ones keep labels away."""
        a, b = np.asarray(start, float), np.asarray(end, float)
        e = (b - a) / (np.linalg.norm(b - a) or 1.0)
        tip, foot = (float(b[0]), float(b[1])), b - 7.0 * e
        self.put(
            line((a[0], a[1]), (foot[0], foot[1])),
            role,
            placement,
            of=of,
            kind=kind,
            width=width,
            layer=EFFORT,
            moves=moves,
        )
        self.put(
            head(tip, (e[0], e[1])), role, placement, of=of, kind=kind, width=0.0, solid=True, layer=EFFORT, moves=moves
        )
        if placement.at is None:
            self.fence(a, b)

    def bow(
        self,
        centre: Sequence[float] | Array,
        radius: float,
        start: float,
        end: float,
        role: Role,
        *,
        of: Iterable[str] = (),
        kind: str = "arc",
        width: float = INK,
        layer: int = MEASURE,
    ) -> None:
        """An arc with an arrow's head at its end, by angles on the screen."""
        x, y = (float(v) for v in centre)
        tip, direction = arc_end(radius, start, end, x=x, y=y)
        sense = 1.0 if end >= start else -1.0
        short = end - sense * min(6.0 / max(radius, 1.0), abs(end - start) / 2)
        self.put(arc(radius, start, short, x=x, y=y), role, of=of, kind=kind, width=width, layer=layer, moves=False)
        self.put(head(tip, direction), role, of=of, kind=kind, width=0.0, solid=True, layer=layer, moves=False)
        steps = np.linspace(start, end, 7)
        spots = [(x + radius * np.cos(a), y + radius * np.sin(a)) for a in steps]
        for a, b in itertools.pairwise(spots):
            self.fence(a, b)

    def measure(self, a: int, b: int, name: str, off: float) -> None:
        """A thin line beside the straight line between two points, ``off`` [px] to its left, with a length's name."""
        start, end = self.at(a), self.at(b)
        e = (end - start) / (np.linalg.norm(end - start) or 1.0)
        n = np.array([e[1], -e[0]]) * (1.0 if off > 0 else -1.0)
        p, q = start + abs(off) * n, end + abs(off) * n
        foot, top = start + (abs(off) + 3.0) * n, end + (abs(off) + 3.0) * n
        for s, t, dashed in ((p, q, False), (start, foot, True), (end, top, True)):
            self.put(
                line(_pair(s), _pair(t)), "thin", kind="measure", width=0.9, layer=GROUND, moves=False, dashed=dashed
            )
        self.fence(p, q)
        self.wish((name,), (p + q) / 2, n, "thin", distance=3.0)

    def lacks(self, what: str, help_by: str) -> None:
        """Say what is not drawn, and the line that helps."""
        self.missing.append(f"{what}: {help_by}" if help_by else what)


def _pair(v: Array) -> Pair:
    return float(v[0]), float(v[1])
