"""Robots of Gymnasium (MIT licence), whose files its package brings: the same numbers as MuJoCo's and Pinocchio's."""

import importlib.util
import re
from pathlib import Path

import numpy as np
import pytest
from mujoco_robots import MujocoOracle

import lagrangian as lg
from lagrangian import dynamics
from lagrangian.graph import evaluate

ROBOTS = (
    "inverted_pendulum",
    "reacher",
    "hopper",
    "ant",
    "half_cheetah",
    "humanoid",
    "inverted_double_pendulum",
    "point",
    "pusher",
    "swimmer",
    "walker2d",
)
WATER = 'density="4000" integrator="RK4" timestep="0.01" viscosity="0.1"'


def file_of(name):
    found = importlib.util.find_spec("gymnasium")
    if found is None:
        pytest.skip("the package gymnasium, with the robots' files, is not installed")
    return Path(found.origin).parent / "envs" / "mujoco" / "assets" / f"{name}.xml"


@pytest.mark.sampled(("inverted_pendulum", "reacher", "hopper"))
@pytest.mark.parametrize("name", ROBOTS)
def test_the_same_as_mujoco_and_pinocchio(name, tmp_path):
    mujoco, pin = pytest.importorskip("mujoco"), pytest.importorskip("pinocchio")
    path = tmp_path / "robot.xml"  # the swimmer swims in what is not read: its water is left out
    text = file_of(name).read_text(encoding="utf-8").replace(WATER, "")
    text = re.sub('(contype|conaffinity)="0"', r'\1="1"', text)  # what touches nothing has no mass for Pinocchio
    path.write_text(text, encoding="utf-8")
    theirs, system = mujoco.MjModel.from_xml_path(str(path)), lg.load(path).model
    oracle, other = MujocoOracle(mujoco, theirs), Rigid(pin, path, theirs)
    assert len(system.inputs) == theirs.nu > 0
    p = [x.value for x in system.parameters]
    programs = [make(system) for make in (dynamics.mass_matrix, dynamics.bias, dynamics.forward)]
    for q, v, u in oracle.states(2, theirs.nu):
        given = {"q": q, "v": v, "u": u, "p": p, "t": [0.0]}
        found = [
            np.array(next(iter(evaluate(program, {key: given[key] for key in program.inputs}).values())))
            for program in programs
        ]
        for x, y in zip(found, oracle.at(q, v, u), strict=True):
            np.testing.assert_allclose(x, y, rtol=1e-10, atol=1e-10 * np.abs(y).max())
        n = other.model.nv
        for x, y in zip(found, other.at(q, v, oracle.acting(q)), strict=True):
            first = x[:n, :n] if x.ndim == 2 else x[:n]
            np.testing.assert_allclose(first, y, rtol=1e-10, atol=1e-10 * np.abs(y).max())


class Rigid:
    """Pinocchio's model of a file in MJCF, which has the first tree of its bodies, and no total mass."""

    def __init__(self, pin, path, theirs):
        self.pin, self.model = pin, pin.buildModelFromMJCF(str(path))
        self.model.gravity.linear = theirs.opt.gravity
        if 'settotalmass="14"' in path.read_text(encoding="utf-8"):
            factor = 14 / sum(body.mass for body in self.model.inertias)
            for k, body in enumerate(self.model.inertias):
                self.model.inertias[k] = pin.Inertia(body.mass * factor, body.lever, body.inertia * factor)
        self.data = self.model.createData()

    def at(self, q, v, force):
        """M, bias − force and the accelerations."""
        pin, model, data, n = self.pin, self.model, self.data, self.model.nv
        q, v, force = q[: model.nq], v[:n], force[:n]
        M = np.triu(pin.crba(model, data, q))
        bias = pin.nonLinearEffects(model, data, q, v) - force
        return M + np.triu(M, 1).T, bias, pin.aba(model, data, q, v, force)


@pytest.mark.slow
def test_the_page_of_the_ant_is_below_150_kb():
    assert len(lg.load(file_of("ant")).look().to_html().encode()) < 150_000
