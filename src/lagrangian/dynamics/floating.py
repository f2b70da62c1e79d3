"""Quasi-velocities of a body that floats: q̇ = N(q) u with a unit quaternion.

q = (p, e): position in the fixed axes and quaternion (x, y, z, w), turning body axes into fixed axes. u = (v, ω):
velocity of the body's origin and angular velocity, both in the body's axes.

    ṗ = R(e) v,        ė = ½ e ∘ (ω, 0)

e is used as it is: it is of unit length to the precision its integration keeps.
"""

from __future__ import annotations

from collections.abc import Sequence

from lagrangian.dynamics.motion import Axes, Motion, Place
from lagrangian.dynamics.vectors import Matrix, times
from lagrangian.graph import Graph


def quaternion_rotation(g: Graph, e: Sequence[int]) -> Matrix:
    """R of the unit quaternion (x, y, z, w): v_fixed = R v_body."""
    x, y, z, w = e
    two = g.const(2.0)
    X, Y, Z = (g.mul(two, c) for c in (x, y, z))
    xx, yy, zz = g.mul(X, x), g.mul(Y, y), g.mul(Z, z)
    xy, xz, yz = g.mul(X, y), g.mul(X, z), g.mul(Y, z)
    wx, wy, wz = g.mul(X, w), g.mul(Y, w), g.mul(Z, w)
    one = g.one
    return [
        [g.sub(one, g.add(yy, zz)), g.sub(xy, wz), g.add(xz, wy)],
        [g.add(xy, wz), g.sub(one, g.add(xx, zz)), g.sub(yz, wx)],
        [g.sub(xz, wy), g.add(yz, wx), g.sub(one, g.add(xx, yy))],
    ]


def floating_rates(g: Graph, q: Sequence[int], u: Sequence[int]) -> list[int]:
    """q̇ = N(q) u of q = (p, e), u = (v, ω)."""
    x, y, z, w = q[3:7]
    a, b, c = (g.mul(g.const(0.5), k) for k in u[3:6])
    turned = [
        g.sub(g.add(g.mul(w, a), g.mul(y, c)), g.mul(z, b)),
        g.sub(g.add(g.mul(w, b), g.mul(z, a)), g.mul(x, c)),
        g.sub(g.add(g.mul(w, c), g.mul(x, b)), g.mul(y, a)),
        g.neg(g.add(g.add(g.mul(x, a), g.mul(y, b)), g.mul(z, c))),
    ]
    return [*times(g, quaternion_rotation(g, q[3:7]), u[:3]), *turned]


def floating_body(motion: Motion, q: Sequence[int], u: Sequence[int]) -> tuple[Axes, Place]:
    """Axes and origin of a body that floats, with q = (p, e) and u = (v, ω) among the motion's coordinates."""
    axes = motion.turned_axes(motion.root, quaternion_rotation(motion.graph, q[3:7]), list(u[3:6]))
    return axes, motion.floating(q[:3], axes, u[:3])
