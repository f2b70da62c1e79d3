"""The decimals of a number that is a finite decimal: 1.25 = 5/4 has two, 1/3 has none."""

from __future__ import annotations

import sympy as sp


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
