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
