"""Linearizations of systems with constraints: closed forms, published eigenvalues, and the same system without them."""

import numpy as np
import pytest
import sympy as sp

import built_in
import lagrangian as lg
from constrained_systems import G, cart_pole, disc, rod, sleigh, slider_crank
from lagrangian.errors import RunError
from lagrangian.linear.manifold import pivots


def test_a_rod_pendulum_swings_with_the_root_of_g_over_l() -> None:
    found = rod().linearize({"y": -1.5})
    assert found.states == ("x", "x'") and found.kind == "rest"
    assert np.abs(found.poles - np.array([1j, -1j]) * np.sqrt(G / 1.5)).max() < 1e-14
    assert found.stability.verdict == "stable"
    assert found.multipliers["rod"] == pytest.approx(-2 * G, rel=1e-14)  # a tension: λ pushes the ends apart
    assert found.modes[0].shape == {"x": 1, "y": 0}
    assert found.basis is not None and np.abs(found.basis - [[1, 0], [0, 0], [0, 1], [0, 0]]).max() == 0
    above = rod().linearize({"y": 1.5})
    assert np.abs(np.sort(above.poles.real) - np.array([-1, 1]) * np.sqrt(G / 1.5)).max() < 1e-14
    said = str(found)
    assert "The constraints leave 2 of 4 states independent" in said and "rod   −19.62" in said
    assert found.to_dict()["all_states"] == ["x", "y", "x'", "y'"]


@pytest.mark.slow
def test_redundant_coordinates_change_no_linearization() -> None:
    plain, found = cart_pole(redundant=False).linearize(), cart_pole(redundant=True).linearize({"Y": 0.7})
    assert found.states == plain.states
    for name in ("A", "B", "mass", "damping", "stiffness", "input_matrix"):
        ours, theirs = getattr(found, name), getattr(plain, name)
        assert np.abs(ours - theirs).max() < 1e-13 * max(1.0, np.abs(theirs).max())
    assert np.abs(found.C - [[1, 0, 0, 0], [0, 1, 0, 0], [1, 0.7, 0, 0], [0, 0, 0, 0]]).max() < 1e-15
    assert found.stability.verdict == plain.stability.verdict == "unstable"
    assert found.controllability.complete
    regulator = found.lqr({"theta": 1, "x": 2}, 1)
    assert np.abs(regulator.K - plain.lqr({"theta": 1, "x": 2}, 1).K).max() < 1e-11
    assert {str(x) for x in next(iter(regulator.law.values())).atoms(sp.Function)} == {"x(t)", "theta(t)"}


@pytest.mark.slow
def test_a_rolling_disc_is_stable_above_the_critical_speed() -> None:
    """φ̇² > m g r I/(K (K + m r²)): Neimark and Fufaev (1972), ch. V; poles by their linear equations."""
    system, n = disc()
    full = n["K"] + n["m"] * n["r"] ** 2
    critical = np.sqrt(n["m"] * G * n["r"] * n["I"] / (n["K"] * full))
    for speed in (0.5 * critical, 0.95 * critical, 1.05 * critical, 2 * critical):
        found = system.linearize({"phi'": speed, "x'": n["r"] * speed})
        assert found.kind == "steady motion" and found.states[5:] == ("x'", "psi'", "theta'")
        square = (n["m"] * G * n["r"] - full * n["K"] * speed**2 / n["I"]) / (n["I"] + n["m"] * n["r"] ** 2)
        root = np.sqrt(complex(square))
        assert min(abs(found.poles - root)) < 1e-11 * abs(root) and min(abs(found.poles + root)) < 1e-11 * abs(root)
        assert found.stability.verdict == ("unstable" if speed < critical else "marginal")


@pytest.mark.slow
def test_the_benchmark_bicycle_has_its_published_eigenvalues() -> None:
    """Meijaard, Papadopoulos, Ruina and Schwab, Proc. R. Soc. A 463 (2007) 1955–1982, table 2."""
    bicycle = built_in.system("whipple-bicycle")
    still = bicycle.linearize()
    assert still.kind == "rest"
    for pole in (3.13164324790656, 5.53094371765393):
        assert min(abs(still.poles - pole)) < 1e-11 and min(abs(still.poles + pole)) < 1e-11
    radius = {p.name: p.value for p in bicycle.model.parameters}
    speed = {"x'": 5.0, "theta_r'": 5.0 / radius["r_r"], "theta_f'": 5.0 / radius["r_f"]}
    found = bicycle.linearize(speed)
    assert found.kind == "steady motion" and set(found.states) >= {"phi", "delta", "phi'", "delta'"}
    for pole in (-14.07838969279822, -0.775341882195845 + 4.46486771378823j, -0.322866429004087):
        assert min(abs(found.poles - pole)) < 1e-11
    assert sum(abs(found.poles) < 1e-9) == len(found.poles) - 4
    assert found.multipliers["front wheel on the ground"] > 0


def test_slopes_are_those_of_assembled_neighbours() -> None:
    system = slider_crank()
    compiled = system.compile()
    guess = {"phi": 1.0, "psi": -0.3, "x": 0.17, "phi'": 20}
    found = system.linearize(guess, fixed=["phi"], operating_point=True)
    assert found.states == ("phi", "phi'") and found.notes[0].startswith("moved onto the constraints")

    def rates(phi: float, speed: float) -> np.ndarray:
        at = {name: found.at[name] for name in ("phi", "psi", "x")}
        q, v = compiled.assemble({**at, "phi": phi}, {"phi'": speed}, fixed="phi")
        return compiled.rhs(0.0, np.concatenate([q, v]))[[0, 3]]

    h = 1e-5
    slopes = [
        (rates(1 + h, 20) - rates(1 - h, 20)) / (2 * h),
        (rates(1, 20 + h) - rates(1, 20 - h)) / (2 * h),
    ]
    assert np.abs(found.A - np.array(slopes).T).max() < 1e-6 * np.abs(found.A).max()
    assert np.abs(found.drift - rates(1, 20)).max() < 1e-10 * np.abs(found.drift).max()


def test_a_point_must_satisfy_the_constraints() -> None:
    system = rod()
    with pytest.raises(RunError, match="does not satisfy the constraints: the nearest point that does has") as error:
        system.linearize({"x": 0.1, "y": -1.4})
    assert error.value.code == "E521" and "fixed='x'" in error.value.fix
    assert system.linearize({"y": -1.4}, fixed="x").at["y"] == pytest.approx(-1.5, rel=1e-15)
    assert system.linearize({"x": 1e-5, "y": -1.50001}).at["x"] == pytest.approx(0, abs=1e-12)
    with pytest.raises(RunError, match="not an equilibrium"):
        system.linearize({"x": 0.1, "y": -1.4}, fixed=["x"])
    with pytest.raises(RunError, match="no coordinate 'z' to hold fixed"):
        system.linearize({"y": -1.5}, fixed="z")
    with pytest.raises(RunError, match="has no constraints"):
        built_in.system("pendulum").linearize(fixed="theta")
    with pytest.raises(RunError, match="symbolic matrices are not available for systems with constraints"):
        _ = system.linearize({"y": -1.5}).symbolic


def test_constraints_that_move_leave_no_rest() -> None:
    s = rod()
    s.constraint(s.model.coordinates[0].symbol - sp.sin(sp.Symbol("t")) / 10, name="drive")
    with pytest.raises(RunError, match="constraints move with time") as error:
        s.linearize({"y": -1.5}, fixed=())
    assert error.value.code == "E521"
    assert s.linearize({"y": -1.5}, fixed=(), operating_point=True).states == ()


@pytest.mark.slow
def test_a_position_with_more_than_one_way_on_has_no_linearization() -> None:
    s = lg.System("parallelogram")
    l = s.parameter("l", 1.0)
    a, b, c = (s.coordinate(n) for n in "abc")
    P = s.origin + (l * sp.cos(a), l * sp.sin(a))
    Q = P + (2 * l * sp.cos(b), 2 * l * sp.sin(b))
    R = s.origin + (2 * l + l * sp.cos(c), l * sp.sin(c))
    for k, point in enumerate((P, Q, R)):
        s.particle(1.0, at=point, name=f"p{k}")
    s.constraint(between=(Q, R), name="coupler")
    with pytest.raises(RunError, match="depend on each other at a = 0") as error:
        s.linearize()
    assert error.value.code == "E525"
    assert len(s.linearize({"a": 0.7, "c": 0.7}).states) == 2


def test_a_knife_edge_restricts_a_speed_and_no_coordinate() -> None:
    found = sleigh().linearize({"theta": np.pi / 2})
    assert found.states == ("x", "y", "theta", "y'", "theta'") and found.mass is None
    assert found.multipliers["edge"] == pytest.approx(3.0)  # −sin θ λ = −w holds the sleigh on the slope
    assert np.abs(found.A[3] - [0, 0, -3.0 / 1.5, 0, 0]).max() < 1e-14  # y'' = −w/m δθ along the edge


def test_independent_states_along_a_run() -> None:
    system = rod(1.0)
    run = system.simulate(0.5, initial={"y": -1.0, "x'": 1.0}, samples=6)
    found = system.linearize_along(run)
    assert found.states == ("x", "x'") and found.A.shape == (6, 2, 2) and found.C.shape == (6, 2, 2)
    x = dict(zip(("x", "y", "x'", "y'"), run.y[:, -1], strict=True))
    single = system.linearize(x, operating_point=True)
    assert np.abs(found.A[-1] - single.A).max() < 1e-11
    assert found.basis is not None and found.to_dict()["basis"] == found.basis.tolist()
    around = system.simulate(3.0, initial={"y": -1.0, "x'": 9.0}, samples=600)
    with pytest.raises(RunError, match="no choice of independent states"):
        system.linearize_along(around)
    with pytest.raises(RunError, match="does not satisfy the constraints"):
        system.linearize_along(([0.0], [[0.3, -1.0, 0.0, 0.0]]))


def test_rows_are_solved_for_clear_entries_in_order() -> None:
    assert pivots(np.array([[1.0, 2.0, 0.01]]), [2, 1, 0]) == [1]
    assert pivots(np.array([[1.0, 0, 1], [2.0, 0, 2]]), [2, 1, 0]) == [2]
    assert sorted(pivots(np.array([[1.0, 0, 1], [0.0, 1, 1e-3]]), [2, 1, 0])) == [1, 2]
    assert pivots(np.zeros((2, 3)), [0, 1, 2]) == []


def test_what_rolling_ties_together_is_what_inputs_do_not_reach() -> None:
    """Upright, x − r (φ_l + φ_r)/2 and ψ + r (φ_l − φ_r)/2w are constant, and y as nothing moves sideways."""
    found = built_in.system("balancing-robot").linearize().controllability
    r, w = 0.08, 0.15
    assert (found.rank, found.order) == (6, 9)
    expected = [
        {"x": 1.0, "phi_l": -r / 2, "phi_r": -r / 2},
        {"y": 1.0},
        {"psi": 1.0, "phi_l": r / (2 * w), "phi_r": -r / (2 * w)},
    ]
    assert [m.combination.keys() for m in found.missing] == [e.keys() for e in expected]
    for m, e in zip(found.missing, expected, strict=True):
        assert m.pole == 0 and m.times == 3
        assert [m.combination[k] for k in e] == pytest.approx(list(e.values()), rel=1e-12)


@pytest.mark.slow
def test_what_rounding_leaves_of_0_is_0() -> None:
    """Of Whipple's bicycle no acceleration depends on where it stands, where it heads, or on how far wheels turned."""
    linear = built_in.system("whipple-bicycle").linearize()
    idle = [k for k, name in enumerate(linear.states) if name in ("x", "y", "psi", "theta_r", "theta_f")]
    assert len(idle) >= 4 and (linear.A[:, idle] == 0).all()
    missing = linear.controllability.missing
    assert {m.pole for m in missing} == {0} and missing[0].times == linear.controllability.order - 4
    for m in missing:  # Popov, Belevitch, Hautus
        left = np.array([m.combination.get(name, 0.0) for name in linear.states])
        assert np.abs(left @ linear.B).max() < 1e-9 * np.abs(linear.B).max()
    plain = {frozenset(m.combination) for m in missing}
    assert frozenset({"y"}) in plain and frozenset({"x'"}) in plain


@pytest.mark.sampled(4)
@pytest.mark.parametrize("seed", range(4))
def test_other_last_digits_of_a_matrix_leave_its_report_as_it_is(seed: int) -> None:
    """The entries of A and B of a system with a pole 0 that counts six times, each moved by its rounding error."""
    from lagrangian.linear.reach import controllable

    linear = built_in.system("whipple-bicycle").linearize()
    source = np.random.default_rng(seed)
    A, B = (a * (1 + 1e-15 * source.uniform(-1, 1, a.shape)) for a in (linear.A, linear.B))
    found, expected = controllable(A, B, linear.states), linear.controllability
    assert [m.combination.keys() for m in found.missing] == [m.combination.keys() for m in expected.missing]
    for mine, other in zip(found.missing, expected.missing, strict=True):
        assert list(mine.combination.values()) == pytest.approx(list(other.combination.values()), rel=1e-9)
