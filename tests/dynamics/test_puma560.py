"""A published robot, one of whose inertias is that of no body, moves as Newton and Euler say."""

import numpy as np
import pytest
from puma560 import CENTRE, GRAVITY, INERTIA, MASS, MOTOR, accelerations, newton_euler, system, transform
from scipy.integrate import solve_ivp

import lagrangian as lg


@pytest.fixture(scope="module")
def arm() -> lg.System:
    return system()


def test_it_is_taken_with_notices(arm: lg.System) -> None:
    first, third = arm.notices  # of link 1 only the moment about its axis was measured
    assert (first.where, third.where) == ("rigid body 'link 1'", "rigid body 'link 3'")
    assert first.code == third.code == "E105"
    assert "0.0125 + 0.066 ≥ 0.086" in third.text
    assert "link 3" in repr(arm)


@pytest.mark.slow
def test_its_accelerations_are_those_of_newton_and_euler(arm: lg.System) -> None:
    rng = np.random.default_rng(1)
    q, v, tau = rng.uniform(-3, 3, (20, 6)), rng.uniform(-2, 2, (20, 6)), rng.uniform(-20, 20, (20, 6))
    dyn = arm.compile()
    found = dyn.forward(q, v, tau)
    wanted = np.array([accelerations(*row) for row in zip(q, v, tau, strict=True)])
    np.testing.assert_allclose(found, wanted, atol=1e-9 * np.abs(wanted).max())
    forces = dyn.inverse(q, v, wanted)
    by_recursion = np.array([newton_euler(*row) for row in zip(q, v, wanted, strict=True)])
    np.testing.assert_allclose(forces, by_recursion, atol=1e-9 * np.abs(by_recursion).max())


@pytest.mark.slow
def test_its_fall_is_that_of_newton_and_euler(arm: lg.System) -> None:
    start = np.array([0.1, -0.5, 0.3, 0.2, 0.4, -0.1])
    run = arm.simulate(0.5, initial=[*start, *np.zeros(6)], samples=6)
    wanted = solve_ivp(
        lambda t, x: np.concatenate([x[6:], accelerations(x[:6], x[6:], np.zeros(6))]),
        (0, 0.5),
        [*start, *np.zeros(6)],
        rtol=1e-10,
        atol=1e-11,
    )
    np.testing.assert_allclose(run.y[:, -1], wanted.y[:, -1], atol=1e-7)
    assert run.success
    assert float(run.audit) < 1e-8
    assert [n.code for n in run.notices] == ["E105", "E105"]


def test_pinocchio_agrees(arm: lg.System) -> None:
    pin = pytest.importorskip("pinocchio")
    robot = pin.Model()
    robot.gravity.linear = np.array([0, 0, -GRAVITY])
    for k in range(6):
        R, p = transform(k, 0.0)
        joint = robot.addJoint(k, pin.JointModelRZ(), pin.SE3(R, p), f"j{k}")
        robot.appendBodyToJoint(joint, pin.Inertia(MASS[k].item(), CENTRE[k], np.diag(INERTIA[k])), pin.SE3.Identity())
    robot.armature = MOTOR
    rng = np.random.default_rng(2)
    data = robot.createData()
    for _ in range(5):
        q, v, tau = rng.uniform(-3, 3, 6), rng.uniform(-2, 2, 6), rng.uniform(-20, 20, 6)
        wanted = pin.aba(robot, data, q, v, tau)
        np.testing.assert_allclose(arm.compile().forward(q, v, tau), wanted, atol=1e-8 * np.abs(wanted).max())
