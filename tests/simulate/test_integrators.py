"""Integrators in machine code: orders of convergence, reference problems, lanes and threads."""

import numpy as np
import pytest

from lagrangian.graph import Graph, Output, Program, Scalar
from lagrangian.simulate import METHODS, Solver


def problem(build, *, x, u=(), p=None, t=True):
    """``build(scalars by name) → derivatives`` as a Program; ``p`` maps parameters to defaults."""
    p = p or {}
    graph = Graph()
    groups = {"x": tuple(x), "u": tuple(u), "p": tuple(p), **({"t": ("t",)} if t else {})}
    named = {n: Scalar(graph, graph.input(g, k)) for g, names in groups.items() for k, n in enumerate(names)}
    ids = tuple(value.id for value in build(named))
    return Program("test", graph, groups, {"xdot": Output(ids, (len(ids),))}, p)


def kepler():
    """Two bodies, GM = 1: from (1 − e, 0) with speed √((1 + e)/(1 − e)) the period is 2π."""

    def build(s):
        r2 = s["x"] * s["x"] + s["y"] * s["y"]
        cube = r2 * r2.apply("sqrt")
        return [s["vx"], s["vy"], -(s["x"] / cube), -(s["y"] / cube)]

    return problem(build, x=("x", "y", "vx", "vy"))


def start(e):
    return np.array([1 - e, 0.0, 0.0, np.sqrt((1 + e) / (1 - e))])


def run(solver, x0, times, h, **more):
    """With steps of length h: fixed, or adaptive with tolerances that never shorten them."""
    if solver.method.adaptive:
        return solver.solve(x0, times, rtol=1e6, atol=1e6, max_step=h, **more)
    return solver.solve(x0, times, step=h, **more)


COUNTS = {"rk4": (800, 1600), "tsit5": (400, 800), "dop853": (60, 120), "gauss4": (100, 200)}
"""Steps in a period: enough for the leading term of the error, few enough to stay above rounding."""


@pytest.mark.parametrize("name", [n for n in METHODS if n in COUNTS])
def test_the_order_of_convergence_is_the_methods(name):
    solver = Solver(kepler(), name, keep=False)
    x0 = start(0.2)
    errors = [np.linalg.norm(run(solver, x0, [0, 2 * np.pi], 2 * np.pi / n).final[0] - x0) for n in COUNTS[name]]
    slope = np.log(errors[0] / errors[1]) / np.log(2)
    assert abs(slope - solver.method.order) < 0.1
