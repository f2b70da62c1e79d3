"""Equations in letters with the same in numbers behind them, for other values than those of the system.

Oracle: the equations of the cart with a pole for M = 2, m = 1, l = 0.5, b = 0.2 and J = 0.45.
"""

from __future__ import annotations

import pytest

from student_answers import CART, POLE, right

NUMBERS = """3 x'' + 0.5 theta'' cos theta - 0.5 theta'^2 sin theta + 0.2 x' = F
0.7 theta'' + 0.5 x'' cos theta - 4.905 sin theta = 0"""
VALUES = "With M = 2, m = 1, l = 0.5, b = 0.2, J = 0.45, g = 9.81:"


@pytest.mark.parametrize("head", ["With numbers:", VALUES])
def test_numbers_of_other_values_do_not_make_right_equations_wrong(head: str) -> None:
    assert right(f"{CART}\n{POLE}\n{head}\n{NUMBERS}")
    assert not right(f"{CART}\n{POLE.replace('- m g', '+ m g')}\n{head}\n{NUMBERS}")


def test_numbers_of_the_values_that_are_stated_are_judged() -> None:
    assert not right(f"{CART}\n{POLE}\n{VALUES}\n{NUMBERS.replace('4.905', '5.905').replace('0.2', '0.3')}")
