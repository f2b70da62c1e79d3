"""No crossing is lost: random conditions along motions that are known exactly, against dense samples of these."""

from __future__ import annotations

import numpy as np
import pytest
from simulate_problems import accuracy, chain, events, problem

from lagrangian.integrate import METHODS, Signals, Solver
from size import rest_slow

FAST = np.sqrt(2.0)
END = 12.0
SHALLOW = 1e-6
"""Excursions beyond zero by less than this are left to rounding and to the methods' own errors."""

STATES = ("q", "v", "r", "w")


def motion():
    """Two oscillators, of frequencies 1 and √2."""
    return problem(lambda s: [s["v"], -s["q"], s["w"], -2.0 * s["r"]], x=STATES)


def exact(x0: np.ndarray, t: np.ndarray) -> dict[str, np.ndarray]:
    q, v, r, w = x0
    c, s, C, S = np.cos(t), np.sin(t), np.cos(FAST * t), np.sin(FAST * t)
    return {"q": q * c + v * s, "v": v * c - q * s, "r": r * C + w / FAST * S, "w": w * C - FAST * r * S, "t": t}


def condition(rng: np.random.Generator):
    """A random smooth function, for the scalars of a graph and for arrays alike; ``f`` applies a function by name."""
    a = rng.normal(size=8)
    frequency, narrow, at = rng.uniform(5, 40), rng.uniform(20, 200), rng.uniform(2, END - 2)
    kind = rng.integers(6)

    def g(s, f):
        wave = f("sin", frequency * s["t"] + a[0])
        if kind == 0:
            return wave + 0.3 * a[1]
        if kind == 1:
            return a[1] * s["q"] + a[2] * s["v"] * s["r"] + a[3] * s["w"] + 0.3 * wave
        if kind == 2:
            return f("tanh", 3.0 * (s["q"] - s["r"])) + a[1] * s["v"] * s["v"] * 0.3 - 0.2
        if kind == 3:
            z = narrow * (s["t"] - at)
            return f("exp", -(z * z)) * 3.0 + a[1] * s["q"] * 0.4 - 0.5
        if kind == 4:
            return s["q"] / (s["r"] * s["r"] + 0.2) + f("atan", 5.0 * s["w"]) - a[1] * 0.5
        return f("sqrt", s["q"] * s["q"] + s["v"] * s["v"] + 0.1 * wave + 1.0) - 1.45 + 0.2 * f("cos", 7.0 * s["w"])

    return g


def crossings(y: np.ndarray, t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Times and directions of the sign changes in samples, of those that lead beyond zero by more than `SHALLOW`."""
    clear = np.flatnonzero(np.abs(y) > SHALLOW)
    sign = np.sign(y[clear])
    k = np.flatnonzero(np.diff(sign))
    return (t[clear[k]] + t[clear[k + 1]]) / 2, sign[k + 1].astype(int)


def in_numpy(function: str, x: np.ndarray) -> np.ndarray:
    return getattr(np, {"atan": "arctan"}.get(function, function))(x)


@pytest.mark.thinned(4)
@pytest.mark.sampled(3)
@pytest.mark.parametrize("seed", [0, *[pytest.param(k, marks=pytest.mark.slow) for k in range(1, 9)]])
@pytest.mark.parametrize("name", rest_slow(METHODS, {"taylor"}))
def test_every_crossing_of_random_conditions_is_found(name: str, seed: int) -> None:
    rng = np.random.default_rng([seed, list(METHODS).index(name)])
    conditions = [condition(rng) for _ in range(8)]
    directions = tuple(int(d) for d in rng.integers(-1, 2, 8))
    watched = events(
        lambda s: [g(s, lambda function, x: x.apply(function)) for g in conditions], x=STATES, direction=directions
    )
    x0 = rng.normal(size=(9, 4))
    t = np.linspace(0, END, 200_001)
    solver = Solver(motion(), name, events=watched)
    given = {"rtol": 1e-9, "atol": 1e-9} if solver.method.adaptive else {"step": 0.01}
    found = solver.solve(x0, [0.0, END], max_events=10_000, store=False, **given)
    assert np.all(found.status == 0)
    alone = solver.solve(x0[3], [0.0, END], max_events=10_000, store=False, **given)
    assert alone.event_count[0] == found.event_count[3]
    count = 0
    for run, start in enumerate(x0):
        states = exact(start, t)
        for k, g in enumerate(conditions):
            y = g(states, in_numpy)
            when, which = crossings(y, t)
            when = when[(which == directions[k]) | (directions[k] == 0)]
            mine = found.event_time[run][found.event_index[run] == k]
            near = np.abs(mine[:, None] - when).min(axis=0, initial=1.0)
            assert near.max(initial=0.0) < 1e-2, (run, k, when[near > 1e-2])
            assert np.abs(g(exact(start, mine), in_numpy)).max(initial=0.0) < 1e-5
            touches = np.abs(y[np.searchsorted(t, mine)]) < 10 * SHALLOW
            assert 0 <= len(mine) - len(when) <= touches.sum(), (run, k)
            count += len(when)
    assert count > 100


@pytest.mark.parametrize("name", ["dop853", "gauss4"])
@pytest.mark.slow
def test_states_too_long_for_registers_lose_none_either(name: str) -> None:
    program, matrix = chain(10)
    watched = events(
        lambda s: [s["q3"] * s["q5"] - 0.02, (20 * s["t"]).apply("cos") * s["v2"]],
        x=program.inputs["x"], u=("f",), direction=(0, 0),
    )  # fmt: skip
    x0 = np.random.default_rng(1).normal(size=(9, 20))
    solver = Solver(program, name, events=watched)
    found = solver.solve(x0, [0.0, 5.0], u=[0.0], **accuracy(solver, step=0.01))
    rates, modes = np.linalg.eig(matrix)
    t = np.linspace(0, 5, 100_001)
    growth = np.exp(np.outer(rates, t))
    for run, start in enumerate(x0):
        x = ((modes * np.linalg.solve(modes, start)) @ growth).real
        for k, y in enumerate((x[3] * x[5] - 0.02, np.cos(20 * t) * x[12])):
            assert (found.event_index[run] == k).sum() == (np.diff(np.sign(y)) != 0).sum()


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", METHODS)
def test_a_condition_on_a_table_is_followed_along_its_slopes(name: str) -> None:
    """sin 40u: u rises to 2 in 1 s (25 zeros after the start), falls to −1 in 2 s (38) and stays there."""
    swing = problem(lambda s: [s["v"], -s["q"] + 0 * s["f"]], x="qv", u=("f",))
    wave = events(lambda s: [(40 * s["f"]).apply("sin") + 0 * s["q"]], x="qv", u=("f",), direction=(0,))
    table = Signals(np.array([0.0, 1, 3]), np.array([[0.0], [2], [-1]]), np.array([[2.0], [-1.5], [0]]))
    solver = Solver(swing, name, events=wave)
    for x0 in ([1.0, 0.0], [[1.0, 0.0]] * 9):
        found = solver.solve(x0, [0.0, 4.0], u=table, **accuracy(solver, step=0.3, tolerance=1e-8))
        assert np.all(found.event_count == 63)
