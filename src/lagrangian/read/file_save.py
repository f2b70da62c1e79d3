"""Writes a `Model` as a model file that is read back as the same system.

Elements keep their order and their names. A point without a name is written inline if it is used only once; otherwise
it gets a name (``P1``, ``P2`` …). A frame without a name gets one (``F1`` …).
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable
from fractions import Fraction
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.errors import ModelError, ParseError
from lagrangian.model import Coordinate, Element, Floating, Frame, Model, Parameter, Point
from lagrangian.model.elements.answers import REQUIRED
from lagrangian.page.plain import plain
from lagrangian.quantities.quantity import parse_quantity, parse_unit, unit_and_words
from lagrangian.read.expression import parse_expression
from lagrangian.read.scope import Scope

_BARE = re.compile(r"[A-Za-z0-9_-]+\Z")
_ESCAPES = {'"': '\\"', "\\": "\\\\", "\n": "\\n", "\t": "\\t", "\r": "\\r", "\b": "\\b", "\f": "\\f"}


def dumps(model: Model) -> str:
    """Return the model as the text of a model file.

    Raises `ModelError` if an expression contains something that the grammar of model files cannot express.
    """
    return _Writer(model).text()


class _Writer:
    def __init__(self, model: Model) -> None:
        self.model = model
        self.scope = Scope(model.symbols)
        self.lines: list[str] = []
        self.frames = self._frame_names()
        self.points = self._point_names()

    # -- names for points and frames --------------------------------------------------------------------------------

    def _all_points(self) -> list[Point]:
        """All points, parents before children, the named ones in their order."""
        found: dict[int, Point] = {}

        def visit(point: Point) -> None:
            chain: list[Point] = []
            at: Point | None = point
            while at is not None and not at.is_origin and id(at) not in found:
                chain.append(at)
                at = at.parent
            for p in reversed(chain):
                found[id(p)] = p
                frame = p.frame
                while frame is not None:
                    visit(frame.origin)
                    frame = frame.parent

        for point in self.model.points:
            visit(point)
        for frame in self.frames:
            visit(self.frame_table[frame].origin)
        for element in self.model.elements:
            for _, point in element.points():
                visit(point)
        return list(found.values())

    def _all_frames(self) -> list[Frame]:
        found: dict[int, Frame] = {}

        def visit(frame: Frame | None) -> None:
            chain: list[Frame] = []
            while frame is not None and id(frame) not in found:
                chain.append(frame)
                frame = frame.parent
            for f in reversed(chain):
                found[id(f)] = f

        def visit_points(point: Point | None) -> None:
            while point is not None and not point.is_origin:
                visit(point.frame)
                point = point.parent

        for frame in self.model.frames:
            visit(frame)
        for point in self.model.points:
            visit_points(point)
        for element in self.model.elements:
            for _, point in element.points():
                visit_points(point)
            for _, frame in element.frames():
                visit(frame)
        return list(found.values())

    def _frame_names(self) -> dict[int, str]:
        frames = self._all_frames()
        self.frame_table = {id(f): f for f in frames}
        return _named(frames, "F", {f.name for f in frames if f.name})

    def _point_names(self) -> dict[int, str]:
        """Names for the points that have one, or that are used by several others."""
        points = self._all_points()
        uses: Counter[int] = Counter()
        joined: set[int] = set()
        for p in points:
            uses[id(p.parent)] += 2
        for frame in self.frame_table.values():
            uses[id(frame.origin)] += 2
        for element in self.model.elements:
            for key, point in element.points():
                uses[id(point)] += 1
                if key in ("between", "through"):
                    joined.add(id(point))
        kept = [p for p in points if p.name or uses[id(p)] > 1 or id(p) in joined]
        return _named(kept, "P", {p.name for p in points if p.name})

    # -- values -------------------------------------------------------------------------------------------------

    def expression(self, expr: sp.Expr, what: str, local: tuple[sp.Symbol, ...] = ()) -> str:
        """Return an expression as a TOML value, after checking that it is read back as the same."""
        if expr.is_Integer and abs(expr) < 10**15:
            return str(expr)
        text = plain(self.as_written(expr))
        try:
            scope = self.scope.extended({s.name: s for s in local}) if local else self.scope
            same = parse_expression(text, scope, what=what)
        except ParseError as error:
            raise ModelError(
                f"{what} cannot be written to a model file: {error.what}", fix=error.fix, code="E701"
            ) from None
        if plain(self.as_written(same)) != text and bounded.expand(same - expr) != 0:
            raise ModelError(
                f"{what} cannot be written to a model file: {text} reads back as {plain(same)}",
                fix="write it in the functions of the model file's grammar",
                code="E701",
            )
        return _text(text)

    def as_written(self, expr: sp.Expr) -> sp.Expr:
        """The expression with decimals where the description had them."""
        written = {x: repr(float(x)) for x in expr.atoms(sp.Rational) if abs(x) in self.model.decimals}
        found = {x: sp.Float(digits) for x, digits in written.items() if sp.Rational(digits) == x}
        return cast("sp.Expr", expr.xreplace(found)) if found else expr

    def vector(self, values: Iterable[sp.Expr], what: str) -> str:
        """Return a list of expressions."""
        return "[" + ", ".join(self.expression(v, what) for v in values) + "]"

    def point(self, point: Point, what: str) -> str:
        """Return the name of a point, or the point itself."""
        if point.is_origin:
            return _text("origin")
        if id(point) in self.points:
            return _text(self.points[id(point)])
        return self.offset(point, what)

    def offset(self, point: Point, what: str) -> str:
        """Return the offset of a point: a list, or a table with the point from which it is measured."""
        assert point.parent is not None
        offset = self.vector(point.offset, what)
        default = point.frame.origin if point.frame is not None else self.model.origin
        parts = []
        if point.parent is not default:
            parts.append(f"from = {self.point(point.parent, what)}")
        if point.frame is not None:
            parts.append(f"frame = {_text(self.frames[id(point.frame)])}")
        return "{ " + ", ".join([*parts, f"offset = {offset}"]) + " }" if parts else offset

    # -- the file -----------------------------------------------------------------------------------------------

    def text(self) -> str:
        """Write all sections."""
        model = self.model
        self.lines = [f"name = {_text(model.name)}"]
        floating = {c.name for f in model.floating if f.floating for c in f.floating.coordinates}
        declared = [c for c in model.coordinates if c.name not in floating]
        self._section("coordinates", ((c.name, _coordinate(c)) for c in declared))
        self._section("parameters", ((p.name, _parameter(p)) for p in model.parameters))
        self._section("inputs", ((i.name, _input(i.description, i.unit)) for i in model.inputs))
        self._section(
            "define",
            ((d.name, self.expression(d.expression, f"definition '{d.name}'")) for d in model.definitions),
        )
        for key, frame in self.frame_table.items():
            self._frame_table(self.frames[key], frame)
        given = {id(f.origin) for f in model.floating if f.floating is not None and not f.floating.held}
        points = [p for p in self._all_points() if id(p) in self.points and id(p) not in given]
        self._section("points", ((self.points[id(p)], self.offset(p, f"point '{p.name}'")) for p in points))
        for element in model.elements:
            self._element(element)
        self._settings()
        return "\n".join(self.lines) + "\n"

    def _section(self, name: str, rows: Iterable[tuple[str, str]]) -> None:
        rows = list(rows)
        if rows:
            self.lines += ["", f"[{name}]", *(f"{_key(key)} = {value}" for key, value in rows)]

    def _frame_table(self, name: str, frame: Frame) -> None:
        what = f"frame '{name}'"
        rows = [("name", _text(name))]
        if frame.floating is not None:
            rows += [("ball" if frame.floating.held else "floating", "true"), *self._after(frame.floating)]
        else:
            rows.append(("angle", self.expression(frame.angle, f"the angle of {what}")))
        if frame.axis is not None:
            rows.append(("axis", self.vector(frame.axis, f"the axis of {what}")))
        if frame.floating is None or frame.floating.held:
            if frame.parent is not None:
                rows.append(("parent", _text(self.frames[id(frame.parent)])))
            default = frame.parent.origin if frame.parent is not None else self.model.origin
            if frame.origin is not default:
                rows.append(("origin", self.point(frame.origin, what)))
        self.lines += ["", "[[frame]]", *(f"{key} = {value}" for key, value in rows)]

    def _after(self, floating: Floating) -> list[tuple[str, str]]:
        """What the coordinates of a floating frame follow, unless they come first."""
        number = self.model.coordinates.index(floating.coordinates[0])
        if number == 0:
            return []
        before = self.model.coordinates[number - 1]
        frames = {c.name: f.name for f in self.model.floating if f.floating for c in f.floating.coordinates}
        return [("after", _text(frames.get(before.name) or before.name))]

    def _element(self, element: Element) -> None:
        """Write an element: its fields in their order, without those that were not given."""
        rows = [("name", _text(element.name))]
        for key, entry in element.entries.items():
            value = getattr(element, key)
            made = entry.made_from and getattr(element, entry.made_from) is not None
            if not made and (entry.default is REQUIRED or value != entry.default):
                rows.append((key, self._field(element, key, value)))
        self.lines += ["", f"[[{element.kind}]]", *(f"{key} = {value}" for key, value in rows)]

    def _field(self, element: Element, key: str, value: Any) -> str:
        what = f"the {key} of {element.title}"
        if isinstance(value, Point):
            return self.point(value, what)
        if isinstance(value, Frame):
            return _text(self.frames[id(value)])
        if isinstance(value, sp.MatrixBase):
            if value.rows == 1:
                return self.expression(value[0, 0], what)
            if value.is_diagonal():
                return self.vector([value[i, i] for i in range(3)], what)
            return "[" + ", ".join(self.vector(value.row(i), what) for i in range(3)) + "]"
        if isinstance(value, Element):
            return _text(value.name)
        if isinstance(value, str):
            return _text(value)
        if isinstance(value, tuple):
            if isinstance(value[0], sp.Expr):
                return self.vector(value, what)
            return "[" + ", ".join(self._field(element, key, x) for x in value) + "]"
        return self.expression(value, what, element.entries[key].local)

    def _settings(self) -> None:
        if self.model.settings:
            self.lines += ["", "[simulate]"]
            self.lines += [f"{_key(key)} = {_value(value)}" for key, value in self.model.settings.items()]
        if self.model.look:
            arrays = {key: value for key, value in self.model.look.items() if key in ("line", "shape")}
            self._section("look", ((k, _value(v)) for k, v in self.model.look.items() if k not in arrays))
            for key, tables in arrays.items():
                for table in tables:
                    self.lines += ["", f"[[look.{key}]]", *(f"{_key(k)} = {_value(v)}" for k, v in table.items())]


def _named(things: Iterable[Any], letter: str, taken: set[str]) -> dict[int, str]:
    """Give every item a unique name: its own, or a letter with the next free number."""
    names: dict[int, str] = {}
    number = 0
    for thing in things:
        name = thing.name
        while not name:
            number += 1
            name = f"{letter}{number}" if f"{letter}{number}" not in taken else None
        names[id(thing)] = name
    return names


def _described(description: str, unit: str | None) -> str:
    if unit is None:
        return _text(description)
    return "{ " + f"description = {_text(description)}, unit = {_text(unit)}" + " }"


def _coordinate(c: Coordinate) -> str:
    if not c.positive:
        return _described(c.description, c.unit)
    unit = [] if c.unit is None else [f"unit = {_text(c.unit)}"]
    return "{ " + ", ".join([f"description = {_text(c.description)}", *unit, "positive = true"]) + " }"


def _input(description: str, unit: str | None) -> str:
    short = description if unit is None else f"{unit}, {description}" if description else unit
    if unit_and_words(short) == (unit, description):
        return _text(short)
    return _described(description, unit) if unit is not None else "{ description = " + _text(description) + " }"


def _parameter(parameter: Parameter) -> str:
    """Return a parameter in the shortest form: 2.0, "2.0 kg", or a table."""
    value, unit = parameter.value, parameter.unit
    short = None if value is None else repr(value) if unit is None else _text(_with_unit(value, unit))
    if not parameter.description and short is not None:
        return short
    parts = [] if short is None else [f"value = {short}"]
    if unit is not None and short is None:
        parts.append(f"unit = {_text(unit)}")
    if parameter.description:
        parts.append(f"description = {_text(parameter.description)}")
    return "{ " + ", ".join(parts) + " }" if parts else "{}"


def _with_unit(value: float, unit: str) -> str:
    """Return an SI value in a unit, with digits that are read back as exactly the same value."""
    exact = Fraction(value) / parse_unit(unit).factor
    candidates = [repr(float(f"{float(exact):.{digits}g}")) for digits in (6, 12, 15, 16, 17)]
    near = float(exact)
    candidates += [f"{near:.17g}", f"{near:.18g}", f"{float(exact):.20g}"]
    for number in candidates:
        number = number.removesuffix(".0")
        if parse_quantity(f"{number} {unit}").value == value:
            return f"{number} {unit}"
    digits = sp.Rational(exact.numerator, exact.denominator).evalf(40)
    number = str(digits)
    if parse_quantity(f"{number} {unit}").value == value:
        return f"{number} {unit}"
    return f"{value!r} {parse_unit(unit).dimension}".strip()


def _key(name: str) -> str:
    return name if _BARE.match(name) else _text(name)


def _text(text: str) -> str:
    """Return a TOML basic string."""
    return '"' + "".join(_ESCAPES.get(c) or (c if c.isprintable() else _code(c)) for c in text) + '"'


def _code(c: str) -> str:
    return f"\\u{ord(c):04X}" if ord(c) < 0x10000 else f"\\U{ord(c):08X}"


def _value(value: Any) -> str:
    """Return plain data as TOML."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(_value, value)) + "]"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{_key(str(k))} = {_value(v)}" for k, v in value.items()) + " }" if value else "{}"
    raise ModelError(f"{value!r} in [simulate] or [look] cannot be written to a file", fix="use numbers and text")
