"""Terms are told with the sign that they have on the side where they stand, and in the words of what was written.

Oracle: the equations of the cart with a pole, by hand.
"""

from __future__ import annotations

import pytest
import sympy as sp

import lagrangian as lg
from built_in import derivation

POLE = "(J + m l^2) theta'' + m l x'' cos(theta) - m g l sin(theta) = 0"


def report(answer: str) -> str:
    verdict = derivation("cart-pole").check(answer)
    assert not verdict.right
    return " ".join(verdict.to_text().split())


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("cart", "said"),
    [
        (
            "(M + m) x'' = F - m l cos(theta) theta'' + m l sin(theta) theta'^2",
            "line 1, on the right-hand side: the term −b ẋ is missing",
        ),
        (
            "(M + m) x'' + b x' + m l cos(theta) theta'' - m l sin(theta) theta'^2 = -F",
            "line 1, on the right-hand side: −F has the wrong sign",
        ),
        (
            "(M + m) x'' + m l cos(theta) theta'' - m l sin(theta) theta'^2 = F",
            "line 1: the term b ẋ is missing",
        ),
        (
            "(M + m) x'' + m l cos(theta) theta'' = F - m g + m l sin(theta) theta'^2",
            "line 1, with everything on the left-hand side: the term b ẋ is missing",
        ),
        (  # within brackets
            "m (l cos(theta) theta'' + l sin(theta) theta'^2) + M x'' + m x'' = F - b x'",
            "line 1: m l θ̇² sin θ has the wrong sign",
        ),
        (
            "(M + m) x'' + m l cos(theta) theta'' = F - b x' - m l theta'^2 sin(theta)",
            "line 1, on the right-hand side: −m l θ̇² sin θ has the wrong sign",
        ),
        (
            "(M + m) x'' + m l cos(theta) theta'' - m l sin(theta) theta'^2 = b x' + F",
            "line 1, on the right-hand side: b ẋ has the wrong sign",
        ),
    ],
)
def test_a_term_is_told_with_its_sign_on_its_side(cart: str, said: str) -> None:
    assert said in (found := report(f"{cart}\n{POLE}")), found


def test_no_energy_is_blamed_that_nobody_wrote() -> None:
    cart = "(M + m) x'' + b x' + m l theta'' cos(theta) - m l theta'^2 sin(theta) = F"
    rows = f"{cart}\n{POLE.replace('- m g', '+ m g')}"
    assert "weight of rigid body 'pole' has the wrong sign." in report(rows)
    energy = "V = -m g l cos(theta)"
    assert "has the wrong sign in V" in report(f"{energy}\n{rows}")


def test_the_sides_of_an_equation_in_a_program_are_those_of_eq() -> None:
    program = """from sympy import *
t = symbols("t")
M, m, l, J, b, g, F = symbols("M m l J b g F")
x, theta = Function("x")(t), Function("theta")(t)
one = Eq((M + m)*x.diff(t, 2) + m*l*cos(theta)*theta.diff(t, 2) - l*sin(theta)*theta.diff(t)**2 + b*x.diff(t), F)
two = Eq((J + m*l**2)*theta.diff(t, 2) + m*l*cos(theta)*x.diff(t, 2) - m*g*l*sin(theta), 0)
"""
    found = report(program)
    assert "line 5: −l θ̇² sin θ should be −m l θ̇² sin θ" in found and "right-hand side" not in found, found


def test_the_sides_of_a_matrix_equation_are_those_of_its_rows() -> None:
    program = """MM = [M+m, m*l*cos(theta); m*l*cos(theta), J+m*l^2];
rhs = [F - b*xd - m*l*sin(theta)*thetad^2; m*g*l*sin(theta)];
qdd = MM\\rhs;
"""
    assert "line 2: −m l θ̇² sin θ has the wrong sign" in (found := report(program)), found  # as line 2 has it


def test_what_is_missing_in_a_derivative_of_a_constraint_is_told_on_its_side() -> None:
    s = lg.System("roller on a turning arm")
    psi, phi = s.coordinates("psi phi")
    q = s.coordinate("s")
    m, r, J = s.parameters("m r J")
    s.particle(mass=m, at=s.point("C", (q * sp.cos(psi), q * sp.sin(psi))), name="wheel")
    s.rigid_body(mass=m, inertia=J, at=s.point("O", (0, 0)), frame=s.frame(phi, name="disc"), name="disc")
    s.velocity_constraint(phi.diff() - q * psi.diff() / r, name="rolling")
    told = [str(x.what) for x in s.derive().check("phi' = s psi'/r\nphi'' = s psi''/r").mistakes]
    assert told and told[0].endswith("on the right-hand side, the term psi'*s'/r is missing."), told
