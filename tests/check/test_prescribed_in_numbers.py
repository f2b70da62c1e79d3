"""Answers in numbers for a system with a prescribed motion, whose values an answer states and rounds.

Oracle: m + J/r² = 5.2222, m r + J/r = 0.78333, A = 7° = 0.122173, A Ω = 0.0977384, A Ω² = 0.0781907.
"""

from __future__ import annotations

from functools import cache

import pytest

from lagrangian import loads
from lagrangian.derivation import Derivation

PLANK = """
name = "disc on a rocking plank"
[coordinates]
s = "along the plank"
[parameters]
m = "3 kg"
J = "0.05 kg*m^2"
r = "0.15 m"
A = "7 deg"
Omega = "0.8 rad/s"
k = "20 N/m"
g = "9.81 m/s^2"
[define]
phi = "A*sin(Omega*t)"
[[kinetic]]
value = "m/2*((s' - r*phi')^2 + s^2*phi'^2) + J/2*(phi' - s'/r)^2"
[[potential]]
value = "m*g*(s*sin(phi) + r*cos(phi)) + k*s^2/2"
"""
LETTERS = "(m + J/r^2) s'' - (m r + J/r) phi'' - m s phi'^2 + m g sin(phi) + k s = 0\n"
NUMBERS = "5.2222 s'' - 0.78333 phi'' - 3 s phi'^2 + 29.43 sin(phi) + 20 s = 0\n"
LAGRANGIAN = "L = 1.5 ((s' - 0.15 phi')^2 + s^2 phi'^2) + 0.025 (phi' - s'/0.15)^2 - 29.43 (s sin phi + 0.15 cos phi)"


@cache
def plank() -> Derivation:
    """A disc that rolls on a plank, which is rocked."""
    return loads(PLANK).derive()


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "answer",
    [
        "A = 0.122173\n" + LETTERS,
        "A = 0.122173\n" + NUMBERS,
        "A = 0.122 rad, m = 3 kg, r = 0.15 m\n" + NUMBERS,
        f"m + J/r² = 5.2222, m r + J/r = 0.78333, A = 0.122173 rad\n{LAGRANGIAN} - 10 s^2\n{NUMBERS}",
        NUMBERS + "where phi = 0.122173 sin(0.8 t)",
        NUMBERS + "where phi = 7 deg sin(0.8 t)",
        NUMBERS + "phi = 0.1222 sin(0.8 t), phi' = 0.09774 cos(0.8 t), phi'' = -0.07819 sin(0.8 t)",
        "A = 0.122173\n" + NUMBERS + "where phi = 0.122173 sin(0.8 t)",
        LETTERS + "phi = 0.122173 sin(0.8 t)",
        "M = m + J/r^2 = 5.222 kg\n" + NUMBERS,
        "With M = m + J/r^2:\n" + NUMBERS + "phi = 0.1222 sin(0.8 t)",
        LETTERS + NUMBERS,
        "5.2222 s'' + 0.06125 sin(0.8 t) - 0.028658 s cos(0.8 t)^2 + 29.43 sin(0.122173 sin(0.8 t)) + 20 s = 0",
        "s'' = (0.78333 phi'' + 3 s phi'^2 - 29.43 sin(phi) - 20 s)/5.2222",
    ],
)
def test_values_that_are_rounded(answer: str) -> None:
    verdict = plank().check(answer)
    assert verdict.right, verdict.to_text()
    assert not any(f.status.value == "wrong" for f in verdict.findings), verdict.to_text()


@pytest.mark.sampled(12)
@pytest.mark.parametrize(
    "answer",
    [
        "A = 0.122173\n" + NUMBERS.replace("- 0.78333", "+ 0.78333"),
        "A = 0.122173\n" + NUMBERS.replace("0.78333", "0.78433"),
        "A = 0.122173\n" + NUMBERS.replace("- 3 s", "- 4 s"),
        "A = 0.122173\n" + NUMBERS.replace("20 s", "10 s") + "where phi = 0.122173 sin(0.8 t)",
        "s'' = (0.78333 phi'' + 3 s phi'^2 - 29.43 sin(phi) - 20 s)/5.3222",
        "s'' = (0.78333 phi'' + 3 s phi'^2 - 29.43 sin(phi) - 21 s)/5.2222",
        "5.2222 s'' + 0.06125 cos(0.8 t) - 0.028658 s cos(0.8 t)^2 + 29.43 sin(0.122173 sin(0.8 t)) + 20 s = 0",
        LETTERS + NUMBERS.replace("- 3 s", "+ 3 s"),
        "M = m + J/r^2 = 5.222 kg\n" + NUMBERS.replace("20 s", "30 s"),
        "M = m + J/r^2 = 5.222 kg\n" + NUMBERS.replace("5.2222", "5.3222"),
        "A = 0.222173\n" + NUMBERS + "where phi = 0.122173 cos(0.8 t)",
    ],
)
def test_wrong_numbers_stay_wrong(answer: str) -> None:
    assert not plank().check(answer, hint=0).right


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    "line",
    [
        "phi = 0.122173 cos(0.8 t)",
        "phi = 0.132173 sin(0.8 t)",
        "phi'' = 0.07819 sin(0.8 t)",
        "phi' = 0.09774 sin(0.8 t)",
        "phi'' = -0.12217 sin(0.8 t)",
    ],
)
def test_a_wrong_motion_in_numbers_is_told(line: str) -> None:
    for rows in (LETTERS, NUMBERS):
        verdict = plank().check(rows + line)
        assert [f.line.text for f in verdict.findings if f.status.value == "wrong"] == [line], verdict.to_text()


def test_a_wrong_number_is_explained_with_values() -> None:
    told = plank().check("A = 0.122173\n" + NUMBERS.replace("20 s", "10 s")).to_text()
    assert "10 s should be 20 s" in told, told


LONGER = """
name = "arm that grows"
[coordinates]
theta = {}
[parameters]
J = "10 kg*m^2"
m = "5 kg"
k = "30 N*m/rad"
s0 = "2 m"
v = "0.4 m/s"
[define]
s = "s0 + v*t"
[[kinetic]]
value = "J/2*theta'^2 + m/2*(v^2 + s^2*theta'^2)"
[[potential]]
value = "k*theta^2/2"
"""
GROWS = "(10 + 5 s^2) theta'' + 4 s theta' + 30 theta = 0"


@pytest.mark.slow
def test_a_length_by_name_beside_its_rate_in_numbers() -> None:
    arm = loads(LONGER).derive()
    said = "s = 2 + 0.4 t\nT = 5 theta'^2 + 2.5 (0.16 + s^2 theta'^2)\nV = 15 theta^2\n"
    assert arm.check(said + GROWS, hint=0).right
    assert not arm.check(said + GROWS.replace("4 s", "5 s"), hint=0).right
    assert not arm.check(said + GROWS.replace("4 s", "2 s"), hint=0).right
