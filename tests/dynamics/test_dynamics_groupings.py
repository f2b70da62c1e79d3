"""Every way of gathering bodies into links, and every way of eliminating, gives the same equations."""

import itertools

import numpy as np
import pytest
import sympy as sp
from dynamics_models import run

from lagrangian.dynamics import Inputs, describe
from lagrangian.graph import Graph, Output, Program
from lagrangian.model import Builder, Gravity, Particle, RigidBody, Spring


def swings(signs, swapped):
    """Two point masses whose steps are ±L cos, ±L sin or ±L sin, ±L cos."""
    b = Builder("swings")
    a, c = b.coordinate("a").symbol, b.coordinate("c").symbol
    L = b.parameter("L", 0.7).symbol
    f, h = (sp.sin, sp.cos) if swapped else (sp.cos, sp.sin)
    P = b.point("P", (signs[0] * L * f(a), signs[1] * L * h(a)))
    Q = b.point("Q", (signs[1] * f(a + c), signs[0] * h(a + c)), parent=P)
    b.add(Particle(mass=2, at=P))
    b.add(Particle(mass=3, at=Q))
    b.add(Gravity(direction=(0, -1), g=9.81))
    return b.model()


def rods_on_a_cart():
    b = Builder("rods on a cart")
    x, a, c = (b.coordinate(n).symbol for n in ["x", "a", "c"])
    cart = b.point("cart", (x, 0))
    first = b.frame("first", a, origin=cart)
    joint = first.point(0.1, -0.9)
    second = b.frame("second", c, parent=first, origin=joint)
    third = b.frame("third", x * c, origin=joint)
    b.add(Particle(mass=1, at=cart))
    b.add(RigidBody(mass=2, inertia=0.3, at=first.point(0, -0.4), frame=first))
    b.add(RigidBody(mass=1.5, inertia=0.2, at=second.point(0.3, -0.2), frame=second))
    b.add(RigidBody(mass=0.5, inertia=0.1, at=joint, frame=third))
    b.add(Particle(mass=0.4, at=second.point(0, -0.7)))
    b.add(Particle(mass=0.3, at=joint))
    b.add(Gravity(direction=(0, -1), g=9.81))
    b.add(Spring(k=3, deflection=a))
    return b.model()


CASES = [
    *((lambda s=s, w=w: swings(s, w)) for s, w in itertools.product(itertools.product((1, -1), repeat=2), (0, 1))),
    rods_on_a_cart,
]


@pytest.mark.parametrize("build", CASES)
def test_all_groupings_and_eliminations_agree_with_the_route_from_the_lagrangian(build):
    model = build()
    g, n = Graph(), len(model.coordinates)
    m = describe(model, g, Inputs.of(g, model))
    a = [g.input("a", i) for i in range(n)]
    outputs = {"lagrangian": m.inverse_from_lagrangian(a)}
    solutions = {}
    for k, links in enumerate(m.groupings):
        outputs[f"inverse {k}"] = m.gathered(m.missing(m.accelerations(a), links))
        solutions[f"dense {k}"] = m.by_mass_matrix(links, free=k % 2 == 0)
        for free, exchange in itertools.product((True, False), repeat=2):
            solutions[f"forward {k} {free} {exchange}"] = m.along_tape(links, free=free, exchange=exchange)
    names = {key: tuple(f"{key}{i}" for i in range(n)) for key in "qva"}
    names |= {"p": tuple(p.name for p in model.parameters), "t": ("t",)}
    both = {**outputs, **solutions}
    program = Program("all", g, names, {key: Output(tuple(ids), (n,)) for key, ids in both.items()})
    rng = np.random.default_rng(4)
    at = {key: list(rng.uniform(-1, 1, n)) for key in "qva"} | {"p": [p.value for p in model.parameters], "t": [0.0]}
    found = run(program, at)
    for key in outputs:
        assert found[key] == pytest.approx(found["lagrangian"], rel=1e-12, abs=1e-12)
    for key in solutions:
        there = run(program, {**at, "a": list(found[key])})["lagrangian"]
        assert np.abs(there).max() < 1e-11 * (1 + np.abs(found[key]).max())


def test_equal_angles_about_crossed_axes_share_nodes_without_harm():
    """ω has the same node in two components: couplings of a node with itself count twice."""
    b = Builder("diagonal")
    q, r = b.coordinate("q").symbol, b.coordinate("r").symbol
    frame = b.frame("F", q, axis=(1, 1, 0))
    other = b.frame("G", r, axis=(0, 1, 1), parent=frame)
    inertia = [[2, sp.Rational(1, 5), 0], [sp.Rational(1, 5), 3, sp.Rational(1, 3)], [0, sp.Rational(1, 3), 4]]
    b.add(RigidBody(mass=1, inertia=inertia, at=other.point(0.1, 0.2, 0.3), frame=other))
    b.add(RigidBody(mass=1, inertia=inertia, at=b.origin, frame=frame))
    model = b.model()
    g = Graph()
    m = describe(model, g, Inputs.of(g, model))
    a = [g.input("a", i) for i in range(2)]
    names = {"q": ("q", "r"), "v": ("q'", "r'"), "a": ("a", "b"), "t": ("t",)}
    outputs = {"one": m.inverse(a), "two": m.inverse_from_lagrangian(a), "solution": m.forward()}
    program = Program("t", g, names, {key: Output(tuple(ids), (2,)) for key, ids in outputs.items()})
    at = {"q": [0.3, -0.8], "v": [0.7, 0.9], "a": [1.1, -0.4], "t": [0.0]}
    found = run(program, at)
    assert found["one"] == pytest.approx(found["two"], rel=1e-12)
    assert np.abs(run(program, {**at, "a": list(found["solution"])})["two"]).max() < 1e-12
