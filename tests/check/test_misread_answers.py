"""Answers that were misread: names of multipliers and angles, labels, lists of energies, loops of programs.

Oracle: by hand, a slider with two equal bobs on both sides of its pin, and two masses on a rope; every wrong twin
differs in one term and stays wrong.
"""

from functools import cache
from typing import Any, cast

import pytest
import sympy as sp

from built_in import derivation
from lagrangian import Derivation, System
from lagrangian.check.reading.plain.rows import AnswerRow, pieces


@cache
def slider() -> Derivation:
    """A slider with a spring, two equal bobs at the distance l on both sides of its pin, and a flywheel."""
    s = System("slider")
    x, alpha = s.coordinates("x alpha")
    M, m, l, k, J, c = s.parameters("M m l k J c")
    F, tau = s.inputs("F tau")
    s.particle(M, at=s.point("A", (x, 0)), name="slider")
    for sign, name in ((1, "bob 1"), (-1, "bob 2")):
        place = (x + sign * l * sp.sin(alpha), -sign * l * sp.cos(alpha))
        s.particle(m, at=s.point(f"P{name[-1]}", place), name=name)
    s.kinetic(J * alpha.diff() ** 2 / 2, name="flywheel")
    s.spring(k, deflection=x)
    s.damper(c, deflection=alpha)
    s.force(F, deflection=x)
    s.torque(tau, on=alpha)
    return s.derive()


@cache
def rod() -> Derivation:
    """Two masses on a rope over a fixed wheel; the letters of the word lambda are parameters."""
    s = System("rope")
    x, y = s.coordinates("x y")
    l, a, m, b, d, k = s.parameters("l a m b d k")
    s.particle(m, at=s.point("A", (x, 0)))
    s.particle(d, at=s.point("B", (0, -y)))
    s.spring(k, deflection=x - a)
    s.damper(b, deflection=x)
    s.gravity(direction=(0, -1))
    s.constraint(x + y - l, name="rope")
    return s.derive()


ROWS = "(M + 2*m)*x'' + k*x = F\n(J + 2*m*l^2)*{a}'' + c*{a}' = tau"


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", ["al", "alp", "alpha"])
def test_two_letters_of_an_angle_are_its_name(name: str) -> None:
    verdict = slider().check(f"T = 1/2*M*x'^2 + m*x'^2 + m*l^2*{name}'^2 + 1/2*J*{name}'^2\n" + ROWS.format(a=name))
    assert verdict.right
    assert all(f.status.right for f in verdict.findings)
    assert not slider().check(ROWS.format(a=name).replace("2*m*l", "m*l")).right


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", ["lambda", "lam", "lmbda"])
def test_the_name_of_a_multiplier_is_no_product(name: str) -> None:
    text = f"with the multiplier {name}\nm x'' + b x' + k (x - a) = {name}\nd y'' - d g = {name}\nx + y = l"
    verdict = rod().check(text)
    assert verdict.right
    wrong = rod().check(text.replace("d g", "2 d g"))
    assert not wrong.right
    assert not any("Products" in str(note) for note in wrong.notes)


def test_a_label_that_is_named_again_is_a_label() -> None:
    text = """(A) m x'' + b x' + k (x - a) = lam
(B) d y'' - d g = lam
(C) x + y = l
Now lam out.
(C) twice differentiated: y'' = -x''
(A'): (m + d) x'' + b x' + k (x - a) + d g = 0"""
    verdict = rod().check(text)
    assert verdict.right
    wrong = rod().check(text.replace("(A'): (m + d)", "(A'): (m + 2 d)"))
    assert [f.line.number for f in wrong.findings if not f.status.right] == [6]


LIST = """Bodies:
  slider    T = 1/2*M*x'^2
  bobs      T = {bobs}
  flywheel  T = 1/2*J*alpha'^2
V = 1/2*k*x^2
"""


@pytest.mark.slow
def test_energies_behind_names_in_a_list_are_parts() -> None:
    right = LIST.format(bobs="m*(x'^2 + l^2*alpha'^2)") + ROWS.format(a="alpha")
    verdict = slider().check(right)
    assert verdict.right
    assert all(f.status.right for f in verdict.findings)
    wrong = slider().check(LIST.format(bobs="m*(x'^2 + l*alpha'^2)") + ROWS.format(a="alpha").replace("m*l^2", "m*l"))
    assert not wrong.right
    assert [f.status.right for f in wrong.findings if f.line.kind == "T"] == [False]  # their sum
    assert not any("missing" in str(x.what) for x in wrong.mistakes[:1])
    whole = slider().check("system T = 1/2*M*x'^2\nV = 1/2*k*x^2\n" + ROWS.format(a="alpha"))
    assert any(f.line.kind == "T" and not f.status.right for f in whole.findings)


CART_POLE = """(M+m) x'' + m l theta'' cos(theta) - m l theta'^2 sin(theta) + b x' = F
(J + m l^2) theta'' + m l x'' cos(theta) - m g l sin(theta) = 0
"""
WHOLE = "T = 1/2 (M+m) x'^2 + m l x' theta' cos(theta) + 1/2 (J + m l^2) theta'^2\n"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "rows",
    [
        "trolley V = 99 M g x\nbob V = 77 m g theta\n" + WHOLE + "Q_x = F - b x'",
        "cart V = 99 M g x\npole V = 77 m g theta\n" + CART_POLE,
        "trolley V = 99 M g x\nbob V = 77 m g theta\nV_bob is small\n" + CART_POLE,
        "first row T = 1/2 M x'^2\nsecond row T = 1/2 m x'^2\n" + CART_POLE,
        "trolley T = 1/2 M x'^2\nbob T = 1/2 m x'^2\n" + CART_POLE,
    ],
)
def test_the_sum_of_energies_in_a_list_that_nothing_uses_is_judged(rows: str) -> None:
    assert not derivation("cart-pole").check(rows).right


def test_a_right_list_of_energies_is_right() -> None:
    bob = "1/2 m (x'^2 + 2 l x' theta' cos(theta) + l^2 theta'^2) + 1/2 J theta'^2"
    rows = f"trolley T = 1/2 M x'^2\nbob T = {bob}\n"
    assert derivation("cart-pole").check(rows + CART_POLE).right
    assert derivation("cart-pole").check(rows + "T = T_trolley + T_bob\n" + CART_POLE).right


def test_numbers_of_energies_may_count_parts_of_the_answers_own() -> None:
    text = """T_1 = 1/2*M*x'^2 + 1/2*J*alpha'^2
T_2 = m*(x'^2 + l^2*alpha'^2)
T_3 = 0*x'
"""
    verdict = slider().check(text.replace("T_3 = 0*x'\n", "") + ROWS.format(a="alpha").replace("+ k*x", "- k*x"))
    assert not verdict.right
    assert not any("T_2" in f.line.text and not f.status.right for f in verdict.findings)


LOOP = """from sympy import *
t = symbols('t')
M, m, l, k, J, c, F, tau = symbols('M m l k J c F tau')
x, alpha = Function('x')(t), Function('alpha')(t)
T = M*x.diff(t)**2/2 + J*alpha.diff(t)**2/2
for sign in (1, -1):
    v = Matrix([x + sign*l*sin(alpha), -sign*l*cos(alpha)]).diff(t)
    T += m*v.dot(v)/2
V = k*x**2/2
for q, Q in ((x, F), (alpha, tau - c*alpha.diff(t))):
    pprint(simplify((T - V).diff(q.diff(t)).diff(t) - (T - V).diff(q) - Q))
# (M + 2*m)*x'' + k*x - F = 0
# (J + 2*m*l**2)*alpha'' + c*alpha' - tau = 0
"""


def test_what_a_loop_adds_to_an_energy_is_not_missing() -> None:
    wrong = LOOP.replace("tau - c*", "tau + c*").replace("+ c*alpha' - tau", "- c*alpha' - tau")
    verdict = slider().check(wrong)
    assert not verdict.right
    assert all(f.status.right for f in verdict.findings if f.line.kind in ("T", "V"))
    assert "missing" not in str(verdict.mistakes[0].what)
    assert slider().check(LOOP).right


def test_an_energy_to_which_a_loop_adds_that_is_not_carried_out_is_not_judged() -> None:
    text = """% slider
syms M m l k J c F tau
syms x(t) alpha(t)
P_all = {[x + l*sin(alpha); -l*cos(alpha)], [x - l*sin(alpha); l*cos(alpha)]};
T = M*diff(x,t)^2/2 + J*diff(alpha,t)^2/2;
for i = 1:2
    v = diff(P_all{i}, t);
    T = T + m/2*(v.'*v);
end
% (M + 2*m)*x'' + k*x = F
% (J + m*l^2)*alpha'' + c*alpha' = tau
"""
    verdict = slider().check(text)
    assert not verdict.right
    assert not any(f.line.kind == "T" for f in verdict.findings)
    assert any("the loop in line 8 adds to it" in str(note) for note in verdict.notes)


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "energy",
    [
        "T = 0;\nfor i = 1:2\nT = T + m(i)*v(i)^2/2;\nend\nT = 9*M*x'^2",
        "for the record\nT = T + 0\nT = 5 M x'^2",
        "for the record\nT = T + m\nT = 5 M x'^2",
        "while x grows\nV = V + 0\nV = 99 M g x",
        "V = 99 M g x\nwhile x grows\nV = V + m",
        "T = 5 M x'^2\nfor i = 1:2\nT = T + 0\nend",
        "for i in range(2):\n    T = T + m*v[i]**2/2\nT = 9*M*x'^2",
    ],
)
def test_an_energy_beside_a_loop_that_does_not_give_it_is_judged(energy: str) -> None:
    assert not derivation("cart-pole").check(f"{energy}\n{CART_POLE}").right


def test_every_line_of_an_energy_in_a_loop_is_told() -> None:
    text = "T = 0;\nfor i = 1:2\nT = T + m(i)*v(i)^2/2;\nend\nT = T + J;\n"
    notes = [str(x) for x in derivation("cart-pole").check(text + CART_POLE).notes]
    assert sum("the loop in line 3 adds to it" in x for x in notes) == 3


def test_an_element_without_a_name_is_called_by_its_letters() -> None:
    s = System("drum")
    phi = s.coordinates("phi")
    J, a, d = s.parameters("J a d")
    P = s.inputs("P")
    s.kinetic(J * phi.diff() ** 2 / 2)
    s.torque(-P * a, on=phi)
    s.damper(2 * d, deflection=phi)
    told = s.derive().check("J*phi'' = P*a - 2*d*phi'").to_text()
    assert "Torque P a has the wrong sign." in told
    assert "orque 1" not in told


def test_a_spring_force_is_no_kinetic_energy() -> None:
    right = "Spring force K = k x\n" + ROWS.format(a="alpha")
    verdict = slider().check(right)
    assert verdict.right
    assert not any(f.line.kind == "T" for f in verdict.findings)
    energy = slider().check("K = 1/2*M*x^2\nV = 1/2*k*x^2\nL = K - V\n" + ROWS.format(a="alpha"))
    assert any(f.line.kind in ("T", "L") and not f.status.right for f in energy.findings)


def test_a_length_of_an_inertia_may_be_in_a_force() -> None:
    s = System("rod on a spring")
    theta = s.coordinates("theta")
    m, l_, k = s.parameters("m l k")
    centre = s.point("C", (l_ * sp.sin(theta) / 2, -l_ * sp.cos(theta) / 2))
    s.rigid_body(m, m * l_**2 / 12, at=centre, frame=s.frame(theta))
    s.spring(k, deflection=l_ * sp.sin(theta))
    row = "m l^2/3 theta'' + K l cos(theta) = 0"
    for beside in ("", "m l^2/3 theta'' + k l^2 sin(theta) cos(theta) = 0\n"):
        verdict = s.derive().check(f"K = k l sin(theta)\n{beside or row}")
        assert verdict.right and not any(f.line.kind == "T" for f in verdict.findings)


def test_a_kinetic_energy_without_its_dots_is_no_force() -> None:
    for wrong in ("K = 1/2 (M + m) x^2", "K = 1/2 M x + 1/2 m x", "R = 1/2 b x^2"):
        assert not derivation("cart-pole").check(f"{wrong}\n{CART_POLE}").right
    assert not derivation("cart-pole").check("K = 1/2 (M + m) x^2\nV = m g l cos(theta)").right
    used = "K = -m g l sin(theta)\n" + CART_POLE.replace("- m g l sin(theta)", "+ K")
    assert derivation("cart-pole").check(used).right
    assert not derivation("cart-pole").check(used.replace("K = -m", "K = m")).right


def test_what_turns_with_a_body_may_be_in_its_energy() -> None:
    s = System("rack")
    x = s.coordinates("x")
    M, J, R = s.parameters("M J R")
    F = s.inputs("F")
    s.particle(M, at=s.point("A", (x, 0)), name="carriage")
    s.kinetic(J * (x.diff() / R) ** 2 / 2, name="pinion")
    s.force(F, deflection=x)
    answer = "T_carriage = 1/2*(M + J/R^2)*x'^2\n(M + J/R^2)*x'' = 2*F"
    found = s.derive().check(answer).findings
    assert [f.status.right for f in found] == [True, False] or len(found) == 1
    wrong = s.derive().check(answer.replace("1/2*(M + J/R^2)", "1/2*(M + 2*J/R^2)")).findings
    assert not any(f.status.right for f in wrong)


def test_a_row_of_remarks_alone_has_no_pieces() -> None:
    row = AnswerRow(0, "Equation (with drum), Equation (with cart)")
    assert pieces(row, ",", words=cast("Any", object())) == []
