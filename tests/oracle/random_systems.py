"""Random systems, each described twice: to the package in SymPy, and to the oracle in functions of numbers.

What both share is how a place or a turn follows from coordinates: a function written over a set of functions ``m``,
`sympy` for the package, `mpmath` for the oracle.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import mpmath as mp
import sympy as sp
from differences import Mechanism, Vector, dot, times
from sympy.physics.mechanics import dynamicsymbols

import lagrangian as lg


@dataclass
class Case:
    """A system and its oracle; ``u`` are the values of the inputs.

    Where a frame floats ``pose`` are its seven coordinates, and the oracle's first six coordinates are a chart about
    it: the place p + R ξ and the turn R exp(θ×), whose rates at ξ = θ = 0 are the velocities in the frame's own axes.
    """

    system: lg.System
    oracle: Mechanism
    u: list[float] = field(default_factory=list)
    pose: list[float] = field(default_factory=list)


def chosen(source: random.Random) -> sp.Rational:
    """A number that is the same in both descriptions."""
    return sp.Rational(source.randint(3, 17), 10)


def of(expr: sp.Expr, q: list[Any], v: list[Any], t: Any, u: dict[Any, float]) -> Callable[[Vector, Vector, Any], Any]:
    """A SymPy expression of coordinates, rates, inputs and t as a function of numbers, by plain substitution."""
    plain = [sp.Dummy() for _ in range(2 * len(q) + 1)]
    rates = {x.diff(): d for x, d in zip(q, plain[len(q) :], strict=False)}
    other = {**dict(zip(q, plain, strict=False)), t: plain[-1], **{k: sp.Float(x, 30) for k, x in u.items()}}
    written = sp.lambdify(plain, expr.subs(rates).subs(other), "mpmath")
    return lambda x, w, s: written(*x, *w, s)


@dataclass
class Link:
    """A body's place and turn so far, in both descriptions."""

    point: Any
    frame: Any
    place: Callable[[Any, Vector, Any], Vector]
    turn: Callable[[Any, Vector, Any], list[Vector]]
    angle: Callable[[Vector], Any]


def plane(seed: int) -> Case:
    """A tree of turning and sliding bodies in the plane; its root may be moved in a prescribed way."""
    source = random.Random(seed)
    n = source.randint(1, 3)
    s = lg.System(f"plane {seed}")
    q = [s.coordinate(f"q{k}") for k in range(n)]
    oracle, u = Mechanism(n), {}
    shaken, w = source.random() < 0.3, chosen(source)
    root = s.origin + (sp.sin(w * s.t) / 5, 0) if shaken else s.origin

    def ground(m: Any, x: Vector, t: Any) -> Vector:
        return [m.sin(number(m, w) * t) / 5 if shaken else 0 * t, 0 * t]

    links = [Link(root, None, ground, lambda m, x, t: [[1, 0], [0, 1]], lambda x: 0)]
    for k in range(n):
        links.append(planar_link(source, s, q, k, source.choice(links)))
        add_body(source, s, oracle, links[-1], 2)
    add_efforts(source, s, oracle, q, links, u, 2)
    return Case(s, oracle, list(u.values()))


def number(m: Any, x: Any) -> Any:
    return x if m is sp else mp.mpf(int(x.p)) / int(x.q)


def planar_link(source: random.Random, s: lg.System, q: list[Any], k: int, parent: Link) -> Link:
    L, tilt, kind = chosen(source), chosen(source), source.choice(["absolute", "relative", "slide"])
    if kind == "slide":  # along a line fixed in the ground

        def place(m: Any, x: Vector, t: Any) -> Vector:
            P, c = parent.place(m, x, t), number(m, tilt)
            return [P[0] + x[k] * m.cos(c), P[1] + x[k] * m.sin(c)]

        point = parent.point + (q[k] * sp.cos(tilt), q[k] * sp.sin(tilt))
        return Link(point, parent.frame, place, parent.turn, parent.angle)

    def angle(x: Vector) -> Any:
        return x[k] + (parent.angle(x) if kind == "relative" else 0)

    def turn(m: Any, x: Vector, t: Any) -> list[Vector]:
        c, d = m.cos(angle(x)), m.sin(angle(x))
        return [[c, -d], [d, c]]

    def place_turned(m: Any, x: Vector, t: Any) -> Vector:
        P, R, length = parent.place(m, x, t), turn(m, x, t), number(m, L)
        return [P[0] + R[0][0] * length, P[1] + R[1][0] * length]

    relative = kind == "relative" and parent.frame is not None
    frame = s.frame(q[k] if relative else angle(q), parent=parent.frame if relative else None, origin=parent.point)
    point = frame.point(L, 0) if source.random() < 0.5 else parent.point + (L * sp.cos(angle(q)), L * sp.sin(angle(q)))
    return Link(point, frame, place_turned, turn, angle)


def space(seed: int) -> Case:
    """A tree of bodies in space that turn about axes fixed in their parents, or slide along them."""
    source = random.Random(seed)
    n = source.randint(1, 3)
    s = lg.System(f"space {seed}")
    q = [s.coordinate(f"q{k}") for k in range(n)]
    oracle, u = Mechanism(n), {}
    identity = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    root = Link(s.origin, None, lambda m, x, t: [0 * t, 0 * t, 0 * t], lambda m, x, t: identity, lambda x: 0)
    links = [root]
    for k in range(n):
        links.append(spatial_link(source, s, q, k, source.choice(links)))
        add_body(source, s, oracle, links[-1], 3)
    add_efforts(source, s, oracle, q, links, u, 3)
    return Case(s, oracle, list(u.values()))


AXES = ((1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 2, 2), (2, -3, 6))
"""Axes of whole length, so that a unit vector is rational: lengths 1, 1, 1, 3, 7."""


def spatial_link(source: random.Random, s: lg.System, q: list[Any], k: int, parent: Link) -> Link:
    axis, offset = source.choice(AXES), [chosen(source) for _ in range(3)]
    length = int(sp.sqrt(sum(x * x for x in axis)))
    unit = [sp.Rational(x, length) for x in axis]
    slides = source.random() < 0.3

    def turn(m: Any, x: Vector, t: Any) -> list[Vector]:
        R = parent.turn(m, x, t)
        return R if slides else product(R, about(m, [number(m, a) for a in unit], x[k]))

    def place(m: Any, x: Vector, t: Any) -> Vector:
        P, local = parent.place(m, x, t), [number(m, d) for d in offset]
        if slides:
            local = [a + x[k] * number(m, b) for a, b in zip(local, unit, strict=True)]
        return [a + b for a, b in zip(P, times(turn(m, x, t), local), strict=True)]

    if slides:
        moving = tuple(a + q[k] * b for a, b in zip(offset, unit, strict=True))
        if parent.frame is None:
            return Link(parent.point + moving, None, place, turn, parent.angle)
        there = s.frame(0, axis=(0, 0, 1), parent=parent.frame, origin=parent.point)
        return Link(there.point(*moving), parent.frame, place, turn, parent.angle)
    frame = s.frame(q[k], axis=axis, parent=parent.frame, origin=parent.point)
    return Link(frame.point(*offset), frame, place, turn, lambda x: x[k])


def about(m: Any, n: Vector, angle: Any) -> list[Vector]:
    """Rodrigues: R = cos φ 1 + (1 − cos φ) n nᵀ + sin φ n×."""
    c, s = m.cos(angle), m.sin(angle)
    cross = [[0, -n[2], n[1]], [n[2], 0, -n[0]], [-n[1], n[0], 0]]
    return [[(c if i == j else 0) + (1 - c) * n[i] * n[j] + s * cross[i][j] for j in range(3)] for i in range(3)]


def product(A: list[Vector], B: list[Vector]) -> list[Vector]:
    return [[sum(A[i][k] * B[k][j] for k in range(len(B))) for j in range(len(B[0]))] for i in range(len(A))]


def numeric_place(link: Link) -> Callable[[Vector, Any], Vector]:
    return lambda x, t: link.place(mp, x, t)


def numeric_turn(link: Link, dimension: int) -> Callable[[Vector, Any], list[Vector]]:
    def turn(x: Vector, t: Any) -> list[Vector]:
        R = [[mp.mpf(e) for e in row] for row in link.turn(mp, x, t)]
        if dimension == 3:
            return R
        return [[*R[0], mp.mpf(0)], [*R[1], mp.mpf(0)], [mp.mpf(0), mp.mpf(0), mp.mpf(1)]]

    return turn


def add_body(source: random.Random, s: lg.System, oracle: Mechanism, link: Link, dimension: int) -> None:
    m = chosen(source)
    if link.frame is None or (dimension == 2 and source.random() < 0.5):
        s.particle(m, at=link.point)
        oracle.bodies.append((number(mp, m), None, numeric_place(link), None))
        return
    place, turn = numeric_place(link), numeric_turn(link, dimension)
    if dimension == 2:
        J = chosen(source)
        s.rigid_body(m, J, at=link.point, frame=link.frame)
        inertia = [[mp.mpf(0)] * 3, [mp.mpf(0)] * 3, [mp.mpf(0), mp.mpf(0), number(mp, J)]]
    else:  # the inertia of masses on the axes, turned: it belongs to a body
        a, b, c = (chosen(source) for _ in range(3))
        N = about(sp, [sp.Rational(1, 3), sp.Rational(2, 3), sp.Rational(2, 3)], sp.pi / 2)
        full = sp.Matrix(N) * sp.diag(b + c, a + c, a + b) * sp.Matrix(N).T
        s.rigid_body(m, full, at=link.point, frame=link.frame)
        inertia = [[number(mp, sp.Rational(full[i, j])) for j in range(3)] for i in range(3)]
    oracle.bodies.append((number(mp, m), inertia, place, turn))


def add_efforts(
    source: random.Random, s: lg.System, oracle: Mechanism, q: list[Any], links: list[Link], u: dict[Any, float], d: int
) -> None:
    """Gravity, springs, dampers, forces fixed and following, torques, raw energies: some of each."""
    adders = [add_gravity, add_spring, add_raw_kinetic, add_damper, add_force, add_torque, add_raw_potential]
    for adder in source.sample(adders, source.randint(2, 5)):
        adder(source, s, oracle, q, links, u, d)


def add_gravity(source: Any, s: Any, oracle: Mechanism, q: Any, links: Any, u: Any, d: int) -> None:
    g = chosen(source)
    direction = (0, -1) if d == 2 else (0, 0, -1)
    s.gravity(direction, g=g)
    for mass, _, place, _ in list(oracle.bodies):
        oracle.potentials.append(lambda x, t, m=mass, p=place: m * number(mp, g) * p(x, t)[-1])


def add_spring(source: Any, s: Any, oracle: Mechanism, q: Any, links: list[Link], u: Any, d: int) -> None:
    k, rest = chosen(source), chosen(source)
    if source.random() < 0.5:
        i, j = source.randrange(len(q)), source.randrange(len(q))
        stretch = q[i] - q[j] / 2 if i != j else q[i]
        s.spring(k, deflection=stretch, rest=rest)

        def delta(x: Vector, t: Any) -> Any:
            return (x[i] - x[j] / 2 if i != j else x[i]) - number(mp, rest)
    else:
        end, fixed = links[-1], [3] * d
        s.spring(k, between=(s.origin + tuple(fixed), end.point), rest=rest)

        def delta(x: Vector, t: Any) -> Any:
            apart = [a - b for a, b in zip(end.place(mp, x, t), fixed, strict=True)]
            return mp.sqrt(dot(apart, apart)) - number(mp, rest)

    oracle.potentials.append(lambda x, t: number(mp, k) * delta(x, t) ** 2 / 2)


def add_damper(source: Any, s: Any, oracle: Mechanism, q: Any, links: list[Link], u: Any, d: int) -> None:
    b = chosen(source)
    if source.random() < 0.5:
        i = source.randrange(len(q))
        s.damper(b, deflection=q[i])
        oracle.losses.append(lambda x, v, t: number(mp, b) * v[i] ** 2 / 2)
        return
    end, fixed = links[-1], [3] * d
    s.damper(b, between=(s.origin + tuple(fixed), end.point))

    def loss(x: Vector, v: Vector, t: Any) -> Any:
        apart = [a - c for a, c in zip(end.place(mp, x, t), fixed, strict=True)]
        rate = dot(apart, oracle.along(numeric_place(end), x, v, t)) / mp.sqrt(dot(apart, apart))
        return number(mp, b) * rate**2 / 2

    oracle.losses.append(loss)


def add_force(source: Any, s: Any, oracle: Mechanism, q: Any, links: list[Link], u: dict[Any, float], d: int) -> None:
    F = s.input(f"F{len(u)}")
    u[F] = source.uniform(0.5, 1.5)
    size, end, rest = mp.mpf(u[F]), links[-1], [0] * (d - 2)
    if end.frame is not None and source.random() < 0.6:  # a follower force: it turns with the body
        s.force((F, 2 * F, *rest), at=end.point, axes=end.frame)
        oracle.forces.append(
            (
                lambda x, v, t: times(numeric_turn(end, d)(x, t), [size, 2 * size, mp.mpf(0)])[:d],
                numeric_place(end),
            )
        )
        return
    s.force((F, q[0].diff() * F, *rest), at=end.point)
    oracle.forces.append((lambda x, v, t: [size, v[0] * size, *[mp.mpf(0)] * (d - 2)], numeric_place(end)))


def add_torque(source: Any, s: Any, oracle: Mechanism, q: Any, links: list[Link], u: dict[Any, float], d: int) -> None:
    turned = [link for link in links if link.frame is not None]
    if not turned:
        return
    tau = s.input(f"tau{len(u)}")
    u[tau] = source.uniform(0.5, 1.5)
    link, size = source.choice(turned), mp.mpf(u[tau])
    if d == 2:
        s.torque(tau, on=link.frame)
        oracle.torques.append((lambda x, v, t: size, lambda x, t: link.angle(x)))
        return
    s.torque((tau, 0, -tau), on=link.frame)
    oracle.moments.append((lambda x, v, t: [size, mp.mpf(0), -size], numeric_turn(link, 3)))


def add_raw_kinetic(source: Any, s: Any, oracle: Mechanism, q: list[Any], links: Any, u: Any, d: int) -> None:
    T = quadratic(source, q)
    s.kinetic(T)
    oracle.kinetics.append(of(T, q, q, s.t, {}))


def add_raw_potential(source: Any, s: Any, oracle: Mechanism, q: list[Any], links: Any, u: Any, d: int) -> None:
    V = chosen(source) * sp.cos(q[0] - q[-1] / 2) + chosen(source) * q[-1] ** 4 * sp.sin(s.t)
    s.potential(V)
    written = of(V, q, q, s.t, {})
    oracle.potentials.append(lambda x, t: written(x, x, t))


def quadratic(source: random.Random, q: list[Any]) -> sp.Expr:
    """½ Σ (c·v)², its forms depending on q, multiplied out in one of several ways: rates stand alone and in sums."""
    v = [x.diff() for x in q]
    forms = []
    for i in range(len(q)):
        terms = [chosen(source) * v[i] * (1 + sp.sin(q[-1]) ** 2)]
        terms += [chosen(source) * sp.cos(q[source.randrange(len(q))]) * x for x in v if source.random() < 0.7]
        forms.append(sp.Add(*terms))
    T = sp.Rational(1, 2) * sp.Add(*(form**2 for form in forms))
    return source.choice([lambda e: e, sp.expand, lambda e: sp.collect(sp.expand(e), v), sp.factor])(T)


def energies(seed: int) -> Case:
    """A system given by its energies alone."""
    source = random.Random(seed)
    n = source.randint(2, 4)
    q = list(dynamicsymbols(f"q0:{n}"))
    t = dynamicsymbols._t
    T, V = quadratic(source, q), chosen(source) * sp.cos(q[0]) + chosen(source) * q[0] * q[-1] ** 2 / 2
    D = chosen(source) * (q[0].diff() - q[-1].diff()) ** 2 / 2
    Xi = [chosen(source) * sp.sin(t) * q[-1].diff()] + [sp.S.Zero] * (n - 1)
    s = lg.System.from_energies(q, T=T, V=V, D=D, Xi=Xi, name=f"energies {seed}")
    oracle = Mechanism(n, kinetics=[of(T, q, q, t, {})], losses=[of(D, q, q, t, {})])
    written = of(V, q, q, t, {})
    oracle.potentials.append(lambda x, time: written(x, x, time))
    oracle.direct.append((0, of(Xi[0], q, q, t, {})))
    return Case(s, oracle)


def floating(seed: int) -> Case:
    """A body that floats, often a turning or sliding body on it, and what acts on them."""
    source = random.Random(seed)
    s = lg.System(f"floating {seed}")
    base = s.floating_frame("base")
    pose = [source.uniform(-1, 1) for _ in range(3)]
    quaternion = [source.gauss(0, 1) for _ in range(4)]
    size = sum(x * x for x in quaternion) ** 0.5
    pose += [x / size for x in quaternion]
    joints = source.randint(0, 1)
    q = [s.coordinate(f"q{k}") for k in range(joints)]
    oracle, u = Mechanism(6 + joints), {}

    def turn(m: Any, x: Vector, t: Any) -> list[Vector]:
        return product(from_quaternion([m.mpf(e) for e in pose[3:]]), exponential(x[3:6]))

    def place(m: Any, x: Vector, t: Any) -> Vector:
        R = from_quaternion([m.mpf(e) for e in pose[3:]])
        return [m.mpf(p) + d for p, d in zip(pose[:3], times(R, x[:3]), strict=True)]

    links = [Link(base.origin, base, place, turn, lambda x: 0)]
    add_body(source, s, oracle, links[0], 3)
    padded = [sp.nan] * 6 + q  # the chart's coordinates have no symbols
    for k in range(joints):
        links.append(spatial_link(source, s, padded, 6 + k, source.choice(links)))
        add_body(source, s, oracle, links[-1], 3)
    add_gravity(source, s, oracle, q, links, u, 3)
    add_thrust(source, s, oracle, links, u)
    add_torque(source, s, oracle, q, links, u, 3)
    if q:
        k, b = chosen(source), chosen(source)
        s.spring(k, deflection=q[-1])
        s.damper(b, deflection=q[-1])
        oracle.potentials.append(lambda x, t: number(mp, k) * x[-1] ** 2 / 2)
        oracle.losses.append(lambda x, v, t: number(mp, b) * v[-1] ** 2 / 2)
    return Case(s, oracle, list(u.values()), pose)


def add_thrust(source: Any, s: Any, oracle: Mechanism, links: list[Link], u: dict[Any, float]) -> None:
    """A thrust that turns with a body, away from its origin."""
    F = s.input(f"F{len(u)}")
    u[F] = source.uniform(0.5, 1.5)
    link, size = source.choice(links), mp.mpf(u[F])
    if link.frame is None:
        return
    arm = [chosen(source) for _ in range(3)]
    s.force((0, F, 2 * F), at=link.frame.point(*arm), axes=link.frame)
    turn = numeric_turn(link, 3)
    origin = s_origin(link, links)

    def place(x: Vector, t: Any) -> Vector:
        out = times(turn(x, t), [number(mp, e) for e in arm])
        return [a + b for a, b in zip(origin(x, t), out, strict=True)]

    oracle.forces.append((lambda x, v, t: times(turn(x, t), [mp.mpf(0), size, 2 * size]), place))


def s_origin(link: Link, links: list[Link]) -> Callable[[Vector, Any], Vector]:
    """Where a link's frame has its origin: at the place of the link whose point it is."""
    (there,) = [other for other in links if other.point is link.frame.origin]
    return numeric_place(there)


def from_quaternion(e: Vector) -> list[Vector]:
    """The rotation matrix of a quaternion (x, y, z, w)."""
    size = dot(e, e)
    x, y, z, w = e
    cross = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
    return [
        [((w * w - x * x - y * y - z * z) * (i == j) + 2 * e[i] * e[j] + 2 * w * cross[i][j]) / size for j in range(3)]
        for i in range(3)
    ]


def exponential(theta: Vector) -> list[Vector]:
    """exp(θ×) by its series, for the tiny θ of quotients."""
    cross = [[0, -theta[2], theta[1]], [theta[2], 0, -theta[0]], [-theta[1], theta[0], 0]]
    total = term = [[mp.mpf(i == j) for j in range(3)] for i in range(3)]
    for k in range(1, 8):
        term = [[x / k for x in row] for row in product(term, cross)]
        total = [[a + b for a, b in zip(one, two, strict=True)] for one, two in zip(total, term, strict=True)]
    return total
