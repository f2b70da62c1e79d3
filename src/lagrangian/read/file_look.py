"""Checks ``[look]``, what a picture needs and the mechanics does not say; errors have their place in the file."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any, NoReturn

from lagrangian.codes import CodeText
from lagrangian.errors import ParseError, did_you_mean
from lagrangian.model import Body
from lagrangian.model.hints import BODY_KINDS, LINE_KINDS
from lagrangian.quantities.quantity import Quantity, read_quantity, unit_dimension
from lagrangian.quantities.source import shown
from lagrangian.read import file_schema as schema
from lagrangian.read.file_reading import Reading
from lagrangian.read.letters import normal
from lagrangian.read.toml_index import Path

NUMBER, LENGTH = unit_dimension("rad"), unit_dimension("m")
"""Dimensions by powers of kilogram, metre and second; an angle is a number."""

LARGEST_ANGLE = 4 * math.pi


class LookReader:
    """Checks the names, units and values of ``[look]`` and stores them as written."""

    def __init__(self, reading: Reading) -> None:
        self.reading, self.builder = reading, reading.builder

    def read(self) -> None:
        """Check the whole table."""
        table = self.reading.file.look
        if table is None:
            return
        self._pose(table.pose)
        bodies = [e.name for e in self.builder.elements if isinstance(e, Body)]
        for body, kind in table.kinds.items():
            self._known("body", body, bodies, ("look", "kinds", body))
            self._kind(kind, BODY_KINDS, ("look", "kinds", body))
        if table.view is not None:
            for key in ("azimuth", "elevation"):
                if (value := getattr(table.view, key)) is not None:
                    self._angle(value, ("look", "view", key), f"the {key} of the view")
        points = self.builder.point_names
        places = list(dict.fromkeys([*bodies, *points]))
        for number, name in enumerate(table.trail):
            self._known("point or body", name, places, ("look", "trail", number))
        seen = [*(e.name for e in self.builder.elements), *self._coordinates]
        for number, name in enumerate(table.hide):
            self._known("element or coordinate", name, seen, ("look", "hide", number))
        for number, line in enumerate(table.line):
            self._kind(line.kind, LINE_KINDS, ("look", "line", number, "kind"))
            for i, name in enumerate(line.through):
                self._known("point or body", name, places, ("look", "line", number, "through", i))
        for number, shape in enumerate(table.shape):
            self._shape(shape, ("look", "shape", number), bodies, places)
        written = dict(self.reading.data["look"])
        if table.pose:
            written["pose"] = {normal(name): value for name, value in written["pose"].items()}
        self.builder.look.update(written)

    @property
    def _coordinates(self) -> list[str]:
        return [c.name for c in self.builder.coordinates]

    # -- values -------------------------------------------------------------------------------------------------

    def _pose(self, pose: dict[str, Any]) -> None:
        units = {c.name: c.unit for c in self.builder.coordinates}
        for name, value in pose.items():
            path: Path = ("look", "pose", name)
            if normal(name) not in units:
                self._known("coordinate", name, list(units), path)
            quantity = self._quantity(value, path, f"the pose of '{name}'")
            unit = units[normal(name)]
            wanted = (LENGTH, NUMBER) if unit is None else (unit_dimension(unit),)
            if not quantity.is_bare and quantity.dimension.exponents not in wanted:
                asked = "a length or an angle" if unit is None else f"a value in {unit}"
                self._refuse(
                    path,
                    f"expected {asked}, got {shown(quantity.unit)}",
                    "give it in the unit of the coordinate",
                    "E408",
                )

    def _angle(self, value: Any, path: Path, what: str) -> None:
        quantity = self._quantity(value, path, what)
        if quantity.dimension.exponents != NUMBER:
            self._refuse(path, f"expected an angle, got {shown(quantity.unit)}", "write '40 deg'", "E408")
        if abs(quantity.value) > LARGEST_ANGLE:
            self._refuse(path, f"{what} is {quantity.value:.3g} rad", "give an angle within two turns", "E406")

    def _length(self, value: Any, path: Path, what: str, *, positive: bool = False) -> None:
        quantity = self._quantity(value, path, what)
        if not quantity.is_bare and quantity.dimension.exponents != LENGTH:
            self._refuse(path, f"expected a length, got {shown(quantity.unit)}", "write '0.2 m'", "E408")
        if positive and quantity.value <= 0:
            self._refuse(path, f"{what} must be greater than 0 (got {quantity.value:g} m)", "write '0.2 m'", "E406")

    def _quantity(self, value: Any, path: Path, what: str) -> Quantity:
        text = value if isinstance(value, str) else repr(value)
        return read_quantity(self.reading.index.source(path, text, what))

    # -- shapes -------------------------------------------------------------------------------------------------

    def _shape(self, shape: schema.LookShapeTable, path: Path, bodies: list[str], places: list[str]) -> None:
        frames = self.builder.frame_names
        self._known("frame or body", shape.frame, list(dict.fromkeys([*frames, *bodies])), (*path, "frame"))
        if shape.at is not None:
            self._known("point or body", shape.at, places, (*path, "at"))
        if (shape.box is None) == (shape.points is None):
            both = "both 'box' and 'points' are given" if shape.box is not None else "the outline is missing"
            raise ParseError(
                both,
                element="[[look.shape]]",
                place=self.reading.index.of_key(path),
                fix='give one of them: box = ["0.05 m", "0.6 m"], or points = [[x, y], …]',
                code="E404" if shape.box is not None else "E401",
            )
        for i, value in enumerate(shape.box or ()):
            self._length(value, (*path, "box", i), "a side of the box", positive=True)
        for i, corner in enumerate(shape.points or ()):
            if len(corner) > self.builder.dimension:
                where = (*path, "points", i)
                self._refuse(where, f"this point has {len(corner)} components in the plane", "give two", "E414")
            for j, value in enumerate(corner):
                self._length(value, (*path, "points", i, j), "a component of the outline")

    # -- errors -------------------------------------------------------------------------------------------------

    def _known(self, what: str, name: str, known: Iterable[str], path: Path) -> None:
        listed = list(known)
        if name not in listed:
            few = ", ".join(listed[:12]) + (", …" if len(listed) > 12 else "")
            fix = did_you_mean(name[:64], listed) or f"known: {few or 'none'}"
            self._refuse(path, f"there is no {what} {shown(name)}", fix, "E402")

    def _kind(self, kind: str, known: tuple[str, ...], path: Path) -> None:
        if kind not in known:
            fix = did_you_mean(kind[:64], known) or f"known: {', '.join(known)}"
            place = self.reading.index.of_value(path)
            raise ParseError(f"nothing is drawn as {shown(kind)}", element="[look]", place=place, fix=fix, code="E402")

    def _refuse(self, path: Path, message: str, fix: str, code: CodeText) -> NoReturn:
        index = self.reading.index
        place = index.of_key(path) if code == "E402" and isinstance(path[-1], str) else index.of_value(path)
        raise ParseError(message, element="[look]", place=place, fix=fix, code=code)
