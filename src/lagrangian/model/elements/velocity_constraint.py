"""Constraints on velocities: an expression linear in the rates, and a body that does not slip."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, ClassVar

from lagrangian.model.elements.answers import ANGLE, REQUIRED, ActsOn, Entry, FieldKind, Measure
from lagrangian.model.elements.base import Condition, Level, Surroundings, Use
from lagrangian.model.elements.conditions import NoSlip, Stated
from lagrangian.model.elements.constraint import Restriction
from lagrangian.model.elements.rigid_body import RigidBody
from lagrangian.model.geometry import Frame, Point, as_expr, is_listed
from lagrangian.records import dataclass


@dataclass(frozen=True, eq=False, kw_only=True)
class Slipless(Restriction):
    """The base of constraints in which a body's material at a point has no velocity along some directions."""

    at: Any = None
    body: Any = None
    along: Any = None
    axes: Any = None

    def _check_contact(self) -> None:
        """Raise an error if the body, the point or the directions are missing or wrong."""
        if not isinstance(self.at, Point):
            raise self._error("at must be a point", fix="at=P, the point of contact", code="E412")
        if not isinstance(self.body, RigidBody):
            raise self._error(
                "body must be a rigid body of this system",
                fix="body=the element that rigid_body(…) returned; for a particle write the expression",
                code="E412",
            )
        self._frame(self.axes, "axes")
        given = self.along
        several = is_listed(given) and len(given) > 0 and is_listed(given[0])
        directions = tuple(self._direction(d, "along") for d in (given if several else (given,)))
        if any(len(d) != self.body.frame.dimension for d in directions):
            raise self._error(
                f"a direction of {self.body.title} needs {self.body.frame.dimension} components",
                fix="components such as 1, 0 in the plane and 1, 0, 0 in space, or a list of such directions",
                code="E414",
            )
        if len(directions) > 3:
            raise self._error("more than three directions", fix="a point has three at most", code="E414")
        self._set(along=directions)

    def uses(self) -> Iterator[Use]:
        """Directions may turn with coordinates and time."""
        for direction in self.along or ():
            for x in direction:
                yield Use("along", "direction", x, Level.POSITION)

    def acts_on(self) -> ActsOn | None:
        """The body."""
        return ActsOn(
            (self.body.at, self.body.frame),
            "it restricts nothing: no coordinate moves the body",
            "body=a rigid body that a coordinate moves",
        )

    def points(self) -> Iterator[tuple[str, Point]]:
        """The point of contact, and the body's own."""
        if self.at is not None:
            yield "at", self.at
            yield "body", self.body.at

    def frames(self) -> Iterator[tuple[str, Frame]]:
        """The frame in which the directions are given, and the body's own."""
        if self.axes is not None:
            yield "axes", self.axes
        if self.body is not None:
            yield "body", self.body.frame

    def conditions(self, model: Surroundings) -> tuple[Condition, ...]:
        """One row for each direction."""
        several = len(self.along) > 1
        return tuple(
            NoSlip(
                at=self.at,
                centre=self.body.at,
                frame=self.body.frame,
                along=direction,
                axes=self.axes,
                suffix=str(i) if several else "",
            )
            for i, direction in enumerate(self.along, 1)
        )


_CONTACT: Mapping[str, Entry] = {
    "at": Entry(FieldKind.POINT, "The point of contact; the body's matter there has no velocity."),
    "body": Entry(FieldKind.BODY, "The rigid body, by its name."),
    "along": Entry(FieldKind.DIRECTIONS, "A direction, or a list of directions."),
    "axes": Entry(FieldKind.FRAME, "The frame whose axes the directions are given in; the fixed axes if left out."),
}


@dataclass(frozen=True, eq=False, kw_only=True)
class VelocityConstraint(Slipless):
    """A constraint on velocities, c(q, q̇, t) = 0, linear in the rates.

    An ``expression``, such as ``y'*cos(theta) - x'*sin(theta)``; or the material of a ``body`` at the point ``at`` has
    no velocity ``along`` one or several directions: c = e · (v_C + ω × (r_at − r_C)), and λ is the force on the body
    along e.
    """

    expression: Any = None

    kind: ClassVar[str] = "velocity_constraint"
    plural = "Constraints on velocities."
    about = "A constraint on velocities: an expression linear in the rates that is zero, or a body that does not slip."
    entries: ClassVar[Mapping[str, Entry]] = {
        **_CONTACT,
        "expression": Entry(FieldKind.EXPRESSION, "An expression linear in the rates that is zero."),
    }

    def __post_init__(self) -> None:
        contact = [key for key in ("at", "body", "along") if getattr(self, key) is not None]
        if (self.expression is None) == (not contact) or (contact and len(contact) < 3):
            raise self._error(
                "give either an expression, or at, body and along"
                + (f" (got {', '.join(contact)})" if contact else " (got neither)"),
                fix="an expression that is zero, such as x' - r*phi'; or 'body', 'at' and 'along'",
                code="E412",
            )
        if self.expression is None:
            self._check_contact()
        elif self.axes is not None:
            raise self._error("axes are for directions", fix="leave axes out", code="E412")
        else:
            self._set(expression=as_expr(self.expression, f"the expression of {self.title}", place=self.place))

    def uses(self) -> Iterator[Use]:
        """Positions, rates and time."""
        if self.expression is not None:
            yield Use("expression", "expression", self.expression, Level.VELOCITY)
        yield from super().uses()

    def measures(self, model: Surroundings) -> Iterator[Measure]:
        """The terms of an expression have one unit."""
        if self.expression is not None:
            yield Measure("expression", self.expression, ANGLE, self.expression, 1)

    def acts_on(self) -> ActsOn | None:
        """The body; for an expression, nothing, because its rates show what it acts on."""
        return super().acts_on() if self.expression is None else None

    def conditions(self, model: Surroundings) -> tuple[Condition, ...]:
        """One row, or one for each direction."""
        return (
            (Stated(value=self.expression, velocity=True),)
            if self.expression is not None
            else super().conditions(model)
        )


@dataclass(frozen=True, eq=False, kw_only=True)
class Rolling(Slipless):
    """A rigid body that rolls: its material at the point of contact has no velocity along the given directions."""

    kind: ClassVar[str] = "rolling"
    plural = "Bodies that roll without slip."
    about = "A body that rolls: its matter at the point of contact has no velocity along the given directions."
    entries: ClassVar[Mapping[str, Entry]] = {
        key: Entry(e.kind, e.about, e.default if key == "axes" else REQUIRED) for key, e in _CONTACT.items()
    }

    def __post_init__(self) -> None:
        self._check_contact()
