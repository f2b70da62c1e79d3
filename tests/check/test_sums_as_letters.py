"""What is wrong beside sums of parameters, R − r, is told as somebody wrote it and not by the pieces of these sums.

Oracle: the mistakes that are planted in the lines of a roller in a gutter on a cart.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian import loads

T = "T = 1/2 M x'^2 + 1/2 m (x'^2 + 2 (R-r) x' phi' cos phi + (R-r)^2 phi'^2) + 1/2 J (R-r)^2/r^2 phi'^2"
LINES = f"""{T}
V = 1/2 k x^2 - m g (R-r) cos phi
Q_x = F - c x'
Q_phi = -b phi'
(M+m) x'' + m (R-r) (phi'' cos phi - phi'^2 sin phi) + c x' + k x = F
(m (R-r)^2 + J (R-r)^2/r^2) phi'' + m (R-r) x'' cos phi + m g (R-r) sin phi + b phi' = 0"""


@cache
def gutter() -> lg.Derivation:
    s = lg.System("roller in a gutter on a cart")
    x, phi = s.coordinates("x phi")
    M, m, J, R, r, k, c, b, g = s.parameters("M m J R r k c b g")
    cart = s.point("A", (x, 0))
    centre = s.point("P", (x + (R - r) * sp.sin(phi), -(R - r) * sp.cos(phi)))
    s.particle(M, at=cart, name="cart")
    s.rigid_body(m, J, at=centre, frame=s.frame(-(R - r) / r * phi, name="roller"), name="roller")
    s.gravity((0, -1), g)
    s.spring(k, deflection=x, name="cart spring")
    s.damper(c, deflection=x, name="cart damper")
    s.damper(b, deflection=phi, name="rolling friction")
    s.force((s.input("F"), 0), at=cart, name="push")
    return s.derive()


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"1/2 J (R-r)^2/r^2": "1/2 J (R-r)/r", "J (R-r)^2/r^2)": "J (R-r)/r)"}, "(R - r)/r stands once, and belongs"),
        ({"J (R-r)^2/r^2) phi''": "J (R-r)^2/r) phi''"}, "one divisor r is missing"),
        ({"(m (R-r)^2 + J": "(m (R-r) + J"}, "R - r stands once, and belongs there squared"),
        (
            {"Q_phi = -b phi'": "Q_phi = -b (R-r)/r phi'", "+ b phi' = 0": "+ b (R-r)/r phi' = 0"},
            "the factor is (R - r)/r; it should be 1",
        ),
        (
            {"Q_phi = -b phi'": "Q_phi = F (R-r) cos phi - b phi'", "+ b phi' = 0": "+ b phi' = F (R-r) cos phi"},
            "Force 'push' is counted in the equation of phi",
        ),
        (
            {"1/2 J (R-r)^2/r^2": "1/2 J r^2/(R-r)^2", "J (R-r)^2/r^2)": "J r^2/(R-r)^2)"},
            "is (R - r)*phi'/r, not r*phi'/(R - r)",
        ),
        (
            {"1/2 J (R-r)^2/r^2": "1/2 J (R+r)^2/r^2", "J (R-r)^2/r^2)": "J (R+r)^2/r^2)"},
            "J*(R + r)^2*phi'^2/(2*r^2) stands where J*(R - r)^2*phi'^2/(2*r^2) belongs",
        ),
        ({"1/2 J (R-r)^2/r^2": "1/2 J R^2/r^2", "J (R-r)^2/r^2)": "J R^2/r^2)"}, "is (R - r)*phi'/r, not R*phi'/r"),
        (
            {"Q_phi = -b phi'": "Q_phi = -b (R-r)^2/r^2 phi'", "+ b phi' = 0": "+ b (R-r)^2/r^2 phi' = 0"},
            "is taken as (R - r)*phi'/r; it is phi'",
        ),
    ],
)
def test_a_mistake_beside_a_sum_is_told_with_the_sum(changes: dict[str, str], told: str) -> None:
    written = LINES
    for old, new in changes.items():
        assert old in written
        written = written.replace(old, new)
    verdict = gutter().check(written)
    (mistake,) = verdict.mistakes
    assert told in str(mistake.what)
    assert "sum" not in str(verdict).replace("sum of", "")


def test_the_right_answer_is_right_and_a_left_out_length_is_told_without_letters() -> None:
    assert gutter().check(LINES).right
    verdict = gutter().check(LINES.replace("(R-r)", "R").replace("m g R", "m g (R-r)").replace("J R^2", "J (R-r)^2"))
    assert "r is left out" in str(verdict.mistakes[0].what)


def test_a_sum_with_a_name_is_told_by_its_name() -> None:
    model = """
    name = "pendulum on two rods in line"
    [coordinates]
    phi = "arm"
    [parameters]
    m = "2 kg"
    a = "0.3 m"
    b = "0.2 m"
    g = "9.81 m/s^2"
    [define]
    l = "a + b"
    [points]
    P = ["l*sin(phi)", "-l*cos(phi)"]
    [[particle]]
    mass = "m"
    at = "P"
    [[gravity]]
    direction = [0, -1]
    """
    pendulum = loads(model).derive()
    for l in ("l", "(a + b)"):
        right = f"m {l}^2 phi'' + m g {l} sin phi = 0"
        assert pendulum.check(right).right
        (mistake,) = pendulum.check(right.replace(f"g {l}", "g")).mistakes
        assert "without its arm l" in str(mistake.what)
        (mistake,) = pendulum.check(right.replace("^2", "")).mistakes
        assert "l is not squared" in str(mistake.what)
