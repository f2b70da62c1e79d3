"""Lists of words and formulas of which some items cannot be read: winch F, drag -b x', rho^2 = x^2 + d^2.

Oracle: by hand, a slider on a rail at the distance d from the post of its cord, with a pendulum below it,

    (M + m) ẍ + m l (φ̈ cos φ − φ̇² sin φ) = F − b ẋ − k (ρ − a) x/ρ,   m l (ẍ cos φ + l φ̈ + g sin φ) = 0,   ρ² = x² + d²

and the bob's acceleration along the rail, ẍ + l φ̈ cos φ − l φ̇² sin φ.
"""

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.check.verdict import Status

SECOND = "m l (x'' cos(phi) + l phi'' + g sin(phi)) = 0"
BY_RHO = f"(M + m) x'' + m l (phi'' cos(phi) - phi'^2 sin(phi)) = F - b x' - k (rho - a) x/rho\n{SECOND}"
BY_BOB = f"M x'' + m a_b = F - b x' - k (sqrt(x^2 + d^2) - a) x/sqrt(x^2 + d^2)\n{SECOND}"
WITH_RHO = {
    "at the end": "winch F, drag -b x', cord -k (rho - a) x/rho,  rho^2 = x^2 + d^2",
    "in front": "rho^2 = x^2 + d^2; winch F, drag -b x', cord -k (rho - a) x/rho",
    "behind words": "winch F, drag -b x', length of the cord rho = sqrt(x^2 + d^2), cord -k (rho - a) x/rho",
    "behind a colon": "Forces along the rail: winch F, drag -b x', cord -k (rho - a) x/rho, rho = sqrt(x^2 + d^2)",
}
WITH_BOB = {
    "at the end": "Accelerations along the rail: slider x'', bob a_b = x'' + l phi'' cos(phi) - l phi'^2 sin(phi)",
    "in front": "bob a_b = x'' + l phi'' cos(phi) - l phi'^2 sin(phi), slider x''",
    "ended": "accelerations: slider x'', bob a_b = x'' + l phi'' cos(phi) - l phi'^2 sin(phi).",
}
ITEMS = "along: δ = δx + l cos φ δφ,   acceleration  x'' + l φ'' cos φ - l φ'^2 sin φ"
TOLD = "was not read"


@cache
def slider() -> lg.Derivation:
    """A slider with a pendulum, on a rail beside the post of a cord."""
    s = lg.System("slider with a pendulum")
    x, phi = s.coordinates("x phi")
    M, m, l, b, k, a, d, g = s.parameters("M m l b k a d g")
    s.particle(M, at=s.point("S", (x, 0)), name="slider")
    s.particle(m, at=s.point("B", (x + l * sp.sin(phi), -l * sp.cos(phi))), name="bob")
    s.gravity(direction=(0, -1), g=g)
    s.spring(k, deflection=sp.sqrt(x**2 + d**2), rest=a, name="cord")
    s.damper(b, deflection=x)
    s.force(s.input("F"), deflection=x)
    return s.derive()


def wrong_lines(answer: str) -> list[int]:
    verdict = slider().check(answer)
    assert verdict.status is Status.WRONG
    return [f.line.number for f in verdict.findings if f.status is Status.WRONG]


@pytest.mark.sampled(6)
@pytest.mark.parametrize("said", WITH_RHO)
def test_a_length_in_a_list_is_used(said: str) -> None:
    answer = f"{WITH_RHO[said]}\n{BY_RHO}"
    verdict = slider().check(answer)
    assert verdict.right
    assert said == "in front" or any(TOLD in str(x) for x in verdict.notes)
    assert wrong_lines(answer.replace("x^2 + d^2", "x^2 - d^2")) == [2]
    assert wrong_lines(answer.replace("- b x' - k", "- b x' + k")) == [2]
    assert wrong_lines(answer.replace("g sin", "2 g sin")) == [3]


def test_a_word_alone_in_front_is_a_word() -> None:
    said = "I use the length of the cord that is wound up, rho = sqrt(x^2 + d^2), instead of a formula for it.\n\n"
    assert slider().check(said + BY_RHO).right
    assert wrong_lines(said.replace("+ d", "- d") + BY_RHO) == [3]


@pytest.mark.sampled(4)
@pytest.mark.parametrize("said", WITH_BOB)
def test_an_acceleration_in_a_list_is_used(said: str) -> None:
    answer = f"{WITH_BOB[said]}\n{BY_BOB}"
    assert slider().check(answer).right
    assert 1 in wrong_lines(answer.replace("- l phi'^2", "+ l phi'^2"))
    assert wrong_lines(answer.replace("M x'' + m", "M x'' - m")) == [2]


@pytest.mark.parametrize("letter", ["D", "R"])
def test_a_force_in_the_letter_of_a_dissipation_function(letter: str) -> None:
    """No dissipation function begins with a minus and is linear in a rate; one without a minus may be a wrong one."""
    said = f"winch F, drag {letter} = -b x', cord C = -k (rho - a) x/rho,  rho^2 = x^2 + d^2\n"
    used = BY_RHO.replace("- b x'", f"+ {letter}")
    assert slider().check(said + BY_RHO).right
    assert slider().check(said + used).right
    assert 2 in wrong_lines(said.replace("-b x'", "-2 b x'") + used)
    assert wrong_lines(f"rho^2 = x^2 + d^2\n{letter} = b x'\n{BY_RHO}") == [2]


def test_what_cannot_be_read_is_told_and_does_not_decide() -> None:
    equations = BY_RHO.replace("rho", "sqrt(x^2 + d^2)")
    verdict = slider().check(f"{ITEMS}\n{equations}")
    assert verdict.right
    assert any("Line 1 has a part that was not read" in str(x) for x in verdict.notes)
    assert wrong_lines(f"{ITEMS}\n{equations.replace('- b x', '+ b x')}") == [2]


def test_an_equation_of_motion_in_a_list_must_be_read() -> None:
    with pytest.raises(lg.ParseError):
        slider().check(f"winch F, drag -b x', {BY_RHO.splitlines()[0]} @ 2, rho^2 = x^2 + d^2\n{BY_RHO}")


GOES_ON = ["length rho = 1, 5 d", "length rho = x, d", "length rho^2 = x^2, plus d^2", "length rho = x, twice d"]
UNPACKED = ["x, rho = d", "alone, apart, rho = x"]
IN_A_CASE = ["for x = 0, rho = d", "if x is small, rho = d", "rho = d for x = 0, rest a"]


@pytest.mark.sampled(4)
@pytest.mark.parametrize("item", [*GOES_ON, *UNPACKED, *IN_A_CASE])
def test_a_value_that_goes_on_or_holds_in_a_case_is_not_read(item: str) -> None:
    """A decimal comma, a column without brackets, words that add or change, names of entries, and conditions."""
    with pytest.raises(lg.ParseError):
        slider().check(f"winch F, cord -k (rho - a) x/rho, {item}\n{BY_RHO}")


def test_a_name_of_the_system_with_another_value_leaves_a_doubt() -> None:
    """What may say what b is decides whether an equation with b is wrong."""
    said = "winch F, drag -b x', half of it b = c/2 of the old one,  rho^2 = x^2 + d^2"
    with pytest.raises(lg.ParseError):
        slider().check(f"{said}\n{BY_RHO.replace('b x', '2 b x')}")
