"""Rows behind coordinates, of a step that is set equal to another or below a heading of forces, are generalized forces.

Oracle: two carts between a wall and a push, with their energies, forces and equations by hand.
"""

from __future__ import annotations

from functools import partial

import pytest
from small_systems import two_carts

from lagrangian.check.verdict import Verdict

carts = partial(two_carts, between=False)
ENERGIES = "T = m x'^2/2 + n y'^2/2\nV = k x^2/2 + c (y - x)^2/2\n"
STEPS = """\
Step 5  x: m x'' + k x {sign} c (y - x)
        y: n y'' + c (y - x)
Step 6  x: {x}
        y: {y}
"""
SAID = ["", "\nThe equations of motion are Step 5 = Step 6.", "\nstep 5 equals step 6", "\nStep 5 = step 6 for x and y"]
HEADED = """\
Generalized forces
  x: {x}
  y: {y}
m x'' + k x - c (y - x) = {x}
n y'' + c (y - x) = {y}"""


def steps(x: str, y: str, sign: str = "-") -> str:
    return ENERGIES + STEPS.format(x=x, y=y, sign=sign)


def wrong_lines(verdict: Verdict) -> list[int | None]:
    return [f.line.number for f in verdict.findings if not f.status.right and not f.follows]


@pytest.mark.parametrize("said", SAID)
def test_steps_that_are_set_equal_are_equations(said: str) -> None:
    """The sides of the law stand apart, behind the numbers of their steps."""
    verdict = carts().check(steps("-b x'", "F") + said)
    assert verdict.right, str(verdict)
    assert "not read" not in str(verdict)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("said", SAID)
def test_the_wrong_side_is_blamed(said: str) -> None:
    """A reaction in the Ξ of y, or a wrong left-hand side, is blamed where it stands."""
    verdict = carts().check(steps("-b x'", "F + b x'") + said)
    assert wrong_lines(verdict) == [6]
    assert "all non-conservative forces" not in str(verdict)
    assert wrong_lines(carts().check(steps("-b x'", "F", "+") + said)) == [3]


def test_rows_below_a_heading_of_forces_are_judged() -> None:
    assert carts().check(ENERGIES + HEADED.format(x="-b x'", y="F")).right
    verdict = carts().check(ENERGIES + HEADED.format(x="0", y="F"))
    assert wrong_lines(verdict) == [4] and not verdict.right


def test_forces_below_a_heading_that_hold_springs_are_no_mistake() -> None:
    """What is called a generalized force may hold what has a potential, if no V is stated."""
    rows = "x: -k x + c (y - x) - b x'\ny: F - c (y - x)\n"
    rest = "m x'' = -k x + c (y - x) - b x'\nn y'' = F - c (y - x)"
    assert carts().check(f"T = m x'^2/2 + n y'^2/2\nGeneralized forces:\n{rows}{rest}").right
