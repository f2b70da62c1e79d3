"""Denominators without brackets, 1/2 m x'^2, which are read the other way, 1/(2 m), only where that may be meant.

Oracle: m ẍ + b ẋ + k x = 0 of a block on a spring with a damper, and what a student states with 1/2 m in either sense.
"""

from functools import cache

import pytest

from lagrangian import loads
from lagrangian.check.reading import Answer, parse_answer, reads_flipped
from lagrangian.check.readings_compared import program_of, without_flipped
from lagrangian.check.reference import truth_of
from lagrangian.derivation import Derivation

BLOCK = """
name = "block on a spring"
[coordinates]
x = "position"
[parameters]
m = "2 kg"
k = "8 N/m"
b = "0.5 N s/m"
[points]
C = ["x", "0"]
[[particle]]
mass = "m"
at = "C"
[[spring]]
k = "k"
deflection = "x"
[[damper]]
b = "b"
deflection = "x"
"""


@cache
def block(m: str = "2 kg") -> Derivation:
    return loads(BLOCK.replace("2 kg", m)).derive()


def read(answer: str, m: str = "2 kg") -> tuple[Answer, Answer]:
    """What is read, and the same without denominators the other way."""
    found = parse_answer(answer, block(m).model)
    return found, without_flipped(truth_of(block(m)), found)


WRONG = "m x'' + 2 b x' + k x = 0"


@pytest.mark.parametrize(
    "energies",
    [
        "T = 1/2 m x'^2\nV = 1/2 k x^2\n",
        "T = 1/2 m x'^2\nV = 1/2 k (x + 1)^2\n",
        "T = 1/2 (m) x'^2\nV = k x^2/2\n",
        "T = 2/4 m x'^2\n",
        "T = 0.5 m x'^2\nV = 1/2 k x^2\n",
        "L = 1/2 m x'^2 - 1/2 k x^2\n",
    ],
)
def test_an_energy_that_is_right_says_how_denominators_are_meant(energies: str) -> None:
    found, left = read(energies + WRONG)
    assert any(map(reads_flipped, found.others))
    assert not any(map(reads_flipped, left.others))
    verdict = block().check(energies + WRONG)
    assert not verdict.right
    assert [f.line.kind for f in verdict.findings if f.differences] in (["equation"], ["V", "equation"])
    assert block().check(energies.replace("(x + 1)", "x") + WRONG.replace("2 b", "b")).right


@pytest.mark.parametrize(
    ("energies", "m"),
    [
        ("T = 1/2 k x'^2\n", "2 kg"),  # wrong either way
        ("T = 0.5 m x'^2\nx'' = -1/m k x\n", "2 kg"),  # says nothing of fractions of numbers
        ("T = 1/2 m x'^2 + 1/2 k\n", "2 kg"),  # a constant more
        ("T = 1/2 m x'^2\n", "1 kg"),  # with m = 1 both are the same
        ("m = 1\nT = 1/2 m x'^2\n", "2 kg"),
    ],
)
def test_elsewhere_they_are_read_the_other_way_as_well(energies: str, m: str) -> None:
    found, left = read(energies + WRONG, m)
    assert any(map(reads_flipped, found.others))
    assert left is found


@pytest.mark.parametrize(
    "answer",
    [
        "x'' = -1/m (b x' + k x)",
        "T = 0.5 m x'^2\nx'' + b/m x' + k/m x = 0",
        "T = 1/2 m x'^2\nV = 1/2 k x^2\nm x'' + b x' + k x = 0",
    ],
)
def test_right_answers_are_right_in_the_sense_in_which_they_are(answer: str) -> None:
    assert block().check(answer).right


def test_only_what_is_carried_out_has_a_reading_as_a_program() -> None:
    found, _ = read(f"T = 1/2 m x'^2\n{WRONG}")
    assert found.others
    assert program_of(found) is None
