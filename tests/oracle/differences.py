"""Lagrange's equations by difference quotients of 60 digits: an oracle that shares nothing with the package.

A system is what its masses, springs and forces are as functions of numbers. Velocities, turns, momenta, their rates and
slopes all come from quotients

    df/ds ≈ (f(s + h) − f(s − h)) / 2h,    error O(h²)

whose widths are spread so far apart that 60 digits leave about 15 at the end.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import mpmath as mp

DIGITS = 60
VELOCITY, MOMENTUM, SLOPE = mp.mpf(10) ** -18, mp.mpf(10) ** -9, mp.mpf(10) ** -9

Vector = list[Any]
Place = Callable[[Vector, Any], Vector]
Turn = Callable[[Vector, Any], list[Vector]]
Scalar = Callable[[Vector, Any], Any]
OfMotion = Callable[[Vector, Vector, Any], Any]


def dot(a: Sequence[Any], b: Sequence[Any]) -> Any:
    return sum((x * y for x, y in zip(a, b, strict=True)), mp.mpf(0))


def times(R: Sequence[Vector], x: Vector) -> Vector:
    return [dot(row, x) for row in R]


def transposed(R: Sequence[Vector]) -> list[Vector]:
    return [list(column) for column in zip(*R, strict=True)]


def quotient(f: Callable[[Any], Any], h: Any) -> Any:
    """df/ds at s = 0, of a number, a vector or a matrix."""
    return over(difference(f(h), f(-h)), 2 * h)


def difference(a: Any, b: Any) -> Any:
    return [difference(x, y) for x, y in zip(a, b, strict=True)] if isinstance(a, list) else a - b


def over(a: Any, d: Any) -> Any:
    return [over(x, d) for x in a] if isinstance(a, list) else a / d


def moved(x: Vector, direction: Vector, s: Any) -> Vector:
    return [a + s * b for a, b in zip(x, direction, strict=True)]


def unit(n: int, k: int) -> Vector:
    return [mp.mpf(1) if i == k else mp.mpf(0) for i in range(n)]


@dataclass
class Mechanism:
    """Masses, stores and efforts as functions of (q, t), or of (q, v, t) where rates matter.

    ``bodies``: mass, inertia in the body's own axes (matrix), place, turn (matrix fixed ← body); inertia and turn are
    None for a point mass. ``forces``: (F, place), F in the fixed axes; ``torques``: (effort, angle);
    ``moments``: (vector in the fixed axes, turn); ``losses``: dissipation functions D, Ξ_i = −∂D/∂v_i.
    """

    n: int
    bodies: list[tuple[Any, Any, Place, Turn | None]] = field(default_factory=list)
    kinetics: list[OfMotion] = field(default_factory=list)
    potentials: list[Scalar] = field(default_factory=list)
    forces: list[tuple[OfMotion, Place]] = field(default_factory=list)
    torques: list[tuple[OfMotion, Scalar]] = field(default_factory=list)
    moments: list[tuple[OfMotion, Turn]] = field(default_factory=list)
    losses: list[OfMotion] = field(default_factory=list)
    direct: list[tuple[int, OfMotion]] = field(default_factory=list)

    def along(self, f: Callable[[Vector, Any], Any], q: Vector, v: Vector, t: Any) -> Any:
        """df/dt along a motion."""
        return quotient(lambda s: f(moved(q, v, s), t + s), VELOCITY)

    def turning(self, turn: Turn, q: Vector, v: Vector, t: Any) -> Vector:
        """ω in the fixed axes: Ṙ Rᵀ is the matrix of ω×."""
        S = [times(turn(q, t), row) for row in self.along(turn, q, v, t)]  # row i: Σ_k R_jk Ṙ_ik = (Ṙ Rᵀ)_ij
        return [S[2][1], S[0][2], S[1][0]]

    def T(self, q: Vector, v: Vector, t: Any) -> Any:
        """Kinetic co-energy."""
        total = mp.mpf(0)
        for mass, inertia, place, turn in self.bodies:
            velocity = self.along(place, q, v, t)
            total += mass * dot(velocity, velocity) / 2
            if turn is not None:
                w = times(transposed(turn(q, t)), self.turning(turn, q, v, t))
                total += dot(w, times(inertia, w)) / 2
        return total + sum((f(q, v, t) for f in self.kinetics), mp.mpf(0))

    def V(self, q: Vector, t: Any) -> Any:
        """Potential energy."""
        return sum((f(q, t) for f in self.potentials), mp.mpf(0))

    def momentum(self, i: int, q: Vector, v: Vector, t: Any) -> Any:
        """∂T/∂v_i."""
        return quotient(lambda s: self.T(q, moved(v, unit(self.n, i), s), t), MOMENTUM)

    def mass_matrix(self, q: Vector, t: Any) -> list[Vector]:
        """∂²T/∂v_i∂v_k: T is quadratic in v, T(v) = T₀ + b·v + ½ v·M v, so M comes out of its values."""
        n, rest = self.n, [mp.mpf(0)] * self.n
        T0 = self.T(q, rest, t)
        plus = [self.T(q, unit(n, i), t) for i in range(n)]
        minus = [self.T(q, [-x for x in unit(n, i)], t) for i in range(n)]
        M = [[mp.mpf(0)] * n for _ in range(n)]
        for i in range(n):
            M[i][i] = plus[i] + minus[i] - 2 * T0
            for k in range(i):
                both = self.T(q, moved(unit(n, i), unit(n, k), 1), t)
                M[i][k] = M[k][i] = both - plus[i] - plus[k] + T0
        return M

    def residual(self, q: Vector, v: Vector, a: Vector, t: Any) -> Vector:
        """d/dt ∂L/∂v − ∂L/∂q − Ξ."""
        found = []
        for i in range(self.n):
            e = unit(self.n, i)

            def momentum(s: Any, i: int = i) -> Any:
                return self.momentum(i, moved(q, v, s), moved(v, a, s), t + s)

            def lagrangian(s: Any, e: Vector = e) -> Any:
                return self.T(moved(q, e, s), v, t) - self.V(moved(q, e, s), t)

            found.append(quotient(momentum, SLOPE) - quotient(lagrangian, SLOPE) - self.Xi(i, q, v, t))
        return found

    def gravity(self, q: Vector, t: Any) -> Vector:
        """∂V/∂q."""
        return [quotient(lambda s, i=i: self.V(moved(q, unit(self.n, i), s), t), SLOPE) for i in range(self.n)]

    def Xi(self, i: int, q: Vector, v: Vector, t: Any) -> Any:
        """The generalized force of everything that acts, by virtual work."""
        e, rest = unit(self.n, i), mp.mpf(0)
        total = mp.mpf(0)
        for force, place in self.forces:
            total += dot(force(q, v, t), quotient(lambda s, f=place: f(moved(q, e, s), t), SLOPE))
        for effort, angle in self.torques:
            total += effort(q, v, t) * quotient(lambda s, f=angle: f(moved(q, e, s), t), SLOPE)
        for moment, turn in self.moments:
            virtual = Mechanism(self.n).turning(lambda x, _, f=turn: f(x, t), q, e, rest)
            total += dot(moment(q, v, t), virtual)
        for loss in self.losses:
            total -= quotient(lambda s, f=loss: f(q, moved(v, e, s), t), SLOPE)
        return total + sum((f(q, v, t) for k, f in self.direct if k == i), mp.mpf(0))

    def accelerations(self, q: Vector, v: Vector, t: Any) -> Vector:
        """The a at which the residual vanishes: M a = −residual(0)."""
        bias = self.residual(q, v, [mp.mpf(0)] * self.n, t)
        return list(mp.lu_solve(mp.matrix(self.mass_matrix(q, t)), -mp.matrix(bias)))
