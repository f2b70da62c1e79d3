"""What the lines of an answer refute is not told: another mistake is, or the terms that differ."""

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.check.verb import CheckedAnswer, check_answer


@cache
def hoist() -> lg.Derivation:
    """A weight on a loose pulley, whose elastic cord winds onto a drum that a motor turns."""
    s = lg.System("hoist")
    y, phi = s.coordinates("y phi")
    m, J, r, k = s.parameters("m J r k")
    s.particle(m, at=s.point("S", (0, y)), name="stack")
    s.rigid_body(mass=1, inertia=J, at=s.origin, frame=s.frame(phi, name="drum"), name="drum")
    s.gravity((0, -1))
    s.spring(k, deflection=r * phi - 2 * y, name="cord")
    s.torque(s.input("M"), on=phi, name="motor")
    return s.derive()


@cache
def centrifuge() -> lg.Derivation:
    """Two equal buckets on arms that swing out of a rotor."""
    s = lg.System("centrifuge")
    psi, theta = s.coordinates("psi theta")
    m, J, l, R = s.parameters("m J l R")
    s.rigid_body(mass=1, inertia=(0, 0, J), at=s.origin, frame=s.frame(psi, axis=(0, 0, 1), name="rotor"), name="rotor")
    out = R + l * sp.sin(theta)
    for k, sign in enumerate((1, -1)):
        at = (sign * out * sp.cos(psi), sign * out * sp.sin(psi), -l * sp.cos(theta))
        s.particle(m, at=s.point(f"B{k + 1}", at), name=f"bucket {k + 1}")
    s.gravity((0, 0, -1))
    return s.derive()


@cache
def saw() -> lg.Derivation:
    """An arm on a carriage, pushed at its handle."""
    s = lg.System("saw")
    x, theta = s.coordinates("x theta")
    M, m, l, d, k = s.parameters("M m l d k")
    F = s.input("F")
    hinge = s.point("A", (x, 0))
    arm = s.frame(theta, name="arm", origin=hinge)
    s.particle(M, at=hinge, name="carriage")
    s.particle(m, at=s.point("G", (l, 0), frame=arm), name="arm")
    s.gravity((0, -1))
    s.spring(k, deflection=x, name="spring")
    s.force((F * sp.sin(theta), -F * sp.cos(theta)), at=s.point("H", (d, 0), frame=arm), name="hand")
    return s.derive()


def judged(system: lg.Derivation, answer: str) -> CheckedAnswer:
    """The verdict on a wrong answer."""
    verdict = check_answer(system, answer)
    assert not verdict.right
    return verdict


def told(system: lg.Derivation, answer: str) -> list[str]:
    """What is said to be wrong in an answer."""
    return [str(m.what) for m in judged(system, answer).mistakes]


def test_no_mistake_is_told_that_a_second_one_takes_back_in_a_right_term() -> None:
    """2 k in the first line is right: no ½ of the cord is missing beside a slope that is missing as well."""
    said = told(hoist(), "m y'' = 2 k (r phi - 2 y)\nJ phi'' = M - 2 k r (r phi - 2 y)")
    assert said[0] == "The weight of particle 'stack' is missing.", said
    assert said[1] == "What spring 'cord' adds to the equation of phi counts twice.", said


@pytest.mark.slow
def test_no_sign_is_wrong_in_one_of_two_bodies_where_a_term_of_both_is_missing() -> None:
    answer = "T = J/2 psi'^2 + m (R^2 + l^2 sin(theta)^2) psi'^2 + m l^2 theta'^2\nV = -2 m g l cos(theta)"
    verdict = judged(centrifuge(), answer)
    assert [str(m.what) for m in verdict.mistakes] == ["In line 1 (T*), the term 2*R*l*m*sin(theta)*psi'^2 is missing."]
    assert "double product" in str(verdict.mistakes[0].why)


def test_half_of_the_energy_of_two_bodies_is_no_velocity_of_one() -> None:
    said = told(centrifuge(), "T = J/2 psi'^2 + m (R + l sin(theta))^2 psi'^2 + m/2 l^2 theta'^2")
    assert said == ["In line 1 (T*), l^2*m*theta'^2/2 should be l^2*m*theta'^2."]


def test_the_place_of_a_handle_is_no_wrong_place_of_a_body() -> None:
    answer = "The handle is H = (x + d cos(theta), d sin(theta))\nV = k/2 x^2 + m g d sin(theta)"
    verdict = judged(saw(), answer)
    assert verdict.first_wrong is not None and verdict.first_wrong.line.kind == "V"
    assert [str(m.what) for m in verdict.mistakes] == ["In the weight of particle 'arm', d stands in place of l."]


def test_the_place_of_a_body_that_is_given_that_of_the_handle_is_wrong() -> None:
    answer = "centre of mass G = (x + d cos(theta), d sin(theta))\nV = k/2 x^2 + m g d sin(theta)"
    said = told(saw(), answer)
    assert said[0].startswith("Line 1 is not right: the position of particle 'arm'"), said


def test_a_deflection_that_is_right_in_its_line_is_not_blamed() -> None:
    answer = "e = r phi - 2 y\nT = m/2 y'^2 + J/2 phi'^2\nV = m g y + k/2 (r phi - y)^2\nm y'' + m g = 2 k e"
    said = told(hoist(), f"stretch of the cord: {answer}")
    assert said and all(x.startswith("In line 3 (V), ") for x in said), said


def test_a_force_forgotten_in_the_virtual_work_is_told_there() -> None:
    answer = "only the moment works: δW = -F d δtheta\nΞ_x = 0\nΞ_theta = -F d"
    verdict = judged(saw(), answer)
    wrong = [(f.line.number, f.follows) for f in verdict.findings if not f.status.right]
    assert wrong == [(1, False), (2, True)], wrong


def test_a_missing_term_has_the_sign_of_its_side() -> None:
    """Whatever the reason, the weight is missing on the right, where all but F stands."""
    row = "0 = M x'' + m x'' - m l sin(theta) theta'' - m l cos(theta) theta'^2 + k x - F sin(theta)"
    assert check_answer(saw(), row).status.name == "INCOMPLETE"
    swing = "-F d = m l^2 theta'' - m l sin(theta) x'' {} m g l cos(theta)"
    assert check_answer(saw(), f"{row}\n{swing.format('+')}").right
    said = told(saw(), f"{row}\n{swing.format('+').removesuffix(' + m g l cos(theta)')}")
    assert not any("-g*l*m" in x for x in said), said


@cache
def slope() -> lg.Derivation:
    """A sled of 3 kg up a slope of 20°."""
    s = lg.System("sled")
    x = s.coordinate("x")
    p = s.parameter("p", value=3)
    beta = s.parameter("beta", value=sp.rad(20).evalf(17))
    s.particle(p, at=s.point("P", (x * sp.cos(beta), x * sp.sin(beta))), name="sled")
    s.gravity((0, -1), g=s.parameter("g", value=9.81))
    s.force(s.input("F"), deflection=x)
    return s.derive()


def test_a_number_computed_with_a_stated_rounded_sine_is_right() -> None:
    """3 · 9.81 · 0.3420 = 10.06506, and not 10.0657."""
    stated = "sin(20°) = 0.3420\n"
    assert check_answer(slope(), f"{stated}3 x'' = F - 10.065").right
    for wrong in ("3 x'' = F - 10.075", "3 x'' = F + 10.065", "3 x'' = F - 10.065 x"):
        assert not check_answer(slope(), stated + wrong).right, wrong
    assert "its last digit is off" not in str(check_answer(slope(), f"{stated}3 x'' = F - 10.065"))
    assert "10.065 was read as 10.066: its last digit is off" in str(check_answer(slope(), "3 x'' = F - 10.065"))
    assert not check_answer(slope(), "3 x'' = F - 10.062").right


@cache
def gate() -> lg.Derivation:
    """A gate whose cord, of a length with a name, lifts a weight in a guide that damps."""
    s = lg.System("gate")
    theta = s.coordinate("theta")
    m, J, a, d, b, c = s.parameters("m J a d b c")
    length = s.define("l", sp.sqrt(a**2 + d**2 - 2 * a * d * sp.cos(theta)))
    s.rigid_body(mass=1, inertia=(0, 0, J), at=s.origin, frame=s.frame(theta, axis=(0, 0, 1), name="gate"), name="gate")
    s.particle(m, at=s.point("W", (d, 0, length)), name="weight")
    s.gravity((0, 0, -1))
    s.damper(b, deflection=theta, name="hinge")
    s.damper(c, deflection=length, name="guide")
    return s.derive()


RATE = "l' = {} θ'\nLet q = {}, q' its derivative with respect to θ:\n"
ROW = "(J + m q^2) θ'' + m q q' θ'^2 + m g a d sin θ/l = {} b θ' - c q^2 θ'"


@pytest.mark.slow
def test_the_wrong_rate_of_a_length_is_told_where_it_is_written() -> None:
    """The energy, the damper and the equation follow from it."""
    right = RATE.format(*["a d sin θ/l"] * 2) + ROW.format("-")
    assert check_answer(gate(), right).right
    answer = RATE.format(*["a d sin θ/(2 l)"] * 2) + ROW.format("-")
    verdict = judged(gate(), answer)
    assert [str(m.what) for m in verdict.mistakes] == [
        "Line 1 is not right: the rate of l is a*d*sin(theta)*theta'/l, not a*d*sin(theta)*theta'/(2*l)."
    ]
    assert [f.line.number for f in verdict.findings if not f.status.right and not f.follows] == [1]


@pytest.mark.slow
def test_another_mistake_beside_a_wrong_rate_is_told_as_well() -> None:
    """The exchange of sine and cosine in the guide's damper follows from the rate and is told once."""
    answer = RATE.format(*["a d cos θ/l"] * 2) + "T = J/2 θ'^2 + m/2 q^2 θ'^2\nΞ = b θ' - c q^2 θ'"
    said = told(gate(), answer)
    assert said == [
        "Line 1 is not right: the rate of l is a*d*sin(theta)*theta'/l, not a*d*cos(theta)*theta'/l.",
        "Damper 'hinge' has the wrong sign.",
    ], said


@pytest.mark.slow
def test_a_lost_divisor_is_told_in_the_names_of_the_answer() -> None:
    named = "u = a d sin θ/l\n(J + m u^2) θ'' + m u (a d cos θ - u^2){} θ'^2 + m g u = -b θ' - c u^2 θ'"
    assert check_answer(gate(), named.format("/l")).right
    (said,) = told(gate(), named.format(""))
    assert said.endswith("in the term m*(a*d*cos(theta) - u^2)*u*theta'^2, one divisor l is missing."), said
