"""Point masses on rods, solved for the tensions first: against dense matrices and the elimination of the tape."""

import random

import numpy as np
import pytest
import sympy as sp
from dynamics_models import chain, graph_chain, run, state

from lagrangian import System
from lagrangian.dynamics import programs
from lagrangian.dynamics.describe import describe
from lagrangian.dynamics.description import Inputs
from lagrangian.dynamics.tensions import turn_between
from lagrangian.graph import Graph, Output, Program, count_program


def by_tensions(model):
    """The program of v̇ by tensions, or None where the system is not one of point masses on rods."""
    graph = Graph()
    found = describe(model, graph, Inputs.of(graph, model)).tensions_first()
    forward = programs.forward(model)
    return found and Program("tensions", graph, forward.inputs, {"a": Output(tuple(found), (len(found),))})


def dense(model, at):
    """v̇ = −M⁻¹ h by NumPy."""
    M, h = run(programs.mass_matrix(model), at)["M"], run(programs.bias(model), at)["h"]
    return np.linalg.solve(M, -h)


def agrees(model, seeds=range(2)):
    """Whether the tensions give what the dense matrices give."""
    program = by_tensions(model)
    assert program is not None
    for seed in seeds:
        at = state(model, seed)
        expected = dense(model, at)
        assert run(program, at)["a"] == pytest.approx(expected, rel=1e-9, abs=1e-9 * max(abs(expected)))


def directions(q):
    """The unit vectors (±cos q, ±sin q) and (±sin q, ±cos q)."""
    c, s, signs = sp.cos(q), sp.sin(q), (1, -1)
    return [(i * a, k * b) for a, b in ((c, s), (s, c)) for i in signs for k in signs]


def rods(seed, *, cart=(), branches, relative):
    """Rods of unequal lengths with unequal masses; a random tree with ``branches``, on a mass that moves along
    ``cart``; springs, dampers, forces and inputs at random.
    """
    source = random.Random(seed)
    s = System("rods")
    base = s.origin
    if cart:
        base = s.origin + tuple(s.coordinate(axis) if axis in cart else 0 for axis in "xy")
        s.particle(s.parameter("M", 1.3), at=base)
    ends = [(base, None, 0)]
    for i in range(5):
        at, frame, above = ends[source.randrange(len(ends))] if branches else ends[-1]
        q, L = s.coordinate(f"q{i}"), s.parameter(f"L{i}", source.uniform(0.4, 1.4))
        if relative:
            frame = s.frame(q, parent=frame, origin=s.origin)
            at = frame.point(*source.choice([(0, -L), (L, 0), (L, sp.Rational(1, 3))]), at=at)
        else:
            at = at + tuple(L * x for x in source.choice(directions(q)))
        s.particle(s.parameter(f"m{i}", source.uniform(0.2, 3.0)), at=at)
        ends.append((at, frame, q))
        s.damper(s.parameter(f"b{i}", 0.2), deflection=q - (above if source.random() < 0.5 else 0))
    s.spring(s.parameter("k", 20.0), between=(ends[1][0], ends[4][0]), rest=0.3)
    s.damper(0.4, between=(s.origin + (2, 1), ends[3][0]))
    s.force((s.input("F"), 0.7), at=ends[5][0])
    s.torque(s.input("tau"), on=ends[2][2])
    s.gravity()
    return s.model


@pytest.mark.sampled(4)
@pytest.mark.parametrize("relative", [False, True])
@pytest.mark.parametrize("branches", [False, True])
@pytest.mark.parametrize("cart", ["", "x", "y", "xy"])
def test_chains_and_trees_with_all_that_acts_on_them_agree_with_dense_matrices(cart, branches, relative):
    agrees(rods(f"{cart}{branches}{relative}", cart=cart, branches=branches, relative=relative), seeds=range(1))


def test_angles_of_all_kinds_of_rods_may_be_subtracted():
    s = System("chain")
    at, order = s.origin, [(i + step * n) % 8 for step in (1, 3) for i in range(2) for n in range(4)]
    for i, k in enumerate(order):
        q = s.coordinate(f"q{i}")
        at = at + directions(q)[k]
        s.particle(0.5 + i % 3, at=at)
    s.gravity()
    agrees(s.model)
    assert count_program(by_tensions(s.model)).sincos == len(order)


@pytest.mark.parametrize("one", range(8))
@pytest.mark.parametrize("other", range(8))
def test_the_turn_from_one_direction_to_another(one, other):
    g = Graph()
    q = [g.input("q", i) for i in range(2)]
    ends = [directed(g, angle, k) for angle, k in zip(q, (one, other), strict=True)]
    names = {"q": ("a", "b")}
    c, s = turn_between(g, *ends)
    outputs = {name: Output(tuple(ids), (2,)) for name, ids in (("n", ends[0]), ("m", ends[1]), ("turn", (c, s)))}
    found = run(Program("turn", g, names, outputs), {"q": [0.4, 1.3]})
    n, m = found["n"], found["m"]
    assert found["turn"] == pytest.approx([n @ m, n[0] * m[1] - n[1] * m[0]], abs=1e-15)


def directed(g, angle, k):
    """The k-th of `directions` on the graph."""
    x, y = (g.cos(angle), g.sin(angle)) if k < 4 else (g.sin(angle), g.cos(angle))
    return [g.neg(x) if k & 2 else x, g.neg(y) if k & 1 else y]


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(12))
def test_random_trees_agree_with_dense_matrices(seed):
    source = random.Random(seed)
    agrees(rods(seed, cart=source.choice(["", "x", "y", "xy"]), branches=True, relative=source.random() < 0.5))


def test_masses_that_differ_by_a_million_keep_their_digits():
    model = chain(6, relative=False)
    at = state(model, 1)
    light = [p.name in ("m1", "m3", "m5") for p in model.parameters]
    at["p"] = [x * 1e-6 if is_light else x for x, is_light in zip(at["p"], light, strict=True)]
    exact = run(by_tensions(model), at)["a"]
    assert exact == pytest.approx(run(programs.forward(model), at)["a"], rel=1e-9)
    assert exact == pytest.approx(dense(model, at), rel=1e-5)


def inverted():
    """A rod whose pivot is moved up and down."""
    s = System("shaken")
    q = s.coordinate("q")
    s.particle(1.0, at=s.origin + (sp.sin(q), sp.cos(10 * s.t) - sp.cos(q)))
    return s


def rigid():
    """A link with an inertia of its own."""
    s = System("rigid")
    q = s.coordinate("q")
    body = s.frame(q)
    s.rigid_body(1.0, inertia=0.2, at=body.point(0, -1), frame=body)
    return s


def geared():
    """Two rods whose second turns with three times the first."""
    s = System("geared")
    q = s.coordinate("q")
    at = s.origin + (sp.sin(q), -sp.cos(q))
    s.particle(1.0, at=at)
    s.particle(1.0, at=at + (sp.sin(3 * q), -sp.cos(3 * q)))
    return s


def telescope():
    """A mass that slides along its rod."""
    s = System("telescope")
    q, r = s.coordinate("q"), s.coordinate("r")
    s.particle(1.0, at=s.origin + (r * sp.sin(q), -r * sp.cos(q)))
    return s


def diagonal():
    """A mass that one coordinate moves along x and y at once, with a rod."""
    s = System("diagonal")
    x, q = s.coordinate("x"), s.coordinate("q")
    cart = s.origin + (x, x)
    s.particle(1.0, at=cart)
    s.particle(1.0, at=cart + (sp.sin(q), -sp.cos(q)))
    return s


def umbrella():
    """Many rods on one mass, every two of which would be coupled."""
    s = System("umbrella")
    cart = s.origin + (s.coordinate("x"), 0)
    s.particle(1.0, at=cart)
    for i in range(9):
        q = s.coordinate(f"q{i}")
        s.particle(1.0, at=cart + (sp.sin(q), -sp.cos(q)))
    return s


@pytest.mark.parametrize("described", [inverted, rigid, geared, telescope, diagonal, umbrella])
def test_what_has_no_such_rods_is_left_to_the_tape(described):
    s = described()
    s.gravity()
    assert by_tensions(s.model) is None


@pytest.mark.parametrize(("relative", "limit"), [(False, 18), (True, 19)])
def test_operations_a_link(relative, limit):
    for n in (8, 64):
        count = count_program(graph_chain(n, relative=relative))
        assert count.sincos == n
        assert count.operations <= limit * n
