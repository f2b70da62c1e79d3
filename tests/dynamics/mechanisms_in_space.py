"""Mechanisms in space: a door on two ball hinges, a bicycle, and random trees with random rows."""

import numpy as np
import sympy as sp
from closed_loops import Numbers, cos, gap, join, mechanics, place, sin, slip, turn
from dynamics_models import random_links

from lagrangian.dynamics.rows import ConstraintRow
from lagrangian.dynamics.vectors import cross, plus, scaled
from lagrangian.model import Builder, Gravity, RigidBody

DOWN = (0.0, 0.0, -9.81)
BARE = ((0.2, 0.03, 0.01), (0.03, 0.4, -0.02), (0.01, -0.02, 0.5))
"""An inertia without any symmetry."""


def quaternion_turn(e):
    """R of a unit quaternion (x, y, z, w) of numbers or jets."""
    x, y, z, w = e
    hat = np.array([[0 * x, -z, y], [z, 0 * x, -x], [-y, x, 0 * x]], object)
    return np.eye(3) + 2 * (hat * w) + 2 * (hat @ hat)


def quaternion_rates(q, v):
    """(R v, ½ e ∘ (ω, 0))."""
    R = quaternion_turn(q[3:7])
    x, y, z, w = q[3:7]
    a, b, c = v[3:6]
    turning = [w * a + y * c - z * b, w * b + z * a - x * c, w * c + x * b - y * a, -(x * a + y * b + z * c)]
    return np.r_[R @ np.asarray(v[:3], object), np.array([0.5 * k for k in turning], object)]


def door(*, all_rows=True):
    """A free body held by ball hinges at its origin and 2 m above it, along its own z."""
    b = Builder("door")
    frame = b.floating_frame("leaf")
    b.add(RigidBody(mass=3, inertia=BARE, at=frame.point(0.5, 0.1, 1.0, at=frame.origin), frame=frame))
    b.add(Gravity(direction=(0, 0.6, -0.8), g=sp.Float(9.81)))
    m, d = mechanics(b)
    join(m, d, frame.origin, b.origin, "lower hinge")
    join(m, d, frame.point(0, 0, 2, at=frame.origin), b.origin + (0, 0, 2), "upper hinge")
    if not all_rows:
        m.rows.pop()

    def bodies(q):
        R = quaternion_turn(q[3:7])
        return [(3.0, np.array(BARE), q[:3] + R @ np.array([0.5, 0.1, 1.0]), R)]

    def gaps(q):
        upper = q[:3] + quaternion_turn(q[3:7]) @ np.array([0.0, 0, 2]) - np.array([0, 0, 2.0])
        return [*q[:3], *upper]

    return m, Numbers(6, bodies, (0, 0.6 * 9.81, -0.8 * 9.81), gaps, rates=quaternion_rates)


WHEEL = 0.35
REAR, FRONT, BASE = (2.0, 0.06, 0.12), (1.5, 0.05, 0.1), 1.02
HEAD, TRAIL = 0.3, 0.06


def bicycle():
    """A bicycle: four bodies, eight velocities; rolling of both wheels and the height of the front one, five rows."""
    b = Builder("bicycle")
    names = ("x", "y", "yaw", "lean", "rear", "pitch", "steer", "front")
    x, y, yaw, lean, rear, pitch, steer, front = (b.coordinate(name) for name in names)
    contact = b.origin + (x.symbol, y.symbol, 0)
    heading = b.frame("heading", yaw.symbol, axis=(0, 0, 1), origin=contact)
    leaning = b.frame("leaning", lean.symbol, axis=(1, 0, 0), parent=heading, origin=contact)
    hub = leaning.point(0, 0, WHEEL, at=contact)
    rear_wheel = b.frame("rear_wheel", rear.symbol, axis=(0, 1, 0), parent=leaning, origin=hub)
    frame = b.frame("frame", pitch.symbol, axis=(0, 1, 0), parent=leaning, origin=hub)
    head = frame.point(BASE - TRAIL, 0, 0, at=hub)
    tilted = b.frame("tilted", sp.Float(HEAD), axis=(0, 1, 0), parent=frame, origin=head)
    fork = b.frame("fork", steer.symbol, axis=(0, 0, 1), parent=tilted, origin=head)
    axle = fork.point(TRAIL, 0, 0, at=head)
    front_wheel = b.frame("front_wheel", front.symbol, axis=(0, 1, 0), parent=fork, origin=axle)
    for (mass, I, K), wheel, at in ((REAR, rear_wheel, hub), (FRONT, front_wheel, axle)):
        b.add(RigidBody(mass=mass, inertia=np.diag([I, K, I]).tolist(), at=at, frame=wheel))
    b.add(RigidBody(mass=60, inertia=[[40 * x for x in row] for row in BARE], at=frame.point(0.3, 0, 0.6, at=hub),
                    frame=frame))  # fmt: skip
    b.add(RigidBody(mass=4, inertia=BARE, at=fork.point(0.01, 0, 0.3, at=axle), frame=fork))
    b.add(Gravity(direction=(0, 0, -1), g=sp.Float(9.81)))
    m, d = mechanics(b)
    slip(m, d, x.rate - WHEEL * sp.cos(yaw.symbol) * rear.rate, "rear, along")
    slip(m, d, y.rate - WHEEL * sp.sin(yaw.symbol) * rear.rate, "rear, across")
    _front_contact(m, d, axle, fork, front_wheel)

    def parts(q):
        R = turn((0, 0, 1), q[2]) @ turn((1, 0, 0), q[3])
        hub = np.array([q[0], q[1], 0.0]) + R @ np.array([0, 0, WHEEL])
        F = R @ turn((0, 1, 0), q[5])
        head = hub + F @ np.array([BASE - TRAIL, 0, 0])
        S = F @ turn((0, 1, 0), HEAD) @ turn((0, 0, 1), q[6])
        return R, hub, F, S, head + S @ np.array([TRAIL, 0, 0])

    def bodies(q):
        R, hub, F, S, axle = parts(q)
        wheels = [np.diag([I, K, I]) for _, I, K in (REAR, FRONT)]
        return [
            (REAR[0], wheels[0], hub, R @ turn((0, 1, 0), q[4])),
            (FRONT[0], wheels[1], axle, S @ turn((0, 1, 0), q[7])),
            (60.0, 40 * np.array(BARE), hub + F @ np.array([0.3, 0, 0.6]), F),
            (4.0, np.array(BARE), axle + S @ np.array([0.01, 0, 0.3]), S),
        ]

    def gaps(q):
        *_, S, axle = parts(q)
        return [axle[2] - WHEEL * (1 - S[2, 1] * S[2, 1]) ** 0.5]

    return m, Numbers(8, bodies, DOWN, gaps, _slips_of_a_bicycle(parts)), []


def _front_contact(m, d, axle, fork, wheel):
    """The height of the front contact, and no slip there along two level directions."""
    g, motion = m.graph, m.motion
    hub, R = place(m, d, axle), motion.rotation(d.axes[fork])
    n = [R[k][1] for k in range(3)]
    level = g.sqrt(g.sub(g.one, g.mul(n[2], n[2])))
    gap(m, g.sub(motion.position(hub)[2], g.mul(g.const(WHEEL), level)), "front, height")
    down = [g.div(g.mul(n[2], n[0]), level), g.div(g.mul(n[2], n[1]), level), g.neg(level)]
    spin = motion.turned(d.axes[wheel].omega, d.axes[wheel], motion.root)
    v = plus(g, motion.turned(hub.velocity, hub.axes, motion.root), cross(g, spin, scaled(g, g.const(WHEEL), down)))
    for k, name in enumerate(("x", "y")):
        m.rows.append(ConstraintRow(f"front, {name}", "front", v[k]))


def _slips_of_a_bicycle(parts):
    """The rows on velocities as a function of q and its rates, by angular velocities about the axes in turn."""

    def slips(q, rates):
        rear = [rates[0] - WHEEL * cos(q[2]) * rates[4], rates[1] - WHEEL * sin(q[2]) * rates[4]]
        R, _, _, S, axle = parts(q)
        n = S[:, 1]
        level = (1 - n[2] * n[2]) ** 0.5
        down = np.array([n[2] * n[0], n[2] * n[1], n[2] * n[2] - 1.0], object) * level**-1
        z, x = np.array([0, 0, 1.0]), R[:, 0]
        F = R @ turn((0, 1, 0), q[5])
        steering = (F @ turn((0, 1, 0), HEAD))[:, 2]
        body = z * rates[2] + turn((0, 0, 1), q[2])[:, 0] * rates[3] + R[:, 1] * rates[5]
        hub = np.array([q[0], q[1], 0.0], object) + R @ np.array([0, 0, WHEEL])
        v = np.array([rates[0], rates[1], 0.0], object)
        v = v + _cross(z * rates[2] + x * rates[3], R @ np.array([0, 0, WHEEL]))
        head = F @ np.array([BASE - TRAIL, 0, 0])
        v = v + _cross(body, head) + _cross(body + steering * rates[6], axle - hub - head)
        v = v + _cross(body + steering * rates[6] + n * rates[7], down * WHEEL)
        return [*rear, v[0], v[1]]

    return slips


def _cross(a, b):
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]], object)


def random_tree(parents, axes, seed, joints):
    """Links on ``parents`` (−1: the ground), turning about coordinate axes; ``joints`` are (link, link, components).

    The centres of the two links keep those components of their distance.
    """
    links = random_links(len(parents), seed)
    b = Builder("tree")
    frames, origins, centres = [], [], []
    for k, (parent, axis, (_, offset, mass, centre, inertia)) in enumerate(zip(parents, axes, links, strict=True)):
        q = b.coordinate(f"q{k}").symbol
        below, at = (None, b.origin) if parent < 0 else (frames[parent], origins[parent])
        joint = b.origin + tuple(map(float, offset)) if below is None else below.point(*map(float, offset), at=at)
        frames.append(b.frame(f"F{k}", q, axis=tuple(map(int, np.eye(3)[axis])), parent=below, origin=joint))
        origins.append(joint)
        centres.append(frames[-1].point(*map(float, centre), at=joint))
        inertia = [[float(x) for x in row] for row in inertia]
        b.add(RigidBody(mass=float(mass), inertia=inertia, at=centres[-1], frame=frames[-1]))
    b.add(Gravity(direction=(0, 0, -1), g=sp.Float(9.81)))
    m, d = mechanics(b)
    for i, k, components in joints:
        apart = m.motion.between(place(m, d, centres[k]), place(m, d, centres[i]))
        for c in components:
            gap(m, apart[c], f"{i} on {k}, {c}", f"{i} on {k}")

    def bodies(q):
        found, turns, starts = [], [], []
        for k, (_, offset, mass, centre, inertia) in enumerate(links):
            R, r = (np.eye(3), np.zeros(3)) if parents[k] < 0 else (turns[parents[k]], starts[parents[k]])
            starts.append(r + R @ np.array(offset, float))
            turns.append(R @ turn(np.eye(3)[axes[k]], q[k]))
            found.append(
                (float(mass), np.array(inertia, float), starts[k] + turns[k] @ np.array(centre, float), turns[k])
            )
        return found

    def gaps(q):
        r = [body[2] for body in bodies(q)]
        return [(r[i] - r[k])[c] for i, k, components in joints for c in components]

    return m, Numbers(len(parents), bodies, DOWN, gaps)
