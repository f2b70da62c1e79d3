"""Answers in Cartesian coordinates of which only words say the axes: x to the right, y downwards.

Oracle: Newton's second law for a ball on an elastic string, along both axes.
"""

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.check.verdict import Status
from lagrangian.errors import ParseError


@cache
def ball() -> lg.Derivation:
    """A ball on an elastic string, pushed by a horizontal force."""
    s = lg.System("ball on a string")
    l, theta = s.coordinates("l theta")
    m, k, l0, g = s.parameters("m k l0 g")
    at = s.point("B", (l * sp.sin(theta), -l * sp.cos(theta)))
    s.particle(m, at=at, name="ball")
    s.gravity(direction=(0, -1), g=g)
    s.spring(k, deflection=l - l0, name="string")
    s.force((s.input("F"), 0), at=at, name="push")
    return s.derive()


@cache
def hung() -> lg.Derivation:
    """A ball on a string below a carriage that moves along a rail."""
    s = lg.System("crane")
    s1, theta = s.coordinates("s theta")
    M, m, l, g = s.parameters("M m l g")
    at = s.point("A", (s1, 0))
    s.particle(M, at=at, name="carriage")
    s.particle(m, at=s.point("B", (s1 + l * sp.sin(theta), -l * sp.cos(theta))), name="ball")
    s.gravity(direction=(0, -1), g=g)
    s.force((s.input("F"), 0), at=at, name="drive")
    return s.derive()


DOWN = """
l = sqrt(x^2 + y^2)
m*x'' = -k*(l - l0)*x/l + F
m*y'' = -k*(l - l0)*y/l + m*g
"""
UP = DOWN.replace("+ m*g", "- m*g")

POINTING_DOWN = (
    "I use cartesian coordinates with origin at the nail: x to the right, y downwards.",
    "x nach rechts, y nach unten.",
    "axe x vers la droite, axe y vers le bas",
    "x horizontal, y vertical down",
    "horizontal x and vertical y of the ball, y down",
    "Let x and y be the horizontal and the vertical position of the ball, with y positive downwards.",
    "The ball is at (x, y), x to the right and y pointing down, measured from the nail.",
    "- x: to the right\n- y: downwards",
    "x waagerecht nach rechts, y senkrecht (nach unten positiv)",
    "x = horizontal displacement, y = depth below the nail",
    "F acts to the right. x(t) points right and y(t) down.",
    "x→, y↓",
)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("said", POINTING_DOWN)
def test_axes_in_words_are_the_position_of_what_moves(said: str) -> None:
    verdict = ball().check(f"{said}\n{DOWN}")
    assert verdict.right
    assert any("'y' was read as l*cos(theta)" in str(note) for note in verdict.notes)
    assert ball().check(f"{said}\n{UP}").status is Status.WRONG
    assert ball().check(f"{said}\n{DOWN.replace('+ F', '- 2*F')}").status is Status.WRONG


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    "said", ["x to the right, y upwards", "x horizontal, y the height of the ball", "x nach rechts, y nach oben"]
)
def test_upwards(said: str) -> None:
    assert ball().check(f"{said}\n{UP}").right
    assert ball().check(f"{said}\n{DOWN}").status is Status.WRONG


@pytest.mark.parametrize("said", ["x horizontal, y vertical", "Let x and y be the horizontal and vertical position."])
def test_what_words_leave_open_is_tried(said: str) -> None:
    assert ball().check(f"{said}\n{DOWN}").right
    assert ball().check(f"{said}\n{UP}").right
    left = DOWN.replace("+ F", "- F")
    assert ball().check(f"{said}\n{left}").right
    for wrong in (DOWN.replace("m*g", "2*m*g"), UP.replace("*x/l", "*x")):
        assert ball().check(f"{said}\n{wrong}").status is Status.WRONG


def test_only_lines_that_were_typed_are_listed() -> None:
    verdict = ball().check(f"x to the right, y downwards.\n{UP}")
    assert max(f.line.number for f in verdict.findings) <= 5
    assert not any("measured from another axis" in str(note) for note in verdict.notes)  # it writes no angle
    assert verdict.mistakes


def test_energies_in_them() -> None:
    said = "x to the right, y downwards.\nT = m/2*(x'^2 + y'^2)\nV = k/2*(sqrt(x^2 + y^2) - l0)^2 {} m*g*y"
    assert ball().check(said.format("-") + "\nQ_l = F*sin(theta)\nQ_theta = F*l*cos(theta)").right
    assert not ball().check(said.format("+") + "\nQ_l = F*sin(theta)\nQ_theta = F*l*cos(theta)").right


def test_in_latex() -> None:
    said = (
        r"Cartesian coordinates: $x$ to the right, $y$ downwards."
        "\n"
        r"\[ l=\sqrt{x^2+y^2} \]"
        "\n"
        r"\begin{align} m\ddot x &= -k(l-l_0)\frac{x}{l}+F\\ m\ddot y &= -k(l-l_0)\frac{y}{l}+mg \end{align}"
    )
    assert ball().check(said).right
    assert ball().check(said.replace("+mg", "-mg")).status is Status.WRONG


def test_one_letter_may_be_explained_by_a_formula() -> None:
    said = "x to the right, y downwards.\nx = l*sin(theta)\nm*x'' = -k*(l - l0)*sin(theta) + F\n"
    assert ball().check(said + "m*y'' = m*g - k*(l - l0)*cos(theta)").right
    assert not ball().check(said + "m*y'' = -m*g - k*(l - l0)*cos(theta)").right


@pytest.mark.parametrize(
    "said",
    [
        "x along the slope to the right, y perpendicular to it.",
        "x to the right, y downwards, both from the position of equilibrium.",
        "x to the right, y not downwards.",
        "x is the angle from the horizontal, y downwards.",
        "x is the stretch of the horizontal spring, y is vertical.",
    ],
)
def test_other_axes_are_not_guessed(said: str) -> None:
    wrong = DOWN.replace("m*g", "2*m*g")
    with pytest.raises(ParseError, match="what is"):
        ball().check(f"{said}\n{wrong}")


def test_of_two_bodies_the_one_that_words_name() -> None:
    forces = "\nm*x'' = -S*sin(theta)\nm*y'' = m*g - S*cos(theta)\nM*s'' = F + S*sin(theta)"
    said = "S is the force of the string. The ball is at x to the right, y downwards."
    assert hung().check(said + forces).right
    assert not hung().check(said + forces.replace("m*g - S", "-m*g - S")).right
    assert not hung().check(said + forces.replace("F + S", "F - S")).right


def test_letters_of_two_bodies() -> None:
    said = "X: place of the carriage, to the right; y: depth of the ball, downwards\n"
    ball_along = "m*(X'' + l*theta''*cos(theta) - l*theta'^2*sin(theta)) = -S*sin(theta)"
    forces = f"M*X'' = F + S*sin(theta)\nm*y'' = m*g - S*cos(theta)\n{ball_along}"
    assert hung().check(said + forces).right
    with pytest.raises(ParseError, match="what is"):
        hung().check(said + forces.replace("m*g - S", "-m*g - S"))
