"""Names of an answer that nothing explains are asked about, also where they accelerate or stand in a denominator.

Oracle: m ẍ + J/R² ẍ + k x = 0 by hand, and the equations of examples.
"""

from __future__ import annotations

import pytest

from built_in import derivation
from lagrangian import ParseError, System


def rolling() -> System:
    s = System("roller")
    x = s.coordinates("x")
    m, J, R, k = s.parameters("m J R k")
    s.kinetic(m * x.diff() ** 2 / 2 + J * (x.diff() / R) ** 2 / 2)
    s.spring(k, deflection=x)
    return s


def test_a_name_that_accelerates_beside_all_coordinates_is_asked_about() -> None:
    with pytest.raises(ParseError, match="what is 'theta'"):  # the relation was forgotten
        rolling().derive().check("m x'' + J/R theta'' + k x = 0")


def test_a_name_that_accelerates_is_a_coordinate_where_it_makes_the_answer_right() -> None:
    roller = rolling().derive()
    assert roller.check("(m R^2 + J) beta'' + k R^2 beta = 0", hint=0).right
    assert roller.check("theta = x/R\nm x'' + J/R theta'' + k x = 0", hint=0).right


@pytest.mark.slow
def test_a_name_in_a_denominator_is_no_multiplier() -> None:
    platform = derivation("stewart-platform")
    for written in ("m/R2*platform_vx' = 0", "m*wheel_vx' + platform_wy*platform_wz = 0"):
        with pytest.raises(ParseError, match="what is '"):
            platform.check(written)


def test_letters_in_brackets_that_count_are_labels() -> None:
    cart = "M x'' + m x'' + m l theta'' cos theta - m l theta'^2 sin theta + b x' = F"
    pole = "m l x'' cos theta + (J + m l^2) theta'' - m g l sin theta = 0"
    assert derivation("cart-pole").check(f"(a) {cart}\n(b) {pole}", hint=0).right  # b is a damper
    assert not derivation("cart-pole").check(f"(a) {cart}\n(b) {pole.replace('- m g', '+ m g')}", hint=0).right


def test_no_letter_behind_a_number_is_a_unit_of_time() -> None:
    with pytest.raises(ParseError, match="what is 'h'"):
        rolling().derive().check("m x'' + 2h x'' + k x = 0")


def test_a_common_word_behind_a_word_is_no_product() -> None:
    s = System("gear")
    phi = s.coordinates("phi")
    i, n, k = s.parameters("i n k")
    s.kinetic(i * (n * phi.diff()) ** 2 / 2)
    s.spring(k, deflection=phi)
    assert s.derive().check("put the result in i n^2 phi'' + k phi = 0", hint=0).right
    assert not s.derive().check("put the result in i n phi'' + k phi = 0", hint=0).right


def test_an_expression_beside_complete_equations_decides_nothing() -> None:
    shown = "(%i5) diff(x,t)$\n(%o6)  (m + J/R^2)*'diff(x,t,2)\n       + k*x = 0"
    assert rolling().derive().check(shown, hint=0).right
    assert not rolling().derive().check(shown.replace("+ k", "- k"), hint=0).right
