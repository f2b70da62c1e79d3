"""Arithmetic modulo a prime P that is kind to mechanics: roots, points of a circle, ranks without rounding.

P + 1 is divisible by 16, 9 and all primes to 47. By quadratic reciprocity 2, 3, 5, … 47 are then squares and −1 is not,
as among the reals, and √2 √3 = √6 holds for the roots that are chosen. The circle c² + s² = 1 is a group of P + 1
points, so that it holds the multiples of half a degree. (Modulo the more common 2^61 − 1 there is neither √3 nor a
sine of 60 degrees.)
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from math import gcd

SMOOTH = 14_757_354_782_123_793_840
"""16 · 9 · 5 · 7 · 11 · … · 47."""

PRIMES = tuple(k * SMOOTH - 1 for k in (6, 22, 23, 30))
"""The primes that are used, one after the other: what is no square modulo one may be a square modulo the next."""

QUARTER_DEGREES = 360
"""π is the multiple of this many angles whose sines the field holds: of half a degree."""

Circle = tuple[int, int]
"""A point (c, s) of the circle: the cosine and the sine of an angle."""


def root(x: int, q: int, p: int) -> int | None:
    """Return the q-th root of x modulo p, or None if x has none; if there are several, always the same one.

    Square roots are x^((p + 1)/4), which is multiplicative. For another prime q, p − 1 = q^s m: x^(1/q mod m) is a root
    except for a factor of order q^s; these few numbers are tried in order.
    """
    for factor in _prime_factors(q):
        found = _square_root(x, p) if factor == 2 else _prime_root(x, factor, p)
        if found is None:
            return None
        x = found
    return x


def _square_root(x: int, p: int) -> int | None:
    y = pow(x, (p + 1) // 4, p)
    return y if y * y % p == x % p else None


def _prime_root(x: int, q: int, p: int) -> int | None:
    m, order = p - 1, 1
    while m % q == 0:
        m, order = m // q, order * q
    guess = pow(x, pow(q, -1, m), p)
    generator = next(g for g in (pow(a, m, p) for a in range(2, p)) if order == 1 or pow(g, order // q, p) != 1)
    candidate = guess
    for _ in range(order):
        if pow(candidate, q, p) == x % p:
            return candidate
        candidate = candidate * generator % p
    return None


def _prime_factors(n: int) -> list[int]:
    found: list[int] = []
    k = 2
    while k * k <= n:
        while n % k == 0:
            found.append(k)
            n //= k
        k += 1
    return [*found, n] if n > 1 else found


# -- the circle ---------------------------------------------------------------------------------------------------


def added(a: Circle, b: Circle, p: int) -> Circle:
    """Return the point of the sum of two angles."""
    return (a[0] * b[0] - a[1] * b[1]) % p, (a[0] * b[1] + a[1] * b[0]) % p


def multiple(a: Circle, n: int, p: int) -> Circle:
    """Return the point of n times an angle."""
    if n < 0:
        a, n = (a[0], -a[1] % p), -n
    result = (1, 0)
    while n:
        if n & 1:
            result = added(result, a, p)
        a = added(a, a, p)
        n >>= 1
    return result


def random_angle(draw: random.Random, p: int) -> Circle:
    """Return a random point of the circle, ((1 − t²)/(1 + t²), 2t/(1 + t²))."""
    t = draw.randrange(p)
    below = pow(1 + t * t, -1, p)  # −1 is no square
    return (1 - t * t) * below % p, 2 * t * below % p


def half_turn(parts: int, p: int) -> Circle | None:
    """Return the point of the angle π/parts, or None if the field has none.

    It is the one whose multiples have cos 45° = √2/2, cos 30° = √3/2, sin 30° = ½ and cos 36° = (1 + √5)/4. ``parts``
    is a multiple of `QUARTER_DEGREES`.
    """
    order = 2 * parts
    if (p + 1) % order:
        return None
    draw = random.Random(order)
    primes = set(_prime_factors(order))
    point = (1, 0)
    while any(multiple(point, order // q, p) == (1, 0) for q in primes):
        point = multiple(random_angle(draw, p), (p + 1) // order, p)
    half = pow(2, -1, p)
    cosines = [(4, _root_of(2, p) * half), (6, _root_of(3, p) * half), (5, (1 + _root_of(5, p)) * half * half)]
    for k in range(1, order):
        if gcd(k, order) == 1:
            other = multiple(point, k, p)
            right = all(multiple(other, parts // n, p)[0] == c % p for n, c in cosines)
            if right and multiple(other, parts // 6, p)[1] == half:
                return other
    raise AssertionError("no primitive root of unity has the signs of the square roots")


def _root_of(x: int, p: int) -> int:
    y = _square_root(x, p)
    assert y is not None
    return y


# -- ranks --------------------------------------------------------------------------------------------------------


class Echelon:
    """Rows in echelon form modulo p, taken one after another, each with the combination of stored rows that it lost."""

    def __init__(self, p: int) -> None:
        self.p = p
        self._rows: list[tuple[int, list[int], dict[int, int]]] = []

    def __len__(self) -> int:
        """The rank so far."""
        return len(self._rows)

    @property
    def pivots(self) -> list[int]:
        """The column of every row's leading entry."""
        return [pivot for pivot, _, _ in self._rows]

    def reduce(self, row: Sequence[int]) -> tuple[list[int], dict[int, int]]:
        """Return what remains of a row, and the combination of the stored rows (by name) that was subtracted."""
        p, left = self.p, [x % self.p for x in row]
        lost: dict[int, int] = {}
        for pivot, kept, made in self._rows:
            if factor := left[pivot]:
                left = [(a - factor * b) % p for a, b in zip(left, kept, strict=True)]
                for name, share in made.items():
                    lost[name] = (lost.get(name, 0) + factor * share) % p
        return left, {name: share for name, share in lost.items() if share}

    def reduced(self) -> dict[int, list[int]]:
        """Return the rows by the columns of their leading entries, which are the only entries of those columns."""
        p, rows = self.p, {pivot: row for pivot, row, _ in self._rows}
        for pivot, below in rows.items():
            for other, row in rows.items():
                if other != pivot and (factor := row[pivot]):
                    rows[other] = [(a - factor * b) % p for a, b in zip(row, below, strict=True)]
        return rows

    def take(self, name: int, row: Sequence[int]) -> bool:
        """Store a row under a name if it is independent."""
        left, lost = self.reduce(row)
        pivot = next((k for k, x in enumerate(left) if x), None)
        if pivot is None:
            return False
        scale = pow(left[pivot], -1, self.p)
        made = {k: -share * scale % self.p for k, share in lost.items()}
        made[name] = scale
        self._rows.append((pivot, [x * scale % self.p for x in left], made))
        return True
