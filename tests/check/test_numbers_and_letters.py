"""Answers in numbers that keep some letters, or have numbers that stand in every equation, 3 ẍ + 2 s̈ = 0.

Each line is judged with the values put in, whatever is wrong in another one. A letter whose value is 1 may be among
these only where others are numbers too. Oracle: by hand. Wedge: M = 4, m = 1, α = 30°. Carts: m₁ = 1, m₂ = 2, k = 40.
Cart with a pole: M = 1, m = 0.2, l = 0.3, J = 0.006, b = 0.1. Disks: J₁ = 0.02, J₂ = 0.05, b = 0.05, k = 200.
"""

from __future__ import annotations

import pytest

from built_in import derivation
from lagrangian import CheckedAnswer, loads

WEDGE = "5 x'' + s'' cos(alpha) = F\nx'' cos(alpha) + s'' = 9.81 sin(alpha)"
CARTS = "3 x1'' + 2 x2r'' = 0\n2 (x1'' + x2r'') + 40 x2r = F"
POLE = """1.2 x'' + 0.06 theta'' cos(theta) - 0.06 theta'^2 sin(theta) + b x' = F
0.06 x'' cos(theta) + (J + 0.018) theta'' - 0.06 g sin(theta) = 0"""
DISKS = """T = J1 phi1'^2/2 + J2 phi2'^2/2
0.02 phi1'' + 0.05 (phi1' - phi2') + 200 (phi1 - phi2) = tau
0.05 phi2'' - 0.05 (phi1' - phi2') + 0.01 phi2' + 200 (phi2 - phi1) = 0"""
SLED = """
name = "sled on a slope"
[coordinates]
s = "down the slope"
[parameters]
m = "1 kg"
k = "20 N/m"
beta = "25 deg"
g = "9.81 m/s^2"
[[kinetic]]
value = "m/2*s'^2"
[[potential]]
value = "-m*g*s*sin(beta)"
[[spring]]
k = "k"
deflection = "s"
"""


def verdicts(checked: CheckedAnswer) -> str:
    """R or W for every line."""
    return "".join("R" if f.status.right else "W" for f in checked.findings)


@pytest.mark.sampled(5)
@pytest.mark.parametrize(
    ("system", "answer"),
    [
        ("wedge", WEDGE),
        ("wedge", WEDGE.replace("9.81", "g")),
        ("wedge", WEDGE.replace(".", ",")),
        ("lecture-3b", CARTS),
        ("lecture-3b", CARTS.replace("40", "k")),
        ("cart-pole", POLE),
        ("two-disk-shaft", DISKS),
        ("two-disk-shaft", DISKS.replace("200", "k")),
    ],
)
def test_right_numbers_beside_letters(system: str, answer: str) -> None:
    assert derivation(system).check(answer, hint=0).right


@pytest.mark.sampled(12)
@pytest.mark.parametrize(
    ("system", "answer", "lines", "told"),
    [
        ("wedge", WEDGE.replace("9.81 sin", "9.81 cos"), "RW", "9.81 cos α should be 9.81 sin α"),
        ("wedge", WEDGE.replace("9.81 sin", "4.7 sin"), "RW", "4.7 sin α should be 9.81 sin α"),
        ("wedge", WEDGE.replace("5 x''", "4 x''"), "WR", "4 ẍ should be 5 ẍ"),
        ("wedge", WEDGE.replace("9.81", "0.5 g"), "RW", "g sin α"),
        ("lecture-3b", CARTS.replace("40", "4"), "RW", "4 x_2r should be 40 x_2r"),
        ("lecture-3b", CARTS.replace("+ 40", "- k"), "RW", "−k x_2r has the wrong sign"),
        ("cart-pole", POLE.replace("- 0.06 theta'^2", "+ 0.06 theta'^2"), "WR", "0.06 θ̇² sin θ has the wrong sign"),
        ("cart-pole", POLE.replace("0.018", "0.025"), "RW", "0.025 θ̈"),
        ("two-disk-shaft", DISKS.replace("200 (phi1", "20 (phi1"), "RWR", "20 φ₁ should be 200 φ₁"),
    ],
)
def test_a_wrong_number_leaves_the_other_lines_right(system: str, answer: str, lines: str, told: str) -> None:
    checked = derivation(system).check(answer)
    assert verdicts(checked) == lines
    assert told in " ".join(checked.to_text().split())


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("system", "answer", "one"),
    [
        ("wedge", "V = -g s sin(alpha)", "m = 1"),
        ("wedge", "(M + 1) x'' + s'' cos(alpha) = F\nx'' cos(alpha) + s'' = g sin(alpha)", "m = 1"),
        ("wedge", "(M + m) x'' + s'' cos(alpha) = F\nm x'' cos(alpha) + m s'' = m g sin(alpha)", ""),
        ("pendulum", "V = -9.81 L cos(theta)", "m = 1"),
        ("pendulum", "L^2 theta'' + b theta' + g L sin(theta) = 0", "m = 1"),
        ("lecture-3b", "x1'' + m2 (x1'' + x2r'') = 0\nm2 (x1'' + x2r'') + 40 x2r = F", ""),
    ],
)
def test_a_letter_that_was_forgotten_is_missed(system: str, answer: str, one: str) -> None:
    """Other masses are letters, or nothing else than g is a number."""
    checked = derivation(system).check(answer)
    assert not checked.right
    assert not one or f"right with {one}" in checked.to_text()


@pytest.mark.sampled(4)
@pytest.mark.parametrize(("weight", "right"), [("9.81", True), ("g", True), ("8.81", False), ("9.81*2", False)])
def test_a_mass_of_1_is_a_number_where_the_stiffness_is_one(weight: str, right: bool) -> None:
    sled = loads(SLED).derive()
    assert sled.check(f"s'' + 20 s = {weight} sin(beta)", hint=0).right is right
    assert sled.check(f"s'' + 20 s - {weight} sin(beta) = 0", hint=0).right is right
    assert not sled.check(f"s'' + k s = {weight} sin(beta)", hint=0).right  # m may be forgotten


def test_decimals_are_told_as_they_are_written() -> None:
    told = derivation("pendulum").check("0.5 theta'' + 0.02 theta' + 4.905 sin(theta) = 0").to_text()
    assert "0.5 θ̈ should be 0.25 θ̈" in told
    assert "½ θ̈" in derivation("pendulum").check("1/2 theta'' + 0.02 theta' + 4.905 sin(theta) = 0").to_text()


def test_a_force_is_no_term_of_the_motion() -> None:
    """Two mistakes are two entries, and the one that follows from a force above says so."""
    rows = "(M + m) x'' + m l theta'' cos(theta) + b x' = F + {0}\nm l x'' cos(theta) + (J + m l^2) theta'' = {1}"
    rows = rows.format("F/l", "m g l sin(theta)")
    told = " ".join(derivation("cart-pole").check(f"Xi_x = F + F/l - b x'\n{rows}").to_text().split())
    assert "the term F/l does not belong there. It follows from line 1" in told
    assert "the term −m l θ̇² sin θ is missing" in told
