"""Projection: rows hold at every state that is handed out, by every method, and the motion is the right one."""

import pickle
from functools import cache

import numpy as np
import pytest
from constrained_problems import G, constrained, four_bar, rod, sleigh, sleigh_speeds
from scipy.special import ellipj, ellipk
from simulate_problems import events

from lagrangian.codegen import compile
from lagrangian.errors import RunError
from lagrangian.graph import Graph, Output, Program, jacobian
from lagrangian.integrate import METHODS, Projection, RunStatus, Signals, Solver
from lagrangian.integrate.method_names import SCIPY
from lagrangian.integrate.scipy_methods import Interval, integrate_scipy

STEP = {"rk4": 0.005, "gauss4": 0.005}
TOLERANCES = {"rtol": 1e-12, "atol": 1e-15}  # those of a step by default
MADE = {"rod": rod, "four-bar": four_bar, "sleigh": sleigh}


@cache
def problem_of(name):
    return MADE[name]()


@cache
def solver_of(name, method, how="projected"):
    made = problem_of(name)
    parts = made.projection.position, made.projection.velocity
    projection = {"projected": Projection(*parts), "measured": Projection(*parts, corrects=False), "free": None}[how]
    return Solver(made.program, method, projection=projection, keep=False)


def off(made, x):
    """The largest residual of positions and velocities."""
    x = x[np.isfinite(x).all(axis=-1)]
    return max(0.0 if rows is None else float(abs(rows(x)).max()) for rows in (made.rows, made.speeds))


def angle(t, start=2.0):
    """A pendulum of length 1 released at an angle: sin(θ/2) = k cd(√g t), k = sin(θ₀/2) (DLMF 22.19)."""
    k = np.sin(start / 2)
    _, cn, dn, _ = ellipj(np.sqrt(G) * t, k * k)
    return 2 * np.arcsin(k * cn / dn)


@pytest.mark.sampled(8)
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("name", MADE)
def test_rows_hold_for_100_seconds(name, method):
    made, times = problem_of(name), np.linspace(0, 100, 1001)
    run = solver_of(name, method).solve(made.start, times, step=STEP.get(method), **TOLERANCES)
    assert run.status[0] == RunStatus.REACHED and off(made, run.states[0]) < 1e-14
    assert run.drift.position_after[0] < 1e-14 and run.drift.velocity_after[0] < 1e-14
    energy = made.energy(run.states[0])
    assert np.ptp(energy) < (5e-10 if method not in STEP else 5e-6)


def test_without_projection_they_do_not():
    run = solver_of("rod", "rk4", "free").solve(problem_of("rod").start, [0.0, 100.0], step=0.005)
    assert off(problem_of("rod"), run.final) > 1e-4


@pytest.mark.sampled(4)
@pytest.mark.parametrize("method", METHODS)
def test_the_rod_swings_as_a_pendulum_does(method):
    times = np.linspace(0, 10, 101)
    run = solver_of("rod", method).solve(problem_of("rod").start, times, step=STEP.get(method), **TOLERANCES)
    theta = angle(times)
    exact = np.stack([np.sin(theta), -np.cos(theta)], axis=1)
    assert abs(run.states[0, :, :2] - exact).max() < (1e-10 if method not in STEP else 2e-6)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("method", ["dop853", "taylor", "rk4"])
def test_the_sleigh_comes_to_run_along_its_course(method):
    times = np.linspace(0, 8, 41)
    run = solver_of("sleigh", method).solve(problem_of("sleigh").start, times, step=STEP.get(method), **TOLERANCES)
    theta, speed = run.states[0, :, 2], run.states[0, :, 3:5]
    along = speed[:, 0] * np.cos(theta) + speed[:, 1] * np.sin(theta)
    v, omega = sleigh_speeds(times)
    assert abs(along - v).max() < 1e-9 and abs(run.states[0, :, 5] - omega).max() < 1e-9


def test_a_simple_period_is_met():
    period = 4 * ellipk(np.sin(1.0) ** 2) / np.sqrt(G)
    run = solver_of("rod", "dop853").solve(problem_of("rod").start, [0.0, period], **TOLERANCES)
    assert abs(run.final[0] - problem_of("rod").start).max() < 1e-11


@pytest.mark.parametrize("method", ["rk4", "gauss4"])
def test_fixed_steps_keep_their_order(method):
    times = np.linspace(0, 3, 16)
    exact, errors = np.sin(angle(times)), []
    for step in (0.02, 0.01, 0.005, 0.0025):
        run = solver_of("rod", method).solve(problem_of("rod").start, times, step=step)
        errors.append(abs(run.states[0, :, 0] - exact).max())
    assert (errors[0] / errors[-1]) ** (1 / 3) > 2**3.5


@pytest.mark.parametrize(("method", "order"), [("tsit5", 5), ("dop853", 8)])
def test_adaptive_steps_keep_their_order(method, order):
    exact, found = angle(20.0), []
    for rtol in (1e-6, 1e-11):
        run = solver_of("rod", method).solve(problem_of("rod").start, [0.0, 20.0], rtol=rtol, atol=rtol)
        error = abs(np.arctan2(run.final[0, 0], -run.final[0, 1]) - exact)
        found.append((np.log(error), np.log(run.steps[0])))
    (e0, n0), (e1, n1) = found
    assert (e0 - e1) / (n1 - n0) > order - 1


@pytest.mark.sampled(3)
@pytest.mark.parametrize("method", METHODS)
def test_measuring_changes_no_bit(method):
    times, start = np.linspace(0, 3, 31), problem_of("four-bar").start
    free = solver_of("four-bar", method, "free").solve(start, times, step=STEP.get(method))
    measured = solver_of("four-bar", method, "measured").solve(start, times, step=STEP.get(method))
    assert free.drift is None and np.array_equal(free.states, measured.states)
    assert np.array_equal(free.evaluations, measured.evaluations)
    drift = measured.drift
    assert drift.position_before[0] == drift.position_after[0] > 0
    if method in STEP:  # else samples lie inside steps
        assert drift.position_before[0] >= abs(problem_of("four-bar").rows(measured.states[0])).max() / 2 * (1 - 1e-12)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("method", [m for m in METHODS if m != "taylor"])  # which differs in the last bits anyway
def test_a_run_of_many_is_the_run_by_itself(method):
    made = problem_of("rod")
    theta = np.linspace(0.3, 2.5, 11)
    starts = np.stack([np.sin(theta), -np.cos(theta), 0 * theta, 0 * theta], axis=1)
    p = np.stack([np.linspace(1, 2, 11), np.ones(11)], axis=1)
    times, step = np.linspace(0, 5, 17), STEP.get(method)
    many = solver_of("rod", method).solve(starts, times, p=p, step=step)
    assert off(made, many.states) < 1e-14
    for k in (0, 4, 10):
        one = solver_of("rod", method).solve(starts[k], times, p=p[k], step=step)
        assert np.array_equal(one.states[0], many.states[k])
        assert one.drift.velocity_before[0] == many.drift.velocity_before[k]
        assert one.drift.margin_time[0] == many.drift.margin_time[k]


def test_own_parameters_are_those_of_the_rows():
    length = np.array([0.5, 1.0, 1.5, 2.0, 3.0])
    starts = np.stack([length, 0 * length, 0 * length, 0 * length], axis=1)
    p = np.stack([np.ones(5), length], axis=1)
    run = solver_of("rod", "dop853").solve(starts, np.linspace(0, 10, 11), p=p)
    assert abs(np.hypot(run.states[..., 0], run.states[..., 1]) - length[:, None]).max() < 1e-14


def test_programs_with_graphs_of_their_own_do_the_same():
    other = rod(separate=True)
    run = Solver(other.program, projection=other.projection, keep=False).solve(other.start, np.linspace(0, 5, 11))
    same = solver_of("rod", "dop853").solve(other.start, np.linspace(0, 5, 11))
    assert np.array_equal(run.states, same.states)


def test_a_solver_that_is_sent_elsewhere_projects_there():
    sent = pickle.loads(pickle.dumps(solver_of("rod", "rk4")))
    run = sent.solve(problem_of("rod").start, [0.0, 50.0], step=0.01)
    assert off(problem_of("rod"), run.final) < 1e-14 and run.drift.position_before[0] > 1e-12


def test_a_start_beside_the_rows_is_brought_to_them():
    start = np.array([1.001, 0.0, 0.3, 0.0])
    run = solver_of("rod", "dop853").solve(start, [0.0, 0.1, 0.2])
    assert np.array_equal(run.states[0, 0], start) and off(problem_of("rod"), run.states[0, 1:]) < 1e-14
    assert run.drift.start_position[0] == pytest.approx((1.001**2 - 1) / 2)
    assert run.drift.start_velocity[0] == pytest.approx(0.3)  # x = 1 then, and it moves along the rod
    assert run.drift.velocity_before[0] < 1e-9


def test_a_start_far_from_the_rows_takes_more_steps():
    run = solver_of("rod", "dop853").solve([2.0, 0.5, 0.0, 0.0], [0.0, 0.1, 0.2])
    assert off(problem_of("rod"), run.states[0, 1:]) < 1e-14 and run.drift.position_after[0] < 1e-14


def leaving():
    """ẋ = 1 along a row x = 0 that it does not keep."""
    g = Graph()
    x, groups = g.input("x", 0), {"x": ("x",), "u": (), "p": (), "t": ("t",)}
    size = Output((g.abs(x),), ())
    row = Program("row", g, groups, {"dx": Output((g.neg(x),), (1,)), "gap": size})
    return Program("leaving", g, groups, {"xdot": Output((g.one,), (1,))}), Projection(row, None)


@pytest.mark.parametrize("method", ["dop853", "tsit5", "taylor"])
def test_a_step_that_must_be_corrected_too_much_is_shortened(method):
    program, projection = leaving()
    run = Solver(program, method, projection=projection, keep=False).solve([0.0], [0.0, 1.0], rtol=1e-9, atol=1e-3)
    assert (run.rejected[0] > 0) == (method == "taylor") and run.steps[0] >= 1000 and abs(run.final[0, 0]) == 0
    assert run.drift.position_before[0] <= 1e-3


def test_rows_of_time_are_followed():
    """A bead on a circle whose radius grows as 1 + t/10."""
    made = constrained(
        ("x", "y"),
        lambda s: [1.0, 1.0],
        lambda q, v, s: [0 * q[0]] * 2,
        rows=lambda q, s: [q[0] * q[0] + q[1] * q[1] - (1 + s["t"] / 10) ** 2],
        start=[1.0, 0.0, 0.1, 1.0],
    )
    times = np.linspace(0, 10, 101)
    for method in ("dop853", "rk4", "taylor"):
        run = Solver(made.program, method, projection=made.projection, keep=False).solve(
            made.start, times, step=STEP.get(method)
        )
        x, y, vx, vy = run.states[0].T
        assert abs(np.hypot(x, y) - (1 + times / 10)).max() < 1e-14
        assert abs(x * vy - y * vx - 1).max() < 1e-8  # no torque about the centre


# Events and inputs -----------------------------------------------------------------------------------------------

NAMES = ("x", "y", "x'", "y'")


def bounces(whole=True, terminal=False):
    """The rod comes back from a wall at x = 0 with 0.8 of its speed; else of its horizontal speed alone."""
    return events(
        lambda s: [s["x"]],
        lambda s: [[s["x"], s["y"], -0.8 * s["x'"], -0.8 * s["y'"] if whole else -0.8 * s["y'"] + s["x'"]]],
        x=NAMES,
        p={"m": 2.0, "l": 1.0},
        direction=(-1,),
        terminal=(terminal,),
        reset=(True,),
    )


@pytest.mark.sampled(3)
@pytest.mark.parametrize("method", METHODS)
def test_events_find_and_leave_states_that_satisfy_the_rows(method):
    made = problem_of("rod")
    solver = Solver(made.program, method, events=bounces(), projection=made.projection, keep=False)
    run = solver.solve(made.start, np.linspace(0, 6, 601), step=STEP.get(method), **TOLERANCES)
    count = run.event_count[0]
    assert run.status[0] == RunStatus.REACHED and count >= 4
    states = run.event_state[0, :count]
    assert off(made, states) < 1e-14 and off(made, run.states[0]) < 1e-14
    assert abs(states[:, 0]).max() < 1e-14 and states[:, 0].min() >= 0
    speeds = np.hypot(states[:, 2], states[:, 3])
    fast = np.sqrt(2 * G * (1 - np.cos(2.0)))
    assert abs(speeds / (fast * 0.8 ** np.arange(count)) - 1).max() < (1e-9 if method not in STEP else 1e-5)
    assert run.drift.reset_velocity[0] < 1e-14


def test_a_reset_that_breaks_a_row_shows():
    made = problem_of("rod")
    solver = Solver(made.program, events=bounces(whole=False), projection=made.projection, keep=False)
    run = solver.solve(made.start, np.linspace(0, 1.2, 121))
    speed = np.sqrt(2 * G * (1 - np.cos(2.0)))
    assert run.event_count[0] == 1 and off(made, run.states[0]) < 1e-14
    assert run.drift.reset_velocity[0] == pytest.approx(speed, rel=1e-9) and run.drift.reset_position[0] < 1e-14
    assert run.drift.velocity_before[0] < 1e-6


def test_a_terminal_event_ends_on_the_rows():
    made = problem_of("rod")
    solver = Solver(made.program, events=bounces(terminal=True), projection=made.projection, keep=False)
    run = solver.solve(np.tile(made.start, (9, 1)), np.linspace(0, 6, 61))
    assert (run.status == RunStatus.TERMINAL).all() and off(made, run.final) < 1e-14


@pytest.mark.parametrize("method", ["dop853", "rk4"])
def test_inputs_that_jump_do_not_matter_to_the_rows(method):
    g = problem_of("rod").program.graph
    pushed = problem_of("rod")
    x, y = (g.input("x", k) for k in (0, 1))
    ids = list(pushed.program.ids)  # a torque u/m about the centre has no part along the rod
    r2 = g.add(g.mul(x, x), g.mul(y, y))
    push = g.div(g.input("u", 0), r2)
    ids[2], ids[3] = g.sub(ids[2], g.mul(push, y)), g.add(ids[3], g.mul(push, x))
    groups = {**pushed.program.inputs, "u": ("torque",)}
    program = Program("pushed", g, groups, {"xdot": Output(tuple(ids), (4,))}, pushed.program.defaults)
    solver = Solver(program, method, projection=pushed.projection, keep=False)
    u = Signals(np.array([0.0, 0.53, 1.71]), np.array([[0.0], [2.0], [-1.0]]), np.zeros((3, 1)))
    times = np.linspace(0, 3, 301)
    run = solver.solve(pushed.start, times, u=u, step=STEP.get(method), **TOLERANCES)
    assert off(pushed, run.states[0]) < 1e-14
    theta = np.unwrap(np.arctan2(run.states[0, :, 0], -run.states[0, :, 1]))
    before, after = (times <= 0.53), (times >= 1.71)
    work = np.where(before, 0.0, 0.0) + 0.0
    crossing = [np.interp(t, times, theta) for t in (0.53, 1.71)]
    work = 2.0 * (np.clip(theta, None, None) - crossing[0]) * (~before & ~after)
    work = work + after * (2.0 * (crossing[1] - crossing[0]) - (theta - crossing[1]))
    energy = pushed.energy(run.states[0]) - work
    assert np.ptp(energy) < 2e-3  # the angles at the knots are interpolated linearly


# SciPy -----------------------------------------------------------------------------------------------------------


def by_scipy(name, method, times, projection, **options):
    made = problem_of(name)
    g, n = made.program.graph, len(made.start)
    entries = jacobian(g, made.program.ids, [g.input("x", k) for k in range(n)])
    ids = tuple(entries.get((i, k), g.zero) for i in range(n) for k in range(n))
    slope = Program("jacobian", g, made.program.inputs, {"J": Output(ids, (n, n))}, made.program.defaults)
    p = np.array([made.program.defaults[name] for name in made.program.inputs["p"]], float)
    return integrate_scipy(
        method,
        compile(made.program),
        made.start,
        times,
        [Interval(float(times[-1]), lambda t, x: np.empty(0))],
        p,
        jacobian=compile(slope),
        projection=projection,
        **options,
    )


@pytest.mark.sampled(20)
@pytest.mark.parametrize("method", SCIPY)
@pytest.mark.parametrize("name", MADE)
def test_solvers_of_scipy_keep_the_rows(name, method):
    made, tolerance = problem_of(name), 1e-6 if method == "RK23" else 1e-8
    times = np.linspace(0, 3, 31)
    free = by_scipy(name, method, times, None, rtol=tolerance, atol=tolerance / 100)
    run = by_scipy(name, method, times, made.projection, rtol=tolerance, atol=tolerance / 100)
    assert run.status == RunStatus.REACHED and off(made, run.states) < 1e-14 and off(made, run.final[None]) < 1e-14
    assert 0 < run.drift.velocity_before[0] < 1e-4 and run.drift.velocity_after[0] < 1e-14
    assert run.steps < 1.3 * free.steps  # a history that was lost would cost many
    exact = solver_of(name, "dop853").solve(made.start, times, **TOLERANCES).states[0]
    assert abs(run.states - exact).max() < 3 * abs(free.states - exact).max() + tolerance


def test_scipy_shortens_a_step_that_must_be_corrected_too_much():
    program, projection = leaving()
    for method in ("DOP853", "BDF", "LSODA"):
        legs = [Interval(0.1, lambda t, x: np.empty(0))]
        run = integrate_scipy(
            method,
            compile(program),
            np.zeros(1),
            np.array([0.0, 0.1]),
            legs,
            np.empty(0),
            atol=1e-3,
            projection=projection,
        )
        assert run.status == RunStatus.REACHED and run.rejected > 0 and run.steps >= 100


@pytest.mark.parametrize(
    ("outputs", "inputs"),
    [
        ({"dx": (3,), "gap": ()}, {"x": NAMES}),
        ({"dx": (4,)}, {"x": NAMES}),
        ({"dx": (4,), "gap": (1,)}, {"x": NAMES}),
        ({"dx": (4,), "gap": ()}, {"x": ("a", "b", "c", "d")}),
    ],
)
def test_a_projection_that_does_not_fit_is_refused(outputs, inputs):
    g = Graph()
    made = {n: Output((g.zero,) * int(np.prod(shape)), shape) for n, shape in outputs.items()}
    with pytest.raises(RunError) as caught:
        Solver(problem_of("rod").program, projection=Projection(Program("rows", g, inputs, made), None))
    assert caught.value.code == "E501"
    with pytest.raises(RunError, match="needs a program"):
        Solver(problem_of("rod").program, projection=Projection(None, None))
