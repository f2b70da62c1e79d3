"""Runs that begin where an event is zero: what moves through it has its event there, what rests against it too."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import lagrangian as lg

METHODS = ["dop853", "tsit5", "taylor", "gauss4", "RK45", "Radau"]


def ball() -> tuple[lg.System, Any]:
    """A ball of 1 kg that falls along y."""
    s = lg.System("ball")
    y = s.coordinate("y")
    s.particle(s.parameter("m", 1.0), at=s.origin + (0, y))
    s.gravity()
    return s, y


def options(method: str) -> dict[str, Any]:
    """The step of a method that needs one."""
    return {"step": 0.01} if method == "gauss4" else {}


@pytest.mark.sampled(6)
@pytest.mark.parametrize("method", METHODS)
def test_a_ball_thrown_at_the_floor_from_the_floor_bounces_at_once(method: str) -> None:
    s, y = ball()
    bounce = lg.event(y, direction=-1, reset={y.diff(): -0.5 * y.diff()}, name="bounce")
    run = s.simulate(0.1, initial={"y'": -2.0}, events=bounce, method=method, **options(method))
    assert run.success, run.message
    np.testing.assert_allclose(run.events["bounce"].t, [0.0], atol=1e-12)
    np.testing.assert_allclose(run["y"], run.t - 9.81 * run.t**2 / 2, atol=1e-9)


@pytest.mark.sampled(8)
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("speed", [-1.0, 0.0])
def test_a_floor_ends_a_run_that_begins_on_it(method: str, speed: float) -> None:
    s, y = ball()
    floor = lg.event(y, direction=-1, terminal=True, name="floor")
    run = s.simulate(1.0, initial={"y'": speed}, events=floor, method=method, **options(method))
    assert "event 'floor' ended the run" in run.message
    assert run.t[-1] < 1e-9


@pytest.mark.sampled(2)
@pytest.mark.parametrize("method", METHODS)
def test_a_ball_at_rest_on_the_floor_does_not_fall_through(method: str) -> None:
    s, y = ball()
    bounce = lg.event(y, direction=-1, reset={y.diff(): -0.5 * y.diff()}, name="bounce")
    run = s.simulate(1.0, events=bounce, method=method, **options(method))
    assert not run.success
    assert "'bounce' repeats itself" in run.message
    assert abs(run["y"]).max() < 1e-9


@pytest.mark.sampled(4)
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("direction", [-1, 0])
def test_what_leaves_the_floor_flies(method: str, direction: int) -> None:
    s, y = ball()
    floor = lg.event(y, direction=direction, terminal=True, name="floor")
    run = s.simulate(1.0, initial={"y'": 2.0}, events=floor, method=method, **options(method))
    np.testing.assert_allclose(run.t[-1], 2 * 2.0 / 9.81, rtol=1e-9)


def test_many_runs_begin_on_the_floor() -> None:
    s, y = ball()
    bounce = lg.event(y, direction=-1, reset={y.diff(): -0.5 * y.diff()}, name="bounce")
    v = np.array([-2.0, 1.0, -1.0])
    runs = s.ensemble(0.05, initial={"y'": v}, events=bounce)
    up = np.where(v < 0, -0.5 * v, v)
    np.testing.assert_allclose(runs["y"], up * 0.05 - 9.81 * 0.05**2 / 2, atol=1e-10)
    assert list(runs["count bounce"]) == [1, 0, 1]
