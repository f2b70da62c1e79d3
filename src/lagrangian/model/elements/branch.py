"""The family of circuit elements: branches through which the charge of some coordinates flows.

The charges are generalized coordinates [C], chosen as mesh charges are: q̇ is the current around a loop, and the charge
of a branch is the sum of those of its loops, such as q1 − q2. So Kirchhoff's current law holds by the choice of the
coordinates, and each equation of a charge is his voltage law for a loop.

Source: S. H. Crandall, D. C. Karnopp, E. F. Kurtz, D. C. Pridmore-Brown, Dynamics of Mechanical and Electromechanical
Systems, McGraw-Hill 1968, chapters 5 and 6.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, ClassVar, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.model.antiderivatives import antiderivative
from lagrangian.model.elements.answers import CHARGE, REQUIRED, ActsOn, Entry, FieldKind, Measure
from lagrangian.model.elements.base import Element, Level, Surroundings, Use, Words, called, error_of
from lagrangian.model.geometry import Frame, as_expr
from lagrangian.model.names import time
from lagrangian.page.plain import plain
from lagrangian.records import dataclass

CURRENT_SYMBOL = sp.Symbol("current")
"""In a law: the current of the branch [A]."""

CHARGE_SYMBOL = sp.Symbol("charge")
"""In a law: the charge that has flowed through the branch [C]."""

THROUGH: Words = ("its current",)
"""The target of a voltage: the current through its branch."""

CHARGE_ENTRY = Entry(FieldKind.EXPRESSION, "The charge that flows through it, such as q1 - q2.", REQUIRED)


@dataclass(frozen=True, eq=False, kw_only=True)
class CircuitBranch(Element):
    """The family of what a ``charge`` [C] flows through: a sum of charges of loops, with their signs."""

    charge: Any = None

    by_charge: ClassVar[bool] = False
    """Whether a constant charge acts, as that of a capacitor, and not only a current."""

    @property
    def charges(self) -> tuple[sp.Expr, ...]:
        """The charges that flow through it."""
        return (self.charge,)

    def _check_charge(self, key: str = "charge") -> None:
        """Normalize the charge in a field: a sum of coordinates with constant factors (Kirchhoff's current law).

        It may be prescribed, as by a source of current, where another field holds a coordinate.
        """
        what = f"the {key.replace('_', ' ')} of {self.title}"
        if getattr(self, key) is None:
            raise self._error("it is in no circuit", fix=f"{key}=q, the charge that flows through it", code="E412")
        charge = as_expr(getattr(self, key), what, place=self.place)
        for q in sorted(charge.atoms(AppliedUndef), key=str):
            if bounded.diff(charge, q).has(AppliedUndef, time) or charge.has(sp.Derivative):
                raise self._error(
                    f"its {key.replace('_', ' ')} {plain(charge)} is not a sum of charges",
                    fix="add and subtract the charges of the loops that it is in, such as q1 - q2",
                    code="E412",
                )
        prescribed = charge.has(time) or self.by_charge
        if not charge.has(AppliedUndef) and not (prescribed and self._moves_by_others(key)):
            raise self._error(
                f"no coordinate is in its {key.replace('_', ' ')} {plain(charge)}",
                fix="declare the charge as a coordinate, and write charge=q",
                code="E412",
            )
        self._set(**{key: charge})

    def _moves_by_others(self, key: str) -> bool:
        """Whether a field other than a charge's holds a coordinate, so that a prescribed current does something."""
        given = [getattr(self, x) for x in self.entries if x != key]
        return any(isinstance(x, Frame) or (isinstance(x, sp.Basic) and x.has(AppliedUndef)) for x in given)

    def _check_one_of(self, keys: tuple[str, ...], local: sp.Symbol, fix: str) -> None:
        """Normalize the one of several fields that is given; a function is called with the local symbol."""
        given = [key for key in keys if getattr(self, key) is not None]
        if len(given) != 1:
            listed = f"{', '.join(keys[:-1])} and {keys[-1]}"
            raise self._error(f"give exactly one of {listed} (got {', '.join(given) or 'none'})", fix=fix, code="E416")
        for key in given:
            value = getattr(self, key)
            value = called(self, key, value, local) if callable(value) and key != keys[0] else value
            self._set(**{key: as_expr(value, f"the {key} of {self.title}", place=self.place)})

    def uses_of_charge(self) -> Iterator[Use]:
        """The charge, of coordinates and time."""
        yield Use("charge", "charge", self.charge, Level.POSITION)

    def measure_of_charge(self) -> Iterator[Measure]:
        """The charge, in coulombs."""
        yield Measure("charge", self.charge, CHARGE)

    def acts_on(self) -> ActsOn | None:
        """The current of its branch."""
        return ActsOn(
            (self.charge,), "it does nothing: no charge that is a coordinate flows through it", "charge=a coordinate"
        )

    def flowed(self, model: Surroundings) -> sp.Expr:
        """The charge that has flowed through it [C]."""
        return model.expand(self.charge)

    def current(self, model: Surroundings) -> sp.Expr:
        """Its current [A], the rate of its charge."""
        return bounded.diff(self.flowed(model), time)


def integral(element: Element, key: str, law: sp.Expr, local: sp.Symbol) -> sp.Expr:
    """∫₀ of a law over its local symbol, with positions held; raises `ModelError` if no closed form was found."""
    names = {*law.atoms(AppliedUndef), *law.free_symbols} - {local, time}
    held = {x: sp.Dummy(str(x), nonzero=True) for x in sorted(names, key=str)}  # 1/i0 has no case i0 = 0
    found = antiderivative(cast("sp.Expr", bounded.replaced(law, held)), local)
    if found is None:
        raise error_of(
            element,
            f"no closed form was found for the integral of its law {plain(law)[:200]} over {local} from 0",
            fix=f"give {key}, an expression in {local}, instead",
            code="E415",
        )
    return cast("sp.Expr", bounded.replaced(found, {dummy: x for x, dummy in held.items()}))
