"""Rows given twice are left out by name; rows that contradict each other are refused by name."""

import numpy as np
import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.dynamics import ordering
from lagrangian.errors import ModelError


def bob() -> lg.System:
    s = lg.System("bob")
    x, y = s.coordinates("x y")
    s.parameters("l k", l=2.0, k=1.0)
    s.particle(1, at=s.point("P", (x, y)))
    s.gravity()
    return s


def test_a_row_given_twice_is_left_out_by_name() -> None:
    s = bob()
    s.constraint(s["x"] - s["l"], name="wall")
    s.constraint(2 * s["x"] - 2 * s["l"], name="again")
    (notice,) = s.notices
    assert notice.code == "E306" and "again" in str(notice)
    dyn = s.compile()
    assert dyn.forward([2.0, 0.0], [0.0, 1.0]) == pytest.approx([0.0, -9.81])
    lam = dyn.multipliers([2.0, 0.0], [0.0, 1.0])
    assert lam["wall"] == pytest.approx(0.0) and lam["again"] == 0.0
    assert dyn.margin([2.0, 0.0]) == pytest.approx(1.0)


def test_the_first_elimination_that_succeeds_tells_which_rows_are_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    """A search for the cheapest one would count operations."""
    s = bob()
    s.constraint(s["x"] - s["l"], name="wall")
    s.constraint(2 * s["x"] - 2 * s["l"], name="again")
    monkeypatch.setattr(ordering, "count_operations", None)
    assert [n.where for n in s.notices] == ["constraint 'again'"]


def test_the_third_of_three_rows_on_two_coordinates_is_left_out() -> None:
    s = bob()
    x, y = s["x"], s["y"]
    s.constraint(x, name="a")
    s.constraint(y, name="b")
    s.constraint(x - y, name="c")
    (notice,) = s.notices
    assert notice.where == "constraint 'c'" and "what 'a' and 'b' say together" in notice.text
    dyn = s.compile()
    assert dyn.forward([0.0, 0.0], [0.0, 0.0]) == pytest.approx([0.0, 0.0])
    assert dyn.multipliers([0.0, 0.0], [0.0, 0.0])["b"] == pytest.approx(9.81)


def test_accelerations_that_contradict_each_other_are_refused_by_name() -> None:
    s = bob()
    x = s["x"]
    s.velocity_constraint(x.diff() - s["k"] * s.t, name="pulled")
    s.velocity_constraint(x.diff() - 2 * s["k"] * s.t, name="pulled twice")
    with pytest.raises(ModelError, match="'pulled twice' contradicts 'pulled'") as caught:
        s.compile()
    assert caught.value.code == "E302"


def test_rates_that_contradict_each_other_are_refused_by_name() -> None:
    s = bob()
    s.velocity_constraint(s["x"].diff() - s["k"], name="one")
    s.velocity_constraint(s["x"].diff() - 2 * s["k"], name="two")
    with pytest.raises(ModelError, match="'two' contradicts 'one'"):
        s.compile()


def test_positions_that_contradict_each_other_close_nowhere() -> None:
    s = bob()
    s.constraint(s["x"] - 1, name="a")
    s.constraint(s["x"] - 2, name="b")
    s.constraint(s["y"], name="c")
    with pytest.raises(lg.Error, match=r"E304.*'b' by 1") as caught:
        s.compile().assemble(None)
    assert caught.value.fix == "'b' contradicts 'a': leave one of them out, or change one so that both can hold"


@pytest.mark.slow
def test_power_of_a_constraint_that_moves() -> None:
    """x = A sin ωt: the drive does the work of ½ m ẋ², and the audit knows it."""
    s = bob()
    A, w = s.parameter("A", "0.5 m"), s.parameter("w", "2 rad/s")
    s.constraint(s["x"] - A * sp.sin(w * s.t), name="drive")
    run = s.simulate(3.0, initial={"x'": 1.0})
    assert run.success and run.audit.figure < 1e-9
    assert run["x"] == pytest.approx(0.5 * np.sin(2 * run.t), abs=1e-9)


@pytest.mark.parametrize("angle", [0.0, 1e-9, 0.3])
def test_a_massless_angle_gets_its_inertia_from_all_its_rows(angle: float) -> None:
    """A cart and a bob with X, Y of its own, joined by two rows in a massless θ: the equations of the cart-pole."""
    s = lg.System("cart-pole in too many coordinates")
    x, X, Y, theta = s.coordinates("x X Y theta")
    M, m, length = s.parameters("M m l", M=2.0, m=0.5, l=0.7)
    s.particle(M, at=s.origin + (x, 0))
    s.particle(m, at=s.origin + (X, Y))
    s.gravity(g=9.81)
    s.constraint(X - x - length * sp.sin(theta), name="cx")
    s.constraint(Y - length * sp.cos(theta), name="cy")
    c, sine = np.cos(angle), np.sin(angle)
    a = s.compile().forward([0, 0.7 * sine, 0.7 * c, angle], [0, 0, 0, 0])
    mass = np.array([[2.5, 0.35 * c], [0.35 * c, 0.245]])
    expected = np.linalg.solve(mass, [0.0, 0.35 * 9.81 * sine])
    assert a[[0, 3]] == pytest.approx(expected, rel=1e-9, abs=1e-16)
