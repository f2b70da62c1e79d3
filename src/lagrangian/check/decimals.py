"""The decimals of a number that is a finite decimal: 1.25 = 5/4 has two, 1/3 has none."""

from __future__ import annotations

import sympy as sp

HALF = 0.5000001
"""How far a number that is rounded may be off, in units of its last digit."""
FEWEST_OFF, MOST_OFF = 5, 2.5
"""From how many digits on the last one may be off, as if made from rounded numbers, and by how many units."""
WHOLE = 1e-8
"""How far, in parts of its size, a number may be from one that needs no rounding."""


def places(x: sp.Rational) -> int | None:
    """How many decimals a number has, max(a, b) where its denominator is 2ᵃ 5ᵇ; None if they do not end."""
    below, powers = int(x.q), {2: 0, 5: 0}
    for prime in powers:
        while below % prime == 0:
            below, powers[prime] = below // prime, powers[prime] + 1
    return max(powers.values()) if below == 1 else None


def digits(x: sp.Rational, after: int) -> int:
    """How many significant digits a number has that is written with ``after`` decimals: 0.0125 has three."""
    return len(str(abs(int(x.p)) * 10**after // int(x.q)))


def most_off(size: float, unit: float, exact: float) -> float:
    """How far a number with such a last digit may be off in a line that is otherwise right; 2.0001 is not 2."""
    whole = abs(exact / unit - round(exact / unit)) <= WHOLE * abs(exact) / unit
    return unit * (HALF if whole or size < 10 ** (FEWEST_OFF - 1) * unit else MOST_OFF)
