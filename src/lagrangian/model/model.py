"""The frozen description of a mechanical system."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cached_property
from typing import Any, TypeVar

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.errors import Notice
from lagrangian.model.elements import Body, CircuitBranch, Element, Friction, Inductor, Words
from lagrangian.model.geometry import Frame, Point
from lagrangian.model.names import time
from lagrangian.model.spare import SpareRows
from lagrangian.model.symbols import Coordinate, Definition, Input, Parameter, Velocity
from lagrangian.records import dataclass, field
from lagrangian.viewed import Brief, cut

T = TypeVar("T")


def written_out(expr: sp.Expr, table: Mapping[Any, Any]) -> sp.Expr:
    """Return ``expr`` with symbols replaced by their expressions, and derivatives of these carried out.

    Raises `TooLarge`, before anything is expanded, if the result would be too long.
    """
    return bounded.written_out(expr, table) if table else expr


@dataclass(frozen=True, eq=False)
class Model(Brief):
    """A frozen description, complete and checked. It is made by `Builder.model`.

    ``points`` and ``frames`` are the named ones, in order; unnamed ones are reached from the elements. ``dimension`` is
    2 in the plane and 3 in space. ``settings`` contains the simulation settings of a file,
    and ``look`` its hints for the picture, both as plain data. ``spare`` says which rows of constraints follow from
    others along the motion, if that is known. ``remarks`` are notices of what the description was read from,
    ``decimals`` the numbers (without signs) that were written as decimals.
    """

    name: str
    dimension: int
    origin: Point
    coordinates: tuple[Coordinate, ...]
    parameters: tuple[Parameter, ...]
    inputs: tuple[Input, ...]
    definitions: tuple[Definition, ...]
    points: tuple[Point, ...]
    frames: tuple[Frame, ...]
    elements: tuple[Element, ...]
    settings: Mapping[str, Any] = field(default_factory=dict[str, Any], repr=False)
    look: Mapping[str, Any] = field(default_factory=dict[str, Any], repr=False)
    spare: tuple[SpareRows, ...] = ()
    remarks: tuple[Notice, ...] = ()
    decimals: frozenset[sp.Rational] = frozenset()
    _memo: dict[Any, Any] = field(default_factory=dict[Any, Any], repr=False)

    def __repr__(self) -> str:
        counts = ("coordinates", "parameters", "inputs", "elements")
        return cut(f"<Model {self.name!r}: {', '.join(f'{len(getattr(self, x))} {x}' for x in counts)}>")

    def __getstate__(self) -> dict[str, Any]:
        """What is pickled: the description alone, without what was made of it."""
        return {**self.__dict__, "_memo": {}}

    def sparing(self, spare: tuple[SpareRows, ...]) -> Model:
        """The same model, with what is known of rows that follow from others."""
        if spare == self.spare:
            return self
        return self.remembered(("sparing", spare), lambda: replace(self, spare=spare, _memo={}))

    def remembered(self, key: Any, make: Callable[[], T]) -> T:
        """Return what belongs to the model under a key; it is made at the first request."""
        if key not in self._memo:
            self._memo[key] = make()
        return self._memo[key]

    def recent(self, kind: str, key: Any, make: Callable[[], T], most: int) -> T:
        """The same, but of each kind only the ``most`` things that were used last are kept."""
        kept: dict[Any, T] = self._memo.setdefault(kind, {})
        found = kept.pop(key, None)  # one operation: other threads use it too
        if found is None:
            found = make()
        kept[key] = found  # the most recently used is last
        for oldest in list(kept)[:-most]:
            kept.pop(oldest, None)
        return found

    @property
    def bodies(self) -> tuple[Body, ...]:
        """Particles and rigid bodies, in order."""
        return self.remembered("bodies", lambda: tuple(e for e in self.elements if isinstance(e, Body)))

    @cached_property
    def constraints(self) -> tuple[Element, ...]:
        """The constraints, in order: joints that close loops, expressions, no slip."""
        return tuple(e for e in self.elements if e.ledger == "λ")

    @cached_property
    def frictions(self) -> tuple[Friction, ...]:
        """Dry friction, in order, of which it is not known whether it slips or sticks."""
        return tuple(e for e in self.elements if isinstance(e, Friction) and e.sense is None)

    @cached_property
    def branches(self) -> tuple[CircuitBranch, ...]:
        """The elements of circuits, in order."""
        return tuple(e for e in self.elements if isinstance(e, CircuitBranch))

    @cached_property
    def charges(self) -> tuple[Coordinate, ...]:
        """The coordinates that are charges: those that flow through an element of a circuit."""
        flowing = {x for e in self.branches for charge in e.charges for x in self.expand(charge).atoms(AppliedUndef)}
        return tuple(c for c in self.coordinates if c.symbol in flowing)

    @cached_property
    def saturating(self) -> tuple[Inductor, ...]:
        """The coils whose flux linkage is not proportional to their current, so that T is not T*, in order."""
        return tuple(e for e in self.elements if isinstance(e, Inductor) and not e.linear)

    def total_energy(self) -> sp.Expr:
        """T + V [J] of all elements as an expression; T is T* except for coils that saturate."""
        whole = [e.kinetic(self) + e.potential(self) for e in self.elements]
        return sp.Add(*whole, *(e.stored_energy(self) - e.kinetic(self) for e in self.saturating))

    @cached_property
    def floating(self) -> tuple[Frame, ...]:
        """The frames with a quaternion, which float or turn in a ball joint, in order."""
        return tuple(f for f in self.frames if f.floating is not None)

    @property
    def velocities(self) -> tuple[Velocity, ...]:
        """The velocities v in the order of the coordinates: their rates, and six quasi-velocities of each floating
        frame, three of each frame in a ball joint.
        """
        return self._velocities

    @cached_property
    def _velocities(self) -> tuple[Velocity, ...]:
        floats = {c.name: f.floating for f in self.floating if f.floating is not None for c in f.floating.coordinates}
        found: dict[str, Velocity] = {}
        for c in self.coordinates:
            floating = floats.get(c.name)
            own = (Velocity(f"{c.name}'", c.rate, place=c.place),) if floating is None else floating.velocities
            found.update((v.name, v) for v in own)
        return tuple(found.values())

    @cached_property
    def values(self) -> dict[sp.Symbol, float]:
        """The parameters that have a value, by symbol."""
        return {p.symbol: p.value for p in self.parameters if p.value is not None}

    @cached_property
    def symbols(self) -> dict[str, sp.Expr]:
        """Every name with its symbol: coordinates, quasi-velocities, parameters, inputs, definitions."""
        quasi = [v for f in self.floating if f.floating is not None for v in f.floating.velocities]
        named = (*self.coordinates, *quasi, *self.parameters, *self.inputs, *self.definitions)
        return {x.name: x.symbol for x in named}

    def expand(self, expr: sp.Expr, *, constants: bool = False) -> sp.Expr:
        """Return ``expr`` with moving definitions written out (constant ones too, if requested), and derivatives
        carried out."""

        def made() -> sp.Expr:
            table = {d.symbol: d.expression for d in self.definitions if d.moving or constants}
            return written_out(expr, table)

        return self.remembered(("expand", expr, constants), made)

    def position(self, point: Point) -> tuple[sp.Expr, ...]:
        """The components of a point's position in the fixed axes, ``dimension`` of them; definitions keep their
        names."""
        return point.position or (sp.S.Zero,) * self.dimension

    def velocity(self, point: Point) -> tuple[sp.Expr, ...]:
        """The components of a point's velocity in the fixed axes, written out in coordinates and rates."""
        return self.remembered(
            ("velocity", id(point)),
            lambda: tuple(bounded.diff(self.expand(x), time) for x in self.position(point)),
        )

    def point_words(self, point: Point) -> Words:
        """The point in words: the body at it, else its name, else the ground or its components."""
        if point.is_origin:
            return ("the ground",)
        for body in self.bodies:
            if body.at is point:
                return (body.title,)
        if point.name:
            return (f"point '{point.name}'",)
        position = [self.expand(x) for x in self.position(point)]
        if not any(x.has(AppliedUndef, time) for x in position):
            return ("the ground",)
        for body in self.bodies:
            if tuple(self.expand(x) for x in self.position(body.at)) == tuple(position):
                return (body.title,)
        listed: list[str | sp.Expr] = [part for x in position for part in (x, ", ")]
        return ("the point (", *listed[:-1], ")")

    def frame_words(self, frame: Frame) -> Words:
        """The frame in words: the body that turns with it, else its name."""
        for body in self.bodies:
            if body.axes is frame:
                return (body.title,)
        if frame.name:
            return (f"frame '{frame.name}'",)
        return ("the frame turned by ", self.expand(frame.total_angle if frame.dimension == 2 else frame.angle))

    def angle_words(self, angle: sp.Expr) -> Words:
        """An angle in words: the body in the plane whose orientation it is, else the angle itself."""
        for body in self.bodies:
            frame = body.axes
            if frame is not None and frame.dimension == 2:
                free = bounded.expand(self.expand(frame.total_angle) - angle)
                if not free.has(AppliedUndef, time):
                    return (body.title,)
        return ("what turns with ", angle)


def is_hard(model: Model, *_: object, **__: object) -> bool:
    """Whether SymPy may take long over what the elements are described by, see `bounded.hard`.

    Further arguments, those of a question about the model, make no difference.
    """
    return model.remembered("is_hard", lambda: bounded.hard(_described(model)))


def _described(model: Model) -> list[sp.Basic]:
    """The expressions of the elements, the definitions, and the points and frames in use, each point and frame once."""
    points = {id(p): p for e in model.elements for _, p in e.points()}
    frames = {id(f): f for e in model.elements for _, f in e.frames()}
    found: list[Any] = [use.expr for e in model.elements for use in e.uses()]
    found += [d.expression for d in model.definitions]
    found += [x for p in points.values() for x in model.position(p)]
    found += [x for f in frames.values() for x in (*(f.axis or ()), f.angle)]
    return [sp.sympify(x) for x in found]
