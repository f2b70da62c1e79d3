"""What is wrong is told as one thing: the value of a name, or the term that stands where another one belongs.

Oracle: a roller in a round gutter, with ρ = R − r and n = (R − r)/r, by hand.
"""

from __future__ import annotations

from functools import cache

import sympy as sp

import lagrangian as lg
from lagrangian.check.verb import CheckedAnswer
from lagrangian.model import time


@cache
def roller() -> lg.Derivation:
    s = lg.System("roller with a lump")
    phi = s.coordinate("phi")
    m, J, e, R, r, g = s.parameters("m J e R r g")
    rho = s.define("rho", R - r)
    n = s.define("n", (R - r) / r)
    s.kinetic(m * rho**2 * phi.diff(time) ** 2 / 2 + J * n**2 * phi.diff(time) ** 2 / 2, name="roller")
    s.potential(-m * g * rho * sp.cos(phi), name="weight")
    s.potential(-m * g * e * sp.cos(n * phi), name="lump")
    return s.derive()


EQUATION = "(m rho^2 + J n^2) phi'' + m g rho sin(phi) + m g e n sin(n phi) = 0"


def told(answer: str) -> CheckedAnswer:
    verdict = roller().check(answer)
    assert not verdict.right
    return verdict


def test_the_right_equation_is_accepted() -> None:
    assert roller().check(EQUATION).right
    assert roller().check(f"rho = R - r, n = R/r - 1\n{EQUATION}").right


def test_a_wrong_value_of_a_name_is_told_as_a_whole() -> None:
    verdict = told(f"n = R/r\n{EQUATION}")
    said = [str(m.what) for m in verdict.mistakes]
    assert len(said) == 1 and "R/r should be (R - r)/r" in said[0].replace("(-R + r)", "(R - r)"), said
    assert "R/r should be" in verdict.to_text().replace("\n", " ")


def test_a_term_that_is_wrong_in_a_name_is_told_as_that_term() -> None:
    verdict = told(f"n = (R + r)/r\n{EQUATION}")
    assert not any("R/r" in str(m.what) and "belong" in str(m.what) for m in verdict.mistakes)


def test_one_term_that_differs_is_one_mistake() -> None:
    verdict = told(EQUATION.replace("e n sin", "e sin"))
    said = [str(m.what) for m in verdict.mistakes]
    assert len(said) == 1 and "missing. And" not in said[0], said
    assert "should be" in said[0] or "n is missing" in said[0] or "factor" in said[0], said
