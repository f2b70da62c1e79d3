"""Points and frames of a model file.

They are made when they are first needed, so a frame may refer to a point and a point to a frame; a circle of references
is an error.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, NoReturn

import sympy as sp

from lagrangian.errors import ParseError, did_you_mean
from lagrangian.model import Floating, Frame, Point
from lagrangian.quantities.source import shown
from lagrangian.read import file_schema as schema
from lagrangian.read.toml_index import Path
from lagrangian.read.validate import owner

if TYPE_CHECKING:
    from lagrangian.read.file_reading import Reading

MAX_CHAIN = 200
"""The largest number of points and frames that may each depend on one that comes later in the file."""

_WORD = re.compile(r"[^\W\d]\w*")


class Geometry:
    """The points and frames of one file, by name."""

    def __init__(self, loader: Reading) -> None:
        self.loader, self.file, self.index, self.data = loader, loader.file, loader.index, loader.data
        self.points: dict[str, Point] = {"origin": loader.builder.origin}
        self.frames: dict[str, Frame] = {}  # floating frames and their origins already exist
        self.held: dict[str, Floating] = {}  # so do the variables of ball joints
        self.frame_numbers: dict[str, int] = {}
        self.making: list[str] = []

    def read(self) -> None:
        """Make every named frame and point."""
        for number, table in enumerate(self.file.frame):
            if table.name in self.frame_numbers:
                line = self.index.of_key(("frame", self.frame_numbers[table.name])).line
                raise ParseError(
                    f"frame '{table.name}' is given twice (line {line})",
                    place=self.index.of_value(("frame", number, "name")),
                    fix="give it another name",
                    code="E404",
                )
            self.frame_numbers[table.name] = number
        for number, table in enumerate(self.file.frame):
            self.frame(table.name, ("frame", number))
        for name in self.file.points:
            self.named_point(name, ("points", name))

    def _enter(self, what: str, path: Path) -> None:
        if what in self.making:
            circle = [*self.making[self.making.index(what) :], what]
            raise ParseError(
                f"their definitions form a circle: {' → '.join(circle)}",
                element=owner(path, self.data) or None,
                place=self.index.of_value(path),
                fix="define one of them from the origin or the fixed axes",
                code="E413",
            )
        if len(self.making) > MAX_CHAIN:
            raise ParseError(
                f"more than {MAX_CHAIN} points and frames are defined in one chain, each from the one before",
                place=self.index.of_value(path),
                fix="define some of them from the origin",
                code="E703",
            )
        self.making.append(what)

    def named_point(self, name: str, path: Path) -> Point:
        """Return the point with a name; ``path`` is the place that refers to it."""
        if name in self.points:
            return self.points[name]
        if name not in self.file.points:
            self._unknown("point", name, path, ["origin", *self.file.points])
        self._enter(f"point '{name}'", path)
        own = ("points", name)
        self.points[name] = self._point(self.file.points[name], own, name)
        self.making.pop()
        return self.points[name]

    def point(self, value: Any, path: Path) -> Point:
        """Return a point that is given by name or inline."""
        return self.named_point(value, path) if isinstance(value, str) else self._point(value, path, None)

    def _point(self, value: Any, path: Path, name: str | None) -> Point:
        what = f"point '{name}'" if name else f"the point in {owner(path, self.data)}"
        if isinstance(value, schema.PointTable):
            parent = self.named_point(value.from_, (*path, "from")) if value.from_ is not None else None
            frame = self.frame(value.frame, (*path, "frame")) if value.frame is not None else None
            offset = self.loader.vector(value.offset, (*path, "offset"), what)
        else:
            parent, frame, offset = None, None, self.loader.vector(value, path, what)
        place = self.index.of_key(path)
        return self.loader.placed(
            lambda: self.loader.builder.point(name, offset, parent=parent, frame=frame, place=place), place
        )

    def frame(self, name: str, path: Path) -> Frame:
        """Return the frame with a name; ``path`` is the place that refers to it."""
        if name in self.frames:
            return self.frames[name]
        if name not in self.frame_numbers:
            self._unknown("frame", name, path, list(self.frame_numbers))
        self._enter(f"frame '{name}'", path)
        own = ("frame", self.frame_numbers[name])
        table = self.file.frame[self.frame_numbers[name]]
        parent = self.frame(table.parent, (*own, "parent")) if table.parent is not None else None
        origin = self.named_point(table.origin, (*own, "origin")) if table.origin is not None else None
        if (held := self.held.get(name)) is not None:
            made = self._ball(name, own, parent, origin, held)
        else:
            made = self._turned(table, own, parent, origin)
        self.frames[name] = made
        self.making.pop()
        return made

    def _ball(self, name: str, own: Path, parent: Frame | None, origin: Point | None, held: Floating) -> Frame:
        builder, place = self.loader.builder, self.index.of_key(own)
        return self.loader.placed(
            lambda: builder.ball_frame(name, parent=parent, origin=origin, declared=held, place=place), place
        )

    def _turned(self, table: schema.FrameTable, own: Path, parent: Frame | None, origin: Point | None) -> Frame:
        """A frame that is turned by an angle."""
        name, what = table.name, f"frame '{table.name}'"
        if table.angle is None:
            raise ParseError(
                "the field 'angle' is missing",
                element=what,
                place=self.index.of_key(own),
                fix="write angle = …: the angle from its parent's axes; or ball = true, or floating = true",
                code="E401",
            )
        angle = self.loader.expression(table.angle, (*own, "angle"), f"angle of {what}")
        axis = self.loader.vector(table.axis, (*own, "axis"), f"the axis of {what}") if table.axis is not None else None
        place = self.index.of_key(own)
        return self.loader.placed(
            lambda: self.loader.builder.frame(name, angle, axis=axis, parent=parent, origin=origin, place=place), place
        )

    def frame_or_angle(self, value: Any, path: Path, what: str) -> Frame | sp.Expr:
        """Return the frame with a name, or otherwise the expression of an angle."""
        if isinstance(value, str):
            name = value.strip()
            if name in self.frame_numbers:
                return self.frame(name, path)
            if (
                _WORD.fullmatch(name)
                and not self.loader.scope.meanings(name)[0]
                and did_you_mean(name, self.frame_numbers)
            ):
                self._unknown("frame", name, path, list(self.frame_numbers))
        return self.loader.expression(value, path, what)

    def _unknown(self, what: str, name: str, path: Path, known: list[str]) -> NoReturn:
        listed = "known: " + ", ".join(known[:12]) if known else f"there is no {what} in this file"
        raise ParseError(
            f"unknown {what} {shown(name)}",
            element=owner(path, self.data) or None,
            place=self.index.of_value(path),
            fix=did_you_mean(name[:64], known) or listed,
            code="E412",
        )
