"""Reactions of joints against free bodies: forces and moments added up in NumPy from the accelerations alone."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import sympy as sp

import lagrangian as lg

GRAVITY = 9.81
DOWN = np.array([0.0, -GRAVITY])


def chain(n: int) -> tuple[lg.System, list[tuple[float, float]]]:
    """Links pinned to each other, by absolute angles; their masses and lengths."""
    s = lg.System(f"chain of {n}")
    angles = s.coordinates(" ".join(f"q{i}" for i in range(1, n + 1)))
    angles = angles if isinstance(angles, (tuple, list)) else (angles,)
    s.gravity((0, -1), GRAVITY)
    at, sizes = s.origin, []
    for i in range(n):
        m, length = 1 + 0.3 * i, 1 - 0.04 * i
        f = s.frame(angle=angles[i], origin=at, name=f"F{i + 1}")
        s.rigid_body(m, m * length**2 / 12, at=f.point(length / 2, 0), frame=f, name=f"rod {i + 1}")
        at = f.point(length, 0, name=f"P{i + 1}")
        sizes.append((m, length))
    return s, sizes


def link_accelerations(sizes: Any, q: Any, v: Any, a: Any) -> list[np.ndarray]:
    """The accelerations of the centres, by differentiating L (cos q, sin q) twice."""
    found, end = [], np.zeros(2)
    for (_, length), angle, rate, change in zip(sizes, q, v, a, strict=True):
        across = np.array([-np.sin(angle), np.cos(angle)])
        step = length * (change * across - rate**2 * np.array([np.cos(angle), np.sin(angle)]))
        found.append(end + step / 2)
        end = end + step
    return found


@pytest.mark.sampled(2)
@pytest.mark.parametrize("n", [3, 10])
def test_the_pins_of_a_chain_carry_what_accelerates_everything_beyond_them(n: int) -> None:
    s, sizes = chain(n)
    rng = np.random.default_rng(n)
    q, v = rng.uniform(-1, 1, (2, n))
    dyn = s.compile()
    centres = link_accelerations(sizes, q, v, dyn.forward(q, v))
    total = np.zeros(2)
    for i in reversed(range(n)):
        total = total + sizes[i][0] * (centres[i] - DOWN)
        pin = dyn.reaction(f"P{i}" if i else "origin", q, v)
        assert pin.force == pytest.approx(total, abs=1e-11), i
        assert float(pin.torque) == pytest.approx(0, abs=1e-11)
        assert pin.on == f"rod {i + 1}"
    inner = dyn.reaction("P1", q, v, on="rod 1").force
    assert inner == pytest.approx(-dyn.reaction("rod 2", q, v).force, abs=1e-12)


def test_a_pinned_rod_that_is_let_go_level_loads_its_pin_with_a_quarter_of_its_weight() -> None:
    s, sizes = chain(1)
    run = s.simulate(0.5, samples=51)
    m, length = sizes[0]
    angle, rate = run["q1"], run["q1'"]
    pin = run.reaction("origin")
    assert pin.force.shape == (51, 2) and pin.torque.shape == (51,)
    assert pin.force[0] == pytest.approx([0, m * GRAVITY / 4], abs=1e-12)
    change = -1.5 * GRAVITY / length * np.cos(angle)
    along, across = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
    exact = m * length / 2 * (change * across - rate**2 * along).T - m * DOWN
    assert pin.force == pytest.approx(exact, abs=1e-11)
    turned = run.reaction("origin", axes="F1").force
    assert turned[:, 0] == pytest.approx(np.sum(exact * along.T, axis=1), abs=1e-11)
    assert run.reaction("origin", on="ground").force == pytest.approx(-exact, abs=1e-11)


def fourbar() -> tuple[lg.System, list[tuple[float, float]], np.ndarray]:
    s, sizes = chain(3)
    pivot = s.point("pivot", (1.2, 0))
    s.constraint(between=(s["P3"], pivot), name="loop")
    return s, sizes, np.array([1.2, 0.0])


def free_bodies(sizes: Any, q: Any, v: Any, a: Any) -> np.ndarray:
    """The forces on the inner end of every link and on the last end, from 3 equations a link, by least squares."""
    n, rows, right = len(sizes), [], []
    centres = link_accelerations(sizes, q, v, a)
    for i, (m, length) in enumerate(sizes):
        half = length / 2 * np.array([np.cos(q[i]), np.sin(q[i])])
        for k in range(2):  # force balance; the next link pushes back with −F
            row = np.zeros(2 * (n + 1))
            row[2 * i + k], row[2 * i + 2 + k] = 1, 1 if i == n - 1 else -1
            rows.append(row)
            right.append(m * (centres[i] - DOWN)[k])
        row, sign = np.zeros(2 * (n + 1)), 1 if i == n - 1 else -1
        row[2 * i : 2 * i + 2] = half[1], -half[0]  # (−half) × F
        row[2 * i + 2 : 2 * i + 4] = -sign * half[1], sign * half[0]
        rows.append(row)
        right.append(m * length**2 / 12 * a[i])
    found, *_ = np.linalg.lstsq(np.array(rows), np.array(right), rcond=None)
    return found.reshape(-1, 2)


@pytest.mark.slow
def test_the_pins_of_a_four_bar_agree_with_its_free_bodies() -> None:
    s, sizes, _ = fourbar()
    dyn = s.compile()
    q, v = dyn.assemble({"q1": 1.2, "q2": 0.2, "q3": -1.0}, {"q1'": 2.0}, fixed="q1")
    forces = free_bodies(sizes, q, v, dyn.forward(q, v))
    for k, name in enumerate(("origin", "P1", "P2")):
        assert dyn.reaction(name, q, v).force == pytest.approx(forces[k], abs=1e-9), name
    loop = dyn.reaction("loop", q, v)
    assert loop.force == pytest.approx(forces[3], abs=1e-9)  # on the rocker's end, the first point
    assert loop.on == "rod 3" and loop.at == "P3"
    assert dyn.reaction("loop", q, v, on="pivot").force == pytest.approx(-forces[3], abs=1e-9)
    assert dyn.reaction("loop", q, v, on="rod 3").force == pytest.approx(forces[3], abs=1e-9)
    lam = dyn.multipliers(q, v)
    assert loop.force == pytest.approx(np.array([lam["loop.x"], lam["loop.y"]]))


def test_a_rod_of_constant_length_pulls_with_its_tension() -> None:
    s = lg.System("rod pendulum")
    x, y = s.coordinates("x y")
    bob = s.point("bob", (x, y))
    s.particle(2.0, at=bob, name="ball")
    s.gravity((0, -1), GRAVITY)
    s.constraint(between=(bob, s.origin), distance=1.5, name="rod")
    angle, speed = 0.7, 1.1
    e = np.array([np.sin(angle), -np.cos(angle)])
    dyn = s.compile()
    q, v = 1.5 * e, 1.5 * speed * np.array([np.cos(angle), np.sin(angle)])
    tension = 2 * GRAVITY * np.cos(angle) + 2 * 1.5 * speed**2
    assert dyn.reaction("rod", q, v).force == pytest.approx(-tension * e)
    assert dyn.reaction("rod", q, v, on="origin").force == pytest.approx(tension * e)


def test_the_point_mass_of_a_pendulum_hangs_on_the_origin() -> None:
    s = lg.System("pendulum")
    theta = s.coordinates("theta")
    s.particle(2.0, at=s.point("P", (1.5 * sp.sin(theta), -1.5 * sp.cos(theta))), name="bob")
    s.gravity((0, -1), GRAVITY)
    tension = 2 * GRAVITY * np.cos(0.7) + 2 * 1.5 * 1.1**2
    pull = -tension * np.array([np.sin(0.7), -np.cos(0.7)])
    assert s.compile().reaction("origin", [0.7], [1.1]).force == pytest.approx(pull)


def test_a_guide_holds_across_and_against_tipping_but_not_along() -> None:
    """A block on a rail, pushed at a height: N = m g, no force along, and a moment F h against tipping."""
    s = lg.System("block")
    x = s.coordinates("x")
    centre = s.point("C", (x, 0.2))
    frame = s.frame(angle=0, origin=centre, name="B")
    s.rigid_body(3.0, 0.5, at=centre, frame=frame, name="block")
    s.gravity((0, -1), GRAVITY)
    s.force((7.0, 0), at=centre + (0, 0.3), name="push")
    s.spring(100.0, deflection=x)
    guide = s.compile().reaction("block", [0.1], [0.4])
    assert guide.force == pytest.approx([0, 3 * GRAVITY], abs=1e-12)
    assert float(guide.torque) == pytest.approx(7 * 0.3)


def test_a_motor_of_a_joint_is_no_part_of_its_reaction_however_it_is_described() -> None:
    forces = []
    for kind in ("angle", "frames"):
        s = lg.System("arm")
        q1, q2 = s.coordinates("q1 q2")
        f1 = s.frame(angle=q1, name="F1")
        s.rigid_body(1.0, 0.1, at=f1.point(0.5, 0), frame=f1, name="upper")
        B = f1.point(1, 0, name="B")
        f2 = s.frame(angle=q2, parent=f1, origin=B, name="F2")
        s.rigid_body(0.7, 0.05, at=f2.point(0.4, 0), frame=f2, name="fore")
        tau = s.input("tau")
        if kind == "angle":
            s.torque(tau, on=q2)
        else:
            s.torque(tau, on=f2, reaction=f1)
        elbow = s.compile().reaction("B", [0.3, 0.6], [1.0, -0.5], {"tau": 4.0})
        assert float(elbow.torque) == pytest.approx(0, abs=1e-12)
        forces.append(elbow.force)
    assert forces[0] == pytest.approx(forces[1], abs=1e-12)


def test_a_disc_that_rolls_down_is_held_back_by_a_third_of_its_weights_share() -> None:
    """m g sin β − F = m a and F r = ½ m r² a / r: F = m g sin β / 3, uphill; the normal force is m g cos β."""
    s = lg.System("rolling down")
    x, phi = s.coordinates("x phi")
    r, m, slope = 0.3, 2.0, 0.4
    centre = s.point("C", (x, r))
    turning = s.frame(angle=-phi, origin=centre, name="D")
    disc = s.rigid_body(m, m * r**2 / 2, at=centre, frame=turning, name="disc")
    s.gravity((sp.Float(np.sin(slope)), -sp.Float(np.cos(slope))), GRAVITY)
    s.rolling(disc, at=s.point("K", (x, 0)), along=(1, 0), name="contact")
    dyn = s.compile()
    friction = dyn.reaction("contact", [0, 0], [0.6, 2.0])
    assert friction.force == pytest.approx([-m * GRAVITY * np.sin(slope) / 3, 0])
    assert dyn.reaction("contact", [0, 0], [0.6, 2.0], on="ground").force == pytest.approx(-friction.force)


def test_a_body_on_two_pins_says_that_their_shares_are_not_determined() -> None:
    s = lg.System("shelf")
    x, y, phi = s.coordinates("x y phi")
    f = s.frame(angle=phi, origin=s.point("C", (x, y)), name="S")
    s.rigid_body(4.0, 0.3, at=s["C"], frame=f, name="shelf")
    s.gravity((0, -1), GRAVITY)
    for name, side in (("left", -0.5), ("right", 0.5)):
        s.pin((f.point(side, 0, name=f"{name}_end"), s.point(f"{name}_nail", (side, 0))), name=name)
    dyn = s.compile()
    left, right = (dyn.reaction(name, [0, 0, 0], [0, 0, 0]) for name in ("left", "right"))
    assert left.force + right.force == pytest.approx([0, 4 * GRAVITY])
    assert left.force[1] == pytest.approx(2 * GRAVITY)
    assert any("share" in str(notice) for notice in left.notices)


def test_what_is_no_joint_is_answered_with_those_that_are() -> None:
    s, _ = chain(2)
    dyn = s.compile()
    for asked, said in (("P2", "no body hangs on it"), ("elbow", "no joint 'elbow'")):
        with pytest.raises(lg.ModelError, match=said) as trouble:
            dyn.reaction(asked, [0, 0], [0, 0])
        assert "origin, P1, rod 1, rod 2" in trouble.value.fix
    with pytest.raises(lg.ModelError, match="no body, frame or point 'rod 7'"):
        dyn.reaction("P1", [0, 0], [0, 0], on="rod 7")
    with pytest.raises(lg.ModelError, match="'P1' does not join the ground"):
        dyn.reaction("P1", [0, 0], [0, 0], on="ground")
    x = s.coordinates("x")
    s.particle(1.0, at=s.point("Q", (sp.cos(x), sp.sin(x))), name="other")
    with pytest.raises(lg.ModelError, match="2 parts are held at 'origin': 'other', 'rod 1'"):
        s.compile().reaction("origin", [0, 0, 0], [0, 0, 0])


def test_energies_that_name_no_body_are_refused() -> None:
    s, _ = chain(1)
    s.potential(s["q1"] ** 2)
    with pytest.raises(lg.ModelError, match="does not say on which bodies"):
        s.compile().reaction("origin", [0], [0])


def test_a_deflection_that_names_no_points_is_refused() -> None:
    s, _ = chain(1)
    s.spring(10.0, deflection=sp.sin(s["q1"]))
    with pytest.raises(lg.ModelError, match="at which points"):
        s.compile().reaction("origin", [0], [0])


# -- in space ---------------------------------------------------------------------------------------------------


def about(axis: int, angle: float) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    R = np.eye(3)
    R[i, i], R[i, j], R[j, i], R[j, j] = c, -s, s, c
    return R


MASSES = (3.0, 2.0)
TENSORS = (
    np.array([[0.3, 0.02, 0.01], [0.02, 0.2, -0.03], [0.01, -0.03, 0.25]]),
    np.array([[0.1, -0.01, 0.02], [-0.01, 0.15, 0.01], [0.02, 0.01, 0.12]]),
)
CENTRES = (np.array([0.1, -0.05, 0.3]), np.array([0.4, 0.05, -0.1]))
SHOULDER = np.array([0.2, 0.0, 0.5])


def arm_in_space() -> lg.System:
    """A column that turns about z, and an arm that turns about the column's y, with centres and tensors askew."""
    s = lg.System("arm in space")
    q1, q2 = s.coordinates("q1 q2")
    s.gravity((0, 0, -1), GRAVITY)
    base = s.point("base", (0, 0, 0))
    f1 = s.frame(angle=q1, axis=(0, 0, 1), origin=base, name="F1")
    s.rigid_body(MASSES[0], TENSORS[0].tolist(), at=f1.point(*CENTRES[0]), frame=f1, name="column")
    shoulder = f1.point(*SHOULDER, name="shoulder")
    f2 = s.frame(angle=q2, axis=(0, 1, 0), parent=f1, origin=shoulder, name="F2")
    s.rigid_body(MASSES[1], TENSORS[1].tolist(), at=f2.point(*CENTRES[1]), frame=f2, name="arm")
    s.torque(s.input("tau"), on=q2)
    return s


def wrench_of_free_bodies(q: Any, v: Any, a: Any) -> list[tuple[np.ndarray, np.ndarray]]:
    """(force, torque) at the shoulder and at the base, by Newton and Euler in the fixed axes."""
    z = np.array([0, 0, 1.0])
    R1 = about(2, q[0])
    R2 = R1 @ about(1, q[1])
    y = R1[:, 1]
    omega = [v[0] * z, v[0] * z + v[1] * y]
    alpha = [a[0] * z, a[0] * z + a[1] * y + v[1] * np.cross(omega[0], y)]
    shoulder = R1 @ SHOULDER
    arms = [R1 @ CENTRES[0], R2 @ CENTRES[1]]

    def carried(i: int, r: np.ndarray) -> np.ndarray:
        return np.cross(alpha[i], r) + np.cross(omega[i], np.cross(omega[i], r))

    accelerations = [carried(0, arms[0]), carried(0, shoulder) + carried(1, arms[1])]
    forces, moments = [], []
    for i, R in enumerate((R1, R2)):
        tensor = R @ TENSORS[i] @ R.T
        forces.append(MASSES[i] * (accelerations[i] + GRAVITY * z))
        moments.append(tensor @ alpha[i] + np.cross(omega[i], tensor @ omega[i]))
    outer = forces[1], moments[1] + np.cross(arms[1], forces[1])
    inner = (
        forces[0] + outer[0],
        moments[0] + np.cross(arms[0], forces[0]) + outer[1] + np.cross(shoulder, outer[0]),
    )
    return [outer, inner]


def test_the_joints_of_an_arm_in_space_carry_force_and_the_torque_across_their_axes() -> None:
    dyn = arm_in_space().compile()
    q, v, tau = np.array([0.4, -0.7]), np.array([1.3, -0.8]), 5.0
    a = dyn.forward(q, v, {"tau": tau})
    (force, torque), (base_force, base_torque) = wrench_of_free_bodies(q, v, a)
    R1 = about(2, q[0])
    y = R1[:, 1]
    assert torque @ y == pytest.approx(tau)  # the motor's share of the moment
    joint = dyn.reaction("shoulder", q, v, {"tau": tau})
    assert joint.force == pytest.approx(force, abs=1e-11)
    assert joint.torque == pytest.approx(torque - tau * y, abs=1e-11)
    turned = dyn.reaction("arm", q, v, {"tau": tau}, axes="F1")
    assert turned.force == pytest.approx(R1.T @ force, abs=1e-11)
    assert turned.torque == pytest.approx(R1.T @ (torque - tau * y), abs=1e-11)
    assert turned.at == "shoulder" and turned.on == "arm"
    foot = dyn.reaction("base", q, v, {"tau": tau})
    assert foot.force == pytest.approx(base_force, abs=1e-11)
    assert base_torque[2] == pytest.approx(0, abs=1e-10)
    assert foot.torque == pytest.approx(base_torque, abs=1e-10)
    states = dyn.reaction("shoulder", np.tile(q, (4, 1)), np.tile(v, (4, 1)), {"tau": tau})
    assert states.torque.shape == (4, 3)
    assert states.torque[3] == pytest.approx(joint.torque)


def test_a_floating_body_is_held_by_nothing_and_holds_what_hangs_on_it() -> None:
    s = lg.System("satellite")
    F = s.floating_frame("F")
    s.rigid_body(5.0, [1, 2, 3], at=F.origin, frame=F, name="hub")
    q1 = s.coordinates("q1")
    hinge = F.point(0.5, 0, 0, name="hinge")
    panel = s.frame(angle=q1, axis=(0, 0, 1), parent=F, origin=hinge, name="G")
    s.rigid_body(0.8, [0.1, 0.2, 0.3], at=panel.point(0.4, 0, 0), frame=panel, name="panel")
    dyn = s.compile()
    q = np.array([1.0, 2.0, 3.0, 0, 0, 0, 1.0, 0.3])
    v = np.array([0.2, -0.1, 0.3, 0.5, -0.4, 0.7, 1.1])
    assert dyn.coordinates[-1] == "q1"
    a = dyn.forward(q, v)
    omega, alpha, z = v[3:6], a[3:6], np.array([0, 0, 1.0])
    start = a[:3] + np.cross(omega, v[:3])
    r, arm = np.array([0.5, 0, 0]), 0.4 * np.array([np.cos(0.3), np.sin(0.3), 0])
    w2 = omega + v[6] * z
    a2 = alpha + a[6] * z + np.cross(omega, v[6] * z)
    there = start + np.cross(alpha, r) + np.cross(omega, np.cross(omega, r))
    centre = there + np.cross(a2, arm) + np.cross(w2, np.cross(w2, arm))
    assert dyn.reaction("hinge", q, v, on="panel").force == pytest.approx(0.8 * centre, abs=1e-12)
    R = about(2, 0.3)
    tensor = R @ np.diag([0.1, 0.2, 0.3]) @ R.T
    moment = tensor @ a2 + np.cross(w2, tensor @ w2) + np.cross(arm, 0.8 * centre)
    assert moment[2] == pytest.approx(0, abs=1e-12)
    assert dyn.reaction("panel", q, v).torque == pytest.approx(moment, abs=1e-12)
    hub = dyn.reaction("hub", q, v)
    assert hub.force == pytest.approx(np.zeros(3), abs=1e-12)
    assert hub.torque == pytest.approx(np.zeros(3), abs=1e-12)


def test_a_weld_in_space_holds_a_shelf_up_and_level() -> None:
    """A body that floats is welded to the ground off its centre: force m g, torque m g times the arm."""
    s = lg.System("cantilever")
    F = s.floating_frame("F")
    s.rigid_body(2.0, [1, 2, 3], at=F.origin, frame=F, name="shelf")
    s.gravity((0, 0, -1), GRAVITY)
    s.weld((F.point(-0.5, 0, 0), s.point("wall", (0, 0, 0))), bodies=F, name="weld")
    q, v = [0.5, 0, 0, 0, 0, 0, 1], np.zeros(6)
    weld = s.compile().reaction("weld", q, v)
    assert weld.force == pytest.approx([0, 0, 2 * GRAVITY], abs=1e-11)
    assert weld.torque == pytest.approx([0, -2 * GRAVITY * 0.5, 0], abs=1e-11)


def test_a_coordinate_that_moves_two_joints_leaves_neither_free() -> None:
    """A disc with x = r φ: what holds it at its centre is m a = m g sin β − F, and the torque F r that turns it."""
    s = lg.System("geared disc")
    phi = s.coordinates("phi")
    r, m, slope = 0.3, 2.0, 0.4
    centre = s.point("C", (r * phi, r))
    turning = s.frame(angle=-phi, origin=centre, name="D")
    s.rigid_body(m, m * r**2 / 2, at=centre, frame=turning, name="disc")
    s.gravity((sp.Float(np.sin(slope)), -sp.Float(np.cos(slope))), GRAVITY)
    held = s.compile().reaction("disc", [0.2], [1.0])
    friction = m * GRAVITY * np.sin(slope) / 3
    assert held.force == pytest.approx([-friction, m * GRAVITY * np.cos(slope)])
    assert float(held.torque) == pytest.approx(-friction * r)
