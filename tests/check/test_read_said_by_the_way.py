"""What sheets say by the way: numbers below LaTeX, what a letter is with its value, definitions in words, forces in lists.

Oracle: small systems with equations by hand. Every form has a wrong twin.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg


@cache
def flap() -> lg.Derivation:
    """A flap on a torsion spring that is relaxed at theta0, with a damper and a motor."""
    s = lg.System("flap")
    theta = s.coordinate("theta")
    values = {"J": "0.5 kg m^2", "kappa": "3 N m", "d": "0.25 N m s", "theta0": "30 deg", "m": "2 kg", "a": "0.4 m"}
    J, kappa, d, theta0, m, a, g = (s.parameter(x, v) for x, v in [*values.items(), ("g", "9.81 m/s^2")])
    s.kinetic(J * theta.diff() ** 2 / 2, name="flap")
    s.potential(kappa * (theta - theta0) ** 2 / 2, name="spring")
    s.particle(m, at=s.point("C", (a * sp.sin(theta), -a * sp.cos(theta))), name="weight")
    s.gravity(direction=(0, -1), g=g)
    s.damper(d, deflection=theta)
    s.torque(s.input("M"), on=theta, name="motor")
    return s.derive()


FLAP = r"""$$(J + m a^2)\ddot\theta + d\dot\theta + \kappa(\theta - \theta_0) + m g a\sin\theta = M$$

Mit Zahlen (SI): 0,82·θ̈ + 0,25·θ̇ + 3·(θ − π/6) + 7,848·sin θ = M"""


@pytest.mark.parametrize(
    ("now", "wrong"), [("0,82", "0,80"), ("+ 7,848", "− 7,848"), ("0,25·θ̇", "0,25·θ"), ("0,82·θ̈", "0,82")]
)
def test_numbers_in_a_line_below_latex_may_have_commas(now: str, wrong: str) -> None:
    assert flap().check(FLAP).right
    assert "line 3" in flap().check(FLAP).to_text()
    assert now in FLAP and not flap().check(FLAP.replace(now, wrong)).right


SHORT = """J th'' + m a^2 th'' + d th' + kappa (th - th0) + m g a sin(th) = M
th = theta, th0 = theta0 = 30 deg"""


@pytest.mark.parametrize("value", ["30 deg", "pi/6", "30°", "0.5236 rad", "0.5236"])
def test_a_name_may_be_said_to_be_a_parameter_with_its_value(value: str) -> None:
    text = SHORT.replace("30 deg", value)
    verdict = flap().check(text)
    assert verdict.right and "another one" not in verdict.to_text()
    assert not flap().check(text.replace("(th - th0)", "(th + th0)"), hint=0).right
    assert not flap().check(text.replace("th0 = theta0", "th0 = 2 theta0"), hint=0).right


def test_another_value_is_told_as_an_assumption() -> None:
    verdict = flap().check(SHORT.replace("30 deg", "1.5"))
    assert verdict.right and "1.5" in verdict.to_text()
    assert flap().check(SHORT.replace("theta0 = 30 deg", "theta0"), hint=0).right
