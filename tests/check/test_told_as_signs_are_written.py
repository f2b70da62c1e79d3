"""A sign is only said to be wrong if it was written: ½ k a² sin²φ for ½ k a² cos²φ has its sign, though but for a
constant it is the same as −½ k a² cos²φ."""

from functools import cache

import pytest

import lagrangian as lg

FLAP = """
name = "flap on a spring"
[coordinates]
phi = "flap from the wall"
[parameters]
J = { value = "2 kg*m^2" }
a = { value = "0.4 m" }
k = { value = "70 N/m" }
[inputs]
Q = "N*m"
[[kinetic]]
name = "flap"
value = "J*phi'^2/2"
[[spring]]
name = "strut"
k = "k"
deflection = "a*cos(phi)"
[[torque]]
name = "motor"
value = "Q"
on = "phi"
"""


@cache
def flap() -> lg.Derivation:
    return lg.loads(FLAP).derive()


ANSWER = "T = 1/2 J phi'^2\nV = {}\nJ phi'' {} k a^2 sin(phi) cos(phi) = Q"


@pytest.mark.parametrize("energy", ["1/2 k a^2 sin(phi)^2", "1/2 k (a sin(phi))^2", "k/2 a² sin²(phi)"])
def test_a_spring_with_the_other_function_keeps_its_sign(energy: str) -> None:
    verdict = flap().check(ANSWER.format(energy, "+"))
    assert [f.line.number for f in verdict.findings if not f.status.right and not f.follows] == [2]
    words = str(verdict.mistake.what)
    assert "Sine and cosine are exchanged" in words, words
    others = [str(m.what) for m in (*verdict.mistakes, *verdict.alternatives)]
    assert not any("sign" in x or "-a*sin" in x for x in others), others


def test_a_wrong_sign_that_is_written_is_told() -> None:
    verdict = flap().check(ANSWER.format("-1/2 k a^2 cos(phi)^2", "+"))
    assert "wrong sign" in str(verdict.mistake.what)
    verdict = flap().check("J phi'' + k a^2 sin(phi) cos(phi) = Q")
    assert "wrong sign" in str(verdict.mistake.what)


def test_the_zero_of_an_energy_is_free() -> None:
    for energy in ("1/2 k a^2 cos(phi)^2", "-1/2 k a^2 sin(phi)^2"):
        assert flap().check(ANSWER.format(energy, "-")).right
