"""Constraints on positions: points that coincide, a distance, an expression; and the base of all constraints."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import pairwise
from typing import Any, ClassVar

import sympy as sp

from lagrangian.model.elements.answers import ANGLE, LENGTH, ActsOn, Entry, FieldKind, Measure
from lagrangian.model.elements.base import Condition, Element, Ledger, Level, Surroundings, Use
from lagrangian.model.elements.conditions import LETTERS, Coincidence, Separation, Stated
from lagrangian.model.elements.rigid_body import RigidBody
from lagrangian.model.geometry import Frame, Point, as_expr, as_vector, is_listed
from lagrangian.records import dataclass


@dataclass(frozen=True, eq=False, kw_only=True)
class Restriction(Element):
    """A restriction of the motion: rows f(q, t) = 0 or c(q, q̇, t) = 0, each with a multiplier λ.

    M v̇ + h = Ξ + Aᵀ λ: a positive λ acts in the direction that increases f (or c).
    """

    ledger: ClassVar[Ledger] = "λ"
    because = ("its force does no work on a motion that it allows: it enters with a multiplier",)

    def uses(self) -> Iterator[Use]:
        """No expressions of its own."""
        return iter(())

    def measures(self, model: Surroundings) -> Iterator[Measure]:
        """Nothing to check: points and frames have their units already."""
        return iter(())

    def _pair(self, between: object) -> tuple[Point, Point]:
        """Two different points, or an error."""
        pair = self._points(between, "between")
        if len(pair) != 2:
            raise self._error(f"between must be two points (got {len(pair)})", fix="between=(P, Q)", code="E412")
        return pair[0], pair[1]

    def _points(self, given: object, what: str) -> tuple[Point, ...]:
        points = [p for p in given if isinstance(p, Point)] if is_listed(given) else []
        if not is_listed(given) or len(points) != len(given):
            raise self._error(
                f"{what} must be points of this system", fix=f"write {what}=(P, Q) with two points", code="E412"
            )
        if len(points) < 2 or any(a is b for a, b in pairwise(points)):
            raise self._error(
                f"{what} names the same point twice in a row, so there is nothing to restrict"
                if len(points) > 1
                else f"{what} needs two points",
                fix="name two different points",
                code="E410",
            )
        return tuple(points)

    def _frame(self, given: object, key: str) -> None:
        if given is not None and not isinstance(given, Frame):
            raise self._error(f"{key} must be a frame", fix=f"{key}=F with a frame of this system", code="E412")

    def _bodies(self, given: object) -> tuple[Frame, Frame | None]:
        """The frames of one or two bodies, given as frames or rigid bodies; a single body is joined to the ground."""
        listed = given if is_listed(given) else (given,)
        frames = [f for x in listed if isinstance(f := x.frame if isinstance(x, RigidBody) else x, Frame)]
        if not 1 <= len(frames) <= 2 or len(frames) != len(listed):
            raise self._error(
                "bodies must be one rigid body or frame, or two",
                fix="bodies=(A, B) for two bodies, bodies=A for a body on the ground",
                code="E412",
            )
        if len(frames) == 2 and frames[0] is frames[1]:
            raise self._error("both bodies turn with one frame", fix="name two bodies that turn", code="E410")
        return frames[0], frames[1] if len(frames) == 2 else None

    def _direction(self, given: object, key: str) -> tuple[sp.Expr, ...]:
        """A direction that is not zero."""
        found = as_vector(given, f"{key} of {self.title}", place=self.place)
        if not any(found):
            raise self._error(
                f"{key} is zero, so it is no direction", fix="components that are not all 0, such as 1, 0", code="E409"
            )
        return found


def dimension_of(*things: Point | Frame | None) -> int:
    """2 in the plane, 3 in space, from the first point or frame that has a dimension."""
    return next((t.dimension for t in things if t is not None and t.dimension is not None), 2)


def body_axes(*points: Point) -> Frame | None:
    """In space, the frame that carries the first of some points: its own, or that of a point that it is relative to."""
    for point in points:
        at: Point | None = point
        while at is not None:
            if at.frame is not None:
                return at.frame
            at = at.parent
    return None


def together(pair: tuple[Point, Point], axes: Frame | None) -> tuple[Condition, ...]:
    """The rows that keep two points together: two in the plane, three in space, along the axes of a body."""
    start, end = pair
    n = dimension_of(start, end)
    frame = axes if axes is not None or n == 2 else body_axes(start, end)
    return tuple(Coincidence(start=start, end=end, axis=i, frame=frame, suffix=LETTERS[i]) for i in range(n))


@dataclass(frozen=True, eq=False, kw_only=True)
class Constraint(Restriction):
    """A constraint on positions, f(q, t) = 0.

    Two points P, Q that coincide (``between``): f = r_P − r_Q, λ is the force on P's body at P. With ``distance`` ℓ:
    f = |r_P − r_Q| − ℓ, λ pushes the ends apart. An ``expression`` of coordinates, parameters and t: f itself. In space
    the rows of two points are components along the axes of P's body, or of ``axes``.
    """

    expression: Any = None
    between: Any = None
    distance: Any = None
    axes: Any = None

    kind: ClassVar[str] = "constraint"
    plural = "Constraints on positions."
    about = "A constraint on positions: two points that coincide, their distance, or an expression that is zero."
    entries: ClassVar[Mapping[str, Entry]] = {
        "expression": Entry(FieldKind.EXPRESSION, "An expression of coordinates, parameters and t that is zero."),
        "between": Entry(FieldKind.TWO_POINTS, "Two points that coincide, or whose distance is given."),
        "distance": Entry(FieldKind.EXPRESSION, "The distance of the two points."),
        "axes": Entry(FieldKind.FRAME, "The frame whose axes the rows of two points stand in."),
    }

    def __post_init__(self) -> None:
        if (self.expression is None) == (self.between is None):
            raise self._error(
                "give either two points or an expression"
                + (" (got both)" if self.between is not None else " (got neither)"),
                fix="two points in between, with a distance if they do not coincide; or an expression that is zero",
                code="E412",
            )
        if self.expression is not None:
            if self.distance is not None or self.axes is not None:
                raise self._error(
                    "distance and axes are for two points", fix="write the expression so that it is zero", code="E412"
                )
            self._set(expression=as_expr(self.expression, f"the expression of {self.title}", place=self.place))
            return
        self._set(between=self._pair(self.between))
        self._frame(self.axes, "axes")
        if self.distance is not None:
            self._set(distance=as_expr(self.distance, f"the distance of {self.title}", place=self.place))
            if self.distance.is_nonpositive:
                raise self._error(
                    f"the distance is {self.distance}",
                    fix="a distance is above 0; leave it out for points that coincide",
                    code="E406",
                )

    def uses(self) -> Iterator[Use]:
        """Positions, parameters and time."""
        for key in ("expression", "distance"):
            if (value := getattr(self, key)) is not None:
                yield Use(key, key, value, Level.POSITION)

    def measures(self, model: Surroundings) -> Iterator[Measure]:
        """A distance is a length; the terms of an expression have one unit."""
        if self.distance is not None:
            yield Measure("distance", self.distance, LENGTH)
        if self.expression is not None:
            yield Measure("expression", self.expression, ANGLE, self.expression, 1)

    def acts_on(self) -> ActsOn:
        """The points or coordinates that it restricts."""
        if self.between:
            return ActsOn(
                (self.between,),
                "it restricts nothing: no coordinate moves its two points apart",
                "between=(P, Q) with at least one of them moved by a coordinate that does not carry the other along",
            )
        return ActsOn(
            (self.expression,),
            "it restricts nothing: no coordinate stands in it",
            "an expression in the coordinates that is zero, such as x - r*phi",
        )

    def points(self) -> Iterator[tuple[str, Point]]:
        """Its two points."""
        for point in self.between or ():
            yield "between", point

    def frames(self) -> Iterator[tuple[str, Frame]]:
        """The frame whose axes its rows refer to."""
        if self.axes is not None:
            yield "axes", self.axes

    def conditions(self, model: Surroundings) -> tuple[Condition, ...]:
        """One row, or one for each component."""
        if self.expression is not None:
            return (Stated(value=self.expression),)
        start, end = self.between
        if self.distance is not None:
            return (Separation(points=(start, end), length=self.distance),)
        return together((start, end), self.axes)
