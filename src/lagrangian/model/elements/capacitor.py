"""A capacitor: its potential energy, linear or by its law."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, ClassVar, Literal

import sympy as sp

from lagrangian import bounded
from lagrangian.model.elements.answers import (
    CAPACITANCE,
    CHARGE,
    ENERGY,
    VOLTAGE,
    ActsOn,
    Entry,
    FieldKind,
    Measure,
)
from lagrangian.model.elements.base import XI, Level, Surroundings, Use, V
from lagrangian.model.elements.branch import CHARGE_ENTRY, CHARGE_SYMBOL, CircuitBranch, integral
from lagrangian.records import dataclass


@dataclass(frozen=True, eq=False, kw_only=True)
class Capacitor(CircuitBranch):
    """A capacitor with a charge q: V = ∫₀^q v dq, which is q²/(2 C) for a constant capacitance.

    ``C`` [F] may depend on positions. ``law`` is its voltage v [V] as an expression in ``charge``; ``energy`` is V [J]
    as an expression in ``charge``. Both may depend on positions, too. Give exactly one of the three.
    """

    C: Any = None
    law: Any = None
    energy: Any = None

    kind: ClassVar[str] = "capacitor"
    plural = "Capacitors."
    about = "A capacitor: V = q²/(2 C), or by its law."
    entries: ClassVar[Mapping[str, Entry]] = {
        "charge": CHARGE_ENTRY,
        "C": Entry(FieldKind.EXPRESSION, "Its capacitance; it may depend on positions."),
        "law": Entry(
            FieldKind.EXPRESSION, "Its voltage as an expression in charge, instead of C.", local=(CHARGE_SYMBOL,)
        ),
        "energy": Entry(
            FieldKind.EXPRESSION,
            "Its energy as an expression in charge, instead of C.",
            local=(CHARGE_SYMBOL,),
            made_from="law",
        ),
    }
    ledger: ClassVar[Literal["T*", "V", "Ξ"]] = "V"
    because = ("its voltage depends on its charge and on positions alone: conservative, stored in ", V, ", not in ", XI)
    stored = "stores energy by its charge"
    note = ""
    by_charge = True

    def __post_init__(self) -> None:
        self._check_one_of(
            ("C", "law", "energy"),
            CHARGE_SYMBOL,
            "write C for a constant capacitance, law='charge/C + a*charge^3' for another capacitor",
        )
        self._check_charge()
        if self.C == 0:
            raise self._error("its capacitance is zero", fix="leave it out: no charge flows through it", code="E103")
        if self.law is not None:
            self._set(energy=integral(self, "energy", self.law, CHARGE_SYMBOL))

    def acts_on(self) -> ActsOn:
        """Its charge, and what its capacitance depends on."""
        law = self.C if self.C is not None else self.energy
        return ActsOn(
            (self.charge, law), "it does nothing: no coordinate changes its charge or its capacitance", "charge=q"
        )

    def suggested_name(self) -> str:
        """The symbol of its capacitance."""
        return self.C.name if isinstance(self.C, sp.Symbol) else ""

    def uses(self) -> Iterator[Use]:
        """The charge; the capacitance, or the law, of positions and parameters."""
        yield from self.uses_of_charge()
        for key, what in (("C", "capacitance"), ("law", "law"), ("energy", "energy")):
            if getattr(self, key) is not None:
                yield Use(key, what, getattr(self, key), Level.POSITION, local=(CHARGE_SYMBOL,) if key != "C" else ())

    def measures(self, model: Surroundings) -> Iterator[Measure]:
        """F; for a law V, for an energy J."""
        yield from self.measure_of_charge()
        if self.C is not None:
            yield Measure("capacitance", self.C, CAPACITANCE)
            return
        yield Measure("charge", CHARGE_SYMBOL, CHARGE, local=True)
        if self.law is not None:
            yield Measure("law", self.law, VOLTAGE)
        else:
            yield Measure("energy", self.energy, ENERGY)

    def voltage(self, model: Surroundings) -> sp.Expr:
        """v = ∂V/∂q [V], positive where it opposes more charge."""
        if self.C is not None:
            return self.flowed(model) / model.expand(self.C)
        law = self.law if self.law is not None else bounded.diff(self.energy, CHARGE_SYMBOL)
        return model.expand(law).subs(CHARGE_SYMBOL, self.flowed(model))

    def potential(self, model: Surroundings) -> sp.Expr:
        """q²/(2 C), or the energy of its law at the charge."""
        charge = self.flowed(model)
        if self.C is not None:
            return charge**2 / (2 * model.expand(self.C))
        return model.expand(self.energy).subs(CHARGE_SYMBOL, charge)
