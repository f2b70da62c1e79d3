"""A speed that the system has a name for is judged where an answer says it, in the sense in which the answer counts it.

Oracle: a boat with a paddle whose blade feels w = ẋ cos φ − L φ̇ across it, with its forces and equations by hand.
"""

from __future__ import annotations

from functools import cache

import pytest

import lagrangian as lg
from lagrangian.check.verdict import Verdict

BOAT = """
name = "boat with a paddle"

[coordinates]
x = "boat, forward"
phi = "paddle, to the stern"

[parameters]
M = "20 kg"
J = "2 kg*m^2"
L = "1.5 m"
b = "60 N*s/m"

[inputs]
tau = "N*m, on the paddle"

[define]
w = "x'*cos(phi) - L*phi'"

[points]
H = ["x", "0"]
P = ["x - L*sin(phi)", "L*cos(phi)"]

[[particle]]
name = "boat"
mass = "M"
at = "H"

[[kinetic]]
name = "paddle"
value = "J*phi'^2/2"

[[force]]
name = "blade"
value = ["-b*w*cos(phi)", "-b*w*sin(phi)"]
at = "P"

[[torque]]
name = "arm"
value = "tau"
on = "phi"
"""


@cache
def boat() -> lg.Derivation:
    return lg.loads(BOAT).derive()


ROWS = "M x'' = -b {w} cos(phi)\nJ phi'' = tau + b L {w}"
RIGHT, LOST = "(x' cos(phi) - L phi')", "(-L phi')"


def wrong(verdict: Verdict) -> list[int]:
    return [f.line.number for f in verdict.findings if not f.status.right and not f.follows]


def told(verdict: Verdict) -> str:
    return " ".join(str(verdict).split())


def test_a_speed_is_what_the_answer_says() -> None:
    assert boat().check(ROWS.format(w=RIGHT)).right
    assert boat().check(f"w = x' cos(phi) - L phi'\n{ROWS.format(w='w')}").right


def test_a_speed_may_be_counted_in_the_other_sense() -> None:
    """With forces that fit it, nothing is wrong; with ours, both equations are."""
    turned = "w = L phi' - x' cos(phi)"
    assert boat().check(f"{turned}\n{ROWS.replace('-b', 'b').replace('tau + b', 'tau - b').format(w='w')}").right
    verdict = boat().check(f"{turned}\n{ROWS.format(w='w')}")
    assert not verdict.right and wrong(verdict) == [2, 3]


@pytest.mark.parametrize("rows", [ROWS.format(w="w"), ROWS.format(w=LOST)])
def test_what_follows_from_a_wrong_speed_is_no_mistake(rows: str) -> None:
    """The boat's own motion is forgotten in the speed of the blade, and put in below, by its name or in full."""
    verdict = boat().check(f"w = -L phi'\n{rows}")
    assert wrong(verdict) == [1]
    assert "w is ẋ cos φ − L φ̇, not −L φ̇." in told(verdict)


def test_a_wrong_equation_beside_a_right_speed_is_blamed() -> None:
    verdict = boat().check(f"w = x' cos(phi) - L phi'\n{ROWS.format(w='w').replace('b L', 'b')}")
    assert wrong(verdict) == [3]
