"""Rotations as turns about axes, one after the other, and as matrices of numbers; right angles stay exact.

R = R(n₁, φ₁) R(n₂, φ₂) …,      R(n, φ) = 1 + sin φ [n]× + (1 − cos φ) [n]×²
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import TypeAlias

import sympy as sp

from lagrangian.records import dataclass

Vector: TypeAlias = tuple[float, float, float]
Rows: TypeAlias = tuple[Vector, Vector, Vector]

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
IDENTITY: Rows = (X, Y, Z)
ZERO: Vector = (0.0, 0.0, 0.0)

EXACT_ANGLE = 1e-11
"""An angle [rad] that is nearer than this to a multiple of 30° or 45° is that multiple: 1.57079632679 is π/2."""

_STEPS = tuple(k for k in range(1, 24) if k % 2 == 0 or k % 3 == 0)  # of 15°


@dataclass(frozen=True)
class FixedTurn:
    """A turn by a constant ``angle`` [rad] about an ``axis`` of length 1."""

    axis: Vector
    angle: float

    @property
    def exact(self) -> sp.Expr:
        """The angle as an exact number, a multiple of π where it is one."""
        steps = round(self.angle * 12 / math.pi)
        near = abs(self.angle - steps * math.pi / 12) < EXACT_ANGLE
        if near and (steps % 24 == 0 or steps % 24 in _STEPS):
            return sp.Rational(steps, 12) * sp.pi
        return sp.Rational(repr(self.angle))

    @property
    def is_none(self) -> bool:
        """Whether it is no turn at all."""
        return self.exact == 0

    @property
    def matrix(self) -> Rows:
        """R(n, φ), with exact zeros and ones at right angles."""
        exact = self.exact
        angle = exact if exact.has(sp.pi) else sp.Float(self.angle)
        c, s = float(sp.cos(angle)), float(sp.sin(angle))
        x, y, z = self.axis
        cross = ((0.0, -z, y), (z, 0.0, -x), (-y, x, 0.0))
        n = self.axis
        return _rows([[c * (i == j) + (1 - c) * n[i] * n[j] + s * cross[i][j] for j in range(3)] for i in range(3)])


def _rows(rows: Iterable[Sequence[float]]) -> Rows:
    a, b, c = ((float(x), float(y), float(z)) for x, y, z in rows)
    return a, b, c


@dataclass(frozen=True)
class FixedPose:
    """Where a frame is in another: the ``offset`` of its origin [m] and the ``turns`` of its axes, in that order."""

    offset: Vector = ZERO
    turns: tuple[FixedTurn, ...] = ()

    @property
    def matrix(self) -> Rows:
        """R, from the frame's axes to those in which it is placed."""
        made = IDENTITY
        for turn in self.turns:
            made = product(made, turn.matrix)
        return made

    def along(self, offset: Vector) -> Vector:
        """A vector along the frame's axes, in those in which it is placed; what is rounding alone is 0."""
        if not self.turns:
            return offset
        noise = 1e-15 * length(offset)
        x, y, z = (0.0 if abs(s) <= noise else float(f"{s:.15g}") for s in turned(self.matrix, offset))
        return x, y, z

    def within(self, outer: FixedPose) -> FixedPose:
        """The same pose, which is placed in another, in the axes in which that one is placed."""
        x, y, z = (a + b for a, b in zip(outer.offset, outer.along(self.offset), strict=True))
        return FixedPose((x, y, z), outer.turns + self.turns).short

    def seen_from(self, other: FixedPose) -> FixedPose:
        """This pose in the axes of another, both placed in the same axes; what is rounding alone is 0."""
        back, least = transposed(other.matrix), 1e-15 * max(1.0, length(self.offset), length(other.offset))
        apart = turned(back, [b - a for a, b in zip(other.offset, self.offset, strict=True)])
        x, y, z = (0.0 if abs(k) < least else float(f"{k:.15g}") for k in apart)
        return FixedPose((x, y, z), by_matrix(product(back, self.matrix)))

    @property
    def short(self) -> FixedPose:
        """The same pose with at most three turns: of more, the angles are found anew from the matrix."""
        if len(self.turns) <= 1:
            return self
        turns = by_matrix(self.matrix)
        return FixedPose(self.offset, turns) if len(turns) < len(self.turns) else self


def fixed_axes(roll: float, pitch: float, yaw: float) -> tuple[FixedTurn, ...]:
    """The turns of URDF's rpy: about the fixed x, y, z in this order, R = R(z, yaw) R(y, pitch) R(x, roll)."""
    made = (FixedTurn(Z, yaw), FixedTurn(Y, pitch), FixedTurn(X, roll))
    return tuple(turn for turn in made if not turn.is_none)


def by_matrix(R: Rows) -> tuple[FixedTurn, ...]:
    """The turns about z, y and x that a matrix is made of."""
    return fixed_axes(*_roll_pitch_yaw(R))


def aligned(axis: Sequence[float], angle: float) -> FixedTurn:
    """A turn about an axis of any length, which is one of x, y and z if it is within rounding of it."""
    size = length(axis)
    kept = [0.0 if abs(x) < 1e-12 * size else x / size for x in axis]
    first = next(x for x in kept if x != 0)
    if sum(x != 0 for x in kept) == 1 and first < 0:  # about −z by φ is about z by −φ
        kept, angle = [-x for x in kept], -angle
    x, y, z = (round(k) if abs(abs(k) - 1) < 1e-12 else k for k in kept)
    return FixedTurn((float(x), float(y), float(z)), angle)


def _roll_pitch_yaw(R: Rows) -> Vector:
    """The angles of R = R(z, yaw) R(y, pitch) R(x, roll); roll is 0 where the pitch is a right angle."""
    pitch = math.atan2(-R[2][0], math.hypot(R[0][0], R[1][0]))
    if math.hypot(R[0][0], R[1][0]) < 1e-9:
        return 0.0, pitch, math.atan2(-R[0][1], R[1][1])
    return math.atan2(R[2][1], R[2][2]), pitch, math.atan2(R[1][0], R[0][0])


def product(a: Rows, b: Rows) -> Rows:
    """a · b."""
    return _rows([[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)])


def transposed(a: Rows) -> Rows:
    """aᵀ."""
    return _rows(zip(*a, strict=True))


def turned(a: Rows, v: Sequence[float]) -> Vector:
    """a · v."""
    x, y, z = (sum(p * q for p, q in zip(row, v, strict=True)) for row in a)
    return x, y, z


def turned_tensor(a: Rows, inertia: Rows) -> Rows:
    """a · I · aᵀ, symmetric to the last digit; entries that are rounding alone are 0."""
    made = product(product(a, inertia), transposed(a))
    large = max(abs(x) for row in made for x in row) * 1e-15
    mean = [[(made[i][j] + made[j][i]) / 2 for j in range(3)] for i in range(3)]
    return _rows([[0.0 if abs(x) <= large else x for x in row] for row in mean])


def length(v: Sequence[float]) -> float:
    """|v|."""
    return math.hypot(*v)
