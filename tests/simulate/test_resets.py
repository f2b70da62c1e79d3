"""A reset without a value: what was run is kept, and the reason is told."""

import numpy as np
import pytest
import sympy as sp

import lagrangian as lg
from lagrangian import event


@pytest.fixture(scope="module")
def ball() -> lg.System:
    """Falls from 1 m: on the ground at √(2/9.81) s with the rate −√(2·9.81)."""
    system = lg.System("ball")
    y = system.coordinate("y")
    m, _ = system.parameters("m g", m=1.0, g=9.81)
    system.particle(m, at=system.origin + (0, y))
    system.gravity(direction=(0, -1))
    return system


@pytest.mark.sampled(2)
@pytest.mark.parametrize("options", [{}, {"method": "taylor"}, {"method": "gauss4", "step": 0.01}, {"method": "RK45"}])
def test_a_reset_to_no_number_ends_the_run_before_it(ball: lg.System, options) -> None:
    y = ball["y"]
    rebound = event(y, direction=-1, reset={y.diff(): sp.sqrt(4 + y.diff())}, name="bounce")
    run = ball.simulate(3.0, y=1.0, events=[rebound], samples=301, **options)
    landing = np.sqrt(2 / 9.81)
    assert not run.success and "the reset of event 'bounce' gives y' = nan" in run.message
    assert "y' = -4.42" in run.message  # the state before it
    assert run.t[-1] == pytest.approx(landing, abs=1e-6)
    assert np.isfinite(run.y).all()
    assert run["y"] == pytest.approx(1 - 9.81 * run.t**2 / 2, abs=1e-4)
    assert run.events["bounce"].t == pytest.approx([landing], abs=1e-6)


def test_a_reset_with_a_value_goes_on(ball: lg.System) -> None:
    y = ball["y"]
    run = ball.simulate(1.0, y=1.0, events=[event(y, direction=-1, reset={y.diff(): sp.sqrt(-y.diff())}, name="b")])
    assert run.success and run.t[-1] == 1.0
