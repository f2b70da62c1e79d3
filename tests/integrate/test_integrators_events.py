"""Events: found to the last bits of time, in the right order, reset, terminal, accumulating."""

import numpy as np
import pytest
from simulate_problems import accuracy, ball, events, problem

from lagrangian.errors import RunError
from lagrangian.integrate import METHODS, Solver


def turning():
    return problem(lambda s: [s["v"], -s["q"]], x="qv")


def solved(program, name, watched, x0, times, *, lanes=None, **more):
    solver = Solver(program, name, events=watched, lanes=lanes)
    return solver.solve(x0, times, **accuracy(solver, tolerance=1e-12), **more)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", METHODS)
def test_a_bouncing_ball_bounces_when_it_should(name):
    motion, bounce, exact = ball()
    found = solved(motion, name, bounce, np.tile([1.0, 0.0], (11, 1)), np.linspace(0, 3, 31))
    assert np.all(found.status == 0) and np.all(found.event_count == 6)
    assert np.abs(found.event_time - exact[:6]).max() < 2e-12
    assert np.all(found.event_index == 0)
    assert np.abs(found.event_state[:, :, 0]).max() < 1e-12
    alone = solved(motion, name, bounce, [1.0, 0.0], np.linspace(0, 3, 31))
    assert np.abs(alone.event_time[0] - found.event_time[4]).max() < 1e-13
    # between the bounces it flies, and never below the ground
    times = found.times[:, None]
    last = np.concatenate([[-exact[0]], exact])[np.searchsorted(exact, times.ravel(), side="right")]
    speed = np.where(last > 0, 9.81 * exact[0] * 0.8 ** np.searchsorted(exact, times.ravel(), side="right"), 0)
    since = times.ravel() - np.where(last > 0, last, 0)
    height = np.where(last > 0, 0, 1) + speed * since - 9.81 / 2 * since**2
    assert np.abs(found.states[2, :, 0] - height).max() < 1e-11


@pytest.mark.parametrize("name", METHODS)
def test_bounces_that_accumulate_end_the_run(name):
    motion, bounce, exact = ball()
    found = solved(motion, name, bounce, [1.0, 0.0], [0.0, 5.0, 6.0])
    assert found.status[0] == -4
    assert abs(found.reached[0] - exact[-1]) < 1e-11
    assert np.isnan(found.states[0, 1:]).all()
    few = solved(motion, name, bounce, [1.0, 0.0], [0.0, 5.0], max_events=3)
    assert few.status[0] == -4 and few.event_count[0] == 3
    assert abs(few.reached[0] - exact[2]) < 1e-11


@pytest.mark.sampled(7)
@pytest.mark.parametrize("name", METHODS)
@pytest.mark.parametrize("ground", [0.0, 5.0])
@pytest.mark.parametrize("restitution", [0.1, 0.5, 0.9])
def test_no_ball_falls_through_the_ground(name, ground, restitution):
    motion = problem(lambda s: [s["v"], -9.81 + 0 * s["y"]], x="yv")
    bounce = events(
        lambda s: [s["y"] - ground],
        lambda s: [[s["y"], -restitution * s["v"]]],  # what is below the ground by rounding stays there
        x="yv",
        direction=(-1,),
        reset=(True,),
    )
    found = solved(motion, name, bounce, [[ground + 1, 0.0], [ground + 0.3, 1.0]], [0.0, 10.0])
    assert found.status.tolist() == [-4, -4]
    assert np.abs(found.final[:, 0] - ground).max() < 1e-10


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", METHODS)
@pytest.mark.parametrize(("direction", "exact"), [(1, [1.5, 3.5, 5.5]), (-1, [0.5, 2.5, 4.5]), (0, np.arange(6) + 0.5)])
def test_only_crossings_in_the_direction_count(name, direction, exact):
    watched = events(lambda s: [s["q"]], x="qv", direction=(direction,))
    found = solved(turning(), name, watched, [1.0, 0.0], [0.0, 6 * np.pi - 0.1])
    close = 1e-9 if name in ("tsit5", "dop853", "taylor") else 1e-6
    assert np.abs(found.event_time[0] - np.array(exact) * np.pi).max() < close
    assert np.abs(found.event_state[0, :, 0]).max() < 1e-12  # on the polynomial, to rounding


@pytest.mark.parametrize("name", METHODS)
def test_a_terminal_event_ends_the_run(name):
    watched = events(lambda s: [s["q"], s["q"] - 0.5], x="qv", direction=(0, -1), terminal=(True, False))
    found = solved(turning(), name, watched, [[1.0, 0.0]] * 3 + [[0.2, 0.0]], np.linspace(0, 4, 9))
    assert np.all(found.status == 1)
    assert np.abs(found.reached - np.pi / 2).max() < 1e-7
    assert np.abs(found.final[:, 0]).max() < 1e-12
    assert found.event_index[0].tolist() == [1, 0] and found.event_index[3].tolist() == [0, -1]
    assert np.abs(found.event_time[0] - [np.pi / 3, np.pi / 2]).max() < 1e-7
    assert np.isnan(found.event_time[3, 1])
    assert np.isfinite(found.states[:, :4]).all() and np.isnan(found.states[:, 4:]).all()


@pytest.mark.parametrize("name", METHODS)
def test_an_event_at_the_start_is_no_event(name):
    watched = events(lambda s: [s["q"]], x="qv", direction=(0,))
    found = solved(turning(), name, watched, [[0.0, 1.0], [0.0, -1.0]], [0.0, 4.0])
    assert found.event_count.tolist() == [1, 1]
    assert np.abs(found.event_time[:, 0] - np.pi).max() < 1e-7


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", METHODS)
def test_two_walls_of_a_corner_are_both_met(name):
    motion = problem(lambda s: [s["vx"], s["vy"], 0 * s["x"], 0 * s["x"]], x=("x", "y", "vx", "vy"))
    walls = events(
        lambda s: [1 - s["x"], 1 - s["y"]],
        lambda s: [[s["x"], s["y"], -s["vx"], s["vy"]], [s["x"], s["y"], s["vx"], -s["vy"]]],
        x=("x", "y", "vx", "vy"),
        direction=(-1, -1),
        reset=(True, True),
    )
    found = solved(motion, name, walls, [0.0, 0.0, 1.0, 1.0], [0.0, 1.9])
    assert found.status[0] == 0
    assert np.abs(found.final[0] - [0.1, 0.1, -1, -1]).max() < 1e-12
    assert np.abs(found.event_time[0] - 1).max() < 1e-12
    assert found.event_index[0].tolist() == [0, 1]


@pytest.mark.parametrize("name", ["tsit5", "dop853", "taylor"])
def test_two_crossings_in_one_step_are_found(name):
    # a parabola is exact for every method: one step would jump over both crossings
    motion = problem(lambda s: [s["v"], -1.0 + 0 * s["y"]], x="yv")
    watched = events(lambda s: [s["y"] - 0.3], x="yv", direction=(0,))
    found = solved(motion, name, watched, [0.0, 1.0], [0.0, 1.9])
    exact = 1 + np.array([-1, 1]) * np.sqrt(1 - 0.6)
    assert found.event_count[0] == 2
    assert np.abs(found.event_time[0] - exact).max() < 1e-12


def test_many_events_are_all_kept_whatever_the_lanes_and_threads():
    watched = events(lambda s: [s["q"], s["v"]], x="qv", direction=(0, 0))
    x0 = np.random.default_rng(0).normal(size=(300, 2))
    reference = None
    for lanes, threads in ((8, 1), (4, 2), (2, 1)):
        solver = Solver(turning(), "tsit5", events=watched, lanes=lanes, threads=threads)
        found = solver.solve(x0, [0.0, 20.0])
        reference = reference or found
        for name in ("event_time", "event_state", "event_index", "final"):
            assert getattr(found, name).tobytes() == getattr(reference, name).tobytes()
    angle = np.arctan2(-x0[:, 1], x0[:, 0])  # q = r cos(t + angle)
    for k in (0, 150, 299):
        quarter = np.arange(np.ceil(angle[k] / (np.pi / 2)), np.floor((20 + angle[k]) / (np.pi / 2)) + 1)
        assert np.abs(reference.event_time[k, : len(quarter)] - (quarter * np.pi / 2 - angle[k])).max() < 1e-6
        assert reference.event_count[k] == len(quarter)


def test_parameters_of_each_run_reach_events_and_resets():
    motion, bounce, _ = ball()
    restitution = np.array([[9.81, 0.5], [9.81, 0.9], [9.81, 1.0]])
    found = Solver(motion, events=bounce).solve([1.0, 0.0], [0.0, 1.0], p=restitution)
    fall = np.sqrt(2 / 9.81)
    speed = 9.81 * fall * restitution[:, 1] - 9.81 * (1 - fall)
    two = found.event_count == 2
    assert np.abs(found.final[~two, 1] - speed[~two]).max() < 1e-9
    assert two.tolist() == [True, False, False]


def test_events_that_do_not_fit_are_refused():
    motion = turning()
    with pytest.raises(RunError, match="directions"):
        Solver(motion, events=events(lambda s: [s["q"]], x="qv", direction=(0, 1)))
    with pytest.raises(RunError, match="direction of an event"):
        Solver(motion, events=events(lambda s: [s["q"]], x="qv", direction=(2,)))
    with pytest.raises(RunError, match="after"):
        Solver(motion, events=events(lambda s: [s["q"]], x="qv", direction=(0,), reset=(True,)))
    with pytest.raises(RunError, match="group 'x'"):
        Solver(motion, events=events(lambda s: [s["q"]], x="vq", direction=(0,)))
    root = events(lambda s: [s["q"].apply("log")], x="qv", direction=(0,))
    assert Solver(motion, events=root).solve([1.0, 0.0], [0.0, 4.0]).status[0] == -10


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", METHODS)
@pytest.mark.parametrize("direction", [-1, 0, 1])
def test_a_reset_that_lets_the_motion_through_is_done_once_a_crossing(name, direction):
    push = events(
        lambda s: [s["q"]], lambda s: [[s["q"], s["v"] * 1.1]], x="qv", direction=(direction,), reset=(True,)
    )  # fmt: skip
    found = solved(turning(), name, push, [1.0, 0.0], [0.0, 20.0])
    exact = (np.arange(6) + 0.5) * np.pi
    exact = exact if direction == 0 else exact[direction > 0 :: 2]
    assert found.status[0] == 0 and found.event_count[0] == len(exact)
    assert np.abs(found.event_time[0] - exact).max() < 1e-8
