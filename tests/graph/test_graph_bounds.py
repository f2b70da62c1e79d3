"""Bounds along a stretch hold at every place sampled on it, and tighten as it gets shorter."""

from __future__ import annotations

import numpy as np
import pytest

from lagrangian.codegen import compile as compiled
from lagrangian.graph import Graph, Output, Program, Scalar, bounds

SMOOTH = ("sin", "cos", "tan", "exp", "atan", "sinh", "cosh", "tanh", "asinh")
HALF = ("log", "sqrt", "acosh")
INNER = ("asin", "acos", "atanh")
KINKED = ("abs", "sign")


def grown(rng: np.random.Generator, leaves: list[Scalar], depth: int) -> Scalar:
    """A random expression that is finite for states of the size of 1."""
    if depth == 0 or rng.random() < 0.1:
        return leaves[rng.integers(len(leaves))]
    a = grown(rng, leaves, depth - 1)
    kind = rng.integers(12)
    if kind < 5:
        b = grown(rng, leaves, depth - 1)
        return [a + b, a - b, a * b, a / (b * b + 0.5), a.apply("min", b)][kind]
    if kind == 5:
        return a.apply(str(rng.choice(SMOOTH[3:] if depth > 2 else SMOOTH)))
    if kind == 6:
        return (a * a + 1.1).apply(str(rng.choice(HALF)))
    if kind == 7:
        return (a.apply("sin") * 0.9).apply(str(rng.choice(INNER)))
    if kind == 8:
        return a.apply(str(rng.choice(KINKED)))
    if kind == 9:
        return (a.apply("tanh") - 1.5) ** int(rng.choice([-3, 3, 4])) if depth > 2 else (a * a + 0.3) ** 1.7
    if kind == 10:
        return a.apply("atan2", grown(rng, leaves, depth - 1))
    b = grown(rng, leaves, depth - 1)
    g = a.graph
    return Scalar(g, g.select(g.and_(g.lt(a.id, b.id), g.not_(g.eq(a.id, b.id))), a.id, (b * 2).id))


def watched(rng: np.random.Generator, count: int) -> Program:
    """Random functions of two states, a parameter and time."""
    g = Graph()
    leaves = [Scalar(g, g.input(group, k)) for group, k in (("x", 0), ("x", 1), ("t", 0), ("p", 0))]
    leaves.append(Scalar(g, g.const(0.7)))
    made = tuple(grown(rng, leaves, 4).id for _ in range(count))
    names = {"x": ("a", "b"), "p": ("c",), "t": ("t",)}
    return Program("g", g, names, {"g": Output(made, (count,))}, {"c": 0.3})


@pytest.mark.parametrize("count", [20, pytest.param(300, marks=pytest.mark.slow)])
def test_no_zero_and_no_turn_where_the_bounds_say_so(count: int) -> None:
    """Random functions along random cubics have no zero, and no turn, on a stretch that was cleared of them."""
    rng = np.random.default_rng(5)
    guard = watched(rng, count)
    value, judge = compiled(guard, keep=False), compiled(bounds(guard), keep=False)
    cleared = steadied = 0
    for _ in range(8):
        c = rng.normal(size=(4, 2)) / np.array([1, 1, 2, 6])[:, None]
        t0, pace = rng.normal(), rng.uniform(0.1, 2)
        lengths = 2.0 ** -np.arange(1, 12, 2)
        stretches = np.stack([np.full(len(lengths), pace), lengths], axis=1)
        bends = 2 * np.abs(c[2]) + 6 * np.abs(c[3]) * lengths[:, None]
        same = np.tile(c[:2], (len(lengths), 1, 1))
        found = judge(x=same[:, 0], rate=same[:, 1], bend=bends, t=np.full(6, t0), stretch=stretches)
        for r, clear, steady in zip(lengths, found["clear"] > 0, found["steady"] > 0, strict=True):
            s = np.linspace(-r, r, 101)
            x = c[0] + s[:, None] * (c[1] + s[:, None] * (c[2] + s[:, None] * c[3]))
            y = value(x=x, t=t0 + pace * s)
            cleared, steadied = cleared + clear.sum(), steadied + steady.sum()
            # the same sign all along: a branch that is the constant 0 crosses nothing, any other has no zero
            assert np.all(np.sign(y) == np.sign(y[0]), axis=0)[clear].all()
            assert (np.all(y == 0, axis=0) | np.all(y, axis=0))[clear].all()
            noise = 1e-13 * (1 + np.abs(y).max(axis=0))
            falls, rises = np.all(np.diff(y, axis=0) < noise, axis=0), np.all(np.diff(y, axis=0) > -noise, axis=0)
            assert (falls | rises)[steady].all()
    assert cleared > 8 * count / 2 and steadied > 8 * count / 2


@pytest.mark.sampled(6)
@pytest.mark.parametrize("name", SMOOTH + HALF + INNER)
def test_bounds_of_every_function_are_nearly_met_on_short_stretches(name: str) -> None:
    """A zero 1e-4 from the centre is known not to be nearer than 0.99e-4, and nothing is said beyond 1.01e-4."""
    g = Graph()
    x = Scalar(g, g.input("x", 0))
    at, near = (2.1 if name in HALF else 0.5), 1e-4
    zero = x.apply(name) - Scalar(g, g.const(at + near)).apply(name)
    judge = compiled(bounds(Program("g", g, {"x": ("a",)}, {"g": Output((zero.id,), (1,))})), keep=False)
    ball = np.array([0.99, 1.01]) * near
    found = judge(x=[[at]] * 2, rate=[[1.0]] * 2, bend=[[0.0]] * 2, t=[0.0] * 2, stretch=[[1.0, r] for r in ball])
    assert found["clear"][:, 0].tolist() == [1, 0] and found["steady"][:, 0].tolist() == [1, 1]
