"""Of two balances that share a force and do not fit each other, the mass times acceleration that is missing is that of
the body whose mass a line has: in the line of the other one the force stands for it."""

from functools import cache

import pytest

import lagrangian as lg

HATCH = """
name = "hatch with a counterweight"
[coordinates]
theta = "hatch from the vertical"
[parameters]
J = { value = "12 kg*m^2", description = "hatch about the hinge" }
M = "30 kg"
L = "1.2 m"
c = "40 N*m*s"
g = "9.81 m/s^2"
[inputs]
Q = "N*m"
[points]
weight = ["0", "L*cos(theta)"]
[[kinetic]]
name = "hatch"
value = "J*theta'^2/2"
[[particle]]
name = "counterweight"
mass = "M"
at = "weight"
[[gravity]]
direction = [0, -1]
g = "g"
[[damper]]
name = "hinge"
b = "c"
deflection = "theta"
[[torque]]
name = "motor"
value = "Q"
on = "theta"
"""


@cache
def hatch() -> lg.Derivation:
    return lg.loads(HATCH).derive()


ANSWER = "J theta'' = Q + S L sin(theta) - c theta'\nM L sin(theta) theta''{} = M g - S\n"
RESULT = "(J + M L^2 sin(theta)^2) theta''{} + c theta' - M g L sin(theta) = Q"
CARRIED, SUM = " + M L cos(theta) theta'^2", " + M L^2 sin(theta) cos(theta) theta'^2"


def test_both_balances_are_right() -> None:
    assert hatch().check(ANSWER.format(CARRIED) + RESULT.format(SUM)).right


@pytest.mark.parametrize("result", ["", RESULT.format("")])
def test_the_line_with_the_mass_lacks_the_acceleration(result: str) -> None:
    verdict = hatch().check(ANSWER.format("") + result)
    open_ones = [f for f in verdict.findings if not f.status.right and not f.follows]
    assert [f.line.number for f in open_ones] == [2], str(verdict)
    assert "line 2" in str(verdict.mistake.what) and "L*M*cos(theta)*theta'^2" in str(verdict.mistake.what)


def test_a_force_that_is_missing_is_still_sought_in_the_other_line() -> None:
    verdict = hatch().check(
        ANSWER.format(CARRIED).replace(" - c theta'", "") + RESULT.format(SUM).replace(" + c theta'", "")
    )
    open_ones = [f for f in verdict.findings if not f.status.right and not f.follows]
    assert [f.line.number for f in open_ones] == [1], str(verdict)
