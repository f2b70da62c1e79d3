"""A rope of fixed length over points."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import pairwise
from typing import Any, ClassVar

from lagrangian.model.elements.answers import LENGTH, REQUIRED, ActsOn, Entry, FieldKind, Measure
from lagrangian.model.elements.base import Condition, Level, Surroundings, Use
from lagrangian.model.elements.conditions import Separation
from lagrangian.model.elements.constraint import Restriction
from lagrangian.model.geometry import Point, as_expr
from lagrangian.records import dataclass


@dataclass(frozen=True, eq=False, kw_only=True)
class Rope(Restriction):
    """A taut inextensible rope: Σ |r_{k+1} − r_k| = ``length`` over the points that it runs ``through``.

    It has one row, and the tension is −λ. The model keeps it taut: with a negative tension, a real rope would be slack.
    """

    through: Any
    length: Any

    kind: ClassVar[str] = "rope"
    plural = "Ropes of fixed length."
    about = "A taut rope of fixed length over two points or more."
    entries: ClassVar[Mapping[str, Entry]] = {
        "through": Entry(FieldKind.POINTS, "The points that it runs through, from end to end.", REQUIRED),
        "length": Entry(FieldKind.EXPRESSION, "Its length.", REQUIRED),
    }

    def __post_init__(self) -> None:
        self._set(through=self._points(self.through, "through"))
        self._set(length=as_expr(self.length, f"the length of {self.title}", place=self.place))
        if self.length.is_nonpositive:
            raise self._error(f"the length is {self.length}", fix="a length is above 0", code="E406")

    def uses(self) -> Iterator[Use]:
        """The length may change with positions and time."""
        yield Use("length", "length", self.length, Level.POSITION)

    def measures(self, model: Surroundings) -> Iterator[Measure]:
        """A length."""
        yield Measure("length", self.length, LENGTH)

    def points(self) -> Iterator[tuple[str, Point]]:
        """The points that it runs through."""
        for point in self.through:
            yield "through", point

    def acts_on(self) -> ActsOn:
        """Its straight parts from point to point."""
        return ActsOn(
            tuple(pairwise(self.through)),
            "it restricts nothing: no coordinate moves its points apart",
            "through=(P, Q, …) with at least one of them moved by a coordinate",
        )

    def conditions(self, model: Surroundings) -> tuple[Condition, ...]:
        """One row."""
        return (Separation(points=self.through, length=self.length),)
