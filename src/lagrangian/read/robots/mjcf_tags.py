"""Tags of MJCF with their defaults put in, and the orientations that they may be given in."""

from __future__ import annotations

import math
from dataclasses import replace

from lagrangian.read.robots.markup import Tag
from lagrangian.read.robots.rotations import (
    IDENTITY,
    ZERO,
    FixedPose,
    FixedTurn,
    Rows,
    X,
    Y,
    Z,
    aligned,
    by_matrix,
    length,
    product,
)
from lagrangian.records import dataclass

WRITTEN = ("quat", "euler", "axisangle", "xyaxes", "zaxis")
"""The ways in which an orientation may be written."""

MECHANICAL = {
    "joint": "type axis pos ref springref stiffness damping armature frictionloss range springdamper",
    "geom": "type size pos quat euler axisangle xyaxes zaxis fromto mass density shellinertia mesh",
    "mesh": "scale inertia refpos refquat",
}
"""The attributes that are read where defaults give them, too."""


@dataclass
class Defaults:
    """The default attributes of joints and geoms, by class."""

    classes: dict[str, dict[str, dict[str, str]]]

    @classmethod
    def of(cls, root: Tag) -> Defaults:
        """Read every <default>, those within others with what the outer ones say."""
        made = cls({"main": {}})
        for tag in root.all("default"):
            made._read(tag, tag.get("class") or "main", {})
        return made

    def _read(self, tag: Tag, name: str, outer: dict[str, dict[str, str]]) -> None:
        own = {kind: dict(attributes) for kind, attributes in {**outer, **self.classes.get(name, {})}.items()}
        for kind in MECHANICAL:
            found = tag.one(kind)
            if found is not None:
                found.seen.update(MECHANICAL[kind].split())
                own[kind] = {**own.get(kind, {}), **found.attributes}
        self.classes[name] = own
        for inner in tag.all("default"):
            self._read(inner, inner.word("class", "visual"), own)

    def put_into(self, tag: Tag, inherited: str) -> Tag:
        """The tag with the attributes that its class gives it."""
        name = tag.get("class") or inherited
        if name not in self.classes:
            tag.unknown("default class", name, self.classes, "class")
        given = self.classes[name].get(tag.name, {})
        return replace(tag, attributes={**given, **tag.attributes}, read=True)


@dataclass(frozen=True)
class Orientations:
    """How angles are written: ``degree`` is what a number of them is in radians, ``sequence`` that of Euler angles."""

    degree: float = math.pi / 180
    sequence: str = "xyz"

    def pose(self, tag: Tag) -> FixedPose:
        """The position and orientation of a tag, in its body."""
        return self._own(tag, "pos").within(self.moved(tag)) if tag.frames else self._own(tag, "pos")

    def moved(self, tag: Tag) -> FixedPose:
        """The pose, in the body, of the frames and copies that a tag is in."""
        made = FixedPose()
        for frame in tag.frames:
            made = self._own(frame, "offset" if frame.name == "replicate" else "pos").within(made)
        return made

    def _own(self, tag: Tag, key: str) -> FixedPose:
        x, y, z = tag.vector(key, ZERO)
        return FixedPose((x, y, z), self.turns(tag))

    def by_quaternion(self, values: tuple[float, float, float, float]) -> tuple[FixedTurn, ...]:
        """The turns of a quaternion (w, x, y, z) that is not 0."""
        return self._turns("quat", values) or ()

    def turns(self, tag: Tag, keys: tuple[str, ...] = WRITTEN) -> tuple[FixedTurn, ...]:
        """The orientation of a tag, in any of the five ways in which it may be written; one of them at most."""
        given = [key for key in keys if tag.get(key) is not None]
        if len(given) > 1:
            raise tag.error(f"the orientation is given by {' and by '.join(given)}", "keep one", "E404", given[1])
        if not given:
            return ()
        key = given[0]
        if key == "euler":
            angles = tag.vector(key, ZERO)
            tag.check_angles(key, [angle * self.degree for angle in angles])
            axes = {"x": X, "y": Y, "z": Z}
            turns = [FixedTurn(axes[c.lower()], a * self.degree) for c, a in zip(self.sequence, angles, strict=True)]
            kept = [turn for turn in (turns[::-1] if self.sequence.isupper() else turns) if not turn.is_none]
            return tuple(kept)
        size = {"quat": 4, "refquat": 4, "axisangle": 4, "xyaxes": 6, "zaxis": 3}[key]
        values = tag.vector(key, (), (size,))
        if key == "axisangle":
            tag.check_angles(key, [values[3] * self.degree])
        made = self._turns(key, values)
        if made is None:
            raise tag.error(f"'{key}' has no direction", "its vectors must not be 0 or parallel", "E409", key)
        return made

    def _turns(self, key: str, values: tuple[float, ...]) -> tuple[FixedTurn, ...] | None:
        if key in ("quat", "refquat"):
            v, angle = values[1:], 2 * math.atan2(length(values[1:]), values[0])
            return None if length(values) == 0 else () if length(v) == 0 else _about(v, angle)
        if key == "axisangle":
            return None if length(values[:3]) == 0 else _about(values[:3], values[3] * self.degree)
        if key == "zaxis":
            size = length(values)
            x, y, z = values
            across = math.hypot(x, y)
            if size == 0:
                return None
            return _about((-y, x, 0.0) if across else X, math.atan2(across, z))
        rows = _from_axes(values[:3], values[3:])
        return None if rows is None else by_matrix(rows)


def _about(axis: tuple[float, ...], angle: float) -> tuple[FixedTurn, ...]:
    """One turn about an axis of any length; about an axis that is none of x, y and z, three turns instead."""
    turn = aligned(axis, angle)
    if turn.is_none:
        return ()
    return (turn,) if sum(x != 0 for x in turn.axis) == 1 else by_matrix(turn.matrix)


def _from_axes(x: tuple[float, ...], y: tuple[float, ...]) -> Rows | None:
    """R with the axes x and y, of which y is made perpendicular to x."""
    size = length(x)
    if size == 0:
        return None
    a = [k / size for k in x]
    along = sum(p * q for p, q in zip(a, y, strict=True))
    rest = [q - along * p for p, q in zip(a, y, strict=True)]
    if length(rest) <= 1e-12 * length(y):
        return None
    b = [k / length(rest) for k in rest]
    c = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    return (a[0], b[0], c[0]), (a[1], b[1], c[1]), (a[2], b[2], c[2])


def between(start: tuple[float, ...], end: tuple[float, ...]) -> tuple[tuple[float, float, float], Rows, float]:
    """The middle of two points, axes of which z leads from one to the other, and half their distance."""
    d = [b - a for a, b in zip(start, end, strict=True)]
    x, y, z = ((a + b) / 2 for a, b in zip(start, end, strict=True))
    half = length(d) / 2
    rows = IDENTITY
    if half:
        for turn in Orientations()._turns("zaxis", tuple(d)) or ():
            rows = product(rows, turn.matrix)
    return (x, y, z), rows, half
