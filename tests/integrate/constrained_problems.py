"""Constrained motions for the tests of projection: multipliers eliminated in the graph, everything by hand.

    M v̇ = F + Aᵀ λ,   A v̇ + γ = 0      ⇒      λ = −(A M⁻¹ Aᵀ)⁻¹ (A M⁻¹ F + γ)

and the two corrections, −M⁻¹Aᵀ(A M⁻¹Aᵀ)⁻¹ f on positions and the same of A v on velocities.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lagrangian.graph import Graph, Output, Program, Scalar, jacobian, jvp
from lagrangian.integrate import Projection


@dataclass
class Constrained:
    """A right-hand side, its projection, and NumPy functions that know what is true."""

    program: Program
    projection: Projection
    start: np.ndarray
    rows: object = None  # x → residuals of positions
    speeds: object = None  # x → residuals of velocities
    energy: object = None


def solved(matrix, right):
    """Gauss' elimination of a symmetric positive matrix of scalars, without pivoting."""
    n = len(matrix)
    a, b = [list(row) for row in matrix], list(right)
    for k in range(n):
        for i in range(k + 1, n):
            factor = a[i][k] / a[k][k]
            a[i] = [x - factor * y for x, y in zip(a[i], a[k], strict=True)]
            b[i] = b[i] - factor * b[k]
    found = [None] * n
    for k in range(n - 1, -1, -1):
        rest = b[k]
        for j in range(k + 1, n):
            rest = rest - a[k][j] * found[j]
        found[k] = rest / a[k][k]
    return found


def constrained(names, masses, force, *, rows=None, speeds=None, p=None, start=(), scale=1.0, separate=False):
    """A system of coordinates ``names`` with constant ``masses``, position rows ``rows(q, s)`` or velocity rows
    ``speeds(q, v, s)``, and ``force(q, v, s)``. With ``separate`` its three programs have graphs of their own.
    """
    p, n = p or {}, len(names)
    groups = {"x": (*names, *(f"{name}'" for name in names)), "u": (), "p": tuple(p), "t": ("t",)}

    def made():
        g = Graph()
        q = [Scalar(g, g.input("x", k)) for k in range(n)]
        v = [Scalar(g, g.input("x", n + k)) for k in range(n)]
        s = {name: Scalar(g, g.input("p", k)) for k, name in enumerate(p)} | {"t": Scalar(g, g.input("t", 0))}
        m = [value if isinstance(value, Scalar) else Scalar(g, g.const(value)) for value in masses(s)]
        zero = Scalar(g, g.zero)
        flow = {q[k].id: v[k].id for k in range(n)}
        f = [] if rows is None else rows(q, s)
        if rows is not None:
            c = [Scalar(g, i) for i in jvp(g, [r.id for r in f], {**flow, s["t"].id: g.one})]
        else:
            c = speeds(q, v, s)
        entries = jacobian(g, [r.id for r in c], [w.id for w in v])
        A = [[Scalar(g, entries.get((i, k), g.zero)) for k in range(n)] for i in range(len(c))]
        second = jvp(g, [r.id for r in c], {**flow, s["t"].id: g.one})
        gamma = [Scalar(g, i) for i in second]
        MA = [[a / m[k] for k, a in enumerate(row)] for row in A]
        K = [[sum((x * y for x, y in zip(r, w, strict=True)), zero) for w in MA] for r in A]
        margin = K[0][0] * 1.0

        def push(residuals):
            """−M⁻¹ Aᵀ (A M⁻¹ Aᵀ)⁻¹ of residuals."""
            lam = solved(K, residuals)
            return [-sum((lam[i] * MA[i][k] for i in range(len(c))), zero) for k in range(n)]

        F = force(q, v, s)
        free = [F[k] / m[k] for k in range(n)]
        back = push([gamma[i] + sum((A[i][k] * free[k] for k in range(n)), zero) for i in range(len(c))])
        rates = [*v, *(a + b for a, b in zip(free, back, strict=True))]

        def program(name, dx, residuals):
            gap = zero
            for r in residuals:
                gap = Scalar(g, g.max(gap.id, (r * (1 / scale)).apply("abs").id))
            outputs = {"dx": Output(tuple(d.id for d in dx), (2 * n,)), "gap": Output((gap.id,), ())}
            if name == "velocity":
                outputs["margin"] = Output((margin.id,), ())
            return Program(name, g, groups, outputs, p)

        still = [zero] * n
        position = program("position", [*push(f), *still], f) if rows is not None else None
        return (
            Program("rates", g, groups, {"xdot": Output(tuple(r.id for r in rates), (2 * n,))}, p),
            position,
            program("velocity", [*still, *push(c)], c),
        )

    first = made()
    position, velocity = made()[1:] if separate else first[1:]
    return Constrained(first[0], Projection(position, velocity), np.array(start, float))


G = 9.81


def rod(*, separate=False):
    """A pendulum in x and y on a rod: x² + y² = l², so θ'' = −(g/l) sin θ from x = l sin θ, y = −l cos θ."""
    made = constrained(
        ("x", "y"),
        lambda s: [s["m"], s["m"]],
        lambda q, v, s: [0 * q[0], -s["m"] * G],
        rows=lambda q, s: [(q[0] * q[0] + q[1] * q[1] - s["l"] * s["l"]) / (2 * s["l"])],
        p={"m": 2.0, "l": 1.0},
        start=[np.sin(2.0), -np.cos(2.0), 0.0, 0.0],
        separate=separate,
    )
    made.rows = lambda x: (x[..., :1] ** 2 + x[..., 1:2] ** 2 - 1) / 2
    made.speeds = lambda x: x[..., :1] * x[..., 2:3] + x[..., 1:2] * x[..., 3:]
    made.energy = lambda x: (x[..., 2] ** 2 + x[..., 3] ** 2) / 2 + G * x[..., 1]
    return made


LINKS, BASE = (1.0, 2.0, 1.5), 2.2


def four_bar():
    """Three massless rods a, b, c in absolute angles, point masses where they meet, which close on a ground of length
    d: a cos α + b cos β − c cos γ = d, a sin α + b sin β = c sin γ; each angle has an inertia of its own.
    """
    a, b, c = LINKS

    def rows(q, s):
        A, B, C = q
        return [
            a * A.apply("cos") + b * B.apply("cos") - c * C.apply("cos") - BASE,
            a * A.apply("sin") + b * B.apply("sin") - c * C.apply("sin"),
        ]

    def force(q, v, s):
        return [-(w * G) * angle.apply("cos") for w, angle in zip((1.0, 2.0, 0.5), q, strict=True)]

    def residual(x):
        A, B, C = x[..., 0], x[..., 1], x[..., 2]
        return np.stack(
            [
                a * np.cos(A) + b * np.cos(B) - c * np.cos(C) - BASE,
                a * np.sin(A) + b * np.sin(B) - c * np.sin(C),
            ],
            axis=-1,
        )

    def speed(x):
        A, B, C, va, vb, vc = np.moveaxis(x, -1, 0)
        return np.stack(
            [
                -a * np.sin(A) * va - b * np.sin(B) * vb + c * np.sin(C) * vc,
                a * np.cos(A) * va + b * np.cos(B) * vb - c * np.cos(C) * vc,
            ],
            axis=-1,
        )

    # the crank at 60°: the two circles about its end and about (d, 0) meet
    A = np.pi / 3
    to = np.array([BASE - a * np.cos(A), -a * np.sin(A)])
    r = np.hypot(*to)
    B = np.arctan2(to[1], to[0]) + np.arccos((b * b + r * r - c * c) / (2 * b * r))
    C = np.arctan2(a * np.sin(A) + b * np.sin(B), a * np.cos(A) + b * np.cos(B) - BASE)
    made = constrained(
        ("A", "B", "C"), lambda s: [1.0, 2.0, 1.0], force, rows=rows, start=[A, B, C, 0, 0, 0], scale=2.0
    )
    made.rows, made.speeds = residual, speed
    made.energy = lambda x: (
        (x[..., 3] ** 2 + 2 * x[..., 4] ** 2 + x[..., 5] ** 2) / 2
        + G * (np.sin(x[..., 0]) + 2 * np.sin(x[..., 1]) + 0.5 * np.sin(x[..., 2]))
    )
    return made


SLEIGH = {"m": 1.0, "J": 0.5, "a": 0.3}


def sleigh():
    """Chaplygin's sleigh by its edge (x, y) and its course: y' cos θ − x' sin θ = 0, the mass ahead by a.

    In v along the course and ω: m v' = m a ω², (J + m a²) ω' = −m a ω v (J. I. Neimark, N. A. Fufaev, Dynamics of
    Nonholonomic Systems, 1972); v = V tanh(k t + c). M is not diagonal in x, y: here the state is that of the centre of
    mass, in which it is.
    """
    m, J, a = SLEIGH["m"], SLEIGH["J"], SLEIGH["a"]

    def speeds(q, v, s):
        sine, cosine = q[2].apply("sin"), q[2].apply("cos")
        return [v[1] * cosine - v[0] * sine - a * v[2]]

    made = constrained(
        ("x", "y", "theta"),
        lambda s: [m, m, J],
        lambda q, v, s: [0 * q[0]] * 3,
        speeds=speeds,
        start=[a, 0, 0, 0.0, a * 2.0, 2.0],
    )
    made.speeds = lambda x: (x[..., 4] * np.cos(x[..., 2]) - x[..., 3] * np.sin(x[..., 2]) - a * x[..., 5])[..., None]
    made.energy = lambda x: (m * (x[..., 3] ** 2 + x[..., 4] ** 2) + J * x[..., 5] ** 2) / 2
    return made


def sleigh_speeds(t):
    """v along the course and ω of `sleigh`, from rest along it."""
    m, J, a = SLEIGH["m"], SLEIGH["J"], SLEIGH["a"]
    turning = J + m * a * a
    twice = turning * 2.0**2
    V = np.sqrt(twice / m)
    k = m * a * V / turning
    return V * np.tanh(k * t), np.sqrt(twice / turning) / np.cosh(k * t)
