"""An answer that gives the energy theorem alone is told what it proves, and what it does not; its mistake is named."""

from __future__ import annotations

import pytest

from built_in import derivation
from lagrangian.check import Status

ENERGY = "(M+m)*x'^2/2 + m*l*cos(theta)*x'*theta' + (J+m*l^2)*theta'^2/2 + m*g*l*cos(theta)"


def test_of_one_coordinate_it_is_the_equation_wherever_that_moves() -> None:
    verdict = derivation("pendulum").check("d/dt(m*L^2*theta'^2/2 - m*g*L*cos(theta)) = -b*theta'^2")
    assert verdict.status is Status.SAME_MOTION
    assert "the same wherever that is not 0" in str(verdict.findings[0].note)


def test_of_two_coordinates_it_is_one_equation_of_two() -> None:
    verdict = derivation("cart-pole").check(f"d/dt({ENERGY}) = F*x' - b*x'^2")
    assert verdict.status is Status.INCOMPLETE and verdict.findings[0].status.right
    assert "energy theorem" in str(verdict.findings[0].note) and "do not follow" in str(verdict.findings[0].note)


@pytest.mark.parametrize(
    ("old", "new", "name"),
    [
        ("- b*x'^2", "+ b*x'^2", "damper_sign"),
        ("+ m*g*l", "- m*g*l", "gravity_sign"),
        ("F*x' ", "", "element_forgotten"),
    ],
)
def test_a_mistake_in_it_is_named_without_terms_of_lagranges_equations(old: str, new: str, name: str) -> None:
    verdict = derivation("cart-pole").check(f"d/dt({ENERGY}) = F*x' - b*x'^2".replace(old, new))
    assert verdict.status is Status.WRONG and [m.name for m in verdict.mistakes] == [name]
    assert not verdict.findings[0].differences and "read as the energy theorem" in str(verdict.findings[0].note)


def test_an_equation_of_motion_is_not_taken_for_it() -> None:
    verdict = derivation("cart-pole").check("(J+m*l^2)*theta'' + m*l*cos(theta)*x'' = 0")
    assert verdict.findings[0].note is None
