"""A resistor, linear or by its law, and a source of voltage: what takes energy out of a circuit and what feeds it."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, ClassVar, Literal

import sympy as sp

from lagrangian.model.elements.answers import CURRENT, REQUIRED, RESISTANCE, VOLTAGE, Entry, FieldKind, Measure
from lagrangian.model.elements.base import XI, Action, Level, Surroundings, Use
from lagrangian.model.elements.branch import CHARGE_ENTRY, CURRENT_SYMBOL, THROUGH, CircuitBranch
from lagrangian.model.elements.vectors import main_symbol
from lagrangian.model.geometry import as_expr
from lagrangian.records import dataclass


@dataclass(frozen=True, eq=False, kw_only=True)
class Resistor(CircuitBranch):
    """A resistor with the current i: Ξ = −R i on its charge; Rayleigh's D = ½ R i².

    ``R`` [Ω] may depend on positions (a potentiometer). ``law`` is its voltage [V] as an expression in ``current``, for
    a part whose voltage is not proportional to its current. Give exactly one of the two.
    """

    R: Any = None
    law: Any = None

    kind: ClassVar[str] = "resistor"
    plural = "Resistors."
    about = "A resistor: D = ½ R i², or by its law."
    entries: ClassVar[Mapping[str, Entry]] = {
        "charge": CHARGE_ENTRY,
        "R": Entry(FieldKind.EXPRESSION, "Its resistance; it may depend on positions."),
        "law": Entry(
            FieldKind.EXPRESSION, "Its voltage as an expression in current, instead of R.", local=(CURRENT_SYMBOL,)
        ),
    }
    ledger: ClassVar[Literal["T*", "V", "Ξ"]] = "Ξ"
    because = ("it turns energy into heat and stores none: no potential, so it is in ", XI)
    resists = True

    def __post_init__(self) -> None:
        self._check_charge()
        self._check_one_of(
            ("R", "law"), CURRENT_SYMBOL, "write R for a constant resistance, law='a*current^3' for another part"
        )

    def suggested_name(self) -> str:
        """The symbol of its resistance."""
        return self.R.name if isinstance(self.R, sp.Symbol) else ""

    def uses(self) -> Iterator[Use]:
        """The charge; the resistance, or the law, of positions and parameters."""
        yield from self.uses_of_charge()
        if self.R is not None:
            yield Use("R", "resistance", self.R, Level.POSITION)
        else:
            yield Use("law", "law", self.law, Level.POSITION, local=(CURRENT_SYMBOL,))

    def measures(self, model: Surroundings) -> Iterator[Measure]:
        """Ω; for a law V."""
        yield from self.measure_of_charge()
        if self.R is not None:
            yield Measure("resistance", self.R, RESISTANCE)
            return
        yield Measure("current", CURRENT_SYMBOL, CURRENT, local=True)
        yield Measure("law", self.law, VOLTAGE)

    def voltage(self, model: Surroundings) -> sp.Expr:
        """R i, or the law at the current [V]."""
        current = self.current(model)
        if self.R is not None:
            return model.expand(self.R) * current
        return model.expand(self.law).subs(CURRENT_SYMBOL, current)

    def works(self, model: Surroundings) -> tuple[Action, ...]:
        """The voltage against the current."""
        return (Action(-self.voltage(model), self.current(model), THROUGH, self.flowed(model)),)

    def dissipation(self, model: Surroundings) -> sp.Expr | None:
        """D = ½ R i² of a linear resistor."""
        return model.expand(self.R) * self.current(model) ** 2 / 2 if self.R is not None else None


@dataclass(frozen=True, eq=False, kw_only=True)
class VoltageSource(CircuitBranch):
    """A source of voltage, which drives its current: Ξ = u on its charge.

    ``value`` [V] is an input, or an expression in coordinates, rates, inputs and time.
    """

    value: Any = None

    kind: ClassVar[str] = "voltage_source"
    plural = "Sources of voltage."
    about = "A source of voltage, which drives the current of its branch."
    entries: ClassVar[Mapping[str, Entry]] = {
        "charge": CHARGE_ENTRY,
        "value": Entry(FieldKind.EXPRESSION, "Its voltage; positive where it drives the charge forward.", REQUIRED),
    }
    ledger: ClassVar[Literal["T*", "V", "Ξ"]] = "Ξ"
    because = ("it feeds energy in from outside: no potential, so it is in ", XI)
    resists = False

    def __post_init__(self) -> None:
        self._check_charge()
        if self.value is None:
            raise self._error("its voltage is missing", fix="value=u with an input u", code="E416")
        self._set(value=as_expr(self.value, f"the voltage of {self.title}", place=self.place))

    def suggested_name(self) -> str:
        """The symbol of its voltage."""
        return main_symbol(self.value)

    def uses(self) -> Iterator[Use]:
        """The charge; the voltage, of coordinates, rates, inputs, parameters and time."""
        yield from self.uses_of_charge()
        yield Use("value", "voltage", self.value, Level.VELOCITY, inputs=True)

    def measures(self, model: Surroundings) -> Iterator[Measure]:
        """V."""
        yield from self.measure_of_charge()
        yield Measure("voltage", self.value, VOLTAGE)

    def works(self, model: Surroundings) -> tuple[Action, ...]:
        """The voltage along the current."""
        return (Action(model.expand(self.value), self.current(model), THROUGH, self.flowed(model)),)
