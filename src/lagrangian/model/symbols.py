"""The named symbols of a system: coordinates, parameters, inputs, definitions."""

from __future__ import annotations

from dataclasses import dataclass, field

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.errors import Place
from lagrangian.model.names import time


@dataclass(frozen=True)
class Coordinate:
    """A generalized coordinate ξ: ``symbol`` is SymPy's ``dynamicsymbols(name)``."""

    name: str
    symbol: AppliedUndef
    description: str = ""
    unit: str | None = None
    place: Place | None = field(default=None, compare=False)

    @property
    def rate(self) -> sp.Derivative:
        """ξ̇."""
        return sp.Derivative(self.symbol, time)

    @property
    def acceleration(self) -> sp.Derivative:
        """ξ̈."""
        return sp.Derivative(self.symbol, (time, 2))


@dataclass(frozen=True)
class Parameter:
    """A constant: a plain SymPy symbol with, perhaps, a value in SI units and the unit it was given in."""

    name: str
    symbol: sp.Symbol
    value: float | None = None
    unit: str | None = None
    description: str = ""
    place: Place | None = field(default=None, compare=False)


@dataclass(frozen=True)
class Input:
    """A force, torque or other signal from outside, a function of time that is known only when the system runs."""

    name: str
    symbol: AppliedUndef
    description: str = ""
    unit: str | None = None
    place: Place | None = field(default=None, compare=False)


@dataclass(frozen=True)
class Definition:
    """A named expression; where it holds coordinates or time it is ``moving``, and its symbol a function of t."""

    name: str
    symbol: sp.Expr
    expression: sp.Expr
    place: Place | None = field(default=None, compare=False)

    @property
    def moving(self) -> bool:
        """Whether it changes with time."""
        return isinstance(self.symbol, AppliedUndef)
