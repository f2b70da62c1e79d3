"""Numbers and units as text: 2·10⁻⁵ and N·m, not 2e-05 and N*m."""

from __future__ import annotations

import re

from lagrangian.quantities.quantity import si_unit, unit_factor

_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_FIGURE = re.compile(r"(?<![\w.])(\d+(?:\.\d+)?)e([+-]?\d+)(?![\w.])")


def unit(words: str | None) -> str:
    """Return a unit with its exponents raised and dots between its factors: N*m/s^2 → N·m/s²."""
    dotted = re.sub(r"(?<=[\w)])\s*[* ]\s*(?=[^\W\d_])", "·", (words or "").strip())
    return re.sub(r"\^(-?\d+)", lambda m: m.group(1).translate(_RAISED), dotted)


def figure(x: float) -> str:
    """Return a number with six digits, with a power of ten if it is far from 1: 2·10⁻⁵."""
    return figures(f"{x:.6g}")


def measured(value: float, given: str | None) -> str:
    """Return an SI value in the unit in which it was given, followed by the SI value if the unit differs: 200 g (0.2
    kg)."""
    if not given:
        return figure(value)
    words, si = f"{figure(value / unit_factor(given))} {unit(given)}", si_unit(given)
    if si is None:
        return words
    rounded = figure(float(f"{value:.4g}"))
    return f"{words} ({rounded} {unit(si)})" if si else f"{words} ({rounded})"


def figures(words: str) -> str:
    """Return a text with every number in it written as ``figure`` does, with its own digits: 5.5e-16 → 5.5·10⁻¹⁶.

    A power of ten from 10⁻³ to 10³ is carried out: 1.59e-01 → 0.159.
    """
    return _FIGURE.sub(lambda m: _power_of_ten(m[1], int(m[2])), words)


def _power_of_ten(mantissa: str, exponent: int) -> str:
    if float(mantissa) == 0:
        return "0"
    if -3 <= exponent <= 3:
        digits = max(0, len(mantissa.partition(".")[2]) - exponent)
        return f"{float(mantissa) * 10.0**exponent:.{digits}f}"
    raised = f"10{str(exponent).translate(_RAISED)}"
    return raised if mantissa == "1" else f"{mantissa}·{raised}"
