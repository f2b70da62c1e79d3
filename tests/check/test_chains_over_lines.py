"""What goes on over several lines, v² = (…)² ⏎ = …, is told in the line in which the wrong part stands."""

from functools import cache

import pytest

import lagrangian as lg

STAGE = """
name = "wagon on a stage"
[coordinates]
phi = "stage"
s = "wagon along its rail"
[parameters]
J = "50 kg*m^2"
m = "26 kg"
d = "1.5 m"
c = "3 N*m*s"
[inputs]
Q = "N*m"
[[frame]]
name = "stage"
angle = "phi"
[points]
W = { frame = "stage", offset = ["s", "d"] }
[[kinetic]]
name = "stage"
value = "J*phi'^2/2"
[[particle]]
name = "wagon"
mass = "m"
at = "W"
[[damper]]
name = "bearing"
b = "c"
deflection = "phi"
[[torque]]
name = "motor"
value = "Q"
on = "phi"
"""
ROWS = """(J + m (d^2 + s^2)) phi'' - {k} m d s'' + 2 m s s' phi' = Q - c phi'
m s'' - {k} m d phi'' - m s phi'^2 = 0
"""
RIGHT = "(s' - d phi')^2 + s^2 phi'^2"
EXPANDED = "s'^2 - {} d s' phi' + (d^2 + s^2) phi'^2"


@cache
def stage() -> lg.Derivation:
    return lg.loads(STAGE).derive()


def wrong_lines(answer: str) -> list[int]:
    verdict = stage().check(answer)
    return [f.line.number for f in verdict.findings if not f.status.right and not f.follows]


def test_a_right_chain_is_right_in_each_line() -> None:
    text = f"v^2 = {RIGHT}\n    = {EXPANDED.format(2)}\nT = 1/2 J phi'^2 + 1/2 m v^2\n{ROWS.format(k='1')}"
    verdict = stage().check(text)
    assert verdict.right
    assert {1, 2} <= {f.line.number for f in verdict.findings}


@pytest.mark.parametrize(
    ("first", "second", "line"),
    [(RIGHT, EXPANDED.format(1), 2), (EXPANDED.format(1), EXPANDED.format(1), 1)],
)
def test_the_line_of_the_wrong_part_is_told(first: str, second: str, line: int) -> None:
    text = f"v^2 = {first}\n    = {second}\nT = 1/2 J phi'^2 + 1/2 m v^2\n{ROWS.format(k='1/2')}"
    verdict = stage().check(text)
    open_ones = [f.line.number for f in verdict.findings if not f.status.right and not f.follows]
    assert open_ones[0] == line, str(verdict)
    assert str(verdict.mistake.what).startswith(f"Line {line} is not right"), str(verdict)


def test_an_energy_is_told_where_it_goes_on() -> None:
    text = (
        f"T = 1/2 J phi'^2 + 1/2 m ({RIGHT})\n  = 1/2 J phi'^2 + 1/2 m ({EXPANDED.format(1)})\n{ROWS.format(k='1/2')}"
    )
    assert wrong_lines(text) == [2]
    text = f"T = 1/2 J phi'^2\n  + 1/2 m ({EXPANDED.format(1)})\n{ROWS.format(k='1/2')}"
    assert wrong_lines(text) == [1]


def test_an_equation_in_two_lines_stands_in_its_first() -> None:
    rows = ROWS.format(k="1").replace("2 m s s' phi' =", "m s s' phi'\n   =")
    verdict = stage().check(rows)
    assert [f.line.number for f in verdict.findings if not f.status.right] == [1], str(verdict)
