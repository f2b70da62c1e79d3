"""What a unit's name means: its factor to SI and its dimension.

The symbols of mechanics are listed here; every other name is looked up in pint, one plain name at a time (pint's own
parser of unit texts evaluates expressions and never sees what people write).
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from typing import Any

from lagrangian.errors import did_you_mean

BASE = ("kg", "m", "s", "A", "K", "mol", "cd")
"""The SI base units, in the order of a dimension's exponents."""

_PINT_NAMES = ("[mass]", "[length]", "[time]", "[current]", "[temperature]", "[substance]", "[luminosity]")
MAX_NAME = 40
_NAME = re.compile(r"[^\W\d_][^\W_]*(?:_[^\W_]+)*\Z")


@dataclass(frozen=True)
class Dimension:
    """kg^a m^b s^c A^d K^e mol^f cd^g; angles have none."""

    exponents: tuple[Fraction, ...] = (Fraction(0),) * 7

    def times(self, other: Dimension, power: Fraction) -> Dimension:
        """self · other^power."""
        return Dimension(tuple(a + power * b for a, b in zip(self.exponents, other.exponents, strict=True)))

    @property
    def mechanical(self) -> tuple[Fraction, Fraction, Fraction]:
        """The exponents of kg, m and s."""
        return self.exponents[0], self.exponents[1], self.exponents[2]

    def __str__(self) -> str:
        """Read as a unit that can be read back: ``kg*m^2/s^2``, and nothing for no dimension."""
        over = [_factor(u, e) for u, e in zip(BASE, self.exponents, strict=True) if e > 0]
        under = [_factor(u, -e) for u, e in zip(BASE, self.exponents, strict=True) if e < 0]
        text = "*".join(over) or ("1" if under else "")
        return text + ("/" + ("(" + "*".join(under) + ")" if len(under) > 1 else under[0]) if under else "")


def _factor(unit: str, exponent: Fraction) -> str:
    if exponent == 1:
        return unit
    return f"{unit}^{exponent}" if exponent.denominator == 1 else f"{unit}^({exponent})"


@dataclass(frozen=True)
class Unit:
    """A unit: one of it is ``factor`` SI units of its dimension."""

    factor: Fraction
    dimension: Dimension

    def times(self, other: Unit, power: Fraction) -> Unit:
        """self · other^power; raises OverflowError where the factor leaves the range of numbers."""
        factor = other.factor ** int(power) if power.denominator == 1 else Fraction(float(other.factor) ** float(power))
        return Unit(self.factor * factor, self.dimension.times(other.dimension, power))


ONE = Unit(Fraction(1), Dimension())


def _unit(factor: str, kg: int = 0, m: int = 0, s: int = 0, A: int = 0, K: int = 0) -> Unit:
    exponents = tuple(Fraction(e) for e in (kg, m, s, A, K, 0, 0))
    return Unit(Fraction(factor), Dimension(exponents))


_DEGREE = Fraction(repr(math.pi / 180))

SYMBOLS: dict[str, Unit] = {
    "kg": _unit("1", 1),
    "g": _unit("0.001", 1),
    "m": _unit("1", 0, 1),
    "km": _unit("1000", 0, 1),
    "cm": _unit("0.01", 0, 1),
    "mm": _unit("0.001", 0, 1),
    "s": _unit("1", 0, 0, 1),
    "ms": _unit("0.001", 0, 0, 1),
    "min": _unit("60", 0, 0, 1),
    "h": _unit("3600", 0, 0, 1),
    "N": _unit("1", 1, 1, -2),
    "kN": _unit("1000", 1, 1, -2),
    "J": _unit("1", 1, 2, -2),
    "W": _unit("1", 1, 2, -3),
    "Pa": _unit("1", 1, -1, -2),
    "Hz": _unit("1", 0, 0, -1),
    "rad": _unit("1"),
    "deg": Unit(_DEGREE, Dimension()),
    "°": Unit(_DEGREE, Dimension()),
    "A": _unit("1", 0, 0, 0, 1),
    "V": _unit("1", 1, 2, -3, -1),
    "Ω": _unit("1", 1, 2, -3, -2),
    "K": _unit("1", 0, 0, 0, 0, 1),
}
"""The symbols of everyday mechanics; a test holds every line against pint."""

_COMMON = (
    *SYMBOLS,
    "mN",
    "MN",
    "MPa",
    "kJ",
    "kW",
    "mg",
    "inch",
    "ft",
    "lb",
    "lbf",
    "slug",
    "rpm",
    "degree",
    "hour",
    "minute",
)
_SPELLING = {"Kg": "kg", "KG": "kg", "Nm": "N*m", "NM": "N*m", "M": "m", "sec": "s", "grad": "rad", "RAD": "rad"}


@cache
def registry() -> Any:
    """Return pint's registry of units, made once when first needed."""
    import pint

    return pint.UnitRegistry()


@cache
def lookup(name: str) -> Unit | None:
    """Return the unit of one plain name, or None for an unknown one.

    Raises ValueError for a unit whose zero is not zero (°C, dB).
    """
    name = name.replace("µ", "μ").replace("\u2126", "Ω")
    if name in SYMBOLS:
        return SYMBOLS[name]
    if len(name) > MAX_NAME or not _NAME.match(name) or name in _SPELLING:
        return None
    import pint

    units = registry()
    try:
        unit = units.Unit(name)
    except (pint.UndefinedUnitError, pint.DefinitionSyntaxError, ValueError, AttributeError, TypeError):
        return None
    none, one, two = (units.Quantity(float(x), unit).to_base_units().magnitude for x in (0, 1, 2))
    if none != 0 or not math.isclose(two, 2 * one):
        raise ValueError(name)
    exponents = dict(unit.dimensionality)
    if not exponents.keys() <= set(_PINT_NAMES):
        return None
    powers = tuple(Fraction(exponents.get(d, 0)).limit_denominator(100) for d in _PINT_NAMES)
    return Unit(Fraction(repr(float(one))), Dimension(powers))


def similar(name: str) -> str | None:
    """Say which unit was probably meant."""
    if name in _SPELLING:
        return f"write {_SPELLING[name]}"
    if (match := re.fullmatch(r"([^\W\d_]+)([0-9])", name)) and lookup(match.group(1)):
        return f"write {match.group(1)}^{match.group(2)}"
    lower = {c.lower(): c for c in _COMMON}
    if name.lower() in lower:
        return f"Did you mean '{lower[name.lower()]}'?"
    return did_you_mean(name, _COMMON)
