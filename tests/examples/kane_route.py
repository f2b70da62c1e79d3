"""Kane's equations of a system described with SymPy's own frames and points: the oracle's route.

With speeds u = q̇ Kane's F_r + F_r* is minus Lagrange's left-hand side plus Ξ, row by row, so residuals can be compared
equation for equation: r_i = d/dt(∂L/∂q̇_i) − ∂L/∂q_i − Ξ_i = −(F_r + F_r*)_i. Nothing here comes from the package.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import count

import sympy as sp
import sympy.physics.mechanics as me

t = me.dynamicsymbols._t


@dataclass(frozen=True)
class State:
    """Numbers by name: coordinates, their rates and accelerations, parameters, inputs; and the time."""

    q: Mapping[str, float]
    v: Mapping[str, float]
    a: Mapping[str, float]
    p: Mapping[str, float]
    u: Mapping[str, float]
    t: float


Residual = Callable[[State], list[float]]


def residual(rows: Sequence[sp.Expr], names: Sequence[str]) -> Residual:
    """Return rows as a function of the state; they hold ``q``, ``q_rate``, ``q_acceleration``, constants, inputs, t."""
    args = sorted(set().union(*[sp.sympify(r).free_symbols for r in rows]), key=str)
    function = sp.lambdify(args, list(rows), modules="math", cse=True)

    def evaluate(state: State) -> list[float]:
        table = {**state.p, **state.u, "t": state.t, **state.q}
        for n in names:
            table[f"{n}_rate"], table[f"{n}_acceleration"] = state.v[n], state.a[n]
        return [float(x) for x in function(*[table[str(s)] for s in args])]

    return evaluate


class Kane:
    """A system under construction: frame ``N``, its fixed point ``O``, coordinates ``q`` and speeds ``u`` = q̇."""

    def __init__(self, coordinates: str) -> None:
        self.names = coordinates.split()
        self.q = list(me.dynamicsymbols(" ".join(self.names) + " _")[:-1])
        self.u = list(me.dynamicsymbols(" ".join(f"{n}_rate" for n in self.names) + " _")[:-1])
        self.v = [q.diff(t) for q in self.q]
        self.N = me.ReferenceFrame("N")
        self.O = me.Point("O")
        self.O.set_vel(self.N, 0)
        self._serial = count(1)
        self.bodies: list[me.Particle | me.RigidBody] = []
        self.loads: list[tuple[object, me.Vector]] = []

    def point(self, vector: me.Vector, start: me.Point | None = None) -> me.Point:
        """A point at ``vector`` from ``start``, its velocity by differentiating its position in N."""
        made = (start or self.O).locatenew(f"P{next(self._serial)}", vector)
        made.set_vel(self.N, made.pos_from(self.O).dt(self.N))
        return made

    def turned(self, angle: sp.Expr, axis: me.Vector, frame: me.ReferenceFrame | None = None) -> me.ReferenceFrame:
        """A frame turned from ``frame`` by ``angle`` about ``axis``."""
        made = me.ReferenceFrame(f"F{next(self._serial)}")
        made.orient_axis(frame or self.N, axis, angle)
        return made

    def particle(self, mass: sp.Expr, at: me.Point) -> None:
        self.bodies.append(me.Particle(f"p{len(self.bodies)}", at, mass))

    def body(
        self, mass: sp.Expr, moments: tuple[sp.Expr, sp.Expr, sp.Expr], at: me.Point, f: me.ReferenceFrame
    ) -> None:
        """A rigid body with principal moments along ``f`` about its centre of mass."""
        self.bodies.append(me.RigidBody(f"b{len(self.bodies)}", at, f, mass, (me.inertia(f, *moments), at)))

    def force(self, vector: me.Vector, at: me.Point, reaction: me.Point | None = None) -> None:
        self.loads.append((at, vector))
        if reaction is not None:
            self.loads.append((reaction, -vector))

    def torque(self, vector: me.Vector, on: me.ReferenceFrame, reaction: me.ReferenceFrame | None = None) -> None:
        self.loads.append((on, vector))
        if reaction is not None:
            self.loads.append((reaction, -vector))

    def weights(self, g: sp.Expr, up: me.Vector) -> None:
        for body in self.bodies:
            at = body.point if isinstance(body, me.Particle) else body.masscenter
            self.loads.append((at, -body.mass * g * up))

    def residual(self) -> Residual:
        """−(F_r + F_r*) as a function of the state."""
        method = me.KanesMethod(self.N, self.q, self.u, [u - v for u, v in zip(self.u, self.v, strict=True)])
        applied, inertial = method.kanes_equations(self.bodies, self.loads)
        table = {}
        for n, q, u in zip(self.names, self.q, self.u, strict=True):
            table[u.diff(t)], table[u] = sp.Symbol(f"{n}_acceleration"), sp.Symbol(f"{n}_rate")
            table[q.diff(t)], table[q] = sp.Symbol(f"{n}_rate"), sp.Symbol(n)
        rows = [me.msubs(-(a + b), table) for a, b in zip(applied, inertial, strict=True)]
        return residual(rows, self.names)
