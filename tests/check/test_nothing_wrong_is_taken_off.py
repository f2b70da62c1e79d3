"""Nothing that is wrong is taken off an answer as a check of units, a gloss, a correction, a mark or a name.

Oracle: a mass on a spring and a damper, m x'' + b x' + k x = F, and a puck on a turning rod.
"""

from __future__ import annotations

import pytest
import sympy as sp
from small_systems import mass, rod

import lagrangian as lg
from lagrangian.errors import ParseError

MASS = "m x'' + b x' + k x = F"
FIRST, SECOND = "(J + m r^2) phi'' + 2 m r r' phi' = M", "m r'' - m r phi'^2 + k (r - a) = 0"


@pytest.mark.parametrize(
    "answer",
    [
        f"{MASS.replace('= F', '+')}\n  5 k x    kg m/s^2 = N\n= F",
        "x'' = (F - k x - b x')/m    (dx/dt)",
        "T = 1/2 m x'^2\nV = 1/2 k x^2\nQ_x = F - b x'    (dx/dt)",
        f"{MASS.replace('= F', '= 7 F')}\nNo damping: m x'' + k x = F",
        f"{MASS.replace('k x', 'k x (2)')}\n(1) the first thing here\n(2) the spring force",
        "T = 1/2 m x'^2\nV = 7\nQ_x = F - b x'",
    ],
)
def test_what_is_wrong_stays(answer: str) -> None:
    try:
        assert not mass().check(answer).right
    except ParseError as error:
        assert error.code == "E701"


@pytest.mark.parametrize(
    "answer",
    [
        f"Force balance: {SECOND}\nMoment balance: {FIRST}",
        f"{SECOND}\nNo slip here: {FIRST}",
        f"{SECOND.replace('k (r', '2 k (r')}\nsorry, {SECOND}\n{FIRST}",
    ],
)
def test_right_lines_are_not_taken_back(answer: str) -> None:
    assert rod().check(answer).right


@pytest.mark.parametrize("text", [" " * 3_000, "m  " * 1_000, "a is " * 500, "(" * 500, "[ " * 500])
def test_blanks_and_units_without_end_are_read_or_refused(text: str) -> None:
    try:
        mass().check(f"{MASS}\na{text}b")
    except ParseError as error:
        assert error.code in ("E701", "E703", "E402")


def test_a_letter_whose_value_is_zero_may_have_been_forgotten() -> None:
    s = lg.System("pendulum without damping")
    theta = s.coordinate("theta")
    m, L, b, g = s.parameters("m L b g", m=2, L=0.5, b=0, g=9.81)
    s.particle(m, at=s.point("P", (L * sp.sin(theta), -L * sp.cos(theta))))
    s.gravity((0, -1), g)
    s.damper(b, deflection=theta)
    derivation = s.derive()
    assert not derivation.check("m L^2 theta'' + m g L sin(theta) = 0").right
    assert derivation.check("m L^2 theta'' + b theta' + m g L sin(theta) = 0").right


def test_an_energy_of_two_bodies_is_not_that_of_one() -> None:
    equations = f"{FIRST}\n{SECOND}\n"
    assert not rod().check(f"{equations}The rod and the puck have the kinetic energy T = 1/2 J phi'^2").right
