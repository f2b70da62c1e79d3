"""Mistakes in coordinates that an answer defines are told in these: a mass on a spring on moving ground."""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.model import time


@cache
def shaken() -> lg.Derivation:
    """m x″ + c (x − Y sin ωt)′ + k (x − Y sin ωt) = 0; with u = x − Y sin ωt: m u″ + c u′ + k u = m Y ω² sin ωt."""
    s = lg.System("shaken")
    x = s.coordinate("x")
    m, k, c, Y, omega = (s.parameter(p) for p in ("m", "k", "c", "Y", "omega"))
    s.particle(m, at=s.point("P", (x, 0)), name="m")
    s.spring(k, deflection=x - Y * sp.sin(omega * time), name="k")
    s.damper(c, deflection=x - Y * sp.sin(omega * time), name="c")
    return s.derive()


@pytest.mark.parametrize(
    ("equation", "said"),
    [
        ("m u'' + c u' + k u = 0", "The prescribed motion is missing in the velocity of particle 'm'."),
        ("m u'' + k u = m Y omega^2 sin(omega t)", "Damper 'c' is missing."),
        ("m u'' + c u' - k u = m Y omega^2 sin(omega t)", "What spring 'k' adds to the equations has the wrong sign"),
    ],
)
def test_mistakes_are_told_in_the_coordinates_of_the_answer(equation: str, said: str) -> None:
    verdict = shaken().check(f"u = x - Y sin(omega t)\n{equation}")
    assert not verdict.right
    (mistake,) = verdict.mistakes
    assert said in str(mistake.what), str(mistake.what)
    assert "does not belong" not in str(verdict)


def test_the_right_equation_in_these_is_right() -> None:
    assert shaken().check("u = x - Y sin(omega t)\nm u'' + c u' + k u = m Y omega^2 sin(omega t)", hint=0).right


def test_a_wrong_line_with_a_prescribed_motion_is_no_position_at_rest() -> None:
    """Nothing is at rest where time itself stands in the equation."""
    row = "m x'' + c (x' - Y omega cos(omega t)) + k (x - Y sin(omega t)) = 0"
    assert shaken().check(row, hint=0).right
    assert not shaken().check(f"k x^2 = k Y sin(omega t)\n{row}", hint=0).right
