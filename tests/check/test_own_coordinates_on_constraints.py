"""Answers in one coordinate of their own in which a constraint holds by itself, by the law of sines.

Oracle: a strut between a floor and an inclined guide; with θ, its angle at the floor, x = l sin(β + θ)/sin β and
s = l sin θ/sin β, so that T* = ½ l² (m cos²(β + θ) + n cos² θ) θ̇²/sin² β and V = n g l sin θ.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from built_in import derivation


@cache
def strut() -> lg.Derivation:
    """Two masses on straight guides that a strut holds at the distance l."""
    system = lg.System("strut")
    x, s = system.coordinates("x s")
    m, n, length, beta, g = system.parameters("m n l beta g")
    system.kinetic(m * x.diff() ** 2 / 2)
    system.kinetic(n * s.diff() ** 2 / 2)
    system.potential(n * g * s * sp.sin(beta))
    system.force(system.input("F"), deflection=x)
    system.constraint(x**2 + s**2 - 2 * x * s * sp.cos(beta) - length**2, name="strut")
    return system.derive()


SAID = "s = l sin(theta)/sin(beta)\nx = l sin(beta + theta)/sin(beta)\n"
ENERGIES = "T = l^2/(2 sin(beta)^2) (m cos(beta + theta)^2 + n cos(theta)^2) theta'^2\nV = n g l sin(theta)\n"
ROW = (
    "l^2/sin(beta)^2 ((m cos(beta + theta)^2 + n cos(theta)^2) theta'' - (m sin(beta + theta) cos(beta + theta)"
    " + n sin(theta) cos(theta)) theta'^2) + n g l cos(theta) = F l cos(beta + theta)/sin(beta)"
)


def test_the_answer_is_right() -> None:
    verdict = strut().check(SAID + ENERGIES + ROW, hint=0)
    assert verdict.right
    assert verdict.status.value == "right in other coordinates"


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("written", "instead", "said"),
    [
        ("g l cos(theta)", "g l sin(theta)", "are exchanged in the term g*l*n*sin(theta)"),
        ("= F l cos(beta + theta)/sin(beta)", "= F", "F"),
        ("V = n g l sin(theta)", "V = n g l cos(theta)", "Sine and cosine are exchanged in the weights"),
    ],
)
def test_a_mistake_is_named_there_and_right_lines_are_right(written: str, instead: str, said: str) -> None:
    verdict = strut().check((SAID + ENERGIES + ROW).replace(written, instead))
    assert not verdict.right
    assert said in str(verdict.mistakes[0].what)
    assert sum(not f.status.right for f in verdict.findings) == 1


@pytest.mark.slow
def test_a_multiplier_beside_it_is_not_passed_over() -> None:
    assert not strut().check(SAID + ENERGIES + ROW + "\nm x'' = F + 3 lambda x", hint=0).right


def test_coordinates_that_break_the_constraint_are_the_mistake() -> None:
    x = "x = l cos(theta)"
    T = "T = l^2/2 (m sin(theta)^2 + n cos(theta)^2/sin(beta)^2) theta'^2\nV = n g l sin(theta)\n"
    verdict = strut().check(
        f"s = l sin(theta)/sin(beta)\n{x}\n{T}l^2 (m sin(theta)^2 + n cos(theta)^2/sin(beta)^2) theta''"
        " + l^2 (m - n/sin(beta)^2) sin(theta) cos(theta) theta'^2 + n g l cos(theta) = -F l sin(theta)"
    )
    assert not verdict.right
    assert str(verdict.mistakes[0].what).endswith("do not satisfy constraint 'strut'.")
    roots = [f.line.text for f in verdict.findings if not f.status.right and not f.follows]
    assert roots == ["s = l sin(theta)/sin(beta)", x]


def test_a_derivative_of_a_potential_into_which_a_constraint_is_put_is_right() -> None:
    """With z = l − s below V = … − M g z, ∂V/∂s has + M g; only the wrong part of V is told."""
    system = lg.System("hoist")
    s, z = system.coordinates("s z")
    m, M, g, length, alpha = system.parameters("m M g l alpha")
    system.kinetic(m * s.diff() ** 2 / 2 + M * z.diff() ** 2 / 2)
    system.potential(-m * g * s * sp.sin(alpha) - M * g * z)
    system.force(system.input("F"), deflection=s)
    system.constraint(s + z - length, name="rope")
    answer = """T = m s'^2/2 + M z'^2/2
V = -m g s sin(alpha) - M g z
z = l - s
dV/ds = -m g sin(alpha) + M g
(m + M) s'' - m g sin(alpha) + M g = F"""
    d = system.derive()
    assert d.check(answer).right
    verdict = d.check(answer.replace("sin(alpha)", "cos(alpha)"))
    wrong = [f.line.number for f in verdict.findings if not f.status.right and not f.follows]
    assert wrong == [2] and next(f for f in verdict.findings if f.line.number == 4).follows
    slip = d.check(answer.replace("+ M g\n", "- M g\n"))
    assert [f.line.number for f in slip.findings if not f.status.right and not f.follows] == [4]


def test_a_relation_in_a_coordinate_counted_the_other_way_is_judged() -> None:
    rows = "phi = -psi\nm*x'' - m*g*sin(beta) = -lambda\nJ*psi'' = -r*lambda\nx = {}r*psi"
    assert not derivation("wheel-on-incline").check(rows.format("")).right
    assert not derivation("wheel-on-incline").check(rows.format("-2*")).right
