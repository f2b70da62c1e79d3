"""Arms, chains and a platform: systems whose equations fill pages when they are written out."""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

import lagrangian as lg

AXES = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1)}


def arm(axes: str, offsets: Sequence[Sequence[str]], name: str, *, full: bool = False) -> lg.System:
    """An arm of revolute joints about ``axes``; ``offsets`` lead from each joint to the next; a torque a joint."""
    s = lg.System(name)
    frame, joint = None, s.origin
    for k, (axis, offset) in enumerate(zip(axes, offsets, strict=True), 1):
        q, u = s.coordinate(f"q{k}"), s.input(f"tau{k}")
        step = [s.parameter(x, 0.2 + k / 20) if x else 0 for x in offset]
        if any(offset):
            joint = frame.point(*step, at=joint) if frame else s.origin + tuple(step)
        frame = s.frame(q, axis=AXES[axis], parent=frame, origin=joint)
        m = s.parameter(f"m{k}", 1 + k / 10)
        c = [s.parameter(f"c{k}{a}", 0.1) if full or a != "y" else 0 for a in "xyz"]
        s.rigid_body(m, _inertia(s, k, full=full), frame.point(*c, at=joint), frame)
        s.torque(u, on=q)
    s.gravity(direction=(0, 0, -1))
    return s


def _inertia(s: lg.System, k: int, *, full: bool) -> list[list[object]]:
    main = [s.parameter(f"I{k}{a}{a}", 0.2) for a in "xyz"]
    mixed = {pair: s.parameter(f"I{k}{pair}", 0.01) if full else 0 for pair in ("xy", "xz", "yz")}
    return [
        [main[0], mixed["xy"], mixed["xz"]],
        [mixed["xy"], main[1], mixed["yz"]],
        [mixed["xz"], mixed["yz"], main[2]],
    ]


def puma() -> lg.System:
    """Six joints with the axes and offsets of a PUMA 560 (Armstrong, Khatib and Burdick, ICRA 1986)."""
    offsets = (("", "", ""), ("", "d2", ""), ("a2", "", ""), ("d4", "", "a3"), ("", "", ""), ("", "", ""))
    return arm("zyyxyx", offsets, "PUMA 560")


def armstrongs_puma() -> lg.System:
    """The same arm as its source has it: its axes, centres of mass and inertias, motors, a symmetric last link."""
    s = lg.System("PUMA 560")
    quarter, at, frame = sp.pi / 2, s.origin, None
    twists = (0, -quarter, 0, quarter, -quarter, quarter)
    offsets = ("", "", "a2", "a3", "", ""), ("", "d2", "d3", "d4", "", "")
    centres = ("", "", ""), ("x2", "y2", "z2"), ("", "y3", "z3"), ("", "", "z4"), ("", "", ""), ("", "", "z6")
    values: dict[str, float] = {"a2": 0.4318, "a3": -0.0203, "d2": 0.2435, "d3": -0.0934, "d4": 0.4331}
    values |= {"m2": 17.40, "m3": 4.80, "m4": 0.82, "m5": 0.34, "m6": 0.09}
    values |= {"x2": 0.068, "y2": 0.006, "z2": -0.016, "y3": -0.070, "z3": 0.014, "z4": -0.019, "z6": 0.032}
    values |= {"C1": 0.35, "A2": 0.130, "B2": 0.524, "C2": 0.539, "A3": 0.066, "B3": 0.0125, "C3": 0.086, "A4": 1.8e-3}
    values |= {"B4": 1.8e-3, "C4": 1.3e-3, "A5": 0.3e-3, "B5": 0.3e-3, "C5": 0.4e-3, "A6": 0.15e-3, "C6": 0.04e-3}
    values |= {"J1": 1.14, "J2": 4.71, "J3": 0.827, "J4": 0.200, "J5": 0.179, "J6": 0.193}

    def known(name: str) -> object:
        return s.parameter(name, values[name]) if name else 0

    for k in range(6):
        q, number = s.coordinate(f"q{k + 1}"), k + 1
        twisted = s.frame(twists[k], axis=AXES["x"], parent=frame)
        along, d = known(offsets[0][k]), known(offsets[1][k])
        at = at + (along, 0, 0) if frame is None else frame.point(along, 0, 0, at=at)
        at = twisted.point(0, 0, d, at=at)
        frame = s.frame(q, axis=AXES["z"], parent=twisted)
        across, axial = known(f"A{number}") if k else 0, known(f"C{number}")
        other = known(f"B{number}") if 0 < k < 5 else across
        mass = known(f"m{number}") if k else 0
        s.rigid_body(mass, (across, other, axial), frame.point(*map(known, centres[k]), at=at), frame)
        s.kinetic(known(f"J{number}") * q.diff() ** 2 / 2)
    s.gravity(direction=(0, 0, -1))
    return s


def seven_joints() -> lg.System:
    """Seven joints and full inertias, with the offsets of a Franka Panda."""
    offsets = (
        *(("", "", "d1"), ("", "", ""), ("", "", "d3"), ("a4", "", "")),
        *(("a5", "", "d5"), ("", "", ""), ("a7", "", "")),
    )
    return arm("zyzyzyz", offsets, "seven joints", full=True)


def chain(n: int, *, relative: bool) -> lg.System:
    """A chain of point masses in the plane, its angles from the vertical or from the link before."""
    s = lg.System(f"{n} links")
    at, frame = s.origin, None
    for i in range(1, n + 1):
        q, L, m = s.coordinate(f"q{i}"), s.parameter(f"L{i}", 0.8), s.parameter(f"m{i}", 1.0)
        if relative:
            frame = s.frame(q, parent=frame, origin=s.origin)
            at = frame.point(0, -L, at=at)
        else:
            at = at + (L * sp.sin(q), -L * sp.cos(q))
        s.particle(m, at=at)
    s.gravity()
    return s


def platform() -> lg.System:
    """A plate on four springs that have a rest length: six coordinates, roots of long sums."""
    s = lg.System("platform")
    x, y, z, psi, theta, phi = s.coordinates("x y z psi theta phi")
    m, A, B, C, k, L, w, d, b = s.parameters("m A B C k L w d b")
    yaw = s.frame(psi, axis=AXES["z"])
    pitch = s.frame(theta, axis=AXES["y"], parent=yaw)
    centre = s.origin + (x, y, z)
    plate = s.frame(phi, axis=AXES["x"], parent=pitch, origin=centre)
    s.rigid_body(m, [A, B, C], centre, plate)
    for i, j in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
        corner, foot = plate.point(i * w, j * d, 0, at=centre), s.origin + (i * w, j * d, -L)
        s.spring(k, between=(corner, foot), rest=L)
    s.damper(b, between=(centre, s.origin))
    s.gravity(direction=(0, 0, -1))
    return s


def crooked_chain(n: int) -> lg.System:
    """Links in the plane whose next joint lies beside their axis: velocities hold heights."""
    s = lg.System(f"{n} crooked links")
    frame, joint = None, s.origin
    m, a, b = s.parameters("m a b")
    for i in range(1, n + 1):
        q = s.coordinate(f"q{i}")
        if frame is not None:
            joint = frame.point(a, b, at=joint)
        frame = s.frame(q, parent=frame, origin=joint)
        s.particle(m, at=frame.point(a, -b, at=joint), name=f"body {i}")
    s.gravity()
    return s


def numeric_arm() -> lg.System:
    """Four joints with numbers for lengths: rounded in different places in different formulas."""
    s = lg.System("numbers")
    frame, joint = None, s.origin
    for k, axis in enumerate("zyyx", 1):
        q = s.coordinate(f"q{k}")
        if frame is not None:
            joint = frame.point(sp.Float("0.43"), sp.Float("0.1501"), sp.Rational(1, 5), at=joint)
        frame = s.frame(q, axis=AXES[axis], parent=frame, origin=joint)
        s.rigid_body(1.3, [0.21, 0.17, 0.09], frame.point(0.07, 0.013, 0.031, at=joint), frame, name=f"link {k}")
    s.gravity(direction=(0, 0, -1))
    return s


def two_gravities() -> lg.System:
    """A link and its payload in one frame, a second link, and weights along two directions."""
    s = lg.System("two gravities")
    m, M, n, L, J, K, g, h = s.parameters("m M n L J K g h")
    q1, q2 = s.coordinates("q1 q2")
    one = s.frame(q1)
    s.rigid_body(m, J, one.point(L, 0), one, name="link")
    s.rigid_body(M, K, one.point(2 * L, L), one, name="payload")
    two = s.frame(q2, parent=one, origin=one.point(2 * L, 0))
    s.particle(n, at=two.point(L, 0, at=two.origin), name="tip")
    s.gravity(direction=(0, -1), g=g)
    s.gravity(direction=(1, 0), g=h, name="wind")
    s.damper(law=lambda rate: 2 * rate * sp.Abs(rate), deflection=q2)
    return s


def satellite() -> lg.System:
    """A floating body with two arms of three joints."""
    s = lg.System("satellite with two arms")
    base = s.floating_frame("base")
    m, A, B, C, w = s.parameters("m0 A B C w")
    s.rigid_body(m, (A, B, C), base.origin, base)
    for side, sign in (("l", 1), ("r", -1)):
        parent, at = base, base.point(0, sign * w, 0)
        for k, axis in enumerate("zyy", 1):
            q, u = s.coordinate(f"q{side}{k}"), s.input(f"tau{side}{k}")
            if k > 1:
                at = parent.point(s.parameter(f"L{side}{k}"), 0, 0, at=at)
            parent = s.frame(q, axis=AXES[axis], parent=parent, origin=at)
            mass, c = s.parameters(f"m{side}{k} c{side}{k}")
            inertia = [s.parameter(f"I{side}{k}{a}") for a in "xyz"]
            s.rigid_body(mass, inertia, parent.point(c, 0, 0, at=at), parent)
            s.torque(u, on=q)
    return s
