"""What fits, optimizations and sensitivities return is held against ordinary runs; a wrong derivative is found."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import lagrangian as lg
from lagrangian.fit import problem
from lagrangian.optimize import objective
from lagrangian.simulate import sensitivities, varied

T = np.linspace(0.0, 2.0, 21)


def ball() -> tuple[lg.System, lg.Event]:
    """A ball that loses speed at the ground."""
    system = lg.System("ball")
    y, e = system.coordinate("y"), system.parameter("e", 0.8)
    system.particle(system.parameter("m", 1.0), at=system.origin + (0, y))
    system.gravity()
    return system, lg.event(y, direction=-1, reset={y.diff(): -e * y.diff()}, name="bounce")


def data() -> dict[str, Any]:
    return {"t": T, "theta": lg.example("pendulum").simulate(times=T, theta=0.5)["theta"]}


@pytest.fixture
def wrong(monkeypatch: pytest.MonkeyPatch) -> None:
    """Variational equations that are wrong by a thousandth."""
    right = varied.varied_run

    def off(*given: Any) -> varied.VariedRun:
        made = right(*given)
        more = {"changes": made.changes * 1.001, "integral_changes": made.integral_changes * 1.001}
        return replace(made, **more)

    for module in (problem, objective, sensitivities):
        monkeypatch.setattr(module, "varied_run", off)


def test_a_fit_is_held_against_ordinary_runs() -> None:
    found = lg.example("pendulum").fit(data(), {"L": 0.45, "theta": 0.4})
    assert [check.holds for check in found.checks] == [True, True]
    assert "What was checked" in str(found)
    assert [check["holds"] for check in found.report().data["checks"]] == [True, True]


@pytest.mark.usefixtures("wrong")
def test_a_wrong_jacobian_of_a_fit_is_told() -> None:
    found = lg.example("pendulum").fit(data(), {"L": 0.45, "theta": 0.4})
    assert [check.holds for check in found.checks] == [True, False]
    assert "DOES NOT HOLD" in repr(found)


@pytest.mark.slow
def test_an_optimum_is_held_against_ordinary_runs_and_quadrature() -> None:
    """With jumps of the velocity inside the run, between which the integrand is integrated by quadrature."""
    system, bounce = ball()
    found = system.optimize({"e": 0.7}, 1.2, y=1.0, events=bounce, integral="(y - 0.4)^2", final="y'^2")
    assert [check.holds for check in found.checks] == [True, True]
    assert "What was checked" in str(found)


@pytest.mark.slow
def test_an_optimum_that_an_event_ends_is_held_too() -> None:
    system, bounce = ball()
    ground = lg.event(bounce.expression, direction=-1, terminal=True)
    found = system.optimize({"y'": 1.0}, 5.0, y=1.0, events=ground, integral="(y - 0.4)^2", final="y'^2")
    assert [check.holds for check in found.checks] == [True, True]


@pytest.mark.slow
@pytest.mark.usefixtures("wrong")
def test_a_wrong_gradient_of_an_optimum_is_told() -> None:
    push = {"F": ([0, 0.5, 1], [0.0, 0.1, 0.0])}
    found = lg.example("cart-pole").optimize("F", 1.0, integral="F^2 + x^2", reach={"x": 0.1}, inputs=push, theta=0.1)
    assert [check.holds for check in found.checks] == [True, False]
    assert "DOES NOT HOLD" in repr(found)


@pytest.mark.slow
def test_sensitivities_are_held_against_ordinary_runs() -> None:
    run = lg.example("double-pendulum").simulate(2.0, theta1=0.5, theta2=0.2, samples=101)
    (check,) = run.sensitivities(["m2", "L1", "theta1"]).verify()
    assert check.holds


@pytest.mark.slow
def test_samples_that_an_event_comes_close_to_are_left_out() -> None:
    system, bounce = ball()
    (check,) = system.simulate(1.2, y=1.0, events=bounce).sensitivities(["e", "g"]).verify()
    assert check.holds


@pytest.mark.slow
@pytest.mark.usefixtures("wrong")
def test_wrong_sensitivities_are_told() -> None:
    run = lg.example("double-pendulum").simulate(2.0, theta1=0.5, theta2=0.2, samples=101)
    (check,) = run.sensitivities(["m2", "L1", "theta1"]).verify()
    assert check.holds is False


@pytest.mark.slow
def test_where_quotients_do_not_settle_it_is_said() -> None:
    """Over a minute a double pendulum that turns over is chaotic: a change of a thousandth changes everything."""
    run = lg.example("double-pendulum").simulate(60.0, theta1=2.0, theta2=2.0, samples=61)
    (check,) = run.sensitivities(["m2"]).verify()
    assert check.holds is None
    assert "do not settle" in check.figure
    assert repr(check).count("not checked") == 1
    with pytest.raises(lg.RunError, match="seed must be a whole number"):
        sensitivities.Sensitivities.verify(run.sensitivities("m2"), seed="a")  # type: ignore[arg-type]
