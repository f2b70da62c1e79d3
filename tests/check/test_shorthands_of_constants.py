"""A shorthand of constants that one slip makes wrong is the mistake if all lines with it are right without.

Oracle: by hand, (m l² + M d²) φ̈ + k φ + (m l − M d) g sin φ = 0, and that of a rack with a pinion.
"""

from __future__ import annotations

import pytest
from small_systems import rack, seesaw

import lagrangian as lg

SEESAW = """Names: I = m l^2 + M d^2, w = (m l - M d) g
T = 1/2 I phi'^2
V = -w cos(phi) + 1/2 k phi^2
I phi'' + k phi + w sin(phi) = 0"""
RACK = """m_r = m + J/R^2
m_r x'' + k (x - d) = M/R"""


def wrong_lines(system: lg.Derivation, answer: str) -> dict[int, bool]:
    """The wrong lines of an answer, with whether they follow."""
    assert not system.check(answer).right
    return {f.line.number: f.follows for f in system.check(answer).findings if not f.status.right}


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("right", "wrong", "told"),
    [
        ("m l - M d", "m l + M d", " has the wrong sign."),
        ("m l - M d", "m l - M d^2", "there is the factor d too much"),
        ("m l - M d", "2 m l - M d", ": the term "),
    ],
)
def test_a_slip_in_a_shorthand_is_told_there(right: str, wrong: str, told: str) -> None:
    assert seesaw().check(SEESAW).right
    answer = SEESAW.replace(right, wrong)
    assert wrong_lines(seesaw(), answer) == {1: False, 3: True, 4: True}
    what = str(seesaw().check(answer).mistakes[0].what)
    assert what.startswith("Line 1 is not right: the value of w is ") and told in what, what


def test_a_power_in_a_shorthand_is_told_there() -> None:
    assert rack().check(RACK).right
    answer = RACK.replace("R^2", "R")
    assert wrong_lines(rack(), answer) == {1: False, 2: True}
    assert "should be J/R^2." in str(rack().check(answer).mistakes[0].what)


@pytest.mark.parametrize(
    "answer",
    [
        SEESAW.replace("w sin(phi) = 0", "2 w sin(phi) = 0"),  # right where V has it
        SEESAW.replace("+ k phi +", "- k phi +"),
        RACK.replace("k (x - d)", "k (x + d)"),
    ],
)
def test_a_right_shorthand_is_not_blamed(answer: str) -> None:
    system = rack() if answer.startswith("m_r") else seesaw()
    assert 1 not in wrong_lines(system, answer)


def test_two_mistakes_are_not_one_of_a_shorthand() -> None:
    lines = wrong_lines(seesaw(), SEESAW.replace("m l - M d", "m l + M d").replace("I phi'' + k", "I phi'' - k"))
    assert lines[4] is False
