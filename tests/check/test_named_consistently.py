"""What is told of a wrong answer contradicts none of its other lines: right equations above, definitions, other forces.

Oracle: the equations of a pulley with a hoop, of a cart with a pole and of two sliders, by hand.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from built_in import derivation
from student_answers import CART, POLE


def told(d: lg.Derivation, answer: str) -> list[str]:
    """What is told, in words."""
    found = d.check(answer)
    assert found.status == "wrong"
    return [str(m.what) for m in found.mistakes]


SOLVED = "x'' = (F - b x' + {} m l theta'^2 sin theta - m l theta'' cos theta)/(M + m)"


def test_below_right_equations_a_slip_is_told_as_it_is_written() -> None:
    """The weight of the pole is right in the equations above, so that its sign in V is no cause."""
    rows = f"{CART}\n{POLE}"
    assert derivation("cart-pole").check(f"{rows}\n{SOLVED.format('')}", hint=0).right
    (said,) = told(derivation("cart-pole"), f"{rows}\n{SOLVED.format('2')}")
    assert "m*l*sin(theta)*theta'^2" in said.replace("l*m", "m*l"), said


def test_a_slip_in_solving_two_equations_is_no_wrong_energy() -> None:
    """(J + m l²)(M + m) − m² l² cos² θ divided by J + m l², with the weight's term of the wrong sign."""
    below = "/(M + m - m^2 l^2 cos(theta)^2/(J + m l^2))"
    first = "F - b x' + m l theta'^2 sin theta"
    row = f"x'' = ({first} {{}} m^2 l^2 g sin(theta) cos(theta)/(J + m l^2)){below}"
    assert derivation("cart-pole").check(f"{CART}\n{POLE}\n{row.format('-')}", hint=0).right
    found = told(derivation("cart-pole"), f"{CART}\n{POLE}\n{row.format('+')}")
    assert not any("in V" in x for x in found) and all("wrong sign" in x for x in found), found


@cache
def wheel() -> lg.Derivation:
    """A solid wheel on a spring that rolls, with its centre at the height r."""
    s = lg.System("wheel")
    x = s.coordinates("x")
    m, k = s.parameters("m k")
    r = s.parameter("r", unit="m")
    s.rigid_body(m, m * r**2 / 2, at=s.point("C", (x, r)), frame=s.frame(-x / r), name="wheel")
    s.spring(k, deflection=x)
    return s.derive()


def test_a_moment_of_inertia_that_is_stated_is_told_and_no_other_cause() -> None:
    (said,) = told(wheel(), "J = m r^2\nomega = x'/r\nT = 1/2 m x'^2 + 1/2 m x'^2\n2 m x'' + k x = 0")
    assert "moment of inertia" in said and "m*r^2" in said and "½" not in said, said


def test_where_nothing_tells_which_of_two_causes_it_was_both_are_told() -> None:
    (said,) = told(wheel(), "omega = x'/r\nT = m x'^2\n2 m x'' + k x = 0")
    assert said.startswith("Either this") and "moment of inertia" in said


@cache
def sliders() -> lg.Derivation:
    """Two sliders in crossed guides with a motor on each."""
    s = lg.System("sliders")
    p, q = s.coordinates("p q")
    a, b, l = s.parameters("a b l")
    M, N = s.inputs("M N")
    s.particle(a, at=s.point("A", (l * sp.sin(p), 0)), name="A")
    s.particle(b, at=s.point("B", (0, l * sp.cos(q))), name="B")
    s.force(M, deflection=p)
    s.force(N, deflection=q)
    return s.derive()


def test_a_force_in_the_wrong_equation_is_not_called_missing() -> None:
    found = told(sliders(), "Xi_p = 0\nXi_q = N + M")
    assert len(found) == 1 and not found[0].startswith("Force 'M' is missing."), found


def test_speeds_that_are_stated_are_told_before_masses_that_are_exchanged() -> None:
    answer = "v_A = l*q'*sin(q)\nv_B = l*p'*cos(p)\nT = a*v_A^2/2 + b*v_B^2/2"
    found = told(sliders(), answer)
    assert len(found) == 2 and all("speed" in x for x in found), found


def test_a_cause_of_a_later_line_is_no_first_word_where_the_first_line_is_open() -> None:
    """Both wrong in many terms: what differs in the first equation is said before what explains the second alone."""
    rows = "(2 M + 3 m) x'' + 5 m l theta'' - 7 b x' + 4 J = F\n" + POLE.replace("- m g", "+ m g")
    verdict = derivation("cart-pole").check(rows)
    assert verdict.mistakes and not verdict.sure


ENERGIES = """T = 1/2 M x'^2 + 1/2 m (x'^2 + 2 l x' theta' cos theta + l^2 theta'^2) + 1/2 J theta'^2
V = m g l cos theta
"""
ROWS = f"""dT/dx' = (M + m) x' + {{0}} m l theta' cos theta
(M + m) x'' + {{1}} m l theta'' cos theta - {{1}} m l theta'^2 sin theta = F - b x'
{POLE}"""


@pytest.mark.sampled(2)
@pytest.mark.parametrize("wrong", [2, sp.Rational(1, 2)])
def test_what_follows_from_a_wrong_derivative_of_a_right_T_is_marked_so(wrong: int) -> None:
    d = derivation("cart-pole")
    assert d.check(ENERGIES + ROWS.format(1, 1), hint=0).right
    verdict = d.check(ENERGIES + ROWS.format(wrong, wrong))
    assert [f.follows for f in verdict.findings if f.status == "wrong"] == [False, True]
    (said,) = (" ".join(str(m.what).split()) for m in verdict.mistakes)
    assert said.startswith("In ∂T*/∂x'") and "2 too much" in said, said


def test_another_mistake_below_a_wrong_derivative_of_T_does_not_follow() -> None:
    verdict = derivation("cart-pole").check(ENERGIES + ROWS.format(2, 3))
    assert [f.follows for f in verdict.findings if f.status == "wrong"] == [False, False]
