"""The variables of a frame with a quaternion, which floats in space or turns freely in a ball joint.

    a floating frame:    q = (x, y, z, qx, qy, qz, qw)      u = (vx, vy, vz, wx, wy, wz)
    in a ball joint:     q = (qx, qy, qz, qw)               u = (wx, wy, wz)

q contains the position of the frame's origin in the fixed axes, and the quaternion, scalar part last, for the rotation
from the frame's axes to those of its parent (the fixed axes, for a floating frame); it may have any length but 0. u
contains the velocity of the origin and the angular velocity relative to the parent, both with components in the frame's
own axes. Pinocchio's free-flyer and spherical joint use the same order and axes.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

from typing import cast

import sympy as sp

from lagrangian.errors import Place
from lagrangian.model.names import moving_symbol
from lagrangian.model.symbols import Coordinate, Velocity
from lagrangian.records import dataclass


@dataclass(frozen=True)
class Floating:
    """The coordinates q and the quasi-velocities u of a frame that floats, or turns in a ball joint."""

    coordinates: tuple[Coordinate, ...]
    velocities: tuple[Velocity, ...]

    @classmethod
    def named(cls, name: str, place: Place | None = None, *, held: bool = False) -> Floating:
        """The variables of the frame ``name``: ``name_x``, ``name_qx``, ``name_vx``, ``name_wx`` and so on.

        A frame that is ``held`` by a ball joint has none of position and velocity.
        """
        rows: list[tuple[str, str, str | None]] = []
        rates: list[tuple[str, str, str]] = []
        if not held:
            rows += [(k, f"{k} of the origin of {name}", "m") for k in "xyz"]
            rates += [(f"v{k}", f"velocity of the origin of {name} along its own {k}", "m/s") for k in "xyz"]
        rows += [(f"q{k}", f"quaternion of {name}, part along {k}", None) for k in "xyz"]
        rows += [("qw", f"quaternion of {name}, scalar part", None)]
        joint = " in its joint" if held else ""
        rates += [(f"w{k}", f"angular velocity of {name}{joint} about its own {k}", "rad/s") for k in "xyz"]
        return cls(
            tuple(
                Coordinate(f"{name}_{key}", moving_symbol(f"{name}_{key}"), words, unit, place, float(key == "qw"))
                for key, words, unit in rows
            ),
            tuple(
                Velocity(f"{name}_{key}", moving_symbol(f"{name}_{key}"), words, unit, place)
                for key, words, unit in rates
            ),
        )

    @property
    def held(self) -> bool:
        """Whether it turns in a ball joint, about a point that its parent carries, rather than floats."""
        return len(self.velocities) == 3

    @property
    def orientation(self) -> tuple[Coordinate, ...]:
        """The four coordinates of the quaternion."""
        return self.coordinates[-4:]

    @property
    def turning(self) -> tuple[Velocity, ...]:
        """The three velocities about the frame's axes."""
        return self.velocities[-3:]

    @property
    def position(self) -> tuple[sp.Expr, ...]:
        """x, y, z; nothing in a ball joint."""
        return tuple(c.symbol for c in self.coordinates[:-4])

    @property
    def quaternion(self) -> tuple[sp.Expr, ...]:
        """qx, qy, qz, qw."""
        return tuple(c.symbol for c in self.orientation)

    @property
    def velocity(self) -> tuple[sp.Expr, ...]:
        """vx, vy, vz, in the frame's axes; nothing in a ball joint."""
        return tuple(v.symbol for v in self.velocities[:-3])

    @property
    def angular_velocity(self) -> tuple[sp.Expr, ...]:
        """wx, wy, wz, in the frame's axes, relative to its parent."""
        return tuple(v.symbol for v in self.turning)

    @property
    def rotation(self) -> sp.ImmutableMatrix:
        """R of the quaternion e:  R = 1 + 2/|e|² (w [r]× + [r]×²),  r = (x, y, z)."""
        x, y, z, w = self.quaternion
        hat = sp.Matrix([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        return sp.ImmutableMatrix(
            sp.Matrix([[1, 0, 0], [0, 1, 0], [0, 0, 1]]) + 2 / (x**2 + y**2 + z**2 + w**2) * (w * hat + hat * hat)
        )

    @property
    def in_rates(self) -> dict[sp.Expr, sp.Expr]:
        """The quasi-velocities in the rates of the coordinates: v = Rᵀ ṗ and (ω, 0) = 2 e* ∘ ė/|e|²."""
        x, y, z, w = self.quaternion
        rates = [c.rate for c in self.coordinates]
        dx, dy, dz, dw = rates[-4:]
        scale = 2 / (x**2 + y**2 + z**2 + w**2)
        turning = [
            scale * (w * dx - x * dw - y * dz + z * dy),
            scale * (w * dy - y * dw - z * dx + x * dz),
            scale * (w * dz - z * dw - x * dy + y * dx),
        ]
        turn = self.rotation
        columns = range(len(self.velocity))
        moving = [sp.Add(*[cast("sp.Expr", turn[j, k]) * rates[j] for j in range(3)]) for k in columns]
        return dict(zip((*self.velocity, *self.angular_velocity), (*moving, *turning), strict=True))
