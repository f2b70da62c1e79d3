"""Frames that turn in ball joints: Pinocchio's spherical joint, laws of motion, files, changes of coordinates."""

import numpy as np
import pytest

import lagrangian as lg
from lagrangian import dynamics
from lagrangian.coordinates import changed
from lagrangian.errors import ModelError
from lagrangian.graph import evaluate
from lagrangian.verify.motion import verify_motion

INERTIA = [[0.03, 0.001, 0.002], [0.001, 0.04, 0.003], [0.002, 0.003, 0.02]]
CENTRE = (0.1, -0.2, -0.5)


def swing() -> lg.System:
    """A turntable that carries an arm in a ball joint, with damping and a moment in the joint."""
    s = lg.System("swing")
    table = s.frame(s.coordinate("turn"), axis=(0, 0, 1), name="table")
    s.rigid_body(2, (0.1, 0.1, 0.2), at=table.point(0, 0, 0), frame=table)
    arm = s.ball_frame("arm", parent=table, origin=s.point("shoulder", (0.1, 0.2, 0.3), frame=table))
    s.rigid_body(1.5, INERTIA, at=arm.point(*CENTRE), frame=arm)
    s.gravity(direction=(0, 0, -1))
    s.torque((s.input("tau"), 0, 0), on=arm, reaction=table, axes=arm)
    s.dissipation(s.parameter("b", 0.1) * sum(s[f"arm_w{k}"] ** 2 for k in "xyz") / 2)
    return s


def test_the_same_as_pinocchios_spherical_joint():
    pin = pytest.importorskip("pinocchio")
    theirs, model = pin.Model(), swing().model
    theirs.gravity.linear = np.array([0, 0, -9.81])
    table = theirs.addJoint(0, pin.JointModelRZ(), pin.SE3.Identity(), "turn")
    theirs.appendBodyToJoint(table, pin.Inertia(2, np.zeros(3), np.diag([0.1, 0.1, 0.2])), pin.SE3.Identity())
    joint = pin.JointModelSpherical()
    arm = theirs.addJoint(table, joint, pin.SE3(np.eye(3), np.array([0.1, 0.2, 0.3])), "arm")
    theirs.appendBodyToJoint(arm, pin.Inertia(1.5, np.array(CENTRE), np.array(INERTIA)), pin.SE3.Identity())
    data, rng = theirs.createData(), np.random.default_rng(2)
    program, p = dynamics.forward(model), [x.value for x in model.parameters]
    for _ in range(3):
        q, v, u = rng.normal(size=5), rng.uniform(-1, 1, 4), rng.uniform(-1, 1, 1)
        force = np.array([0, u[0], 0, 0]) - [0, *0.1 * v[1:]]
        expected = pin.aba(theirs, data, np.array([q[0], *q[1:] / np.linalg.norm(q[1:])]), v, force)
        found = evaluate(program, {"q": q, "v": v, "u": u, "p": p, "t": [0.0]})["a"]
        np.testing.assert_allclose(found, expected, rtol=1e-11, atol=1e-12)


def test_two_routes_and_the_laws_of_motion():
    checks = verify_motion(swing().model, states=3)
    assert len(checks) > 5 and all(check.holds for check in checks)


def test_a_file_says_what_python_says():
    text = swing().to_toml()
    assert 'ball = true\nafter = "turn"\nparent = "table"\norigin = "shoulder"' in text
    again = lg.loads(text)
    assert again.to_toml() == text


@pytest.mark.slow
def test_other_coordinates_leave_the_joint_alone():
    system = swing()
    moved = changed(system.model, {system["turn"]: system.coordinate("other") / 2})
    assert [c.name for c in moved.coordinates][1:] == ["arm_qx", "arm_qy", "arm_qz", "arm_qw"]
    assert moved.frames[1].floating.held and moved.frames[1].parent is moved.frames[0]


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("ball = true", "ball = true\nangle = 0", "it turns in a ball joint, so it has no 'angle'"),
        ("ball = true", "ball = true\nfloating = true", "it floats, so it has no 'parent'"),
        ('after = "turn"', 'after = "turm"', "no coordinate or frame with a quaternion 'turm'"),
        ('origin = "shoulder"', 'origin = "below"', "their definitions form a circle: frame 'arm' → point 'below'"),
    ],
)
def test_what_a_ball_joint_has_no_use_for_is_refused(old, new, said):
    text = swing().to_toml().replace("[points]", '[points]\nbelow = { frame = "arm", offset = [0, 0, -1] }')
    with pytest.raises(ModelError) as caught:
        lg.loads(text.replace(old, new))
    assert said in str(caught.value)


def test_a_torque_without_direction_and_an_entry_of_the_quaternion_are_refused():
    s = swing()
    with pytest.raises(ModelError, match="turns freely, so a single value does not say"):
        s.torque(1, on=s["arm"])
    with pytest.raises(ModelError, match="act on arm_wx or arm_wy or arm_wz"):
        s.generalized_force(s["arm_qx"], 1)
