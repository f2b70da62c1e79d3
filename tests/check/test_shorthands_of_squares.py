"""A wrong shorthand of a square, ω² = k/M, is told at its own line and by what was written, also in a list."""

from functools import cache

import pytest

import lagrangian as lg

TABLE = """
name = "table with a rider"
[coordinates]
x = "table"
[parameters]
M = "35 kg"
m = "2 kg"
k = "8 kN/m"
b = "90 N*s/m"
[inputs]
F = "N"
[points]
A = ["x", "0"]
[[particle]]
name = "table"
mass = "M"
at = "A"
[[particle]]
name = "rider"
mass = "m"
at = "A"
[[spring]]
name = "spring"
k = "k"
deflection = "x"
[[damper]]
name = "damper"
b = "b"
deflection = "x"
[[force]]
name = "push"
value = "F"
deflection = "x"
"""
LIST = "I use\n\n- ω₀² = {}\n- 2δ = b/M*\n- M* = M + m\n\nx'' + 2δ x' + ω₀² x = F/M*\n"


@cache
def table() -> lg.Derivation:
    return lg.loads(TABLE).derive()


def test_starred_names_in_a_list_are_read() -> None:
    assert table().check(LIST.format("k/M*")).right
    assert table().check(LIST.format("k/(M + m)")).right


@pytest.mark.parametrize(
    ("value", "right", "written"),
    [("k/M", "k/(M + m)", "k/M"), ("2 k/(M + m)", "k/(M + m)", "2*k/(M + m)"), ("k/m", "k/(M + m)", "k/m")],
)
def test_a_wrong_square_is_told_at_its_line(value: str, right: str, written: str) -> None:
    verdict = table().check(LIST.format(value))
    open_ones = [f.line.number for f in verdict.findings if not f.status.right and not f.follows]
    assert open_ones == [3], str(verdict)
    words = str(verdict.mistake.what)
    assert words.startswith("Line 3 is not right") and f"is {right}, not {written}" in words, words
    assert "^2 is" in words, words


def test_what_is_no_square_is_not_told_as_one() -> None:
    """With ω₀ = k/M the equation has (k/M)²."""
    verdict = table().check(LIST.format("k/M").replace("- ω₀²", "- ω₀"))
    assert "^2 is" not in str(verdict.mistake.what) and "(M + m), not k/M" not in str(verdict.mistake.what)
