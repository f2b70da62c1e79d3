"""What a solver is handed: inputs as functions of time, and what does not fit."""

import math
import os
import signal
from itertools import count
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.linalg import expm
from simulate_problems import accuracy, chain, double_pendulum, kepler, problem, start

from lagrangian.codegen import workers
from lagrangian.errors import RunError
from lagrangian.integrate import METHODS, Signals, Solver
from lagrangian.integrate import solver as solver_module


def pushed():
    return problem(lambda s: [s["v"], s["f"] - s["k"] * s["q"] - 0 * s["g"]], x="qv", u="fg", p={"k": 4.0})


def answer(pieces, end):
    """q, v of q'' = f − 4q from rest, f piecewise linear: exactly, as the linear system of (q, v, f, f')."""
    matrix = np.array([[0, 1, 0, 0], [-4, 0, 1, 0], [0, 0, 0, 1], [0, 0, 0, 0.0]])
    state = np.zeros(2)
    for k, (begin, value, slope) in enumerate(pieces):
        until = min(end, pieces[k + 1][0]) if k + 1 < len(pieces) else end
        if until > max(begin, 0):
            value += slope * (max(begin, 0) - begin)
            state = (expm(matrix * (until - max(begin, 0))) @ [*state, value, slope])[:2]
    return state


PIECES = [(-1.0, 1.0, 0.5), (0.3, -2.0, 0.0), (0.7, 3.0, -4.0), (1.5, 0.0, 0.0)]
SIGNALS = Signals(
    np.array([p[0] for p in PIECES]), np.array([[p[1], 7.0] for p in PIECES]), np.array([[p[2], 1.0] for p in PIECES])
)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", METHODS)
def test_inputs_that_jump_and_bend_keep_the_accuracy(name):
    solver = Solver(pushed(), name)
    times = np.array([0.0, 0.2, 0.3, 1.0, 1.5, 2.2])
    found = solver.solve(np.zeros((5, 2)), times, u=SIGNALS, **accuracy(solver, step=0.02, tolerance=1e-11))
    exact = np.array([answer(PIECES, t) for t in times])
    assert np.abs(found.states - exact).max() < (1e-9 if solver.method.adaptive else 1e-6)
    alone = solver.solve([0.0, 0.0], times, u=SIGNALS, **accuracy(solver, step=0.02, tolerance=1e-11))
    assert np.abs(alone.states[0] - found.states[2]).max() < 1e-13


@pytest.mark.parametrize("name", ["rk4", "gauss4"])
def test_the_order_is_kept_over_jumps(name):
    solver = Solver(pushed(), name)
    exact = answer(PIECES, 2.2)
    errors = [np.abs(solver.solve([0.0, 0.0], [0, 2.2], u=SIGNALS, step=h).final[0] - exact).max() for h in (0.1, 0.05)]
    assert abs(np.log2(errors[0] / errors[1]) - 4) < 0.35


def test_signals_serve_long_vectors_too():
    program, matrix = chain(12)
    x0 = np.zeros(24)
    found = Solver(program, "dop853").solve(
        x0, [0.0, 1.0, 2.0], u=Signals(np.array([0.0, 1.0]), np.array([[1.0], [0.0]]), np.zeros((2, 1))), rtol=1e-11
    )
    force = np.zeros(24)
    force[12] = 1.0
    exact = np.linalg.solve(matrix, (expm(matrix) - np.eye(24)) @ force)
    assert np.abs(found.states[0, 1] - exact).max() < 1e-9
    assert np.abs(found.states[0, 2] - expm(matrix) @ exact).max() < 1e-9


@pytest.mark.parametrize(
    ("signals", "message"),
    [
        (Signals(np.array([0.0, 0.0]), np.zeros((2, 2)), np.zeros((2, 2))), "increase"),
        (Signals(np.array([0.0, 1.0]), np.zeros((2, 1)), np.zeros((2, 2))), "shape"),
        (Signals(np.array([0.5, 1.0]), np.zeros((2, 2)), np.zeros((2, 2))), "begin"),
        (Signals(np.array([0.0, 1.0]), np.full((2, 2), np.nan), np.zeros((2, 2))), "finite"),
    ],
)
def test_signals_that_do_not_fit_are_refused(signals, message):
    with pytest.raises(RunError, match=message):
        Solver(pushed()).solve([0.0, 0.0], [0.0, 1.0], u=signals)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"x0": [0.0]}, "1 values"),
        ({"x0": [0.0, np.nan]}, "'v' is nan"),
        ({"x0": np.zeros((2, 2, 2))}, "axes"),
        ({"x0": ["a", "b"]}, "real numbers"),
        ({"x0": np.zeros((3, 2)), "u": np.zeros((2, 2))}, "numbers of runs differ"),
        ({"times": [0.0]}, "at least two"),
        ({"times": [0.0, 1.0, 1.0]}, "increase"),
        ({"times": [0.0, math.inf]}, "requested time"),
        ({"rtol": 0.0}, "rtol"),
        ({"rtol": -1e-9}, "rtol"),
        ({"atol": 0.0}, "atol"),
        ({"atol": [1e-9] * 3}, "atol has shape"),
        ({"step": 0.1}, "chooses its step size itself"),
        ({"max_steps": 0}, "max_steps"),
        ({"max_step": 0.0}, "max_step"),
        ({"max_events": 1.5}, "max_events"),
        ({"deadline": -1.0}, "deadline"),
        ({"u": None}, "no value"),
        ({"u": [0.0]}, "1 values"),
        ({"p": [1.0, 2.0]}, "2 values"),
        ({"p": {"j": 1.0}}, "unknown parameter 'j'"),
        ({"p": [math.inf]}, "'k' is inf"),
    ],
)
def test_what_does_not_fit_is_said(arguments, message):
    given = {"x0": [0.0, 0.0], "times": [0.0, 1.0], "u": [0.0, 0.0], **arguments}
    with pytest.raises(RunError, match=message):
        Solver(pushed()).solve(given.pop("x0"), given.pop("times"), **given)


@pytest.mark.parametrize("step", [0.0, -0.1, math.nan, 1e-17])
def test_steps_that_lead_nowhere_are_refused(step):
    with pytest.raises(RunError, match="step"):
        Solver(pushed(), "rk4").solve([0.0, 0.0], [0.0, 1.0], u=[0.0, 0.0], step=step)
    with pytest.raises(RunError, match="needs a step"):
        Solver(pushed(), "rk4").solve([0.0, 0.0], [0.0, 1.0], u=[0.0, 0.0])


def test_solvers_that_cannot_be_are_refused():
    with pytest.raises(RunError, match="'dop853'"):
        Solver(pushed(), "dop835")
    with pytest.raises(RunError, match="lanes"):
        Solver(pushed(), lanes=3)
    with pytest.raises(RunError, match="threads"):
        Solver(pushed(), threads=0)
    with pytest.raises(RunError, match="smooth"):
        Solver(problem(lambda s: [s["x"].apply("abs")], x="x"), "taylor")
    with pytest.raises(RunError, match="too long"):
        Solver(chain(12)[0], "taylor")
    with pytest.raises(RunError, match="not a right-hand side"):
        Solver(problem(lambda s: [s["x"]], x=("x", "y")))


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", METHODS)
def test_a_motion_without_inputs_or_parameters_runs(name):
    solver = Solver(kepler(), name)
    assert solver.solve(start(0.1), [1.0, 2.0], **accuracy(solver)).status[0] == 0
    assert solver.solve(np.empty((0, 4)), [1.0, 2.0], **accuracy(solver)).states.shape == (0, 2, 4)


@pytest.mark.parametrize("name", METHODS)
def test_a_blow_up_ends_the_run_and_keeps_what_was_reached(name):
    solver = Solver(problem(lambda s: [s["x"] * s["x"]], x="x"), name)  # x = 1/(1 − t)
    found = solver.solve([[1.0], [0.1]], [0.0, 0.5, 2.0], **accuracy(solver))
    assert found.status[0] < 0 and found.status[1] == 0
    assert np.abs(found.states[0, 1] - 2).max() < 1e-6 and np.isnan(found.states[0, 2])
    if solver.method.adaptive:
        assert abs(found.reached[0] - 1) < 1e-6


@pytest.mark.parametrize("name", [n for n, m in METHODS.items() if m.adaptive and not m.expands])
def test_a_trial_step_out_of_the_domain_is_halved(name):
    # ẋ = −√x ends at 0 after t = 2, beyond which it is no number: the run stops there, and says so
    solver = Solver(problem(lambda s: [-s["x"].apply("sqrt")], x="x"), name)
    found = solver.solve([1.0], [0.0, 1.9, 3.0])
    assert abs(found.states[0, 1, 0] - (1 - 0.95) ** 2) < 1e-9
    assert found.status[0] == -2 and 1.99 < found.reached[0] <= 2.01


def test_limits_end_runs():
    solver = Solver(kepler(), "rk4")
    found = solver.solve(start(0.1), [0.0, 10.0], step=0.01, max_steps=100)
    assert found.status[0] == -3 and found.steps[0] == 100 and abs(found.reached[0] - 1) < 1e-12
    found = Solver(kepler(), "dop853").solve(start(0.1), [0.0, 1e6], max_steps=50)
    assert found.status[0] == -3 and found.steps[0] + found.rejected[0] == 50
    stiff = problem(lambda s: [-1e6 * s["x"]], x="x")
    found = Solver(stiff, "gauss4").solve([1.0], [0.0, 1.0], step=0.1)
    assert found.status[0] == -5


@pytest.mark.slow
def test_a_deadline_is_kept_and_what_was_reached_too(monkeypatch):
    x0 = np.stack([start(e) for e in np.linspace(0, 0.5, 40)])
    looks = count(1)
    monkeypatch.setattr(solver_module, "time", SimpleNamespace(monotonic=lambda: 0.01 * next(looks)))
    found = Solver(kepler(), "dop853", threads=2).solve(x0, [0.0, 1e9], deadline=0.05)
    ranges = 2 * workers.PARTS  # at most; a thread may come to a range when the time is over, and looks twice
    assert next(looks) <= 6 + 2 * ranges  # the clock is looked at again and again, and past 0.05 s each range ends
    assert np.all(found.status == -6)
    assert np.isfinite(found.final).all() and found.reached.max() > 100
    assert np.all(found.reached[found.steps == 0] == 0)


@pytest.fixture
def interruptible():
    """Interrupts as a terminal sends them, also where the tests run in the background, which has them ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("interruptible")
def test_an_interrupt_is_heard_while_a_run_goes_on(monkeypatch):
    """The machine code pauses often: a run of weeks ends at the pause after the signal."""
    solver = Solver(double_pendulum(), "dop853")
    pauses = count(1)

    def looked() -> float:
        if next(pauses) == 4:
            os.kill(os.getpid(), signal.SIGINT)
        return 0.0

    monkeypatch.setattr(solver_module, "time", SimpleNamespace(monotonic=looked))
    with pytest.raises(KeyboardInterrupt):
        solver.solve([1.0, 1.0, 0.0, 0.0], [0.0, 1e9], max_steps=10**12)
    assert next(pauses) < 1000


def test_a_solver_can_be_sent_to_another_process():
    import pickle

    solver = pickle.loads(pickle.dumps(Solver(kepler(), "tsit5", lanes=4, threads=1)))
    assert solver.method.name == "tsit5"
    assert solver.solve(start(0.1), [0.0, 1.0]).status[0] == 0
