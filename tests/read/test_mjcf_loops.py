"""MJCF that is written out (files, frames, copies), tendons with springs, and loops: the same numbers as MuJoCo's."""

import numpy as np
import pytest
from test_mjcf import compared

import lagrangian as lg
from lagrangian import dynamics
from lagrangian.errors import ParseError
from lagrangian.graph import evaluate
from lagrangian.read.robots import mjcf_expanded

POST = """<mujocoinclude><worldbody>
  <body name="post" pos="0 1 1"><joint name="turn" axis="0 0 1" damping=".1"/>
    <geom type="capsule" fromto="0 0 0 0 .2 .3" size=".02"/></body>
</worldbody></mujocoinclude>
"""
LEGS = """<mujoco><compiler angle="degree"/><include file="parts/post.xml"/>
<default><default class="light"><geom density="400"/></default></default>
<worldbody>
  <replicate count="2" offset="1 .2 0" euler="0 0 40" sep="-">
    <body name="leg" pos="0 .1 0" gravcomp=".4"><joint name="hip" pos="0 0 .1" axis="1 0 0"/>
      <frame pos="0 0 -.3" euler="30 0 0" childclass="light">
        <geom type="box" size=".1 .05 .2" pos="0 .1 0"/>
        <geom type="capsule" fromto="0 0 0 .1 .2 .1" size=".03"/>
        <body name="foot" pos="0 0 -.2">
          <frame euler="0 90 0" pos=".01 0 0"><joint name="ankle" axis="1 0 0" pos=".1 0 .02" stiffness="3"/></frame>
          <geom size=".1" pos=".02 0 0"/>
        </body>
      </frame>
    </body>
  </replicate>
</worldbody>
<tendon>
  <fixed name="cord" stiffness="5" damping=".2" springlength=".3" armature=".1">
    <joint joint="hip-0" coef="1"/><joint joint="ankle-0" coef="-.5"/>
  </fixed>
  <fixed name="belt"><joint joint="hip-1" coef="2"/><joint joint="ankle-1" coef=".25"/></fixed>
</tendon>
<actuator><position name="grip" tendon="belt" kp="3" gear="-2"/><motor tendon="cord"/><motor joint="turn"/></actuator>
</mujoco>
"""


def test_included_files_frames_copies_and_fixed_tendons_are_as_in_mujoco(tmp_path):
    mujoco = pytest.importorskip("mujoco")
    path = tmp_path / "legs.xml"
    path.write_text(LEGS, encoding="utf-8")
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "post.xml").write_text(POST, encoding="utf-8")
    system = lg.load(path)
    assert [c.name for c in system.model.coordinates] == ["turn", "hip_0", "ankle_0", "hip_1", "ankle_1"]
    compared(mujoco, mujoco.MjModel.from_xml_path(str(path)), system)


LOOPS = """<mujoco><compiler angle="degree"/>
<worldbody>
  <body name="crank" pos="0 0 1"><joint name="a" axis="0 1 0" ref="20"/>
    <geom type="capsule" fromto="0 0 0 0 0 .3" size=".02"/>
    <body name="rod" pos="0 0 .3" euler="0 70 0"><joint name="b" axis="0 1 0"/>
      <geom type="capsule" fromto="0 0 0 0 0 .8" size=".02"/></body></body>
  <body name="rocker" pos=".9 0 1" euler="0 -20 0"><joint name="c" axis="0 1 0"/>
    <geom type="capsule" fromto="0 0 0 0 0 .5" size=".02"/></body>
  <body name="free" pos="2 0 1"><freejoint/><geom type="box" size=".1 .2 .3"/></body>
  <body name="other" pos="2 1 1" euler="20 0 30"><joint name="d" axis="0 0 1"/><joint name="d2" axis="1 0 0"/>
    <geom type="box" size=".1 .2 .3" pos=".1 0 0"/></body>
  <body name="e1" pos="3 0 0"><joint name="e1" type="slide" axis="1 0 1" ref=".2"/><geom size=".1"/></body>
  <body name="e2" pos="3 1 0"><joint name="e2" type="slide" axis="0 0 1"/><geom size=".1"/></body>
</worldbody>
<equality>
  <connect name="loop" body1="rod" body2="rocker" anchor="0 0 .8"/>
  <weld body1="other" body2="free" anchor=".1 .2 .3"/>
  <joint name="gear" joint1="e1" joint2="e2" polycoef="0 2 .5"/>
  <connect name="off" body1="rod" anchor="0 0 0" active="false"/>
</equality>
</mujoco>
"""


def test_equalities_are_constraints_with_the_accelerations_that_hold_mujocos_rows():
    """M a + h = Jᵀ λ and J a = −J̇ v, with MuJoCo's M, h and J where the rows hold; J̇ v by central differences."""
    mujoco = pytest.importorskip("mujoco")
    theirs, model = mujoco.MjModel.from_xml_string(LOOPS), lg.loads(LOOPS).model
    theirs.opt.jacobian = mujoco.mjtJacobian.mjJAC_DENSE
    data = mujoco.MjData(theirs)

    def at(q, v):
        data.qpos[:], data.qvel[:] = q, v
        mujoco.mj_forward(theirs, data)
        return np.array(data.efc_J).reshape(-1, theirs.nv)

    start, n = theirs.qpos0, theirs.nv
    J = at(start, np.zeros(n))
    assert np.abs(data.efc_pos).max() < 1e-12
    v = (
        np.linalg.svd(J)[2][np.linalg.matrix_rank(J) :].T
        @ np.array([0.7, -0.4, 0.5, 0.3])[: n - np.linalg.matrix_rank(J)]
    )
    step, rates = 1e-5, []
    for sign in (1, -1):
        q = np.array(start)
        mujoco.mj_integratePos(theirs, q, v, sign * step)
        rates.append(at(q, v) @ v)
    J, M = at(start, v), np.zeros((n, n))
    mujoco.mj_fullM(theirs, data, M)
    force = np.array(data.qfrc_passive - data.qfrc_bias)
    square = np.block([[M, J.T], [J, np.zeros((len(J), len(J)))]])
    expected = np.linalg.lstsq(square, [*force, *(-(rates[0] - rates[1]) / (2 * step))], rcond=1e-12)[0][:n]
    q, ours = np.array(start), np.array(v)
    floats = int(theirs.jnt_qposadr[3])
    q[floats + 3 : floats + 7] = [0, 0, 0, 1]  # our quaternions end with w; at the start its axes are the fixed ones
    dof = int(theirs.jnt_dofadr[3])
    expected[dof : dof + 3] -= np.cross(v[dof + 3 : dof + 6], v[dof : dof + 3])  # along its axes, not the fixed ones
    p, program = [x.value for x in model.parameters], dynamics.forward(model)
    given = {"q": q, "v": ours, "u": np.zeros(len(model.inputs)), "p": p, "t": [0.0]}
    found = evaluate(program, {key: given[key] for key in program.inputs})["a"]
    np.testing.assert_allclose(found, expected, atol=1e-7 * np.abs(expected).max())
    held = evaluate(dynamics.residual(model), {key: given[key] for key in dynamics.residual(model).inputs})
    assert max(np.abs(np.array(x)).max() for x in held.values()) < 1e-12


@pytest.mark.parametrize(
    "held",
    ['<weld body1="a"/>', '<weld body1="world" body2="a"/>', '<weld site1="s" site2="t"/>'],
)
def test_what_is_welded_to_the_world_stays(held):
    text = """<mujoco><worldbody><site name="t" pos="1 0 1.2" euler="0 0 90"/>
    <body name="a" pos="1 0 1" euler="0 0 30"><freejoint/><geom type="box" size=".1 .2 .3"/>
    <site name="s" pos="0 0 .2" euler="0 0 60"/></body></worldbody><equality>HELD</equality></mujoco>"""
    model = lg.loads(text.replace("HELD", held)).model
    p, program = [x.value for x in model.parameters], dynamics.forward(model)
    q = [1, 0, 1, 0, 0, np.sin(np.pi / 12), np.cos(np.pi / 12)]
    given = {"q": q, "v": np.zeros(6), "u": [], "p": p, "t": [0.0]}
    assert np.abs(evaluate(program, given)["a"]).max() < 1e-12
    residual = dynamics.residual(model)
    assert np.abs(evaluate(residual, {key: given[key] for key in residual.inputs})["f"]).max() < 1e-12


def test_what_holds_and_what_does_not_is_told():
    said = " ".join(notice.text for notice in lg.loads(LOOPS).notices)
    for part in (
        "these hold exactly, where MuJoCo's give way: loop (connect rod to rocker)",
        "weld_other_free (weld other to free); gear (joint e1 follows e2)",
        "these do not hold: connect 'off' (line 19): it is not active",
    ):
        assert part in said


BAD = [
    ('<joint name="gear"', '<tendon name="gear"', "<tendon> among the equalities is not supported", 18),
    ('body2="rocker"', 'body2="rockers"', "[E402] connect 'loop': there is no body 'rockers'", 16),
    ('joint2="e2"', 'joint2="e3"', "there is no hinge or slide 'e3'", 18),
    ("<equality>", '<tendon><spatial stiffness="1"/></tendon><equality>', "of a tendon through sites is not", 15),
    ("<equality>", '<tendon><fixed stiffness="1"/></tendon><equality>', "[E405] <fixed>: it has no joints", 15),
    ("<worldbody>", '<include file="/etc/passwd"/><worldbody>', "there are none beside a text", 2),
    ("<worldbody>", '<worldbody><replicate count="1e4"/>', "[E406] <replicate>: 'count' is 10000", 2),
    ("<worldbody>", '<worldbody><composite/>', "<composite> is not supported", 2),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "said", "line"), BAD, ids=[said[:40] for _, _, said, _ in BAD])
def test_the_message_names_the_mistake_and_its_line(old, new, said, line):
    with pytest.raises(ParseError) as caught:
        lg.loads(LOOPS.replace(old, new, 1), name="bad.xml")
    assert said in str(caught.value) and f"bad.xml:{line}:" in str(caught.value)


def test_files_outside_the_folder_and_files_twice_are_not_read(tmp_path):
    inner = tmp_path / "robot"
    inner.mkdir()
    (tmp_path / "post.xml").write_text(POST, encoding="utf-8")
    (inner / "post.xml").write_text(POST, encoding="utf-8")
    for include, said in (
        ('<include file="../post.xml"/>', "outside the folder of the robot's file"),
        ('<include file="/etc/passwd"/>', "outside the folder of the robot's file"),
        ('<include file="none.xml"/>', r"cannot be read \(FileNotFoundError\)"),
        ('<include file="post.xml"/><include file="post.xml"/>', "'post.xml' is included twice"),
        ('<include file="self.xml"/>', "'self.xml' is included twice"),
    ):
        (inner / "self.xml").write_text(f"<mujoco>{include}</mujoco>", encoding="utf-8")
        with pytest.raises(ParseError, match=said):
            lg.load(inner / "self.xml")


def test_copies_of_copies_end(monkeypatch):
    monkeypatch.setattr(mjcf_expanded, "MAX_TAGS", 500)
    nested = '<replicate count="1000">' * 4 + "<body/>" + "</replicate>" * 4
    with pytest.raises(ParseError, match="copies have more than 500 elements"):
        lg.loads(LOOPS.replace("<worldbody>", f"<worldbody>{nested}", 1))
