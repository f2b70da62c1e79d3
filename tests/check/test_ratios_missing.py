"""A ratio of two letters that is missing, a/r of a lever, is called so, and no letter is said to stand in its place.

Oracle: by hand, a winch with a gear; see `small_systems`.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp
from small_systems import winch

import lagrangian as lg
from lagrangian.check.explain.own_terms import term_replaced
from lagrangian.page.formula import text

LEFT = "(m r² + J + n² I) φ'' + c φ' - m g r ="


def told(answer: str, system: lg.Derivation | None = None) -> str:
    """What is told of a wrong answer, in one line."""
    verdict = (system or winch()).check(answer)
    assert not verdict.right
    return " ".join(str(verdict).split())


@cache
def lever() -> lg.Derivation:
    """A bar that a strap turns, with a weight on it."""
    s = lg.System("bar on a strap")
    phi = s.coordinate("phi")
    J, M, m, L, r, a, k, g = s.parameters("J M m L r a k g")
    s.kinetic(J * phi.diff() ** 2 / 2, name="axle")
    s.kinetic(sp.Rational(1, 6) * M * L**2 * (r / a * phi.diff()) ** 2, name="bar")
    s.particle(m, at=s.point("P", (L * sp.cos(r / a * phi), L * sp.sin(r / a * phi))), name="weight")
    s.gravity(direction=(0, -1), g=g)
    s.spring(k, deflection=r * phi, name="spring")
    return s.derive()


def test_a_missing_ratio_is_no_letter_in_place_of_another() -> None:
    said = told("(J + (1/3 M + m) L² r²/a²) φ'' + k r² φ + m g L cos(r φ/a) = 0", lever())
    assert "the factor r/a is missing" in said and "stands in place" not in said


def test_a_letter_stands_in_place_of_another_only_where_it_stands() -> None:
    m, r, a = sp.symbols("m r a")
    assert term_replaced(m * a, m * r)[0] == "letter"
    assert term_replaced(m * r, m * r**2 / a) == (
        "factor_missing",
        text("In the term ", m * r, ", the factor ", r / a, " is missing."),
    )
    assert term_replaced(m * r / a, m * r**2 / a**2)[0] == "not_squared"
    assert term_replaced(m * r / a, m)[0] == "foreign_factor"


def test_a_ratio_that_is_not_squared() -> None:
    answer = "T = 1/2 J φ'² + 1/6 M L² r/a φ'² + 1/2 m L² r²/a² φ'²\nV = 1/2 k r² φ² + m g L sin(r φ/a)"
    said = told(answer, lever())
    assert "r/a stands once, and belongs there squared" in said


@pytest.mark.parametrize("right", ["-B + a F/r"])
def test_a_pure_number_is_found_by_no_units(right: str) -> None:
    said = told(f"{LEFT} {right}")
    assert "the factor n is missing" in said and "Compare the units" not in said
