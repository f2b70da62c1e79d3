"""What has mass, and how it moves: momenta, their rates, and how far a wiggle of each coordinate moves and turns it.

A particle is one `Moving` with p = m v, a rigid body two: p = m v of its centre of mass, and H = I ω about it. Sums
over all particles of a body are exactly these two (König), so the lecture's sums over masses are sums over `Moving`:

    Σ m r̈·∂r/∂ξ  =  Σ ṗ·∂v/∂ξ̇      with ṗ = m a,  or  ṗ = I ω̇ + ω × I ω in the axes of the body
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from lagrangian.derive.algebra import Form
from lagrangian.derive.context import Context
from lagrangian.model import Body
from lagrangian.model.geometry import turned
from lagrangian.records import dataclass
from lagrangian.viewed import Brief

Column = tuple[Form, ...]
"""The components of a vector: in the fixed axes for a place, in the axes of the body for a turn."""


@dataclass(frozen=True, eq=False)
class Moving(Brief):
    """The translation of a body, or its rotation about its centre of mass.

    ``velocity`` is v or ω, ``momentum`` m v or I ω, ``momentum_rate`` its rate of change. ``by_place[j]`` is ∂r/∂ξ_j
    (empty for a rotation), ``columns[j]`` is ∂v/∂ξ̇_j or ∂ω/∂ξ̇_j, ``slopes[j]`` is ∂v/∂ξ_j or ∂ω/∂ξ_j.
    """

    body: Body
    turning: bool
    velocity: Column
    momentum: Column
    momentum_rate: Column
    by_place: tuple[Column, ...]
    columns: tuple[Column, ...]
    slopes: tuple[Column, ...]


def moving(context: Context) -> tuple[Moving, ...]:
    """The translations and rotations of all bodies, in order."""
    found: list[Moving] = []
    for body in context.model.bodies:
        found.append(_translation(context, body))
        if body.angular_velocity(context.model):
            found.append(_rotation(context, body))
    return tuple(found)


def dot(context: Context, a: Sequence[Form], b: Sequence[Form]) -> Form:
    """a·b."""
    return context.algebra.total([x * y for x, y in zip(a, b, strict=True) if x.parts and y.parts])


def cross(context: Context, a: Sequence[Form], b: Sequence[Form]) -> Column:
    """a × b in space; in the plane (a is ω, b a vector of one component too) nothing."""
    if len(a) == 1:
        return (context.algebra.total([]),)
    return tuple(a[i] * b[j] - a[j] * b[i] for i, j in ((1, 2), (2, 0), (0, 1)))


def _translation(context: Context, body: Body) -> Moving:
    model, coordinates = context.model, context.model.coordinates
    place = [context.form(model.expand(x)) for x in model.position(body.at)]
    velocity = tuple(context.form(v) for v in model.velocity(body.at))
    mass = context.form(body.mass)
    return Moving(
        body,
        False,
        velocity,
        tuple(mass * v for v in velocity),
        tuple(mass * v.total_derivative() for v in velocity),
        tuple(tuple(x.diff(c.symbol) for x in place) for c in coordinates),
        tuple(tuple(v.diff(c.rate) for v in velocity) for c in coordinates),
        tuple(tuple(v.diff(c.symbol) for v in velocity) for c in coordinates),
    )


def _rotation(context: Context, body: Body) -> Moving:
    coordinates = context.model.coordinates
    omega = tuple(context.form(w) for w in body.angular_velocity(context.model))
    tensor = [[context.form(x) for x in row] for row in body.tensor]
    momentum = tuple(dot(context, row, omega) for row in tensor)
    gyroscopic = cross(context, omega, momentum)
    return Moving(
        body,
        True,
        omega,
        momentum,
        tuple(h.total_derivative() + g for h, g in zip(momentum, gyroscopic, strict=True)),
        (),
        tuple(tuple(w.diff(c.rate) for w in omega) for c in coordinates),
        tuple(tuple(w.diff(c.symbol) for w in omega) for c in coordinates),
    )


def in_body_axes(body: Body, vector: Sequence[sp.Expr]) -> tuple[sp.Expr, ...]:
    """The components in the axes of a body of a vector in the fixed axes; in the plane a torque has one, the same."""
    if len(vector) == 1 or body.axes is None:
        return tuple(vector)
    return turned(body.axes.rotation.T, vector)  # type: ignore[arg-type] # SymPy's transpose has no type
