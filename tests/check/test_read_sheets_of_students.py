"""Sheets of students: numbered steps, crossed lines, derivatives on lines of their own, abbreviations in a sentence.

Oracle: the equations of the cart with a pole, in the grammar of model files. Every form has a wrong twin.
"""

from __future__ import annotations

import pytest

from built_in import derivation
from lagrangian import ParseError, System
from student_answers import CART, POLE, right

SLOPES = """\
dL/dx' = (M + m) x' + m l theta' cos theta
d/dt   = (M + m) x'' + m l theta'' cos theta - m l theta'^2 sin theta
dL/dtheta' = (J + m l^2) theta' + m l x' cos theta
d/dt   = (J + m l^2) theta'' + m l x'' cos theta - m l x' theta' sin theta
"""


def test_a_derivative_on_a_line_of_its_own_is_that_of_the_line_above() -> None:
    assert right(f"{SLOPES}\n{CART}\n{POLE}")
    assert not right(f"{SLOPES.replace('- m l x', '+ m l x')}\n{CART}\n{POLE}")


@pytest.mark.parametrize(
    "said",
    [
        "I write c for cos(theta) and sn for sin(theta), and\nmt for the whole mass M + m.",
        "writing c for cos(theta), sn for sin(theta) and mt for M + m",
    ],
)
def test_abbreviations_in_a_sentence_are_read(said: str) -> None:
    rows = "mt x'' + m l c theta'' = m l sn theta'^2 - b x' + F\n(J + m l^2) theta'' + m l c x'' = m g l sn"
    assert right(f"{said}\n\n{rows}")
    assert not right(f"{said.replace('cos', 'tan')}\n\n{rows}")


@pytest.mark.parametrize(
    "aside",
    [
        "Check: theta = 0 and F = 0: 0 = 0. ok",
        "~~V = m g l sin(theta)~~",
        "So the mass, *clockwise* positive, lifts itself um y = l cos theta",
    ],
)
def test_what_decides_nothing_is_no_equation(aside: str) -> None:
    assert right(f"{aside}\n{CART}\n{POLE}")
    assert not right(f"{aside}\n{CART.replace('= F', '= 2 F')}\n{POLE}")


def test_a_coordinate_of_ones_own_is_not_defined_by_where_it_is_zero() -> None:
    said = "**β** is the angle of the pole, *clockwise* positive, β = 0 at the top, so θ = β.\n\n"
    rows = f"1. {CART}\n2. {POLE}".replace("theta", "beta")
    assert right(said + rows)
    assert not right(said + rows.replace("- m g", "+ m g"))


def test_numbers_far_in_front_count_the_steps() -> None:
    sheet = "0  ξ₁ = x, ξ₂ = θ\n1  V = m g l cos θ\n2  Ξ₁ = 2 F - F - b ẋ\n3  equations\n"
    assert right(f"{sheet}{CART}\n{POLE}")
    assert not right(f"{sheet.replace('cos', 'sin')}{CART}\n{POLE}")


def test_a_general_form_is_not_passed_over_where_it_is_needed() -> None:
    with pytest.raises(ParseError, match="no rate"):
        derivation("cart-pole").check(f"V = m g l cos theta\nl' = 0\n(M + m) x'' + W l'' = F\n{POLE}")


def test_labels_in_front_are_no_factors() -> None:
    sheet = f"(k) masses M and m\n(l) V = m g l cos theta\n(m) {CART}\n(n) {POLE}"
    for first in ("(k)", "(a)"):  # l and m are a length and a mass
        labelled = sheet if first == "(k)" else sheet.replace("(k)", "(a)").replace("(l)", "(b)")
        labelled = labelled if first == "(k)" else labelled.replace("(m)", "(c)").replace("(n)", "(d)")
        assert right(labelled)
        assert not right(labelled.replace("- m g l sin", "+ m g l sin"))
    assert right(f"[x]   {CART}\n[theta]   {POLE}")
    assert not right(f"[l]   {CART}\n[b]   {POLE.replace('(J + m l^2)', '(J/b + m l^2/b)')}")  # factors
    assert right(f"x)   {CART}\ntheta)   -m g l sin theta + {POLE.replace(' - m g l sin theta', '')}")


def test_a_list_of_equations_in_latex_is_one_of_rows() -> None:
    listed = (
        r"\left[ (M + m) \ddot{x} + m l \ddot{\theta} \cos{\theta} - m l \dot{\theta}^{2} \sin{\theta} + b \dot{x} "
        r"= F, \  "
        r"\left(J + l^{2} m\right) \ddot{\theta} + m l \ddot{x} \cos{\theta} - m g l \sin{\theta} = 0\right]"
    )
    assert right(listed)
    assert not right(listed.replace("- m g l", "+ m g l"))


def test_derivatives_of_a_quantity_of_ones_own_are_judged() -> None:
    sheet = "R = 1/2 b x'^2\ndR/dx' = b x', dR/dtheta' = 0\nd/dt(∂T*/∂ẋ) = (M + m) x''\n"
    assert right(f"{sheet.splitlines()[0]}\n{sheet.splitlines()[1]}\n{CART}\n{POLE}")
    assert not right(f"{sheet.splitlines()[0]}\ndR/dx' = 2 b x'\n{CART}\n{POLE}")
    assert not right(f"{sheet}{CART}\n{POLE}")


def test_derivatives_by_spelled_rates_are_judged() -> None:
    stated = "R = 1/2 b xd^2\n{}\ndR/dthd = 0\n" + f"{CART}\n{POLE}"
    assert right(stated.format("dR/dxd = b xd"))
    assert not right(stated.format("dR/dxd = 2 b xd"))


@pytest.mark.parametrize(
    ("sign", "spoken", "other"), [("- m g", "minus m g", "plus m g"), ("- m g", "\nminus m g", "\nplus m g")]
)
def test_words_between_mathematics_are_signs(sign: str, spoken: str, other: str) -> None:
    assert right(f"{CART}\n{POLE.replace(sign, spoken).replace('= 0', 'equals 0')}")
    assert not right(f"{CART}\n{POLE.replace(sign, other)}")
    assert right(f"{CART}\n(J + m l^2) times theta'' + m l x'' cos theta = m g l sin theta")


def test_what_words_add_at_the_end_is_not_left_out() -> None:
    assert right(f"{CART} by Lagrange\n{POLE}")
    assert not right(f"{CART} plus friction\n{POLE}")


def test_d_dt_alone_in_latex_is_the_derivative_of_the_slope_above() -> None:
    above = r"\[\frac{\partial L}{\partial \dot x} = (M+m)\dot x + m l \dot\theta\cos\theta\]"
    rate = r"\[\frac{d}{dt} = (M+m)\ddot x + m l\ddot\theta\cos\theta - m l\dot\theta^2\sin\theta\]"
    assert right(f"{above}\n{rate}\n{CART}\n{POLE}")
    assert not right(f"{above}\n{rate.replace('- m l', '- 2 m l')}\n{CART}\n{POLE}")
    one = above.replace(r"\]", rate.replace(r"\[", r" \Rightarrow "))
    assert right(f"{one}\n{CART}\n{POLE}")


def test_a_misspelled_name_is_read_where_the_answer_is_right_then() -> None:
    misspelled = POLE.replace("sin theta", "sin theeta")
    assert right(f"{CART}\n{misspelled}")
    assert "misspelled" in str(derivation("cart-pole").check(f"{CART}\n{misspelled}"))
    assert not right(f"{CART}\n{misspelled.replace('- m g', '+ m g')}")


def test_a_damper_in_front_of_a_name_with_primes_is_a_factor() -> None:
    s = System("pendulum")
    phi = s.coordinates("phi")
    J, d, k = s.parameters("J d k")
    s.kinetic(J * phi.diff() ** 2 / 2)
    s.damper(d, deflection=phi)
    s.spring(k, deflection=phi)
    assert s.derive().check("J phi'' + dphi' + kphi = 0", hint=0).right
    assert not s.derive().check("J phi'' + dphi'' + kphi = 0", hint=0).right
    assert s.derive().check("dphi = phi'\nJ dphi' + d dphi + kphi = 0", hint=0).right  # here it is a name
    for rate in ("d dphi/dt", "ddphi/dt", "d d/dt(phi)", "d d(phi)/dt"):
        assert s.derive().check(f"J d2phi/dt2 + {rate} + k phi = 0", hint=0).right, rate
    for rate in (r"d d\phi/dt", r"d\,\mathrm d\phi/\mathrm dt", r"d \, d(\phi)/{dt}", r"d\, d/dt \phi"):
        assert s.derive().check(rf"$J\, d^2\phi/dt^2 + {rate} + k \phi = 0$", hint=0).right, rate


@pytest.mark.slow
def test_expressions_beside_every_generalized_force_are_left_hand_sides() -> None:
    cart = "x: (M + m) x'' + m l theta'' cos theta - m l theta'^2 sin theta"
    pole = "theta: (J + m l^2) theta'' + m l x'' cos theta - m g l sin theta"
    for rows in (f"{cart}\n{pole}", f"{pole}\n{cart}"):
        sheet = f"5) left-hand sides\n{rows}\n6) Xi_x = F - b x'\nThe equations are 5) = 6)."
        assert right(sheet)
        assert not right(sheet.replace("- m g l", "+ m g l"))
        assert not right(sheet.replace("F - b", "F + b"))
        assert not right(sheet.replace("6) Xi_x = F - b x'\n", ""))
        assert not right(sheet.replace("sin theta\n", "sin theta = 0\n"))
        labelled = f"Step 5\n{rows}\nStep 6\n  x: F - b x'\n  theta: 0\nstep 5 = step 6"
        assert right(labelled)
        assert not right(labelled.replace("F - b", "F + b"))
        assert not right(labelled.replace("theta: 0", "theta: F l"))


def test_a_letter_e_of_the_answer_is_not_the_base_of_powers() -> None:
    s = System("spring between two blocks")
    x, y = s.coordinates("x y")
    m, k = s.parameters("m k")
    s.particle(m, at=s.point("A", (x, 0)))
    s.particle(m, at=s.point("B", (y, 0)))
    s.spring(k, deflection=y - x)
    d = s.derive()
    rows = r"m \ddot x - k e &= 0 \\ m \ddot y + k e &= 0"
    sheet = rf"With $e = y - x$, \begin{{align}} V &= \frac{{1}}{{2}} k e^2 \\ {rows} \end{{align}}"
    assert d.check(sheet, hint=0).right
    assert not d.check(sheet.replace("e^2", "e^3"), hint=0).right


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("legend", "first", "second"),
    [
        ("D1 = first time derivative, D2 = second.", "D1{}", "D2{}"),
        ("Y1 is d/dt, Y2 is d^2/dt^2", "Y1({})", "Y2({})"),
        ("x: cart   w behind a name = d/dt, ww = d^2/dt^2", "{}w", "{}ww"),
    ],
)
def test_a_legend_of_derivatives_is_read(legend: str, first: str, second: str) -> None:
    def written(name: str, text: str) -> str:
        return text.replace(f"{name}''", second.format(name)).replace(f"{name}'", first.format(name))

    rows = written("x", written("theta", f"{CART}\n{POLE}"))
    assert right(f"{legend}\n\n{rows}")
    assert not right(f"{legend}\n\n{rows.replace(first.format('theta'), second.format('theta'))}")


def test_letters_in_a_group_are_read_though_one_ends_a_side() -> None:
    rows = f"{CART}\n{POLE}".replace("theta", "P").replace("x", "Y")
    assert right(f"Y, P stand for x and theta.\n\n{rows}")


@pytest.mark.parametrize("combined", ["cos * (horizontal) + sin * (vertical):", "sin(theta)·(1) - cos(theta)·(2):"])
def test_a_line_that_says_how_equations_are_combined_stops_nothing(combined: str) -> None:
    assert right(f"{CART}\n{combined}\n   {POLE}")
    assert not right(f"{CART}\n{combined}\n   2 {POLE}")


def test_names_that_only_call_equations_are_told_from_forces() -> None:
    named = f"g1 = {CART.removesuffix(' = F')} - F\ng2 = {POLE.removesuffix(' = 0')}"
    assert right(named) and not right(f"{named}\ng1 = 2 F")
    for wrong in ("- b x'", "+ 2 b x'"):
        assert not right(named.replace("+ b x'", wrong))


def test_equations_that_are_added_may_be_the_label_of_their_sum() -> None:
    added = (
        "(M + m + m l cos theta) x'' + (J + m l^2 + m l cos theta) theta'' - m l theta'^2 sin theta - m g l sin theta"
    )
    rows = f"(I) + (II):  {added} + b x' = F\n(II):        {POLE}"
    assert right(rows) and not right(rows.replace("+ b x'", "- b x'"))


def test_a_bare_force_in_the_row_of_a_coordinate_is_that_of_it() -> None:
    sheet = f"x: ∂V/∂x = 0, Q = F - b x'\ntheta: ∂V/∂theta = -m g l sin theta, Q = 0\n{CART}\n{POLE}"
    assert right(f"V = m g l cos theta\n{sheet}")
    told = derivation("cart-pole").check(f"V = m g l cos theta\n{sheet.replace('F - b', 'F + b')}")
    assert any(x.startswith("line 2 (Ξ of x)") and x.endswith(" not right") for x in told.to_text().splitlines())
