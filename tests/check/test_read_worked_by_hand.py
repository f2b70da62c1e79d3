"""Answers worked out by hand, with names and words of their own, are judged as what they state.

Oracle: the equations of these small systems, whose mistakes are made here one by one.
"""

from __future__ import annotations

from functools import cache

import pytest

from lagrangian.check.verb import CheckedAnswer, check_answer
from lagrangian.derive import Derived
from lagrangian.read import loads
from lagrangian.structured.choose import derive_in_form

BAR = """
name = "bar on a crank"
[coordinates]
phi = "crank, from the top"
[parameters]
J = "0.7 kg*m^2"
m = "0.7 kg"
d = "0.7 m"
c = "0.7 N*m*s"
g = "9.81 m/s^2"
[inputs]
tau = "N*m"
[define]
l = "d/2"
[points]
N = ["0", "l*cos(phi)"]
[[particle]]
name = "bar"
mass = "m"
at = "N"
[[kinetic]]
name = "wheel"
value = "1/2*J*phi'^2"
[[gravity]]
direction = [0, -1]
[[damper]]
b = "c"
deflection = "phi"
[[torque]]
value = "tau"
on = "phi"
"""


@cache
def derived(system: str) -> Derived:
    return derive_in_form(loads(system).model())


def judged(answer: str, system: str = BAR, name: str = "a.txt") -> CheckedAnswer:
    return check_answer(derived(system), answer, name=name)


SLOPES = """Θ(φ) φ̈ + ½ (dΘ/dφ) φ̇² + c φ̇ + dV/dφ = τ
Θ(φ) = J + m l² sin² φ
dΘ/dφ = 2 m l² sin φ cos φ
dV/dφ = −m g l sin φ
"""


def test_slopes_that_are_stated_may_hold_names_that_the_system_defines() -> None:
    """Of an energy that no line states, its derivative has a value, dV/dφ = −m g l sin φ with l = d/2."""
    assert judged(SLOPES).status.name == "RIGHT"
    for wrong in (
        SLOPES.replace("−m g l", "m g l"),
        SLOPES.replace("½ ", ""),
        SLOPES.replace("m l² sin² φ", "2 m l² sin² φ"),
        SLOPES.replace("dV/dφ = −m g l sin φ", "dV/dφ = −m g l sin φ − τ"),
    ):
        assert not judged(wrong).right


LIFTS = """
name = "lift with a load"
[coordinates]
z = { description = "height", unit = "m" }
[parameters]
m0 = "0.7 kg"
m1 = "0.7 kg"
k = "0.7 N/m"
c = "0.7 N*s/m"
g = "9.81 m/s^2"
[inputs]
F = "N"
[points]
A = ["0", "z"]
B = ["0", "z + 1"]
[[particle]]
mass = "m0"
at = "A"
[[particle]]
mass = "m1"
at = "B"
[[gravity]]
direction = [0, -1]
[[spring]]
k = "k"
deflection = "z"
[[damper]]
b = "c"
deflection = "z"
[[force]]
value = "F"
deflection = "z"
"""


@pytest.mark.parametrize("sign", ["Σ", "∑", "∑ "])
def test_the_sign_of_a_sum_may_be_part_of_a_name(sign: str) -> None:
    """Σm := m0 + m1 says what Σm is; ∑F = m x'' only says what is added up."""
    answer = f"d/dt [ {sign}m ż ] = F − c ż − k z − {sign}m g,   {sign}m := m0 + m1"
    assert judged(answer, LIFTS).status.name == "RIGHT"
    for wrong in (answer.replace("m0 + m1", "m0 + m0"), answer.replace(f"− {sign}m g", f"+ {sign}m g")):
        assert judged(wrong, LIFTS).status.name == "WRONG"
    energy = (
        f"Power theorem dE/dt = P_nc :\nE = ½ {sign}m ż² + ½ k z² + {sign}m g z, {sign}m = m0 + m1\nP_nc = F ż − c ż²"
    )
    assert judged(energy, LIFTS).right
    assert not judged(energy.replace("− c", "+ c"), LIFTS).right
    assert judged(f"{sign}F = (m0 + m1) z'' = F − c z' − k z − (m0 + m1) g", LIFTS).status.name == "RIGHT"


def test_the_sign_of_a_sum_in_latex_may_be_part_of_a_name() -> None:
    answer = r"\[ \sum m\,\ddot z = F - c\dot z - k z - \sum m\,g,\qquad \sum m = m_0 + m_1 \]"
    assert judged(answer, LIFTS).status.name == "RIGHT"
    assert judged(answer.replace("m_0 + m_1", "m_1 + m_1"), LIFTS).status.name == "WRONG"
