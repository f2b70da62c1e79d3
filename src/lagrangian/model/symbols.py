"""The named symbols of a system: coordinates, velocities, parameters, inputs, definitions."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

from functools import cached_property

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.errors import Place
from lagrangian.model.names import time
from lagrangian.records import dataclass, field
from lagrangian.viewed import Brief


@dataclass(frozen=True)
class Coordinate(Brief):
    """A generalized coordinate ξ: ``symbol`` is SymPy's ``dynamicsymbols(name)``.

    ``start`` is its default initial value: 1 for the last entry of a quaternion. A ``positive`` coordinate is a
    distance that is always greater than 0: √(ξ²) simplifies to ξ.
    """

    name: str
    symbol: AppliedUndef
    description: str = ""
    unit: str | None = None
    place: Place | None = field(default=None, compare=False, repr=False)
    start: float = 0.0
    positive: bool = False

    @cached_property
    def rate(self) -> sp.Derivative:
        """ξ̇."""
        return sp.Derivative(self.symbol, time)

    @cached_property
    def acceleration(self) -> sp.Derivative:
        """ξ̈."""
        return sp.Derivative(self.symbol, (time, 2))


@dataclass(frozen=True)
class Velocity(Brief):
    """A velocity: the rate of a coordinate, named ``ξ'``, or a quasi-velocity, which is not the rate of a coordinate.

    The symbol of a quasi-velocity is a function of time; ``rate`` is the name of its own rate.
    """

    name: str
    symbol: AppliedUndef | sp.Derivative
    description: str = ""
    unit: str | None = None
    place: Place | None = field(default=None, compare=False, repr=False)

    @property
    def rate(self) -> str:
        """The name of its rate: ``ξ''`` of ``ξ'``."""
        return f"{self.name}'"


@dataclass(frozen=True)
class Parameter(Brief):
    """A constant: a plain SymPy symbol, optionally with a value in SI units and the unit in which it was given."""

    name: str
    symbol: sp.Symbol
    value: float | None = None
    unit: str | None = None
    description: str = ""
    place: Place | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True)
class Input(Brief):
    """A force, torque or other signal from outside, a function of time that is known only when the system runs."""

    name: str
    symbol: AppliedUndef
    description: str = ""
    unit: str | None = None
    place: Place | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True)
class Definition(Brief):
    """A named expression; if it contains coordinates or time it is ``moving``, and its symbol is a function of t."""

    name: str
    symbol: sp.Expr
    expression: sp.Expr
    place: Place | None = field(default=None, compare=False, repr=False)

    @property
    def moving(self) -> bool:
        """Whether it changes with time."""
        return isinstance(self.symbol, AppliedUndef)
