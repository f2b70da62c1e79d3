"""Robots in MJCF: the same numbers as MuJoCo's, what is listed, what is refused."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import lagrangian as lg
from lagrangian import dynamics
from lagrangian.errors import ModelError, ParseError
from lagrangian.graph import evaluate
from size import sized

ARM = """<mujoco model="arm">
<compiler angle="degree" eulerseq="zyx"/>
<default>
  <joint damping="0.1" armature="0.02"/><geom density="800"/>
  <default class="heavy"><geom density="3000"/></default>
</default>
<worldbody>
  <geom type="plane" size="1 1 .1"/>
  <body name="upper" pos="0 0 1" euler="10 20 30">
    <joint name="s1" axis="0 1 0" pos="0 0 0.1"/>
    <joint name="s2" axis="1 0 0" stiffness="3" springref="20"/>
    <geom type="capsule" fromto="0 0 0 0.1 0 -0.4" size="0.05"/>
    <geom class="heavy" type="sphere" size="0.08" pos="0 0 -.4"/>
    <body name="fore" pos="0.1 0 -0.4" quat="0.9 0.1 0.2 0.3">
      <joint name="e" axis="0 1 1" ref="15" range="-30 60"/>
      <geom type="box" size=".02 .03 .2" pos="0 0 -.2" axisangle="1 0 0 30" rgba="1 0 0 1"/>
      <body name="rod" pos="0 0 -.4" xyaxes="0 1 0 -1 0 0">
        <joint name="p" type="slide" axis="0 0 1" pos="1 2 3"/>
        <geom type="cylinder" size=".03 .1" mass="0.7"/>
        <geom type="ellipsoid" size=".1 .05 .02" zaxis="1 1 0"/>
      </body>
    </body>
  </body>
  <body name="hook" pos="1 0 1">
    <joint name="h" axis="1 0 0"/>
    <inertial pos="0.1 0 -.2" mass="2" diaginertia=".02 .03 .04" euler="10 0 0"/>
    <geom type="mesh" mesh="hook"/>
  </body>
</worldbody>
<actuator><motor joint="e"/></actuator>
</mujoco>
"""
CRAB = """<mujoco model="crab">
<compiler angle="radian"/><option gravity="0 1 -3"/>
<worldbody>
  <body name="shell" pos="0 0 1">
    <freejoint/><geom type="box" size=".3 .2 .1"/>
    <body name="claw" pos="0.3 0 0">
      <joint name="turn" type="hinge" axis="0 0 1"/>
      <geom type="capsule" fromto="0 0 0 .3 0 .1" size=".04"/>
    </body>
    <body name="leg" pos="0 -.2 0" euler="0.3 0 1.5707963267948966">
      <joint name="hip" axis="1 0 1"/><inertial mass="1" pos="0 0 -.1" fullinertia=".02 .02 .01 .001 0 .002"/>
    </body>
  </body>
</worldbody>
</mujoco>
"""


@pytest.mark.parametrize("text", [ARM.replace('<geom type="mesh" mesh="hook"/>', ""), CRAB], ids=["arm", "crab"])
def test_the_same_as_mujoco(text):
    mujoco = pytest.importorskip("mujoco")
    theirs = mujoco.MjModel.from_xml_string(text)
    theirs.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
    data, system = mujoco.MjData(theirs), lg.loads(text).model
    program, rng = dynamics.forward(system), np.random.default_rng(1)
    free = 7 * len(system.floating)
    names = [c.name for c in system.coordinates[free:]]
    places = [theirs.joint(name).dofadr[0] for name in names]
    p = [x.value for x in system.parameters]
    for _ in range(3):
        q, u = rng.uniform(-1, 1, (2, len(system.coordinates)))
        v = rng.uniform(-1, 1, len(system.velocities))
        u = u[free:]
        for name, place, *values in zip(names, places, q[free:], v[6 * (free > 0) :], u, strict=True):
            data.qpos[theirs.joint(name).qposadr[0]], data.qvel[place], data.qfrc_applied[place] = values
        if free:  # MuJoCo's quaternion begins with w, and its linear motion is along the fixed axes
            q[3:7] /= np.linalg.norm(q[3:7])
            R = turn(q[3:7])
            data.qpos[:7], data.qvel[:6] = q[[0, 1, 2, 6, 3, 4, 5]], [*(R @ v[:3]), *v[3:6]]
        mujoco.mj_forward(theirs, data)
        expected = data.qacc[places]
        if free:
            expected = [*(R.T @ data.qacc[:3] - np.cross(v[3:6], v[:3])), *data.qacc[3:6], *expected]
        found = evaluate(program, {"q": q, "v": v, "u": u, "p": p, "t": [0.0]})["a"]
        np.testing.assert_allclose(found, expected, rtol=1e-10, atol=1e-10 * np.abs(expected).max())
        # their velocities are X v: linear motion along the fixed axes, joints in their own order
        n = len(system.velocities)
        X, turning = np.zeros((n, n)), np.zeros(n)
        if free:
            X[:3, :3], X[3:6, 3:6] = R, np.eye(3)
            turning[:3] = R @ np.cross(v[3:6], v[:3])
        X[places, range(n - len(places), n)] = 1
        whole = np.zeros((n, n))
        mujoco.mj_fullM(theirs, data, whole)
        bias = X.T @ (data.qfrc_bias - data.qfrc_passive - data.qfrc_applied + whole @ turning)
        for make, name, expected in ((dynamics.mass_matrix, "M", X.T @ whole @ X), (dynamics.bias, "h", bias)):
            made = make(system)
            given = {"q": q, "v": v, "u": u, "p": p, "t": [0.0]}
            found = np.array(evaluate(made, {key: given[key] for key in made.inputs})[name])
            np.testing.assert_allclose(found, expected, rtol=1e-10, atol=1e-10 * np.abs(expected).max())


def test_what_is_not_mechanics_is_listed():
    said = lg.loads(ARM).notices[-1].text
    for part in ("<actuator> (line 30)", "<geom> (2 times, first in line 8)", "'rgba' of <geom> (line 16)"):
        assert part in said


def turn(e):
    """R of the quaternion (x, y, z, w), by the product of quaternions e ∘ r ∘ e⁻¹."""
    r, w = e[:3], e[3]
    return np.array([x + 2 * w * np.cross(r, x) + 2 * np.cross(r, np.cross(r, x)) for x in np.eye(3)]).T


BAD = [
    ("</worldbody>", "</worldbody><equality/>", "[E405] <equality>: <equality> is not supported", 29),
    ("<worldbody>", '<include file="/etc/passwd"/><worldbody>', "<include> is not supported", 7),
    ('type="slide"', 'type="ball"', "a ball joint is not supported yet", 18),
    ('type="slide"', 'type="slid"', "there is no joint 'slid'", 18),
    ('class="heavy" type', 'class="heavi" type', "[E402] <geom>: there is no default class 'heavi'", 13),
    ('axisangle="1 0 0 30"', 'axisangle="0 0 0 30"', "[E409] <geom>: 'axisangle' has no direction", 16),
    ('axisangle="1 0 0 30"', 'axisangle="1 0 0 30" quat="1 0 0 0"', "is given by quat and by axisangle", 16),
    ('size=".02 .03 .2"', 'size=".02 .03"', "[E414] <geom>: a box needs 3 positive sizes", 16),
    ('type="ellipsoid"', 'type="mesh"', "the mass of a mesh or a shell is not found from its shape", 20),
    ('name="fore"', 'name="upper"', "there are two of the name 'upper'", 14),
    ('mass="2"', 'mass="inf"', "[E101] <inertial>: 'mass' must be finite", 26),
    ('angle="degree"', 'angle="gon"', "'angle' is neither degree nor radian", 2),
    ('angle="degree"', 'settotalmass="3"', "'settotalmass' is not supported", 2),
    ('<joint name="h"', '<freejoint/><joint name="h"', "a body that floats has one joint", 25),
]


@pytest.mark.parametrize(("old", "new", "said", "line"), BAD, ids=[said[:40] for _, _, said, _ in BAD])
def test_the_message_names_the_mistake_and_its_line(old, new, said, line):
    assert old in ARM
    with pytest.raises(ParseError) as caught:
        lg.loads(ARM.replace(old, new, 1), name="bad.xml")
    assert said in str(caught.value) and f"bad.xml:{line}:" in str(caught.value)


PIECES = st.sampled_from(
    ["<", "/>", '"', "=", "</body>", "<body>", "<freejoint/>", "nan", "-", "0", " ", 'class="heavy"', "e9"]
)


@sized(1000, 40)
@given(st.lists(st.tuples(st.integers(0, len(ARM)), st.integers(0, 9), PIECES), min_size=1, max_size=3))
def test_broken_texts_are_read_or_refused_with_a_place(cuts):
    text = ARM
    for at, length, piece in cuts:
        text = text[:at] + piece + text[at + length :]
    try:
        lg.loads(text, name="broken.xml")
    except ModelError as error:
        assert error.place is not None and error.place.line is not None
