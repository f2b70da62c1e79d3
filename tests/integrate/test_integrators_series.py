"""The rules for Taylor series: every operation against quadrature in many digits."""

import mpmath
import numpy as np
import pytest
from simulate_problems import problem

from lagrangian.integrate import Solver

RULES = {
    "sin cos": lambda t, f: f("sin", t * t + 1) * f("cos", 2 * t),
    "tan": lambda t, f: f("tan", t * t / 2),
    "exp": lambda t, f: f("exp", f("sin", 3 * t)),
    "log": lambda t, f: f("log", 1 + t * t),
    "sqrt": lambda t, f: f("sqrt", 1 + t + t * t),
    "sinh": lambda t, f: f("sinh", t * t - t),
    "cosh": lambda t, f: f("cosh", 2 * t) / (3 + t),
    "tanh": lambda t, f: f("tanh", 2 * t - 1),
    "asin": lambda t, f: f("asin", t * t / 2),
    "acos": lambda t, f: f("acos", f("sin", t) / 2),
    "atan": lambda t, f: f("atan", 2 * t - t * t),
    "asinh": lambda t, f: f("asinh", 3 * t),
    "acosh": lambda t, f: f("acosh", 2 + t * t),
    "atanh": lambda t, f: f("atanh", t / 2),
    "atan2": lambda t, f: f("atan2", t - 2, 1 + t * t),
    "atan2 behind": lambda t, f: f("atan2", f("sin", t) - 1, -1 - t),
    "power": lambda t, f: f("pow", 1 + t, f("cos", t)),
    "constant power": lambda t, f: f("pow", 1 + t * t, mpmath.mpf(5) / 4),
    "reciprocal": lambda t, f: 1 / (1 + t * t * t),
    "quotient": lambda t, f: f("sin", t) / (2 + f("cos", t)),
    "whole power": lambda t, f: (t - 2) ** 5 / 7 - (1 + t) ** -3,
    "high power": lambda t, f: f("cos", t) ** 81,
    "flat at first": lambda t, f: f("sin", t) ** 40,
    "products": lambda t, f: 2 - t * (1 + t) * f("sin", t) + 3 * t * t - (t - 1) * (t - 1),
}


def printed(s, rule):
    def call(name, *arguments):
        if name in ("atan2", "pow"):
            graph, (a, b) = arguments[0].graph, arguments
            b = b.id if hasattr(b, "id") else graph.const(float(b))
            return type(a)(graph, getattr(graph, {"atan2": "atan2", "pow": "pow"}[name])(a.id, b))
        return arguments[0].apply(name)

    return rule(s["t"], call)


def computed(t, rule):
    names = {"pow": mpmath.power}
    return rule(t, lambda name, *arguments: names.get(name, getattr(mpmath, name, None))(*arguments))


@pytest.mark.sampled(12)
@pytest.mark.parametrize("name", RULES)
def test_the_series_of_every_operation_is_right(name):
    rule = RULES[name]
    solver = Solver(problem(lambda s: [printed(s, rule)], x="x"), "taylor")
    times = np.array([0.0, 0.35, 1.0])
    exact = [float(mpmath.quad(lambda t: computed(t, rule), [0, t / 2, t])) for t in times]
    scale = 1 + np.abs(exact).max()
    for x0 in ([0.0], np.zeros((3, 1))):
        found = solver.solve(x0, times, rtol=1e-13, atol=1e-13)
        assert found.status[0] == 0 and found.steps[0] < 60
        assert np.abs(found.states[..., 0] - exact).max() < 2e-13 * scale


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9, 1e-12, 1e-15])
def test_the_error_follows_the_tolerance(tolerance):
    solver = Solver(problem(lambda s: [s["v"], -s["q"].apply("sin")], x="qv"), "taylor")
    fine = Solver(problem(lambda s: [s["v"], -s["q"].apply("sin")], x="qv"), "dop853")
    exact = fine.solve([2.0, 0.0], [0.0, 10.0], rtol=1e-14, atol=1e-14).final
    found = solver.solve([2.0, 0.0], [0.0, 10.0], rtol=tolerance, atol=tolerance).final
    assert np.abs(found - exact).max() < 30 * tolerance + 2e-13
