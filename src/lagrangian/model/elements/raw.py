"""Energies and generalized forces that are given directly."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, ClassVar, Literal

import sympy as sp

from lagrangian import bounded
from lagrangian.model.elements.answers import ENERGY, POWER, REQUIRED, Entry, FieldKind, Measure, MovingMass, Unit
from lagrangian.model.elements.base import XI, Action, Element, Level, Surroundings, Use
from lagrangian.model.elements.vectors import diagonal
from lagrangian.model.geometry import as_expr
from lagrangian.model.names import time
from lagrangian.records import dataclass


@dataclass(frozen=True, eq=False, kw_only=True)
class Energy(Element):
    """An energy or power of the whole system, as an expression."""

    value: Any

    about = "An energy or power as an expression."
    entries: ClassVar[Mapping[str, Entry]] = {"value": Entry(FieldKind.EXPRESSION, "The expression.", REQUIRED)}
    because = ("given as an energy",)
    unit: ClassVar[Unit] = ENERGY

    def __post_init__(self) -> None:
        self._set(value=as_expr(self.value, f"the value of {self.title}", place=self.place))

    def measures(self, model: Surroundings) -> Iterator[Measure]:
        """Every term is an energy, or a power."""
        for term in sp.Add.make_args(self.value):
            yield Measure("value", term, self.unit)

    def acts_on(self) -> None:
        """It has no place."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Potential(Energy):
    """A potential energy V [J], an expression in coordinates and time."""

    kind: ClassVar[str] = "potential"
    plural = "Potential energies."
    ledger: ClassVar[Literal["T*", "V", "Ξ"]] = "V"
    stored = "is an energy of position"
    note = "as given"

    def uses(self) -> Iterator[Use]:
        """An energy that depends on positions and time."""
        yield Use("value", "potential energy V", self.value, Level.POSITION, inputs=True)

    def potential(self, model: Surroundings) -> sp.Expr:
        """V as given."""
        return model.expand(self.value)


@dataclass(frozen=True, eq=False, kw_only=True)
class Kinetic(Energy):
    """A kinetic co-energy T* [J], an expression in coordinates, rates and time."""

    kind: ClassVar[str] = "kinetic"
    plural = "Kinetic co-energies."
    ledger: ClassVar[Literal["T*", "V", "Ξ"]] = "T*"
    note = "as given"

    def uses(self) -> Iterator[Use]:
        """An energy that depends on rates."""
        yield Use("value", "kinetic co-energy T*", self.value, Level.VELOCITY)

    def kinetic(self, model: Surroundings) -> sp.Expr:
        """T* as given."""
        return model.expand(self.value)

    def masses(self, model: Surroundings) -> Iterator[MovingMass]:
        """Its momenta ∂T*/∂ξ̇, each by itself: what changes none of them moves no mass."""
        momenta = tuple(bounded.diff(self.kinetic(model), v.symbol) for v in model.velocities)
        yield MovingMass(momenta, diagonal((sp.S.One,) * len(momenta)))


@dataclass(frozen=True, eq=False, kw_only=True)
class Dissipation(Energy):
    """Rayleigh's dissipation function D [W]: Ξ_i = −∂D/∂ξ̇_i."""

    kind: ClassVar[str] = "dissipation"
    plural = "Rayleigh's dissipation functions."
    ledger: ClassVar[Literal["T*", "V", "Ξ"]] = "Ξ"
    because = ("it takes energy out and stores none: no potential, so it is in ", XI)
    resists = True
    unit = POWER

    def uses(self) -> Iterator[Use]:
        """A function of the rates."""
        yield Use("value", "dissipation function D", self.value, Level.VELOCITY)

    def works(self, model: Surroundings) -> tuple[Action, ...]:
        """−∂D/∂ξ̇_i on each coordinate."""
        d = model.expand(self.value)
        rates: dict[sp.Expr, sp.Expr] = {c.rate: c.symbol for c in model.coordinates}
        moved = [(v.symbol, rates.get(v.symbol, v.symbol)) for v in model.velocities]
        return tuple(
            Action(-effort, rate, (symbol,), symbol) for rate, symbol in moved if (effort := bounded.diff(d, rate)) != 0
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
    plural = "Generalized forces."
    about = "A generalized force Ξ on one coordinate."
    entries: ClassVar[Mapping[str, Entry]] = {
        "coordinate": Entry(FieldKind.COORDINATE, "The coordinate, or the velocity of a floating frame.", REQUIRED),
        "value": Entry(FieldKind.EXPRESSION, "The force, as an expression.", REQUIRED),
    }
    ledger: ClassVar[Literal["T*", "V", "Ξ"]] = "Ξ"
    because = ("it acts from outside and may do work: no potential, so it is in ", XI)
    resists = False

    def __post_init__(self) -> None:
        self._set(
            coordinate=as_expr(self.coordinate, f"the coordinate of {self.title}", place=self.place),
            value=as_expr(self.value, f"the value of {self.title}", place=self.place),
        )

    def uses(self) -> Iterator[Use]:
        """The value, which may contain coordinates, rates, inputs, parameters and time."""
        yield Use("value", "value", self.value, Level.VELOCITY, inputs=True)

    def measures(self, model: Surroundings) -> Iterator[Measure]:
        """J/[ξ] on a coordinate ξ, W/[v] on a velocity v: the product is an energy or a power."""
        unit = ENERGY if any(self.coordinate == c.symbol for c in model.coordinates) else POWER
        yield Measure("value", self.value, unit, self.coordinate, -1)

    def acts_on(self) -> None:
        """Its coordinate, which moves."""

    def works(self, model: Surroundings) -> tuple[Action, ...]:
        """The force on its coordinate."""
        rate = bounded.diff(self.coordinate, time)
        return (Action(model.expand(self.value), rate, (self.coordinate,), self.coordinate),)
