"""A velocity, a position or an acceleration that an answer states is right only as that of the body and axis it says.

Oracle: a cart with a bob; every value below is that of some component of the bob, and of no other.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg

ALONG_X = "x'' + l theta'' cos(theta) - l theta'^2 sin(theta)"
ALONG_Y = "l theta'' sin(theta) + l theta'^2 cos(theta)"
EQUATIONS = """
(M + m) x'' + m l theta'' cos(theta) - m l theta'^2 sin(theta) + k x = F
m l^2 theta'' + m l x'' cos(theta) + m g l sin(theta) = 0"""


@cache
def cart() -> lg.Derivation:
    """A cart on a spring with a bob that hangs from it."""
    s = lg.System("cart with a bob")
    x, th = s.coordinates("x theta")
    M, m, l_, g, k = s.parameters("M m l g k")
    s.particle(M, at=s.point("C", (x, 0)), name="cart")
    s.particle(m, at=s.point("P", (x + l_ * sp.sin(th), -l_ * sp.cos(th))), name="bob")
    s.gravity((0, -1), g)
    s.spring(k, deflection=x)
    s.force(s.input("F"), deflection=x)
    return s.derive()


@cache
def pendulum() -> lg.Derivation:
    """A bob on a rod, without coordinates called x or y."""
    s = lg.System("pendulum")
    th = s.coordinate("theta")
    m, l_, g = s.parameters("m l g")
    s.particle(m, at=s.point("P", (l_ * sp.sin(th), -l_ * sp.cos(th))), name="bob")
    s.gravity((0, -1), g)
    return s.derive()


def told(derivation: lg.Derivation, line: str, equations: str = EQUATIONS) -> list[str]:
    """What the definitions in a line are called right for, beside right equations."""
    verdict = derivation.check(line + equations)
    assert verdict.right
    return [str(f.note) for f in verdict.findings if f.line.number == 1 and f.status.right]


@pytest.mark.parametrize(
    ("line", "note"),
    [
        (f"acceleration of the bob: {ALONG_X}", "x component of the acceleration of particle 'bob'"),
        (f"acceleration of the mass m: {ALONG_X}", "x component of the acceleration of particle 'bob'"),
        (f"horizontal acceleration of the bob: {ALONG_X}", "x component of the acceleration"),
        (f"The acceleration of the mass m in y is {ALONG_Y}", "y component of the acceleration"),
        ("the horizontal velocity of the bob is v_x = x' + l theta' cos(theta)", "x component of the velocity"),
        ("vertical velocity: v = l theta' sin(theta)", "y component of the velocity"),
        ("velocity of the bob: v = l theta' sin(theta)", "y component of the velocity"),
        ("y_P = -l cos(theta)", "y coordinate of particle 'bob'"),
    ],
)
def test_the_quantity_that_is_said_is_right(line: str, note: str) -> None:
    (found,) = told(cart(), line)
    assert note in found


@pytest.mark.parametrize(
    "line",
    [
        f"acceleration of the cart: {ALONG_X}",
        f"acceleration of the mass M: {ALONG_X}",
        f"vertical acceleration of the bob: {ALONG_X}",
        f"horizontal acceleration of the bob: {ALONG_Y}",
        f"The acceleration of the mass m in x is {ALONG_Y}",
        f"a_y of the bob = {ALONG_X}",
        f"acceleration of the bob: a_x = {ALONG_Y}",
        "the vertical velocity of the bob is v_y = x' + l theta' cos(theta)",
        "velocity of the cart: v = x' + l theta' cos(theta)",
        "velocity of the bob: v_x = l theta' sin(theta)",
        "x_bob = -l cos(theta), y_bob = x + l sin(theta)",
        "position of the cart: X = x + l sin(theta)",
    ],
)
def test_that_of_another_body_or_axis_is_not_called_right(line: str) -> None:
    assert told(cart(), line) == []


def test_axes_of_its_own_are_right() -> None:
    equation = "\nl theta'' + g sin(theta) = 0"
    assert len(told(pendulum(), "x_P = l cos(theta), y_P = l sin(theta)", equation)) == 2
    assert told(pendulum(), "y_P = l sin(theta), x_P = 2 l cos(theta)", equation) == []


@cache
def rod() -> lg.Derivation:
    """A rod that hangs from a hinge."""
    s = lg.System("rod")
    th = s.coordinate("theta")
    M, L, g = s.parameters("M L g")
    middle = s.point("G", (L / 2 * sp.sin(th), -L / 2 * sp.cos(th)))
    s.rigid_body(mass=M, inertia=M * L**2 / 12, at=middle, frame=s.frame(th, name="rod"), name="rod")
    s.gravity((0, -1), g)
    return s.derive()


ROD = "\nM L^2/3 theta'' + M g L/2 sin(theta) = 0"
"""The equation of the rod."""


@pytest.mark.parametrize(
    "line",
    [
        "about the hinge: J = M L^2/3",
        "J = M L^2/3 (about the pivot)",
        "moment of inertia about the centre of mass: J = M L^2/12",
        "J = M L^2/12 about its center",
        "J = M L^2/12",
        "Steiner about the hinge: J_G = M L^2/12",
    ],
)
def test_a_moment_of_inertia_about_the_point_that_is_said_is_right(line: str) -> None:
    assert len(told(rod(), line, ROD)) == 1


@pytest.mark.parametrize(
    "line",
    [
        "about the hinge: J = M L^2/12",
        "J = M L^2/12 (about the pivot)",
        "The moment of inertia about the hinge is J = M L^2/12",
        "Trägheitsmoment um das Gelenk: J = M L^2/12",
        "about the centre of mass: J = M L^2/3",
    ],
)
def test_one_about_another_point_is_not_called_right(line: str) -> None:
    assert told(rod(), line, ROD) == []
