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


def van_der_pol():
    return problem(lambda s: [s["v"], s["mu"] * (1 - s["q"] * s["q"]) * s["v"] - s["q"]], x="qv", p={"mu": 1.0})


def run(solver, x0, times, h, **more):
    """With steps of length h: fixed, or adaptive with tolerances that never shorten them."""
    if solver.method.adaptive:
        return solver.solve(x0, times, rtol=1e3, atol=1e3, max_step=h, **more)
    return solver.solve(x0, times, step=h, **more)


@pytest.mark.parametrize("name", METHODS)
def test_the_order_of_convergence_is_the_methods(name):
    solver = Solver(van_der_pol(), name, keep=False)
    exact = Solver(van_der_pol(), "rk4", keep=False).solve([2.0, 0.0], [0.0, 1.0], step=2e-4).final[0]
    assert solver.solve([2.0, 0.0], [0.0, 1.0], **({} if solver.method.adaptive else {"step": 0.1})).status[0] == 0
    lengths = 0.05 / 2 ** np.arange(4)
    errors = [np.linalg.norm(run(solver, [2.0, 0.0], [0.0, 1.0], h).final[0] - exact) for h in lengths]
    slopes = np.diff(np.log(errors)) / np.diff(np.log(lengths))
    assert abs(slopes[-1] - solver.method.order) < 0.1
