"""Spatial chains and floating trees of rigid bodies, against Newton–Euler and against Pinocchio."""

import numpy as np
import pytest
from dynamics_models import X, Y, Z, arm, newton_euler, random_links, run, state

from lagrangian.dynamics import Bodies, Mechanics, Motion, programs
from lagrangian.dynamics.floating import floating_body, floating_rates
from lagrangian.graph import Graph, Output, Program, count_operations, count_program

SEVEN = [(Z, Y), (Y, Z), (Y, X), (X, Z), (Z, Y), (Y, X), (X, Z)]


@pytest.mark.sampled(3)
@pytest.mark.parametrize("seed", range(5))
def test_random_chains_against_newton_and_euler(seed):
    links = random_links(5, seed)
    model = arm(links)
    at = state(model, seed)
    at["a"] = state(model, seed + 9)["v"]
    expected = newton_euler(links, at["q"], at["v"], at["a"])
    size = np.abs(expected).max()
    assert np.abs(run(programs.inverse(model), at)["r"] - expected).max() < 1e-13 * size
    assert np.abs(run(programs.inverse_from_lagrangian(model), at)["r"] - expected).max() < 1e-12 * size
    a = run(programs.forward(model), at)["a"]
    assert np.abs(newton_euler(links, at["q"], at["v"], a)).max() < 1e-11 * (1 + np.abs(a).max())
    M = run(programs.mass_matrix(model), at)["M"]
    rest = newton_euler(links, at["q"], np.zeros(5), np.zeros(5))
    for j, column in enumerate(np.eye(5)):
        expected = newton_euler(links, at["q"], np.zeros(5), column) - rest
        assert M[:, j] == pytest.approx(expected, rel=1e-11, abs=1e-12)


def seven_links():
    """A 7-joint arm whose joint axes turn by right angles, with full inertias and sparse offsets."""
    links = random_links(7, 77)
    axes = [Z, Y, Z, Y, Z, Y, Z]
    offsets = [(0, 0, 0.3), (0, 0, 0), (0, 0, 0.3), (0.08, 0, 0), (-0.08, 0, 0.4), (0, 0, 0), (0.09, 0, 0)]
    return [(a, o, *link[2:]) for a, o, link in zip(axes, offsets, links, strict=True)]


def test_seven_joint_arm_takes_few_operations():
    model = arm(seven_links())
    forward, bias = programs.forward(model), programs.bias(model)
    assert count_program(forward).operations <= 1350
    assert count_program(bias).operations <= 620
    assert count_program(programs.mass_matrix(model)).operations <= 520
    at = state(model, 1)
    assert np.abs(newton_euler(seven_links(), at["q"], at["v"], run(forward, at)["a"])).max() < 1e-12 * 100


def pinocchio_tree(pin, specification, free):
    model = pin.Model()
    ids = []
    if free is not None:
        root = model.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), "base")
        mass, centre, inertia = free
        model.appendBodyToJoint(root, pin.Inertia(mass, np.array(centre), np.array(inertia)), pin.SE3.Identity())
    for i, (parent, axis, offset, mass, centre, inertia) in enumerate(specification):
        above = ids[parent] if parent >= 0 else (1 if free is not None else 0)
        joint = pin.JointModelRevoluteUnaligned(np.array(axis, float) / np.linalg.norm(axis))
        ids.append(model.addJoint(above, joint, pin.SE3(np.eye(3), np.array(offset)), f"j{i}"))
        model.appendBodyToJoint(ids[-1], pin.Inertia(mass, np.array(centre), np.array(inertia)), pin.SE3.Identity())
    return model


def graph_tree(specification, free):
    """The same tree through the layer below models, with quasi-velocities where it floats."""
    n = len(specification)
    g = Graph()
    base = (7, 6) if free is not None else (0, 0)
    q = [g.input("q", i) for i in range(base[0] + n)]
    v = [g.input("v", i) for i in range(base[1] + n)]
    rates = [*(floating_rates(g, q[:7], v[:6]) if free is not None else []), *v[base[1] :]]
    motion = Motion(g, 3, q, v, rates)
    bodies = Bodies(motion)

    def attach(axes, place, mass, centre, inertia):
        at = motion.place(place, axes, [g.const(x) for x in centre])
        bodies.add(axes, at, g.const(mass), [[g.const(x) for x in row] for row in inertia])

    below = (motion.root, motion.ground)
    if free is not None:
        below = floating_body(motion, q[:7], v[:6])
        attach(*below, *free)
    made = []
    for i, (parent, axis, offset, *body) in enumerate(specification):
        axes, place = made[parent] if parent >= 0 else below
        joint = motion.place(place, axes, [g.const(x) for x in offset])
        turned = motion.turned_about(axes, [abs(x) for x in axis].index(1), q[base[0] + i])
        made.append((turned, joint))
        attach(turned, joint, *body)
    efforts = [(x, g.input("u", i)) for i, x in enumerate(v)]
    names = tuple(f"v{i}" for i in range(len(v)))
    return Mechanics(g, motion, bodies, names, [g.zero, g.zero, g.const(-9.81)], efforts)


def tree_specification(seed, parents):
    links = random_links(len(parents), seed)
    rng = np.random.default_rng(seed)
    return [(parent, (X, Y, Z)[int(rng.integers(3))], *link[1:]) for parent, link in zip(parents, links, strict=True)]


TREES = {
    "arm": ([-1, 0, 1, 2, 3, 4, 5], False),
    "quadruped": ([-1, 0, 1, -1, 3, 4, -1, 6, 7, -1, 9, 10], True),
    "humanoid": ([-1, 0, 1, 2, 3, 1, 5, 6, -1, 8, 9, 10, -1, 12, 13, 14], True),
}


@pytest.mark.parametrize("name", TREES)
def test_trees_against_pinocchio(name):
    pin = pytest.importorskip("pinocchio")
    parents, floats = TREES[name]
    specification = tree_specification(5, parents)
    free = random_links(1, 99)[0][2:] if floats else None
    reference = pinocchio_tree(pin, specification, free)
    data = reference.createData()
    m = graph_tree(specification, free)
    g, n = m.graph, len(m.v)
    a = [g.input("a", i) for i in range(n)]
    groups = {"q": m.q, "v": m.v, "u": m.v, "a": m.v}
    names = {key: tuple(f"{key}{i}" for i in range(len(ids))) for key, ids in groups.items()}
    forward = Program("forward", g, names, {"a": Output(tuple(m.forward()), (n,))})
    inverse = Program("inverse", g, names, {"r": Output(tuple(m.inverse(a)), (n,))})
    mass = Program("mass", g, names, {"M": Output(tuple(x for row in m.mass_matrix() for x in row), (n, n))})
    rng = np.random.default_rng(3)
    for _ in range(3):
        q, v, u, acc = rng.uniform(-1, 1, len(m.q)), *rng.uniform(-1, 1, (3, n))
        if floats:
            q[3:7] /= np.linalg.norm(q[3:7])
        at = {"q": list(q), "v": list(v), "u": list(u), "a": list(acc)}
        expected = pin.aba(reference, data, q, v, u)
        assert np.abs(run(forward, at)["a"] - expected).max() < 1e-10 * np.abs(expected).max()
        expected = pin.rnea(reference, data, q, v, acc) - u
        assert np.abs(run(inverse, at)["r"] - expected).max() < 1e-12 * np.abs(expected).max()
        expected = pin.crba(reference, data, q)
        expected = np.triu(expected) + np.triu(expected, 1).T
        assert np.abs(run(mass, at)["M"] - expected).max() < 1e-12 * np.abs(expected).max()


def test_a_floating_top_keeps_its_momentum():
    """Free of gravity: the angular momentum R (I ω) and the centre's velocity do not change."""
    free = (2.0, (0.0, 0.0, 0.0), ((0.3, 0.02, 0.01), (0.02, 0.4, 0.03), (0.01, 0.03, 0.5)))
    m = graph_tree([], free)
    m.down = [m.graph.zero] * 3
    g = m.graph
    names = {"q": tuple("xyzabcd"), "v": tuple("uvwpqr"), "u": tuple("123456")}
    program = Program("top", g, names, {"a": Output(tuple(m.forward()), (6,)), "rate": Output(m.motion.rates, (7,))})
    e = np.array([0.1, -0.4, 0.3, 0.8])
    w, v = np.array([0.3, -0.7, 0.9]), np.array([0.2, 0.5, -0.4])
    found = run(program, {"q": [0, 0, 0, *(e / np.linalg.norm(e))], "v": [*v, *w], "u": [0] * 6})
    inertia = np.array(free[2])
    assert inertia @ found["a"][3:] == pytest.approx(-np.cross(w, inertia @ w), abs=1e-15)
    assert found["a"][:3] == pytest.approx(-np.cross(w, v), abs=1e-15)
    assert found["rate"][3:] @ (e / np.linalg.norm(e)) == pytest.approx(0, abs=1e-16)


@pytest.mark.slow
def test_operations_grow_with_the_number_of_joints_alone():
    links = seven_links()

    def operations(n):
        m = graph_tree([(i - 1, *links[i % 7]) for i in range(n)], None)
        return count_operations(m.graph, m.forward()).operations

    one, two, three = (operations(n) for n in (14, 28, 42))
    assert two - one == three - two
