"""The coefficients of the elementary functions: minimax polynomials by Remez' exchange, in multiple precision.

``python tools/minimax.py`` prints the table in ``src/lagrangian/codegen/elementary.py``.

A polynomial P of degree n is the best approximation of f on [a, b] under the weight w exactly when the weighted error
``w(x) (f(x) − P(x))`` takes its greatest magnitude at n + 2 points with alternating signs (Chebyshev); Remez' iteration
solves for equal errors at n + 2 points, moves the points to the extremes of the error found, and repeats.
Source: E. Remez, Comptes rendus de l'Académie des Sciences 198 (1934) 2063.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import mpmath
from mpmath import mp, mpf

Real = Any  # mpmath's number; its classes have no types
DIGITS = 60


def remez(f: Callable[[Real], Real], weight: Callable[[Real], Real], a: Real, b: Real, degree: int) -> list[Real]:
    """Coefficients ``[c0, …, c_degree]`` that minimize the largest ``|weight(x) (f(x) − Σ c_k x^k)|`` on [a, b]."""
    count = degree + 2
    points = [(a + b) / 2 - (b - a) / 2 * mpmath.cos(mp.pi * k / (count - 1)) for k in range(count)]
    coefficients: list[Real] = []
    for _ in range(20):
        # Σ_j c_j x_k^j + (−1)^k E / w(x_k) = f(x_k)
        matrix = mpmath.matrix(count, count)
        right = mpmath.matrix(count, 1)
        for k, x in enumerate(points):
            for j in range(degree + 1):
                matrix[k, j] = x**j
            matrix[k, degree + 1] = (-1) ** k / weight(x)
            right[k] = f(x)
        solution = mpmath.lu_solve(matrix, right)
        coefficients = [solution[j] for j in range(degree + 1)]
        points = _extremes(lambda x, c=coefficients: weight(x) * (f(x) - horner(c, x)), a, b, points)
    return coefficients


def horner(coefficients: list[Real], x: Real) -> Real:
    """``Σ c_k x^k``."""
    value = mpf(0)
    for c in reversed(coefficients):
        value = value * x + c
    return value


def _extremes(error: Callable[[Real], Real], a: Real, b: Real, points: list[Real]) -> list[Real]:
    """Move each point except the last to the extremum of ``error`` between the midpoints to its neighbours, by golden
    section."""
    ratio = (mpmath.sqrt(5) - 1) / 2
    moved = []
    for k in range(len(points) - 1):
        sign = mpmath.sign(error(points[k]))
        low, high = (points[k - 1] + points[k]) / 2 if k else a, (points[k] + points[k + 1]) / 2
        for _ in range(60):
            x1, x2 = high - ratio * (high - low), low + ratio * (high - low)
            if sign * error(x1) > sign * error(x2):
                high = x2
            else:
                low = x1
        moved.append((low + high) / 2)
    return [*moved, b]


def split(value: Real, bits: list[int]) -> list[float]:
    """``value`` as a sum of doubles, the k-th rounded to ``bits[k]`` significant bits (a Cody–Waite split)."""
    parts = []
    for b in bits:
        scale = mpf(2) ** (b - 1 - mpmath.floor(mpmath.log(abs(value), 2)))
        part = float(mpmath.nint(value * scale) / scale)
        parts.append(part)
        value -= mpf(part)
    return parts


def targets() -> dict[str, tuple[Callable[[Real], Real], Callable[[Real], Real], Real, Real, int]]:
    """The function, weight, interval and degree of each polynomial. The weights make errors relative to the result.

    With z = r²: sin r = r + r z S(z), cos r = 1 − z/2 + z² C(z), atan r = r + r z A(z), 2 atanh r = 2r + r z L(z); exp
    r = 1 + r + r² E(r). The weights vanish at 0, where Remez' exchange cannot find an extremum, so the intervals begin
    slightly above 0.
    """
    root, late = mpmath.sqrt, 1 + mpf(2) ** -20  # reduced arguments exceed the interval by the rounding of the quotient
    quarter, eighth = (mp.pi / 4 * late) ** 2, mpmath.tan(mp.pi / 8) ** 2
    ratio = (3 - 2 * root(mpf(2))) ** 2  # ((m − 1)/(m + 1))² at m = √2
    half = mpmath.log(2) / 2 * late
    return {
        "SIN": (lambda z: (mpmath.sin(root(z)) / root(z) - 1) / z, lambda z: z, quarter / 1000, quarter, 5),
        "COS": (lambda z: (mpmath.cos(root(z)) - 1 + z / 2) / z**2, lambda z: z**2, quarter / 1000, quarter, 5),
        "EXP": (lambda r: (mpmath.exp(r) - 1 - r) / r**2, lambda r: 1, -half, half, 10),
        "ATAN": (lambda z: (mpmath.atan(root(z)) / root(z) - 1) / z, lambda z: z, eighth / 1000, eighth, 10),
        "LOG": (lambda z: (2 * mpmath.atanh(root(z)) / root(z) - 2) / z, lambda z: z, ratio / 1000, ratio, 6),
    }


def table() -> dict[str, list[float]]:
    """Every polynomial and constant of ``elementary.py``, by name."""
    numbers = {name: [float(c) for c in remez(*target)] for name, target in targets().items()}
    return numbers | {
        "HALF_PI": split(mp.pi / 2, [53, 53, 53]),
        "LN2": split(mpmath.log(2), [32, 53]),
        "HALF_PI_SHORT": split(mp.pi / 2, [33, 33, 33, 53]),
    }


def main() -> None:
    """Print the table as Python source, each number in the shortest decimal form that reads back exactly."""
    with mp.workdps(DIGITS):
        for name, numbers in table().items():
            print(f"{name} = (" + ", ".join(repr(c) for c in numbers) + ")")


if __name__ == "__main__":
    main()
