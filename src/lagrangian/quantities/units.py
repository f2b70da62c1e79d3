"""The table of units: for each name its factor to SI, its dimension, and its SI unit.

The table contains every unit that is accepted: those found in mechanics books. Any other name is refused, so that a
typing mistake ("gr", "Kg", "c") never becomes another unit; `unit_hints` suggests the unit that was probably meant.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from fractions import Fraction
from functools import cache

from lagrangian.records import dataclass

BASE = ("kg", "m", "s", "A", "K", "mol", "cd")
"""The SI base units, in the order of the exponents of a dimension."""

COHERENT: dict[str, tuple[int, ...]] = {
    "kg": (1,),
    "m": (0, 1),
    "s": (0, 0, 1),
    "A": (0, 0, 0, 1),
    "K": (0, 0, 0, 0, 1),
    "mol": (0, 0, 0, 0, 0, 1),
    "cd": (0, 0, 0, 0, 0, 0, 1),
    "rad": (),
    "Hz": (0, 0, -1),
    "N": (1, 1, -2),
    "Pa": (1, -1, -2),
    "J": (1, 2, -2),
    "W": (1, 2, -3),
    "C": (0, 0, 1, 1),
    "V": (1, 2, -3, -1),
    "F": (-1, -2, 4, 2),
    "Ω": (1, 2, -3, -2),
    "S": (-1, -2, 3, 2),
    "Wb": (1, 2, -2, -1),
    "T": (1, 0, -2, -1),
    "H": (1, 2, -2, -2),
}
"""The SI units that are products of base units with factor 1: exponents of `BASE`, without trailing zeros."""

PREFIXES = {
    **{"p": -12, "n": -9, "µ": -6, "u": -6, "m": -3, "c": -2, "d": -1},
    **{"da": 1, "h": 2, "k": 3, "M": 6, "G": 9, "T": 12},
}
"""Powers of ten; u means µ."""

_FOOT, _INCH, _MILE = Fraction("0.3048"), Fraction("0.0254"), Fraction("1609.344")
_POUND, _GRAVITY = Fraction("0.45359237"), Fraction("9.80665")
_LBF = _POUND * _GRAVITY
_PI = Fraction(repr(math.pi))
_JOINED = re.compile(r"(N|V|A|W|J|kg)(m)?(s)?")
_MANY, _FEW = "T G M k m µ u n p", "k m µ u"

TABLE: tuple[tuple[str, str, Fraction | int | str, str, str], ...] = (
    # symbols, words, the value of one in these SI units, prefixes of the symbols
    # length: Mm and Gm are too similar to mm and gm
    ("m", "metre metres meter meters", 1, "m", "k h da d c m µ u n p"),
    ("", "kilometre kilometres kilometer kilometers", 1000, "m", ""),
    ("", "centimetre centimetres centimeter centimeters", "0.01", "m", ""),
    ("", "millimetre millimetres millimeter millimeters", "0.001", "m", ""),
    ("in", "inch inches", _INCH, "m", ""),
    ("ft", "foot feet", _FOOT, "m", ""),
    ("yd", "yard yards", 3 * _FOOT, "m", ""),
    ("mi", "mile miles", _MILE, "m", ""),
    ("nmi", "", 1852, "m", ""),
    # mass: Mg is too similar to mg
    ("kg", "kilogram kilograms", 1, "kg", ""),
    ("g", "gram grams", "0.001", "kg", "m µ u n"),
    ("t", "tonne tonnes", 1000, "kg", ""),
    ("lb lbm", "", _POUND, "kg", ""),
    ("oz", "", _POUND / 16, "kg", ""),
    ("slug", "slugs", _LBF / _FOOT, "kg", ""),
    # time
    ("s", "second seconds", 1, "s", "m µ u n p"),
    ("min", "minute minutes", 60, "s", ""),
    ("h", "hour hours", 3600, "s", ""),
    ("d", "day days", 86400, "s", ""),
    # angle and rotation
    ("rad", "radian radians", 1, "rad", "m µ u"),
    ("deg °", "degree degrees", _PI / 180, "rad", ""),
    ("arcmin", "", _PI / 10800, "rad", ""),
    ("arcsec", "", _PI / 648000, "rad", ""),
    ("rev", "revolution revolutions turn turns", 2 * _PI, "rad", ""),
    ("rpm", "", _PI / 30, "rad/s", ""),
    ("Hz", "hertz", 1, "Hz", "G M k m"),
    # speed
    ("mph", "", _MILE / 3600, "m/s", ""),
    ("", "knot knots", Fraction(1852, 3600), "m/s", ""),
    # force
    ("N", "newton newtons", 1, "N", "T G M k d c m µ u n p"),
    ("lbf", "", _LBF, "N", ""),
    ("kip", "kips", 1000 * _LBF, "N", ""),
    ("kgf", "", _GRAVITY, "N", ""),
    ("dyn", "dyne dynes", "1e-5", "N", ""),
    # pressure
    ("Pa", "pascal pascals", 1, "Pa", "G M k h m µ u"),
    ("bar", "", 100000, "Pa", "k m"),
    ("atm", "", 101325, "Pa", ""),
    ("psi", "", _LBF / _INCH**2, "Pa", ""),
    ("ksi", "", 1000 * _LBF / _INCH**2, "Pa", ""),
    ("mmHg", "", "133.322387415", "Pa", ""),
    # energy, power
    ("J", "joule joules", 1, "J", _MANY),
    ("erg", "ergs", "1e-7", "J", ""),
    ("W", "watt watts", 1, "W", _MANY),
    ("hp", "horsepower", 550 * _FOOT * _LBF, "W", ""),
    # volume
    ("L l", "litre litres liter liters", "0.001", "m^3", "h d c m µ u"),
    # electricity, and the other base units
    ("A", "ampere amperes", 1, "A", _MANY),
    ("V", "volt volts", 1, "V", _MANY),
    ("Ω ohm", "ohms", 1, "Ω", _MANY),
    ("S", "siemens", 1, "S", _FEW),
    ("F", "farad farads", 1, "F", "m µ u n p"),
    ("H", "henry henrys henries", 1, "H", "m µ u n"),
    ("C", "coulomb coulombs", 1, "C", "k m µ u n p"),
    ("T", "tesla teslas", 1, "T", "m µ u n"),
    ("Wb", "weber webers", 1, "Wb", "m µ u"),
    ("K", "kelvin kelvins", 1, "K", "m µ u"),
    ("mol", "mole moles", 1, "mol", _FEW),
    ("cd", "candela candelas", 1, "cd", ""),
)
"""Every unit that is accepted, following NIST Special Publication 811."""

_SHORT = "kg g m km cm mm s ms min h N kN J W Pa Hz rad deg ° A V Ω K"
BEFORE_WORDS = frozenset(_SHORT.split())  # not T, F, H, in, t: words begin with these
"""Symbols that are read as a unit before a comma and words, as in ``"N, pushes the carts apart"``."""


@dataclass(frozen=True)
class Dimension:
    """A dimension kg^a m^b s^c A^d K^e mol^f cd^g; angles have none."""

    exponents: tuple[Fraction, ...] = (Fraction(0),) * 7

    def times(self, other: Dimension, power: Fraction) -> Dimension:
        """self · other^power."""
        return Dimension(tuple(a + power * b for a, b in zip(self.exponents, other.exponents, strict=True)))

    def __str__(self) -> str:
        """Return a unit that can be read back: ``kg*m^2/s^2``, or nothing for no dimension."""
        return _product(zip(BASE, self.exponents, strict=True))


def _product(powers: Iterable[tuple[str, Fraction]]) -> str:
    listed = list(powers)
    over = [_factor(u, e) for u, e in listed if e > 0]
    under = [_factor(u, -e) for u, e in listed if e < 0]
    text = "*".join(over) or ("1" if under else "")
    return text + ("/" + ("(" + "*".join(under) + ")" if len(under) > 1 else under[0]) if under else "")


def _factor(unit: str, exponent: Fraction) -> str:
    if exponent == 1:
        return unit
    return f"{unit}^{exponent}" if exponent.denominator == 1 else f"{unit}^({exponent})"


@dataclass(frozen=True)
class Unit:
    """A unit: one of it equals ``factor`` SI units of its dimension.

    ``powers`` are the SI units to which it is converted, such as N and m for lbf·ft; ``plain`` says whether it consists
    of SI units with factor 1.
    """

    factor: Fraction
    dimension: Dimension
    powers: tuple[tuple[str, Fraction], ...] = ()
    plain: bool = True

    def times(self, other: Unit, power: Fraction) -> Unit:
        """Return self · other^power; raises OverflowError if the factor leaves the range of numbers."""
        factor = other.factor ** int(power) if power.denominator == 1 else Fraction(float(other.factor) ** float(power))
        powers = dict(self.powers)
        for name, exponent in other.powers:
            powers[name] = powers.get(name, Fraction(0)) + power * exponent
        return Unit(
            self.factor * factor,
            self.dimension.times(other.dimension, power),
            tuple((name, exponent) for name, exponent in powers.items() if exponent),
            self.plain and other.plain,
        )

    @property
    def si(self) -> str:
        """The SI unit to which its values are converted: ``rad/s`` for rpm, ``N*m`` for lbf*ft."""
        return _product(self.powers)


ONE = Unit(Fraction(1), Dimension())


def _coherent(text: str) -> Unit:
    """A product of SI units with factor 1, as the table writes it: ``rad/s``, ``m^3``."""
    unit, sign = ONE, 1
    for part in text.replace("/", " / ").split():
        if part == "/":
            sign = -1
            continue
        name, _, power = part.partition("^")
        exponents = (*COHERENT[name], 0, 0, 0, 0, 0, 0, 0)[:7]
        one = Unit(Fraction(1), Dimension(tuple(map(Fraction, exponents))), ((name, Fraction(1)),))
        unit = unit.times(one, Fraction(sign * int(power or 1)))
    return unit


@cache
def units() -> dict[str, Unit]:
    """Every unit that is accepted, by each of its names."""
    found: dict[str, Unit] = {}
    for symbols, words, number, text, prefixes in TABLE:
        one, factor = _coherent(text), Fraction(number)
        for name in (*symbols.split(), *words.split()):
            found[name] = Unit(factor, one.dimension, one.powers, factor == 1)
        for name in symbols.split():
            for prefix in prefixes.split():
                scaled = factor * Fraction(10) ** PREFIXES[prefix]
                found[prefix + name] = Unit(scaled, one.dimension, one.powers, plain=False)
    return found


def lookup(name: str) -> Unit | None:
    """Return the unit with a name, or None if there is none."""
    return units().get(name.replace("\u03bc", "µ").replace("\u2126", "Ω"))


def joined(word: str) -> tuple[str, ...]:
    """Return the SI units that stand in a word without a sign between them, N, m and s of Nms; nothing if it is none.

    What has a prefix, or can be read with one, is not taken apart: Nmm.
    """
    found = _JOINED.fullmatch(word)
    return tuple(x for x in found.groups() if x) if found is not None and lookup(word) is None else ()
