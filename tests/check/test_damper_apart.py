"""A wrong rate in D is the damper's own, unless the spring beside it is wrong in the same way."""

from __future__ import annotations

from functools import cache

import pytest

from lagrangian import loads
from lagrangian.derivation import Derivation

HOIST = """
name = "lever and crate"
[coordinates]
phi = { description = "lever", unit = "rad" }
y = { description = "crate, downwards", unit = "m" }
[parameters]
J = "2 kg*m^2"
m = "11 kg"
a = "0.6 m"
k = "900 N/m"
d = "14 N*s/m"
[[kinetic]]
value = "J*phi'^2/2 + m*y'^2/2"
[[spring]]
name = "sling"
k = "k"
deflection = "y - a*phi/3"
[[damper]]
name = "brake"
b = "d"
deflection = "y - a*phi/3"
"""
T = "T = 1/2 J phi'^2 + 1/2 m y'^2\n"


@cache
def hoist() -> Derivation:
    return loads(HOIST).derive()


@pytest.mark.parametrize("potential", ["1/2 k (y - a phi/3)^2", "k (y - a phi/3)^2", "1/4 k (y - a phi/3)^2"])
def test_a_wrong_rate_is_the_dampers_alone(potential: str) -> None:
    """The deflection of the spring is right, whatever its factor is."""
    verdict = hoist().check(f"{T}V = {potential}\nD = 1/2 d (y' - a phi')^2\n")
    told = [m for m in verdict.mistakes if "phi" in str(m.what)]
    assert told and not any("sling" in str(m.what) for m in told)
    assert {m.step for m in told} == {6}


def test_a_length_that_is_wrong_in_both_is_told_of_both() -> None:
    verdict = hoist().check(f"{T}V = 1/2 k (y - a phi)^2\nD = 1/2 d (y' - a phi')^2\n")
    assert len(verdict.mistakes) == 1
    assert "sling" in str(verdict.mistake.what) and "brake" in str(verdict.mistake.what)
