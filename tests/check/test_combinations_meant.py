"""A wrong equation that is the sum or the difference of two is compared with that, and not with one of them.

Oracle: a crank with an arm on its pin, φ from the ground and β from the crank. The equation of φ less that of β is the
balance of the crank alone, with the force of the arm on its pin.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.check.verdict import Verdict


@cache
def crank() -> lg.Derivation:
    """A crank of inertia J with a bob on an arm at its pin, a damper and a motor between both."""
    s = lg.System("crank and arm")
    phi, beta = s.coordinates("phi beta")
    J, m, R, e, b, c = s.parameters("J m R e b c")
    u = s.input("u")
    s.kinetic(J * phi.diff() ** 2 / 2, name="crank")
    bob = s.point("P", (R * sp.cos(phi) + e * sp.cos(phi + beta), R * sp.sin(phi) + e * sp.sin(phi + beta)))
    s.particle(m, at=bob, name="bob")
    s.damper(b, deflection=beta, name="pin")
    s.damper(c, deflection=phi, name="axle")
    s.torque(u, on=beta, name="wheel")
    return s.derive()


CRANK = "(J + m R^2) phi'' + m R e ((phi'' + beta'') cos(beta) - {rate}^2 sin(beta)) = -u - c phi' + b {damped}"
ARM = "m e^2 (phi'' + beta'') + {coupling}m R e (phi'' cos(beta) + phi'^2 sin(beta)) = u - b beta'"


def answer(rate: str = "(phi' + beta')", damped: str = "beta'", coupling: str = "") -> str:
    return f"{CRANK.format(rate=rate, damped=damped)}\n{ARM.format(coupling=coupling)}"


def told(verdict: Verdict) -> list[str]:
    return [str(m.what) for m in verdict.mistakes]


def test_the_difference_is_right() -> None:
    assert crank().check(answer()).right


@pytest.mark.slow
def test_a_relative_rate_is_named_in_the_difference() -> None:
    """Only the rate is wrong: neither u nor the terms of β are."""
    verdict = crank().check(answer(rate="beta'"))
    assert not verdict.right and [f.status.right for f in verdict.findings] == [False, True]
    assert "as the equation of φ less that of β" in str(verdict)
    assert len(told(verdict)) == 1 and "should be -R*e*m*(beta' + phi')^2*sin(beta)" in told(verdict)[0]


@pytest.mark.parametrize(("wrong", "said"), [("phi'", "b"), ("(phi' + beta')", "b*phi'")])
def test_a_damper_is_named_in_the_difference(wrong: str, said: str) -> None:
    verdict = crank().check(answer(damped=wrong))
    assert not verdict.right and said in " ".join(told(verdict))
    assert not any("term -u" in x or "term u" in x for x in told(verdict))


def test_each_line_has_its_own_mistake() -> None:
    """A rate in the difference, and a number in the other equation."""
    verdict = crank().check(answer(rate="beta'", coupling="2 "))
    assert [f.status.right for f in verdict.findings] == [False, False]
    assert any("should be -R*e*m*(beta' + phi')^2*sin(beta)" in x for x in told(verdict)) and len(told(verdict)) > 1


def test_an_equation_of_its_own_is_no_sum() -> None:
    """A wrong equation of β alone is compared with that of β."""
    verdict = crank().check(
        "(J + m R^2 + m e^2 + 2 m R e cos(beta)) phi'' + (m e^2 + m R e cos(beta)) beta''"
        " - m R e sin(beta) (2 phi' beta' + beta'^2) = -c phi'\n" + ARM.format(coupling="2 ")
    )
    assert "less that of" not in str(verdict) and [f.status.right for f in verdict.findings] == [True, False]
