"""Lists of coordinates are lists of names, and letters that stand for nothing or for 0 do no harm.

Oracle: two carts on a spring and a pendulum, by hand.
"""

from __future__ import annotations

from functools import cache

import pytest
from small_systems import pendulum

import lagrangian as lg


@cache
def carts() -> lg.Derivation:
    s = lg.System("two carts on a spring")
    x1, x2 = s.coordinates("x1 x2")
    m1, m2, k = s.parameters("m1 m2 k")
    first = s.point("A", (x1, 0))
    s.particle(m1, at=first, name="first")
    s.particle(m2, at=s.point("B", (x2, 0)), name="second")
    s.spring(k, deflection=x2 - x1, name="spring")
    s.force((s.input("F"), 0), at=first, name="push")
    return s.derive()


RIGHT = "M = [m1, 0; 0, m2]\nK = [k, -k; -k, k]\nf = [F; 0]\nM*q'' + K*q = f"
TURNED = "M = [m2, 0; 0, m1]\nK = [k, -k; -k, k]\nf = [0; F]\nM*q'' + K*q = f"


@pytest.mark.parametrize("said", ["", "z = (x2 - x1)\n", "ξ = (x2 - x1)\n", "let z = (x2 - x1)/2\n", "q = (x1, x2)\n"])
def test_a_difference_is_no_list_of_coordinates(said: str) -> None:
    assert carts().check(said + RIGHT).right
    assert not carts().check(said + TURNED).right


def test_the_order_in_which_coordinates_are_listed_counts() -> None:
    assert carts().check("z = (x1, x2)\nq = (x2, x1)\n" + TURNED).right
    assert not carts().check("q = (x2, x1)\n" + RIGHT).right


@pytest.mark.parametrize("said", ["V = -m*g*l*cos(phi)", "y = -l*cos(phi)"])
def test_an_axis_whose_letter_is_not_used_is_read(said: str) -> None:
    row = "m*l^2*phi'' + b*phi' + m*g*l*sin(phi) = M"
    assert pendulum().check(f"x horizontal, y vertical.\n{said}\nm*x'' = -S*sin(phi)\n{row}").right
