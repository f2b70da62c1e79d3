"""Explanations that say nothing untrue: what they quote was written, and what they call wrong is wrong."""

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.model import time


def told(system: lg.Derivation, answer: str) -> str:
    """What an explanation of a wrong answer says went wrong."""
    verdict = system.check(answer)
    assert not verdict.right
    return " And: ".join(str(m.what) for m in verdict.mistakes)


@pytest.fixture(scope="module")
def gears() -> lg.Derivation:
    """A wheel that an arm carries around a gear; its bearing on the arm damps."""
    s = lg.System("gears")
    a, b = s.coordinates("a b")
    J, Ja, Js, R, r, c, M = s.parameters("J Ja Js R r c M")
    gamma = s.define("gamma", ((R + r) * a - R * b) / r)
    arm, sun, wheel = (s.frame(x, name=n) for x, n in ((a, "arm"), (b, "sun"), (gamma, "wheel")))
    for frame, inertia in ((arm, Ja), (sun, Js), (wheel, J)):
        s.rigid_body(mass=M, inertia=inertia, at=s.origin, frame=frame, name=frame.name or "")
    s.damper(c, deflection=gamma - a, name="bearing")
    return s.derive()


T = "T = Ja/2 a'^2 + Js/2 b'^2 + J/2 (((R + r) a' {} R b')/r)^2\n"
ROWS = """(Ja + J (R + r)^2/r^2) a'' {0} J R (R + r)/r^2 b'' + {1} = 0
(Js + J R^2/r^2) b'' {0} J R (R + r)/r^2 a'' - {1} = 0"""
DAMPED = "c (R/r)^2 (a' - b')"


def test_a_rate_is_quoted_with_the_sign_that_was_written(gears: lg.Derivation) -> None:
    assert gears.check(T.format("-") + ROWS.format("-", DAMPED)).right
    words = told(gears, T.format("+"))
    assert "not (R*b' + (R + r)*a')/r" in words, words


def test_without_its_line_no_rate_is_said_to_be_written(gears: lg.Derivation) -> None:
    words = told(gears, ROWS.format("+", DAMPED))
    assert "The products of different rates" in words and "The angular velocity" not in words, words


def test_the_ratio_that_is_missing_in_the_work_of_a_damper_is_named(gears: lg.Derivation) -> None:
    words = told(gears, "Q_a = -c R/r (a' - b')\nQ_b = c R/r (a' - b')")
    assert "In what damper 'bearing' adds to Ξ, the factor R/r is missing." in words, words
    words = told(gears, ROWS.format("-", "c (a' - b')"))
    assert "The rate of damper 'bearing' is taken as a' - b'" in words and "stands in place" not in words, words


def test_the_angular_velocity_of_a_body_is_named_where_a_damper_is_given_it(gears: lg.Derivation) -> None:
    words = told(gears, "D = c/2 (((R + r) a' - R b')/r)^2")
    assert "The rate of damper 'bearing' is taken as (-R*b' + (R + r)*a')/r; it is R*a'/r - R*b'/r." in words, words


@pytest.fixture(scope="module")
def swing() -> lg.Derivation:
    """A pendulum on a mast that rolls as prescribed, with a damper against the mast and a spring on a loose pulley."""
    s = lg.System("swing")
    phi, y = s.coordinates("phi y")
    m, a, H, A, Omega, c, d, M = s.parameters("m a H A Omega c d M")
    mast = s.frame(A * sp.sin(Omega * time), name="mast")
    arm = s.frame(phi, name="arm")
    s.particle(m, at=s.point("bob", (0, -a), relative_to=s.point("top", (0, H), frame=mast), frame=arm), name="bob")
    s.particle(M, at=s.point("load", (3 * H, y)), name="load")
    s.damper(c, deflection=phi - A * sp.sin(Omega * time), name="hinge")
    s.damper(d, deflection=2 * y, name="rope")
    return s.derive()


ENERGY = "B = A sin(Omega t)\nT = m/2 (H^2 B'^2 + a^2 phi'^2 {} 2 a H B' phi' cos(phi - B)) + M/2 y'^2"


def test_a_length_is_no_motion_that_goes_the_other_way(swing: lg.Derivation) -> None:
    assert not swing.check(ENERGY.format("-")).mistakes
    words = told(swing, ENERGY.format("+"))
    assert "The products of the velocity of top" in words and "goes the other way" not in words, words


@pytest.mark.parametrize(
    ("force", "said"),
    [
        ("Q_phi = -c phi'", "The rate of damper 'hinge' is taken as phi'; it is -A*Omega*cos(Omega*t) + phi'."),
        ("Q_y = -2 d y'", "In what damper 'rope' adds to the equation of y, the factor 2 is missing."),
    ],
)
def test_the_rate_and_the_arm_of_a_damper_are_named(swing: lg.Derivation, force: str, said: str) -> None:
    assert said in told(swing, force)


def test_the_cause_stands_above_what_follows_from_it() -> None:
    s = lg.System("press")
    th = s.coordinate("th")
    m, r, J, M = s.parameters("m r J M")
    s.rigid_body(mass=M, inertia=J, at=s.origin, frame=s.frame(th, name="pinion"), name="pinion")
    s.particle(m, at=s.point("ram", (0, r * th)), name="ram")
    s.torque(s.input("P"), on=th, name="hand")
    answer = "m r th'' = N\n{0} th'' = P - N r\n({0} + m r^2) th'' = P"
    press = s.derive()
    assert press.check(answer.format("J")).right
    verdict = press.check(answer.format("2 J"))
    assert [(f.line.number, f.follows) for f in verdict.findings] == [(2, False), (3, True)], verdict.to_text()
