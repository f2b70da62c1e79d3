"""Equations in letters with the same in numbers behind them, for other values than those of the system.

Oracle: the equations of the cart with a pole for M = 2, m = 1, l = 0.5, b = 0.2 and J = 0.45.
"""

from __future__ import annotations

from functools import cache

import pytest

from built_in import derivation
from lagrangian import loads
from lagrangian.derivation import Derivation
from student_answers import CART, POLE, right

ROLLING = """
name = "cylinder and block on a slope"
[coordinates]
x = "axle, down the slope"
s = "elongation"
[parameters]
m1 = "4 kg"
m2 = "2 kg"
k = "200 N/m"
alpha = "30 deg"
g = "9.81 m/s^2"
[define]
down = "x + s"
[[kinetic]]
value = "3/4*m1*x'^2 + m2*down'^2/2"
[[potential]]
value = "-(m1*x + m2*down)*g*sin(alpha)"
[[spring]]
k = "k"
deflection = "s"
"""
NUMBERS = """3 x'' + 0.5 theta'' cos theta - 0.5 theta'^2 sin theta + 0.2 x' = F
0.7 theta'' + 0.5 x'' cos theta - 4.905 sin theta = 0"""
VALUES = "With M = 2, m = 1, l = 0.5, b = 0.2, J = 0.45, g = 9.81:"


@cache
def rolling() -> Derivation:
    """A cylinder that rolls down a slope, and a block on a spring."""
    return loads(ROLLING).derive()


@pytest.mark.sampled(2)
@pytest.mark.parametrize("head", ["With numbers:", VALUES])
def test_numbers_of_other_values_do_not_make_right_equations_wrong(head: str) -> None:
    assert right(f"{CART}\n{POLE}\n{head}\n{NUMBERS}")
    assert not right(f"{CART}\n{POLE.replace('- m g', '+ m g')}\n{head}\n{NUMBERS}")


def test_numbers_of_the_values_that_are_stated_are_judged() -> None:
    assert not right(f"{CART}\n{POLE}\n{VALUES}\n{NUMBERS.replace('4.905', '5.905').replace('0.2', '0.3')}")


@pytest.mark.sampled(4)
@pytest.mark.parametrize("stiffness", ["2·10³", "2*10^3", "2e3", "2×10³", "2 · 10³"])
def test_a_power_of_ten_belongs_to_a_value(stiffness: str) -> None:
    values = f"m1 = 3 kg, k = {stiffness} N/m"
    rows = "3 x1'' - 2000 x2r = -F\nm2 (x1'' + x2r'') + 2000 x2r = F"
    assert derivation("lecture-3b").check(f"{values}\n{rows}", hint=0).right
    assert not derivation("lecture-3b").check(f"{values}\n{rows.replace('2000 x2r = F', '2 x2r = F')}", hint=0).right
    assert derivation("lecture-3b").check(f"{values.replace(', ', chr(10))}\n{rows}", hint=0).right


@pytest.mark.sampled(6)
@pytest.mark.parametrize("pi", ["Pi", "PI", "π", "pi"])
def test_pi_is_a_number_in_the_spelling_of_every_program(pi: str) -> None:
    answer = f"alpha = theta - {pi}/2\nm L^2 alpha'' + b alpha' + m g L cos(alpha) = 0"
    assert derivation("pendulum").check(answer, hint=0).right
    assert not derivation("pendulum").check(answer.replace("/2", "/3"), hint=0).right


def test_what_a_product_with_a_sine_amounts_to_stands_in_a_list_of_values() -> None:
    rows = "3/2 m1 x'' = m1 g sin α + k s\nm2 (x'' + s'') = m2 g sin α - k s"
    listed = "m1 = 4 kg, α = 30°, g sin α = 4,905 m/s², cos α = 0.866"
    verdict = rolling().check(f"{rows}\n{listed}")
    assert verdict.right and "Right if" not in verdict.to_text()
    assert "α = 0.7" in rolling().check(f"{rows}\n{listed.replace('30°', '0.7')}").to_text()


def test_the_whole_expression_in_front_of_a_listed_value_has_it() -> None:
    values = "(M + m) g l = 3.5316       m g l = 0.5886, 2 M + m = 2.2 and l = 0.3 m g = 9.81 m/s^2 M = 1 kg"
    values = f"{values}\nM = 1 kg  m l^2 = 0.018 kg m^2  m g = 1.962 N"
    assert right(f"{values}\n{CART}\n{POLE}")
    for number in ("3.53", "0.588", "2.2 and", "0.018", "1.96"):
        assert not right(f"{values.replace(number, '4' + number[1:])}\n{CART}\n{POLE}")


@pytest.mark.sampled(2)
@pytest.mark.parametrize("amount", ["m_1 + m_2 = 6 kg", "m_1/m_3 = 4 kg/4 kg = 1 kg, m_2 g = 19.62 N"])
def test_kilograms_are_a_unit_where_k_and_g_are_parameters(amount: str) -> None:
    system = ROLLING.replace("m1", "m_1").replace("m2", "m_2").replace('k = "2', 'm_3 = "4 kg"\nk = "2')
    rows = "6 x'' = 4 g sin(alpha) + 200 s\n2 (x'' + s'') = 2 g sin(alpha) - 200 s"
    blocks = loads(system).derive()
    assert blocks.check(f"{amount}\n{rows}", hint=0).right
    assert not blocks.check(f"{amount.replace(' kg', '.5 kg').replace('19', '18')}\n{rows}", hint=0).right
    assert not blocks.check(f"{amount}\n{rows.replace('- 200', '+ 200')}", hint=0).right


@pytest.mark.sampled(2)
@pytest.mark.parametrize(("said", "holds"), [("y = x - 0.1 theta", True), ("y = x - 0.2 theta", False)])
def test_a_name_of_the_system_may_be_said_in_numbers(said: str, holds: bool) -> None:
    system = """
name = "drum and box"
[coordinates]
x = "box"
theta = "drum"
[parameters]
J = "2 kg*m^2"
m = "3 kg"
k = "50 N/m"
R = "0.1 m"
[define]
y = "x - R*theta"
[[kinetic]]
value = "J*theta'^2/2 + m*x'^2/2"
[[spring]]
k = "k"
deflection = "y"
"""
    drum = loads(system).derive()
    rows = "3 x'' + 50 y = 0\n2 theta'' - 5 y = 0"
    assert drum.check(f"{said}\n{rows}", hint=0).right == holds
    assert not drum.check(f"{said}\n{rows.replace('- 5', '- 0.5')}", hint=0).right
    assert not drum.check(f"{said}\n{rows.replace('50', '5')}", hint=0).right
