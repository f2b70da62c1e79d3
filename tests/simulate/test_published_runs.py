"""Runs of mechanisms with constraints against printed values, closed forms and the loops that they close."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import sympy as sp

import built_in
import lagrangian as lg
from size import rest_slow

STEPS = {"rk4": 0.0005}

SQUEEZER = {
    "beta": 15.81077119629904,
    "Theta": -15.75637105984298,
    "gamma": 0.04082224013073101,
    "Phi": -0.5347301163226948,
    "delta": 0.5244099658805304,
    "Omega": 0.5347301163226948,
    "epsilon": 1.048080741042263,
}


@pytest.mark.slow
def test_andrews_squeezer_arrives_where_it_is_printed() -> None:
    """Mazzia and Magherini, Test Set for IVP Solvers 2.4, part II, section 6, at t = 0.03 s."""
    run = built_in.system("andrews-squeezer").simulate(0.03, rtol=1e-13, atol=1e-15)
    assert run.success
    for name, printed in SQUEEZER.items():
        assert run[name][-1] == pytest.approx(printed, rel=1e-9), name
    assert run.drift is not None and run.drift.position_after < 1e-14


def test_a_sleigh_comes_to_run_along_its_course() -> None:
    """v = V tanh(k t), θ'² = (2E − m v²)/(J + m a²) from rest along the course: V² = 2E/m, k = m a V/(J + m a²).

    Chaplygin 1911; Neimark and Fufaev, Dynamics of Nonholonomic Systems, 1972, III.2.
    """
    s = built_in.system("chaplygin-sleigh")
    m, J, a = (float(s.model.values[p.symbol]) for p in s.model.parameters)
    run = s.simulate(5.0, initial={"theta'": 3.0}, rtol=1e-12, atol=1e-14)
    inertia = J + m * a * a
    energy = inertia * 9.0 / 2
    final = np.sqrt(2 * energy / m)
    v = final * np.tanh(m * a * final / inertia * run.t)
    rate = np.sqrt(np.maximum(2 * energy - m * v * v, 0) / inertia)
    along = run["x'"] * np.cos(run["theta"]) + run["y'"] * np.sin(run["theta"])
    assert along == pytest.approx(v, abs=1e-10)
    assert run["theta'"] == pytest.approx(rate, abs=1e-7)  # a root of a difference
    turning = -a * m * along * run["theta'"] / inertia
    assert run["knife edge"] == pytest.approx(m * (along * run["theta'"] + a * turning), abs=1e-11)


def test_a_wheel_rolls_down_and_its_friction_is_a_third_of_its_weight_along_the_slope() -> None:
    """A solid cylinder: x'' = (2/3) g sin β, friction m g sin β/3 up the slope."""
    s = built_in.system("wheel-on-incline")
    p = {x.name: float(x.value or 0.0) for x in s.model.parameters}
    run = s.simulate(2.0)
    weight = p["m"] * p["g"] * np.sin(p["beta"])
    assert run["x"] == pytest.approx(weight / p["m"] * run.t**2 / 3, abs=1e-9)
    assert run["slope"] == pytest.approx(np.full(len(run.t), -weight / 3), rel=1e-12)


def bricard(quarter: sp.Expr | float = sp.pi / 2) -> lg.System:
    """Six equal links, twisted by ±90° in turns, the last hinge on the ground: the regular trihedral loop of Bricard.

    It has one degree of freedom though it should have none: cos θ + cos φ + cos θ cos φ = 0 (Baker, Mechanism and
    Machine Theory 15, 1980).
    """
    s = lg.System("Bricard's loop")
    frame, at = None, s.origin
    for k, q in enumerate(s.coordinates("a b c d e")):
        joint = s.frame(q, axis=(0, 0, 1), parent=frame, origin=at, name=f"link{k}")
        s.rigid_body(1 + k, (0.1, 0.2, 0.3), at=joint.point(0.5, 0, 0, at=at), frame=joint)
        at = joint.point(1, 0, 0, at=at)
        frame = s.frame(quarter * (-1) ** k, axis=(1, 0, 0), parent=joint, origin=at, name=f"twist{k}")
    assert frame is not None
    s.gravity((0, 0, -1))
    ground = s.frame(quarter, axis=(1, 0, 0), name="ground")  # its z is −y
    s.pin((frame.point(0, 0, 0, at=at), s.origin + (-1, 0, 0)), axis=(0, 0, 1), bodies=(frame, ground), name="sixth")
    return s


def door() -> lg.System:
    """A free body on two ball hinges: one of the six rows says again what the others say."""
    s = lg.System("door")
    leaf = s.floating_frame("leaf")
    s.rigid_body(3, (0.2, 0.4, 0.5), at=leaf.point(0.5, 0.1, 1), frame=leaf)
    s.gravity((0, 3, -4))
    s.ball((leaf.origin, s.origin), name="lower hinge")
    s.ball((leaf.point(0, 0, 2), s.origin + (0, 0, 2)), name="upper hinge")
    return s


def trihedral(theta: float) -> dict[str, float]:
    phi = float(np.arccos(-np.cos(theta) / (1 + np.cos(theta))))
    return {"a": theta, "b": phi, "c": theta, "d": phi, "e": theta}


REDUNDANT: dict[str, tuple[Callable[[], lg.System], dict[str, float]]] = {
    "double parallelogram": (lambda: built_in.system("double-parallelogram"), {f"theta{k}": -1.0 for k in (1, 2, 3)}),
    "Bricard": (bricard, trihedral(1.9)),
    "door": (door, {"leaf_qz": float(np.sin(0.4)), "leaf_qw": float(np.cos(0.4))}),
}


@pytest.mark.parametrize("name", rest_slow(REDUNDANT, {"double parallelogram"}))
def test_loops_with_a_row_too_many_stay_closed_for_20_seconds(name: str) -> None:
    build, start = REDUNDANT[name]
    s = build()
    run = s.simulate(20.0, initial=start)
    assert run.success, run.message
    n = len(s.model.coordinates)
    left = s.compile().residual(run.y[:n].T, run.y[n:].T)
    for rows in left.values():
        assert max(np.abs(x).max() for x in rows.values()) < 1e-12
    assert float(run.audit) < 1e-8
    assert np.ptp(run.y[:n], axis=1).max() > 0.1  # it moves
    if name == "Bricard":
        a, b = np.cos(run["a"]), np.cos(run["b"])
        assert np.abs(a + b + a * b).max() < 1e-12


@pytest.mark.slow
def test_a_turn_by_a_rounded_quarter_is_a_turn_by_a_quarter() -> None:
    """cos of a rounded π/2 is 6e-17 and stands in the rows as a number: nothing may be divided by it."""
    q = list(trihedral(1.9).values())
    exact, rounded = (bricard(quarter).compile().forward(q, np.zeros(5)) for quarter in (sp.pi / 2, np.pi / 2))
    assert np.abs(exact).max() > 1
    assert rounded == pytest.approx(exact, rel=1e-10)


SLOWEST = ("RK45", "Radau")


@pytest.mark.slow
@pytest.mark.parametrize(
    "method",
    ["dop853", "tsit5", "taylor", "rk4", "DOP853", *(pytest.param(m, marks=pytest.mark.exhaustive) for m in SLOWEST)],
)
def test_a_four_bar_stays_closed_for_100_seconds_by_every_method(method: str) -> None:
    s = built_in.system("four-bar")
    looser: dict[str, Any] = {"rtol": 1e-11, "atol": 1e-13} if method == "RK45" else {}  # to save half the time
    run = s.simulate(100.0, method=method, step=STEPS.get(method), **looser)
    assert run.success, run.message
    left = s.compile().residual(run.y[:3].T, run.y[3:].T)
    assert max(np.abs(x).max() for rows in left.values() for x in rows.values()) < 1e-12
    assert float(run.audit) < 1e-8
    assert all(notice.code == "E303" for notice in run.notices)


@pytest.mark.slow
@pytest.mark.thinned(3)
@pytest.mark.parametrize("method", ["LSODA", "BDF", "Radau"])
def test_a_four_bar_stays_closed_for_ten_seconds_by_implicit_methods(method: str) -> None:
    s = built_in.system("four-bar")
    run = s.simulate(10.0, method=method, rtol=1e-9, atol=1e-12)
    left = s.compile().residual(run.y[:3].T, run.y[3:].T)
    assert run.success and max(np.abs(x).max() for rows in left.values() for x in rows.values()) < 1e-12


@pytest.mark.slow
def test_lsoda_keeps_its_order_where_components_pass_zero_or_stay_there() -> None:
    """ψ stays at zero to rounding. With errors relative to |x_i| alone: 1245 steps, and 3.8e-9 of the energy."""
    run = built_in.system("double-parallelogram").simulate(5.0, method="LSODA", samples=11)
    assert run.success and run.steps < 700 and float(run.audit) < 5e-10


ORDERS = {"rk4": (4, 0.02), "tsit5": (5, 0.02), "dop853": (8, 0.04), "RK45": (5, 0.02), "RK23": (3, 0.01)}
"""The order of a method, and the longest of the steps that are tried."""


@pytest.mark.parametrize("method", rest_slow(ORDERS, {"rk4"}))
def test_projection_keeps_the_order_of_a_method(method: str) -> None:
    """With loose tolerances an adaptive method takes the longest steps that it may take."""
    s, (order, longest) = built_in.system("four-bar"), ORDERS[method]
    exact = s.simulate(2.0, rtol=1e-13, atol=1e-15, samples=2)["theta1"][-1]

    def error(h: float) -> float:
        how: dict[str, Any] = {"step": h} if method == "rk4" else {"max_step": h, "rtol": 1.0, "atol": 10.0}
        run = s.simulate(2.0, method=method, samples=2, **how)
        assert run.steps <= 2.0 / h + 2
        return abs(run["theta1"][-1] - exact)

    errors = [error(longest / k) for k in (1, 2, 4)]
    assert errors[0] / errors[1] > 2 ** (order - 0.6) and errors[1] / errors[2] > 2 ** (order - 0.6)
