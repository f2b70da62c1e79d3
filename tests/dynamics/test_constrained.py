"""Corrections of states, the rows of a model as programs, and the dual route, against dense matrices of numbers."""

import closed_loops
import mechanisms
import mechanisms_in_space
import numpy as np
import pytest
import sympy as sp
from closed_loops import values
from dynamics_models import run
from floating_trees import QUADRUPED, pinocchio_model, states, system
from hypothesis import given
from hypothesis import strategies as st

import built_in
from lagrangian.dynamics import constraint_programs, programs
from lagrangian.dynamics.constrained import dual, kept_by_steps, position_correction, velocity_correction
from lagrangian.dynamics.describe import Inputs, described
from lagrangian.dynamics.rows import ConstraintRow
from lagrangian.errors import ModelError
from lagrangian.graph import Graph, count_operations, jvp, vjp
from lagrangian.model import Builder, Gravity, Particle, RigidBody
from size import sized

SYSTEMS = {
    "slider-crank": mechanisms.slider_crank,
    "four-bar": mechanisms.four_bar,
    "five-bar": mechanisms.five_bar,
    "sleigh": mechanisms.sleigh,
    "disc": mechanisms.rolling_disc,
    "ladder of 2": lambda: mechanisms.ladder(2),
    "bicycle": mechanisms_in_space.bicycle,
}


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", SYSTEMS)
@pytest.mark.parametrize("keep", [(), (0,)])
def test_corrections_are_the_least_steps(name, keep):
    m, numbers, p = SYSTEMS[name]()
    rng = np.random.default_rng(len(name))
    q, v = rng.uniform(0.2, 0.9, numbers.n), rng.uniform(-1, 1, numbers.n)
    f = np.array(numbers.gaps(q), float)
    step = position_correction(m, keep)
    assert (step is None) == (len(f) == 0)
    if step is not None:
        expected = numbers.step(q, f, keep)
        assert np.abs(values(m, q, v, p, dq=step[0])["dq"] - expected).max() < 1e-11 * (1 + np.abs(expected).max())
    step = velocity_correction(m, keep)
    assert step is not None
    expected = numbers.step(q, numbers.rows(q, v)[1], keep)
    assert np.abs(values(m, q, v, p, dv=step[0])["dv"] - expected).max() < 1e-11 * (1 + np.abs(expected).max())


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", SYSTEMS)
def test_the_dual_route_agrees(name):
    m, numbers, p = SYSTEMS[name]()
    rng = np.random.default_rng(3)
    q, v = rng.uniform(0.2, 0.9, numbers.n), rng.uniform(-1, 1, numbers.n)
    a, lam = dual(m)
    got = values(m, q, v, p, a=a, lam=lam, vdot=m.forward(), multipliers=m.constrained.multipliers)
    for one, other in (("a", "vdot"), ("lam", "multipliers")):
        assert np.abs(got[one] - got[other]).max() < 1e-10 * (1 + np.abs(got[other]).max())


def test_the_dual_route_skips_a_redundant_row_too():
    m, numbers, p = mechanisms.double_parallelogram()
    q = np.array([0.7, 0.7, 0.7, 0.0])
    v = np.array([1.0, 1.0, 1.0, 0.0])
    vdot, _ = numbers.solution(q, v)
    assert np.abs(values(m, q, v, p, a=dual(m)[0])["a"] - vdot).max() < 1e-12 * np.abs(vdot).max()


def test_newtons_steps_close_a_floating_door():
    m, numbers = mechanisms_in_space.door()
    found = position_correction(m)
    assert found is not None
    q = np.array([0.1, -0.05, 0.02, 0.1, -0.08, np.sin(0.4), np.cos(0.4)])
    for _ in range(6):
        q = q + values(m, q, np.zeros(6), dq=found[0])["dq"]
    q[3:] /= np.linalg.norm(q[3:])
    assert np.abs(np.array(numbers.gaps(q), float)).max() < 1e-14


def test_a_coordinate_of_a_floating_frame_can_be_held():
    m, _ = mechanisms_in_space.door(all_rows=False)
    m.rows[:] = m.rows[3:]  # the lower hinge is free
    q = np.array([0.1, -0.05, 0.02, 0.1, -0.08, 0.3, 0.9])
    q[3:] /= np.linalg.norm(q[3:])
    found = position_correction(m, (0, 2))
    assert found is not None
    step = values(m, q, np.zeros(6), dq=found[0], f=[row.residual for row in m.rows])
    assert np.abs(step["dq"][[0, 2]]).max() < 1e-15 < np.abs(step["dq"][1])
    left = values(m, q + 1e-4 * step["dq"], np.zeros(6), f=[row.residual for row in m.rows])["f"]
    turned = values(m, q, np.zeros(6), c=m.motion.rate([row.residual for row in m.rows]))  # at rest: nothing turns
    assert np.abs(turned["c"]).max() == 0 and np.abs(left).max() < np.abs(step["f"]).max()


FEET = {4: 0, 7: 1, 10: 2, 13: 3}
"""Pinocchio's joints whose links end in feet (1 is the floating base), and the numbers of the feet."""


def standing(model):
    """The mechanics of a quadruped whose shins' ends stay where they are, rows in the shins' axes."""
    graph = Graph()
    m, d = described(model, graph, Inputs.of(graph, model))
    frames = list(d.axes)
    for joint, foot in FEET.items():
        frame = frames[joint - 1]
        point = closed_loops.place(m, d, frame.point(0, 0, -0.4, at=frame.origin))
        for axis, x in zip("xyz", point.velocity, strict=True):
            m.rows.append(ConstraintRow(f"foot {foot}.{axis}", f"foot {foot}", x))
    return m


@pytest.mark.slow
def test_a_quadruped_stands_as_in_pinocchio():
    pin = pytest.importorskip("pinocchio")
    there, tree = pinocchio_model(pin, QUADRUPED, 3), system(QUADRUPED, 3)
    m, parameters = standing(tree.model), [x.value for x in tree.model.parameters]
    for joint in FEET:
        at = pin.SE3(np.eye(3), np.array([0, 0, -0.4]))
        there.addFrame(pin.Frame(f"foot {joint}", joint, 0, at, pin.FrameType.OP_FRAME))
    data = there.createData()
    a, lam = dual(m)
    for q, v, u in zip(*states(tree, 3, 5), strict=True):
        M, h = pin.crba(there, data, q), pin.nonLinearEffects(there, data, q, v)
        M = np.triu(M) + np.triu(M, 1).T
        A, gamma = [], []
        pin.forwardKinematics(there, data, q, v, np.zeros(18))
        pin.computeJointJacobians(there, data, q)
        pin.updateFramePlacements(there, data)
        for joint in FEET:
            foot = there.getFrameId(f"foot {joint}")
            A.append(pin.getFrameJacobian(there, data, foot, pin.LOCAL)[:3])
            gamma.append(pin.getFrameAcceleration(there, data, foot, pin.LOCAL).linear)  # ċ in the shin's own axes
        A, gamma = np.vstack(A), np.concatenate(gamma)
        saddle = np.block([[M, -A.T], [A, np.zeros((12, 12))]])
        expected = np.linalg.solve(saddle, np.r_[u - h, -gamma])
        got = values(m, q, v, parameters, u, a=a, lam=lam, vdot=m.forward(), multipliers=m.constrained.multipliers)
        for names, found in ((("a", "vdot"), expected[:18]), (("lam", "multipliers"), expected[18:])):
            for name in names:
                assert np.abs(got[name] - found).max() < 1e-11 * np.abs(found).max(), name


@sized(200, 6)
@given(st.data())
def test_random_rows_on_random_trees(data):
    n = data.draw(st.integers(3, 6))
    parents = [data.draw(st.integers(-1, k - 1)) for k in range(n)]
    axes = [data.draw(st.integers(0, 2)) for _ in range(n)]
    pair = st.tuples(st.integers(0, n - 1), st.integers(0, n - 1)).filter(lambda x: x[0] != x[1])
    ends = data.draw(st.lists(pair, min_size=1, max_size=2, unique_by=frozenset))
    joints = [(i, k, sorted(data.draw(st.sets(st.integers(0, 2), min_size=1, max_size=2)))) for i, k in ends]
    seed = data.draw(st.integers(0, 10**6))
    m, numbers = mechanisms_in_space.random_tree(parents, axes, seed, joints)
    rng = np.random.default_rng(seed)
    q, v = rng.uniform(-1.2, 1.2, n), rng.uniform(-1, 1, n)
    M, _, A, gamma = numbers.equations(q, v)
    L = np.linalg.cholesky(M)
    size = np.linalg.svd(np.linalg.solve(L, A.T), compute_uv=False)
    if len(A) > n or size[-1] <= 1e-2 * size[0]:
        return  # more rows than velocities, or rows that nearly depend on each other
    vdot, lam = numbers.solution(q, v)
    got = values(m, q, v, vdot=m.forward(), lam=m.constrained.multipliers)
    assert np.abs(A @ got["vdot"] + gamma).max() < 1e-9 * (1 + np.abs(gamma).max())
    assert np.abs(got["vdot"] - vdot).max() < 1e-9 * (1 + np.abs(vdot).max())
    assert np.abs(got["lam"] - lam).max() < 1e-9 * (1 + np.abs(lam).max())


# -- rates without inertia --------------------------------------------------------------------------------------


def roller(coefficient):
    """A mass on x, and a wheel without inertia that turns by phi: x′ = coefficient · phi′."""
    b = Builder("roller")
    x, phi = b.coordinate("x"), b.coordinate("phi")
    r = b.parameter("r", 0.5).symbol
    b.add(Particle(mass=2.0, at=b.origin + (x.symbol, 0)))
    b.add(Gravity(direction=(1, 0), g=sp.Float(3.0)))
    m, d = closed_loops.mechanics(b)
    closed_loops.slip(m, d, x.rate - coefficient(r, phi.symbol) * phi.rate, "rolling")
    return m


def test_a_rate_without_inertia_follows_from_its_row():
    m = roller(lambda r, phi: r)
    got = values(m, [0.1, 0.2], [1.0, 2.0], [0.5], a=m.forward(), lam=m.constrained.multipliers)
    assert got["a"] == pytest.approx([3.0, 6.0], rel=1e-15) and got["lam"] == pytest.approx([0.0], abs=1e-15)
    assert m.constrained.divisors == []  # the coefficient of x is a number
    step = velocity_correction(m)
    assert step is not None
    dv = values(m, [0.1, 0.2], [1.0, 1.0], [0.5], dv=step[0])["dv"]
    assert dv == pytest.approx([0.0, 1.0], abs=1e-15)


def test_what_is_divided_by_unseen_is_told():
    b = Builder("belt")
    x, y = b.coordinate("x"), b.coordinate("y")
    r, s = b.parameter("r", 0.5).symbol, b.parameter("s", 0.25).symbol
    b.add(Particle(mass=2.0, at=b.origin + (x.symbol, y.symbol)))
    b.add(Gravity(direction=(1, 0), g=sp.Float(3.0)))
    m, d = closed_loops.mechanics(b)
    closed_loops.slip(m, d, r * x.rate - s * y.rate, "belt")
    (name, divisor), *_ = m.constrained.divisors
    got = values(m, [0, 0], [0, 0], [0.5, 0.25], a=m.forward(), lam=m.constrained.multipliers, divisor=[divisor])
    assert name == "belt" and abs(got["divisor"][0]) in (0.5, 0.25)
    assert got["a"] == pytest.approx([0.6, 1.2], rel=1e-14) and got["lam"] == pytest.approx([-9.6], rel=1e-14)


def test_derivatives_are_finite_where_a_row_is_skipped():
    m, _, p = mechanisms.double_parallelogram()
    q = np.array([0.7, 0.7, 0.7, 0.0])
    back = vjp(m.graph, m.forward(), [m.graph.one] * 4, list(m.q))
    along = jvp(m.graph, m.forward(), {m.q[0]: m.graph.one})
    for state in (q, q + 0.3 * np.array([1, 1, 1, 0]), np.array([np.pi / 2] * 3 + [0.0]), np.zeros(4)):
        got = values(m, state, [1.0, 1.0, 1.0, 0.0], p, back=back, along=along)
        assert np.isfinite(got["back"]).all() and np.isfinite(got["along"]).all()


def test_a_rate_without_inertia_needs_a_row():
    m = roller(lambda r, phi: r)
    m.rows.clear()
    with pytest.raises(ModelError, match="'phi' moves no mass"):
        m.forward()


# -- programs ---------------------------------------------------------------------------------------------------


@pytest.fixture
def four_bar_model(monkeypatch):
    """A four-bar linkage as a model whose rows are added when it is described, with its `Numbers`."""
    b = Builder("four-bar")
    ends = []
    for k, (size, below) in enumerate(zip((0.6, 1.4, 0.9), (None, 0, 1), strict=True)):
        ends.append(mechanisms.bar(b, k, b.origin if below is None else ends[below], size))
    b.add(Gravity(direction=(0, -1), g=sp.Float(9.81)))
    fixed = b.origin + (1.5, 0.2)

    def with_rows(model, graph, inputs):
        m, d = described(model, graph, inputs)
        closed_loops.join(m, d, ends[2], fixed, "loop")
        return m

    monkeypatch.setattr(programs, "describe", with_rows)
    return b.model(), mechanisms.four_bar()[1]


def test_programs_of_constraints(four_bar_model):
    model, numbers = four_bar_model
    p = [x.value for x in model.parameters]
    q, v = mechanisms.closed(numbers, [1.0, 0.2, -1.2], np.array([1.0, 0.5, -0.3]))
    at = {"q": q, "v": v, "u": [], "p": p, "t": [0.0], "x": [*q, *v]}
    vdot, lam = numbers.solution(q, v)
    A, _, gamma = numbers.rows(q, v)
    assert run(programs.forward(model), at)["a"] == pytest.approx(vdot, rel=1e-12)
    got = run(constraint_programs.multipliers(model), at)
    assert got["lam"] == pytest.approx(lam, rel=1e-12)
    assert got["margin"] == got["margins"].min() > 1e-3 and (got["skipped"] == 0).all() and (got["sizes"] > 0).all()
    alone = constraint_programs.multipliers(model, redundant=["loop.x", "loop.y"])
    assert run(alone, at)["margin"] == 1.0
    dense = run(constraint_programs.forward_dual(model), at)
    assert dense["a"] == pytest.approx(vdot, rel=1e-11) and dense["lam"] == pytest.approx(lam, rel=1e-11)
    rows = run(constraint_programs.constraint_matrix(model), at)
    assert rows["A"] == pytest.approx(A, abs=1e-14) and rows["gamma"] == pytest.approx(gamma, abs=1e-13)
    assert (rows["a0"] == 0).all()
    assert np.abs(np.r_[tuple(run(constraint_programs.residual(model), at).values())]).max() < 1e-14


def test_projections_bring_a_state_back(four_bar_model):
    model, numbers = four_bar_model
    p = [x.value for x in model.parameters]
    q, v = mechanisms.closed(numbers, [1.0, 0.2, -1.2], np.array([1.0, 0.5, -0.3]))
    x = np.r_[q, v] + 1e-5 * np.arange(6)
    position, velocity = constraint_programs.projection(model)
    assert position is not None and velocity is not None
    at = {"u": [], "p": p, "t": [0.0]}
    f, c = np.array(numbers.gaps(x[:3]), float), numbers.rows(x[:3], x[3:])[1]
    got = run(position, {**at, "x": x})
    assert got["gap"] == pytest.approx(np.abs(f).max(), rel=1e-9) and 1e-3 < got["margin"] < 1
    assert (got["dx"][3:] == 0).all()
    assert run(velocity, {**at, "x": x})["gap"] == pytest.approx(np.abs(c).max(), rel=1e-9)
    for _ in range(2):
        x = x + run(position, {**at, "x": x})["dx"]
    x = x + run(velocity, {**at, "x": x})["dx"]
    assert np.abs(np.array(numbers.gaps(x[:3]), float)).max() < 1e-15
    assert np.abs(numbers.rows(x[:3], x[3:])[1]).max() < 1e-14


def test_corrections_hold_what_is_fixed(four_bar_model):
    model, numbers = four_bar_model
    q, v = np.array([1.0, 0.3, -1.0]), np.array([1.0, 0.5, -0.3])
    at = {"q": q, "v": v, "u": [], "p": [x.value for x in model.parameters], "t": [0.0]}
    program = constraint_programs.correction(model, ["q0"])
    assert program is not None
    dq = run(program, at)["dq"]
    assert dq[0] == 0 and dq == pytest.approx(numbers.step(q, np.array(numbers.gaps(q), float), (0,)), rel=1e-11)
    program = constraint_programs.correction(model, ["q0", "q1"], position=False)  # two rows, one rate: one is skipped
    assert program is not None
    got = run(program, at)
    assert (got["dv"][:2] == 0).all() and np.isfinite(got["dv"]).all() and got["margin"] < 1e-11
    program = constraint_programs.correction(model, ["q0", "q1", "q2"])
    assert program is not None
    got = run(program, at)
    assert (got["dq"] == 0).all() and got["margin"] == 0 and got["gap"] > 0.01
    with pytest.raises(ModelError, match="no coordinate 'q7'"):
        constraint_programs.correction(model, ["q7"])


def test_rows_with_constant_coefficients_need_no_projection(four_bar_model):
    m, d = closed_loops.mechanics(_cart())
    x, y = d.motion.v
    m.rows.append(ConstraintRow("belt", "belt", m.graph.sub(x, m.graph.mul(m.graph.const(2.0), y))))
    assert kept_by_steps(m)
    assert not kept_by_steps(mechanisms.sleigh()[0])
    model, _ = four_bar_model
    assert constraint_programs.residual(model).outputs["f"].shape == (2,)


def _cart():
    b = Builder("carts")
    x, y = b.coordinate("x"), b.coordinate("y")
    for c in (x, y):
        b.add(RigidBody(mass=1, inertia=1, at=b.origin + (c.symbol, 0), frame=b.frame(f"F{c.name}", sp.Integer(0))))
    return b


def test_both_steps_of_a_projection_share_their_elimination():
    position, velocity = constraint_programs.projection(built_in.system("four-bar").model)
    assert position is not None and position.graph is velocity.graph
    alone = [count_operations(p.graph, p.outputs["dx"].ids, hoist="p").operations for p in (position, velocity)]
    both = [*position.outputs["dx"].ids, *velocity.outputs["dx"].ids]
    assert count_operations(position.graph, both, hoist="p").operations < 0.75 * sum(alone)
