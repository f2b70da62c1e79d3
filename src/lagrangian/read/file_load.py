"""Reads a model file into a `Builder`: names first, then geometry, then elements in the order of the file."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path as FilePath
from typing import Any, NoReturn

import sympy as sp

from lagrangian.codes import CodeText
from lagrangian.errors import ModelError, ParseError, Place, did_you_mean
from lagrangian.model import REGISTRY, Builder
from lagrangian.model.decimals import noting
from lagrangian.model.joint_texts import asked_joint
from lagrangian.quantities.quantity import Quantity, parse_unit, read_quantity, unit_and_words, unit_dimension
from lagrangian.quantities.source import shown
from lagrangian.read import file_schema as schema
from lagrangian.read.file_elements import add_element
from lagrangian.read.file_floating import FloatingFrames
from lagrangian.read.file_geometry import Geometry
from lagrangian.read.file_look import LookReader
from lagrangian.read.file_reading import Reading
from lagrangian.read.letters import normal, spelled, twin
from lagrangian.read.robots import is_markup, read_robot
from lagrangian.read.toml_index import Path
from lagrangian.read.validate import MAX_BYTES, decode, owner

_WORD = re.compile(r"[^\W\d]\w*")


def load(path: str | FilePath) -> Builder:
    """Return the description in a model file. Raises `ParseError` or `ModelError` with file, line and column."""
    name = str(path)
    try:
        with FilePath(path).open("rb") as file:
            data = file.read(MAX_BYTES + 1)
    except FileNotFoundError:
        raise _unreadable(name, "there is no such file", "check the path; `lagrangian new NAME` prints one") from None
    except IsADirectoryError:
        raise _unreadable(name, "this is a folder, not a file", "name the model file in it") from None
    except PermissionError:
        raise _unreadable(name, "the file may not be read", "check its permissions") from None
    except (OSError, ValueError) as error:
        raise _unreadable(name, f"the file cannot be read ({error})", "check the path") from None
    text = decode(data, name)
    return read_robot(text, name, FilePath(path).parent) if is_markup(text) else loads(text, name)


def _unreadable(name: str, what: str, fix: str) -> ModelError:
    return ModelError(what, place=Place(name), fix=fix, code="E702")


def loads(text: str, name: str | None = None) -> Builder:
    """Return the description in the text of a model file; messages use ``name`` as the name of the file."""
    return read_robot(text, name or "<text>") if is_markup(text) else Loader(text, name or "<text>").build()


class Loader(Reading):
    """Reads the sections of one file."""

    def __init__(self, text: str, name: str) -> None:
        super().__init__(text, name)
        self.geometry = Geometry(self)

    def build(self) -> Builder:
        """Read all sections, in an order in which each finds what it refers to."""
        self._coordinates()
        self._parameters()
        self._inputs()
        self._look_alikes()
        with noting(self.builder.decimals):
            self._definitions()
            self.geometry.read()
            self._elements()
        self._simulate()
        LookReader(self).read()
        return self.builder

    # -- names --------------------------------------------------------------------------------------------------

    def _coordinates(self) -> None:
        """Declare the coordinates; those of floating frames at their places among them."""
        floating = FloatingFrames(self, self.geometry)
        floating.declare(None)
        for name, value in self.file.coordinates.items():
            path, place = ("coordinates", name), self.index.of_key(("coordinates", name))
            table = (
                schema.CoordinateTable(description=value, unit=None, positive=False)
                if isinstance(value, str)
                else value
            )
            unit = self._unit(table.unit, (*path, "unit"))
            made = self.placed(
                lambda n=name, t=table, u=unit, p=place: self.builder.coordinate(
                    n, description=t.description, unit=u, positive=t.positive, place=p
                ),
                place,
            )
            self.scope.add(made.name, made.symbol)
            floating.declare(made.name)
        floating.finish()

    def _parameters(self) -> None:
        for name, value in self.file.parameters.items():
            path, place = ("parameters", name), self.index.of_key(("parameters", name))
            number, unit, description = self._parameter(value, path)
            made = self.placed(
                lambda n=name, v=number, u=unit, d=description, p=place: self.builder.parameter(
                    n, v, unit=u, description=d, place=p
                ),
                place,
            )
            self.scope.add(made.name, made.symbol)

    def _parameter(self, value: Any, path: Path) -> tuple[float | None, str | None, str]:
        """Return a parameter's value in SI units, its unit and its description."""
        if not isinstance(value, schema.ParameterTable):
            number, unit = self._number(value, path)
            return number, unit, ""
        unit = self._unit(value.unit, (*path, "unit"))
        if value.value is None:
            return None, unit, value.description
        number, own = self._number(value.value, (*path, "value"))
        if unit is not None and own is not None:
            raise ParseError(
                f"the unit is given twice, as {shown(own)} and as {shown(unit)}",
                element=owner(path, self.data),
                place=self.index.of_value((*path, "unit")),
                fix="keep one of the two",
                code="E404",
            )
        if unit is not None:
            number = float(sp.Rational(repr(number)) * sp.Rational(parse_unit(unit).factor))
        return number, unit or own, value.description

    def _number(self, value: Any, path: Path) -> tuple[float, str | None]:
        if isinstance(value, str):
            quantity = read_quantity(self.index.source(path, value, owner(path, self.data)))
            return quantity.value, quantity.unit or None
        return float(value), None

    def _unit(self, unit: str | None, path: Path) -> str | None:
        """Return a unit after checking that it is one."""
        if unit is None:
            return None
        place = self.index.source(path, unit, "").place
        return unit if parse_unit(unit, owner(path, self.data), place) else None

    def _inputs(self) -> None:
        for name, value in self.file.inputs.items():
            path, place = ("inputs", name), self.index.of_key(("inputs", name))
            if isinstance(value, str):
                unit, description = unit_and_words(value)
            else:
                unit, description = self._unit(value.unit, (*path, "unit")), value.description
            made = self.placed(
                lambda n=name, d=description, u=unit, p=place: self.builder.input(n, description=d, unit=u, place=p),
                place,
            )
            self.scope.add(made.name, made.symbol)

    def _look_alikes(self) -> None:
        """Raise an error for two names that look alike to a reader: θ1 and theta1, а (Cyrillic) and a."""
        seen: dict[str, tuple[str, str]] = {}
        sections: tuple[tuple[str, Mapping[str, Any]], ...] = (
            ("coordinates", self.file.coordinates),
            ("parameters", self.file.parameters),
            ("inputs", self.file.inputs),
            ("define", self.file.define),
        )
        for section, table in sections:
            for name in table:
                for form in {spelled(name), twin(name)}:
                    before = seen.setdefault(form, (section, name))
                    if before != (section, name) and normal(before[1]) != normal(name):
                        line = self.index.of_key(before).line
                        raise ParseError(
                            f"'{name}' and '{before[1]}' (line {line}) look alike",
                            place=self.index.of_key((section, name)),
                            fix="rename one of them",
                            code="E404",
                        )

    def _definitions(self) -> None:
        names = list(self.file.define)
        for number, name in enumerate(names):
            path = ("define", name)
            place = self.index.of_key(path)
            value = self.file.define[name]
            later = [w for w in _WORD.findall(value) if w in names[number:]] if isinstance(value, str) else []
            if later and later[0] not in self.scope:
                self._not_in_order(name, later[0])
            expr = self.expression(value, path, f"definition '{name}'")
            made = self.placed(lambda n=name, e=expr, p=place: self.builder.define(n, e, place=p), place)
            self.scope.add(made.name, made.symbol)

    def _not_in_order(self, name: str, later: str) -> NoReturn:
        """Raise the error for a definition that refers to itself or to a later one: a circle, or only the wrong
        order."""
        table = {n: [w for w in _WORD.findall(v) if w in self.file.define] for n, v in self._texts().items()}
        trail = _circle(table, name)
        place = self.index.of_value(("define", name))
        if trail:
            raise ParseError(
                f"the definitions form a circle: {' → '.join(trail)}",
                element=f"definition '{name}'",
                place=place,
                fix="write one of them without the others",
                code="E413",
            )
        raise ParseError(
            f"it uses '{later}', which is defined after it",
            element=f"definition '{name}'",
            place=place,
            fix=f"put '{later}' before '{name}'",
            code="E413",
        )

    def _texts(self) -> dict[str, str]:
        return {n: v for n, v in self.file.define.items() if isinstance(v, str)}

    # -- elements -----------------------------------------------------------------------------------------------

    def _elements(self) -> None:
        """Add the elements in the order of the file, whatever their kinds; then the constraints on them."""
        found: list[tuple[tuple[bool, int], Path, Callable[[], None]]] = []
        for kind in REGISTRY:
            last = REGISTRY[kind].ledger == "λ"
            for number, table in enumerate(getattr(self.file, kind)):
                path = (kind, number)
                add = partial(add_element, self, self.geometry, kind, table, path)
                found.append(((last, self.index.offset(path)), path, add))
        if self.file.energies is not None:
            for key in ("T", "V", "D", "Xi"):
                path = ("energies", key)
                if getattr(self.file.energies, key):
                    found.append(((False, self.index.offset(path)), path, lambda k=key: self._energy(k)))
        for _, path, add in sorted(found, key=lambda item: item[0]):
            self.placed(add, self.index.of_key(path))

    def _energy(self, key: str) -> None:
        table = self.file.energies
        assert table is not None
        if key == "Xi":
            for coordinate, value in table.Xi.items():
                path = ("energies", "Xi", coordinate)
                given = {"name": f"Xi_{coordinate}", "coordinate": coordinate, "value": value}
                made = schema.TABLES["generalized_force"](**given)
                add_element(self, self.geometry, "generalized_force", made, path, path)
            return
        kind, name = {"T": ("kinetic", "T*"), "V": ("potential", "V"), "D": ("dissipation", "D")}[key]
        path = ("energies", key)
        made = schema.TABLES[kind](**{"name": name, "value": getattr(table, key)})
        add_element(self, self.geometry, kind, made, path, path)

    # -- simulation ---------------------------------------------------------------------------------------------

    def _simulate(self) -> None:
        """Check the contents of [simulate] and store them as written."""
        table = self.file.simulate
        if table is None:
            return
        if table.duration is not None:
            path = ("simulate", "duration")
            duration = self._quantity(table.duration, path, "the duration", "10 s")
            exponents = duration.dimension.exponents
            if not duration.is_bare and exponents != unit_dimension("s"):
                self._refuse(path, f"expected a time, got {shown(duration.unit)}", "write '10 s'", "E408")
            if duration.value < 0:
                self._refuse(path, f"the duration is negative ({duration.value:g} s)", "give 0 or more", "E406")
        floating = [x.name for x in self.builder.floating]
        coordinates = [*self.file.coordinates, *floating]
        for name, value in table.initial.items():
            path = ("simulate", "initial", name)
            self._quantity(value, path, f"the initial value of '{name[:64]}'", "0.3 rad")
            base = name.removesuffix("'")
            if normal(base) not in map(normal, coordinates) or (base != name and normal(base) in floating):
                self._refuse(
                    path,
                    f"there is no coordinate {shown(base)}",
                    did_you_mean(base[:64], coordinates) or "known: " + ", ".join(coordinates),
                    "E402",
                )
        for number, name in enumerate(table.fixed):
            if normal(name) not in map(normal, coordinates):
                known = did_you_mean(name[:64], coordinates) or "known: " + ", ".join(coordinates)
                self._refuse(("simulate", "fixed", number), f"there is no coordinate {shown(name)}", known, "E402")
        joints = self.builder.joint_names
        for number, name in enumerate(table.reactions):
            if asked_joint(name, joints).joint not in joints:
                known = did_you_mean(name[:64], joints) or f"known: {', '.join(joints[:12]) or 'none'}"
                self._refuse(("simulate", "reactions", number), f"there is no joint {shown(name)}", known, "E402")
        for name, value in table.inputs.items():
            path = ("simulate", "inputs", name)
            if name not in self.file.inputs:
                known = list(self.file.inputs)
                hint = did_you_mean(name[:64], known) or "known: " + ", ".join(known)
                self._refuse(path, f"there is no input {shown(name)}", hint, "E402")
            self.expression(value, path, f"the input '{name}' in [simulate]")
        self.builder.settings.update(self.data["simulate"])

    def _quantity(self, value: Any, path: Path, what: str, example: str) -> Quantity:
        text = value if isinstance(value, str) else repr(value)
        return read_quantity(replace(self.index.source(path, text, what), example=example))

    def _refuse(self, path: Path, message: str, fix: str, code: CodeText) -> NoReturn:
        place = self.index.of_key(path) if code == "E402" else self.index.of_value(path)
        raise ParseError(message, element="[simulate]", place=place, fix=fix, code=code)


def _circle(table: Mapping[str, list[str]], start: str) -> list[str]:
    """Return a circle of references that starts and ends at ``start``, or an empty list."""
    trail, seen = [(start, iter(table.get(start, ())))], {start}
    while trail:
        for name in trail[-1][1]:
            if name == start:
                return [*(n for n, _ in trail), start]
            if name not in seen:
                seen.add(name)
                trail.append((name, iter(table.get(name, ()))))
                break
        else:
            trail.pop()
    return []
