"""Quasi-velocities of a body that floats, or turns in a ball joint: q̇ = N(q) u with a unit quaternion.

q = (p, e): position in the fixed axes and quaternion (x, y, z, w), turning body axes into fixed axes. u = (v, ω):
velocity of the body's origin and angular velocity, both in the body's axes.

    ṗ = R(e) v,        ė = ½ e ∘ (ω, 0)

e may have any length but 0, which ė leaves as it is: R is that of e/|e|.
The equations of motion that follow from an energy T(q, u) are those of Euler, Poincaré and Hamel,

    d/dt ∂T/∂u − ad_uᵀ ∂T/∂u − Nᵀ ∂T/∂q = …        ad_uᵀ (f, m) = (f × ω, f × v + m × ω)

with ad_u the Lie bracket of two velocities, ad_u (v', ω') = (ω × v' − ω' × v, ω × ω'); for one body they are
Kirchhoff's, ṗ + ω × p and ḣ + ω × h + v × p. Source: J. E. Marsden, T. S. Ratiu, Introduction to Mechanics and
Symmetry, 2nd ed., 1999, §13.5 (Euler–Poincaré) and §14.2 (rigid body motion); signs checked by the tests.

A ball joint has q = e and u = ω alone, relative to the axes that carry it; of the bracket ω × ω' is left, and of ad_uᵀ
m × ω.
"""

from __future__ import annotations

from collections.abc import Sequence

from lagrangian.dynamics.axes import Axes, PlaceMotion
from lagrangian.dynamics.motion import Motion
from lagrangian.dynamics.vectors import Matrix, cross, dot, minus, plus, times, zeros
from lagrangian.graph import Graph
from lagrangian.records import dataclass


@dataclass(frozen=True)
class Float:
    """The positions in q and v of the first coordinates and velocities of a floating body: 7 and 6, or, if it is
    ``held`` by a ball joint, 4 and 3.
    """

    q: int
    v: int
    held: bool = False

    @property
    def coordinates(self) -> slice:
        """The places of its coordinates in q."""
        return slice(self.q, self.q + (4 if self.held else 7))

    @property
    def orientation(self) -> slice:
        """The places of its quaternion in q."""
        return slice(self.coordinates.stop - 4, self.coordinates.stop)

    @property
    def velocities(self) -> range:
        """The places of its velocities in v."""
        return range(self.v, self.v + (3 if self.held else 6))

    @property
    def turning(self) -> range:
        """The places of its angular velocity in v."""
        return self.velocities[-3:]


def quaternion_rotation(g: Graph, e: Sequence[int]) -> Matrix:
    """R of the quaternion (x, y, z, w) of any length: v_fixed = R v_body."""
    x, y, z, w = e
    two = g.div(g.const(2.0), dot(g, e, e))
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
    """q̇ = N(q) u of q = (p, e), u = (v, ω); in a ball joint, of e and ω alone."""
    x, y, z, w = q[-4:]
    a, b, c = (g.mul(g.const(0.5), k) for k in u[-3:])
    turned = [
        g.sub(g.add(g.mul(w, a), g.mul(y, c)), g.mul(z, b)),
        g.sub(g.add(g.mul(w, b), g.mul(z, a)), g.mul(x, c)),
        g.sub(g.add(g.mul(w, c), g.mul(x, b)), g.mul(y, a)),
        g.neg(g.add(g.add(g.mul(x, a), g.mul(y, b)), g.mul(z, c))),
    ]
    return [*times(g, quaternion_rotation(g, q[-4:]), u[:3]), *turned] if len(q) == 7 else turned


def floating_body(motion: Motion, q: Sequence[int], u: Sequence[int]) -> tuple[Axes, PlaceMotion]:
    """The axes and the origin of a floating body, with q = (p, e) and u = (v, ω) among the motion's coordinates."""
    axes = motion.turned_axes(motion.root, quaternion_rotation(motion.graph, q[3:7]), list(u[3:6]))
    return axes, motion.floating(q[:3], axes, u[:3])


def bracket(g: Graph, a: Sequence[int], b: Sequence[int]) -> list[int]:
    """ad_a b of two velocities (v, ω) of a body, or of two ω."""
    if len(a) == 3:
        return cross(g, a, b)
    v, w = a[:3], a[3:]
    moved = minus(g, cross(g, w, b[:3]), cross(g, b[3:], v))
    return [*moved, *cross(g, w, b[3:])]


def transported(g: Graph, u: Sequence[int], force: Sequence[int]) -> list[int]:
    """ad_uᵀ (f, m): f × ω and f × v + m × ω; in a ball joint m × ω alone."""
    if len(u) == 3:
        return cross(g, force, u)
    v, w, f, m = u[:3], u[3:], force[:3], force[3:]
    return [*cross(g, f, w), *plus(g, cross(g, f, v), cross(g, m, w))]


def transported_momenta(g: Graph, floats: Sequence[Float], v: Sequence[int], momenta: Sequence[int]) -> list[int]:
    """ad_uᵀ of the momenta of every floating body, 0 for all other velocities."""
    found = zeros(g, len(v))
    for at in floats:
        own = slice(at.velocities.start, at.velocities.stop)
        found[own] = transported(g, v[own], momenta[own])
    return found
