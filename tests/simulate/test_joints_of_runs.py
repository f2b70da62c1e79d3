"""Runs of joints that are described as elements, against closed solutions: rope, slider, weld, ball, pin."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import sympy as sp

import lagrangian as lg

TIGHT: dict[str, Any] = {"rtol": 1e-12, "atol": 1e-13}
G = 9.81


@pytest.mark.slow
def test_a_rope_over_a_peg_is_atwoods_machine() -> None:
    """ẍ = (m₁ − m₂) g/(m₁ + m₂), and the tension −λ is 2 m₁ m₂ g/(m₁ + m₂)."""
    s = lg.System("Atwood")
    y1, y2 = s.coordinates("y1 y2")
    m1, m2 = s.parameters("m1 m2", m1=3, m2=2)
    A, B = s.point("A", (-0.5, -y1)), s.point("B", (0.5, -y2))
    s.particle(m1, A)
    s.particle(m2, B)
    s.gravity(g=G)
    s.rope((A, s.point("left", (-0.5, 0)), s.point("right", (0.5, 0)), B), length=4, name="rope")
    run = s.simulate(0.5, initial={"y1": 1.5, "y2": 1.5}, **TIGHT)
    assert run["y1"] == pytest.approx(1.5 + G / 5 * run.t**2 / 2, abs=1e-12)
    assert run["rope"] == pytest.approx(-12 / 5 * G, abs=1e-9)


@pytest.mark.slow
def test_a_bar_on_two_sliders_is_the_trammel_of_archimedes() -> None:
    """Its centre moves on a circle: (m h² + J) θ̈ = m g h cos θ with h half of its length (a falling ladder's)."""
    s = lg.System("trammel")
    x, y, theta = s.coordinates("x y theta")
    m, J, h = s.parameters("m J h", m=2, J=0.4, h=0.6)
    bar = s.frame(theta, origin=s.point("C", (x, y)), name="bar")
    s.rigid_body(m, J, at=bar.point(0, 0), frame=bar)
    s.gravity(g=G)
    s.slider((bar.point(-h, 0), s.origin), along=(1, 0), name="level")
    s.slider((bar.point(h, 0), s.origin), along=(0, 2), name="upright")
    start = {"x": -0.6 * np.cos(0.3), "y": 0.6 * np.sin(0.3), "theta": 0.3}
    run = s.simulate(0.5, initial=start, **TIGHT)
    assert run["x"] == pytest.approx(-0.6 * np.cos(run["theta"]), abs=1e-12)
    speed = 2 * 2 * G * 0.6 * (np.sin(0.3) - np.sin(run["theta"])) / (2 * 0.36 + 0.4)
    assert run["theta'"] ** 2 == pytest.approx(speed, abs=1e-9)
    assert run["level"] == pytest.approx(2 * (run["y''"] + G), abs=1e-9)  # the floor carries the rest
    assert run["upright.across"] == pytest.approx(
        -2 * run["x''"], abs=1e-9
    )  # across (0, 1), along (−1, 0), whatever its length


@pytest.mark.slow
def test_two_bars_that_are_welded_are_one_pendulum() -> None:
    s = lg.System("welded")
    a, x, y, b = s.coordinates("a x y b")
    upper, lower = s.frame(a, name="upper"), s.frame(b, origin=s.point("C", (x, y)), name="lower")
    s.rigid_body(1.5, 0.2, at=upper.point(0.4, 0), frame=upper)
    s.rigid_body(0.5, 0.1, at=lower.point(0, 0), frame=lower)
    s.gravity(g=G)
    s.weld((upper.point(0.8, 0), lower.point(-0.3, 0)), name="weld")
    run = s.simulate(1.0, initial={"a": 0.2, "b": 0.2, "x": 1.1 * np.cos(0.2), "y": 1.1 * np.sin(0.2)}, **TIGHT)
    one = lg.System("one")
    c = one.coordinates("c")
    inertia = 1.5 * 0.16 + 0.2 + 0.5 * 1.21 + 0.1
    one.kinetic(sp.Float(inertia) / 2 * c.diff() ** 2)
    one.potential(G * (1.5 * 0.4 + 0.5 * 1.1) * sp.sin(c))
    exact = one.simulate(1.0, c=0.2, **TIGHT)["c"]
    assert run["a"] == pytest.approx(exact, abs=1e-10) and run["b"] == pytest.approx(exact, abs=1e-10)
    below = 0.1 * run["b''"] + 0.3 * (run["weld.x"] * np.sin(run["b"]) - run["weld.y"] * np.cos(run["b"]))
    assert run["weld.turn"] == pytest.approx(-below, abs=1e-9)  # a torque on the upper bar


@pytest.mark.slow
def test_a_floating_body_on_a_ball_joint_is_a_spherical_pendulum() -> None:
    """Swinging about x: (J + m l²) ω² = (J + m l²) ω₀² − 2 m g l (1 − cos α)."""
    s = lg.System("hook")
    body = s.floating_frame("F")
    s.rigid_body(2, (0.3, 0.3, 0.1), at=body.origin, frame=body)
    s.gravity(direction=(0, 0, -1), g=G)
    s.ball((body.point(0, 0, 0.8), s.origin), name="hook")
    run = s.simulate(0.5, initial={"F_z": -0.8, "F_qw": 1.0, "F_wx": 0.5, "F_vy": 0.4}, **TIGHT)
    assert run.success and float(run.audit) < 1e-11
    tilt = 2 * np.arctan2(run["F_qx"], run["F_qw"])
    square = 0.25 - 2 * 2 * G * 0.8 * (1 - np.cos(tilt)) / (0.3 + 2 * 0.64)
    assert run["F_wx"] ** 2 == pytest.approx(square, abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize(
    "method",
    [
        "dop853",
        "tsit5",
        "taylor",
        "rk4",
        pytest.param("RK45", marks=pytest.mark.exhaustive),
        "DOP853",
        "LSODA",
        pytest.param("BDF", marks=pytest.mark.exhaustive),  # at looser tolerances in test_drift
        pytest.param("Radau", marks=pytest.mark.exhaustive),
    ],
)
def test_loops_stay_closed_for_100_seconds_at_the_default_tolerance(method: str) -> None:
    s = lg.example("rod-pendulum")
    run = s.simulate(100.0, method=method, step=0.01 if method == "rk4" else None)
    assert run.success, run.message
    n = len(s.model.coordinates)
    left = s.compile().residual(run.y[:n].T, run.y[n:].T)
    assert max(np.abs(x).max() for rows in left.values() for x in rows.values()) < 1e-12
