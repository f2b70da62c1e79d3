"""Collects a description, checks every part of it immediately, and freezes it as a `Model`."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, TypeVar

import sympy as sp

from lagrangian.errors import ModelError, NoSuchEntry, Place
from lagrangian.model.body_checks import check_body
from lagrangian.model.checks import check_acted_on, check_kind, check_position, check_use
from lagrangian.model.coils import check_coils, check_inertia
from lagrangian.model.declarations import Declarations
from lagrangian.model.effect import check_effect
from lagrangian.model.elements import Body, Element, FieldKind, Level
from lagrangian.model.floating import Floating
from lagrangian.model.geometry import Frame, Point, as_axis, as_expr, as_vector, is_listed
from lagrangian.model.model import Model
from lagrangian.model.names import check_name, is_text
from lagrangian.model.rows import check_rows, with_pressing_rows

E = TypeVar("E", bound=Element)
MAX_ELEMENTS = 100_000


class Builder(Declarations):
    """A description that is being built. Every method checks its arguments and raises `ModelError`."""

    def __init__(self, name: str) -> None:
        if not is_text(name) or not name.strip():
            raise ModelError("a system needs a name", fix='System("two-link arm")', code="E401")
        super().__init__()
        self.name = name.strip()
        self.origin = Point("origin", None, (), None, self)
        self.decimals: set[sp.Rational] = set()
        self._points: dict[str, Point] = {"origin": self.origin}
        self._frames: dict[str, Frame] = {}
        self._elements: list[Element] = []
        self._element_names: dict[str, Element] = {}
        self._dimension: tuple[int, str] | None = None
        self._checked: dict[int, Point | Frame] = {}  # once found right, a point and all it hangs on stay right

    def __getstate__(self) -> dict[str, Any]:
        """The state for a copy, without the record of checked points and frames, which are compared by identity."""
        return {**self.__dict__, "_checked": list(self._checked.values()), "_frozen": None}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state, _checked={id(thing): thing for thing in state["_checked"]})

    @property
    def joint_names(self) -> list[str]:
        """The names by which reactions may be asked for: constraints, points and bodies."""
        acting = [e.name for e in self._elements if e.ledger == "λ" or isinstance(e, Body)]
        return list(dict.fromkeys([*acting, *self._points]))

    @property
    def point_names(self) -> list[str]:
        """The names of the points, the origin first."""
        return list(self._points)

    @property
    def frame_names(self) -> list[str]:
        """The names of the frames, in order."""
        return list(self._frames)

    @property
    def dimension(self) -> int:
        """2 in the plane and 3 in space."""
        return self._dimension[0] if self._dimension else 2

    # -- geometry -----------------------------------------------------------------------------------------------

    def _fit(self, dimension: int, what: str, place: Place | None) -> None:
        """Check that all points and frames have the same dimension as the first."""
        if self._dimension is None:
            self._dimension = (dimension, what)
        elif self._dimension[0] != dimension:
            first = self._dimension
            raise ModelError(
                f"{what} has {dimension} components, but {first[1]} has {first[0]}",
                place=place,
                fix=f"a system is either planar or spatial: give {first[0]} components everywhere",
                code="E414",
            )

    def _own(self, thing: Point | Frame, what: str, place: Place | None) -> None:
        if thing.owner is not self:
            raise ModelError(
                f"{what} belongs to another system",
                place=place,
                fix="make it from this system's own origin and frames",
                code="E412",
            )

    def point(
        self,
        name: str | None,
        offset: object,
        *,
        parent: Point | None = None,
        frame: Frame | None = None,
        place: Place | None = None,
    ) -> Point:
        """Add a named point at ``offset`` from ``parent`` (the frame's origin, or the origin) in ``frame``'s axes."""
        what = f"point '{name}'" if isinstance(name, str) else "a point"
        if name is not None:
            name = self._claim_place(name, "point", self._points, place)
        check_kind(parent, Point, f"the point that {what} is measured from", place)
        check_kind(frame, Frame, f"the frame of {what}", place)
        base = parent if parent is not None else (frame.origin if frame is not None else self.origin)
        made = Point(name, base, as_vector(offset, what, place=place), frame, self, place)
        self._check_point(made, what, place)
        if name is not None:
            self._points[name] = made
        return made

    def frame(
        self,
        name: str | None,
        angle: object,
        *,
        axis: object = None,
        parent: Frame | None = None,
        origin: Point | None = None,
        place: Place | None = None,
    ) -> Frame:
        """Add a frame turned by ``angle`` from ``parent`` about ``axis`` (in space)."""
        what = f"frame '{name}'" if isinstance(name, str) else "a frame"
        if name is not None:
            name = self._claim_place(name, "frame", self._frames, place)
        check_kind(parent, Frame, f"the parent of {what}", place)
        check_kind(origin, Point, f"the origin of {what}", place)
        expr = as_expr(angle, f"the angle of {what}", place=place)
        turned = None if axis is None else as_axis(axis, what, place=place)
        if parent is not None and (parent.dimension == 2) != (turned is None):
            raise ModelError(
                f"{what} and its parent must both have an axis (space) or both have none (plane)",
                place=place,
                fix="give axis=(0, 0, 1) to both, or to neither",
                code="E414",
            )
        base = origin if origin is not None else (parent.origin if parent is not None else self.origin)
        made = Frame(name, parent, turned, expr, base, self, place)
        self._check_frame(made, what, place)
        self._frozen = None
        if name is not None:
            self._frames[name] = made
        return made

    def floating_frame(self, name: str, *, place: Place | None = None) -> Frame:
        """Add a frame that floats in space: seven coordinates, six quasi-velocities (`Floating`), and its origin.

        Their names begin with that of the frame: ``name_x``, ``name_qx``, ``name_vx``, ``name_wx`` …; the point is
        ``name_origin``.
        """
        name = self._claim_place(name, "frame", self._frames, place)
        self._fit(3, f"frame '{name}'", place)
        at = self._claim_place(f"{name}_origin", "point", self._points, place)
        made = self.quaternion(name, place=place)
        origin = self._points[at] = Point(at, self.origin, made.position, None, self, place)
        frame = self._frames[name] = Frame(name, None, None, sp.S.Zero, origin, self, place, floating=made)
        self._checked.update({id(origin): origin, id(frame): frame})
        return frame

    def ball_frame(
        self,
        name: str,
        *,
        parent: Frame | None = None,
        origin: Point | None = None,
        declared: Floating | None = None,
        place: Place | None = None,
    ) -> Frame:
        """Add a frame that turns freely about ``origin``, which moves with ``parent``: four coordinates, three
        quasi-velocities (`Floating`), unless they were ``declared`` before.
        """
        what = f"frame '{name}'" if is_text(name) else "a frame"
        name = self._claim_place(name, "frame", self._frames, place)
        check_kind(parent, Frame, f"the parent of {what}", place)
        check_kind(origin, Point, f"the origin of {what}", place)
        self._fit(3, what, place)
        base = origin if origin is not None else (parent.origin if parent is not None else self.origin)
        self._check_point(base, f"the origin of {what}", place)
        if parent is not None:
            self._check_frame(parent, f"the parent of {what}", place)
        made = declared or self.quaternion(name, held=True, place=place)
        frame = self._frames[name] = Frame(name, parent, None, sp.S.Zero, base, self, place, floating=made)
        self._checked[id(frame)] = frame
        return frame

    def _claim_place(self, name: str, what: str, table: Mapping[str, Any], place: Place | None) -> str:
        self._frozen = None
        name = check_name(name, what, place=place)
        if name in table:
            raise ModelError(f"{what} '{name}' is defined twice", place=place, fix="give it another name", code="E404")
        return name

    def _check_point(self, point: Point, what: str, place: Place | None) -> None:
        self._own(point, what, place)
        chain: list[Point] = []
        at: Point | None = point
        while at is not None and not at.is_origin and id(at) not in self._checked:
            chain.append(at)
            at = at.parent
        for p in chain:
            self._fit(len(p.offset), what, place)
            for i, x in enumerate(p.offset, 1):
                self._check_known(x, f"component {i} of {what}", place)
                self._check_position(x, f"component {i} of {what}", place)
            if p.frame is not None:
                self._check_frame(p.frame, f"the frame of {what}", place)
        self._checked.update((id(p), p) for p in chain)

    def _check_frame(self, frame: Frame, what: str, place: Place | None) -> None:
        at: Frame | None = frame
        chain: list[Frame] = []
        while at is not None and id(at) not in self._checked:
            chain.append(at)
            self._own(at, what, place)
            self._fit(at.dimension, what, place)
            self._check_known(at.angle, f"the angle of {what}", place)
            self._check_position(at.angle, f"the angle of {what}", place)
            at = at.parent
        self._checked.update((id(f), f) for f in chain)

    def _check_position(self, expr: sp.Expr, where: str, place: Place | None) -> None:
        inputs = {i.symbol: i.name for i in self._inputs.values()}
        velocities = {v.symbol: v.name for v in self._velocities.values()}
        check_position(self._written_out(expr), where, inputs, velocities, place)

    # -- elements -----------------------------------------------------------------------------------------------

    def add(self, element: E) -> E:
        """Check an element, name it if it has no name, and store it."""
        self._frozen = None
        if len(self._elements) >= MAX_ELEMENTS:
            raise ModelError(f"more than {MAX_ELEMENTS} elements", code="E601")
        element = element.named(self._element_name(element))
        if element.ledger == "λ" and any(element.name in table for table in self._symbol_tables):
            raise ModelError(
                f"the name '{element.name}' is taken by a coordinate, parameter, input or definition",
                element=element.kind,
                place=element.place,
                fix="choose another one: the multiplier of a constraint is asked for by its name",
                code="E404",
            )
        for key, point in element.points():
            self._check_point(point, f"the point in '{key}' of {element.title}", element.place)
        for key, frame in element.frames():
            self._check_frame(frame, f"the frame in '{key}' of {element.title}", element.place)
        for key, entry in element.entries.items():
            value: Any = getattr(element, key)
            if entry.kind is FieldKind.COORDINATE:
                known = (*self.coordinates, *self._velocities.values())
                check_acted_on(element, value, known, self._quaternions)
            elif entry.kind in (FieldKind.VECTOR, FieldKind.EXPRESSION_OR_VECTOR) and is_listed(value):
                self._fit(len(value), f"the {key} of {element.title}", element.place)
        for use in element.uses():
            self._check_known(use.expr, f"the {use.what} of {element.title}", element.place, use.local)
            inputs = {i.symbol: i.name for i in self._inputs.values()}
            velocities = {v.symbol: v.name for v in self._velocities.values()}
            check_use(element, use, self._written_out(use.expr), inputs, velocities)
            if element.ledger == "λ" and use.level == Level.POSITION:
                self._check_position(use.expr, f"the {use.what} of {element.title}", element.place)
        if isinstance(element, Body):
            check_body(self._numbers, element)
        self._elements.append(element)
        self._element_names[element.name] = element
        return element

    def _element_name(self, element: Element) -> str:
        if not is_text(element.name) or element.name:
            if not is_text(element.name) or len(element.name) > 200 or not element.name.isprintable():
                raise ModelError(
                    f"the name of a {element.kind} must be printable text of at most 200 characters",
                    place=element.place,
                    code="E702",
                )
            if element.name in self._element_names:
                before = self._element_names[element.name]
                line = f" (line {before.place.line})" if before.place is not None and before.place.line else ""
                raise ModelError(
                    f"the name '{element.name}' is taken by a {before.kind}{line}",
                    element=element.kind,
                    place=element.place,
                    fix="give every element a name of its own",
                    code="E404",
                )
            return element.name
        base = element.suggested_name()
        if not base:
            base, number = element.kind.replace("_", " "), 1
        elif base not in self._element_names:
            return base
        else:
            number = 2
        while f"{base} {number}" in self._element_names:
            number += 1
        return f"{base} {number}"

    def exchange(self, elements: Iterable[Element]) -> None:
        """Put other elements in the places of those that were added."""
        self._frozen = None
        self._elements = list(elements)
        self._element_names = {e.name: e for e in self._elements}

    def is_free(self, name: str) -> bool:
        """Whether no symbol has this name."""
        return not any(name in table for table in self._symbol_tables)

    @property
    def elements(self) -> tuple[Element, ...]:
        """The elements added so far, in order."""
        return tuple(self._elements)

    def lookup(self, name: str) -> Any:
        """Return the symbol with that name, or else the point, frame or element."""
        if not is_text(name):
            raise ModelError(f"system[…] takes a name (got {type(name).__name__})", fix='system["theta"]', code="E402")
        if (found := self.find(name)) is None:
            known = [known for table in self._tables for known in table]
            raise NoSuchEntry.among("nothing is named", name, known)
        return found

    def find(self, name: object) -> Any:
        """Return the symbol with that name, or else the point, frame or element, or None."""
        found = next((table[name] for table in self._tables if name in table), None)
        return getattr(found, "symbol", found)

    def named(self) -> Iterator[Any]:
        """Every symbol, point, frame and element that has a name."""
        return (getattr(thing, "symbol", thing) for table in self._tables for thing in table.values())

    @property
    def _tables(self) -> tuple[Mapping[Any, Any], ...]:
        """Everything that has a name, by name."""
        return (*self._symbol_tables, self._points, self._frames, self._element_names)

    @property
    def _symbol_tables(self) -> tuple[Mapping[str, Any], ...]:
        """The declared symbols by name."""
        return (self._coordinates, self._velocities, self._parameters, self._inputs, self._definitions)

    def summary(self) -> str:
        """The numbers of parts of each kind, in words."""
        counts = {
            "coordinate": len(self._coordinates),
            "parameter": len(self._parameters),
            "input": len(self._inputs),
            "element": len(self._elements),
        }
        return ", ".join(f"{n} {what}{'s' if n != 1 else ''}" for what, n in counts.items())

    # -- the whole ----------------------------------------------------------------------------------------------

    def model(self) -> Model:
        """Freeze the description; raise an error if it has no coordinates or nothing with mass."""
        if self._frozen is not None:
            return self._frozen
        if not self._coordinates:
            raise ModelError(
                f"system '{self.name}' has no coordinates",
                fix='declare the generalized coordinates first: coordinates("theta1 theta2")',
                code="E201",
            )
        check_inertia(self.name, self._elements)
        made = Model(
            name=self.name,
            dimension=self.dimension,
            origin=self.origin,
            coordinates=tuple(self._coordinates.values()),
            parameters=tuple(self._parameters.values()),
            inputs=tuple(self._inputs.values()),
            definitions=tuple(self._definitions.values()),
            points=tuple(p for p in self._points.values() if not p.is_origin),
            frames=tuple(self._frames.values()),
            elements=tuple(self._elements),
            settings=dict(self.settings),
            look=dict(self.look),
            remarks=tuple(self.remarks),
            decimals=frozenset(self.decimals),
        )
        made = with_pressing_rows(made)
        check_effect(made)
        check_coils(made)
        check_rows(made)
        self._frozen = made
        return made
