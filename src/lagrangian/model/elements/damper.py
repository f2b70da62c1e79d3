"""A damper: linear or by a law, translational or torsional, between points or on a deflection."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, ClassVar, Literal

import sympy as sp

from lagrangian import bounded
from lagrangian.model.elements.answers import ENERGY, ActsOn, Entry, FieldKind, Measure, deflected
from lagrangian.model.elements.base import (
    DEFLECTION,
    XI,
    Action,
    Element,
    Level,
    Surroundings,
    Use,
    called,
    check_ends,
    difference,
    pair_ends,
)
from lagrangian.model.elements.vectors import norm
from lagrangian.model.geometry import Point, as_expr
from lagrangian.model.names import time
from lagrangian.records import dataclass

RATE = sp.Symbol("rate")
"""In a law: the rate of the deflection δ̇ [m/s or rad/s]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Damper(Element):
    """A damper, which pulls its ends with b δ̇, or by its law of ``rate``; Rayleigh's D = ½ b δ̇², Ξ_i = −∂D/∂ξ̇_i.

    δ is the distance of two points (``between``) or an expression in the coordinates (``deflection``; an angle makes it
    torsional). ``law`` is the pull [N or N m] as an expression in ``rate`` = δ̇. Give exactly one of ``b`` and ``law``.
    """

    b: Any = None
    between: Any = None
    deflection: Any = None
    law: Any = None

    kind: ClassVar[str] = "damper"
    plural = "Dampers."
    about = "A damper: D = ½ b δ̇², or by its law."
    entries: ClassVar[Mapping[str, Entry]] = {
        "b": Entry(FieldKind.EXPRESSION, "Its coefficient."),
        "between": Entry(FieldKind.TWO_POINTS, "The two points it joins."),
        "deflection": Entry(FieldKind.EXPRESSION, "Its deflection δ, instead of two points."),
        "law": Entry(FieldKind.EXPRESSION, "Its pull as an expression in rate, instead of b.", local=(RATE,)),
    }
    ledger: ClassVar[Literal["T*", "V", "Ξ"]] = "Ξ"
    because = ("it takes energy out and stores none: no potential, so it is in ", XI)
    resists = True

    def __post_init__(self) -> None:
        given = [key for key in ("b", "law") if getattr(self, key) is not None]
        if len(given) != 1:
            raise self._error(
                f"give exactly one of b and law (got {', '.join(given) or 'none'})",
                fix="write b for a linear damper, law='b*rate*abs(rate)' for another",
                code="E416",
            )
        self._set(between=check_ends(self, self.between, self.deflection))
        for key in (*given, *(("deflection",) if self.deflection is not None else ())):
            value = getattr(self, key)
            value = called(self, key, value, RATE) if callable(value) and key == "law" else value
            self._set(**{key: as_expr(value, f"the {key} of {self.title}", place=self.place)})

    def suggested_name(self) -> str:
        """The symbol of its coefficient."""
        return self.b.name if isinstance(self.b, sp.Symbol) else ""

    def uses(self) -> Iterator[Use]:
        """The coefficient (of parameters), the deflection (of coordinates and time), the law (of the rate)."""
        if self.b is not None:
            yield Use("b", "damping coefficient", self.b, Level.CONSTANT)
        if self.law is not None:
            yield Use("law", "law", self.law, Level.CONSTANT, local=(RATE,))
        if self.deflection is not None:
            yield Use("deflection", "deflection", self.deflection, Level.POSITION)

    def measures(self, model: Surroundings) -> Iterator[Measure]:
        """With the unit [δ]: law J/[δ] of a rate in [δ]/s, coefficient J s/[δ]²."""
        along = None if self.between else self.deflection
        if self.law is not None:
            yield Measure("rate", RATE, (0, 0, -1), along, 1, local=True)
            yield Measure("law", self.law, ENERGY, along, -1)
        if self.b is not None:
            yield Measure("damping coefficient", self.b, (1, 2, -1), along, -2)

    def acts_on(self) -> ActsOn:
        """Its ends or its deflection."""
        return deflected(self.between, self.deflection)

    def points(self) -> Iterator[tuple[str, Point]]:
        """Its two ends, if it has them."""
        for point in self.between or ():
            yield "between", point

    def displacement(self, model: Surroundings) -> sp.Expr:
        """δ [m or rad]; along one fixed line it is the signed separation, because only its rate matters."""
        if not self.between:
            return model.expand(self.deflection)
        delta = difference(model, *self.between)
        moving = [d for d in delta if d != 0]
        if len(moving) == 1 and (self.law is None):
            return moving[0]
        return norm(delta)

    def rate(self, model: Surroundings) -> sp.Expr:
        """δ̇ [m/s or rad/s]."""
        return bounded.diff(self.displacement(model), time)

    def pull(self, model: Surroundings) -> sp.Expr:
        """The force or torque that resists the motion: b δ̇, or the law at δ̇."""
        rate = self.rate(model)
        return self.b * rate if self.b is not None else self.law.subs(RATE, rate)

    def works(self, model: Surroundings) -> tuple[Action, ...]:
        """One action −b δ̇ on the deflection."""
        return (Action(-self.pull(model), self.rate(model), DEFLECTION, self.displacement(model)),)

    def ends(self, model: Surroundings) -> tuple[Action, ...]:
        """The pull on each end."""
        if not self.between:
            return self.works(model)
        delta = difference(model, *self.between)
        length = norm(delta)
        rate = sp.Add(*(d * bounded.diff(d, time) for d in delta)) / length
        pull = self.b * rate if self.b is not None else self.law.subs(RATE, rate)
        return pair_ends(model, self.between[0], self.between[1], -pull)

    def dissipation(self, model: Surroundings) -> sp.Expr | None:
        """D = ½ b δ̇² of a linear damper."""
        return self.b * self.rate(model) ** 2 / 2 if self.b is not None else None
