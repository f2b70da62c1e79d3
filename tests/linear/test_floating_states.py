"""Floating frames in twelve states: a quadrotor's linear model, its regulator, and a spinning body."""

import numpy as np
import pytest

import lagrangian as lg

MASS, G, ARM, DRAG = 0.8, 9.81, 0.2, 0.02
INERTIA = (0.005, 0.006, 0.009)


def quadrotor() -> lg.System:
    """Four rotors at ±ARM on the axes x and y; each pushes along z, and turns by ±DRAG times its push about z."""
    s = lg.System("quadrotor")
    body = s.floating_frame("body")
    s.rigid_body(MASS, INERTIA, at=body.origin, frame=body)
    s.gravity(direction=(0, 0, -1), g=G)
    places = ((ARM, 0), (0, ARM), (-ARM, 0), (0, -ARM))
    for k, (x, y) in enumerate(places, 1):
        F = s.input(f"F{k}")
        s.force((0, 0, F), at=body.point(x, y, 0), axes=body, name=f"rotor {k}")
        s.torque((0, 0, (-1) ** k * DRAG * F), on=body, axes=body, name=f"drag {k}")
    return s


HOVER = {f"F{k}": MASS * G / 4 for k in range(1, 5)}


def test_a_body_that_falls_is_told_what_holds_it_and_no_verb_that_refuses() -> None:
    """A drone in flight has no equilibrium for `equilibria` to find; each piece of the advice works."""
    falling = quadrotor()
    with pytest.raises(lg.Error, match=r"body_vz' = -9\.81 there") as caught:
        falling.linearize()
    advice = str(caught.value).partition("Fix: ")[2]
    assert advice.startswith("give the inputs that hold it still; operating_point=True") and "equilibria" not in advice
    assert falling.linearize(inputs=HOVER).kind == "rest"
    drift = falling.linearize(operating_point=True).drift
    assert drift is not None and drift[8] == pytest.approx(-G)


def test_a_quadrotor_hovers_in_twelve_states() -> None:
    """R. Mahony, V. Kumar, P. Corke, Multirotor Aerial Vehicles, IEEE Robotics & Automation Magazine 19 (2012):
    ẍ = g θ, ÿ = −g φ, z̈ = ΣF/m, I ω̇ = arms × forces."""
    found = quadrotor().linearize(inputs=HOVER)
    positions = ["body_x", "body_y", "body_z", "body_rx", "body_ry", "body_rz"]
    assert found.states == (*positions, *(f"body_{k}" for k in ("vx", "vy", "vz", "wx", "wy", "wz")))
    A, B = np.zeros((12, 12)), np.zeros((12, 4))
    A[:6, 6:] = np.eye(6)
    A[6, 4], A[7, 3] = G, -G
    B[8] = 1 / MASS
    B[9] = np.array([0, ARM, 0, -ARM]) / INERTIA[0]
    B[10] = np.array([-ARM, 0, ARM, 0]) / INERTIA[1]
    B[11] = np.array([-DRAG, DRAG, -DRAG, DRAG]) / INERTIA[2]
    np.testing.assert_allclose(found.A, A, atol=1e-12)
    np.testing.assert_allclose(found.B, B, atol=1e-10)
    assert found.controllability.rank == 12
    assert len(found.poles) == 12
    assert "small turns about the frames" in found.to_text()


@pytest.mark.slow
def test_a_regulator_brings_a_quadrotor_back() -> None:
    system = quadrotor()
    found = system.linearize({"body_qx": 0.0, "body_qz": 0.6, "body_qw": 0.8}, inputs=HOVER)  # hovering turned by 74°
    regulator = found.lqr({"body_x": 1, "body_y": 1, "body_z": 1, "body_rz": 1}, 1.0)
    assert regulator.K.shape == (4, 12)
    assert (regulator.poles.real < 0).all()
    start = {"body_x": 0.5, "body_z": -0.3, "body_qx": 0.15, "body_qz": 0.4, "body_qw": 0.9, "body_wy": 0.4}
    run = system.simulate(12.0, initial=start, inputs=regulator.law, rtol=1e-7)
    length = np.sqrt(0.15**2 + 0.4**2 + 0.9**2)
    end = {name: run[name][-1] for name in run.states}
    for name in ("body_x", "body_y", "body_z", "body_vx", "body_wx"):
        assert abs(end[name]) < 1e-3
    assert end["body_qz"] / length == pytest.approx(0.6, abs=1e-3)
    assert "body_rz" in regulator.to_text()
    assert regulator.law[system["F1"]].has(*(c.symbol for c in system.model.coordinates[3:7]))


@pytest.mark.slow
def test_a_body_that_spins_and_flies_against_difference_quotients() -> None:
    """A of δξ̇ = A δξ from the flow: back(x₁) (x₁(+) − x₁(−))/2ε = 1 + A h + O(h²), extrapolated."""
    system = quadrotor()
    rng = np.random.default_rng(1)
    dyn = system.compile()
    x0 = np.concatenate([rng.normal(size=7), rng.normal(size=6)])
    names = [*dyn.coordinates, *dyn.velocities]
    u = rng.normal(size=4)

    def linear(x: np.ndarray) -> lg.Linearization:
        at = dict(zip(names, x, strict=True))
        inputs = {f"F{k}": value for k, value in enumerate(u, 1)}
        return system.linearize(at, inputs=inputs, operating_point=True)

    found, eps = linear(x0), 1e-5
    Z = found.basis
    assert Z is not None

    def quotient(h: float) -> np.ndarray:
        back = linear(dyn.step(x0[:7], x0[7:], u, h)).back
        assert back is not None
        ends = [dyn.step((x0 + s * eps * Z.T)[:, :7], (x0 + s * eps * Z.T)[:, 7:], u, h) for s in (1, -1)]
        return (back @ (ends[0] - ends[1]).T / (2 * eps) - np.eye(12)) / h

    h = 2e-3
    flow = (8 * quotient(h / 4) - 6 * quotient(h / 2) + quotient(h)) / 3  # cancels h and h²
    np.testing.assert_allclose(flow, found.A, atol=2e-5 * float(np.abs(found.A).max()))
    assert found.kind == "operating point"
    assert found.drift.shape == (12,)


def test_names_of_turns_avoid_those_of_the_model() -> None:
    system = quadrotor()
    system.parameter("body_rx", 1.0)
    assert "body__rx" in system.linearize(inputs=HOVER).states
