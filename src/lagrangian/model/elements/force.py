"""A force: a vector at a point, with or without reaction, or a scalar along a deflection."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, ClassVar, Literal

import sympy as sp

from lagrangian import bounded
from lagrangian.model.elements.answers import ENERGY, FORCE, REQUIRED, ActsOn, Entry, FieldKind, Measure, deflected
from lagrangian.model.elements.base import (
    DEFLECTION,
    XI,
    Action,
    Element,
    Level,
    Surroundings,
    Use,
    check_ends,
    deflection_between,
    difference,
    pair_ends,
)
from lagrangian.model.elements.vectors import entries_of, main_symbol
from lagrangian.model.geometry import Frame, Point, as_expr, as_vector, is_listed
from lagrangian.model.names import time
from lagrangian.records import dataclass


@dataclass(frozen=True, eq=False, kw_only=True)
class Force(Element):
    """A force [N]: Ξ_i = Σ F·∂r/∂ξ_i.

    A vector acts ``at`` a point; it is given in the fixed axes or in those of ``axes``, and the opposite force acts on
    the point ``reaction``. A scalar acts along a deflection, of two points (``between``) or an expression
    (``deflection``); a positive value pushes the ends apart.
    """

    value: Any
    at: Any = None
    reaction: Any = None
    axes: Any = None
    between: Any = None
    deflection: Any = None

    kind: ClassVar[str] = "force"
    plural = "Forces."
    about = "A force: a vector at a point, or a scalar along a deflection."
    entries: ClassVar[Mapping[str, Entry]] = {
        "value": Entry(
            FieldKind.EXPRESSION_OR_VECTOR, "A vector [Fx, Fy] at a point, or one value along a deflection.", REQUIRED
        ),
        "at": Entry(FieldKind.POINT, "The point a vector acts at."),
        "reaction": Entry(FieldKind.POINT, "The point that feels its opposite."),
        "axes": Entry(FieldKind.FRAME, "The frame whose axes the vector is given in."),
        "between": Entry(FieldKind.TWO_POINTS, "Two points; a positive value pushes them apart."),
        "deflection": Entry(FieldKind.EXPRESSION, "A deflection, instead of two points."),
    }
    ledger: ClassVar[Literal["T*", "V", "Ξ"]] = "Ξ"
    because = ("it acts from outside and may do work: no potential, so it is in ", XI)
    resists = False

    def __post_init__(self) -> None:
        what = f"the value of {self.title}"
        if self.at is None:
            self._scalar(what)
            return
        if self.between is not None or self.deflection is not None:
            raise self._error(
                "a force acts either at a point or along a deflection (got both)",
                fix="give a vector with at=P, or a scalar with between=(P, Q) or deflection=expression",
                code="E412",
            )
        if not is_listed(self.value):
            raise self._error(
                "a force at a point is a vector (got one value)",
                fix="write force((Fx, Fy), at=P); a scalar needs between=(P, Q) or deflection=expression",
                code="E412",
            )
        for key in ("at", "reaction"):
            point = getattr(self, key)
            if point is not None and not isinstance(point, Point):
                raise self._error(f"its {key} must be a point", fix=f"{key}=P", code="E412")
        if self.reaction is self.at:
            raise self._error(
                "it acts and reacts on the same point, so it does nothing",
                fix="leave reaction out, or name another point",
                code="E410",
            )
        if self.axes is not None and not isinstance(self.axes, Frame):
            raise self._error("its axes must be a frame", fix="axes=F", code="E412")
        self._set(value=as_vector(self.value, what, place=self.place))

    def _scalar(self, what: str) -> None:
        if is_listed(self.value):
            raise self._error(
                "a vector force needs the point it acts at", fix="write force((Fx, Fy), at=P)", code="E412"
            )
        if self.between is None and self.deflection is None:
            raise self._error(
                "it acts on nothing",
                fix="name a point with at=P, two points with between=(P, Q), or deflection=expression",
                code="E412",
            )
        if self.reaction is not None or self.axes is not None:
            key = "reaction" if self.reaction is not None else "axes"
            raise self._error(
                f"a force along a deflection already acts on both ends; {key} does not fit",
                fix=f"leave {key} out",
                code="E412",
            )
        self._set(between=check_ends(self, self.between, self.deflection))
        self._set(value=as_expr(self.value, what, place=self.place))
        if self.deflection is not None:
            self._set(deflection=as_expr(self.deflection, f"the deflection of {self.title}", place=self.place))

    @property
    def is_vector(self) -> bool:
        """Whether it is a vector at a point."""
        return self.at is not None

    def suggested_name(self) -> str:
        """The symbol of its value."""
        heads = [v for v in entries_of(self.value) if v != 0]
        return main_symbol(heads[0]) if len(heads) == 1 else ""

    def uses(self) -> Iterator[Use]:
        """The value (of coordinates, rates, inputs, parameters, time); a deflection (of coordinates and time)."""
        for v in entries_of(self.value):
            yield Use("value", "value", v, Level.VELOCITY, inputs=True)
        if self.deflection is not None:
            yield Use("deflection", "deflection", self.deflection, Level.POSITION)

    def measures(self, model: Surroundings) -> Iterator[Measure]:
        """Components in N; along a deflection J/[δ]."""
        if self.is_vector:
            for component in self.value:
                yield Measure("value", component, FORCE)
        else:
            yield Measure("value", self.value, ENERGY, None if self.between else self.deflection, -1)

    def acts_on(self) -> ActsOn:
        """The points it acts and reacts at, its ends or its deflection."""
        if not self.is_vector:
            return deflected(self.between, self.deflection)
        return ActsOn(
            tuple(p for p in (self.at, self.reaction) if p is not None),
            "it does nothing: no coordinate moves the point it acts at",
            "at=the point that the force moves; to hold a fixed point takes no force in these equations",
        )

    def points(self) -> Iterator[tuple[str, Point]]:
        """Where it acts."""
        for key in ("at", "reaction"):
            if getattr(self, key) is not None:
                yield key, getattr(self, key)
        for point in self.between or ():
            yield "between", point

    def frames(self) -> Iterator[tuple[str, Frame]]:
        """Its axes, if given."""
        if self.axes is not None:
            yield "axes", self.axes

    def components(self, model: Surroundings) -> tuple[sp.Expr, ...]:
        """The vector in the fixed axes."""
        vector = self.value if self.axes is None else self.axes.in_fixed_axes(self.value)
        return tuple(model.expand(v) for v in vector)

    def works(self, model: Surroundings) -> tuple[Action, ...]:
        """Component by component at the point and its reaction; or one action on the deflection."""
        if self.is_vector:
            return self.ends(model)
        effort = model.expand(self.value)
        if self.between:
            delta = difference(model, *self.between)
            displacement = deflection_between(model, *self.between)
            rate = sp.Add(*(d * bounded.diff(d, time) for d in delta)) / displacement
        else:
            displacement = model.expand(self.deflection)
            rate = bounded.diff(displacement, time)
        return (Action(effort, rate, DEFLECTION, displacement),)

    def ends(self, model: Surroundings) -> tuple[Action, ...]:
        """The force on each end."""
        if self.between:
            return pair_ends(model, self.between[0], self.between[1], model.expand(self.value))
        if not self.is_vector:
            return self.works(model)
        actions: list[Action] = []
        for sign, point in ((1, self.at), (-1, self.reaction)):
            if point is None:
                continue
            for f, x in zip(self.components(model), model.position(point), strict=True):
                if f != 0:
                    x = model.expand(x)
                    actions.append(Action(sign * f, bounded.diff(x, time), model.point_words(point), x, point))
        return tuple(actions)
