"""Derivatives of the dynamics against difference quotients of 50 digits, against Pinocchio, and way against way."""

import pathlib

import mpmath as mp
import numpy as np
import pytest
from floating_trees import pinocchio_model, states, system

import built_in
import lagrangian as lg
from built_in import FREE, SOME
from lagrangian import codegen, dynamics
from lagrangian.dynamics.derivatives import candidates, directions_of
from lagrangian.graph import Output, Program, Tangents, count_program, evaluate
from size import rest_slow

BENCH = pathlib.Path(__file__).parent.parent.parent / "bench"
WIDTH = mp.mpf(10) ** -17  # of a quotient with 50 digits: its error is about 1e-33


def close(got, wanted, most):
    a, b = np.asarray(got, float), np.asarray(wanted, float)
    assert a.shape == b.shape
    assert not a.size or np.abs(a - b).max() <= most * (1 + np.abs(b).max())


def state(model, seed):
    """Random values of every group as mpmath numbers; masses and lengths positive."""
    rng = np.random.default_rng(seed)
    sizes = {"q": model.coordinates, "v": model.velocities, "u": model.inputs, "p": model.parameters}
    return {k: [mp.mpf(x) for x in rng.uniform(0.5, 1.5, len(entries))] for k, entries in sizes.items()} | {"t": [0.3]}


def quotient(program, output, x, group, k):
    """(f(x + h e_k) − f(x − h e_k)) / 2h in 50 digits."""
    with mp.workdps(50):
        ends = [{**x, group: [y + h * (i == k) for i, y in enumerate(x[group])]} for h in (WIDTH, -WIDTH)]
        after, before = (evaluate(program, end, digits=50)[output] for end in ends)
        return [(a - b) / (2 * WIDTH) for a, b in zip(after, before, strict=True)]


TIED = ("four-bar", "rolling-disc", "chaplygin-sleigh", "wheel-on-incline")


@pytest.mark.parametrize("name", rest_slow((*FREE, *TIED), {*SOME} & {*FREE, *TIED}))
def test_against_quotients_of_fifty_digits(name):
    model = built_in.system(name).model
    wrt = ("q", "v", "u", *(p.name for p in model.parameters))
    forward, x = dynamics.forward(model), state(model, 3)
    found = evaluate(dynamics.derivatives(model, wrt), x, digits=50)
    close(found["a"], evaluate(forward, x, digits=50)["a"], 1e-30)
    for group in "qvup":
        for k in range(len(x[group])):
            close([row[k] for row in found[f"a_{group}"]], quotient(forward, "a", x, group, k), 1e-20)


@pytest.mark.parametrize("name", ["cart-pole", "spherical-pendulum"])
def test_inverse_dynamics_against_quotients(name):
    model = built_in.system(name).model
    inverse, x = dynamics.inverse(model), state(model, 4)
    x["a"] = x["v"][::-1]
    found = evaluate(dynamics.inverse_derivatives(model, ("q", "v", "u", model.parameters[0].name)), x, digits=50)
    close(found["r"], evaluate(inverse, x, digits=50)["r"], 1e-30)
    for group, output in (("q", "r_q"), ("v", "r_v"), ("a", "M"), *([("u", "r_u")] if model.inputs else [])):
        for k in range(len(x[group])):
            close([row[k] for row in found[output]], quotient(inverse, "r", x, group, k), 1e-20)
    close([row[0] for row in found["r_p"]], quotient(inverse, "r", x, "p", 0), 1e-20)


def held_against_pinocchio(pin, reference, model, q, v, u):
    data = reference.createData()
    kernel = codegen.compile(dynamics.derivatives(model), optional={"t": 0.0}, threads=1)
    found = kernel(q, v, u)
    for k in range(len(q)):
        by_q, by_v, Minv = pin.computeABADerivatives(reference, data, q[k], v[k], u[k])
        Minv = np.triu(Minv) + np.triu(Minv, 1).T
        wanted = {"a": data.ddq, "a_q": by_q, "a_v": by_v, "a_u": Minv, "Minv": Minv}
        for name, value in wanted.items():
            close(found[name][k], value, 1e-12)
    count = count_program(kernel.program).operations
    inverse = codegen.compile(dynamics.inverse_derivatives(model), optional={"t": 0.0}, threads=1)
    r = inverse(q[:2], v[:2], v[:2], u[:2])
    for k in range(2):
        by_q, by_v, M = pin.computeRNEADerivatives(reference, data, q[k], v[k], v[k])
        M = np.triu(M) + np.triu(M, 1).T
        for name, value in {"r": data.tau - u[k], "r_q": by_q, "r_v": by_v, "M": M}.items():
            close(r[name][k], value, 1e-12)
    return count


@pytest.mark.slow
@pytest.mark.parametrize(("name", "most"), [("arm", 7653), ("quadruped", 24572)])
def test_robots_against_pinocchio_and_their_operations(name, most, monkeypatch):
    pin = pytest.importorskip("pinocchio")
    monkeypatch.syspath_prepend(BENCH)
    import engine_peers
    import engine_systems

    tree = getattr(engine_systems, f"{name}_tree")()
    model = engine_systems.described(tree).model
    assert held_against_pinocchio(pin, engine_peers.Pinocchio(tree).model, model, *tree.states(12)) <= most


@pytest.mark.parametrize("parents", rest_slow(([-1, 0], [-1, 0, 1, -1, 3, 4]), ([-1, 0],)))
def test_floating_trees_against_pinocchio(parents):
    pin = pytest.importorskip("pinocchio")
    s = system(parents, 3)
    held_against_pinocchio(pin, pinocchio_model(pin, parents, 3), s.model, *states(s, 8, 5))


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", ["double-pendulum", "robot-arm", "floating"])
def test_all_ways_agree(name):
    """Columns, rows, the tape, the mass matrix, products and solutions: the same numbers."""
    model = (system([-1], 3) if name == "floating" else built_in.system(name)).model
    graph, m, directions = directions_of(model, ("q", "v", "u"))
    width = len(directions.columns)
    ways = list(candidates(m, directions))
    assert len(ways) >= 4
    outputs = {
        str(k): Output(tuple(x for row in S for x in row), (len(m.v), width)) for k, (_, _, S) in enumerate(ways)
    }
    inputs = dynamics.derivatives(model).inputs
    found = list(evaluate(Program("ways", graph, inputs, outputs), state(model, 5)).values())
    for other in found[1:]:
        close(other, found[0], 1e-11)


@pytest.mark.parametrize("name", ["double-pendulum", "furuta-pendulum", "robot-arm"])
def test_the_slope_in_the_forces_is_the_inverse_of_the_mass_matrix(name):
    model = built_in.system(name).model
    x = state(model, 6)
    Minv, M = (evaluate(f(model), x)[k] for f, k in ((dynamics.derivatives, "Minv"), (dynamics.mass_matrix, "M")))
    close(np.array(Minv, float) @ np.array(M, float), np.eye(len(model.velocities)), 1e-11)


@pytest.mark.slow
def test_accelerations_must_be_inputs_while_they_are_held():
    """If r is built with the nodes of a, the graph simplifies with them, and what is held constant is bypassed."""
    model = system([-1, 0, 1], 3).model
    graph, m, directions = directions_of(model, ("q", "v"))
    a = m.forward()
    r = m.inverse(a)
    still = dict.fromkeys(a, graph.zero)
    naive = [Tangents(graph, {**still, **column})(r) for column in directions.columns]
    n = len(m.v)
    right = dynamics.inverse_derivatives(model, ("q", "v"))
    x = state(model, 7)
    outputs = {"D": Output(tuple(x for column in naive for x in column), (2 * n, n))}
    wrong = np.array(evaluate(Program("naive", graph, right.inputs, outputs), {**x, "a": x["v"]})["D"], float).T
    forward = evaluate(dynamics.forward(model), x)["a"]
    found = evaluate(right, {**x, "a": forward})
    D = np.hstack([np.array(found[k], float) for k in ("r_q", "r_v")])
    assert np.abs(wrong - D).max() > 1e-3 * np.abs(D).max()
    slopes = evaluate(dynamics.derivatives(model, ("q", "v")), x)
    by_a = np.hstack([np.array(slopes[k], float) for k in ("a_q", "a_v")])
    close(np.array(found["M"], float) @ by_a, -D, 1e-10)


def test_what_cannot_be_differentiated_is_refused():
    model = built_in.system("cart-pole").model
    with pytest.raises(lg.ModelError, match="nothing called 'mass'"):
        dynamics.derivatives(model, ("q", "mass"))
    with pytest.raises(lg.ModelError, match="'q' is given twice"):
        dynamics.inverse_derivatives(model, ("q", "q"))
    sled = lg.System("sled")
    x, y = sled.coordinates("x y")
    sled.particle(2, at=sled.origin + (x, y))
    sled.constraint(y, name="floor")
    sled.friction(0.3, pressed_by="floor", deflection=x)
    for program in (dynamics.derivatives, dynamics.inverse_derivatives):
        with pytest.raises(lg.ModelError, match="sticks or slips"):
            program(sled.model)


@pytest.mark.parametrize(("name", "most"), [("double-pendulum", 105), ("cart-pole", 71)])
def test_small_systems_take_few_operations(name, most):
    program = dynamics.derivatives(built_in.system(name).model, ("q", "v"))
    assert count_program(program).operations <= most
