"""Right equations in every shape are right, wrong ones are wrong; the oracle is SymPy's LagrangesMethod."""

from typing import Any

import pytest
import sympy as sp
from sympy.physics.mechanics import LagrangesMethod, dynamicsymbols

from lagrangian import System
from lagrangian.check import AnsweredLine, Status, check


def lines(*rows: sp.Expr) -> list[AnsweredLine]:
    return [AnsweredLine("equation", r, i) for i, r in enumerate(rows, 1)]


def cart_and_pendulum() -> tuple[Any, list[sp.Expr]]:
    """A pendulum on a cart with a spring, derived here, and by SymPy from energies written by hand."""
    s = System("cart and pendulum")
    x, theta = s.coordinates("x theta")
    M, m, L, k, b, g = s.parameters("M m L k b g")
    F = s.input("F")
    P = s.origin + (x, 0)
    s.particle(M, at=P, name="cart")
    s.particle(m, at=P + (L * sp.sin(theta), -L * sp.cos(theta)), name="bob")
    s.gravity(g=g)
    s.spring(k, deflection=x)
    s.damper(b, deflection=x)
    s.force((F, 0), at=P)
    t = dynamicsymbols._t
    vx, w = x.diff(t), theta.diff(t)
    T = M * vx**2 / 2 + m * (vx**2 + 2 * L * vx * w * sp.cos(theta) + L**2 * w**2) / 2
    V = k * x**2 / 2 - m * g * L * sp.cos(theta)
    rows = LagrangesMethod(T - V, [x, theta]).form_lagranges_equations()
    return s.derive(), [rows[0] - F + b * vx, rows[1]]


D, ROWS = cart_and_pendulum()
X, THETA = D.coordinates
M, m, L, k, b, g = (p.symbol for p in D.model.parameters)


def test_right_as_it_is() -> None:
    verdict = check(D, lines(*ROWS))
    assert verdict.status is Status.RIGHT
    assert verdict.right


def test_the_other_side_of_the_equals_sign_does_not_matter() -> None:
    assert check(D, lines(-ROWS[0], ROWS[1])).status is Status.RIGHT


@pytest.mark.parametrize("factor", [2, m, 1 / (m * L**2), -3 * M / L])
def test_scaled(factor: Any) -> None:
    verdict = check(D, lines(ROWS[0], ROWS[1] * factor))
    assert verdict.status is Status.EQUIVALENT
    assert verdict.combination is not None
    assert sp.simplify(verdict.combination[1][1] - factor) == 0


def test_reordered() -> None:
    verdict = check(D, lines(ROWS[1], ROWS[0]))
    assert verdict.status is Status.EQUIVALENT
    assert [f.coordinate for f in verdict.findings] == ["theta", "x"]


def test_combined() -> None:
    verdict = check(D, lines(ROWS[0] + 2 * ROWS[1] / L, ROWS[1]))
    assert verdict.right


def test_expanded_factored_and_in_other_identities() -> None:
    rows = [sp.expand(r) for r in ROWS]
    rows[1] = rows[1].subs(sp.sin(THETA), 2 * sp.sin(THETA / 2) * sp.cos(THETA / 2))
    assert check(D, lines(*rows)).status is Status.RIGHT


def test_solved_for_the_accelerations() -> None:
    a = [X.diff().diff(), THETA.diff().diff()]
    solved = sp.solve(ROWS, a)
    verdict = check(D, lines(*(q - solved[q] for q in a)))
    assert verdict.status is Status.SAME_MOTION
    assert verdict.right


@pytest.mark.slow
def test_a_tiny_change_of_a_coefficient_is_wrong() -> None:
    for size in (sp.Rational(1, 10**6), sp.Rational(1, 10**12), sp.Rational(1, 10**20)):
        assert check(D, lines(ROWS[0], ROWS[1] + size * m * g * L * sp.sin(THETA))).status is Status.WRONG


def test_equal_at_special_points_only_is_wrong() -> None:
    rows = [ROWS[0], ROWS[1].subs(sp.sin(THETA), THETA)]
    assert check(D, lines(*rows)).status is Status.WRONG
    rows = [ROWS[0] + sp.sin(2 * sp.pi * X / L) * M, ROWS[1]]
    assert check(D, lines(*rows)).status is Status.WRONG


def test_said_twice_is_incomplete() -> None:
    assert check(D, lines(ROWS[0], ROWS[0])).status is Status.INCOMPLETE
    assert check(D, lines(ROWS[0], ROWS[0] - ROWS[0] + 0)).status is Status.INCOMPLETE
    assert check(D, lines(ROWS[0])).status is Status.INCOMPLETE


def test_said_once_more_than_needed_is_right() -> None:
    assert check(D, lines(*ROWS, ROWS[0] + ROWS[1] / L)).right


def test_the_product_of_two_equations_says_nothing() -> None:
    verdict = check(D, lines(ROWS[0] * ROWS[1], ROWS[1]))
    assert verdict.status is Status.INCOMPLETE
    assert check(D, lines(ROWS[0] * (1 + X**2) + ROWS[1] * sp.cos(THETA), ROWS[1])).status is Status.SAME_MOTION


def test_identities_the_normal_form_does_not_know_are_decided_with_many_digits() -> None:
    other = ROWS[1].subs(sp.sin(THETA), sp.cos(THETA) * sp.tan(THETA))
    assert check(D, lines(ROWS[0], other)).right
    assert check(D, lines(ROWS[0], other + sp.Rational(1, 10**20) * m * g * L * THETA)).status is Status.WRONG


def test_a_wrong_line_is_named_with_its_term_and_its_element() -> None:
    wrong = ROWS[1] - 2 * m * g * L * sp.sin(THETA)
    verdict = check(D, lines(ROWS[0], wrong))
    assert verdict.status is Status.WRONG
    assert verdict.first_wrong is not None and verdict.first_wrong.line.number == 2
    (difference,) = verdict.first_wrong.differences
    assert difference.kind == "sign"
    assert sp.simplify(difference.term - m * g * L * sp.sin(THETA)) == 0
    assert [o.element for o in difference.origins] == ["gravity 'g'"]
    assert [o.step for o in difference.origins] == [3]
