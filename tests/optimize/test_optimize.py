"""Optimal runs against problems whose solutions are known."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import lagrangian as lg
from lagrangian.simulate import allowance


def cart() -> lg.System:
    system = lg.System("cart")
    x, F = system.coordinate("x"), system.input("F")
    system.particle(system.parameter("m", 1.0), at=system.origin + (x, 0))
    system.force((F, 0), at=system.origin + (x, 0), name="push")
    return system


@pytest.mark.slow
def test_the_least_effort_from_rest_to_rest_is_a_straight_line() -> None:
    """min ∫ F² dt with x(1) = 1 and x'(1) = 0: F = 6 − 12 t, the cost 12 (Bryson and Ho, Applied Optimal Control)."""
    times = np.linspace(0, 1, 5)
    found = cart().optimize({"F": (times, np.zeros(5))}, 1.0, integral="F^2", reach={"x": 1, "x'": 0}, tolerance=1e-12)
    assert found.success
    assert found.cost == pytest.approx(12.0, rel=1e-7)
    np.testing.assert_allclose(found.inputs["F"][1], 6 - 12 * times, atol=1e-3)
    assert max(map(abs, found.missing.values())) < 1e-8
    again = cart().simulate(1.0, inputs=found.inputs)
    assert again["x"][-1] == pytest.approx(1.0, abs=1e-7)


@pytest.mark.slow
def test_the_best_damping_of_an_oscillator() -> None:
    """∫ x² dt of ẍ + c ẋ + x = 0 from x = 1 is (c + 1/c)/2, least at c = 1."""
    system = cart()
    c, x = system.parameter("c", 0.4), system["x"]
    found = system.optimize(["c"], 60.0, integral=x**2, inputs={"F": -x - c * x.diff()}, x=1.0)
    assert found.success
    assert found.params["c"] == pytest.approx(1.0, abs=1e-4)
    assert found.cost == pytest.approx(1.0, rel=1e-8)
    assert found.first_cost == pytest.approx(0.5 * (0.4 + 1 / 0.4), rel=1e-4)


@pytest.mark.slow
def test_the_end_of_a_run_moves_with_a_terminal_event() -> None:
    """A thrown ball lands at t = 2 v/g, whatever is wanted of the end."""
    system = lg.System("ball")
    y = system.coordinate("y")
    system.particle(1.0, at=system.origin + (0, y))
    system.gravity()
    land = lg.event(y, direction=-1, terminal=True, name="land")
    g = 9.81
    system.parameter("T", 1.2)
    found = system.optimize({"y'": 3.0}, 10.0, final="(t - T)^2", events=land)
    assert found.initial["y'"] == pytest.approx(0.6 * g, rel=1e-6)
    by_integral = system.optimize({"y'": 3.0}, 10.0, integral="2*(t - T)", events=land)  # t² − 2 t T at the end
    assert by_integral.initial["y'"] == pytest.approx(0.6 * g, rel=1e-5)
    fast = system.optimize({"y'": 3.0}, 10.0, final="1", reach={"y'": -8}, events=land)
    assert fast.initial["y'"] == pytest.approx(8.0, rel=1e-7)


def test_bounds_hold_and_are_named() -> None:
    found = cart().optimize({"x'": 0.5}, 2.0, final="(x - 4)^2", bounds={"x'": (0, 1.5)})
    assert found.values["x'"] == pytest.approx(1.5)
    assert found.at_bound == ("x'",)
    assert "on a bound" in found.to_text()
    assert found.to_dict()["cost"] == pytest.approx(1.0)
    assert repr(found).startswith("<Optimum 'cart': cost 1 at x' = 1.5")


@pytest.mark.slow
def test_masses_that_cannot_be_are_not_tried() -> None:
    found = cart().optimize({"m": 2.0}, 1.0, final="(x - 5)^2", inputs={"F": 1.0})
    assert found.params["m"] == pytest.approx(0.1, rel=1e-5)


@pytest.mark.slow
def test_what_cannot_be_reached_is_no_success() -> None:
    found = cart().optimize({"x'": 1.0}, 1.0, final="x^2", reach={"x": 1, "x'": 0})
    assert not found.success
    assert "missed by" in found.message
    assert "FAILED" in repr(found)


@pytest.mark.parametrize(
    ("unknowns", "options", "code", "said"),
    [
        ("F", {}, "E401", "nothing is to be minimized"),
        ("G", {"final": "x"}, "E402", "nothing called 'G' to optimize"),
        ([], {"final": "x"}, "E401", "names nothing"),
        ("F", {"final": "z"}, "E402", "z"),
        ("F", {"final": "x", "reach": ["x"]}, "E501", "a mapping"),
        ("F", {"final": "x", "reach": {"w": 1}}, "E402", "w"),
        ("F", {"final": "x", "reach": {"x": np.nan}}, "E502", "reach: 'x'"),
        ("F", {"final": "x", "bounds": {"m": (0, 1)}}, "E402", "not an unknown"),
        ({"F": ([0, 1], [0])}, {"final": "x"}, "E501", "one value for each time"),
        ({"x": np.inf}, {"final": "x"}, "E502", "first guess of 'x'"),
        ("F", {"final": "x", "tolerance": 2}, "E501", "between 0 and 1"),
        ("F", {"final": "x", "max_evaluations": 1.5}, "E501", "whole number"),
        ("F", {"final": "x", "params": 3}, "E501", "params must be a mapping"),
        ("F", {"final": "x", "inputs": [1]}, "E501", "inputs must be a mapping"),
        ("F", {"final": "x", "y": 2}, "E402", "no option or state 'y'"),
        ("F", {"final": "x", "inputs": {"F": lambda t, x: 0.0}}, "E501", "Python function"),
        ("F", {"final": "x", "inputs": {"F": "-x"}}, "E501", "an expression of time and state"),
        ("x", {"final": "log(x)"}, "E503", ""),
    ],
)
def test_what_does_not_fit_is_said(unknowns: Any, options: Any, code: str, said: str) -> None:
    with pytest.raises(lg.Error) as caught:
        cart().optimize(unknowns, 1.0, **options)
    assert said in str(caught.value)
    assert caught.value.code == code


@pytest.mark.slow
def test_a_cart_pole_is_swung_up_by_a_table_of_forces() -> None:
    """From two different first guesses the same least effort is found, and the pole ends upright and at rest."""
    system, times = lg.example("cart-pole"), np.linspace(0, 3.0, 13)
    upright = {"theta": 0, "x": 0, "theta'": 0, "x'": 0}
    options: dict[str, Any] = {"integral": "F^2", "reach": upright, "theta": np.pi, "samples": 26, "tolerance": 1e-6}
    found = [system.optimize({"F": (times, F)}, 3.0, **options) for F in (np.full(13, 0.1), 3 * np.sin(4 * times))]
    for best in found:
        assert best.success, best.message
        assert max(map(abs, best.missing.values())) < 1e-6
    assert found[0].cost == pytest.approx(found[1].cost, rel=1e-4)


@pytest.mark.slow
def test_units_of_what_is_to_be_reached_are_checked() -> None:
    cart = lg.example("cart-pole")
    push = {"F": ([0, 1], [0.0, 0.0])}
    found = cart.optimize("F", 1.0, integral="F^2", reach={"x": "10 cm"}, inputs=push, theta=0.1)
    assert found.run["x"][-1] == pytest.approx(0.1)
    with pytest.raises(lg.RunError, match="reach: 'x' = '1 kg' has the unit kg, but m is needed"):
        cart.optimize("F", 1.0, integral="F^2", reach={"x": "1 kg"}, inputs=push)
    with pytest.raises(lg.RunError, match="tolerance = '1 kg' has the unit kg"):
        cart.optimize("F", 1.0, integral="F^2", inputs=push, tolerance="1 kg")  # type: ignore[arg-type]


@pytest.mark.slow
def test_how_a_search_failed_is_said_in_words_of_its_own() -> None:
    cart = lg.example("cart-pole")
    push = {"F": ([0, 1], [0.0, 0.0])}
    short = cart.optimize("F", 1.0, final="(x - 100)^2", inputs=push, max_evaluations=2)
    assert short.message == "max_evaluations were not enough"
    both = cart.optimize("F", 1.0, integral="F^2", reach={"M": 99}, inputs=push, theta=0.1)
    assert both.message.endswith("contradicts itself, or no unknown changes it")


@pytest.mark.slow
def test_the_evaluations_and_the_time_of_a_search_that_must_reach_something_are_limited(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """By a clock that goes on by a second whenever it is read."""
    cart = lg.example("cart-pole")
    asked = {"integral": "F^2", "reach": {"x": 1.0, "theta": 0.0}, "inputs": {"F": ([0, 1, 2], [0.5, 0.0, -0.5])}}
    short = cart.optimize("F", 2.0, **asked, theta=0.4, max_evaluations=3)
    assert not short.success and short.message.endswith("max_evaluations were not enough")
    assert short.evaluations <= 3 + 2  # the first guess and the values that are returned
    ticks = iter(range(10**6))
    monkeypatch.setattr(allowance, "time", SimpleNamespace(monotonic=lambda: next(ticks)))
    late = cart.optimize("F", 2.0, **asked, theta=0.4, timeout=4.0)
    assert not late.success and late.message.endswith("timeout was not enough")
    assert late.evaluations <= 4 + 2
