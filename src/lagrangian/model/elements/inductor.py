"""A coil: its kinetic co-energy, linear or by its law, and of two coils that share flux."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, ClassVar, Literal

import sympy as sp

from lagrangian import bounded
from lagrangian.model.elements.answers import (
    CHARGE,
    CURRENT,
    ENERGY,
    FLUX,
    INDUCTANCE,
    REQUIRED,
    Entry,
    FieldKind,
    Measure,
    MovingMass,
)
from lagrangian.model.elements.base import Level, Surroundings, T, Use
from lagrangian.model.elements.branch import CHARGE_ENTRY, CURRENT_SYMBOL, CircuitBranch, integral
from lagrangian.model.names import time
from lagrangian.records import dataclass


@dataclass(frozen=True, eq=False, kw_only=True)
class Inductor(CircuitBranch):
    """A coil with the current i = d(charge)/dt: T* = ∫₀^i ψ di, which is ½ L i² for a constant inductance.

    ``L`` [H] may depend on positions. ``law`` is the flux linkage ψ [Wb] as an expression in ``current``; ``coenergy``
    is T* [J] as an expression in ``current``. Both may depend on positions, too. Give exactly one of the three.
    The voltage across it is dψ/dt, in the direction of the current.
    """

    L: Any = None
    law: Any = None
    coenergy: Any = None

    kind: ClassVar[str] = "inductor"
    plural = "Coils."
    about = "A coil: T* = ½ L i², or by its law."
    entries: ClassVar[Mapping[str, Entry]] = {
        "charge": CHARGE_ENTRY,
        "L": Entry(FieldKind.EXPRESSION, "Its inductance; it may depend on positions."),
        "law": Entry(
            FieldKind.EXPRESSION,
            "Its flux linkage as an expression in current, instead of L.",
            local=(CURRENT_SYMBOL,),
        ),
        "coenergy": Entry(
            FieldKind.EXPRESSION,
            "Its co-energy T* as an expression in current, instead of L.",
            local=(CURRENT_SYMBOL,),
            made_from="law",
        ),
    }
    ledger: ClassVar[Literal["T*", "V", "Ξ"]] = "T*"
    because = ("its flux linkage follows from its current, the rate of a charge: its energy is in ", T)
    note = ""

    def __post_init__(self) -> None:
        self._check_one_of(
            ("L", "law", "coenergy"),
            CURRENT_SYMBOL,
            "write L for a constant inductance, law='L0*i0*tanh(current/i0)' for a coil that saturates",
        )
        self._check_charge()
        if self.law is not None:
            self._set(coenergy=integral(self, "coenergy", self.law, CURRENT_SYMBOL))

    def suggested_name(self) -> str:
        """The symbol of its inductance."""
        return self.L.name if isinstance(self.L, sp.Symbol) else ""

    def uses(self) -> Iterator[Use]:
        """The charge; the inductance, or the law, of positions and parameters."""
        yield from self.uses_of_charge()
        for key, what in (("L", "inductance"), ("law", "law"), ("coenergy", "co-energy")):
            if getattr(self, key) is not None:
                yield Use(key, what, getattr(self, key), Level.POSITION, local=(CURRENT_SYMBOL,) if key != "L" else ())

    def measures(self, model: Surroundings) -> Iterator[Measure]:
        """H; for a law Wb, for a co-energy J."""
        yield from self.measure_of_charge()
        if self.L is not None:
            yield Measure("inductance", self.L, INDUCTANCE)
            return
        yield Measure("current", CURRENT_SYMBOL, CURRENT, local=True)
        if self.law is not None:
            yield Measure("law", self.law, FLUX)
        else:
            yield Measure("co-energy", self.coenergy, ENERGY)

    def acts_on(self) -> None:
        """A coil is counted by its energy."""

    @property
    def linear(self) -> bool:
        """Whether its flux linkage is L i, so that T* = T."""
        return self.L is not None

    def flux_of_current(self) -> sp.Expr:
        """ψ [Wb] as an expression in the local symbol of its current."""
        if self.L is not None:
            return self.L * CURRENT_SYMBOL
        return self.law if self.law is not None else bounded.diff(self.coenergy, CURRENT_SYMBOL)

    def coenergy_of_current(self) -> sp.Expr:
        """T* [J] as an expression in the local symbol of its current."""
        return self.L * CURRENT_SYMBOL**2 / 2 if self.L is not None else self.coenergy

    def flux(self, model: Surroundings) -> sp.Expr:
        """ψ [Wb] in the coordinates and rates."""
        return self.at_current(model, self.flux_of_current())

    def kinetic(self, model: Surroundings) -> sp.Expr:
        """T* = ∫₀^i ψ di."""
        return self.at_current(model, self.coenergy_of_current())

    def stored_energy(self, model: Surroundings) -> sp.Expr:
        """T = ψ i − T* [J], the energy that is stored."""
        return self.at_current(model, self.flux_of_current() * CURRENT_SYMBOL - self.coenergy_of_current())

    def at_current(self, model: Surroundings, law: sp.Expr) -> sp.Expr:
        """An expression in the local symbol of its current, at its current in the coordinates and rates."""
        return model.expand(law).subs(CURRENT_SYMBOL, self.current(model))

    def masses(self, model: Surroundings) -> Iterator[MovingMass]:
        """Its differential inductance dψ/di, with the current."""
        slope = self.L if self.L is not None else bounded.diff(self.flux_of_current(), CURRENT_SYMBOL)
        yield MovingMass((self.current(model),), ((self.at_current(model, slope),),))


@dataclass(frozen=True, eq=False, kw_only=True)
class MutualInductance(CircuitBranch):
    """Two coils that share flux: T* = M i₁ i₂, positive where currents in their directions support each other.

    The coils themselves are two inductors. For any pair M² ≤ L₁ L₂, and M² < L₁ L₂ unless all flux is shared.
    """

    M: Any = None
    other_charge: Any = None

    kind: ClassVar[str] = "mutual_inductance"
    plural = "Pairs of coils that share flux."
    about = "Two coils that share flux: T* = M i₁ i₂."
    entries: ClassVar[Mapping[str, Entry]] = {
        "charge": CHARGE_ENTRY,
        "other_charge": Entry(FieldKind.EXPRESSION, "The charge that flows through the other coil.", REQUIRED),
        "M": Entry(FieldKind.EXPRESSION, "Their mutual inductance; it may depend on positions.", REQUIRED),
    }
    ledger: ClassVar[Literal["T*", "V", "Ξ"]] = "T*"
    because = ("the flux that each coil sends through the other follows from the currents: its energy is in ", T)
    note = "flux that both coils share"

    def __post_init__(self) -> None:
        self._check_one_of(("M",), CURRENT_SYMBOL, "M='0.1 H', or a parameter")
        self._check_charge()
        self._check_charge("other_charge")
        if self.charge == self.other_charge:
            raise self._error(
                "both of its coils have the same charge",
                fix="name the charges of two coils; two coils in series have the inductance L1 + L2 + 2 M",
                code="E410",
            )

    @property
    def charges(self) -> tuple[sp.Expr, ...]:
        """The charges that flow through its two coils."""
        return self.charge, self.other_charge

    def suggested_name(self) -> str:
        """The symbol of the mutual inductance."""
        return self.M.name if isinstance(self.M, sp.Symbol) else ""

    def uses(self) -> Iterator[Use]:
        """Both charges; the mutual inductance, of positions and parameters."""
        yield from self.uses_of_charge()
        yield Use("other_charge", "other charge", self.other_charge, Level.POSITION)
        yield Use("M", "mutual inductance", self.M, Level.POSITION)

    def measures(self, model: Surroundings) -> Iterator[Measure]:
        """H."""
        yield from self.measure_of_charge()
        yield Measure("other charge", self.other_charge, CHARGE)
        yield Measure("mutual inductance", self.M, INDUCTANCE)

    def acts_on(self) -> None:
        """Coils are counted by their energy."""

    def other_current(self, model: Surroundings) -> sp.Expr:
        """The current of the other coil [A]."""
        return bounded.diff(model.expand(self.other_charge), time)

    def kinetic(self, model: Surroundings) -> sp.Expr:
        """T* = M i₁ i₂."""
        return model.expand(self.M) * self.current(model) * self.other_current(model)

    def masses(self, model: Surroundings) -> Iterator[MovingMass]:
        """M between the two currents."""
        M = model.expand(self.M)
        yield MovingMass((self.current(model), self.other_current(model)), ((sp.S.Zero, M), (M, sp.S.Zero)))
