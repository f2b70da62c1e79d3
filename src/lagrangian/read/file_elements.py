"""Reads the table of an element in a model file; there is a method for each way to write a field."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from lagrangian.errors import ParseError, did_you_mean
from lagrangian.model import REGISTRY, Element, Frame, RigidBody
from lagrangian.model.elements import Entry, FieldKind
from lagrangian.quantities.source import shown
from lagrangian.read.toml_index import Path

if TYPE_CHECKING:
    from lagrangian.read.file_geometry import Geometry
    from lagrangian.read.file_reading import Reading

STANDARD_GRAVITY = 9.81
"""The default value [m/s²] of the parameter g, if the file does not declare it."""


class _Reader:
    """Reads the fields of one element's table, each in its own format."""

    def __init__(
        self, loader: Reading, geometry: Geometry, kind: type[Element], table: Any, path: Path, at: Path | None
    ) -> None:
        self.loader, self.geometry, self.table, self.path = loader, geometry, table, path
        words = kind.kind.replace("_", " ")
        self.title = f"{words} {shown(table.name)}" if table.name else words
        self.place = loader.index.of_key(path)
        self.given: dict[str, Any] = {"name": table.name, "place": self.place}
        self.single = at

    def where(self, key: str) -> Path:
        """The path of a field; an element that is a single value of [energies] is its own field."""
        return (*self.path, key) if self.single is None else self.single

    def expression(self, key: str, value: Any, entry: Entry) -> Any:
        """Read an expression."""
        return self.loader.expression(value, self.where(key), f"{key} of {self.title}", entry.local)

    def vector(self, key: str, value: Any, entry: Entry) -> Any:
        """Read a list of expressions."""
        return self.loader.vector(value, self.where(key), f"the {key} of {self.title}")

    def expression_or_vector(self, key: str, value: Any, entry: Entry) -> Any:
        """Read an expression or a list of expressions."""
        return (self.vector if isinstance(value, list) else self.expression)(key, value, entry)

    def point(self, key: str, value: Any, entry: Entry) -> Any:
        """Read a point, or the name of one."""
        return self.geometry.point(value, self.where(key))

    def points(self, key: str, value: Any, entry: Entry) -> Any:
        """Read the names of the points that an element connects."""
        path = self.where(key)
        return tuple(self.geometry.named_point(name, (*path, i)) for i, name in enumerate(value))

    def frame(self, key: str, value: Any, entry: Entry) -> Any:
        """Read the name of a frame."""
        return self.geometry.frame(value, self.where(key))

    def frame_or_angle(self, key: str, value: Any, entry: Entry) -> Any:
        """Read the name of a frame, or an angle."""
        return self.geometry.frame_or_angle(value, self.where(key), f"{key} of {self.title}")

    def body_frame(self, key: str, value: Any, entry: Entry) -> Any:
        """Read the name of a frame, or an angle for which a frame is made."""
        found = self.frame_or_angle(key, value, entry)
        if isinstance(found, Frame):
            return found
        return self.loader.builder.frame(None, found, place=self.loader.index.of_value(self.where(key)))

    def inertia(self, key: str, value: Any, entry: Entry) -> Any:
        """Read a moment of inertia, three principal moments or three rows."""
        if not isinstance(value, list):
            return self.expression(key, value, entry)
        path, what = self.where(key), f"the {key} of {self.title}"
        return [
            list(self.loader.vector(row, (*path, i), what))
            if isinstance(row, list)
            else self.loader.expression(row, (*path, i), what)
            for i, row in enumerate(value)
        ]

    def coordinate(self, key: str, value: Any, entry: Entry) -> Any:
        """Read the name of a coordinate, or of a velocity of a floating frame."""
        coordinates = {c: self.loader.scope[c] for c in self.loader.generalized_names}
        found = [n for n in self.loader.scope.meanings(value)[0] if n in coordinates]
        if len(found) != 1:
            raise ParseError(
                f"{shown(value)} is not a coordinate",
                element=self.title,
                place=self.loader.index.of_value(self.where(key)),
                fix=did_you_mean(value[:64], coordinates) or "known: " + ", ".join(coordinates),
                code="E402",
            )
        return coordinates[found[0]]

    def frames(self, key: str, value: Any, entry: Entry) -> Any:
        """Read the names of one frame or two."""
        path = self.where(key)
        return tuple(self.geometry.frame(name, (*path, i)) for i, name in enumerate(value))

    def body(self, key: str, value: Any, entry: Entry) -> Any:
        """Read the name of a rigid body; bodies are read before the constraints on them."""
        bodies = {e.name: e for e in self.loader.builder.elements if isinstance(e, RigidBody)}
        if value not in bodies:
            turning = [shown(name) for name, body in bodies.items() if body.frame.name == value]
            meant = f"{shown(value)} is a frame; the body that turns with it is {', '.join(turning)}" if turning else ""
            raise ParseError(
                f"there is no rigid body {shown(value)}",
                element=self.title,
                place=self.loader.index.of_value(self.where(key)),
                fix=meant or did_you_mean(value[:64], bodies) or "known: " + (", ".join(bodies) or "none"),
                code="E402",
            )
        return bodies[value]

    def rows(self, key: str, value: Any, entry: Entry) -> Any:
        """Read names of rows; constraints may follow in the file, so they are looked up when all are there."""
        return value

    def directions(self, key: str, value: Any, entry: Entry) -> Any:
        """Read a vector, or a list of vectors."""
        path, what = self.where(key), f"the {key} of {self.title}"
        if not any(isinstance(x, list) for x in value):
            return self.loader.vector(value, path, what)
        for i, x in enumerate(value):
            if not isinstance(x, list):
                raise ParseError(
                    f"direction {i + 1} is not a list",
                    element=self.title,
                    place=self.loader.index.of_value((*path, i)),
                    fix="along = [[1, 0, 0], [0, 1, 0]], or one direction alone: [1, 0, 0]",
                    code="E406",
                )
        return tuple(self.loader.vector(x, (*path, i), what) for i, x in enumerate(value))

    def strength_of_gravity(self, key: str, value: Any, entry: Entry) -> Any:
        """Read an expression; the default is the parameter g."""
        if value is None:
            return self.loader.builder.standard_gravity(STANDARD_GRAVITY)
        return self.expression(key, value, entry)


_FIELDS: dict[FieldKind, Callable[[_Reader, str, Any, Entry], Any]] = {
    FieldKind.EXPRESSION: _Reader.expression,
    FieldKind.VECTOR: _Reader.vector,
    FieldKind.EXPRESSION_OR_VECTOR: _Reader.expression_or_vector,
    FieldKind.POINT: _Reader.point,
    FieldKind.TWO_POINTS: _Reader.points,
    FieldKind.FRAME: _Reader.frame,
    FieldKind.FRAME_OR_ANGLE: _Reader.frame_or_angle,
    FieldKind.BODY_FRAME: _Reader.body_frame,
    FieldKind.INERTIA: _Reader.inertia,
    FieldKind.COORDINATE: _Reader.coordinate,
    FieldKind.STRENGTH_OF_GRAVITY: _Reader.strength_of_gravity,
    FieldKind.POINTS: _Reader.points,
    FieldKind.FRAMES: _Reader.frames,
    FieldKind.BODY: _Reader.body,
    FieldKind.ROWS: _Reader.rows,
    FieldKind.DIRECTIONS: _Reader.directions,
}


def add_element(loader: Reading, geometry: Geometry, kind: str, table: Any, path: Path, at: Path | None = None) -> None:
    """Read one element and add it; ``at`` is given if the whole element is a single value in the file."""
    made = REGISTRY[kind]
    reader = _Reader(loader, geometry, made, table, path, at)
    for key, entry in made.entries.items():
        value = getattr(table, key)
        if value is not None or entry.kind is FieldKind.STRENGTH_OF_GRAVITY:
            reader.given[key] = _FIELDS[entry.kind](reader, key, value, entry)
    loader.builder.add(made(**reader.given))
