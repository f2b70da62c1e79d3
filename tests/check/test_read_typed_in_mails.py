"""What is typed in a mail or a short sheet: dots above letters, labels of laws, remarks of special motions.

Oracle: the equations of the cart with a pole, and of a wagon with a load on a spring. Every form has a wrong twin.
"""

from __future__ import annotations

from functools import cache

import pytest

import lagrangian as lg
from built_in import derivation
from student_answers import CART, POLE, right

DOTTED = """\
        ..            ..               .2           .
(M + m) x  +  m l cosθ θ  - m l sin θ  θ    = F - b x

            ..               ..
(J + m l^2) θ + m l cos θ    x  = m g l sin θ
"""


def test_dots_above_letters_are_rates() -> None:
    assert right(DOTTED)
    assert not right(DOTTED.replace("F - b", "F + b"))
    assert not right(DOTTED.replace(".2 ", ".  "))


def test_dots_above_no_coordinate_are_no_rates() -> None:
    wrong = DOTTED.replace("        ..      ", "          ..    ", 1)
    assert not right(wrong)


@cache
def drum() -> lg.Derivation:
    """A drum that hoists a load by an elastic rope."""
    s = lg.System("drum")
    phi, y = s.coordinates("phi y")
    J, m, R, k, g = s.parameters("J m R k g")
    s.rigid_body(mass=0, inertia=J, at=s.origin, frame=s.frame(phi, name="drum"), name="drum")
    s.particle(m, at=s.point("load", (0, y)))
    s.gravity((0, -1), g)
    s.spring(k=k, deflection=R * phi - y)
    s.torque(s.inputs("M"), on=phi)
    return s.derive()


ROWS = "J phi'' + k R (R phi - y) = M\nm y'' - k (R phi - y) + m g = 0"


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    "said",
    [
        "The stiffness matrix has determinant zero (rigid body motion: y = R phi).",
        "No spring force if they move together (y' = R phi').",
        "f) natural frequencies (g = 0): w = 0 and w^2 = k/m + k R^2/J = 250 + 18, w = 16.4 rad/s",
        "Check: static, phi'' = y'' = phi' = 0: stretch = m g/k",
    ],
)
def test_what_is_said_of_special_motions_is_no_equation(said: str) -> None:
    assert drum().check(f"{ROWS}\n{said}").right
    assert not drum().check(f"{ROWS.replace('+ m g', '- m g')}\n{said}").right


@pytest.mark.parametrize(
    "said",
    [
        "The speed of the load follows from that of the drum (y' = R phi').",
        "Natural frequency: phi'^2 = k/m",
        "Frequency and stretch: R phi = 2 y",
    ],
)
def test_what_is_said_of_every_motion_is_judged(said: str) -> None:
    assert not drum().check(f"{ROWS}\n{said}").right


@pytest.mark.parametrize("said", ["k y = m g", "k y = k phi", "y = R phi + m g/(2 k)", "y'' = R phi''"])
def test_what_is_said_of_other_motions_is_judged(said: str) -> None:
    assert not drum().check(f"{ROWS}\n{said}").right


@pytest.mark.parametrize("label", [r"\theta-Gleichung:", r"\theta-equation:", r"equation for \theta:", r"\theta:"])
def test_the_name_of_an_equation_in_latex_without_delimiters_is_a_label(label: str) -> None:
    cart = r"x-equation: (M+m)\ddot{x}+ml\ddot{\theta}\cos\theta-ml\dot{\theta}^2\sin\theta=F-b\dot{x}"
    pole = rf"{label} (J+ml^2)\ddot{{\theta}}+ml\ddot{{x}}\cos\theta=mgl\sin\theta"
    assert right(f"{cart}\n{pole}")
    assert not right(f"{cart}\n{pole.replace('=mgl', '=-mgl')}")


def test_roman_numbers_far_in_front_count() -> None:
    sheet = f"I    V = m g l cos theta\nII   {CART}\nIII  {POLE}\n"
    assert right(sheet)
    assert not right(sheet.replace("- m g l", "+ m g l"))


def test_sides_of_the_law_in_front_of_a_colon_are_a_label() -> None:
    sheet = (
        "p_x = (M + m) x' + m l theta' cos theta\np_theta = (J + m l^2) theta' + m l x' cos theta\n"
        f"d/dt p_x:   {CART}\nd/dt p_theta - dT/dtheta + dV/dtheta:\n            {POLE}"
    )
    assert right(sheet)
    assert not right(sheet.replace("- m g l", "+ m g l"))


def test_a_remark_in_italics_behind_an_equation_is_no_part_of_it() -> None:
    half = "((J + m l^2) theta'' + m l x'' cos theta - m g l sin theta)/2 = 0   *(divided by 2)*"
    assert right(f"{CART}\n{half}")
    assert not right(f"{CART}\n{half.replace('- m g', '+ m g')}")


def test_a_rate_with_a_mark_that_words_explain_is_differentiated_on_the_line_below() -> None:
    sheet = (
        "_d first, _dd second time derivative, th = theta\n"
        "T = 1/2 (M + m) x_d^2 + m l x_d th_d cos(th) + 1/2 (J + m l^2) th_d^2\n"
        "dT/dth_d = (J + m l^2) th_d + m l x_d cos(th)\n"
        "d/dt     = (J + m l^2) th_dd + m l x_dd cos(th) - m l x_d th_d sin(th)\n"
        "dT/dth   = - m l x_d th_d sin(th)\n"
        "(M + m) x_dd + m l th_dd cos(th) - m l th_d^2 sin(th) = F - b x_d\n"
        "(J + m l^2) th_dd + m l x_dd cos(th) = m g l sin(th)\n"
    )
    assert right(sheet)
    verdict = derivation("cart-pole").check(sheet.replace("x_dd cos(th) - m l x_d", "x_dd cos(th) + m l x_d"))
    assert not verdict.right
    assert next(f.line.number for f in verdict.findings if not f.status.right) == 4


def test_a_slope_of_an_energy_has_no_mark_of_a_legend() -> None:
    sheet = (
        "T = 1/2 (M + m) xd^2 + m l xd thd cos th + 1/2 (J + m l^2) thd^2\n(d = time derivative, dd = second)\n"
        "x:   d/dt dT/dxd = (M + m) xdd + m l thdd cos th - m l thd^2 sin th\n"
        f"{CART}\n{POLE}"
    )
    assert right(sheet)
    assert not right(sheet.replace("- m l thd^2", "+ m l thd^2"))


def test_what_i_have_is_no_factor() -> None:
    said = "With u = x/l I have V = m g l cos(theta), and\n"
    assert right(f"{said}{CART}\n{POLE}")
    assert not right(f"{said.replace('cos', 'sin')}{CART}\n{POLE}")


def test_a_value_behind_at_is_no_condition_where_it_goes_on() -> None:
    said = "Pole: mass at a = x + l sin theta, h = l cos theta\nV = m g h\na' = x' + l theta' cos theta\n"
    assert right(f"{said}{CART}\n{POLE}")
    assert not right(f"{said.replace('x + l sin', 'x - l sin')}{CART}\n{POLE}")


def test_an_apposition_behind_a_comma_is_no_statement() -> None:
    said = "Pole, moments about the joint (J_A = J + m l^2, angular acceleration theta''):\n"
    assert right(f"{said}J_A theta'' + m l x'' cos theta - m g l sin theta = 0\n{CART}")
    assert not right(f"{said}J_A theta'' + m l x'' cos theta + m g l sin theta = 0\n{CART}")


def test_what_was_done_with_equations_is_a_label() -> None:
    sheet = f"{CART}          (A)\n{POLE}          (B)\nminus theta' times (A):\n"
    assert right(sheet)
    assert "A" not in str(derivation("cart-pole").check(sheet).notes)
    assert not right(sheet.replace("- m g", "+ m g"))


def test_a_multiplier_behind_a_comma_is_no_part_of_a_constraint() -> None:
    s = lg.System("rope")
    x, y = s.coordinates("x y")
    M, m, L, g = s.parameters("M m L g")
    s.particle(M, at=s.point("block", (x, 0)))
    s.particle(m, at=s.point("weight", (0, -y)))
    s.gravity((0, -1), g)
    s.constraint(x + y - L, name="rope")
    rows = "Constraint x + y - L = 0, λ\nM x'' = λ\nm y'' = m g + λ"
    assert s.derive().check(rows).right
    assert not s.derive().check(rows.replace("m g +", "m g + m g +")).right


def test_a_paragraph_of_html_is_one_line() -> None:
    cart = CART.replace(" + b", "\n+ b")
    sheet = f"<html><body><p>Dear all,\nthe cart:</p>\n<p>{cart}</p>\n<p>{POLE}</p></body></html>"
    assert right(sheet)
    assert not right(sheet.replace("- m g", "+ m g"))


@pytest.mark.parametrize("said", ["Only the angular velocity w = theta' appears.", "Only the speed w = θ̇ appears."])
def test_a_verb_behind_a_value_is_no_factor(said: str) -> None:
    rows = f"{said}\n{CART}\n(J + m l^2) w' + m l x'' cos theta - m g l sin theta = 0"
    assert right(rows)
    assert not right(rows.replace("- m g", "+ m g"))


def test_a_sum_with_a_mass_is_no_acceleration() -> None:
    row = "The sum with the accelerations: m*L^2*theta'' + b*theta' + m*g*L*sin(theta)\nT = m*L^2*theta'^2/2"
    assert right(row, "pendulum")
    assert not right(row.replace("+ m*g", "- m*g"), "pendulum")
