"""Checks known values of masses and inertias: impossible ones raise errors, doubtful ones lead to notices.

A mass must be positive. The principal moments A ≤ B ≤ C of a real body obey two laws:

    A + B ≥ C   (E105),   A ≥ 0   (E106)

If the first is violated, T* is still positive, and some published data of robots do violate it: that leads to a notice,
never to an error. If the second is violated, the mass matrix decides (`lagrangian.dynamics.notices`).
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.codes import Code, CodeText
from lagrangian.errors import ModelError
from lagrangian.model.elements.base import Body
from lagrangian.model.model import written_out
from lagrangian.model.names import time
from lagrangian.records import dataclass

if TYPE_CHECKING:
    from lagrangian.model.model import Model

RELATIVE_TOLERANCE = 1e-9
"""A principal moment may exceed the sum of the other two by this fraction, because of rounding in thin rods."""


@dataclass(frozen=True)
class ConstantValues:
    """The values of constant expressions: of parameters that have one, and of definitions."""

    values: Mapping[Any, float]
    definitions: Mapping[Any, sp.Expr]

    @classmethod
    def of_model(cls, model: Model) -> ConstantValues:
        """The values that a model declares."""
        return cls(model.values, {d.symbol: d.expression for d in model.definitions})

    def of(self, expr: sp.Expr) -> float | None:
        """The value of a constant expression, or None if a parameter in it has no value."""
        full = written_out(expr, self.definitions)
        if full.free_symbols - self.values.keys():
            return None
        value = cast(
            "sp.Expr", full.xreplace({s: sp.Float(self.values[cast("sp.Symbol", s)]) for s in full.free_symbols})
        )
        return float(value) if value.is_real else float("nan")

    def moves(self, body: Body) -> bool:
        """Whether its centre of mass can move."""
        return any(written_out(x, self.definitions).has(AppliedUndef, time) for x in body.at.position)


@dataclass(frozen=True)
class Doubt:
    """An inertia that no real body has: the law that it violates (E105 or E106), and a description."""

    body: Body
    code: Code
    what: str

    @property
    def negative(self) -> bool:
        """Whether the body's own energy can be negative."""
        return self.code is Code.E106


def check_body(numbers: ConstantValues, body: Body) -> None:
    """Raise an error for a mass that is not positive and for values that are not finite, as far as they are known."""
    mass = numbers.of(body.mass)
    shown = f"mass {body.mass} = {mass:g} kg" if mass is not None and body.mass.free_symbols else f"mass = {mass} kg"

    def error(what: str, fix: str, code: CodeText) -> ModelError:
        return ModelError(what, element=body.title, place=body.place, fix=fix, code=code)

    if mass is not None:
        if not math.isfinite(mass):
            raise error(f"its mass must be a finite positive number (got {mass})", "give it a mass above 0", "E101")
        if mass < 0:
            raise error(f"its {shown} is negative", "give it a mass above 0", "E102")
        if mass == 0 and (body.axes is None or numbers.moves(body)):
            raise error(f"its {shown} is zero", "give it a mass above 0, or leave it out", "E103")
    entries = [numbers.of(x) for row in body.tensor for x in row]
    if not all(math.isfinite(x) for x in entries if x is not None):
        raise error("its inertia must be made of finite numbers", "give finite moments of inertia", "E101")


def doubt(numbers: ConstantValues, body: Body) -> Doubt | None:
    """Return why no real body has an inertia; None if one may have it, as far as values are known."""
    if body.axes is None:
        return None
    entries = [numbers.of(x) for row in body.tensor for x in row]
    size = len(body.tensor)
    if any(x is None for x in entries):
        known = [x for x in entries[:: size + 1] if x is not None and x < 0]
        return Doubt(body, Code.E106, f"its moment of inertia {known[0]:.6g} kg m² is negative") if known else None
    if size == 1:
        J = cast("float", entries[0])
        return Doubt(body, Code.E106, f"its inertia {J:.6g} kg m² is negative") if J < 0 else None
    import numpy as np  # here, as describing a system waits for SymPy alone

    moments = np.linalg.eigvalsh(np.array(entries, float).reshape(size, size)).tolist()
    listed = ", ".join(f"{x:.6g}" for x in moments)
    slack = RELATIVE_TOLERANCE * max(abs(moments[2]), 1e-300)
    if moments[0] < -slack:
        return Doubt(body, Code.E106, f"its inertia is not positive semidefinite (principal moments {listed} kg m²)")
    if moments[2] > moments[0] + moments[1] + slack:
        sums = f"{moments[0]:.6g} + {moments[1]:.6g} ≥ {moments[2]:.6g}"
        return Doubt(body, Code.E105, f"its inertia fits no body: principal moments {listed} kg m² violate {sums}")
    return None
