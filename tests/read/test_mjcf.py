"""Robots in MJCF: the same numbers as MuJoCo's, what is listed, what is refused."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mujoco_robots import MujocoOracle

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


JOINTED = """<mujoco model="jointed">
<compiler angle="radian"/>
<default>
  <joint damping="0.2"/><position kp="20" kv="3"/>
  <default class="affine">
    <general biastype="affine" gaintype="affine" gainprm="2 .3 .4" biasprm=".5 -.6 -.7"/>
  </default>
</default>
<worldbody>
  <body name="torso" pos="0 0 1">
    <joint name="root" type="free" damping="0"/><geom type="box" size=".2 .1 .3"/>
    <site name="thruster" pos=".1 .2 .3" euler=".3 .2 .1"/>
    <body name="arm" pos=".2 0 .3" euler="0.3 0.2 1">
      <joint name="shoulder" type="ball" pos="0 .02 .05" armature=".01" range="0 1"/>
      <geom type="capsule" fromto="0 0 0 .3 .1 0" size=".04"/>
      <body name="fore" pos=".3 .1 0">
        <joint name="elbow" axis="0 1 1"/><joint name="slide" type="slide" axis="1 0 0"/>
        <geom type="capsule" fromto="0 0 0 .2 0 0.1" size=".03"/>
        <body name="hand" pos=".2 0 .1">
          <joint name="wrist" type="ball"/><geom type="box" size=".05 .02 .06" pos=".05 0 0"/>
        </body>
      </body>
    </body>
  </body>
  <body name="bob" pos="1 0 1">
    <joint name="hook" type="ball" pos="0 0 .2"/><geom type="ellipsoid" size=".1 .2 .3"/>
  </body>
</worldbody>
"""
ACTUATORS = """<actuator>
  <motor name="elbow" joint="elbow" gear="30"/><position joint="slide"/>
  <position name="servo" joint="elbow" kp="7" gear="-2" ctrlrange="-1 2"/><velocity joint="slide" kv="4" gear=".5"/>
  <motor name="twist" joint="shoulder" gear="1 2 -.5"/><motor jointinparent="shoulder" gear=".1 .2 .3"/>
  <motor joint="root" gear="1 2 3 4 5 6"/><motor jointinparent="root" gear="1 2 3 4 5 6"/>
  <motor name="thrust" site="thruster" gear="0 0 1 0 0 -.02"/><velocity joint="slide" kv="1"/>
  <general class="affine" joint="elbow"/><damper joint="elbow" kv="2" ctrlrange="0 1"/>
  <velocity joint="wrist" kv="2" gear="1 .5 .2"/><position name="one" joint="elbow" kp="1" kv="1"/>
</actuator>
"""
DRIVEN = JOINTED + ACTUATORS + "</mujoco>"
MEMBERS = {
    "arm": ARM.replace('<geom type="mesh" mesh="hook"/>', ""),
    "crab": CRAB,
    "balls": JOINTED + "</mujoco>",
    "driven": DRIVEN,
}


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", list(MEMBERS))
def test_the_same_as_mujoco(name):
    mujoco = pytest.importorskip("mujoco")
    compared(mujoco, mujoco.MjModel.from_xml_string(MEMBERS[name]), lg.loads(MEMBERS[name]))


def compared(mujoco, theirs, system, rtol=1e-10):
    """M, bias and forward of a system against MuJoCo's at a random state."""
    oracle, model = MujocoOracle(mujoco, theirs), system.model
    p = [x.value for x in model.parameters]
    programs = [make(model) for make in (dynamics.mass_matrix, dynamics.bias, dynamics.forward)]
    for q, v, u in oracle.states(1, len(model.inputs)):
        given = {"q": q, "v": v, "u": u, "p": p, "t": [0.0]}
        for program, expected in zip(programs, oracle.at(q, v, u), strict=True):
            found = next(iter(evaluate(program, {key: given[key] for key in program.inputs}).values()))
            np.testing.assert_allclose(found, expected, rtol=rtol, atol=rtol * np.abs(expected).max())


def test_actuators_are_inputs_and_what_is_not_read_is_told():
    text = DRIVEN.replace(
        "</actuator>",
        '<muscle joint="elbow"/>\n<general joint="elbow" dyntype="integrator"/><position joint="wrist"/>'
        '<motor name="pull" body="t"/><position joint="elbow" dampratio="1"/></actuator>',
    )
    system = lg.loads(text)
    names = [u.name for u in system.model.inputs]
    assert names[:5] == ["u_elbow", "u_slide", "servo", "u_slide_2", "twist"] and len(names) == 14
    said = " ".join(n.text for n in system.notices)
    for part in (
        "servo drives elbow (control -1 to 2)",
        "thrust drives a point of torso",
        "<muscle> (line 37): it has a state or a law of its own",
        "<general> (line 38): its dyntype is 'integrator'",
        "<position> (line 38): its effort depends on how far its joint has turned",
        "motor 'pull' (line 38): it drives something other than one joint, tendon or site",
        "its dampratio needs what is not read",
        "no actuator drives these joints, so they have no input: hook",
    ):
        assert part in said
    gear, kp, kv, q, u = (system[name] for name in ("gear_servo", "kp_servo", "kv_servo", "elbow", "servo"))
    assert gear * (kp * (u - gear * q) - kv * gear * q.diff()) in [getattr(e, "value", None) for e in system.elements]


def test_a_robot_with_ball_joints_is_saved_and_derived():
    text = JOINTED[: JOINTED.index('  <body name="torso"')] + JOINTED[JOINTED.index('  <body name="bob"') :]
    system = lg.loads(text + "</mujoco>")
    assert [v.name for v in system.model.velocities] == ["bob_on_hook_wx", "bob_on_hook_wy", "bob_on_hook_wz"]
    again = lg.loads(system.to_toml())
    assert again.to_toml() == system.to_toml() and again.model.frames[0].floating.held
    derivation = system.derive()
    assert "turns in a ball joint" in str(derivation) and len(derivation.equations) == 3


def test_what_is_not_mechanics_is_listed():
    said = lg.loads(ARM).notices[-1].text
    for part in ("<geom> (2 times, first in line 8)", "'rgba' of <geom> (line 16)"):
        assert part in said


BAD = [
    ('type="slide"', 'type="ball" stiffness="1"', "springs and friction of a ball joint are not supported", 18),
    ("<worldbody>", '<option><flag damper="disable"/></option><worldbody>', "'damper' cannot be disabled", 7),
    ('joint="e"/>', 'joint="f"/>', "[E402] <motor>: there is no joint 'f'", 30),
    ('joint="e"/>', 'site="f"/>', "[E402] <motor>: there is no site 'f'", 30),
    ('joint="e"/>', 'joint="e" gear="1e999"/>', "[E101] <motor>: 'gear' must be finite", 30),
    ('joint="e"/>', 'joint="e" class="f"/>', "[E402] <motor>: there is no default class 'f'", 30),
    ('type="slide"', 'type="slid"', "there is no joint 'slid'", 18),
    ('class="heavy" type', 'class="heavi" type', "[E402] <geom>: there is no default class 'heavi'", 13),
    ('axisangle="1 0 0 30"', 'axisangle="0 0 0 30"', "[E409] <geom>: 'axisangle' has no direction", 16),
    ('axisangle="1 0 0 30"', 'axisangle="1 0 0 30" quat="1 0 0 0"', "is given by quat and by axisangle", 16),
    ('size=".02 .03 .2"', 'size=".02 .03"', "[E414] <geom>: a box needs 3 positive sizes", 16),
    ('type="ellipsoid"', 'type="mesh"', "[E402] <geom>: there is no mesh ''", 20),
    ('type="ellipsoid"', 'shellinertia="true" type="box"', "the mass of a box or a shell is not found", 20),
    ('name="fore"', 'name="upper"', "there are two of the name 'upper'", 14),
    ('mass="2"', 'mass="inf"', "[E101] <inertial>: 'mass' must be finite", 26),
    ('angle="degree"', 'angle="gon"', "'angle' is neither degree nor radian", 2),
    ('angle="degree"', 'boundmass="3"', "'boundmass' is not supported", 2),
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
