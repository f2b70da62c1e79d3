"""What only repeats a wrong line above, times a factor, follows from it and is held against no equation of motion."""

from functools import cache

import pytest
from test_one_term_beside import ROLLS

import lagrangian as lg

ANSWER = """e = r beta - R alpha
v = {}
N = k e {} c v
alpha'' = (N R - d alpha')/J1
beta'' = (Q - N r)/J2
"""

WINCH = """
name = "flap with a rope on a drum"
[coordinates]
theta = "flap"
[parameters]
J = "50 kg*m^2"
Jd = "2 kg*m^2"
b = "1.5 m"
r = "0.1 m"
c = "3 N*m*s"
[inputs]
Q = "N*m"
[define]
s = "2*b*sin(pi/4 + theta/2)"
[[kinetic]]
name = "flap"
value = "J*theta'^2/2 + Jd*(s'/r)^2/2"
[[damper]]
name = "hinge"
b = "c"
deflection = "theta"
[[torque]]
name = "crew"
value = "-Q"
on = "s/r"
"""
DRUM = """s' = {0} b cos(pi/4 + theta/2) theta'
drum: phi' = s'/r = ({0} b/r) cos(pi/4 + theta/2) theta'
T = 1/2 J theta'^2 + 1/2 Jd ({0} b/r)^2 cos(pi/4 + theta/2)^2 theta'^2
Q_theta = -c theta' - {1} Q (b/r) {2}(pi/4 + theta/2)
"""


@cache
def system(text: str) -> lg.Derivation:
    return lg.loads(text).derive()


def wrong_lines(verdict: lg.CheckedAnswer) -> list[int]:
    return [f.line.number for f in verdict.findings if not f.status.right and not f.follows]


@pytest.mark.sampled(4)
@pytest.mark.parametrize("wrong", ["r beta' + R alpha'", "r beta' - R", "r beta'"])
def test_a_force_follows_from_a_wrong_rate(wrong: str) -> None:
    verdict = system(ROLLS).check(ANSWER.format("r beta' - R alpha'", "+"))
    assert verdict.right
    verdict = system(ROLLS).check(ANSWER.format(wrong, "+"))
    assert wrong_lines(verdict) == [2], str(verdict)


def test_a_force_with_a_mistake_of_its_own_is_told() -> None:
    assert 3 in wrong_lines(system(ROLLS).check(ANSWER.format("r beta' - R alpha'", "-")))
    assert 3 in wrong_lines(system(ROLLS).check(ANSWER.format("r beta' + R alpha'", "+ 2")))


@pytest.mark.slow
def test_a_rate_that_repeats_another_follows() -> None:
    assert not wrong_lines(system(WINCH).check(DRUM.format("1", "1", "cos")))
    verdict = system(WINCH).check(DRUM.format("2", "1", "cos"))
    assert wrong_lines(verdict) == [1], str(verdict)
    assert not any(
        d.term.has(system(WINCH).coordinates[0].diff("t", 2)) for f in verdict.findings for d in f.differences
    )


@pytest.mark.sampled(4)
@pytest.mark.parametrize(("sign", "function"), [("+", "cos"), ("- 2", "cos"), ("-", "sin")])
def test_a_term_is_told_with_its_whole_angle(sign: str, function: str) -> None:
    angle = "(pi/4 + theta/2)"
    row = f"(J + Jd (b/r)^2 cos{angle}^2) theta'' - 1/2 Jd (b/r)^2 sin{angle} cos{angle} theta'^2"
    verdict = system(WINCH).check(f"{row} = -c theta' {sign} Q (b/r) {function}(pi/4 + theta/2)")
    shown = [d for f in verdict.findings for d in f.differences]
    assert len(shown) == 1 and not shown[0].written.is_Add and "sqrt" not in str(shown[0]), shown


TENSION = """gamma = pi/4 + theta/2
J theta'' = -c theta' - Z b cos(gamma)
Z = (Jd s''/r {} Q)/r
"""


def test_a_wrong_force_is_told_at_its_line_beside_another_name() -> None:
    """The balance of the flap has no Q: it is wrong in what the tension is, whatever its angle is called."""
    assert system(WINCH).check(TENSION.format("+")).right
    verdict = system(WINCH).check(TENSION.format("-"))
    assert wrong_lines(verdict) == [3], str(verdict)


DRUM_TOO = """gamma = pi/4 + theta/2
J theta'' = -c theta' - Z b cos(gamma)
Drum: r phi' = s'
Jd phi'' = Z r {other} Q
  -> Z = (Jd s''/r {sign} Q)/r
(J + Jd (b/r)^2 cos(gamma)^2) theta'' - 1/4 Jd (b/r)^2 sin(2 gamma) theta'^2 = -c theta' {other} Q (b/r) cos(gamma)
"""


def test_a_wrong_force_that_was_solved_is_told_at_its_line() -> None:
    assert system(WINCH).check(DRUM_TOO.format(sign="+", other="-")).right
    verdict = system(WINCH).check(DRUM_TOO.format(sign="-", other="+"))
    assert wrong_lines(verdict)[0] in (4, 5), str(verdict)
    assert not any(f.line.number == 2 and not f.follows and not f.status.right for f in verdict.findings), str(verdict)
