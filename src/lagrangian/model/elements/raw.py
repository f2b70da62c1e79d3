"""Raw energies and generalized forces, for those who have them already."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, ClassVar, Literal

import sympy as sp

from lagrangian import bounded
from lagrangian.model.elements.base import Action, Element, Level, Surroundings, Use
from lagrangian.model.geometry import as_expr
from lagrangian.model.names import time


@dataclass(frozen=True, eq=False, kw_only=True)
class Potential(Element):
    """A potential energy V [J], an expression in coordinates and time."""

    value: Any

    kind: ClassVar[str] = "potential"
    ledger: ClassVar[Literal["T*", "V", "Ξ"]] = "V"

    def __post_init__(self) -> None:
        self._set(value=as_expr(self.value, f"the value of {self.title}", place=self.place))

    def uses(self) -> Iterator[Use]:
        """An energy of position."""
        yield Use("value", "potential energy V", self.value, Level.POSITION, inputs=True)

    def potential(self, model: Surroundings) -> sp.Expr:
        """V as given."""
        return model.expand(self.value)


@dataclass(frozen=True, eq=False, kw_only=True)
class Kinetic(Element):
    """A kinetic co-energy T* [J], an expression in coordinates, rates and time."""

    value: Any

    kind: ClassVar[str] = "kinetic"
    ledger: ClassVar[Literal["T*", "V", "Ξ"]] = "T*"

    def __post_init__(self) -> None:
        self._set(value=as_expr(self.value, f"the value of {self.title}", place=self.place))

    def uses(self) -> Iterator[Use]:
        """An energy of motion."""
        yield Use("value", "kinetic co-energy T*", self.value, Level.VELOCITY)

    def kinetic(self, model: Surroundings) -> sp.Expr:
        """T* as given."""
        return model.expand(self.value)


@dataclass(frozen=True, eq=False, kw_only=True)
class Dissipation(Element):
    """Rayleigh's dissipation function D [W]: Ξ_i = −∂D/∂ξ̇_i."""

    value: Any

    kind: ClassVar[str] = "dissipation"
    ledger: ClassVar[Literal["T*", "V", "Ξ"]] = "Ξ"

    def __post_init__(self) -> None:
        self._set(value=as_expr(self.value, f"the value of {self.title}", place=self.place))

    def uses(self) -> Iterator[Use]:
        """A function of the rates."""
        yield Use("value", "dissipation function D", self.value, Level.VELOCITY)

    def works(self, model: Surroundings) -> tuple[Action, ...]:
        """−∂D/∂ξ̇_i on each coordinate."""
        d = model.expand(self.value)
        return tuple(
            Action(-effort, c.rate, (c.symbol,), c.symbol)
            for c in model.coordinates
            if (effort := bounded.diff(d, c.rate)) != 0
        )

    def dissipation(self, model: Surroundings) -> sp.Expr | None:
        """D as given."""
        return model.expand(self.value)


@dataclass(frozen=True, eq=False, kw_only=True)
class GeneralizedForce(Element):
    """A generalized force Ξ_i [N or N m] on one coordinate, or on one velocity of a floating frame."""

    coordinate: Any
    value: Any

    kind: ClassVar[str] = "generalized_force"
    ledger: ClassVar[Literal["T*", "V", "Ξ"]] = "Ξ"

    def __post_init__(self) -> None:
        self._set(
            coordinate=as_expr(self.coordinate, f"the coordinate of {self.title}", place=self.place),
            value=as_expr(self.value, f"the value of {self.title}", place=self.place),
        )

    def uses(self) -> Iterator[Use]:
        """The value may hold anything down to rates."""
        yield Use("value", "value", self.value, Level.VELOCITY, inputs=True)

    def works(self, model: Surroundings) -> tuple[Action, ...]:
        """The force on its coordinate."""
        rate = bounded.diff(self.coordinate, time)
        return (Action(model.expand(self.value), rate, (self.coordinate,), self.coordinate),)
