"""The base class of elements, and what an element states about its expressions and its actions."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from copy import copy
from enum import IntEnum
from typing import Any, ClassVar, Literal, Protocol, Self, TypeAlias

import sympy as sp

from lagrangian import bounded
from lagrangian.codes import CodeText
from lagrangian.errors import ModelError, Place
from lagrangian.model.elements.answers import ActsOn, Entry, Measure, MovingMass, Rows, Unit
from lagrangian.model.elements.vectors import diagonal, norm
from lagrangian.model.geometry import Frame, Point, is_listed
from lagrangian.model.names import time, titled
from lagrangian.model.symbols import Coordinate, Velocity
from lagrangian.page.formula import Name
from lagrangian.records import dataclass, field
from lagrangian.viewed import Brief

Words: TypeAlias = "tuple[str | sp.Expr, ...]"
"""Words with symbols in them."""

DEFLECTION: Words = ("its deflection",)
"""The target of an action whose ends are not known separately."""


class Surroundings(Protocol):
    """What an element needs from its model."""

    @property
    def dimension(self) -> int:
        """2 in the plane, 3 in space."""
        ...

    @property
    def coordinates(self) -> tuple[Coordinate, ...]:
        """The generalized coordinates."""
        ...

    @property
    def velocities(self) -> tuple[Velocity, ...]:
        """The velocities: rates of coordinates, and quasi-velocities."""
        ...

    @property
    def bodies(self) -> tuple[Body, ...]:
        """Particles and rigid bodies."""
        ...

    def expand(self, expr: sp.Expr) -> sp.Expr:
        """An expression with moving definitions written out."""
        ...

    def position(self, point: Point) -> tuple[sp.Expr, ...]:
        """The components of a position in the fixed axes."""
        ...

    def velocity(self, point: Point) -> tuple[sp.Expr, ...]:
        """The components of a velocity in the fixed axes, written out."""
        ...

    def point_words(self, point: Point) -> Words:
        """A point in words."""
        ...

    def frame_words(self, frame: Frame) -> Words:
        """A frame in words."""
        ...

    def angle_words(self, angle: sp.Expr) -> Words:
        """An angle in words."""
        ...


class Level(IntEnum):
    """What an expression may depend on: only parameters, also positions and time, or also rates."""

    CONSTANT = 0
    POSITION = 1
    VELOCITY = 2


@dataclass(frozen=True)
class Use:
    """An expression of an element: its description, what it may depend on, and whether it may contain inputs.

    ``key`` is the field from which it comes; ``local`` are symbols that have a meaning only in this expression.
    """

    key: str
    what: str
    expr: sp.Expr
    level: Level
    inputs: bool = False
    local: tuple[sp.Symbol, ...] = ()


@dataclass(frozen=True)
class Action:
    """An effort on something that moves: its power is ``effort · rate``, and Ξ_i = effort · ∂rate/∂ξ̇_i.

    ``effort`` is a force [N] or torque [N m]. ``rate`` is the velocity [m/s] or angular velocity [rad/s] of what it
    acts on, in the direction of the effort, and linear in the rates ξ̇. ``displacement`` is the scalar whose variation
    is the virtual displacement, if there is one. ``on`` describes what it acts on; ``target`` is that point or frame.
    """

    effort: sp.Expr
    rate: sp.Expr
    on: Words
    displacement: sp.Expr | None = None
    target: Point | Frame | None = None


@dataclass(frozen=True, kw_only=True)
class Condition:
    """One row of a constraint: f(q, t) = 0, or c(q, q̇, t) = 0 where no position says it.

    ``suffix`` is added to the constraint's name; ``unit`` is that of its multiplier, None where the expression decides.
    """

    suffix: str = ""
    unit: Unit | None = None

    @property
    def on_positions(self) -> bool:
        """Whether a position says it; else it restricts velocities alone."""
        return True

    def position(self, model: Surroundings) -> sp.Expr | None:
        """f, zero where the constraint holds; None for a row on velocities alone."""
        raise NotImplementedError

    def rate(self, model: Surroundings) -> sp.Expr:
        """c, linear in the rates and zero where the constraint holds: ḟ of a row on positions."""
        f = self.position(model)
        assert f is not None
        return bounded.diff(f, time)

    def multiplier(self, model: Surroundings) -> Words:
        """The meaning of λ, in words."""
        raise NotImplementedError


Ledger: TypeAlias = Literal["T*", "V", "Ξ", "λ"]
"""Where an element is counted: as an energy, as a nonconservative force or, for a constraint, with its multiplier."""

T, V, XI = Name("T*"), Name("V"), Name("Xi")

QUESTIONS = ("kind", "plural", "about", "entries", "ledger", "because", "uses", "measures")
"""What every kind of element must define."""

QUESTIONS_OF = {
    "T*": ("kinetic", "masses", "note"),
    "V": ("potential", "stored", "note", "acts_on"),
    "Ξ": ("works", "resists", "acts_on"),
    "λ": ("conditions", "acts_on"),
}
"""What it must define in addition, depending on where it is counted."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Element(Brief):
    """A part of the system. ``name`` is unique in its system; ``place`` is its place in a file.

    A subclass with a ``kind`` must answer `QUESTIONS` and the `QUESTIONS_OF` its ledger, otherwise importing it raises
    an error. ``plural``, ``about`` and ``entries`` describe its table in a file.
    """

    name: str = ""
    place: Place | None = field(default=None, repr=False)

    kind: ClassVar[str] = "element"
    plural: ClassVar[str]
    about: ClassVar[str]
    entries: ClassVar[Mapping[str, Entry]]
    ledger: ClassVar[Ledger]
    because: ClassVar[tuple[str | Name, ...]]
    """The reason why it is counted there, in words."""
    stored: ClassVar[str] = ""
    """How it stores potential energy, in words."""
    note: ClassVar[str] = ""
    """The note beside its energy if the page gives it without a derivation."""
    resists: ClassVar[bool] = False
    """Whether it takes energy out, so that the final equations have it on the left."""

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        if "kind" not in vars(cls):
            return
        asked = (*QUESTIONS, *QUESTIONS_OF.get(getattr(cls, "ledger", ""), ()))
        own = {name for base in cls.__mro__[: cls.__mro__.index(Element)] for name in vars(base)}
        if missing := [question for question in asked if question not in own]:
            raise TypeError(f"the kind of element {cls.__name__} does not answer: {', '.join(missing)}")

    @property
    def title(self) -> str:
        """The element in words, such as ``spring 'k'``; one that was numbered is ``spring 2``."""
        return titled(self.kind.replace("_", " "), self.name)

    def named(self, name: str) -> Self:
        """Return the same element with another name."""
        other = copy(self)
        other._set(name=name)
        return other

    def suggested_name(self) -> str:
        """A name for an element without one: its main symbol, or an empty text."""
        return ""

    def uses(self) -> Iterator[Use]:
        """All expressions in the element, with what each may depend on."""
        raise NotImplementedError

    def measures(self, model: Surroundings) -> Iterator[Measure]:
        """The units that its expressions must have, except those of points and frames."""
        raise NotImplementedError

    def acts_on(self) -> ActsOn | None:
        """What it acts on; None if that is everything or no particular place."""
        return None

    def points(self) -> Iterator[tuple[str, Point]]:
        """All points to which the element refers, with the fields from which they come."""
        return iter(())

    def frames(self) -> Iterator[tuple[str, Frame]]:
        """All frames to which the element refers, with the fields from which they come."""
        return iter(())

    def kinetic(self, model: Surroundings) -> sp.Expr:
        """Its contribution to the kinetic co-energy T* [J]; zero unless the element has moving mass."""
        return sp.S.Zero

    def potential(self, model: Surroundings) -> sp.Expr:
        """Its contribution to the potential energy V [J]; zero unless it stores energy that depends on position."""
        return sp.S.Zero

    def masses(self, model: Surroundings) -> Iterator[MovingMass]:
        """What resists motion in it; nothing unless it moves with mass."""
        return iter(())

    def portions(self, model: Surroundings) -> Iterator[tuple[Body | None, sp.Expr]]:
        """Its energy [J] in the pieces that a page shows, each with the other body that it belongs to, if any."""
        yield None, self.kinetic(model) if self.ledger == "T*" else self.potential(model)

    def works(self, model: Surroundings) -> tuple[Action, ...]:
        """Its actions for virtual work, in the fewest terms (a pair of forces is one action on its deflection)."""
        return ()

    def ends(self, model: Surroundings) -> tuple[Action, ...]:
        """The same actions, end by end, as the box rule counts them; a pair is two actions on two bodies."""
        return self.works(model)

    def conditions(self, model: Surroundings) -> tuple[Condition, ...]:
        """The rows that a constraint consists of; none unless the element is a constraint."""
        return ()

    def dissipation(self, model: Surroundings) -> sp.Expr | None:
        """Rayleigh's function D [W], with Ξ_i = −∂D/∂ξ̇_i, or None if the element has none."""
        return None

    def _error(self, what: str, *, fix: str | None = None, code: CodeText | None = None) -> ModelError:
        return error_of(self, what, fix=fix, code=code)

    def _set(self, **values: object) -> None:
        """Set normalized fields while the frozen object is being made."""
        for key, value in values.items():
            object.__setattr__(self, key, value)


@dataclass(frozen=True, eq=False, kw_only=True)
class Body(Element):
    """The family of what has a ``mass`` [kg] at a point ``at``, its centre of mass, which gravity pulls."""

    mass: Any
    at: Any

    ledger: ClassVar[Literal["T*", "V", "Ξ"]] = "T*"
    because = ("it has mass and moves: its energy of motion is in ", T)
    note = ""

    @property
    def axes(self) -> Frame | None:
        """The frame that turns with it; None where it has no inertia."""
        return None

    @property
    def tensor(self) -> Rows:
        """The inertia [kg m²] about its centre of mass in its axes: 1×1 in the plane, 3×3 in space, else 0×0."""
        return ()

    def angular_velocity(self, model: Surroundings) -> tuple[sp.Expr, ...]:
        """``(ω,)`` in the plane, three components in its axes in space, none where it has no inertia."""
        return ()

    def points(self) -> Iterator[tuple[str, Point]]:
        """Its centre of mass."""
        yield "at", self.at

    def masses(self, model: Surroundings) -> Iterator[MovingMass]:
        """Its mass, with the velocity of its centre of mass."""
        yield MovingMass(model.velocity(self.at), diagonal((self.mass,) * model.dimension))


def error_of(element: Element, what: str, *, fix: str | None = None, code: CodeText | None = None) -> ModelError:
    """An error that names the element and where it is described."""
    return ModelError(what, element=element.title, place=element.place, fix=fix, code=code)


def difference(model: Surroundings, start: Point, end: Point) -> tuple[sp.Expr, ...]:
    """The components of r_end − r_start in the fixed axes, with positions written out in the coordinates.

    Parents common to both points cancel before anything is expanded.
    """
    shared = {id(p) for p in start.with_parents()}
    common = next(p for p in end.with_parents() if id(p) in shared)
    a, b = _from(common, start, model.dimension), _from(common, end, model.dimension)
    return tuple(model.expand(y - x) for x, y in zip(a, b, strict=True))


def _from(base: Point, point: Point, dimension: int) -> list[sp.Expr]:
    total: list[sp.Expr] = [sp.S.Zero] * dimension
    at = point
    while at is not base:
        step = at.offset if at.frame is None else at.frame.in_fixed_axes(at.offset)
        total = [x + y for x, y in zip(total, step, strict=True)]
        assert at.parent is not None
        at = at.parent
    return total


def deflection_between(model: Surroundings, start: Point, end: Point) -> sp.Expr:
    """The distance |r_end − r_start| = √(Δx² + Δy² + Δz²) [m]."""
    return norm(difference(model, start, end))


def pair_ends(model: Surroundings, start: Point, end: Point, effort: sp.Expr) -> tuple[Action, Action]:
    """A pair of forces that pushes ``start`` and ``end`` apart, end by end: +F e on the end, −F e on the start.

    e = (r_end − r_start)/|r_end − r_start|; the rate of an end is its velocity along e.
    """
    delta = difference(model, start, end)
    length = norm(delta)

    def along(point: Point) -> sp.Expr:
        velocity = [bounded.diff(model.expand(x), time) for x in model.position(point)]
        return sp.Add(*(d * v for d, v in zip(delta, velocity, strict=True))) / length

    return (
        Action(effort, along(end), model.point_words(end), target=end),
        Action(-effort, along(start), model.point_words(start), target=start),
    )


def called(element: Element, key: str, law: Callable[[sp.Symbol], object], argument: sp.Symbol) -> object:
    """The result of a law given as a function; an error in the function is reported as one of ours."""
    try:
        return law(argument)
    except Exception as cause:
        raise error_of(
            element,
            f"the function given as {key} cannot take a symbol ({type(cause).__name__}: {cause})",
            fix=f"{key}=lambda {argument}: an expression in {argument}, made of SymPy functions",
            code="E406",
        ) from cause


def check_ends(element: Element, between: object, deflection: object) -> tuple[Point, Point] | None:
    """Return the two points of ``between``, or None for a deflection; exactly one of both must be given."""
    if (between is None) == (deflection is None):
        found = "both" if between is not None else "neither"
        raise error_of(
            element,
            f"give either two points or a deflection (got {found})",
            fix="write between=(P, Q) for the distance of two points, or deflection=expression in the coordinates",
            code="E412",
        )
    if between is None:
        return None
    start, end = between if is_listed(between) and len(between) == 2 else (None, None)
    if not isinstance(start, Point) or not isinstance(end, Point):
        raise error_of(
            element, "between must be two points", fix="write between=(P, Q) with points of this system", code="E412"
        )
    if start is end:
        raise error_of(
            element,
            "both ends are the same point, so it has no length and no direction",
            fix="name two different points in between",
            code="E410",
        )
    return start, end
