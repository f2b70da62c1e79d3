"""A point mass."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import ClassVar

import sympy as sp

from lagrangian.model.elements.answers import MASS, REQUIRED, Entry, FieldKind, Measure
from lagrangian.model.elements.base import Body, Level, Surroundings, Use
from lagrangian.model.geometry import Point, as_expr
from lagrangian.records import dataclass


@dataclass(frozen=True, eq=False, kw_only=True)
class Particle(Body):
    """A point mass [kg] at a point: T* = ½ m v²."""

    kind: ClassVar[str] = "particle"
    plural = "Point masses."
    about = "A point mass: T* = ½ m v²."
    entries: ClassVar[Mapping[str, Entry]] = {
        "mass": Entry(FieldKind.EXPRESSION, "The mass, made of parameters.", REQUIRED),
        "at": Entry(FieldKind.POINT, "The point it is at.", REQUIRED),
    }

    def __post_init__(self) -> None:
        if not isinstance(self.at, Point):
            raise self._error(
                "a particle must be at a point", fix="write at=P with P = system.origin + (x, y)", code="E412"
            )
        self._set(mass=as_expr(self.mass, f"the mass of {self.title}", place=self.place))

    def suggested_name(self) -> str:
        """The symbol of its mass."""
        return self.mass.name if isinstance(self.mass, sp.Symbol) else ""

    def uses(self) -> Iterator[Use]:
        """The mass, made of parameters."""
        yield Use("mass", "mass", self.mass, Level.CONSTANT)

    def measures(self, model: Surroundings) -> Iterator[Measure]:
        """A mass."""
        yield Measure("mass", self.mass, MASS)

    def kinetic(self, model: Surroundings) -> sp.Expr:
        """½ m (ẋ² + ẏ² + ż²)."""
        return self.mass / 2 * sum((v**2 for v in model.velocity(self.at)), sp.S.Zero)
