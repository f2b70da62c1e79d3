"""Linearizations in symbols and along trajectories."""

from typing import Any

import numpy as np
import pytest
import sympy as sp

import lagrangian as lg
from built_in import system as built_in
from lagrangian import dynamics
from lagrangian.errors import RunError
from lagrangian.graph import evaluate
from lagrangian.model import time


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "name",
    ["lecture-1", "lecture-2", "cart-pole", "double-pendulum", "bead-on-hoop", "elastic-pendulum", "furuta-pendulum"],
)
def test_symbols_with_numbers_put_in_are_the_numbers(name: str) -> None:
    system = built_in(name)
    for rest in system.equilibria()[:2]:
        linear = system.linearize(rest)
        found = linear.symbolic
        values: dict[Any, float] = {s: linear.parameters[str(s)] for s in system.model.values}
        for c in system.model.coordinates:
            if found.point[c.symbol].is_Symbol:
                values[found.point[c.symbol]] = rest[c.name]
        values[time] = 0.0
        assert linear.stiffness is not None
        for got, wanted in ((found.A, linear.A), (found.B, linear.B), (found.K, linear.stiffness)):
            numbers = np.array(got.subs(values).tolist(), float).reshape(np.shape(wanted))
            assert np.allclose(numbers, wanted, rtol=1e-12, atol=1e-10)
        for condition in found.conditions:
            left: Any = condition.lhs
            assert float(left.subs(values)) == pytest.approx(0, abs=1e-12)


def test_the_double_pendulum_hanging_reads_as_in_the_textbook() -> None:
    """Landau & Lifshitz, Mechanics, § 23, problem 2: T and V of small angles."""
    found = built_in("double-pendulum").linearize().symbolic
    m1, m2, L1, L2, g = sp.symbols("m1 m2 L1 L2 g")
    M = sp.Matrix([[(m1 + m2) * L1**2, m2 * L1 * L2], [m2 * L1 * L2, m2 * L2**2]])
    K = sp.diag((m1 + m2) * g * L1, m2 * g * L2)
    assert (found.M - M).expand() == sp.zeros(2, 2)
    assert (found.K - K).expand() == sp.zeros(2, 2)
    assert sp.simplify(found.A[2:, :2] + M.inv() * K) == sp.zeros(2, 2)


def test_what_is_too_long_is_refused() -> None:
    system = lg.System("row")
    for k in range(8):
        q = system.coordinate(f"q{k}")
        system.particle(1, at=system.origin + (q, 0))
        system.spring(1, deflection=q)
    with pytest.raises(RunError, match="too long"):
        _ = system.linearize().symbolic


def test_a_point_that_is_no_rest_has_no_symbols() -> None:
    with pytest.raises(RunError, match="only at an equilibrium"):
        _ = built_in("pendulum").linearize({"theta": 1}, operating_point=True).symbolic


# -- along a trajectory --------------------------------------------------------------------------------------------


def test_along_a_trajectory_neighbours_part_as_the_linear_system_says() -> None:
    """x(t; x₀ + ε) − x(t; x₀) to first order is Φ(t) ε with Φ̇ = A(t) Φ, both integrated by SciPy."""
    from scipy.integrate import solve_ivp
    from scipy.interpolate import CubicSpline

    system = built_in("double-pendulum")
    program = dynamics.rhs(system.model)
    p = [x.value for x in system.model.parameters]
    x0, eps = np.array([0.5, -0.3, 0.0, 0.2]), np.array([1e-5, 2e-5, 0, -1e-5])
    t = np.linspace(0, 1, 201)

    def rhs(_: float, x: np.ndarray) -> list[float]:
        return evaluate(program, {"x": x.tolist(), "u": [], "p": p, "t": [0.0]})["xdot"]

    ends = [solve_ivp(rhs, (0, 1), x0 + s * eps, t_eval=t, rtol=1e-10, atol=1e-13, method="DOP853") for s in (1, -1, 0)]
    found = system.linearize_along((t, ends[2].y.T))
    assert found.A.shape == (201, 4, 4) and found.B.shape == (201, 4, 0) and len(found) == 201
    A = CubicSpline(t, found.A)
    moved = solve_ivp(lambda s, d: A(s) @ d, (0, 1), eps, rtol=1e-10, atol=1e-15).y[:, -1]
    assert np.allclose(moved, (ends[0].y[:, -1] - ends[1].y[:, -1]) / 2, rtol=1e-6)


def test_every_moment_along_a_trajectory_is_an_operating_point() -> None:
    system = built_in("cart-pole")
    t = np.array([0.0, 0.5])
    x = np.array([[0.1, 0.2, 0.3, 0.4], [0.0, -0.5, 1.0, 0.0]])
    found = system.linearize_along((t, x), inputs={"F": [1.0, -2.0]}, outputs=["x + l*sin(theta)"])
    for k in range(2):
        names = dict(zip(found.states, x[k], strict=True))
        point = system.linearize(names, inputs={"F": found.u[k, 0]}, operating_point=True, outputs=["x + l*sin(theta)"])
        for a, b in ((found.A[k], point.A), (found.B[k], point.B), (found.C[k], point.C), (found.D[k], point.D)):
            assert np.allclose(a, b, rtol=1e-12, atol=1e-14)


@pytest.mark.parametrize(
    ("trajectory", "message"),
    [
        ((np.zeros(3), np.zeros((3, 5))), r"\(S, 4\)"),
        ("run", "pair"),
        ((np.zeros(1), np.full((1, 4), np.nan)), "not finite"),
        ((["a"], [[1, 2, 3, 4]]), "real numbers"),
    ],
)
def test_bad_trajectories_are_named(trajectory: object, message: str) -> None:
    with pytest.raises(RunError, match=message):
        built_in("cart-pole").linearize_along(trajectory)
