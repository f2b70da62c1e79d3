"""Accelerations and multipliers along the tape against dense matrices of numbers."""

import itertools

import mechanisms
import mechanisms_in_space
import numpy as np
import pytest
import sympy as sp
from closed_loops import values

import lagrangian as lg
from effort import at_most
from lagrangian.dynamics import Inputs, describe, forward, forward_dual
from lagrangian.dynamics.vectors import rotated
from lagrangian.graph import Graph, Output, Program, count_operations, evaluate
from size import rest_slow

SYSTEMS = {
    "slider-crank": mechanisms.slider_crank,
    "four-bar": mechanisms.four_bar,
    "five-bar": mechanisms.five_bar,
    "sleigh": mechanisms.sleigh,
    "disc": mechanisms.rolling_disc,
    "ladder of 2": lambda: mechanisms.ladder(2),
    "ladder of 5": lambda: mechanisms.ladder(5),
}


def random_state(numbers, seed):
    rng = np.random.default_rng(seed)
    return rng.uniform(0.2, 1.2, numbers.n), rng.uniform(-1, 1, numbers.n)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", SYSTEMS)
@pytest.mark.parametrize("seed", range(3))
def test_accelerations_and_multipliers_are_those_of_dense_matrices(name, seed):
    m, numbers, p = SYSTEMS[name]()
    q, v = random_state(numbers, seed)
    vdot, lam = numbers.solution(q, v)
    found = values(m, q, v, p, vdot=m.forward(), lam=m.constrained.multipliers)
    assert np.abs(found["vdot"] - vdot).max() < 1e-12 * (1 + np.abs(vdot).max())
    assert np.abs(found["lam"] - lam).max() < 1e-12 * (1 + np.abs(lam).max())


def moving(numbers, q):
    """Some velocities that satisfy the rows at q."""
    _, sizes, directions = np.linalg.svd(numbers.rows(q, np.zeros(numbers.n))[0])
    rank = int((sizes > 1e-9 * sizes[0]).sum())
    return directions[rank:].T @ np.arange(1.0, numbers.n - rank + 1)


def trihedral(theta):
    """The regular loop of Bricard: cos θ + cos φ + cos θ cos φ = 0."""
    phi = np.arccos(-np.cos(theta) / (1 + np.cos(theta)))
    return np.array([theta, phi, theta, phi, theta])


REDUNDANT = {
    "double parallelogram": (mechanisms.double_parallelogram, np.array([0.7, 0.7, 0.7, 0.0])),
    "Bricard": (mechanisms.bricard, trihedral(0.6)),
}


@pytest.mark.parametrize("name", rest_slow(REDUNDANT, {"double parallelogram"}))
def test_a_row_that_depends_on_others_where_the_loop_closes_is_skipped(name):
    build, q = REDUNDANT[name]
    m, numbers, p = build()
    v = moving(numbers, q)
    vdot, _ = numbers.solution(q, v)
    size, found = np.abs(vdot).max(), m.constrained
    wanted = {"vdot": found.vdot, "lam": found.multipliers, "margins": found.margins, "skipped": found.residuals}
    for off, tolerance in ((0.0, 1e-12), (1e-9, 2e-8)):
        rng = np.random.default_rng(5)
        at = q + off * rng.normal(size=len(q)), v + off * rng.normal(size=len(q))
        got = values(m, *at, p, **wanted)
        assert np.abs(got["vdot"] - vdot).max() < tolerance * size
        skipped = np.abs(got["margins"]) < 1e-11
        assert skipped.sum() == 1 and got["margins"][~skipped].min() > 1e-3
        assert np.abs(got["lam"][skipped]) < 1e-140
        assert np.abs(got["skipped"]).max() <= 1e-12 * size + 10 * off * size and (got["skipped"][~skipped] == 0).all()
        M, h, A, _ = numbers.equations(*at)
        assert np.abs(M @ got["vdot"] + h - A.T @ got["lam"]).max() < 1e-11 * np.abs(h).max()


def test_the_margin_falls_with_the_square_of_the_distance_from_the_flat_position():
    m, _, p = mechanisms.planar([(2, (1.0, 0.0))], [0.5, 1.0, 0.5], [(0, 0), 0, 1])
    margins = []
    for angle in (1e-2, 1e-3):
        got = values(m, [angle, 0.0, angle - np.pi], np.ones(3), p, margins=m.constrained.margins)
        margins.append(got["margins"].min())
    assert margins[0] / margins[1] == pytest.approx(100, rel=0.01) and 1e-6 < margins[0] < 1e-3


def test_a_hinge_that_says_again_what_others_say_is_named():
    m, numbers = mechanisms_in_space.door()
    assert list(m.settled[1]) == ["upper hinge.z"]
    m, _ = mechanisms_in_space.door(all_rows=False)
    q = np.array([0, 0, 0, 0, 0, np.sin(0.4), np.cos(0.4)])
    v = np.array([0, 0, 0, 0, 0, 1.3])
    vdot, _ = numbers.solution(q, v)
    assert np.abs(values(m, q, v, vdot=m.forward())["vdot"] - vdot).max() < 1e-12 * np.abs(vdot).max()
    off = np.array([0, 0, 0, 1e-9, 1e-9, 0, 0])
    assert np.abs(values(m, q + off, v, vdot=m.forward())["vdot"] - vdot).max() < 1e-7 * np.abs(vdot).max()


def test_a_bicycle_rolls():
    m, numbers, p = mechanisms_in_space.bicycle()
    for seed in range(3):
        rng = np.random.default_rng(seed)
        q, v = rng.uniform(-0.4, 0.4, 8), rng.uniform(-1, 1, 8)
        order = [1, 2, 0, 3, 4]  # the oracle's rows are the gaps first
        vdot, lam = numbers.solution(q, v)
        got = values(m, q, v, p, vdot=m.forward(), lam=m.constrained.multipliers, c=[row.rate for row in m.rows])
        assert np.abs(got["c"] - numbers.rows(q, v)[1][order]).max() < 1e-13
        assert np.abs(got["vdot"] - vdot).max() < 1e-11 * (1 + np.abs(vdot).max())
        assert np.abs(got["lam"] - lam[order]).max() < 1e-11 * (1 + np.abs(lam).max())


# operations of v̇ and λ, parameters hoisted
OPERATIONS = {
    "slider-crank": (mechanisms.slider_crank, 80),
    "four-bar": (mechanisms.four_bar, 160),
    "five-bar": (mechanisms.five_bar, 169),
    "sleigh": (mechanisms.sleigh, 45),
    "disc": (mechanisms.rolling_disc, 159),
    "bicycle": (mechanisms_in_space.bicycle, 1875),
}


def operations(m):
    return count_operations(m.graph, [*m.constrained.vdot, *m.constrained.multipliers], hoist=["p"]).operations


@pytest.mark.parametrize("name", OPERATIONS)
def test_constrained_accelerations_take_few_operations(name):
    build, bound = OPERATIONS[name]
    assert operations(build()[0]) <= bound


REDUCED = {
    "chaplygin-sleigh": (45, 40),
    "car": (134, 125),
    "car-with-trailer": (287, 276),
    "balancing-robot": (266, 266),
}
"""Operations for accelerations and multipliers, and for accelerations alone."""


@pytest.mark.parametrize("name", REDUCED)
def test_speeds_along_and_across_a_blade_are_used_where_they_take_fewer_operations(name):
    """Without them 50, 137, 299 and 278: the row gives one speed without a division, its pivot cannot vanish."""
    graph = Graph()
    model = lg.example(name).model
    m = describe(model, graph, Inputs.of(graph, model))
    assert (operations(m), count_operations(graph, m.constrained.vdot, hoist=["p"]).operations) <= REDUCED[name]
    if name == "chaplygin-sleigh":
        assert m.constrained.margins == [graph.one]


@pytest.mark.parametrize("tilted", [False, True])
def test_speeds_along_a_blade_agree_with_dense_matrices_where_bodies_turn_the_same_rates(tilted):
    """In space velocities are along the axes of the sleigh, so that x' and y' are turned for the bodies as well."""
    s = lg.System("sleigh in space")
    x, y, psi, phi = s.coordinates("x y psi phi")
    body = s.frame(psi, axis=(0, 0, 1), origin=s.point("P", (x, y, 0)), name="sleigh")
    s.rigid_body(2.0, (0.1, 0.2, 0.3), at=body.point(0.3, 0.1, 0.2), frame=body)
    arm = s.frame(phi, axis=(1, 0, 0), parent=body, origin=body.point(0.1, 0.2, 0.0), name="arm")
    s.rigid_body(1.0, (0.2, 0.1, 0.1), at=arm.point(0.0, 0.4, 0.1), frame=arm)
    s.gravity((0, 0.5 if tilted else 0, -1))
    t = s.t
    s.velocity_constraint(y.diff(t) * sp.cos(psi) - x.diff(t) * sp.sin(psi), name="blade")
    s.velocity_constraint(x.diff(t) * sp.cos(psi) + y.diff(t) * sp.sin(psi) - phi.diff(t) / 5, name="wheel")
    draw = np.random.default_rng(3)
    for _ in range(5):
        q, v = draw.uniform(-1, 1, 4), draw.uniform(-1, 1, 4)
        given = {"q": list(q), "v": list(v), "u": [], "p": [9.81], "t": [0.0]}
        one, other = (evaluate(make(s.model), given)["a"] for make in (forward, forward_dual))
        assert one == pytest.approx(other, rel=1e-11, abs=1e-11)


@pytest.mark.parametrize("signs", list(itertools.product((1, -1), repeat=4)))
def test_rotated_products_are_those_of_numbers(signs):
    """(c x − s y, s x + c y) for x, y = ±K c, ±K s and ±K s, ±K c, and turns by ±c, ±s: by numbers."""
    g = Graph()
    angle, K = g.input("q", 0), g.mul(g.input("p", 0), g.input("p", 1))
    cosine, sine = g.cos(angle), g.sin(angle)
    a, b, c, s = ((lambda x, sign=sign: x if sign > 0 else g.neg(x)) for sign in signs)
    short = 0
    for first, second in ((cosine, sine), (sine, cosine)):
        x, y, turn, other = a(g.mul(K, first)), b(g.mul(second, K)), c(cosine), s(sine)
        found = rotated(g, x, y, turn, other)
        plain = g.sub(g.mul(turn, x), g.mul(other, y)), g.add(g.mul(other, x), g.mul(turn, y))
        program = Program("turned", g, {"q": ("q",), "p": ("a", "b")}, {"x": Output((*found, *plain), (4,))})
        x = evaluate(program, {"q": [0.7], "p": [1.3, 0.9]})["x"]
        assert x[:2] == pytest.approx(x[2:], abs=1e-15)
        short += g.zero in found
    assert short == 1


def test_a_body_that_rolls_costs_no_more_than_rows_written_by_hand():
    """Of the motion of what carries both the body and its contact, nothing is left in the rows."""
    for name, bound in (("rolling-disc", OPERATIONS["disc"][1]), ("whipple-bicycle", OPERATIONS["bicycle"][1])):
        graph = Graph()
        model = lg.example(name).model
        assert operations(describe(model, graph, Inputs.of(graph, model))) <= bound


@pytest.mark.slow
def test_a_ladder_of_loops_takes_operations_in_proportion_to_its_length():
    five, ten, twenty = (operations(mechanisms.ladder(count)[0]) for count in (5, 10, 20))
    assert twenty - ten == 2 * (ten - five) and ten <= 3581


@pytest.mark.parametrize(("name", "prototype"), [("andrews-squeezer", 438), ("stewart-platform", 4218)])
def test_examples_take_as_many_operations_as_the_prototype_within_five_percent(name, prototype):
    graph = Graph()
    model = lg.example(name).model
    assert operations(describe(model, graph, Inputs.of(graph, model))) <= 1.05 * prototype


@pytest.mark.slow
def test_a_long_ladder_is_built_in_proportion_to_its_length():
    efforts = []
    for count in (25, 50):
        m = mechanisms.ladder(count)[0]
        with at_most(4_000_000) as effort:
            m.forward()
        efforts.append(effort.calls)
    assert efforts[1] < 2.2 * efforts[0]
