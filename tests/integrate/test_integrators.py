"""Integrators in machine code: orders of convergence, reference problems, lanes and threads."""

import json
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import expm
from simulate_problems import (
    accuracy,
    arenstorf,
    chain,
    double_pendulum,
    double_pendulum_by_mpmath,
    kepler,
    problem,
    start,
)

from lagrangian.integrate import METHODS, RunStatus, Solver
from lagrangian.integrate.methods.taylor import Taylor
from size import rest_slow

SWING = json.loads((Path(__file__).parent / "double_pendulum.json").read_text(encoding="utf-8"))

RUNGE_KUTTA = [n for n, m in METHODS.items() if not m.expands]
ADAPTIVE = [n for n, m in METHODS.items() if m.adaptive]
COUNTS = {"rk4": (800, 1600), "tsit5": (400, 800), "dop853": (60, 120), "gauss4": (100, 200)}
"""Steps in a period: enough for the leading term of the error, few enough to stay above rounding."""


def run(solver, x0, times, h):
    """With steps of length h: fixed, or adaptive with tolerances that never shorten them."""
    if solver.method.adaptive:
        return solver.solve(x0, times, rtol=1e6, atol=1e6, max_step=h)
    return solver.solve(x0, times, step=h)


@pytest.mark.parametrize("name", RUNGE_KUTTA)
def test_the_order_of_convergence_is_the_methods(name):
    solver, x0 = Solver(kepler(), name), start(0.2)
    errors = [np.linalg.norm(run(solver, x0, [0, 2 * np.pi], 2 * np.pi / n).final[0] - x0) for n in COUNTS[name]]
    assert abs(np.log2(errors[0] / errors[1]) - solver.method.order) < 0.1


@pytest.mark.parametrize(("order", "count"), [(3, 192), (4, 192), (5, 96)])
def test_a_series_of_order_n_is_of_order_n(order, count):
    """With counts at which the first steps, each at most twice the one before, weigh nothing."""

    class Fixed(Taylor):
        def suited(self, tolerance):
            return self

    solver = Solver(problem(lambda s: [s["x"] * s["t"].apply("cos")], x="x"), "taylor")
    solver.method = Fixed(order)
    exact = np.exp(np.sin(3.0))
    errors = [abs(run(solver, [1.0], [0, 3.0], 3.0 / n).final[0, 0] - exact) for n in (count, 2 * count)]
    assert abs(np.log2(errors[0] / errors[1]) - order) < 0.1


@pytest.mark.parametrize(("name", "lengths"), [("tsit5", (0.05, 0.025)), ("dop853", (0.4, 0.2))])
def test_values_inside_a_step_have_the_order_they_claim(name, lengths):
    solver = Solver(problem(lambda s: [s["x"] * s["t"].apply("cos")], x="x"), name)
    times = np.linspace(0, 6, 1001)
    exact = np.exp(np.sin(times))  # of ẋ = x cos t
    errors = [np.abs(run(solver, [1.0], times, h).states[0, :, 0] - exact).max() for h in lengths]
    assert np.log2(errors[0] / errors[1]) > solver.method.dense_order + 1 - 0.2


@pytest.mark.parametrize("name", ADAPTIVE)
def test_keplers_orbit_closes(name):
    solver, x0 = Solver(kepler(), name), start(0.6)
    found = solver.solve(x0, [0, 2 * np.pi], rtol=1e-11, atol=1e-11)
    assert np.abs(found.final[0] - x0).max() < 3e-9
    assert found.status[0] == 0 and found.reached[0] == 2 * np.pi


@pytest.mark.parametrize("name", ADAPTIVE)
def test_arenstorfs_orbit_closes(name):
    program, x0, period = arenstorf()
    found = Solver(program, name).solve(x0, [0, period], rtol=1e-13, atol=1e-13)
    assert np.abs(found.final[0] - x0).max() < 1e-6  # errors grow a million times along this orbit


@pytest.mark.parametrize("name", ADAPTIVE)
def test_a_double_pendulum_agrees_with_mpmath(name):
    found = Solver(double_pendulum(), name).solve(SWING["start"], [0.0, SWING["time"]], rtol=1e-13, atol=1e-13)
    assert np.abs(found.final[0] - SWING["end"]).max() < 1e-10


@pytest.mark.slow
def test_what_is_stored_of_the_double_pendulum_is_what_mpmath_gives():
    exact = double_pendulum_by_mpmath(tuple(SWING["start"]), SWING["time"])
    assert np.abs(exact - SWING["end"]).max() < 1e-14


@pytest.mark.sampled(6)
@pytest.mark.parametrize("name", RUNGE_KUTTA)
@pytest.mark.parametrize("size", [5, 12])
def test_long_vectors_in_loops_and_short_ones_in_registers_are_right(name, size):
    program, matrix = chain(size)  # 10 and 24 states
    rng = np.random.default_rng(0)
    x0, times = rng.normal(size=(9, 2 * size)), np.linspace(0, 2, 5)
    exact = np.stack([x0 @ expm(matrix * t).T for t in times], 1)
    solver = Solver(program, name)
    found = solver.solve(x0, times, u=[0.0], **accuracy(solver))
    assert np.abs(found.states - exact).max() < 1e-7
    alone = solver.solve(x0[3], times, u=[0.0], **accuracy(solver))
    assert np.abs(alone.states[0] - found.states[3]).max() < 1e-12


@pytest.mark.parametrize("name", rest_slow(METHODS, {"rk4"}))
def test_lanes_threads_and_company_change_no_bit(name):
    def build(s):
        return [s["w"], s["f"] * (s["t"] * 3).apply("cos") - s["k"] * s["q"].apply("sin")]

    program = problem(build, x="qw", u="f", p={"k": 9.81})
    rng = np.random.default_rng(1)
    x0, u, p = rng.normal(size=(203, 2)) * 3, rng.normal(size=(203, 1)), rng.uniform(1, 20, (203, 1))
    times = np.linspace(0, 2, 9)
    x0[17] = [1e9, 0.0]  # beyond the reach of the quick sine
    for parameters in (None, p):
        reference = None
        for lanes, threads in ((8, 1), (16, 2), (4, 1), (2, 2)):
            solver = Solver(program, name, lanes=lanes, threads=threads)
            found = solver.solve(x0, times, u=u, p=parameters, **accuracy(solver))
            reference = reference or found
            assert found.states.tobytes() == reference.states.tobytes()
            assert found.evaluations.tobytes() == reference.evaluations.tobytes()
        order = rng.permutation(203)
        mixed = solver.solve(
            x0[order], times, u=u[order], p=None if parameters is None else p[order], **accuracy(solver)
        )  # fmt: skip
        assert mixed.states.tobytes() == reference.states[order].tobytes()
        for k in (5, 100):
            alone = solver.solve(x0[k], times, u=u[k], p=None if parameters is None else p[k], **accuracy(solver))
            assert np.abs(alone.states[0] - reference.states[k]).max() < 1e-12


@pytest.mark.parametrize("name", METHODS)
def test_only_final_states_are_the_same_states(name):
    solver = Solver(kepler(), name)
    x0 = np.stack([start(e) for e in np.linspace(0, 0.5, 20)])
    full = solver.solve(x0, [0.0, 5.0], **accuracy(solver))
    less = solver.solve(x0, [0.0, 5.0], store=False, **accuracy(solver))
    assert less.states.shape == (20, 0, 4) and less.times.shape == (0,)
    assert less.final.tobytes() == full.final.tobytes() == np.ascontiguousarray(full.states[:, -1]).tobytes()


def test_requested_times_do_not_move_the_steps_of_an_adaptive_method():
    for name in ADAPTIVE:
        solver = Solver(kepler(), name)
        few, many = (solver.solve(start(0.3), np.linspace(0, 7, n)) for n in (2, 301))
        assert few.final.tobytes() == many.final.tobytes()
        assert few.steps[0] == many.steps[0]
        assert np.array_equal(many.states[0, -1], many.final[0])


def test_a_fixed_step_meets_every_requested_time():
    for name in ("rk4", "gauss4"):
        solver = Solver(problem(lambda s: [1.0 + 0 * s["x"], s["x"]], x=("x", "y")), name)
        times = np.array([0.0, 0.1, 0.25, 1.0, 1.7])
        found = solver.solve([0.0, 0.0], times, step=0.04)
        assert np.allclose(found.states[0, :, 0], times, rtol=0, atol=1e-15)
        assert np.allclose(found.states[0, :, 1], times**2 / 2, rtol=0, atol=1e-15)
        assert found.steps[0] == 3 + 4 + 19 + 18


def test_the_symplectic_method_keeps_invariants_where_rk4_drifts():
    x0, period = start(0.4), 2 * np.pi

    def energy(x):
        return (x[..., 2] ** 2 + x[..., 3] ** 2) / 2 - 1 / np.hypot(x[..., 0], x[..., 1])

    def momentum(x):
        return x[..., 0] * x[..., 3] - x[..., 1] * x[..., 2]

    drift = {}
    for name in ("gauss4", "rk4"):
        found = Solver(kepler(), name).solve(x0, np.arange(400 * 60 + 1) * period / 60, step=period)
        states = found.states[0]
        assert found.status[0] == 0
        drift[name] = np.abs(energy(states) - energy(states[0]))
        if name == "gauss4":
            assert np.abs(momentum(states) - momentum(states[0])).max() < 1e-14
    half = 200 * 60
    assert drift["gauss4"][half:].max() < 1.01 * drift["gauss4"][:half].max()
    assert drift["rk4"][-1] > 1.9 * drift["rk4"][half] > 3 * drift["gauss4"].max()


def test_compensated_sums_lose_nothing_over_a_million_steps():
    solver = Solver(problem(lambda s: [s["v"], -s["q"]], x="qv"), "gauss4")
    found = solver.solve([1.0, 0.0], [0.0, 5000.0], step=0.005, store=False)
    assert found.steps[0] == 1_000_000
    assert abs(np.hypot(*found.final[0]) - 1) < 1e-14  # uncompensated: some 1e-13


def test_every_status_has_words():
    assert set(RunStatus) == {*range(1, -15, -1), -127, -128}
    assert len({status.message for status in RunStatus}) == len(RunStatus)
    for name, method in METHODS.items():
        assert method.name == name and method.title and method.source
