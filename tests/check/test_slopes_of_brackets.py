"""Derivatives of what stands in a bracket by a coordinate: d/dθ(…), ∂(…)/∂θ, in text and in LaTeX.

Oracle: a pendulum that a horizontal force pushes, by hand. Every form has a wrong twin.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg


@cache
def pendulum(damper: str = "c") -> lg.Derivation:
    """A pendulum that a horizontal force at its bob pushes, with a damper of any name."""
    s = lg.System("pendulum with a push")
    theta = s.coordinate("theta")
    m, l_, g, c = s.parameters(f"m l g {damper}")
    s.particle(m, at=s.point("P", (l_ * sp.sin(theta), -l_ * sp.cos(theta))), name="bob")
    s.gravity((0, -1), g)
    s.damper(c, deflection=theta)
    s.force(s.input("F"), deflection=l_ * sp.sin(theta))
    return s.derive()


IN_TEXT = [
    "d(HEIGHT)/d(theta)",
    "d(HEIGHT)/dtheta",
    "d/dtheta(HEIGHT)",
    "d/dθ [HEIGHT]",
    "∂(HEIGHT)/∂θ",
    "∂/∂theta (HEIGHT)",
    "∂(HEIGHT)/∂(theta)",
]
IN_LATEX = [
    r"\frac{d}{d\theta}\left(HEIGHT\right)",
    r"\dfrac{\mathrm{d}}{\mathrm{d}\theta}\left[HEIGHT\right]",
    r"\frac{\partial}{\partial\theta}\big(HEIGHT\big)",
]


@pytest.mark.sampled(4)
@pytest.mark.parametrize("slope", [*IN_TEXT, *IN_LATEX])
@pytest.mark.parametrize("damper", ["c", "d"])
def test_a_bracket_is_differentiated_by_a_coordinate(slope: str, damper: str) -> None:
    tex = "\\" in slope
    height = r"-m g l\cos\theta" if tex else "-m g l cos(theta)"
    way = r"l\sin\theta" if tex else "l sin(theta)"
    rates = (r"\ddot\theta", r"\dot\theta") if tex else ("theta''", "theta'")
    weight, push = slope.replace("HEIGHT", height), slope.replace("HEIGHT", way)
    written = f"m l^2 {rates[0]} + {weight} + {damper} {rates[1]} = F {push}"
    wrong = written.replace(height, height[1:])
    assert pendulum(damper).check(f"\\[{written}\\]" if tex else written).right
    assert not pendulum(damper).check(f"\\[{wrong}\\]" if tex else wrong).right


def test_what_is_wrong_in_it_is_told_and_no_quotient() -> None:
    told = pendulum().check("m l^2 theta'' + c theta' + m g l sin(theta) = F*d(l*cos(theta))/d(theta)").to_text()
    assert "/θ" not in told and "F l sin θ" in told


@pytest.mark.parametrize(("height", "is_right"), [("-l cos(theta)", True), ("l cos(theta)", False)])
def test_names_of_the_answer_are_differentiated_with_their_values(height: str, is_right: bool) -> None:
    equation = "m l^2 theta'' + d(m g h + 0)/dtheta + c theta' = F l cos(theta)"
    assert pendulum().check(f"h = {height}\n{equation}").right is is_right
    assert pendulum().check(f"{equation}\nwith h = {height}").right is is_right
