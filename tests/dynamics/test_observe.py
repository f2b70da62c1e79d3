"""Expressions of a run, feedback compiled in, and the energy balance, against SymPy and difference quotients."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest
import sympy as sp
from scipy.integrate import solve_ivp

import built_in
import lagrangian as lg
from built_in import FREE, SOME
from lagrangian import codegen as machine
from lagrangian import dynamics
from lagrangian.graph import evaluate
from lagrangian.model import time


def example(name: str) -> lg.System:
    return built_in.system(name)


def test_expressions_are_what_sympy_says() -> None:
    s = example("cart-pole")
    x, theta, F = s["x"], s["theta"], s["F"]
    asked = {"a": sp.sin(theta) * x.diff(), "b": sp.Derivative(sp.cos(theta) * x, time), "c": F**2 + time}
    got = evaluate(dynamics.observe(s.model, asked), {"x": [0.1, 0.2, 0.3, 0.4], "u": [1.5], "t": [2.0]})
    assert got["a"] == pytest.approx(np.sin(0.2) * 0.3, rel=1e-15)
    assert got["b"] == pytest.approx(np.cos(0.2) * 0.3 - np.sin(0.2) * 0.4 * 0.1, rel=1e-15)
    assert got["c"] == pytest.approx(1.5**2 + 2.0, rel=1e-15)


def test_accelerations_and_second_rates_of_definitions_solve_the_derived_equations() -> None:
    s = example("two-carts")
    d = s.derive()
    x1, x2, F = s["x1"], s["x2"], s["F"]
    state = {x1: 0.1, x2: 0.2, x1.diff(): 0.3, x2.diff(): 0.4, F: 1.5}
    asked = {"a1": x1.diff().diff(), "a2": x2.diff().diff()}
    got = evaluate(dynamics.observe(s.model, asked), {"x": [0.1, 0.2, 0.3, 0.4], "u": [1.5], "t": [0.0]})
    for equation in d.equations:
        left = (equation.lhs - equation.rhs).subs({x1.diff(time, 2): got["a1"], x2.diff(time, 2): got["a2"]})
        assert float(left.subs(state).subs(s.model.values)) == pytest.approx(0.0, abs=1e-12)


def test_a_defined_position_has_rate_and_acceleration() -> None:
    s = lg.System("slider")
    q = s.coordinate("q")
    m = s.parameter("m", 2.0)
    X = s.define("X", sp.sin(q))
    s.particle(m, at=s.origin + (X, 0))
    s.potential(3 * q)
    got = evaluate(
        dynamics.observe(s.model, {"V": X.diff(), "A": X.diff().diff()}), {"x": [0.5, 0.7], "u": [], "t": [0]}
    )
    # ½ m (cos q q̇)²: m cos² q̈ − m cos sin q̇² + 3 = 0
    acceleration = (2 * np.cos(0.5) * np.sin(0.5) * 0.49 - 3) / (2 * np.cos(0.5) ** 2)
    assert got["V"] == pytest.approx(np.cos(0.5) * 0.7, rel=1e-14)
    assert got["A"] == pytest.approx(np.cos(0.5) * acceleration - np.sin(0.5) * 0.49, rel=1e-13)


def test_points_are_where_geometry_puts_them() -> None:
    s = example("double-pendulum")
    point = s.model.points[-1]
    got = evaluate(dynamics.observe(s.model, {"P": point}), {"x": [0.3, 0.4, 0, 0], "u": [], "t": [0]})
    wanted = [float(c.subs({s["theta1"]: 0.3, s["theta2"]: 0.4}).subs(s.model.values)) for c in s.model.position(point)]
    assert got["P"] == pytest.approx(wanted, rel=1e-15)


@pytest.mark.parametrize("name", ["cart-pole", "crane", "robot-arm"])
def test_feedback_is_the_right_hand_side_with_the_inputs_put_in(name: str) -> None:
    s = example(name)
    model = s.model
    first, *others = model.inputs
    q = model.coordinates[0].symbol
    law = -3 * q - 2 * q.diff() + sp.sin(time)
    law = law + 2 * others[0].symbol if others else law
    rng = np.random.default_rng(1)
    x = rng.normal(size=2 * len(model.coordinates))
    u = list(rng.normal(size=len(others)))
    k = len(model.coordinates)
    force = -3 * x[0] - 2 * x[k] + np.sin(0.7) + (2 * u[0] if others else 0)
    made = dynamics.closed(model, {first.symbol: law})
    assert made.inputs["u"] == tuple(i.name for i in others)
    got = evaluate(made, {"x": x, "u": u, "t": [0.7]})["xdot"]
    wanted = evaluate(dynamics.rhs(model), {"x": x, "u": [force, *u], "t": [0.7]})["xdot"]
    assert got == pytest.approx(wanted, rel=1e-12)
    shown = dynamics.observe_closed(model, {"F": first.symbol}, {first.symbol: law})
    assert evaluate(shown, {"x": x, "u": u, "t": [0.7]})["F"] == pytest.approx(force, rel=1e-12)


def test_inputs_may_read_each_other_but_not_in_a_circle() -> None:
    s = example("crane")
    F, F_h = s["F"], s["F_h"]
    made = dynamics.closed(s.model, {F: 2 * F_h, F_h: s["x"]})
    got = evaluate(made, {"x": [0.1, 0.2, 0.3, 0, 0, 0], "u": [], "t": [0]})["xdot"]
    wanted = evaluate(dynamics.rhs(s.model), {"x": [0.1, 0.2, 0.3, 0, 0, 0], "u": [0.2, 0.1], "t": [0]})["xdot"]
    assert got == pytest.approx(wanted, rel=1e-13)
    with pytest.raises(lg.ModelError, match="circle: F → F_h"):
        dynamics.closed(s.model, {F: F_h, F_h: F})


def test_what_cannot_be_fed_back_or_observed_is_refused_with_its_name() -> None:
    s = example("cart-pole")
    x, F = s["x"], s["F"]
    with pytest.raises(lg.ModelError, match="'F' depends on an acceleration"):
        dynamics.closed(s.model, {F: x.diff().diff()})
    with pytest.raises(lg.ModelError, match="'x' is not an input"):
        dynamics.closed(s.model, {x: F})
    with pytest.raises(lg.ModelError, match="unknown symbol 'thetta' in 'y'"):
        dynamics.observe(s.model, {"y": sp.Symbol("thetta") + x})
    with pytest.raises(lg.ModelError, match="the rate of an input"):
        dynamics.observe(s.model, {"y": F.diff()})
    with pytest.raises(lg.ModelError, match="unknown symbol 'x'''"):
        dynamics.observe(s.model, {"y": x.diff(time, 3)})


@pytest.mark.sampled(SOME)
@pytest.mark.parametrize("name", FREE)
def test_the_energy_balance_holds_along_the_motion(name: str) -> None:
    model = example(name).model
    p = [0.5 + 0.1 * k if v.value is None else v.value for k, v in enumerate(model.parameters)]
    n, rng = len(model.coordinates), np.random.default_rng(3)
    x, u = rng.uniform(0.2, 0.6, 2 * n), rng.normal(size=len(model.inputs))
    balance = dynamics.power(model)

    # dh/dt along ẋ by a central difference in 40 digits
    rate = evaluate(dynamics.rhs(model), {"x": x, "u": u, "p": p, "t": [0.3]}, digits=40)["xdot"]
    with mpmath.workdps(40):
        e = mpmath.mpf(10) ** -12

        def h(sign: int) -> mpmath.mpf:
            moved = [mpmath.mpf(a) + sign * e * b for a, b in zip(x, rate, strict=True)]
            given = {"x": moved, "u": u, "p": p, "t": [mpmath.mpf(0.3) + sign * e]}
            return evaluate(balance, given, digits=40)["h"]

        slope = float((h(1) - h(-1)) / (2 * e))
    power = float(evaluate(balance, {"x": x, "u": u, "p": p, "t": [0.3]}, digits=40)["P"])
    assert slope == pytest.approx(power, rel=1e-10, abs=1e-10)


def test_the_supplied_energy_is_carried_along_as_a_state() -> None:
    model = example("pendulum").model
    made = dynamics.closed(model, {}, supply=True)
    assert made.inputs["x"] == ("theta", "theta'", dynamics.SUPPLY)
    kernel = machine.compile(made)
    p = list(model.values.values())
    run = solve_ivp(lambda t, x: kernel(x, [], p, t), (0, 5), [1.0, 0.0, 0.0], rtol=1e-11, atol=1e-12)
    balance = machine.compile(dynamics.power(model))
    h = balance(run.y[:2].T, [], p, run.t)["h"]
    assert h - h[0] == pytest.approx(run.y[2], abs=1e-9)
    assert run.y[2, -1] < -0.1  # the damper takes it


def test_a_conservative_system_carries_nothing_extra() -> None:
    model = example("double-pendulum").model
    assert dynamics.closed(model, {}, supply=True).inputs["x"] == dynamics.rhs(model).inputs["x"]
