"""An equation is told by the one term of it that is wrong as it is written, also beside another mistake, and where one
mass stands for two."""

from functools import cache

import pytest

import lagrangian as lg

ROLLS = """
name = "two rolls with a web"
[coordinates]
alpha = "feed roll"
beta = "pull roll"
[parameters]
J1 = "3 kg*m^2"
J2 = "0.4 kg*m^2"
R = "0.4 m"
r = "0.1 m"
k = "2500 N/m"
c = "40 N*s/m"
d = "2 N*m*s"
[inputs]
Q = "N*m"
[[kinetic]]
name = "rolls"
value = "J1*alpha'^2/2 + J2*beta'^2/2"
[[spring]]
name = "web"
k = "k"
deflection = "r*beta - R*alpha"
[[damper]]
name = "web loss"
b = "c"
deflection = "r*beta - R*alpha"
[[damper]]
name = "brake"
b = "d"
deflection = "alpha"
[[torque]]
name = "motor"
value = "Q"
on = "beta"
"""
WEB = "N = k (r beta - R alpha) + c (r beta' - R alpha')\nJ1 alpha'' = N R - {} alpha'\nJ2 beta'' = Q - N {}\n"

SHAKER = """
name = "table with an eccentric"
[coordinates]
x = "table"
phi = "eccentric"
[parameters]
M = "35 kg"
m = "2 kg"
e = "6 cm"
J = "0.03 kg*m^2"
k = "8 kN/m"
b = "90 N*s/m"
c = "0.02 N*m*s"
[inputs]
Q = "N*m"
[points]
A = ["x", "0"]
S = ["x + e*cos(phi)", "e*sin(phi)"]
[[particle]]
name = "table"
mass = "M"
at = "A"
[[kinetic]]
name = "rotor"
value = "J*phi'^2/2"
[[particle]]
name = "eccentric"
mass = "m"
at = "S"
[[spring]]
name = "spring"
k = "k"
deflection = "x"
[[damper]]
name = "rail"
b = "b"
deflection = "x"
[[damper]]
name = "bearing"
b = "c"
deflection = "phi"
[[torque]]
name = "motor"
value = "Q"
on = "phi"
"""
SOLVED = """x'' = [(J + m e^2) f1 + m e sin(phi) f2]/D
phi'' = [m e sin(phi) f1 + {} f2]/D
f1 = m e cos(phi) phi'^2 - b x' - k x
f2 = Q - c phi'
D = (M + m)(J + m e^2) - (m e sin(phi))^2
"""


@cache
def system(text: str) -> lg.Derivation:
    return lg.loads(text).derive()


def test_the_arm_of_a_force_is_told_beside_another_mistake() -> None:
    rolls = system(ROLLS)
    assert rolls.check(WEB.format("d", "r")).right
    verdict = rolls.check(WEB.format("2 d", "R"))
    words = [str(m.what) for m in verdict.mistakes]
    assert len(words) == 2 and "brake" in words[0] and "-R*N should be -r*N" in words[1], words
    shown = [str(d.term) for f in verdict.findings if f.line.number == 3 for d in f.differences]
    assert len(shown) == 1, shown
    assert not any("other ways" in str(n) for n in verdict.notes)


@pytest.mark.slow
@pytest.mark.parametrize("mass", ["M", "m"])
def test_one_mass_for_two_is_told_as_it_is_written(mass: str) -> None:
    shaker = system(SHAKER)
    assert shaker.check(SOLVED.format("(M + m)")).right
    verdict = shaker.check(SOLVED.format(mass))
    assert [f.line.number for f in verdict.findings if not f.status.right and not f.follows] == [2]
    words = str(verdict.mistake.what)
    assert f"{mass}*f2 " in words and "(M + m)*f2" in words, words
