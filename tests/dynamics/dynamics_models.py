"""Models and helpers that the tests of dynamics share."""

import random

import numpy as np
import sympy as sp

from lagrangian.dynamics import Bodies, Mechanics, Motion, programs
from lagrangian.graph import Graph, Output, Program, evaluate
from lagrangian.model import Builder, Gravity, Particle, RigidBody, time

X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)


def state(model, seed):
    """A random state, with the parameters' values where they have one."""
    source = random.Random(seed)
    n = len(model.coordinates)
    return {
        "q": [source.uniform(-1.2, 1.2) for _ in range(n)],
        "v": [source.uniform(-1, 1) for _ in range(n)],
        "u": [source.uniform(-1, 1) for _ in model.inputs],
        "p": [source.uniform(0.5, 1.5) if p.value is None else p.value for p in model.parameters],
        "t": [source.uniform(0, 1)],
    }


def run(program, at, **options):
    """The outputs of a program at a state, as arrays."""
    given = {group: at[group] for group in program.inputs}
    return {name: np.array(value) for name, value in evaluate(program, given, **options).items()}


def chain(n, *, relative):
    """A planar chain of point masses; with relative angles through frames."""
    b = Builder("chain")
    g = b.parameter("g", 9.81).symbol
    at, frame = b.origin, None
    for i in range(n):
        q = b.coordinate(f"q{i}").symbol
        m, L = b.parameter(f"m{i}", 1 + 0.1 * (i % 5)).symbol, b.parameter(f"L{i}", 0.8 + 0.1 * (i % 3)).symbol
        if relative:
            frame = b.frame(None, q, parent=frame, origin=b.origin)
            at = frame.point(0, -L, at=at)
        else:
            at = at + (L * sp.sin(q), -L * sp.cos(q))
        b.add(Particle(mass=m, at=at))
    b.add(Gravity(direction=(0, -1), g=g))
    return b.model()


def graph_chain(n, *, relative, torques=False):
    """The same chain through the layer below models; ``torques`` puts an input and a damper on every coordinate."""
    g = Graph()
    q, v = ([g.input(group, i) for i in range(n)] for group in "qv")
    motion = Motion(g, 2, q, v, v)
    bodies = Bodies(motion)
    place, angle = motion.ground, g.zero
    for i in range(n):
        angle = g.add(angle, q[i]) if relative else q[i]
        L = g.input("p", 2 * i)
        step = [g.mul(L, g.sin(angle)), g.neg(g.mul(L, g.cos(angle)))]
        place = motion.place(place, motion.root, step)
        bodies.add_point(place, g.input("p", 2 * i + 1))
    down = [g.zero, g.neg(g.input("p", 2 * n))]
    damping = g.input("p", 2 * n + 1)
    loads = [(v[i], g.sub(g.input("u", i), g.mul(damping, v[i]))) for i in range(n)] if torques else []
    m = Mechanics(g, motion, bodies, tuple(f"q{i}" for i in range(n)), down, loads)
    names = {"q": m.names, "v": m.names, "u": m.names, "p": tuple(f"p{i}" for i in range(2 * n + 2))}
    return Program("chain", g, names, {"a": Output(tuple(m.forward()), (n,))})


def arm(links, *, gravity=True):
    """A spatial chain of full rigid bodies: ``links`` are (axis, offset of the joint, mass, centre, inertia)."""
    b = Builder("arm")
    frame, origin = None, b.origin
    for i, (axis, offset, mass, centre, inertia) in enumerate(links):
        q = b.coordinate(f"q{i}").symbol
        joint = b.origin + tuple(offset) if frame is None else frame.point(*offset, at=origin)
        frame = b.frame(f"F{i}", q, axis=axis, parent=frame, origin=joint)
        origin = joint
        body = frame.point(*centre)
        b.add(RigidBody(mass=mass, inertia=inertia, at=body, frame=frame))
    if gravity:
        b.add(Gravity(direction=(0, 0, -1), g=b.parameter("g", 9.81).symbol))
    return b.model()


def random_links(n, seed):
    """Random links with full, physical inertias, turning about the coordinate axes and one slanted axis."""
    rng = np.random.default_rng(seed)
    links = []
    for _ in range(n):
        a = rng.normal(size=(3, 3))
        second = a @ a.T * 0.02 + 0.01 * np.eye(3)
        inertia = np.trace(second) * np.eye(3) - second
        axis = [X, Y, Z, (0, 0, -1), (1, 2, 2)][int(rng.integers(5))]
        links.append(
            (
                axis,
                [float(x) for x in rng.uniform(-0.3, 0.3, 3).round(3)],
                round(float(rng.uniform(0.5, 3)), 3),
                [float(x) for x in rng.uniform(-0.2, 0.2, 3).round(3)],
                [[float((inertia + inertia.T)[r, c]) / 2 for c in range(3)] for r in range(3)],
            )
        )
    return links


def newton_euler(links, q, v, a, g=9.81):
    """Joint torques of a chain by Newton and Euler in the fixed axes: forces body by body, then summed up per joint."""
    n = len(links)
    R, p = np.eye(3), np.zeros(3)
    w, alpha = np.zeros(3), np.zeros(3)
    vp_acc = np.zeros(3)
    axes, joints, forces, moments, centres = [], [], [], [], []
    for (axis, offset, mass, centre, inertia), angle, rate, acc in zip(links, q, v, a, strict=True):
        r = R @ np.array(offset)
        vp_acc = vp_acc + np.cross(alpha, r) + np.cross(w, np.cross(w, r))
        p = p + r
        k = np.array(axis, float) / np.linalg.norm(axis)
        e = R @ k
        alpha = alpha + e * acc + np.cross(w, e * rate)
        w = w + e * rate
        K = np.array([[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]])
        R = R @ (np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K)
        c = R @ np.array(centre)
        ac = vp_acc + np.cross(alpha, c) + np.cross(w, np.cross(w, c))
        inertia_fixed = R @ np.array(inertia) @ R.T
        forces.append(mass * (ac + np.array([0, 0, g])))
        moments.append(inertia_fixed @ alpha + np.cross(w, inertia_fixed @ w))
        axes.append(e)
        joints.append(p)
        centres.append(p + c)
    return np.array(
        [
            sum(axes[i] @ (moments[k] + np.cross(centres[k] - joints[i], forces[k])) for k in range(i, n))
            for i in range(n)
        ]
    )


def euler_lagrange(model, at):
    """r = d/dt ∂L/∂q̇ − ∂L/∂q − Ξ at a state with accelerations, by SymPy on the elements' own expressions."""
    coordinates = model.coordinates
    L = sum((e.kinetic(model) - e.potential(model) for e in model.elements), sp.S.Zero)
    L = model.expand(L, constants=True)
    values = {time: at["t"][0]}
    for c, q, v, a in zip(coordinates, at["q"], at["v"], at["a"], strict=True):
        values |= {c.acceleration: a, c.rate: v, c.symbol: q}
    values.update((x.symbol, y) for x, y in zip(model.inputs, at["u"], strict=True))
    values.update((x.symbol, y) for x, y in zip(model.parameters, at["p"], strict=True))
    values = {k: sp.Float(x, 25) for k, x in values.items()}

    def number(e):
        return float(sp.sympify(e).xreplace(values))

    rows = []
    for c in coordinates:
        left = sp.diff(sp.diff(L, c.rate), time) - sp.diff(L, c.symbol)
        forces = sp.S.Zero
        for e in model.elements:
            for action in e.works(model):
                rate = model.expand(sp.sympify(action.rate), constants=True)
                forces += model.expand(action.effort, constants=True) * sp.diff(rate, c.rate)
        rows.append(number(left) - number(forces))
    return np.array(rows)


PROGRAMS = ("forward", "inverse", "mass_matrix", "bias", "potential_force", "coriolis", "energy", "loss")


def all_programs(model):
    """Every program of a model by name."""
    return {name: getattr(programs, name)(model) for name in PROGRAMS}
