"""Mechanisms with rows, and their equations by dense matrices of numbers: no graph, no tape, no shared formula.

A motion q(t) is followed to second order by jets (x, ẋ, ẍ). Along e_k they give the Jacobians of places and turns,
along v the accelerations at v̇ = 0; virtual work then gives M and h, and [[M, −Aᵀ], [A, 0]] is solved by least squares.
"""

from dataclasses import dataclass, field

import numpy as np

from lagrangian.dynamics.describe import Inputs, described
from lagrangian.dynamics.rows import ConstraintRow
from lagrangian.dynamics.vectors import minus, times, transposed
from lagrangian.graph import Graph, Output, Program, evaluate


class Jet:
    """x + ẋ t + ẍ t²/2."""

    def __init__(self, a, b=0.0, c=0.0):
        self.a, self.b, self.c = a, b, c

    @staticmethod
    def of(x):
        return x if isinstance(x, Jet) else Jet(x)

    def __add__(self, other):
        o = Jet.of(other)
        return Jet(self.a + o.a, self.b + o.b, self.c + o.c)

    def __mul__(self, other):
        o = Jet.of(other)
        return Jet(self.a * o.a, self.a * o.b + self.b * o.a, self.a * o.c + 2 * self.b * o.b + self.c * o.a)

    def __neg__(self):
        return Jet(-self.a, -self.b, -self.c)

    def __sub__(self, other):
        return self + -Jet.of(other)

    def __rsub__(self, other):
        return Jet.of(other) - self

    __radd__, __rmul__ = __add__, __mul__

    def through(self, f, slope, bend):
        return Jet(f, slope * self.b, slope * self.c + bend * self.b**2)

    def __pow__(self, n):
        return self.through(self.a**n, n * self.a ** (n - 1), n * (n - 1) * self.a ** (n - 2))


def sin(x):
    return x.through(np.sin(x.a), np.cos(x.a), -np.sin(x.a)) if isinstance(x, Jet) else np.sin(x)


def cos(x):
    return x.through(np.cos(x.a), -np.sin(x.a), -np.cos(x.a)) if isinstance(x, Jet) else np.cos(x)


def turn(axis, angle):
    """Rodrigues' matrix."""
    x, y, z = np.array(axis, float) / np.linalg.norm(axis)
    hat = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + hat * sin(angle) + (hat @ hat) * (1 - cos(angle))


def part(x, order):
    return np.vectorize(lambda e: getattr(Jet.of(e), "abc"[order]), otypes=[float])(np.asarray(x, object))


def vee(W):
    return np.array([W[2, 1] - W[1, 2], W[0, 2] - W[2, 0], W[1, 0] - W[0, 1]]) / 2


@dataclass
class Numbers:
    """``bodies``: q → (mass, inertia, r, R or an angle) of each; ``gaps``: q → f; ``slips``: q, q̇ → c.

    ``rates``: q, v → q̇. The rows are the gaps' first, then the slips.
    """

    n: int
    bodies: object
    gravity: object
    gaps: object = field(default=lambda q: [])
    slips: object = field(default=lambda q, rates: [])
    rates: object = field(default=lambda q, v: v)

    def path(self, q, v):
        first = part(self.rates(q, v), 0)
        moving = np.array([Jet(a, b) for a, b in zip(q, first, strict=True)], object)
        second = part(self.rates(moving, v), 1)
        return np.array([Jet(*x) for x in zip(q, first, second, strict=True)], object)

    def motions(self, q, v):
        """(velocity, acceleration) of every body's place and turn."""
        found = []
        for _, _, r, R in self.bodies(self.path(q, v)):
            if np.ndim(R) == 0:
                spin, turning = np.array([part(R, 1)]), np.array([part(R, 2)])
            else:
                R0, R1, R2 = (part(R, k) for k in range(3))
                spin, turning = vee(R1 @ R0.T), vee(R2 @ R0.T + R1 @ R1.T)
            found.append((part(r, 1), part(r, 2), spin, turning))
        return found

    def equations(self, q, v):
        """M, h, A, γ."""
        columns = [self.motions(q, e) for e in np.eye(self.n)]
        M, h = np.zeros((self.n, self.n)), np.zeros(self.n)
        for b, (mass, inertia, _, R) in enumerate(self.bodies(np.array(q, float))):
            J = np.array([column[b][0] for column in columns]).T
            W = np.array([column[b][2] for column in columns]).T
            _, a, w, alpha = self.motions(q, v)[b]
            I = np.atleast_2d(inertia)
            if len(I) == 3:
                I = part(R, 0) @ I @ part(R, 0).T
            M += mass * J.T @ J + W.T @ I @ W
            gyro = np.cross(w, I @ w) if len(I) == 3 else 0.0
            h += mass * J.T @ (a - np.array(self.gravity)) + W.T @ (I @ alpha + gyro)
        A, _, gamma = self.rows(q, v)
        return M, h, A, gamma

    def rows(self, q, v):
        """A, c and γ."""

        def along(u):
            path = self.path(q, u)
            rates = np.array([Jet(x.b, x.c) for x in path], object)
            slips = np.asarray(self.slips(path, rates), object)
            gaps = np.asarray(self.gaps(path), object)
            return np.r_[part(gaps, 1), part(slips, 0)], np.r_[part(gaps, 2), part(slips, 1)]

        start = along(np.zeros(self.n))[0]
        A = np.array([along(e)[0] - start for e in np.eye(self.n)]).T.reshape(-1, self.n)
        return A, *along(np.array(v))

    def solution(self, q, v):
        """v̇ and λ, of least length where they are not determined."""
        M, h, A, gamma = self.equations(q, v)
        saddle = np.block([[M, -A.T], [A, np.zeros((len(A), len(A)))]])
        found = np.linalg.lstsq(saddle, np.r_[-h, -gamma], rcond=1e-10)[0]
        return found[: self.n], found[self.n :]

    def step(self, q, values, keep=()):
        """The least δ with A δ = −values, the velocities in ``keep`` left out."""
        M, _, A, _ = self.equations(q, np.zeros(self.n))
        free = [k for k in range(self.n) if k not in keep]
        M, A = M[np.ix_(free, free)], A[: len(values), free]
        L = np.linalg.cholesky(M)
        delta = np.zeros(self.n)
        delta[free] = -np.linalg.solve(L.T, np.linalg.pinv(np.linalg.solve(L, A.T).T, rcond=1e-9) @ values)
        return delta


# -- rows on a described model ----------------------------------------------------------------------------------


def mechanics(builder):
    """The mechanics of what was built, and where its points went."""
    model, graph = builder.model(), Graph()
    return described(model, graph, Inputs.of(graph, model))


def place(m, d, point):
    """The place of a point, whether an element uses it or not."""
    if point not in d.places:
        parent = place(m, d, point.parent)
        axes = m.motion.root if point.frame is None else d.axes[point.frame]
        d.places[point] = m.motion.place(parent, axes, d.nodes(point.offset))
    return d.places[point]


def join(m, d, P, Q, name):
    """P on Q, in the axes of P's place."""
    g, motion = m.graph, m.motion
    p, q = place(m, d, P), place(m, d, Q)
    axes = p.axes if motion.dimension == 3 else motion.root
    f = motion.between(q, p)
    if motion.dimension == 3:
        f = times(g, transposed(motion.rotation(axes)), f)
    c = minus(g, motion.turned(p.velocity, p.axes, axes), motion.turned(q.velocity, q.axes, axes))
    for k in range(motion.dimension):

        def acceleration(acc, k=k):
            return g.sub(motion.turned(acc.a[p], p.axes, axes)[k], motion.turned(acc.a[q], q.axes, axes)[k])

        known = acceleration if motion.dimension == 2 else None
        m.rows.append(ConstraintRow(f"{name}.{'xyz'[k]}", name, c[k], f[k], known))


def gap(m, node, name, closure=None):
    """A row on positions, of its node."""
    m.rows.append(ConstraintRow(name, closure or name, m.motion.rate([node])[0], node))


def slip(m, d, expr, name):
    """A row on velocities, of its expression."""
    m.rows.append(ConstraintRow(name, name, d.node(expr)))


def values(m, q, v, p=(), u=(), **wanted):
    """The values of lists of nodes at a state."""
    given = {"q": list(q), "v": list(v), "p": list(p), "u": list(u), "t": [0.0]}
    names = {group: tuple(map(str, range(len(x)))) for group, x in given.items()}
    outputs = {name: Output(tuple(ids), (len(ids),)) for name, ids in wanted.items()}
    return {name: np.array(x) for name, x in evaluate(Program("rows", m.graph, names, outputs), given).items()}
