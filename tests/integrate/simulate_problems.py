"""Programs for the tests of integrators, made by hand."""

from functools import cache

import mpmath
import numpy as np

from lagrangian.graph import Graph, Output, Program, Scalar
from lagrangian.integrate import Events


def _named(x, u, p):
    graph = Graph()
    groups = {"x": tuple(x), "u": tuple(u), "p": tuple(p), "t": ("t",)}
    named = {n: Scalar(graph, graph.input(g, k)) for g, names in groups.items() for k, n in enumerate(names)}
    return graph, groups, named


def problem(build, *, x, u=(), p=None):
    """``build(scalars by name) → derivatives`` as a Program; ``p`` maps parameters to defaults."""
    p = p or {}
    graph, groups, named = _named(x, u, p)
    ids = tuple(value.id if isinstance(value, Scalar) else graph.const(value) for value in build(named))
    return Program("test", graph, groups, {"xdot": Output(ids, (len(ids),))}, p)


def events(g, after=None, *, x, u=(), p=None, direction, terminal=None, reset=None):
    """Events from functions of the scalars by name: a list of g, and a list of states after each."""
    p = p or {}
    graph, groups, named = _named(x, u, p)
    values = [value.id for value in g(named)]
    outputs = {"g": Output(tuple(values), (len(values),))}
    if after is not None:
        rows = after(named)
        ids = [v.id if isinstance(v, Scalar) else graph.const(v) for row in rows for v in row]
        outputs["after"] = Output(tuple(ids), (len(rows), len(rows[0])))
    n = len(values)
    return Events(
        Program("events", graph, groups, outputs, p), direction, terminal or (False,) * n, reset or (False,) * n
    )


def kepler():
    """Two bodies, GM = 1: from (1 − e, 0) with speed √((1 + e)/(1 − e)) the period is 2π."""

    def build(s):
        r2 = s["x"] * s["x"] + s["y"] * s["y"]
        cube = r2 * r2.apply("sqrt")
        return [s["vx"], s["vy"], -(s["x"] / cube), -(s["y"] / cube)]

    return problem(build, x=("x", "y", "vx", "vy"))


def start(e):
    return np.array([1 - e, 0.0, 0.0, np.sqrt((1 + e) / (1 - e))])


def arenstorf():
    """Earth, moon, satellite: Hairer, Nørsett, Wanner I, section II.0, with initial values and period."""
    mu = 0.012277471
    one = 1 - mu

    def build(s):
        a, b = s["x"] + mu, s["x"] - one
        y2 = s["y"] * s["y"]
        d1, d2 = a * a + y2, b * b + y2
        d1, d2 = d1 * d1.apply("sqrt"), d2 * d2.apply("sqrt")
        return [
            s["vx"],
            s["vy"],
            s["x"] + 2 * s["vy"] - one * a / d1 - mu * b / d2,
            s["y"] - 2 * s["vx"] - one * s["y"] / d1 - mu * s["y"] / d2,
        ]

    x0 = np.array([0.994, 0.0, 0.0, -2.00158510637908252240537862224])
    return problem(build, x=("x", "y", "vx", "vy")), x0, 17.0652165601579625588917206249


def double_pendulum():
    """Unit masses and lengths, absolute angles, g = 9.81."""

    def build(s):
        a, b, va, vb = (s[n] for n in ("a", "b", "va", "vb"))
        sine, cosine = (a - b).apply("sin"), (a - b).apply("cos")
        h1 = -(sine * vb * vb) - 2 * s["g"] * a.apply("sin")
        h2 = sine * va * va - s["g"] * b.apply("sin")
        det = 2 - cosine * cosine
        return [va, vb, (h1 - cosine * h2) / det, (2 * h2 - cosine * h1) / det]

    return problem(build, x=("a", "b", "va", "vb"), p={"g": 9.81})


@cache
def double_pendulum_by_mpmath(x0, t):
    """The same motion by mpmath's Taylor method with 20 digits."""
    with mpmath.workdps(20):
        g = mpmath.mpf(9.81)

        def rates(_, x):
            a, b, va, vb = x
            sine, cosine = mpmath.sin(a - b), mpmath.cos(a - b)
            h1 = -sine * vb**2 - 2 * g * mpmath.sin(a)
            h2 = sine * va**2 - g * mpmath.sin(b)
            det = 2 - cosine**2
            return [va, vb, (h1 - cosine * h2) / det, (2 * h2 - cosine * h1) / det]

        found = mpmath.odefun(rates, 0, [mpmath.mpf(v) for v in x0], tol=mpmath.mpf(10) ** -15)(t)
        return np.array([float(v) for v in found])


def chain(n=10):
    """n unit masses between unit springs, pushed at the first: a linear system, and its matrix."""
    names = [f"q{i}" for i in range(n)] + [f"v{i}" for i in range(n)]

    def build(s):
        q, v = ([s[f"{c}{i}"] for i in range(n)] for c in "qv")
        pull = [(q[i - 1] if i else s["f"]) - 2 * q[i] + (q[i + 1] if i < n - 1 else 0 * q[i]) for i in range(n)]
        return [*v, *pull]

    matrix = np.zeros((2 * n, 2 * n))
    matrix[:n, n:] = np.eye(n)
    matrix[n:, :n] = np.eye(n, k=1) + np.eye(n, k=-1) - 2 * np.eye(n)
    return problem(build, x=names, u=("f",)), matrix


def ball(restitution=0.8):
    """A bouncing ball, its event, and the times of its bounces from height 1 at rest."""
    p = {"g": 9.81, "e": restitution}
    motion = problem(lambda s: [s["v"], -s["g"]], x="yv", p=p)
    bounce = events(
        lambda s: [s["y"]], lambda s: [[0.0, -s["e"] * s["v"]]], x="yv", p=p, direction=(-1,), reset=(True,)
    )
    first = np.sqrt(2 / 9.81)
    flights = 2 * first * restitution ** np.arange(1, 200)
    return motion, bounce, np.concatenate([[first], first + np.cumsum(flights)])


def accuracy(solver, step=0.01, tolerance=1e-10):
    """Arguments for a solver of either kind."""
    return {"rtol": tolerance, "atol": tolerance} if solver.method.adaptive else {"step": step}
