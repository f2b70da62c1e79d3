"""One wrong term in an equation that is a sum of right ones: a body's own balance with a force of another line put in.

Oracle: a bar with a rotor on it, by Newton and Euler; each answer differs from the right one in one place.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from built_in import derivation


@cache
def bar() -> lg.Derivation:
    """A bar about a fixed hinge, that carries the axle of an eccentric rotor at its end."""
    s = lg.System("bar")
    theta, psi = s.coordinates("theta psi")
    J, I, m, a, e, c, k = s.parameters("J I m a e c k")
    whole = theta.diff() + psi.diff()
    s.kinetic(J * theta.diff() ** 2 / 2 + I * whole**2 / 2)
    s.kinetic(m * (a**2 * theta.diff() ** 2 + e**2 * whole**2 + 2 * a * e * theta.diff() * whole * sp.cos(psi)) / 2)
    s.damper(c, deflection=psi)
    s.spring(k, deflection=theta)
    s.torque(s.input("M"), on=psi)
    return s.derive()


ROTOR = "(I + m e^2) (theta'' + psi'') + m a e (theta'' cos(psi) + theta'^2 sin(psi)) = M - c psi'"
FORCE = "N = m a theta'' + m e (theta'' + psi'') cos(psi) - m e (theta' + psi')^2 sin(psi)"
BAR = "J theta'' = -k theta - M + c psi' - N a"
ANSWER = f"{ROTOR}\n{FORCE}\n{BAR}"


def differing(answer: str) -> list[str]:
    """What is told of the terms that differ, and what went wrong."""
    verdict = bar().check(answer)
    assert not verdict.right
    return [" ".join(str(m.what).split()) for m in verdict.mistakes]


def test_the_answer_is_right() -> None:
    assert bar().check(ANSWER, hint=0).right


@pytest.mark.sampled(5)
@pytest.mark.parametrize(
    ("written", "instead", "said"),
    [
        ("J theta'' = -k", "-J theta'' = -k", "J*theta'' has the wrong sign"),
        ("= -k theta", "= -2 k theta", "-2*k*theta should be -k*theta"),
        ("- M + c psi'", "+ M + c psi'", "M has the wrong sign"),
        ("+ c psi'", "+ k psi'", "k*psi' should be c*psi'"),
        ("(theta' + psi')^2 sin(psi)", "(theta' + psi')^2 cos(psi)", "cos(psi)"),
    ],
)
def test_one_wrong_term_is_told_alone(written: str, instead: str, said: str) -> None:
    told = differing(ANSWER.replace(written, instead))
    assert len(told) == 1
    assert said in told[0]


@pytest.mark.slow
def test_two_wrong_terms_are_not_told_as_one() -> None:
    wrong = ANSWER.replace("= -k theta", "= -2 k theta").replace("+ c psi' - N a", "- c psi' - N a")
    assert not any("should be k*theta" in x or "c*psi' has" in x for x in differing(wrong)) or len(differing(wrong)) > 1


def test_a_term_that_a_sum_of_right_equations_lacks_is_told() -> None:
    sum_of_both = "(M + m + m l cos(theta)) x'' + (J + m l^2 + m l cos(theta)) theta'' - m l sin(theta) theta'^2"
    pole = "m l x'' cos(theta) + (J + m l^2) theta'' - m g l sin(theta) = 0"
    answer = f"{sum_of_both} + b x' - m g l sin(theta) = F\n{pole}"
    assert derivation("cart-pole").check(answer).right
    verdict = derivation("cart-pole").check(answer.replace(" + b x'", ""))
    assert [str(m.what) for m in verdict.mistakes] == ["In line 1, the term b*x' is missing."], verdict.to_text()


def test_the_term_of_one_line_with_a_solved_force_is_told_beside_right_equations() -> None:
    s = lg.System("roller")
    x = s.coordinates("x")
    m, J, R, k = s.parameters("m J R k")
    s.kinetic((m + J / R**2) * x.diff() ** 2 / 2)
    s.spring(k, deflection=x)
    rows = "m x'' = -k x - H\n{} x''/R = R H\nH = J x''/R^2\n(m + J/R^2) x'' + k x = 0"
    derived = s.derive()
    assert derived.check(rows.format("J")).right
    verdict = derived.check(rows.format("J R"))
    assert [f.line.number for f in verdict.findings if not f.status.right] == [2], verdict.to_text()
    assert verdict.mistakes and "line 2" in str(verdict.mistakes[0].what), verdict.to_text()


@pytest.mark.parametrize(
    ("written", "told"),
    [
        ("(x' + l theta' cos(theta))^2", "l*cos(theta)*theta' + x'"),
        ("(l theta' sin(theta) + 0)^2", ""),
    ],
)
def test_a_sum_of_rates_that_is_not_squared_is_told(written: str, told: str) -> None:
    energy = "T = 1/2 M x'^2 + 1/2 m [(x' + l theta' cos(theta))^2 + (l theta' sin(theta) + 0)^2] + 1/2 J theta'^2"
    rows = "\n(M + m) x'' + m l theta'' cos(theta) - m l theta'^2 sin(theta) = F - b x'"
    rows += "\nm l x'' cos(theta) + (J + m l^2) theta'' - m g l sin(theta) = 0"
    assert derivation("cart-pole").check(energy + rows).right
    verdict = derivation("cart-pole").check(energy.replace(written, written.removesuffix("^2")) + rows)
    assert not verdict.right
    assert [f.line.number for f in verdict.findings if not f.status.right] == [1]
    assert ("is not squared" in str(verdict.mistakes[0].what)) == bool(told), verdict.to_text()
    assert told in str(verdict.mistakes[0].what)
    twice = energy.replace(written, written.removesuffix("^2")).replace("1/2 J", "J")
    assert "sum" not in str(derivation("cart-pole").check(twice + rows).mistakes)
