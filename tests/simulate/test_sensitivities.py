"""Sensitivities of runs, against closed solutions and central differences."""

import pickle
from typing import Any

import numpy as np
import pytest
import sympy as sp

import lagrangian as lg


def cart() -> lg.System:
    """m ẍ = F − b ẋ."""
    system = lg.System("cart")
    x, F = system.coordinate("x"), system.input("F")
    m, b = system.parameter("m", 2.0), system.parameter("b", 0.5)
    system.particle(m, at=system.origin + (x, 0), name="cart")
    system.damper(b, deflection=x)
    system.force((F, 0), at=system.origin + (x, 0), name="push")
    return system


def ball() -> lg.System:
    system = lg.System("ball")
    y = system.coordinate("y")
    system.parameter("e", 0.8)
    system.particle(system.parameter("m", 1.0), at=system.origin + (0, y))
    system.gravity()
    return system


@pytest.mark.slow
def test_a_cart_that_a_damper_stops_against_its_closed_solution() -> None:
    """x = v m/b (1 − e^(−bt/m)) + F/b (t − m/b (1 − e^(−bt/m))), differentiated by SymPy."""
    run = cart().simulate(3.0, samples=7, initial={"x'": 0.7}, inputs={"F": 1.5})
    found = run.sensitivities(["m", "b", "x'", "F", "x"])
    assert "not compared with runs yet" in repr(found)
    assert found.verify()[0].holds and "equal to quotients of runs, largest relative difference" in repr(found)
    m, b, v, F, t = sp.symbols("m b v F t")
    gone = m / b * (1 - sp.exp(-b * t / m))
    x = v * gone + F / b * (t - gone)
    at = {m: 2.0, b: 0.5, v: 0.7, F: 1.5}
    for j, symbol in enumerate((m, b, v, F)):
        for name, exact in (("x", x), ("x'", sp.diff(x, t)), ("m*x'^2/2", m * sp.diff(x, t) ** 2 / 2)):
            slope = sp.lambdify(t, sp.diff(exact, symbol).subs(at))
            np.testing.assert_allclose(found[name][:, j], slope(run.t) * np.ones(7), rtol=1e-8, atol=1e-9)
    np.testing.assert_allclose(found["x", "x"], 1.0)
    np.testing.assert_allclose(found["F", "F"], 1.0)


@pytest.mark.sampled(3)
@pytest.mark.parametrize(("hold", "method"), [("linear", "dop853"), ("hold", "dop853"), ("hold", "tsit5")])
def test_every_value_of_a_table_has_its_own_column(hold: str, method: str) -> None:
    """The cart is linear, so that the difference of two runs is the derivative."""
    system, knots = cart(), [0.0, 0.5, 1.0, 2.0]
    values = [1.0, -2.0, 0.5, 3.0]
    run = system.simulate(2.0, samples=9, inputs={"F": (knots, values, hold)}, method=method)
    found = run.sensitivities("F")
    assert found.wrt == ("F[0]", "F[1]", "F[2]", "F[3]")
    for k in range(4):
        other = [x + (i == k) for i, x in enumerate(values)]
        raised = system.simulate(2.0, samples=9, inputs={"F": (knots, other, hold)}, method=method)
        np.testing.assert_allclose(found.changes[:, :, k], raised.y - run.y, atol=2e-8)


@pytest.mark.slow
def test_a_bouncing_ball_against_its_closed_solution() -> None:
    """y = v₁ s − g s²/2 with s = t − t₁, v₁ = e g t₁, t₁ = √(2h/g) after the first bounce, and the same again."""
    system = ball()
    y = system["y"]
    bounce = lg.event(y, direction=-1, reset={y.diff(): -system["e"] * y.diff()}, name="bounce")
    run = system.simulate(1.4, y=1.0, samples=15, events=bounce)
    found = run.sensitivities(["e", "g", "y"])
    e, g, h, t = sp.symbols("e g h t")
    first = sp.sqrt(2 * h / g)
    second = first + 2 * e * first
    assert len(run.events["bounce"].t) == 2
    at = {e: 0.8, g: run.params["g"], h: 1.0}
    flights = (
        h - g * t**2 / 2,
        e * g * first * (t - first) - g * (t - first) ** 2 / 2,
        e**2 * g * first * (t - second) - g * (t - second) ** 2 / 2,
    )
    flight = np.searchsorted(run.events["bounce"].t, run.t)
    for j, symbol in enumerate((e, g, h)):
        wanted = [sp.diff(flights[k], symbol).subs(at).subs(t, s) for k, s in zip(flight, run.t, strict=True)]
        np.testing.assert_allclose(found["y"][:, j], np.array(wanted, float), rtol=1e-8, atol=1e-9)
        times = [float(sp.diff(x, symbol).subs(at)) for x in (first, second)]
        np.testing.assert_allclose(found.events["bounce"][:, j], times, rtol=1e-8, atol=1e-9)


@pytest.mark.slow
def test_the_time_of_a_terminal_event_changes_as_the_formula_says() -> None:
    """A thrown ball lands at t = 2 v/g."""
    system = ball()
    land = lg.event(system["y"], direction=-1, terminal=True, name="end")
    run = system.simulate(5.0, initial={"y'": 3.0}, events=land)
    found = run.sensitivities(["y'", "g"])
    g = run.params["g"]
    np.testing.assert_allclose(found.events["end"], [[2 / g, -6 / g**2]], rtol=1e-9)
    assert found.t[-1] == pytest.approx(6 / g)


@pytest.mark.slow
@pytest.mark.parametrize(
    "options",
    [{"method": "rk4", "step": 1e-3}, {"method": "Radau"}, {"method": "LSODA"}, {"method": "gauss4", "step": 1e-3}],
)
def test_other_methods_find_the_same(options: dict[str, Any]) -> None:
    system, names = lg.example("double-pendulum"), ["m1", "L2", "theta1", "theta2'"]
    usual = system.simulate(1.0, samples=5, theta1=0.5, theta2=0.3).sensitivities(names)
    other = system.simulate(1.0, samples=5, theta1=0.5, theta2=0.3, **options).sensitivities(names)
    np.testing.assert_allclose(other.changes, usual.changes, atol=1e-6)


@pytest.mark.slow
def test_feedback_and_a_floating_frame_against_central_differences() -> None:
    system = lg.System("hull")
    hull, tau = system.floating_frame("hull"), system.input("tau")
    K = system.parameter("K", 3.0)
    system.rigid_body(system.parameter("m", 5.0), (1.0, 2.0, 2.5), at=hull.origin, frame=hull)
    system.torque((tau, 0, 0), on=hull)
    spin, name = system.model.velocities[3].symbol, system.model.velocities[4].name

    def final(gain: float, rate: float) -> Any:
        start = {name: rate, system.model.velocities[3].name: 0.4}
        return system.simulate(1.5, samples=4, params={"K": gain}, initial=start, inputs={"tau": -K * spin})

    found = final(3.0, 0.3).sensitivities(["K", name])
    for j, (a, b) in enumerate((((3 + 1e-4, 0.3), (3 - 1e-4, 0.3)), ((3.0, 0.3 + 1e-4), (3.0, 0.3 - 1e-4)))):
        np.testing.assert_allclose(found.changes[:, :, j], (final(*a).y - final(*b).y) / 2e-4, atol=1e-7)


def test_points_are_differentiated_and_names_are_found_by_symbol() -> None:
    system = ball()
    run = system.simulate(1.0, samples=3, y=2.0)
    found = run.sensitivities([system["y"], "g"])
    point = system.model.elements[0].at  # type: ignore[attr-defined]
    assert found[point].shape == (3, 2, 2)
    np.testing.assert_allclose(found[point][:, 1, 1], -(run.t**2) / 2, atol=1e-9)
    np.testing.assert_array_equal(found["y", system["y"]], found["y"][:, 0])
    again = pickle.loads(pickle.dumps(run)).sensitivities("g")
    np.testing.assert_allclose(again["y", "g"], found["y", "g"], rtol=1e-12)


def test_by_default_all_parameters_are_varied() -> None:
    assert cart().simulate(1.0, samples=2).sensitivities().wrt == ("m", "b")


@pytest.mark.parametrize(
    ("wrt", "code", "said"),
    [
        ("M", "E402", "states and inputs: m, b, x"),
        (["m", "m"], "E404", "twice"),
        ([], "E401", "names nothing"),
        (3, "E501", "names or symbols"),
        ([b"m"], "E501", "names or symbols"),
    ],
)
def test_names_that_do_not_fit_are_said(wrt: Any, code: str, said: str) -> None:
    with pytest.raises(lg.RunError) as caught:
        cart().simulate(1.0, samples=2).sensitivities(wrt)
    assert caught.value.code == code
    assert said in str(caught.value)


@pytest.mark.slow
def test_what_has_no_derivative_is_refused() -> None:
    system = cart()
    v = system["x"].diff()
    with pytest.raises(lg.RunError, match="Python function"):
        system.simulate(0.1, inputs={"F": lambda t, x: 1.0}).sensitivities("m")
    with pytest.raises(lg.RunError, match="expression of time and state"):
        system.simulate(0.1, inputs={"F": -v}).sensitivities("F")
    with pytest.raises(lg.RunError, match="sign of something that is varied") as caught:
        system.simulate(0.1, inputs={"F": -sp.sign(v)}, initial={"x'": 1.0}).sensitivities("m")
    assert caught.value.code == "E525"
    with pytest.raises(lg.RunError, match="a table, whose rate is not known"):
        event = lg.event(system["x"] - system["F"], name="catch")
        system.simulate(0.1, inputs={"F": ([0, 1], [1.0, 2.0])}, events=event).sensitivities("m")
    with pytest.raises(lg.RunError, match="the run failed"):
        system.simulate(100.0, max_steps=3).sensitivities("m")
    found = system.simulate(0.1).sensitivities("m")
    with pytest.raises(lg.Error, match="'b'"):
        found["x", "b"]
    with pytest.raises(lg.Error, match="a name or an expression"):
        found[3]
    with pytest.raises(lg.RunError, match="outputs must be a mapping"):
        found.observe(3)  # type: ignore[arg-type]
    assert found.observe({"square": "x^2"})["square"].shape == (1001, 1)


@pytest.mark.slow
def test_constraints_and_dry_friction_are_refused() -> None:
    tied = cart()
    tied.constraint(tied["x"] - sp.sin(tied.t), name="tie")
    with pytest.raises(lg.RunError, match="has constraints"):
        tied.simulate(0.1).sensitivities("m")
    slider = lg.System("slider")
    s = slider.coordinate("s")
    slider.particle(slider.parameter("m", 1.0), at=slider.origin + (s, 0))
    slider.friction(0.2, normal=9.81, deflection=s)
    with pytest.raises(lg.ModelError) as caught:
        slider.simulate(0.1, initial={"s'": 1.0}).sensitivities("m")
    assert caught.value.code == "E311"
