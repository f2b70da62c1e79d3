"""Explanations that are true of what was written: parallel velocities, relations of two rates, arms of dampers."""

from __future__ import annotations

from functools import cache

import pytest
from sympy import cos, sin

import lagrangian as lg
from lagrangian.model import time


@cache
def plank() -> lg.Derivation:
    """A trolley on a plank that moves twice as far as a roller, all along a slope of 15°."""
    s = lg.System("plank")
    x, u = s.coordinates("x u")
    m, n, k = s.parameters("m n k")
    alpha = s.parameter("alpha", value=0.2617993877991494)
    g = s.parameter("g", value=9.81)
    F = s.input("F")
    carried = 2 * x + u
    s.particle(m, at=s.point("roller", (x * cos(alpha), -x * sin(alpha))), name="roller")
    s.particle(n, at=s.point("trolley", (carried * cos(alpha), -carried * sin(alpha))), name="trolley")
    s.gravity((0, -1), g)
    s.spring(k, deflection=u)
    s.force(F, deflection=x)
    return s.derive()


def first(verdict: lg.CheckedAnswer) -> str:
    assert not verdict.right
    return str(verdict.mistakes[0].what)


@pytest.mark.slow
def test_velocities_along_one_line_have_signs_and_no_directions() -> None:
    right = "T = 1/2 m x'^2 + 1/2 n (2 x' + u')^2"
    assert plank().check(right, hint=0).right or not plank().check(right).mistakes
    told = first(plank().check(right.replace("+ u'", "- u'")))
    assert told == "In the velocity of particle 'trolley', the sign of u' against x' is wrong."


PROGRAM = """function yd = plank(t, y, F)
% y = [x; u; xd; ud]
m = 4; n = 2; k = 80; g = 9.81; slope = pi/12;
Mq = [m + 4*n, 2*n; 2*n, n];
f = [F + (m + 2*n)*g*sin(slope); n*g*sin(slope) - k*y(2)];
yd = [y(3); y(4); Mq\\f];
end
"""


def test_a_value_under_a_name_of_the_programs_own_is_that_parameter() -> None:
    assert plank().check(PROGRAM, hint=0).right
    verdict = plank().check(PROGRAM.replace("2*n; 2*n", "n; n"))
    assert first(verdict) == "The terms with u'' in the equation of x and with x'' in that of u count half."
    assert not any("sin" in str(d.term) for f in verdict.findings for d in f.differences)


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("said", "wrong"), [("sin(slope)", "cos(slope)"), ("pi/12", "pi/10"), ("+ (m", "- (m"), ("- k*y(2)", "")]
)
def test_another_value_or_function_stays_wrong(said: str, wrong: str) -> None:
    assert not plank().check(PROGRAM.replace(said, wrong), hint=0).right


@cache
def horse() -> lg.Derivation:
    """A body on a round runner that rolls: x' = R theta'."""
    s = lg.System("horse")
    x, theta = s.coordinates("x theta")
    m, J, R, c = s.parameters("m J R c")
    F = s.input("F")
    body = s.rigid_body(m, J, at=s.point("C", (x, R)), frame=s.frame(-theta), name="horse")
    s.damper(c, deflection=theta)
    s.force(F, deflection=x)
    s.rolling(body, at=s.point("contact", (x, 0)), along=(1, 0), name="floor")
    return s.derive()


ROWS = "m x'' = F + lam\nJ theta'' = -c theta' {}"


def test_a_relation_of_two_rates_has_them_against_each_other() -> None:
    assert horse().check("x' - R theta' = 0\n" + ROWS.format("- R lam"), hint=0).right
    verdict = horse().check("x' + R theta' = 0\n" + ROWS.format("+ R lam"))
    told = first(verdict)
    assert "the terms x' and R*theta' have the same sign and must have opposite ones. The factors" in told, told
    assert [f.status.right for f in verdict.findings] == [False, True, False]
    assert [f.follows for f in verdict.findings] == [False, False, True]


def test_a_rate_that_is_solved_for_leaves_the_other_with_the_wrong_sign() -> None:
    told = first(horse().check("x' = -R theta'\n" + ROWS.format("+ R lam")))
    assert "have the same sign" not in told


@cache
def truck() -> lg.Derivation:
    """A bar that pitches on a soft tyre, with a damper along the vertical."""
    s = lg.System("truck")
    theta, q = s.coordinates("theta s")
    J, m, a, b, d = s.parameters("J m a b d")
    F = s.input("F")
    bar = s.frame(theta)
    s.rigid_body(1, J, at=s.point("A", (0, 0)), frame=bar, name="bar")
    s.particle(m, at=bar.point(b, q), name="load")
    s.damper(d, deflection=a * sin(theta), name="tyre")
    s.force(F, deflection=q, name="lift")
    return s.derive()


LEFT = "(J + m b^2 + m s^2) th'' + m b s'' + 2 m s s' th' = {0}\nm s'' + m b th'' - m s th'^2 = F"


@pytest.mark.sampled(3)
@pytest.mark.parametrize("share", ["-d a cos(th) th'", "-d a^2 th'", "-d th'"])
def test_a_damper_with_another_arm_in_a_generalized_force_is_named_with_its_arm(share: str) -> None:
    right = "-d a^2 cos(th)^2 th'"
    assert truck().check(f"tyre damper: Q_th = {right}\n" + LEFT.format(right), hint=0).right
    verdict = truck().check(f"tyre damper: Q_th = {share}\n" + LEFT.format(share))
    told = first(verdict)
    assert told.startswith("Line 1 is not right: the share of damper 'tyre' in the generalized force of theta is "), (
        told
    )
    assert told.endswith("; its velocity is a*cos(theta)*theta', and its arm is a*cos(theta)."), told
    assert verdict.mistakes[0].element == "damper 'tyre'"


def test_the_other_sign_of_a_damper_is_no_arm() -> None:
    share = "d a^2 cos(th)^2 th'"
    assert "its arm is" not in first(truck().check(f"tyre damper: Q_th = {share}\n" + LEFT.format(share)))


def test_a_force_beside_the_damper_is_not_told_of_the_damper() -> None:
    share = "-d a^2 cos(th)^2 th' + F a"
    assert "its arm is" not in first(truck().check(f"Q_th = {share}\n" + LEFT.format(share)))


@cache
def governor() -> lg.Derivation:
    """A sleeve that slides on a mast, which turns, with a ball on an arm."""
    s = lg.System("governor")
    z, theta = s.coordinates("z theta")
    M, m, l, Omega = s.parameters("M m l Omega")
    mast = s.frame(Omega * time, axis=(0, 0, 1))
    sleeve = s.point("sleeve", (0, 0, z))
    s.particle(M, at=sleeve, name="sleeve")
    s.particle(m, at=mast.point(l * sin(theta), 0, -l * cos(theta), at=sleeve), name="ball")
    return s.derive()


@pytest.mark.slow
def test_what_should_cancel_is_left_over_and_not_counted_twice() -> None:
    rows = "(M + m) z'' + m l theta'' sin(theta) + m l theta'^2 cos(theta) = 0\n"
    right = rows + "m l^2 theta'' + m l z'' sin(theta) - m Omega^2 l^2 sin(theta) cos(theta) = 0"
    assert governor().check(right, hint=0).right
    more = "+ m l z' theta' cos(theta) - m Omega"
    told = first(governor().check(right.replace("- m Omega", more)))
    assert told.endswith("is left over: ∂T*/∂theta cancels it."), told
    assert not governor().check(right.replace("- m Omega", more.replace("+ m l", "- m l")), hint=0).right
