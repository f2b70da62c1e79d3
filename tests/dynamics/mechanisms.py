"""Mechanisms with closed loops and rolling, each as mechanics in a graph and as `Numbers`."""

import numpy as np
import sympy as sp
from closed_loops import Numbers, cos, gap, join, mechanics, place, sin, slip, turn

from lagrangian.model import Builder, Gravity, Particle, RigidBody

DOWN = np.array([0.0, -9.81])


def bar(b, k, at, size):
    """A uniform bar of length ``size`` from ``at``, its angle q_k counted from the fixed axes."""
    l, m, J = (b.parameter(f"{name}{k}", x).symbol for name, x in zip("lmJ", (size, 1 + size, 0.3 * size), strict=True))
    frame = b.frame(f"bar{k}", b.coordinate(f"q{k}").symbol, origin=at)
    b.add(RigidBody(mass=m, inertia=J, at=frame.point(l / 2, 0, at=at), frame=frame))
    return frame.point(l, 0, at=at)


def planar(loops, sizes, tree):
    """Bars on the ends of earlier bars (``tree``: number, or a point of the ground), ends closed on ends or ground.

    Returns mechanics, `Numbers` and the parameters' values.
    """
    b = Builder("bars")
    ends = []
    for k, (size, below) in enumerate(zip(sizes, tree, strict=True)):
        ends.append(bar(b, k, b.origin + tuple(below) if isinstance(below, tuple) else ends[below], size))
    b.add(Gravity(direction=(0, -1), g=sp.Float(9.81)))
    m, d = mechanics(b)
    for k, (i, other) in enumerate(loops):
        join(m, d, ends[i], b.origin + tuple(other) if isinstance(other, tuple) else ends[other], f"loop {k}")

    def points(q):
        starts, tips = [], []
        for size, below, angle in zip(sizes, tree, q, strict=True):
            start = np.array(below) if isinstance(below, tuple) else tips[below]
            starts.append(start)
            tips.append(start + size * np.array([cos(angle), sin(angle)]))
        return starts, tips

    def bodies(q):
        starts, tips = points(q)
        return [(1 + s, 0.3 * s, (x + y) * 0.5, a) for s, x, y, a in zip(sizes, starts, tips, q, strict=True)]

    def gaps(q):
        _, tips = points(q)
        return [x for i, o in loops for x in tips[i] - (np.array(o) if isinstance(o, tuple) else tips[o])]

    p = [x for s in sizes for x in (s, 1 + s, 0.3 * s)]
    return m, Numbers(len(sizes), bodies, DOWN, gaps), p


def four_bar():
    return planar([(2, (1.5, 0.2))], [0.6, 1.4, 0.9], [(0, 0), 0, 1])


def five_bar():
    return planar([(1, 3)], [0.7, 1.1, 0.8, 1.2], [(0, 0), 0, (1.3, 0.0), 2])


def ladder(count):
    """Four-bars, each on the coupler of the one before: its crank on the coupler's start, its rocker on the end."""
    sizes, tree, loops = [], [], []
    for i in range(count):
        start, base = ((0.0, 0.0), (1.2, 0.0)) if i == 0 else (3 * i - 3, 3 * i - 2)
        sizes += [0.7 + 0.01 * i, 1.1, 0.8]
        tree += [start, 3 * i, base]
        loops.append((3 * i + 1, 3 * i + 2))
    return planar(loops, sizes, tree)


def double_parallelogram():
    """Three equal cranks under one platform: one of the four rows depends on the others where the loops close."""
    b = Builder("parallelograms")
    cranks = [bar(b, k, b.origin + (x, 0.0), 1.0) for k, x in enumerate((0.0, 1.0, 2.0))]
    frame = b.frame("platform", b.coordinate("q3").symbol, origin=cranks[0])
    middle, end = frame.point(1.0, 0, at=cranks[0]), frame.point(2.0, 0, at=cranks[0])
    b.add(RigidBody(mass=2.0, inertia=0.5, at=middle, frame=frame))
    b.add(Gravity(direction=(0, -1), g=sp.Float(9.81)))
    m, d = mechanics(b)
    join(m, d, middle, cranks[1], "first")
    join(m, d, end, cranks[2], "second")

    def points(q):
        tips = [np.array([x + cos(a), sin(a)]) for x, a in zip((0.0, 1.0, 2.0), q, strict=False)]
        along = np.array([cos(q[3]), sin(q[3])])
        return tips, tips[0] + along, tips[0] + 2.0 * along

    def bodies(q):
        tips, middle, _ = points(q)
        bars = [
            (2.0, 0.3, (tip + np.array([x, 0.0])) * 0.5, a) for x, tip, a in zip((0.0, 1.0, 2.0), tips, q, strict=False)
        ]
        return [*bars, (2.0, 0.5, middle, q[3])]

    def gaps(q):
        tips, middle, end = points(q)
        return [*(middle - tips[1]), *(end - tips[2])]

    return m, Numbers(4, bodies, DOWN, gaps), [1.0, 2.0, 0.3] * 3


def slider_crank():
    b = Builder("slider crank")
    A = bar(b, 0, b.origin, 0.5)
    B = bar(b, 1, A, 1.3)
    slider = b.origin + (b.coordinate("x").symbol, 0)
    b.add(Particle(mass=0.8, at=slider))
    b.add(Gravity(direction=(0, -1), g=sp.Float(9.81)))
    m, d = mechanics(b)
    join(m, d, B, slider, "pin")

    def points(q):
        A = 0.5 * np.array([cos(q[0]), sin(q[0])])
        return A, A + 1.3 * np.array([cos(q[1]), sin(q[1])]), np.array([q[2], 0.0])

    def bodies(q):
        A, B, C = points(q)
        return [(1.5, 0.15, A * 0.5, q[0]), (2.3, 0.39, (A + B) * 0.5, q[1]), (0.8, 0.0, C, 0.0)]

    return m, Numbers(3, bodies, DOWN, lambda q: points(q)[1] - points(q)[2]), [0.5, 1.5, 0.15, 1.3, 2.3, 0.39]


def sleigh():
    b = Builder("sleigh")
    x, y, theta = (b.coordinate(name) for name in ("x", "y", "theta"))
    mass, J, a = (b.parameter(name, value).symbol for name, value in (("m", 1.3), ("J", 0.4), ("a", 0.5)))
    knife = b.origin + (x.symbol, y.symbol)
    frame = b.frame("body", theta.symbol, origin=knife)
    b.add(RigidBody(mass=mass, inertia=J, at=frame.point(a, 0, at=knife), frame=frame))
    m, d = mechanics(b)
    slip(m, d, y.rate * sp.cos(theta.symbol) - x.rate * sp.sin(theta.symbol), "knife edge")

    def bodies(q):
        return [(1.3, 0.4, np.array([q[0] + 0.5 * cos(q[2]), q[1] + 0.5 * sin(q[2])]), q[2])]

    def slips(q, rates):
        return [rates[1] * cos(q[2]) - rates[0] * sin(q[2])]

    return m, Numbers(3, bodies, (0.0, 0.0), slips=slips), [1.3, 0.4, 0.5]


def rolling_disc():
    b = Builder("disc")
    x, y, psi, theta, phi = (b.coordinate(name) for name in ("x", "y", "psi", "theta", "phi"))
    numbers = [("m", 1.2), ("I", 0.3), ("K", 0.5), ("r", 0.7), ("g", 9.81)]
    mass, I, K, r, g = (b.parameter(name, value).symbol for name, value in numbers)
    contact = b.origin + (x.symbol, y.symbol, 0)
    yaw = b.frame("yaw", psi.symbol, axis=(0, 0, 1), origin=contact)
    lean = b.frame("lean", theta.symbol, axis=(1, 0, 0), parent=yaw, origin=contact)
    centre = lean.point(0, 0, r, at=contact)
    wheel = b.frame("wheel", phi.symbol, axis=(0, 1, 0), parent=lean, origin=centre)
    b.add(RigidBody(mass=mass, inertia=((I, 0, 0), (0, K, 0), (0, 0, I)), at=centre, frame=wheel))
    b.add(Gravity(direction=(0, 0, -1), g=g))
    m, d = mechanics(b)
    slip(m, d, x.rate - r * sp.cos(psi.symbol) * phi.rate, "no slip, x")
    slip(m, d, y.rate - r * sp.sin(psi.symbol) * phi.rate, "no slip, y")

    def bodies(q):
        R = turn((0, 0, 1), q[2]) @ turn((1, 0, 0), q[3])
        centre = np.array([q[0], q[1], 0.0]) + R @ np.array([0, 0, 0.7])
        return [(1.2, np.diag([0.3, 0.5, 0.3]), centre, R @ turn((0, 1, 0), q[4]))]

    def slips(q, rates):
        return [rates[0] - 0.7 * cos(q[2]) * rates[4], rates[1] - 0.7 * sin(q[2]) * rates[4]]

    return m, Numbers(5, bodies, (0, 0, -9.81), slips=slips), [x for _, x in numbers]


def hinge(b, m, d, frame, at, name):
    """The axis z of ``frame`` stays along −y and ``at`` at (−1, 0, 0)."""
    r = m.motion.position(place(m, d, at))
    R = m.motion.rotation(d.axes[frame])
    for node, axis in ((m.graph.add(r[0], m.graph.one), "x"), (r[1], "y"), (r[2], "z")):
        gap(m, node, f"{name}.{axis}", name)
    for k in (0, 2):
        gap(m, R[k][2], f"{name}.turn {'xyz'[k]}", name)


def bricard():
    """Six equal links of length 1, twisted by ±90° in turns; the regular loop of Bricard, which should not move."""
    b = Builder("bricard")
    frame, at = None, b.origin
    for k in range(5):
        joint = b.frame(f"joint{k}", b.coordinate(f"q{k}").symbol, axis=(0, 0, 1), parent=frame, origin=at)
        centre, tip = joint.point(sp.Rational(1, 2), 0, 0, at=at), joint.point(1, 0, 0, at=at)
        b.add(RigidBody(mass=1 + k, inertia=np.diag([0.1, 0.2, 0.3 + 0.1 * k]).tolist(), at=centre, frame=joint))
        frame = b.frame(f"twist{k}", sp.pi / 2 * (-1) ** k, axis=(1, 0, 0), parent=joint, origin=tip)
        b.add(Particle(mass=sp.Rational(1, 10), at=frame.point(0, 0, 0, at=tip)))
        at = tip
    b.add(Gravity(direction=(0, 0, -1), g=sp.Float(9.81)))
    m, d = mechanics(b)
    hinge(b, m, d, frame, at, "sixth")

    def chain(q):
        R, r, found = np.eye(3), np.zeros(3), []
        for k in range(5):
            R = R @ turn((0, 0, 1), q[k])
            centre, tip = r + R @ np.array([0.5, 0, 0]), r + R @ np.array([1.0, 0, 0])
            found += [(1 + k, np.diag([0.1, 0.2, 0.3 + 0.1 * k]), centre, R), (0.1, np.zeros((3, 3)), tip, R)]
            R, r = R @ turn((1, 0, 0), np.pi / 2 * (-1) ** k), tip
        return found, r, R

    def gaps(q):
        _, r, R = chain(q)
        return [r[0] + 1.0, r[1], r[2], R[0, 2], R[2, 2]]

    return m, Numbers(5, lambda q: chain(q)[0], (0, 0, -9.81), gaps), []


def closed(numbers, q, v, keep=()):
    """A state near q, v that satisfies the rows: Newton's steps, then one on the velocities."""
    q = np.array(q, float)
    for _ in range(50):
        f = np.array(numbers.gaps(q), float)
        if len(f) == 0 or np.abs(f).max() < 1e-15:
            break
        q = q + numbers.step(q, f, keep)
    _, c, _ = numbers.rows(q, v)
    return q, v + numbers.step(q, c)
