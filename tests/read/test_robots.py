"""Robots' files: the same numbers as Pinocchio's, names, notices, and what is read back."""

import re
import runpy
from pathlib import Path

import numpy as np
import pytest
from pinocchio_robots import Oracle
from robot_texts import GANTRY, GRIPPER, PENDULUM, QUADRUPED, ROBOTS, TWO, UR5, inertial, joint, link, robot

import lagrangian as lg
from lagrangian import dynamics
from lagrangian.graph import evaluate


def states(system, count, seed=1):
    """Random q with quaternions of length 1, v, a, u."""
    model, rng = system.model, np.random.default_rng(seed)
    q = rng.uniform(-1.5, 1.5, (count, len(model.coordinates)))
    for frame in model.floating:
        first = [c.name for c in model.coordinates].index(f"{frame.name}_qx")
        part = slice(first, first + 4)
        q[:, part] /= np.linalg.norm(q[:, part], axis=1, keepdims=True)
    v, a = rng.uniform(-1, 1, (2, count, len(model.velocities)))
    return q, v, a, rng.uniform(-3, 3, (count, len(model.inputs)))


def applied(system, v, u):
    """The forces of the inputs and dampers along the velocities, from the names in the file."""
    names = [x.name.removesuffix("'") for x in system.model.velocities]
    found = np.zeros(len(names))
    for x, value in zip(system.model.inputs, u, strict=True):
        found[names.index(x.name.split("_", 1)[1])] = value
    for p in system.model.parameters:
        if p.name.startswith("b_"):
            found[names.index(p.name[2:])] -= p.value * v[names.index(p.name[2:])]
    return found


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", list(ROBOTS))
def test_the_same_as_pinocchio(name):
    pin = pytest.importorskip("pinocchio")
    system = lg.loads(ROBOTS[name])
    oracle, model = Oracle(pin, ROBOTS[name], system), system.model
    p = [x.value for x in model.parameters]
    programs = [make(model) for make in (dynamics.mass_matrix, dynamics.inverse, dynamics.forward)]

    def ours(k, **given):
        needed = {key: value for key, value in {**given, "p": p, "t": [0.0]}.items() if key in programs[k].inputs}
        return np.array(next(iter(evaluate(programs[k], needed).values())))

    for q, v, a, u in zip(*states(system, 3), strict=True):
        force = applied(system, v, u)
        expected = oracle.mass_matrix(q), oracle.inverse(q, v, a) - force, oracle.forward(q, v, force)
        found = (ours(k, q=q, v=v, a=a, u=u) for k in range(3))
        for x, y in zip(found, expected, strict=True):
            np.testing.assert_allclose(x, y, rtol=1e-10, atol=1e-10 * np.abs(y).max())


def test_names_of_the_file_become_names_of_the_system():
    system = lg.loads(GRIPPER)
    assert [c.name for c in system.model.coordinates] == ["lift", "left_slide"]
    assert [u.name for u in system.model.inputs] == ["F_lift", "F_left_slide"]
    assert [f.name for f in system.model.frames] == ["palm", "left_finger", "tip", "right_finger"]
    assert [b.name for b in system.model.bodies] == ["palm", "left finger", "tip", "right finger"]
    assert system["m_left_finger"].name == "m_left_finger"
    said = " ".join(str(n) for n in system.notices)
    assert "'left-slide' is left_slide" in said and "right-slide follows left-slide" in said
    assert "lift -3 to 3 m, effort 50 N, velocity 2 m/s" in said


def test_names_that_are_taken_or_reserved_are_changed():
    text = robot(
        "twins",
        *(link(name) for name in ("base",)),
        *(link(name, inertial(1, "0.1 0 0")) for name in ("a b", "a-b", "t", "sin", "x1")),
        *(
            joint(name, "revolute", parent, child, "0.1 0 0")
            for name, parent, child in (
                ("a_b", "base", "a b"),
                ("pi", "a b", "a-b"),
                ("1", "a-b", "t"),
                ("θ", "t", "sin"),
            )
        ),
        joint("theta", "revolute", "sin", "x1", "0.1 0 0"),
    )
    system = lg.loads(text)
    assert [c.name for c in system.model.coordinates] == ["a_b", "pi_2", "_1", "θ", "theta_2"]
    assert [f.name for f in system.model.frames] == ["a_b_link", "a_b_link_2", "t_link", "sin_link", "x1"]
    again = lg.loads(system.to_toml())
    assert [c.name for c in again.model.coordinates] == [c.name for c in system.model.coordinates]


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", ["inverted pendulum", "gripper", "quadruped", "mobile arm"])
def test_a_robot_saved_as_a_model_file_is_the_same_system(name):
    system = lg.loads(ROBOTS[name])
    again = lg.loads(system.to_toml())
    q, v, _, u = (x[0] for x in states(system, 1))
    p = [x.value for x in system.model.parameters]
    first, second = (
        evaluate(dynamics.forward(s.model), {"q": q, "v": v, "u": u, "p": p, "t": [0.0]})["a"] for s in (system, again)
    )
    assert first == pytest.approx(second, rel=1e-12)


def test_what_is_fixed_belongs_to_what_carries_it():
    system = lg.loads(PENDULUM)
    assert [c.name for c in system.model.coordinates] == ["slide", "pin"]
    assert [b.name for b in system.model.bodies] == ["cart", "bracket", "rod", "bob"]
    assert system["bob"].name == "bob" and system["sensor"].parent is system["bob"]
    assert any("what does not move needs no mass: rail" in n.text for n in system.notices)


def test_right_angles_are_exact_and_other_angles_have_names():
    frames = list(lg.loads(UR5).model.frames)
    assert [str(f.angle) for f in frames[1:3]] == ["joint2(t) + pi/2", "joint3(t)"]
    assert "pitch_joint3" in lg.loads(ROBOTS["gantry"])


def test_what_is_not_mechanics_is_listed_with_its_line():
    text = TWO.replace(
        "</robot>",
        '<material name="red"/>\n<transmission name="a"/><transmission name="b"/>\n'
        '<gazebo reference="link1"><mu1>1</mu1></gazebo></robot>',
    ).replace("<axis", '<safety_controller k_velocity="1"/><dynamics damping="0" spring="3"/><axis', 1)
    said = lg.loads(text).notices[-1]
    assert said.code == "E108" and said.where == "robot 'two-link arm'"
    for part in ("<material> (line 8)", "<gazebo> (line 10)"):
        assert part in said.text
    assert "<safety_controller> (line 5)" in said.text and "'spring' of <dynamics> (line 5)" in said.text


def test_a_transmission_multiplies_the_effort_of_its_motor():
    simple = "<type>transmission_interface/SimpleTransmission</type>"
    gear = "<mechanicalReduction> 50 </mechanicalReduction>"
    text = TWO.replace(
        "</robot>",
        f'<transmission name="a">{simple}<joint name="joint1"/><actuator name="m1">{gear}</actuator></transmission>\n'
        f'<transmission name="b">{simple}<joint name="joint2"/><actuator name="m2"/></transmission>\n'
        f'<transmission name="c">{simple}<joint name="joint1"/><actuator name="m3"/></transmission>\n'
        '<transmission name="d"><type>DifferentialTransmission</type></transmission>\n'
        f'<transmission name="e">{simple}<joint name="wheel"/><actuator name="m5"/></transmission></robot>',
    )
    system = lg.loads(text)
    assert [u.name for u in system.model.inputs] == ["tau_joint2", "m1"]
    assert system.model.values[system["gear_m1"]] == 50
    assert system["gear_m1"] * system["m1"] in [getattr(e, "value", None) for e in system.elements]
    said = " ".join(n.text for n in system.notices)
    assert "m1 drives joint1" in said and "transmission 'c' (line 10): another transmission drives joint joint1" in said
    assert "transmission 'd' (line 11): its type is DifferentialTransmission" in said
    assert "transmission 'e' (line 12): there is no joint 'wheel'" in said
    with pytest.raises(lg.ModelError, match="the text of <mechanicalReduction> is '5O', not a number"):
        lg.loads(text.replace(" 50 ", "5O"))


def test_dry_friction_and_damping_act_on_the_joint():
    system = lg.loads(TWO.replace("<axis", '<dynamics damping="0.3" friction="0.2"/><axis', 1))
    kinds = {e.kind: e for e in system.elements}
    assert str(kinds["damper"].b) == "b_joint1" and str(kinds["friction"].limit) == "f_joint1"
    assert system.model.values[system["f_joint1"]] == 0.2


def test_a_floating_robot_falls_freely():
    model = lg.loads(QUADRUPED).model
    q = [float(c.name.endswith("_qw")) for c in model.coordinates]
    given = {"q": q, "v": [0.0] * 18, "u": [0.0] * 12, "p": [x.value for x in model.parameters], "t": [0.0]}
    found = evaluate(dynamics.forward(model), given)["a"]
    assert found == pytest.approx([0, 0, -9.81] + [0] * 15, abs=1e-12)


@pytest.mark.slow
def test_the_papers_robot_runs_as_it_stands(tmp_path, monkeypatch):
    """The file and the script of ``docs/robots.md``."""
    text = (Path(__file__).parents[2] / "docs" / "robots.md").read_text(encoding="utf-8")
    model, script = (re.search(rf"^```{kind}\n(.*?)^```", text, re.M | re.S)[1] for kind in ("xml", "py"))
    (tmp_path / "arm.urdf").write_text(model, encoding="utf-8")
    (tmp_path / "arm.py").write_text(script, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    arm = runpy.run_path("arm.py")["arm"]
    assert all(check.holds for check in arm.derive().verified)
    assert (tmp_path / "arm.html").exists() and len(lg.load("arm.toml").model.coordinates) == 2


def test_the_picture_shows_joints_within_their_limits():
    text = GANTRY.replace('lower="-3" upper="3"', 'lower="0" upper="0.1"')
    system = lg.loads(text)
    assert system.model.look["pose"] == {f"joint{k}": 0.07 for k in range(1, 5)}
    assert lg.loads(system.to_toml()).model.look == system.model.look
    assert system.look().pose["joint1"] == 0.07
