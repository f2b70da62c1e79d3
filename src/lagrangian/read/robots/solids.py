"""Mass, centre and inertia of solids of even density, and of several of them together.

J = Σ (R J_b Rᵀ + m_b (d² 1 − d dᵀ)),   d from the common centre of mass to that of b
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from lagrangian.read.robots.rotations import Rows, Vector, turned, turned_tensor
from lagrangian.records import dataclass


@dataclass(frozen=True)
class Solid:
    """A mass [kg], its centre [m] and its inertia about it [kg m²], in the axes of a body."""

    mass: float
    centre: Vector
    inertia: Rows

    def placed(self, centre: Vector, axes: Rows) -> Solid:
        """The same solid with its centre and its axes elsewhere."""
        return Solid(self.mass, centre, turned_tensor(axes, self.inertia))

    def within(self, offset: Vector, axes: Rows) -> Solid:
        """The same solid where its axes are placed at ``offset``: its centre moves with them."""
        x, y, z = (a + b for a, b in zip(offset, turned(axes, self.centre), strict=True))
        return self.placed((x, y, z), axes)

    def scaled(self, factor: float) -> Solid:
        """The same shape with another density."""
        a, b, c = ((x * factor, y * factor, z * factor) for x, y, z in self.inertia)
        return Solid(self.mass * factor, self.centre, (a, b, c))


def together(solids: Sequence[Solid]) -> Solid:
    """Several solids as one."""
    mass = sum(s.mass for s in solids)
    x, y, z = (sum(s.mass * s.centre[k] for s in solids) / mass for k in range(3))
    rows = [[0.0] * 3 for _ in range(3)]
    for s in solids:
        d = (s.centre[0] - x, s.centre[1] - y, s.centre[2] - z)
        square = sum(k * k for k in d)
        for i in range(3):
            for j in range(3):
                rows[i][j] += s.inertia[i][j] + s.mass * (square * (i == j) - d[i] * d[j])
    a, b, c = ((row[0], row[1], row[2]) for row in rows)
    return Solid(mass, (x, y, z), (a, b, c))


def volume(kind: str, size: Sequence[float]) -> float:
    """The volume [m³] of a solid: sizes are radii and half lengths, as MuJoCo has them."""
    a, b, c = size
    return {
        "sphere": 4 / 3 * math.pi * a**3,
        "ellipsoid": 4 / 3 * math.pi * a * b * c,
        "box": 8 * a * b * c,
        "cylinder": 2 * math.pi * a**2 * b,
        "capsule": 2 * math.pi * a**2 * b + 4 / 3 * math.pi * a**3,
    }[kind]


def solid(kind: str, size: Sequence[float], mass: float) -> Solid:
    """A solid with its centre at the origin and its axis along z."""
    a, b, c = size
    if kind == "sphere":
        moments = [2 / 5 * mass * a**2] * 3
    elif kind in ("ellipsoid", "box"):
        share = mass / (5 if kind == "ellipsoid" else 3)
        moments = [share * (b**2 + c**2), share * (a**2 + c**2), share * (a**2 + b**2)]
    else:  # a cylinder of radius a and half length b, and for a capsule two half balls at its ends
        barrel = mass * (2 * b) / (2 * b + 4 / 3 * a) if kind == "capsule" else mass
        ends = mass - barrel
        across = barrel * (3 * a**2 + 4 * b**2) / 12 + ends * (2 / 5 * a**2 + b**2 + 3 / 4 * a * b)
        moments = [across, across, barrel * a**2 / 2 + ends * 2 / 5 * a**2]
    return Solid(mass, (0.0, 0.0, 0.0), ((moments[0], 0.0, 0.0), (0.0, moments[1], 0.0), (0.0, 0.0, moments[2])))
