"""Coordinates that a sheet has beside the system's, with constraints and multipliers of its own.

Oracle: the pendulum in Cartesian coordinates, and a cylinder that rolls, by hand. Every form has a wrong twin.
"""

from __future__ import annotations

from functools import cache

import pytest

import lagrangian as lg
from built_in import derivation

FIRST_KIND = """\
X - L sin(theta) = 0
Y + L cos(theta) = 0
m X'' = lambda1
m Y'' = lambda2 - m g
0 = -b theta' - lambda1*L*cos(theta) - lambda2*L*sin(theta)
m L^2 theta'' + b theta' + m g L sin(theta) = 0
"""


@pytest.mark.parametrize(("now", "wrong"), [("- lambda1*L*cos", "+ lambda1*L*cos"), ("Y + L", "Y - L")])
def test_constraints_of_the_answers_own_say_what_its_coordinates_are(now: str, wrong: str) -> None:
    verdict = derivation("pendulum").check(FIRST_KIND)
    assert verdict.right, verdict.to_text()
    assert not derivation("pendulum").check(FIRST_KIND.replace(now, wrong), hint=0).right


@cache
def roller() -> lg.Derivation:
    """A cylinder on a slope, at a spring."""
    s = lg.System("roller")
    x = s.coordinates("x")
    m, R, k = s.parameters("m R k")
    F = s.inputs("F")
    at = s.point("axle", (x, 0))
    s.rigid_body(mass=m, inertia=m * R**2 / 2, at=at, frame=s.frame(-x / R, name="cylinder"), name="cylinder")
    s.spring(k, deflection=x)
    s.force((F, 0), at=at)
    return s.derive()


@pytest.mark.sampled(2)
@pytest.mark.parametrize("rolls", ["x' = R phi'", "x - R phi = 0", "R w = x', w = phi'"])
def test_rolling_says_what_the_angle_is(rolls: str) -> None:
    rows = f"m x'' = F - k x - H\n1/2 m R^2 phi'' = R H\n{rolls}\n"
    assert roller().check(f"{rows}3/2 m x'' + k x = F", hint=0).right
    wrong = roller().check(f"{rows.replace('1/2 m', 'm')}3/2 m x'' + k x = F", hint=0)
    assert not wrong.right


@pytest.mark.sampled(8)
@pytest.mark.parametrize("p", ["p_x", "P", "pi_x"])
@pytest.mark.parametrize("rate", ["%s' =", "d%s/dt ="])
def test_hamiltons_equations_alone_say_what_the_momentum_is(p: str, rate: str) -> None:
    rows = f"x' = 2 {p}/(3 m)\n{rate % p} F - k x\n"
    for written in (rows, f"H = {p}^2/(3 m) + k x^2/2 - F x\n{rows}"):
        assert roller().check(written, hint=0).right, written
        assert (
            not roller()
            .check(written.replace("2 p", "p").replace("2 P", "P").replace("F - k x", "F + k x"), hint=0)
            .right
        )
    assert not roller().check(rows.replace("(3 m)", "(5 m)"), hint=0).right


@pytest.mark.slow
def test_a_speed_that_nothing_uses_is_no_definition() -> None:
    right = "(M+m) x'' + m l theta'' cos(theta) - m l theta'^2 sin(theta) + b x' = F\n"
    right += "(J + m l^2) theta'' + m l x'' cos(theta) - m g l sin(theta) = 0\n"
    alone = "b x' + v = 3 F", "omega x' = 99 F theta", "v_p - x' - 7 l theta' = 0"
    for line in (
        *alone,
        "omega l = 5 x'",
        "omega l = 2 l theta'",
        "b x' + v = 3 F\nv w = 0",
        "b x' + v = 3 F\ns = 2 v",
    ):
        first = line.partition("\n")[0]
        assert f"'{first}' was not judged" in derivation("cart-pole").check(f"{line}\n{right}").to_text()
    used = f"l w = 2 l theta'\nT = 1/2 (M+m) x'^2 + m l x' w cos(theta) + 1/2 (J + m l^2) w^2\n{right}"
    assert not derivation("cart-pole").check(used, hint=0).right
    assert derivation("cart-pole").check(used.replace("2 l", "l"), hint=0).right
    chain = f"l v1 = l theta'\nl w = 2 l v1\n{used.partition(chr(10))[2]}"
    assert not derivation("cart-pole").check(chain, hint=0).right
    assert derivation("cart-pole").check(chain.replace("2 l v1", "l v1"), hint=0).right
