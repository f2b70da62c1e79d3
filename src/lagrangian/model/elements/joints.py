"""Joints that close a loop, made of rows: pin, ball, slider and weld."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, ClassVar, TypeAlias

import sympy as sp

from lagrangian import bounded
from lagrangian.model.elements.answers import REQUIRED, ActsOn, Entry, FieldKind
from lagrangian.model.elements.base import Condition, Level, Surroundings, Use
from lagrangian.model.elements.conditions import LETTERS, OnLine, Perpendicular, SameTurn
from lagrangian.model.elements.constraint import Restriction, body_axes, dimension_of, together
from lagrangian.model.geometry import Frame, Point
from lagrangian.records import dataclass

BETWEEN = Entry(FieldKind.TWO_POINTS, "The points that it joins, one on each body.", REQUIRED)
BODIES = Entry(
    FieldKind.FRAMES, "The frames of the two bodies, where the points do not say; one alone stands on the ground."
)

Direction: TypeAlias = "tuple[sp.Expr, ...]"
Pair: TypeAlias = "tuple[Frame, Frame | None]"


@dataclass(frozen=True, eq=False, kw_only=True)
class Joint(Restriction):
    """A joint at two points, one on each body."""

    between: Any

    def __post_init__(self) -> None:
        self._set(between=self._pair(self.between))

    def points(self) -> Iterator[tuple[str, Point]]:
        """Its two points."""
        for point in self.between:
            yield "between", point

    def acts_on(self) -> ActsOn:
        """The points that it connects."""
        return ActsOn(
            (self.between, *(frame for _, frame in self.frames())),
            "it restricts nothing: no coordinate moves what it joins",
            "between=(P, Q) with at least one of them moved by a coordinate that does not carry the other along",
        )


@dataclass(frozen=True, eq=False, kw_only=True)
class TurningJoint(Joint):
    """A joint that restricts the rotation of two bodies. ``bodies`` are their frames, by default those of the
    points."""

    bodies: Any = None

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.bodies is not None:
            self._set(bodies=tuple(f for f in self._bodies(self.bodies) if f is not None))

    @property
    def space(self) -> bool:
        """Whether the joint is in space, not in the plane."""
        return dimension_of(*self.between, *(self.bodies or ())) == 3

    @property
    def turning(self) -> Pair:
        """The frames of the two bodies, the second None for the ground."""
        own = [body_axes(point) for point in self.between]
        found = self.bodies or tuple(frame for frame in own if frame is not None)
        if not found or (self.bodies is None and own[0] is own[1]):
            raise self._error(
                "its points do not say which bodies it joins",
                fix="bodies=(A, B) with their frames or rigid bodies, bodies=A for a body on the ground",
                code="E412",
            )
        return found[0], found[1] if len(found) == 2 else None

    def frames(self) -> Iterator[tuple[str, Frame]]:
        """The frames that were given."""
        for frame in self.bodies or ():
            yield "bodies", frame


def of_length_one(along: Direction) -> Direction:
    """A direction divided by its length, so that the multiplier of a row along it is a force, or a torque."""
    squared = sp.Add(*(x**2 for x in along))
    return along if bounded.is_one(squared) else tuple(x / sp.sqrt(squared) for x in along)


def across(given: Direction) -> tuple[Direction, ...]:
    """Directions of length 1 perpendicular to a given one and to each other: one in the plane, two in space."""
    along = of_length_one(given)
    if len(along) == 2:
        return ((-along[1], along[0]),)
    x, y, z = along
    if x == 0 and y == 0:
        return ((sp.S.One, sp.S.Zero, sp.S.Zero), (sp.S.Zero, sp.S.One, sp.S.Zero))
    first = of_length_one((-y, x, sp.S.Zero))
    return first, (-first[1] * z, first[0] * z, x * first[1] - y * first[0])  # along × first


def same_axes(pair: Pair) -> tuple[Condition, ...]:
    """The rows that prevent two bodies from rotating relative to each other: in space x·y = y·z = z·x = 0."""
    first, second = pair
    if first.dimension == 2:
        return (SameTurn(first=first, second=second, angle=sp.S.Zero, suffix="turn"),)
    units = tuple(tuple(sp.Integer(i == k) for k in range(3)) for i in range(3))
    return tuple(
        Perpendicular(first=first, along=units[i], second=second, other=units[(i + 1) % 3], suffix=f"turn_{LETTERS[i]}")
        for i in range(3)
    )


@dataclass(frozen=True, eq=False, kw_only=True)
class Pin(TurningJoint):
    """A pin: two points coincide and, in space, the bodies rotate relative to each other only about one ``axis``.

    There are two rows in the plane, five in space. The axis has the same components in the axes of both bodies.
    """

    axis: Any = None

    kind: ClassVar[str] = "pin"
    plural = "Pins that close loops."
    about = "A pin between two bodies: the two points coincide; in space the bodies turn about one axis alone."
    entries: ClassVar[Mapping[str, Entry]] = {
        "between": BETWEEN,
        "bodies": BODIES,
        "axis": Entry(FieldKind.VECTOR, "In space: the axis, with the same components in the axes of both bodies."),
    }

    def __post_init__(self) -> None:
        super().__post_init__()
        if not self.space and self.axis is not None:
            raise self._error("a pin in the plane has no axis", fix="leave the axis out", code="E414")
        if self.space and self.axis is None:
            raise self._error(
                "a pin in space needs its axis",
                fix="three components, such as 0, 0, 1; a joint that turns any way is a ball",
                code="E414",
            )
        if self.axis is not None:
            self._set(axis=self._direction(self.axis, "axis"))
            _ = self.turning

    def uses(self) -> Iterator[Use]:
        """The axis is fixed in the bodies."""
        for x in self.axis or ():
            yield Use("axis", "axis", x, Level.CONSTANT)

    def conditions(self, model: Surroundings) -> tuple[Condition, ...]:
        """Two rows in the plane; in space three for the points and two for the axis."""
        rows = together(self.between, None)
        if self.axis is None:
            return rows
        first, second = self.turning
        return (
            *rows,
            *(
                Perpendicular(first=first, along=a, second=second, other=self.axis, suffix=f"axis_{i}")
                for i, a in enumerate(across(self.axis), 1)
            ),
        )


@dataclass(frozen=True, eq=False, kw_only=True)
class Ball(Joint):
    """A ball joint: two points coincide, and the bodies rotate freely. It has three rows; in the plane it is a pin."""

    kind: ClassVar[str] = "ball"
    plural = "Ball joints that close loops."
    about = "A ball joint between two bodies: the two points coincide."
    entries: ClassVar[Mapping[str, Entry]] = {"between": BETWEEN}

    def conditions(self, model: Surroundings) -> tuple[Condition, ...]:
        """One row for each component."""
        return together(self.between, None)


@dataclass(frozen=True, eq=False, kw_only=True)
class Slider(TurningJoint):
    """A slider: the first point stays on the line through the second one ``along`` a direction fixed in ``axes``.

    There is one row in the plane, two in space. With ``bodies``, these do not rotate relative to each other: one more
    row in the plane, three in space.
    """

    along: Any
    axes: Any = None

    kind: ClassVar[str] = "slider"
    plural = "Sliders that close loops."
    about = "A slider: a point stays on a line through another point; with bodies, they do not turn."
    entries: ClassVar[Mapping[str, Entry]] = {
        "between": Entry(FieldKind.TWO_POINTS, "The point that slides, and a point of the line.", REQUIRED),
        "bodies": Entry(FieldKind.FRAMES, "Two bodies that do not turn against each other; one alone: not at all."),
        "along": Entry(FieldKind.VECTOR, "The direction of the line.", REQUIRED),
        "axes": Entry(FieldKind.FRAME, "The frame in whose axes the direction is fixed; the fixed axes if left out."),
    }

    def __post_init__(self) -> None:
        super().__post_init__()
        self._frame(self.axes, "axes")
        self._set(along=self._direction(self.along, "along"))
        if len(self.along) != (3 if self.space else 2):
            raise self._error(
                f"along has {len(self.along)} components, its points have {3 if self.space else 2}", code="E414"
            )

    def uses(self) -> Iterator[Use]:
        """The direction is fixed in its axes."""
        for x in self.along:
            yield Use("along", "direction", x, Level.CONSTANT)

    def frames(self) -> Iterator[tuple[str, Frame]]:
        """The frames of the bodies, and the one in which the direction is fixed."""
        yield from super().frames()
        if self.axes is not None:
            yield "axes", self.axes

    def conditions(self, model: Surroundings) -> tuple[Condition, ...]:
        """The rows across the line, and those that prevent the bodies from rotating."""
        start, end = self.between
        normals = across(self.along)
        rows = tuple(
            OnLine(start=start, end=end, normal=n, frame=self.axes, suffix=f"across{i if len(normals) > 1 else ''}")
            for i, n in enumerate(normals, 1)
        )
        return (*rows, *same_axes(self.turning)) if self.bodies else rows


@dataclass(frozen=True, eq=False, kw_only=True)
class Weld(TurningJoint):
    """A weld: two points coincide, and the bodies do not rotate. It has three rows in the plane, six in space."""

    kind: ClassVar[str] = "weld"
    plural = "Welds that close loops."
    about = "A weld: the two points coincide and the bodies do not turn against each other."
    entries: ClassVar[Mapping[str, Entry]] = {"between": BETWEEN, "bodies": BODIES}

    def __post_init__(self) -> None:
        super().__post_init__()
        _ = self.turning

    def conditions(self, model: Surroundings) -> tuple[Condition, ...]:
        """The rows for the points, and those for the rotation."""
        return (*together(self.between, None), *same_axes(self.turning))
