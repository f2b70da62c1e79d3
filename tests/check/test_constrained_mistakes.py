"""Mistakes in equations with multipliers: named, and never hidden in a multiplier that takes them up."""

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.check import Status

RADIAL = "m*r'' - m*r*theta'^2 + m*g*cos(theta) = F*sin(theta) + lambda"
TANGENT = "m*r^2*theta'' + 2*m*r*r'*theta' - m*g*r*sin(theta) = F*r*cos(theta) - c*theta'"


@pytest.fixture(scope="module")
def puck() -> lg.Derivation:
    """A puck on a smooth cylinder, in polar coordinates; the contact force is the multiplier of r = a."""
    s = lg.System("puck on a cylinder")
    r, theta = s.coordinates("r theta")
    m, a, c, F = *s.parameters("m a c"), s.inputs("F")
    at = s.point("P", (r * sp.sin(theta), r * sp.cos(theta)))
    s.particle(m, at=at, name="puck")
    s.gravity()
    s.force((F, 0), at=at, name="wind")
    s.damper(c, deflection=theta, name="friction")
    s.constraint(r - a, name="contact")
    return s.derive()


def test_the_right_equations_are_right_with_any_sign_and_scale(puck: lg.Derivation) -> None:
    assert puck.check(f"{RADIAL}\n{TANGENT}").right
    assert puck.check(f"{RADIAL.replace('+ lambda', '- 2*N')}\n{TANGENT}").right
    assert puck.check(f"{RADIAL}\n{TANGENT}".replace("r*r'*theta'", "r*0*theta'")).right  # r' = 0 on the cylinder


@pytest.mark.parametrize(
    "row", [("*theta'^2", "*theta'"), (" - m*r*theta'^2", ""), ("F*sin", "F*cos"), ("+ m*g*", "- m*g*")]
)
def test_a_multiplier_takes_up_no_mistake(puck: lg.Derivation, row: tuple[str, str]) -> None:
    verdict = puck.check(f"{RADIAL.replace(*row)}\n{TANGENT}")
    assert verdict.status is Status.WRONG
    assert [f.status.right for f in verdict.findings] == [False, True]
    assert verdict.mistakes and verdict.mistakes[0].coordinate in ("r", None)


@pytest.mark.parametrize(
    ("right", "wrong", "kinds", "element"),
    [
        ("- c*theta'", "", {"element_forgotten"}, "damper 'friction'"),
        ("- m*g*r", "+ m*g*r", {"wrong_sign", "gravity_sign"}, "gravity 'g'"),
        ("F*r*cos", "F*cos", {"lost_in_a_sum", "no_arm", "force_arm"}, "force 'wind'"),
    ],
)
def test_mistakes_beside_a_multiplier_are_named(
    puck: lg.Derivation, right: str, wrong: str, kinds: set[str], element: str | None
) -> None:
    for name in ("lambda", "N"):
        verdict = puck.check(f"{RADIAL.replace('lambda', name)}\n{TANGENT.replace(right, wrong)}")
        (mistake,) = verdict.mistakes
        assert mistake.name in kinds and mistake.element == element, str(mistake.what)
        assert verdict.first_wrong is not None and verdict.first_wrong.line.number == 2


def test_a_multiplier_in_an_equation_where_the_constraint_does_no_work(puck: lg.Derivation) -> None:
    (mistake,) = puck.check(f"{RADIAL}\n{TANGENT} + lambda").mistakes
    assert mistake.name == "term_too_much" and mistake.coordinate == "theta"
