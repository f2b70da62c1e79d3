"""A spring: linear or by a law, translational or torsional, between points or on a deflection."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, ClassVar, Literal

import sympy as sp

from lagrangian.model.antiderivatives import antiderivative
from lagrangian.model.elements.answers import ANGLE, ENERGY, ActsOn, Entry, FieldKind, Measure, deflected
from lagrangian.model.elements.base import (
    XI,
    Element,
    Level,
    Surroundings,
    Use,
    V,
    called,
    check_ends,
    deflection_between,
    error_of,
)
from lagrangian.model.geometry import Point, as_expr
from lagrangian.page.plain import plain
from lagrangian.records import dataclass

DELTA = sp.Symbol("delta")
"""In a law: the extension δ − δ₀ [m or rad]."""


def stored(element: Element, law: sp.Expr) -> sp.Expr:
    """∫₀^δ law in closed form; raises `ModelError` if none was found."""
    energy = antiderivative(law, DELTA)
    if energy is None:
        raise error_of(
            element,
            f"no closed form was found for the integral of its law {plain(law)[:200]} from 0",
            fix="give energy, an expression in delta, instead",
            code="E415",
        )
    return energy


@dataclass(frozen=True, eq=False, kw_only=True)
class Spring(Element):
    """A spring: V = ½ k (δ − δ₀)², or ∫₀^(δ−δ₀) law, where δ is the deflection and δ₀ the rest length.

    δ is the distance of two points (``between``) or an expression in the coordinates (``deflection``; an angle makes it
    torsional). ``law`` is the pull [N or N m] as an expression in ``delta``, the extension; ``energy`` is the stored
    energy as an expression in ``delta``. Give exactly one of ``k``, ``law`` and ``energy``. k may be negative.
    """

    k: Any = None
    between: Any = None
    deflection: Any = None
    rest: Any = 0
    law: Any = None
    energy: Any = None

    kind: ClassVar[str] = "spring"
    plural = "Springs."
    about = "A spring: V = ½ k (δ − rest)², or by its law."
    entries: ClassVar[Mapping[str, Entry]] = {
        "k": Entry(FieldKind.EXPRESSION, "Its stiffness."),
        "between": Entry(FieldKind.TWO_POINTS, "The two points it joins."),
        "deflection": Entry(FieldKind.EXPRESSION, "Its deflection δ, instead of two points."),
        "rest": Entry(FieldKind.EXPRESSION, "The deflection without force.", 0),
        "law": Entry(FieldKind.EXPRESSION, "Its pull as an expression in delta, instead of k.", local=(DELTA,)),
        "energy": Entry(
            FieldKind.EXPRESSION,
            "Its energy as an expression in delta, instead of k.",
            local=(DELTA,),
            made_from="law",
        ),
    }
    ledger: ClassVar[Literal["T*", "V", "Ξ"]] = "V"
    because = ("its force depends on its deflection alone: conservative, stored in ", V, ", so not in ", XI)
    stored = "stores energy by its deflection"
    note = ""

    def __post_init__(self) -> None:
        given = [key for key in ("k", "law", "energy") if getattr(self, key) is not None]
        if len(given) != 1:
            raise self._error(
                f"give exactly one of k, law and energy (got {', '.join(given) or 'none'})",
                fix="write k for a linear spring, law='k*delta + k3*delta^3' for another",
                code="E416",
            )
        self._set(between=check_ends(self, self.between, self.deflection))
        for key in (*given, "rest") + (("deflection",) if self.deflection is not None else ()):
            value = getattr(self, key)
            value = called(self, key, value, DELTA) if callable(value) and key in ("law", "energy") else value
            self._set(**{key: as_expr(value, f"the {key} of {self.title}", place=self.place)})
        if self.law is not None:
            self._set(energy=stored(self, self.law))

    def suggested_name(self) -> str:
        """The symbol of its stiffness."""
        return self.k.name if isinstance(self.k, sp.Symbol) else ""

    def uses(self) -> Iterator[Use]:
        """The stiffness (of parameters); deflection and rest length (of coordinates, time and inputs); the law."""
        if self.k is not None:
            yield Use("k", "stiffness", self.k, Level.CONSTANT)
        if self.deflection is not None:
            yield Use("deflection", "deflection", self.deflection, Level.POSITION, inputs=True)
        yield Use("rest", "rest length", self.rest, Level.POSITION, inputs=True)
        for key in ("law", "energy"):
            if getattr(self, key) is not None:
                yield Use(key, key, getattr(self, key), Level.CONSTANT, local=(DELTA,))

    def measures(self, model: Surroundings) -> Iterator[Measure]:
        """With the unit [δ]: rest length [δ], stiffness J/[δ]², law J/[δ]."""
        along = None if self.between else self.deflection
        if self.rest != 0:
            yield Measure("rest length", self.rest, ANGLE, along, 1)
        if self.k is not None:
            yield Measure("stiffness", self.k, ENERGY, along, -2)
            return
        yield Measure("extension", DELTA, ANGLE, along, 1, local=True)
        if self.law is not None:
            yield Measure("law", self.law, ENERGY, along, -1)

    def acts_on(self) -> ActsOn:
        """Its ends or its deflection."""
        return deflected(self.between, self.deflection)

    def points(self) -> Iterator[tuple[str, Point]]:
        """Its two ends, if it has them."""
        for point in self.between or ():
            yield "between", point

    def extension(self, model: Surroundings) -> sp.Expr:
        """δ − δ₀ [m or rad], positive when stretched."""
        delta = deflection_between(model, *self.between) if self.between else model.expand(self.deflection)
        return delta - model.expand(self.rest)

    def potential(self, model: Surroundings) -> sp.Expr:
        """½ k (δ − δ₀)², or the energy of its law at the extension."""
        extension = self.extension(model)
        if self.k is not None:
            return self.k * extension**2 / 2
        return self.energy.subs(DELTA, extension)
