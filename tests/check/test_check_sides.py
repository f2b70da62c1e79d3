"""Distances: √(r²) is r, in whatever coordinates, and nothing else slips through beside it.

Oracle: Newton's equations of a mass on a spring, in polar coordinates and in the axes (any book of mechanics), and
wrong ones that agree with these at some states.
"""

from functools import cache

import pytest

from lagrangian import loads
from lagrangian.derivation import Derivation
from size import rest_slow

BODY = """
name = "mass on a spring"
[coordinates]
r = "length"
theta = "angle from hanging"
[parameters]
m = "0.5 kg"
k = "40 N/m"
l0 = "30 cm"
[points]
P = ["r*sin(theta)", "-r*cos(theta)"]
[[particle]]
mass = "m"
at = "P"
[[gravity]]
direction = [0, -1]
[[spring]]
k = "k"
rest = "l0"
"""
SPRINGS = {"between": 'between = ["origin", "P"]\n', "deflection": 'deflection = "r"\n'}
POLAR = "m*r'' - m*r*theta'^2 + k*({r} - l0) - m*g*cos(theta) = 0\nr*theta'' + 2*r'*theta' + g*sin(theta) = 0"
AXES = "m*x'' + k*x*(1 - l0/sqrt(x^2 + y^2)) = 0\nm*y'' + k*y*(1 - l0/sqrt(x^2 + y^2)) + m*g = 0"
LONGER = """r = l0 + s
m*s'' - m*(l0 + s)*theta'^2 + k*s - m*g*cos(theta) = 0
(l0 + s)*theta'' + 2*s'*theta' + g*sin(theta) = 0"""


@cache
def derived(spring: str) -> Derivation:
    return loads(BODY + SPRINGS[spring]).derive()


@pytest.mark.sampled(4)
@pytest.mark.parametrize("spring", SPRINGS)
@pytest.mark.parametrize(
    "answer",
    [
        POLAR.format(r="r"),
        POLAR.format(r="sqrt(r^2)"),
        POLAR.format(r="abs(r)"),
        POLAR.format(r="sqrt((r*sin(theta))^2 + (r*cos(theta))^2)"),
        AXES,
        LONGER,
        "V = k*(r - l0)^2/2 - m*g*r*cos(theta)",
        "V = k*(sqrt(r^2) - l0)^2/2 - m*g*r*cos(theta)",
    ],
)
def test_a_distance_is_positive(spring: str, answer: str) -> None:
    verdict = derived(spring).check(answer)
    assert verdict.right, verdict.to_text()


@pytest.mark.sampled(24)
@pytest.mark.parametrize("spring", rest_slow(SPRINGS, {"between"}))
@pytest.mark.parametrize(
    "answer",
    [
        POLAR.format(r="-r"),
        POLAR.format(r="r + piecewise(r > 100, r, 0)"),
        POLAR.format(r="r + piecewise(r > 1000000, r, 0)"),
        POLAR.format(r="r + sqrt(theta^2) - theta"),
        POLAR.format(r="r + abs(r') - r'"),
        POLAR.format(r="r + max(0, r - 200)"),
        POLAR.format(r="r").replace("sin(theta)", "sqrt(1 - cos(theta)^2)"),
        AXES.replace("1 - l0", "1 + l0"),
        AXES.replace("m*g", "m*g + piecewise(y > 100, y, 0)"),
        AXES.replace("m*g", "m*g + abs(x) - x"),
        LONGER.replace("k*s", "k*(s + abs(theta) - theta)"),
    ],
)
def test_what_agrees_at_some_states_is_wrong(spring: str, answer: str) -> None:
    assert not derived(spring).check(answer, hint=0).right


@pytest.mark.sampled(2)
@pytest.mark.parametrize("spring", SPRINGS)
def test_a_wrong_answer_is_explained_where_some_mistakes_divide_by_zero(spring: str) -> None:
    verdict = derived(spring).check(POLAR.format(r="r").replace("2*r'*theta'", "r'*theta'"))
    assert not verdict.right
    assert verdict.mistake is not None and verdict.mistake.name == "coriolis_half"


def test_a_place_measured_along_an_axis_holds_where_it_is_one_to_one() -> None:
    pendulum = loads(
        'name = "pendulum"\n[coordinates]\ntheta = "angle"\n[parameters]\nm = "1 kg"\nL = "2 m"\n'
        '[points]\nP = ["L*sin(theta)", "-L*cos(theta)"]\n[[particle]]\nmass = "m"\nat = "P"\n'
        "[[gravity]]\ndirection = [0, -1]\n"
    ).derive()
    right = "m*(x''*L^2/(L^2 - x^2) + x*x'^2*L^2/(L^2 - x^2)^2) + m*g*x/sqrt(L^2 - x^2) = 0"
    assert pendulum.check(right, hint=0).right
    assert not pendulum.check(right.replace("+ m*g", "- m*g"), hint=0).right


REFUSED = "asinh(x/(x+3))^2+2*x"
LONG = "(2*x+asinh(17*x/(10*(x+3)))^2)*sqrt(1+x^2)"


@pytest.mark.parametrize("place", rest_slow([REFUSED, LONG], [REFUSED]))
def test_a_mass_that_is_no_polynomial_has_no_factors(place: str) -> None:
    """asinh of a root in the mass matrix: SymPy's factor_list refuses it."""
    held = f'[[particle]]\nmass = "m"\nat = ["{place}", "0"]\n'
    system = loads('name = "odd"\n[coordinates]\nx = ""\n[parameters]\nm = 1\nk = 2\n' + held)
    assert not system.check("m*x'' + k*x = 0", hint=0).right
