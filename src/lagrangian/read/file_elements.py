"""From an element's table in the file to the element; one function a kind."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import sympy as sp

from lagrangian.errors import ParseError, did_you_mean
from lagrangian.model import (
    Damper,
    Dissipation,
    Element,
    Force,
    Frame,
    GeneralizedForce,
    Gravity,
    Kinetic,
    Particle,
    Potential,
    RigidBody,
    Spring,
    Torque,
)
from lagrangian.model.elements.damper import RATE
from lagrangian.model.elements.spring import DELTA
from lagrangian.quantities.source import shown
from lagrangian.read.toml_index import Path

if TYPE_CHECKING:
    from lagrangian.read.file_geometry import Geometry
    from lagrangian.read.file_reading import Reading

STANDARD_GRAVITY = 9.81
"""[m/s²] The parameter g unless the file declares it."""


class _Reader:
    """Reads the fields of one element's table."""

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
        """The path of a field; a whole element that is one value of [energies] is its own field."""
        return (*self.path, key) if self.single is None else self.single

    def expressions(self, *keys: str, local: tuple[sp.Symbol, ...] = ()) -> None:
        """Read fields that are expressions, where given."""
        for key in keys:
            value = getattr(self.table, key)
            if value is not None:
                self.given[key] = self.loader.expression(value, self.where(key), f"{key} of {self.title}", local)

    def scalar_or_vector(self, key: str) -> None:
        """Read a field that is an expression or a list of them."""
        value = getattr(self.table, key)
        if isinstance(value, list):
            self.given[key] = self.loader.vector(value, self.where(key), f"the {key} of {self.title}")
        else:
            self.expressions(key)

    def points(self, *keys: str) -> None:
        """Read fields that are points, where given."""
        for key in keys:
            value = getattr(self.table, key)
            if value is not None:
                self.given[key] = self.geometry.point(value, self.where(key))

    def between(self) -> None:
        """Read the two points that an element joins, where given."""
        if self.table.between is not None:
            path = self.where("between")
            self.given["between"] = tuple(
                self.geometry.named_point(name, (*path, i)) for i, name in enumerate(self.table.between)
            )

    def frames_or_angles(self, *keys: str) -> None:
        """Read fields that are a frame or an angle, where given."""
        for key in keys:
            value = getattr(self.table, key)
            if value is not None:
                self.given[key] = self.geometry.frame_or_angle(value, self.where(key), f"{key} of {self.title}")

    def axes(self) -> None:
        """Read the frame whose axes a vector is given in, where given."""
        if self.table.axes is not None:
            self.given["axes"] = self.geometry.frame(self.table.axes, self.where("axes"))

    def add(self, kind: type[Element]) -> None:
        """Make the element and hand it to the builder."""
        self.loader.builder.add(kind(**self.given))


def _particle(r: _Reader) -> None:
    r.expressions("mass")
    r.points("at")


def _rigid_body(r: _Reader) -> None:
    r.expressions("mass")
    inertia = r.table.inertia
    if isinstance(inertia, list):
        path, what = r.where("inertia"), f"the inertia of {r.title}"
        r.given["inertia"] = [
            list(r.loader.vector(row, (*path, i), what))
            if isinstance(row, list)
            else r.loader.expression(row, (*path, i), what)
            for i, row in enumerate(inertia)
        ]
    else:
        r.expressions("inertia")
    r.points("at")
    r.frames_or_angles("frame")
    frame = r.given["frame"]
    if not isinstance(frame, Frame):
        r.given["frame"] = r.loader.builder.frame(None, frame, place=r.loader.index.of_value(r.where("frame")))


def _gravity(r: _Reader) -> None:
    r.given["direction"] = r.loader.vector(r.table.direction, r.where("direction"), f"the direction of {r.title}")
    if r.table.g is None:
        r.given["g"] = r.loader.builder.standard_gravity(STANDARD_GRAVITY)
    r.expressions("g")
    r.points("datum")


def _spring(r: _Reader) -> None:
    r.expressions("k", "deflection", "rest")
    r.expressions("law", "energy", local=(DELTA,))
    r.between()


def _damper(r: _Reader) -> None:
    r.expressions("b", "deflection")
    r.expressions("law", local=(RATE,))
    r.between()


def _force(r: _Reader) -> None:
    r.scalar_or_vector("value")
    r.expressions("deflection")
    r.points("at", "reaction")
    r.between()
    r.axes()


def _torque(r: _Reader) -> None:
    r.scalar_or_vector("value")
    r.frames_or_angles("on", "reaction")
    r.axes()


def _energy(r: _Reader) -> None:
    r.expressions("value")


def _generalized_force(r: _Reader) -> None:
    name = r.table.coordinate
    coordinates = {c: r.loader.scope[c] for c in r.loader.generalized_names}
    found = [n for n in r.loader.scope.meanings(name)[0] if n in coordinates]
    if len(found) != 1:
        raise ParseError(
            f"{shown(name)} is not a coordinate",
            element=r.title,
            place=r.loader.index.of_value(r.where("coordinate")),
            fix=did_you_mean(name[:64], coordinates) or "known: " + ", ".join(coordinates),
            code="E402",
        )
    r.given["coordinate"] = coordinates[found[0]]
    r.expressions("value")


_KINDS: dict[str, tuple[type[Element], Callable[[_Reader], None]]] = {
    "particle": (Particle, _particle),
    "rigid_body": (RigidBody, _rigid_body),
    "gravity": (Gravity, _gravity),
    "spring": (Spring, _spring),
    "damper": (Damper, _damper),
    "force": (Force, _force),
    "torque": (Torque, _torque),
    "potential": (Potential, _energy),
    "kinetic": (Kinetic, _energy),
    "dissipation": (Dissipation, _energy),
    "generalized_force": (GeneralizedForce, _generalized_force),
}

KINDS = tuple(_KINDS)
"""The kinds of elements in a file, as its arrays of tables are called."""


def add_element(loader: Reading, geometry: Geometry, kind: str, table: Any, path: Path, at: Path | None = None) -> None:
    """Read one element and add it; ``at`` is given where a whole element is one value of the file."""
    made, fill = _KINDS[kind]
    reader = _Reader(loader, geometry, made, table, path, at)
    fill(reader)
    reader.add(made)
