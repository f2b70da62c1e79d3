"""Uniform gravity on every mass."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, ClassVar, Literal

import sympy as sp

from lagrangian import bounded
from lagrangian.model.elements.answers import ACCELERATION, REQUIRED, Entry, FieldKind, Measure
from lagrangian.model.elements.base import XI, Body, Element, Level, Surroundings, Use, V
from lagrangian.model.elements.vectors import norm
from lagrangian.model.geometry import Point, as_expr, as_vector
from lagrangian.records import dataclass


@dataclass(frozen=True, eq=False, kw_only=True)
class Gravity(Element):
    """Gravity g [m/s²] along a direction: V = Σ m g h with h = −n·(r − r_datum) and n the unit direction (down).

    ``datum`` is a fixed point where h = 0; by default the origin. Only the direction of the vector matters, not its
    length.
    """

    direction: Any
    g: Any
    datum: Any = None

    kind: ClassVar[str] = "gravity"
    plural = "Gravity."
    about = "Gravity: V = Σ m g h."
    entries: ClassVar[Mapping[str, Entry]] = {
        "direction": Entry(FieldKind.VECTOR, "Which way is down: [0, -1].", REQUIRED),
        "g": Entry(FieldKind.STRENGTH_OF_GRAVITY, "Its strength; the parameter g, 9.81 m/s², if left out."),
        "datum": Entry(FieldKind.POINT, "The point where h = 0; the origin if left out."),
    }
    ledger: ClassVar[Literal["T*", "V", "Ξ"]] = "V"
    because = ("weight depends on height alone: conservative, stored in ", V, ", so not in ", XI)
    stored = "pulls on every mass: mgh"
    note = ""

    def __post_init__(self) -> None:
        direction = as_vector(self.direction, f"the direction of {self.title}", place=self.place)
        length = norm(direction)
        if length == 0:
            raise self._error("its direction is zero", fix="give a direction such as (0, -1)", code="E409")
        if length != 1 and not bounded.is_one(length**2):
            direction = tuple(d / length for d in direction)
        self._set(direction=direction, g=as_expr(self.g, f"the strength of {self.title}", place=self.place))
        if self.datum is not None and not isinstance(self.datum, Point):
            raise self._error("its datum must be a point", fix="write datum=system.origin + (0, h0)", code="E412")

    def suggested_name(self) -> str:
        """The symbol of its strength."""
        return self.g.name if isinstance(self.g, sp.Symbol) else ""

    def uses(self) -> Iterator[Use]:
        """Strength and direction, which may contain only parameters."""
        yield Use("g", "strength g", self.g, Level.CONSTANT)
        for d in self.direction:
            yield Use("direction", "direction", d, Level.CONSTANT)

    def measures(self, model: Surroundings) -> Iterator[Measure]:
        """An acceleration; the unit of the direction does not matter."""
        yield Measure("strength", self.g, ACCELERATION)

    def acts_on(self) -> None:
        """Every mass."""

    def points(self) -> Iterator[tuple[str, Point]]:
        """The datum, if it is given."""
        if self.datum is not None:
            yield "datum", self.datum

    def height(self, model: Surroundings, point: Point) -> sp.Expr:
        """h = −n·(r − r_datum) [m], the height of a point above the datum."""
        zero = model.position(self.datum) if self.datum is not None else (sp.S.Zero,) * model.dimension
        return model.expand(
            -sum(
                (n * (x - x0) for n, x, x0 in zip(self.direction, model.position(point), zero, strict=True)),
                sp.S.Zero,
            )
        )

    def portions(self, model: Surroundings) -> Iterator[tuple[Body, sp.Expr]]:
        """For every body its m g h."""
        for body in model.bodies:
            yield body, body.mass * self.g * self.height(model, body.at)

    def potential(self, model: Surroundings) -> sp.Expr:
        """Σ m g h."""
        return sum((energy for _, energy in self.portions(model)), sp.S.Zero)
