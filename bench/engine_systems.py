"""The systems that `engine.py` measures: planar chains, a 7-joint arm, two floating trees."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import sympy as sp
from numpy.typing import NDArray

import lagrangian as lg
from lagrangian import codegen as machine
from lagrangian.dynamics import Bodies, Mechanics, Motion
from lagrangian.graph import Graph, Output, Program
from lagrangian.model import Frame, Point

Array = NDArray[np.float64]
GRAVITY = 9.81
X, Y, Z = range(3)


@dataclass(frozen=True)
class Body:
    """Mass [kg], centre of mass [m] and inertia about it [kg m²], in the axes of its link."""

    mass: float
    centre: tuple[float, ...]
    inertia: tuple[tuple[float, ...], ...]


@dataclass(frozen=True)
class Link:
    """A body on a turning joint: in the parent's axes at ``offset``, a quarter turn about x where ``quarter`` is ±1,
    then the joint's own turn about coordinate axis ``axis``. ``parent`` −1 is the ground, or the body that floats.
    """

    parent: int
    axis: int
    offset: tuple[float, ...]
    body: Body
    quarter: int = 0


@dataclass(frozen=True)
class Tree:
    """Links, limb after limb from the root outwards, and the body that floats, if one does.

    q = (p, e, angles) and v = (velocity of the origin, ω, rates) with the quaternion e = (x, y, z, w), p in fixed and
    the velocities in body axes; forces likewise. Without a floating body q and v are angles and rates.
    """

    name: str
    links: tuple[Link, ...]
    floats: Body | None = None

    @property
    def nq(self) -> int:
        """How many coordinates."""
        return len(self.links) + (7 if self.floats else 0)

    @property
    def nv(self) -> int:
        """How many velocities."""
        return len(self.links) + (6 if self.floats else 0)

    def states(self, count: int, seed: int = 1) -> tuple[Array, Array, Array]:
        """Random q, v and forces."""
        rng = np.random.default_rng(seed)
        q = rng.uniform(-1, 1, (count, self.nq))
        if self.floats:
            q[:, 3:7] = rng.normal(size=(count, 4))
            q[:, 3:7] /= np.linalg.norm(q[:, 3:7], axis=1, keepdims=True)
        return q, rng.uniform(-1, 1, (count, self.nv)), rng.uniform(-1, 1, (count, self.nv))


def _body(rng: np.random.Generator, mass: float, size: float) -> Body:
    """A body with a full inertia that a body of about that size can have."""
    frame = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    second = frame @ np.diag(rng.uniform(0.5, 1.5, 3) * mass * size**2 / 12) @ frame.T
    inertia = np.trace(second) * np.eye(3) - second
    inertia = (inertia + inertia.T) / 2
    centre = rng.uniform(-0.2, 0.2, 3) * size
    return Body(mass, tuple(map(float, centre)), tuple(tuple(map(float, row)) for row in inertia))


def planar_tree(n: int) -> Tree:
    """The planar chain of point masses as a tree in space."""
    none = ((0.0,) * 3,) * 3
    lengths, masses = chain_values(n)
    offsets = [(0.0, 0.0, 0.0), *[(0.0, 0.0, -length) for length in lengths[:-1]]]
    bodies = [Body(m, (0.0, 0.0, -length), none) for m, length in zip(masses, lengths, strict=True)]
    links = [Link(i - 1, Y, offset, body) for i, (offset, body) in enumerate(zip(offsets, bodies, strict=True))]
    return Tree(f"{n}-link chain", tuple(links))


def chain_values(n: int) -> tuple[list[float], list[float]]:
    """Lengths [m] and masses [kg] of the chain's links, no two alike."""
    i = np.arange(n)
    return (0.8 + 0.1 * np.cos(i + 2.0)).tolist(), (1.0 + 0.1 * np.sin(i + 1.0)).tolist()


def chain(n: int, *, relative: bool) -> lg.System:
    """A planar chain of point masses, masses and lengths parameters; angles from the vertical or from the parent."""
    s = lg.System(f"{n}-link chain")
    lengths, masses = chain_values(n)
    at, frame = s.origin, None
    for i in range(n):
        q, L, m = s.coordinate(f"q{i}"), s.parameter(f"L{i}", lengths[i]), s.parameter(f"m{i}", masses[i])
        if relative:
            frame = s.frame(q, parent=frame, origin=s.origin)
            at = frame.point(0, -L, at=at)
        else:
            at = at + (L * sp.sin(q), -L * sp.cos(q))
        s.particle(m, at=at)
    s.gravity()
    return s


def chain_program(n: int, *, relative: bool) -> Program:
    """The same chain through the layer below systems: q, v, p → v̇, with p = (L0, m0, L1, m1, …, g)."""
    g = Graph()
    q, v = ([g.input(name, i) for i in range(n)] for name in "qv")
    motion = Motion(g, 2, q, v, v)
    bodies, at, angle = Bodies(motion), motion.ground, g.zero
    for i in range(n):
        angle = g.add(angle, q[i]) if relative else q[i]
        L, m = g.input("p", 2 * i), g.input("p", 2 * i + 1)
        at = motion.place(at, motion.root, [g.mul(L, g.sin(angle)), g.neg(g.mul(L, g.cos(angle)))])
        bodies.add_point(at, m)
    names = {key: tuple(f"{key}{i}" for i in range(count)) for key, count in (("q", n), ("v", n), ("p", 2 * n + 1))}
    mechanics = Mechanics(g, motion, bodies, names["v"], [g.zero, g.neg(g.input("p", 2 * n))])
    return Program("chain", g, names, {"a": Output(tuple(mechanics.forward()), (n,))})


def arm_tree() -> Tree:
    """A 7-joint arm with the proportions of a Franka Panda and full inertias, its axes a quarter turn apart."""
    rng = np.random.default_rng(7)
    quarters = (0, -1, 1, 1, -1, 1, 1)
    offsets = [(0, 0, 0.333), (0, 0, 0), (0, -0.316, 0), (0.0825, 0, 0), (-0.0825, 0.384, 0), (0, 0, 0), (0.088, 0, 0)]
    masses = (3.0, 2.9, 2.6, 2.5, 2.2, 1.8, 1.2)
    links = [Link(i - 1, Z, tuple(map(float, offsets[i])), _body(rng, masses[i], 0.3), quarters[i]) for i in range(7)]
    return Tree("7-joint arm", tuple(links))


def _limbs(links: list[Link], root: int, joints: Sequence[tuple[int, tuple[float, ...], Body]]) -> int:
    """Add a limb of (axis, offset, body) to a link; return the number of its last one."""
    for axis, offset, body in joints:
        links.append(Link(root, axis, offset, body))
        root = len(links) - 1
    return root


def quadruped_tree() -> Tree:
    """A floating trunk with four legs of three joints: 18 velocities."""
    rng = np.random.default_rng(18)
    trunk = _body(rng, 9.0, 0.4)
    links: list[Link] = []
    for fore, side in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
        hip = (X, (0.19 * fore, 0.05 * side, 0.0), _body(rng, 0.7, 0.1))
        thigh = (Y, (0.0, 0.08 * side, 0.0), _body(rng, 1.0, 0.2))
        shank = (Y, (0.0, 0.0, -0.21), _body(rng, 0.2, 0.2))
        _limbs(links, -1, (hip, thigh, shank))
    return Tree("quadruped", tuple(links), trunk)


def humanoid_tree() -> Tree:
    """A floating pelvis with two torso joints, two legs of six joints and two arms of five: 30 velocities."""
    rng = np.random.default_rng(30)
    pelvis = _body(rng, 8.0, 0.3)
    links: list[Link] = []

    def joint(axis: int, x: float, y: float, z: float, mass: float) -> tuple[int, tuple[float, ...], Body]:
        return axis, (x, y, z), _body(rng, mass, 0.25)

    chest = _limbs(links, -1, (joint(Z, 0, 0, 0.1, 2.0), joint(Y, 0, 0, 0.05, 15.0)))
    for side in (0.2, -0.2):
        shoulder = joint(Y, 0, side, 0.35, 1.0), joint(X, 0, 0.15 * side, 0, 1.0), joint(Z, 0, 0, -0.05, 1.5)
        _limbs(links, chest, (*shoulder, joint(Y, 0, 0, -0.25, 1.2), joint(Z, 0, 0, -0.22, 0.6)))
    for side in (0.1, -0.1):
        hip = joint(Z, 0, side, -0.05, 1.0), joint(X, 0, 0.2 * side, 0, 1.0), joint(Y, 0, 0, -0.05, 4.0)
        shin = joint(Y, 0, 0, -0.35, 2.5), joint(Y, 0, 0, -0.35, 0.5), joint(X, 0, 0, -0.03, 0.9)
        _limbs(links, -1, (*hip, *shin))
    return Tree("humanoid", tuple(links), pelvis)


Pins = Mapping[int, tuple[Sequence[float], Sequence[float]]]
"""Link → a point of it, in its axes, and the point of the ground at which a ball joint holds it."""


def described(tree: Tree, pins: Pins | None = None) -> lg.System:
    """A tree as a system: a frame a joint, a rigid body a link, an input a velocity, the base's wrench in its axes."""
    s = lg.System(tree.name)
    frames: list[Frame] = []
    joints: list[Point] = []
    base = s.floating_frame("base") if tree.floats else None
    if base and tree.floats:
        wrench = s.inputs([f"w{i}" for i in range(6)])
        s.rigid_body(tree.floats.mass, _rows(tree.floats), base.point(*tree.floats.centre), base)
        s.force(wrench[:3], at=base.origin, axes=base)
        s.torque(wrench[3:], on=base, axes=base)
    for i, link in enumerate(tree.links):
        q, u = s.coordinate(f"q{i}"), s.input(f"u{i}")
        parent, above = (frames[link.parent], joints[link.parent]) if link.parent >= 0 else (base, None)
        joint = parent.point(*link.offset, at=above) if parent else s.origin + link.offset
        if link.quarter:
            parent = s.frame(link.quarter * sp.pi / 2, axis=(1, 0, 0), parent=parent, origin=joint)
        frame = s.frame(q, axis=[int(link.axis == k) for k in range(3)], parent=parent, origin=joint)
        s.rigid_body(link.body.mass, _rows(link.body), frame.point(*link.body.centre, at=joint), frame)
        s.torque(u, on=q)
        frames.append(frame)
        joints.append(joint)
    for i, (foot, place) in (pins or {}).items():
        s.ball((frames[i].point(*foot, at=joints[i]), s.origin + tuple(place)), name=f"foot {i}")
    s.gravity(direction=(0, 0, -1), g=GRAVITY)
    return s


def _rows(body: Body) -> list[list[float]]:
    return [list(row) for row in body.inertia]


def kernel_of(tree: Tree) -> machine.Kernel:
    """Forward dynamics of a tree, compiled for one core."""
    program = described(tree).compile(threads=1).program("forward")
    return machine.compile(program, optional={"u": 0.0, "t": 0.0}, threads=1)
