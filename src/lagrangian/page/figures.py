"""Numbers in a report: six digits, complex numbers with i."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.page.formula import Matrix

DIGITS = 6


def figure(x: float) -> str:
    """A number in a sentence or a table."""
    if x != x:
        return "–"
    if x in (float("inf"), float("-inf")):
        return "∞" if x > 0 else "−∞"
    return scientific(x, DIGITS)


def scientific(x: float, digits: int) -> str:
    """A finite number with the given number of digits, with a power of ten if it is far from 1: ``2·10⁻⁵``."""
    mantissa, e, exponent = f"{x + 0.0:.{digits}g}".replace("-", "−").partition("e")
    if not e:
        return mantissa
    power = str(int(exponent.replace("−", "-"))).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return f"{mantissa}·10{power}"


def complex_figure(z: complex) -> str:
    """A complex number in a table: ``−0.5 + 2i``."""
    if z.imag == 0:
        return figure(z.real)
    sign = "−" if z.imag < 0 else "+"
    return (f"{figure(z.real)} {sign} " if z.real else ("−" if z.imag < 0 else "")) + f"{figure(abs(z.imag))}i"


def number(x: float) -> sp.Expr:
    """A number in a formula, rounded to the digits that are shown."""
    shown = float(f"{x + 0.0:.{DIGITS}g}")
    return sp.Integer(int(shown)) if shown.is_integer() and abs(shown) < 1e6 else sp.Float(shown)


def matrix(rows: NDArray[np.float64]) -> Matrix:
    """A matrix of numbers for a formula."""
    return Matrix(tuple(tuple(number(float(x)) for x in row) for row in rows))


def plain_numbers(values: Iterable[complex]) -> list[dict[str, float]]:
    """Complex numbers as data: pairs of real and imaginary part."""
    return [{"re": float(np.real(z)) + 0.0, "im": float(np.imag(z)) + 0.0} for z in values]


def or_none(x: float) -> float | None:
    """A number as data; None if it is not finite."""
    return float(x) if np.isfinite(x) else None
