"""Positions that close the loops, against the geometry of triangles; what cannot be closed is named."""

import math

import numpy as np
import pytest
import sympy as sp

import built_in
import lagrangian as lg
from constrained_systems import four_bar
from lagrangian.assembly import assemble
from lagrangian.assembly.assemble import assembler_of, seen_position, seen_velocity
from lagrangian.errors import RunError

CRANK, COUPLER, ROCKER, BASE = 0.5, 1.2, 0.9, 1.0


def by_triangles(a: float) -> list[tuple[float, float]]:
    """The two positions (b, c) of coupler and rocker at a crank angle, by the law of cosines."""
    tip = np.array([CRANK * math.cos(a), CRANK * math.sin(a)])
    gap = np.array([BASE, 0.0]) - tip
    r = float(np.hypot(*gap))
    along = math.atan2(gap[1], gap[0])
    at_tip = math.acos((COUPLER**2 + r**2 - ROCKER**2) / (2 * COUPLER * r))
    found = []
    for sign in (1, -1):
        b = along + sign * at_tip
        knee = tip + COUPLER * np.array([math.cos(b), math.sin(b)])
        rest = np.array([BASE, 0.0]) - knee
        found.append((b, math.atan2(rest[1], rest[0])))
    return found


def near(x: float, y: float) -> bool:
    return abs(math.remainder(x - y, 2 * math.pi)) < 1e-9


@pytest.mark.sampled(6)
@pytest.mark.parametrize("a", [0.3, 1.0, 2.5, -1.2])
def test_a_four_bar_is_put_together_in_its_two_ways(a: float) -> None:
    found = four_bar().compile().assemblies({"a": a}, fixed="a")
    expected = by_triangles(a)
    assert len(found) == 2
    for b, c in expected:
        assert any(near(x[1], b) and near(x[2], c) and x[0] == a for x in found)


def test_the_nearest_position_is_taken_and_rates_follow() -> None:
    dyn = four_bar().compile()
    b, c = by_triangles(1.0)[0]
    q, v = dyn.assemble({"a": 1.0, "b": b + 0.2, "c": c - 0.2}, {"a'": 2.0}, fixed="a")
    assert near(q[1], b) and near(q[2], c) and q[0] == 1.0 and v[0] == 2.0
    h = 1e-6
    (b1, c1), (b0, c0) = by_triangles(1.0 + h)[0], by_triangles(1.0 - h)[0]
    assert v[1:] == pytest.approx([(b1 - b0) / h, (c1 - c0) / h], rel=1e-7)
    assert max(map(abs, dyn.residual(q, v)["velocity"].values())) < 1e-14


def test_rates_that_satisfy_the_rows_need_no_program_that_moves_them() -> None:
    model = four_bar().model
    assembler, q = assembler_of(model, ("a",)), np.array([1.0, *by_triangles(1.0)[0]])
    p = np.array([x.value for x in model.parameters], float)
    assert assembler.velocity(q, np.zeros(3), p) == pytest.approx(0.0, abs=0)
    assert "closing" not in vars(assembler)
    assert np.abs(assembler.velocity(q, np.array([1.0, 0.0, 0.0]), p)[1:]).max() > 0.1
    assert "closing" in vars(assembler)


def test_from_the_flat_position_of_all_zeros_a_way_out_is_found() -> None:
    dyn = four_bar().compile()
    q, _ = dyn.assemble(None)
    assert max(map(abs, dyn.residual(q)["position"].values())) < 1e-12


def test_least_motion_is_measured_by_the_mass_matrix() -> None:
    """A bead of unequal inertias on x = y: the guess moves along M⁻¹ Aᵀ, so that m₁ x + m₂ y is kept."""
    s = lg.System("two masses")
    x, y = s.coordinates("x y")
    s.kinetic(x.diff() ** 2 / 2 + 3 * y.diff() ** 2 / 2)
    s.constraint(x - y, name="together")
    q, v = s.compile().assemble([1.0, 5.0], [2.0, -2.0])
    assert q == pytest.approx([4.0, 4.0]) and v == pytest.approx([-1.0, -1.0])
    none = np.array([])
    assert seen_position(s.model, np.array([1.0, 5.0]), none) == pytest.approx([4.0, 4.0])
    assert seen_velocity(s.model, q, np.array([2.0, -2.0]), none) == pytest.approx([-1.0, -1.0])


def test_a_picture_closes_loops_by_numbers_as_a_run_does_by_its_elimination(monkeypatch: pytest.MonkeyPatch) -> None:
    """Dense matrices against the compiled elimination, from a guess whose first step turns by more than 1 rad."""
    s = four_bar()
    p = np.array([s.model.values[x.symbol] for x in s.model.parameters])
    for fixed, q in (((), np.array([0.1, 2.9, -2.0])), (("a",), np.array([0.8, 2.0, -0.5]))):
        expected = assembler_of(s.model, fixed).position(q, p)
        with monkeypatch.context() as held:
            held.setattr(assemble, "assembler_of", None)
            assert seen_position(s.model, q, p, fixed) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize(("name", "fixed"), [("four-bar", ()), ("four-bar", ("a",)), ("rolling-disc", ())])
def test_rates_by_numbers_are_those_of_the_elimination(
    name: str, fixed: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    model = four_bar().model if name == "four-bar" else built_in.system(name).model
    p = np.array([x.value for x in model.parameters], float)
    q = seen_position(model, np.linspace(0.2, 0.7, len(model.coordinates)), p, fixed)
    v = np.linspace(-1.0, 1.0, len(model.velocities))
    expected = assembler_of(model, fixed).velocity(q, v, p)
    monkeypatch.setattr(assemble.Assembler, "velocity", None)
    assert seen_velocity(model, q, v, p, fixed) == pytest.approx(expected, abs=1e-12)


@pytest.mark.slow
def test_what_cannot_close_is_named_with_its_gap() -> None:
    dyn = four_bar().compile()
    with pytest.raises(RunError, match=r"E304.*'loop' by") as caught:
        dyn.assemble({"a": 1.0}, fixed="a", p={"l2": 0.1, "l3": 0.1})
    assert "look at the lengths" in str(caught.value)


def test_a_constraint_without_a_value_at_the_guess_is_named() -> None:
    s = lg.System("root")
    x = s.coordinate("x")
    s.particle(1.0, at=s.point("P", (x, 0)))
    s.constraint(sp.sqrt(x) - 1, name="root")
    with pytest.raises(lg.RunError, match="'root' has no finite value near the guess"):
        s.simulate(0.1, x=-1.0)
    assert s.simulate(0.1, x=0.5)["x"][-1] == pytest.approx(1.0, abs=1e-12)


def test_where_no_single_coordinate_keeps_a_loop_open_fewer_are_to_be_held() -> None:
    """Three angles far from any loop: one alone does not close it, all of them do."""
    with pytest.raises(RunError) as caught:
        four_bar().compile().assemble({"a": 1.0, "b": 2.5, "c": -2.5}, fixed=["a", "b", "c"])
    assert caught.value.code == "E304" and "hold fewer coordinates fixed" in str(caught.value)


def test_the_coordinate_that_keeps_a_loop_open_is_named() -> None:
    dyn = four_bar().compile()
    b, c = by_triangles(1.0)[0]
    with pytest.raises(RunError, match=r"do not hold .*b") as caught:
        dyn.assemble({"a": 1.0, "b": b + 0.3, "c": c}, fixed=("a", "b"))
    assert caught.value.code == "E304"


def test_rates_that_contradict_a_constraint_are_refused() -> None:
    s = lg.System("driven")
    x, y = s.coordinates("x y")
    s.particle(1, at=s.origin + (x, y))
    s.constraint(x - sp.sin(s.t), name="drive")
    dyn = s.compile()
    q, v = dyn.assemble({"y": 1.0}, {"y'": 0.3}, t=0.5)
    assert q == pytest.approx([math.sin(0.5), 1.0]) and v == pytest.approx([math.cos(0.5), 0.3])
    with pytest.raises(RunError, match=r"E305.*'drive'.*x fixed"):
        dyn.assemble({"x": math.sin(0.5), "y": 1.0}, {"x'": 0.0}, t=0.5, fixed="x")


def test_lengths_are_not_taken_for_angles() -> None:
    """A bob on a rod of 20 m: positions 2π apart are not one, and steps are not cut to 1."""
    s = lg.System("long pendulum")
    x, y = s.coordinates("x y")
    s.particle(1, at=s.origin + (x, y))
    s.constraint(between=(s.origin + (x, y), s.origin), distance=20, name="rod")
    dyn = s.compile()
    q, _ = dyn.assemble([300.0, -400.0])
    assert q == pytest.approx([12.0, -16.0])


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda d: d.assemble({"z": 1}), "there is no 'z' in q"),
        (lambda d: d.assemble([1, 2]), "3 finite numbers"),
        (lambda d: d.assemble([1, 2, math.nan]), "3 finite numbers"),
        (lambda d: d.assemble(None, fixed="theta"), "no coordinate 'theta'"),
        (lambda d: d.assemble(None, p={"l9": 1}), "no parameter 'l9'"),
    ],
)
def test_what_does_not_fit_is_said(call, said: str) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(RunError, match=said):
        call(four_bar().compile())


def test_a_system_without_constraints_says_so() -> None:
    s = lg.System("free")
    s.particle(1, at=s.origin + (s.coordinates("x"), 0))
    with pytest.raises(RunError, match="has no constraints"):
        s.compile().multipliers([0.0], [0.0])


def test_the_tension_of_a_rod() -> None:
    """Bob on a rod: −λ = m g cos θ + m l θ'²."""
    s = lg.System("pendulum in x, y")
    x, y = s.coordinates("x y")
    m, length, g = s.parameters("m l g", m=1.5, l=2.0, g=9.81)
    bob = s.point("P", (x, y))
    s.particle(m, at=bob)
    s.gravity(g=g)
    s.constraint(between=(bob, s.origin), distance=length, name="rod")
    dyn = s.compile()
    theta = np.array([0.3, -1.1, 2.0])
    rate = np.array([0.5, 2.0, -3.0])
    q = 2.0 * np.stack([np.sin(theta), -np.cos(theta)], axis=-1)
    v = 2.0 * rate[:, None] * np.stack([np.cos(theta), np.sin(theta)], axis=-1)
    tension = 1.5 * 9.81 * np.cos(theta) + 1.5 * 2.0 * rate**2
    assert -dyn.multipliers(q, v)["rod"] == pytest.approx(tension, rel=1e-13)
    assert dyn.margin(q) == pytest.approx(np.ones(3))
    assert dyn.constraint_matrix(q)[:, 0] == pytest.approx(q / 2.0)


def test_what_a_guess_by_name_leaves_out_begins_as_a_run_does() -> None:
    """A free body held at a point of its own 1 m off its origin: the quaternion left out is (0, 0, 0, 1), not 0."""
    s = lg.System("hung body")
    body = s.floating_frame("b")
    s.rigid_body(2, (1, 1, 1), at=body.origin, frame=body)
    s.ball((body.point(0, 0, 1), s.origin), name="hook")
    q, _ = s.compile().assemble({"b_z": -1.0})
    assert q == pytest.approx([0, 0, -1, 0, 0, 0, 1])
