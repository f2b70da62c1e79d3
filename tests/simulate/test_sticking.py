"""Dry friction written with sign: runs that stick end early, name what makes them, and say what helps."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import sympy as sp
from run_systems import oscillator
from scipy.integrate import solve_ivp

import lagrangian as lg
from lagrangian.cli import main

G, C = 9.81, 0.5

FILE = """name = "pendulum with a dry pivot"
[coordinates]
theta = "angle of the rod"
[parameters]
m = "1 kg"
L = "1 m"
c = "0.5 N*m"
g = "9.81 m/s^2"
eps = "0.001 rad/s"
[points]
bob = ["L*sin(theta)", "-L*cos(theta)"]
[[particle]]
mass = "m"
at = "bob"
[[gravity]]
direction = [0, -1]
[[torque]]
name = "pivot"
value = "-c*sign(theta')"
on = "theta"
"""


@pytest.fixture(scope="module")
def pendulum() -> lg.System:
    return lg.loads(FILE)


def last_stop(start: float, friction: float = C) -> tuple[float, float]:
    """When and where the pendulum stops for good: swing by swing, the friction's sign known in each."""
    t, angle = 0.0, start
    while G * abs(np.sin(angle)) > friction:
        sense = -np.sign(angle)

        def rates(_: float, x: Any, sense: float = sense) -> list[float]:
            return [x[1], -G * np.sin(x[0]) - friction * sense]

        def stops(_: float, x: Any) -> float:
            return x[1]

        stops.terminal, stops.direction = True, -sense  # type: ignore[attr-defined]
        swing = solve_ivp(rates, (0, 10), [angle, 0.0], events=stops, rtol=1e-11, atol=1e-12)
        t, angle = t + swing.t_events[0][-1], swing.y_events[0][-1][0]
    return t, angle


@pytest.mark.sampled(6)
@pytest.mark.parametrize("method", ["dop853", "tsit5", "RK45", "Radau", "LSODA"])
def test_a_run_that_sticks_ends_where_it_sticks_and_names_the_torque(pendulum: lg.System, method: str) -> None:
    run = pendulum.simulate(20.0, theta=0.5, method=method)
    assert not run.success and run.status == -8
    assert run.steps + run.rejected < 30_000
    when, where = last_stop(0.5)
    assert run.t[-1] == pytest.approx(when, abs=1e-5)
    assert run["theta"][-1] == pytest.approx(where, abs=1e-5)
    assert "torque 'pivot' (<text>:17:1) jumps where theta' = 0" in run.message
    assert "value = -c*tanh(theta'/eps1)" in run.message


@pytest.mark.sampled(2)
@pytest.mark.parametrize("method", ["rk4", "gauss4"])
def test_steps_of_one_length_end_at_the_first_sample_that_sticks(pendulum: lg.System, method: str) -> None:
    beat = lg.event(sp.sin(pendulum.t), name="beat")
    run = pendulum.simulate(20.0, theta=0.5, method=method, step=0.01, events=beat)
    when, where = last_stop(0.5)
    assert not run.success and run.status == -8
    assert run.t[-1] == pytest.approx(when, abs=0.03) and run["theta"][-1] == pytest.approx(where, abs=1e-4)
    assert run.events["beat"].t == pytest.approx([np.pi])
    assert "torque 'pivot'" in run.message and "it sticks, and steps jump to and fro" in run.message


@pytest.mark.slow
def test_what_rests_exactly_where_a_force_jumps_does_not_stick(pendulum: lg.System) -> None:
    assert pendulum.simulate(1.0, method="rk4", step=0.01).success
    assert pendulum.simulate(1.0, theta=1.0, params={"c": 0.0}, method="rk4", step=0.01).success
    pulled = oscillator(m=1.0, k=0.0, b=0.0)
    assert pulled.simulate(3.0, q=1.0, inputs={"F": -sp.sign(pulled["q"])}, method="rk4", step=0.01).success
    runs = pendulum.ensemble(6.0, params={"c": [0.0, 0.5, 20.0]}, theta=0.5, method="rk4", step=0.01, outputs="theta")
    assert runs.status.tolist() == [0, -8, -8]


def test_the_law_that_is_advised_runs(pendulum: lg.System) -> None:
    smooth = lg.loads(FILE.replace("sign(theta')", "tanh(theta'/eps)"))
    run = smooth.simulate(8.0, theta=0.5, method="Radau", rtol=1e-6)
    assert run.success
    assert run["theta"][-1] == pytest.approx(last_stop(0.5)[1], abs=0.02)  # it creeps a little


def test_in_an_ensemble_each_run_sticks_or_not(pendulum: lg.System) -> None:
    """Friction of 0 reaches the end; of 0.5 N m it sticks; of 20 N m it never moves."""
    friction = np.array([0.0, 0.5, 20.0] * 3)
    runs = pendulum.ensemble(6.0, params={"c": friction}, initial={"theta": 0.5})
    assert runs.status.tolist() == [0, -8, -8] * 3
    assert runs["reached"][1::3] == pytest.approx(last_stop(0.5)[0], abs=1e-5)
    assert runs["reached"][2::3] == pytest.approx(0.0, abs=1e-5)
    assert "sticks where a force jumps" in str(runs.failures()[0])


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("law", "words"),
    [
        (lambda x, v: -v / sp.Abs(v), "input 'F' jumps where q' = 0"),
        (lambda x, v: -sp.Piecewise((1, v > 0), (-1, True)), "input 'F' jumps where q' = 0"),
        (lambda x, v: sp.Rational(1, 2) - sp.Heaviside(x + v), "F = -tanh((q + q')/eps)/2"),
    ],
)
def test_other_ways_to_write_a_jump_are_seen_too(law: Any, words: str) -> None:
    s = oscillator(m=1.0, k=0.0, b=0.0)
    run = s.simulate(10.0, q=1.0, initial={"q'": -1.0}, inputs={"F": law(s["q"], s["q"].diff())})
    assert run.status == -8 and words in run.message


@pytest.mark.slow
def test_what_crosses_a_jump_or_rests_at_a_kink_does_not_stick() -> None:
    """A force that pulls to the middle, sign(q), is crossed again and again; drag v|v| is continuous."""
    s = oscillator(m=1.0, k=0.0, b=0.0)
    pulled = s.simulate(3.0, q=1.0, inputs={"F": -sp.sign(s["q"])}, rtol=1e-6)
    after = 3 - np.sqrt(2)  # at √2 s it is in the middle, as fast as √2 m/s
    assert pulled.success and pulled["q"][-1] == pytest.approx(-np.sqrt(2) * after + after**2 / 2, abs=1e-5)
    drag = s.simulate(1e3, max_steps=3, inputs={"F": "-q'*abs(q') - q"})
    assert drag.status == -3


def test_the_command_says_it_and_exits_with_1(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "dry.toml"
    file.write_text(FILE, encoding="utf-8")
    assert main(["simulate", str(file), "-d", "20", "--init", "theta=0.5"]) == 1
    said = capsys.readouterr()
    assert "torque 'pivot'" in said.err and "dry.toml:17:1" in said.err and "--method Radau" in said.err
    assert "Traceback" not in said.err
