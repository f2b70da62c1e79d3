"""Monomials and harmonics as single integers, and sparse polynomials over them.

A monomial ∏ g_i^e_i is the integer Σ e_i·2^(16 i) with signed exponents, so that a product of monomials is a sum of
integers, and negative exponents need no special treatment. A harmonic Σ k_j·a_j of angles is packed as the rational
number Σ k_j·P^j with a prime P, so that adding adds the multiples one by one. Its lowest multiple is known modulo P,
and a fraction of small numbers is known by its residue: k_0 = a/b where a ≡ b·h (mod P) and |a|, b < √(P/2) (Wang, Guy
and Davenport, "P-adic reconstruction of rational numbers", SIGSAM Bulletin 16, 1982). The denominator of the packed
number says nothing about them: ½ + ½P is whole.
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from functools import lru_cache
from math import gcd

from lagrangian.bounded import TooLarge

BITS = 16
"""The bits of a field; exponents and multiples stay far within ±2^15, see `LARGEST_EXPONENT`."""

LARGEST_EXPONENT = 64
"""The largest exponent of a power; a larger one is left as written."""

Packed = int | Fraction
Poly = dict[int, int]
"""A polynomial with integer coefficients: packed monomial → coefficient, none of them zero."""

PRIME = (1 << 64) - 59
"""The base in which harmonics are packed: a prime, and not 2^61 − 1, by which Python hashes whole numbers: there all
harmonics without the first angle would have one hash, and tables of them would be searched from end to end."""

SMALL = 1 << 29
"""Numerators and denominators of multiples are below this, itself below √(P/2)."""
TOO_LONG = "an angle stands in a sine or cosine with a multiple that is too long a fraction"


class OutOfReach(TooLarge):
    """An expression has no normal form of reasonable size."""


_MASK = (1 << BITS) - 1
_HALF = 1 << (BITS - 1)


@lru_cache(maxsize=1 << 16)
def digits(packed: int) -> tuple[tuple[int, int], ...]:
    """Return the fields that are not zero as pairs (index, exponent), lowest index first."""
    found: list[tuple[int, int]] = []
    i = 0
    while packed:
        e = packed & _MASK
        if e >= _HALF:
            e -= 1 << BITS
        if e:
            found.append((i, e))
        packed = (packed - e) >> BITS
        i += 1
    return tuple(found)


@lru_cache(maxsize=1 << 14)
def multiples(harmonic: Packed) -> tuple[tuple[int, Packed], ...]:
    """Return the fields of a harmonic as pairs (angle, multiple); multiples are fractions if necessary."""
    found: list[tuple[int, Packed]] = []
    rest, j = Fraction(harmonic), 0
    last = max(abs(rest.numerator), rest.denominator).bit_length() // 60 + 1
    while rest:
        if j > last:
            raise OutOfReach(TOO_LONG)
        k = _fraction(rest.numerator * pow(rest.denominator, -1, PRIME) % PRIME)
        if k:
            found.append((j, whole(k)))
        rest, j = (rest - k) / PRIME, j + 1
    return tuple(found)


def _fraction(residue: int) -> Fraction:
    """Return the fraction a/b of numbers below √(P/2) that is ``residue`` modulo P, by Euclid's algorithm."""
    if residue <= SMALL:
        return Fraction(residue)
    if PRIME - residue <= SMALL:
        return Fraction(residue - PRIME)
    a, b = (PRIME, residue), (0, 1)
    while a[1] > SMALL:
        quotient = a[0] // a[1]
        a, b = (a[1], a[0] - quotient * a[1]), (b[1], b[0] - quotient * b[1])
    if abs(b[1]) > SMALL:
        raise OutOfReach(TOO_LONG)
    return Fraction(a[1], b[1])


def turn(angle: int) -> int:
    """Return the harmonic that consists of angle number ``angle``."""
    return PRIME**angle


def whole(number: Packed) -> Packed:
    """Return a number as an integer if it is one."""
    return number if isinstance(number, int) else number.numerator if number.denominator == 1 else number


def packed(pairs: Iterable[tuple[int, Packed]]) -> Packed:
    """Return the packed number of pairs (index, exponent)."""
    total: Packed = 0
    for i, e in pairs:
        total += e * (1 << (BITS * i))
    return whole(total)


def unit(index: int) -> int:
    """Return the monomial that consists of generator ``index``."""
    return 1 << (BITS * index)


def product(p: Poly, q: Poly) -> Poly:
    """Return p·q; coefficients that cancel are left as zeros, which the caller has to remove."""
    if len(p) > len(q):
        p, q = q, p
    out: Poly = {}
    get = out.get
    for m, c in p.items():
        for n, d in q.items():
            key = m + n
            out[key] = get(key, 0) + c * d
    return out


def content(numbers: Iterable[int]) -> int:
    """Return the greatest common divisor, 0 for no numbers."""
    g = 0
    for n in numbers:
        g = gcd(g, n)
        if g == 1:
            return 1
    return g


def common_divisor(monomials: Iterable[int]) -> int:
    """Return the monomial that divides all of them: the smallest exponent of every generator, even if negative."""
    least: dict[int, int] | None = None
    for m in monomials:
        here = dict(digits(m))
        if least is None:
            least = here
            continue
        for i in list(least):
            e = min(least[i], here.pop(i, 0))
            if e:
                least[i] = e
            else:
                del least[i]
        for i, e in here.items():
            if e < 0:
                least[i] = e
        if not least:
            continue
    return int(packed((least or {}).items()))
