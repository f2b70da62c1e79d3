"""Pulses and jumps in time: steps end where conditions in time switch, against closed forms and forces cut by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import sympy as sp
from run_systems import oscillator
from scipy.integrate import quad
from sympy.physics.vector import dynamicsymbols
from typer.testing import CliRunner

import lagrangian as lg
from lagrangian.cli.app import app
from lagrangian.errors import RunError
from lagrangian.simulate import switching
from lagrangian.simulate.inputs import driving
from lagrangian.simulate.switching import with_stops

T: Any = dynamicsymbols._t  # type: ignore[attr-defined]

METHODS = ["dop853", "tsit5", "gauss4", "rk4", "Radau", "BDF", "RK45", "DOP853"]


def pushed() -> lg.System:
    """A mass of 2 kg on a line that a force F pushes; t1 and t2 are parameters."""
    s = lg.System("pushed")
    x = s.coordinate("x")
    s.particle(s.parameter("m", 2.0), at=s.origin + (x, 0))
    s.parameter("t1", 5.0)
    s.parameter("t2", 5.01)
    s.force(at=s.origin + (x, 0), value=(s.input("F"), 0))
    return s


def travelled(force: float, first: float, last: float, end: float) -> float:
    """The way of 2 kg under a constant force from ``first`` to ``last``, at ``end``: a τ²/2 + a τ (end − last)."""
    a, tau = force / 2.0, last - first
    return a * tau**2 / 2 + a * tau * (end - last)


@pytest.mark.sampled(20)
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(
    "pulse",
    [
        "piecewise(t < 5, 0, t < 5.01, 30, 0)",
        30 * (sp.Heaviside(T - 5) - sp.Heaviside(T - 5.01)),
        "15*(sign(t - 5) - sign(t - 5.01))",
        "piecewise(t < t1, 0, t < t2, 30, 0)",
    ],
)
def test_a_short_pulse_is_not_jumped_over(method: str, pulse: Any) -> None:
    step: Any = {"step": 0.1} if method in ("gauss4", "rk4") else {}
    run = pushed().simulate(10.0, inputs={"F": pulse}, method=method, **step)
    assert run.success
    np.testing.assert_allclose(run["x"][-1], travelled(30.0, 5.0, 5.01, 10.0), rtol=1e-7)
    np.testing.assert_allclose(run["x'"][-1], 30.0 * 0.01 / 2, rtol=1e-7)


@pytest.mark.slow
def test_a_pulse_of_a_period_and_one_of_a_sine() -> None:
    run = pushed().simulate(10.0, inputs={"F": "piecewise(sin(40*t) > 0, 1, -1)"})
    at = run.t % (2 * np.pi / 40)  # x' is a triangle of half a period up, half a period down
    triangle = np.where(at < np.pi / 40, at, 2 * np.pi / 40 - at) / 2.0
    np.testing.assert_allclose(run["x'"], triangle, atol=1e-10)
    bump = pushed().simulate(9.0, inputs={"F": "max(0, sin(t - 7) - 0.99)"})
    c = 0.99  # two bumps, each ∫ (sin s − c) ds from asin c to π − asin c = 2 cos(asin c) − c (π − 2 asin c)
    gained = 2 * np.sqrt(1 - c**2) - c * (np.pi - 2 * np.arcsin(c))
    np.testing.assert_allclose(bump["x'"][-1], 2 * gained / 2.0, rtol=1e-8)


def test_a_jump_does_not_end_a_run() -> None:
    s = lg.System("followed")
    x = s.coordinate("x")
    s.particle(s.parameter("m", 1.0), at=s.origin + (x, 0))
    z = s.input("z")
    s.spring(s.parameter("k", 4.0), deflection=x - z)
    run = s.simulate(6.0, inputs={"z": "piecewise(t < 1.5, 0, 0.05)"})
    expected = np.where(run.t < 1.5, 0.0, 0.05 * (1 - np.cos(2 * (run.t - 1.5))))
    assert run.success
    np.testing.assert_allclose(run["x"], expected, atol=1e-11)


def test_switches_of_a_model_with_a_motion_in_time_and_no_inputs() -> None:
    s = lg.System("carried")
    x = s.coordinate("x")
    base = sp.Max(0, T - 20) ** 3 - sp.Max(0, T - 20.001) ** 3
    s.particle(s.parameter("m", 1.0), at=s.origin + (x, 0))
    s.spring(s.parameter("k", 1.0), deflection=x - 1e4 * base * sp.Heaviside(20.002 - T))
    run = s.simulate(21.0)

    def pull(r: float) -> float:
        return 1e4 * (max(0.0, r - 20) ** 3 - max(0.0, r - 20.001) ** 3)

    expected = quad(lambda r: np.sin(21.0 - r) * pull(r), 20, 20.002, points=[20.001], epsabs=1e-20)[0]
    np.testing.assert_allclose(run["x"][-1], expected, rtol=1e-6)


def test_runs_of_an_ensemble_switch_at_their_own_times() -> None:
    t1 = np.array([1.0, 2.5, 7.0])
    runs = pushed().ensemble(10.0, params={"t1": t1, "t2": t1 + 0.01}, inputs={"F": "piecewise(t<t1, 0, t<t2, 30, 0)"})
    np.testing.assert_allclose(runs["x"], [travelled(30.0, a, a + 0.01, 10.0) for a in t1], rtol=1e-9)


def test_too_many_different_switches_ask_for_a_longest_step() -> None:
    s, force = pushed(), "piecewise(t<t1, 0, t<t1+0.5, 30*sin(2*pi*(t-t1))^2, 0)"
    with pytest.raises(RunError, match="max_step"):
        s.sweep(10.0, ["t1~uniform(1, 8)"], draws=2000, inputs={"F": force})
    runs = s.sweep(10.0, ["t1~uniform(1, 8)"], draws=2000, inputs={"F": force}, max_step=0.2, rtol=1e-6)
    np.testing.assert_allclose(runs["x'"], 3.75, rtol=1e-4)


def test_the_command_knows_a_longest_step() -> None:
    answer = CliRunner().invoke(app, ["simulate", "--example", "pendulum", "-d", "1", "--max-step", "10 ms"])
    assert answer.exit_code == 0, answer.output
    steps = int(answer.stdout.split(" steps")[0].split()[-1])
    assert steps >= 100


NARROW = "sin(3*t) + 100*exp(-((t - 50)/0.001)^2)"
GAIN = 0.1 * np.sqrt(np.pi) + (1 - np.cos(300.0)) / 3
"""What a force of `NARROW` N adds to the speed of 1 kg in 100 s."""


@pytest.mark.sampled(2)
@pytest.mark.parametrize("method", ["dop853", "tsit5", "taylor", "Radau"])
@pytest.mark.slow
def test_a_smooth_pulse_of_a_millisecond_in_a_hundred_seconds_is_not_jumped_over(method: str) -> None:
    s = oscillator(m=1.0, k=0.0, b=0.0)
    alone = s.simulate(100.0, inputs={"F": "100*exp(-((t - 50)/0.001)^2)"}, method=method)
    assert alone["q'"][-1] == pytest.approx(0.1 * np.sqrt(np.pi), rel=1e-8)
    if method != "Radau":
        assert s.simulate(100.0, inputs={"F": NARROW}, method=method)["q'"][-1] == pytest.approx(GAIN, abs=1e-5)


def test_a_smooth_pulse_reaches_every_run_of_an_ensemble() -> None:
    s = oscillator(m=1.0, k=0.0, b=0.0)
    runs = s.ensemble(100.0, initial={"q": np.arange(9.0)}, inputs={"F": NARROW})
    assert runs["final q'"] == pytest.approx(np.full(9, GAIN), abs=1e-8)


def narrow() -> lg.System:
    """A mass that a pulse of a millisecond pushes at t = t1."""
    s = oscillator(m=1.0, k=0.0, b=0.0)
    s.parameter("t1", 1.0)
    return s


PULSE = "100*exp(-((t - t1)/0.001)^2)"


@pytest.mark.slow
def test_a_smooth_pulse_at_a_hundred_different_times_reaches_every_run() -> None:
    runs = narrow().ensemble(100.0, params={"t1": np.linspace(1.0, 99.0, 100)}, inputs={"F": PULSE}, outputs="q'")
    assert runs["q'"] == pytest.approx(np.full(100, 0.1 * np.sqrt(np.pi)), abs=1e-8) and not runs.notices


@pytest.mark.sampled(2)
@pytest.mark.parametrize("varied", [{"t1": np.linspace(1.0, 99.0, 1100)}, {"t1": np.linspace(1.0, 99.0, 700)}])
def test_pulses_at_too_many_different_times_are_told(varied: dict, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(switching, "MOST_PULSES", 2000)
    runs = narrow().ensemble(100.0, params=varied, inputs={"F": PULSE}, outputs="q'", rtol=1e-3)
    (said,) = runs.notices
    assert "narrow at different times in too many runs" in said and "max_step" in said
    short = narrow().ensemble(1.0, params=varied, inputs={"F": PULSE}, outputs="q'", rtol=1e-3, max_step=0.1)
    assert not short.notices
    calm = narrow().ensemble(1.0, params=varied, inputs={"F": "sin(t - t1)"}, outputs="q'", rtol=1e-3)
    assert not calm.notices


def test_a_force_that_is_nowhere_narrow_has_no_stops() -> None:
    model = oscillator(m=1.0, k=0.0, b=0.0).model
    drive = driving(model, {"F": "3*sin(30*t) + sqrt(2 + cos(t))"}, {})
    made = with_stops(model, drive, np.array([1.0, 0.0, 0.0]), np.array([0.0, 10.0]))
    assert not len(made.stops) and made.constant
