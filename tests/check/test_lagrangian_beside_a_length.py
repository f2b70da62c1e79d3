"""The Lagrangian L of an answer where the system's length is called L, too; and outer forces by a relative coordinate.

Oracle: a pendulum and two carts, by hand.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg


@cache
def pendulum() -> lg.Derivation:
    """A pendulum of the length L with a torque."""
    s = lg.System("pendulum")
    theta = s.coordinate("theta")
    m, L, g = s.parameters("m L g")
    s.particle(m, at=s.point("P", (L * sp.sin(theta), -L * sp.cos(theta))), name="bob")
    s.gravity((0, -1), g)
    s.force(s.input("tau"), deflection=theta, name="motor")
    return s.derive()


TEXT = """L = 1/2 m L^2 theta'^2 + m g L cos(theta)
dL/dtheta' = m L^2 theta'
dL/dtheta = -m g L sin(theta)
m L^2 theta'' + m g L sin(theta) = tau
"""
LATEX = r"""\[ L = \tfrac12 m L^2\dot\theta^2 + m g L\cos\theta \]
\[ \frac{\partial L}{\partial\dot\theta} = m L^2\dot\theta, \frac{\partial L}{\partial\theta} = -m g L\sin\theta \]
\[ m L^2\ddot\theta + m g L\sin\theta = \tau \]
"""


@pytest.mark.parametrize("written", [TEXT, LATEX])
def test_a_lagrangian_has_the_letter_of_a_length(written: str) -> None:
    verdict = pendulum().check(written)
    assert verdict.right and "ℒ" in verdict.to_text()
    slope = "-m g L sin(theta)" if written is TEXT else r"-m g L\sin\theta"
    wrong = pendulum().check(written.replace(slope, slope[1:]))
    assert not wrong.right and "∂ℒ/∂ξ" in wrong.to_text()
    assert (
        not pendulum()
        .check(written.replace("m L^2 theta'^2", "m L theta'^2").replace("m L^2\\dot\\theta^2", "m L\\dot\\theta^2"))
        .right
    )


@cache
def sledges() -> lg.Derivation:
    """Two sledges; s is how far the second is behind, and a helper pushes it."""
    s = lg.System("two sledges")
    x, stretch = s.coordinates("x s")
    m1, m2, k, c = s.parameters("m1 m2 k c")
    s.particle(m1, at=s.point("A", (x, 0)), name="first")
    s.particle(m2, at=s.point("B", (x - stretch, 0)), name="second")
    s.spring(k, deflection=stretch, name="coupling")
    s.damper(c, deflection=x - stretch, name="snow")
    s.force(s.input("F"), deflection=x - stretch, name="helper")
    return s.derive()


@pytest.mark.parametrize("right_side", ["= F", "= -c s' - F", "= c (x' - s')"])
def test_what_acts_from_outside_has_no_reaction(right_side: str) -> None:
    first = "(m1 + m2) x'' - m2 s'' + c (x' - s') = F"
    second = "m2 s'' - m2 x'' + k s - c (x' - s') = -F"
    assert sledges().check(f"{first}\n{second}").right
    told = sledges().check(f"{first}\nm2 s'' - m2 x'' + k s {right_side}").to_text()
    assert "eaction" not in told
