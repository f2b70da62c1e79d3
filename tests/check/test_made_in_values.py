"""A wrong term of an equation is told at the value of a name, or the entry of a matrix, in which it was made.

Oracle: by hand. Who leaves J out of an entry of the mass matrix has made the equations that are solved with it wrong by
that; who adds a right force with the wrong sign has not made the force wrong.
"""

from __future__ import annotations

import pytest

from built_in import derivation
from lagrangian import CheckedAnswer
from lagrangian.check import Status

MASSES = "M + m, m*l*cos(theta); m*l*cos(theta), J + m*l^2"
FORCES = "F - b*xd + m*l*thetad^2*sin(theta); m*g*l*sin(theta)"


def matrices(masses: str = MASSES, forces: str = FORCES, solved: str = "MM\\rhs") -> str:
    """The equations of the pole on a cart, as a program has them."""
    return f"MM = [{masses}];\nrhs = [{forces}];\nqdd = {solved};\n"


def pole(text: str) -> CheckedAnswer:
    """The verdict on an answer for the pole on a cart."""
    return derivation("cart-pole").check(text)


def wrong(checked: CheckedAnswer) -> list[tuple[int, bool]]:
    """The numbers of the lines that are wrong, and whether they follow from others."""
    return [(f.line.number, f.follows) for f in checked.findings if f.status is Status.WRONG]


def test_right_matrices_are_right() -> None:
    """The matrices of this module."""
    assert pole(matrices()).right


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("text", "line", "term"),
    [
        (matrices(masses=MASSES.replace("J + ", "")), 1, "the term J is missing"),
        (matrices(masses=MASSES.replace("m*l^2", "m*l")), 1, "m l should be m l²"),
        (matrices(forces=FORCES.replace("- b*xd ", "")), 2, "the term −b ẋ is missing"),
        (matrices(forces=FORCES.replace("b*xd + ", "b*xd - ")), 2, "−m l θ̇² sin θ has the wrong sign"),
        (matrices(forces=f"{FORCES} - b*thetad"), 2, "the term −b θ̇ does not belong there"),
    ],
)
def test_entry_of_a_matrix(text: str, line: int, term: str) -> None:
    """The line of the matrix is told, with the term of its entry; the equation follows."""
    checked = pole(text)
    assert not checked.right
    assert wrong(checked) == [(line, False), (3, True)]
    assert checked.first_wrong is not None
    assert checked.first_wrong.line.number == line
    assert term in checked.to_text()


def test_line_of_the_row() -> None:
    """A matrix over several lines: the line of the row."""
    text = matrices(forces=FORCES.replace("g*l*", "g*").replace("; ", ";\n"))
    assert wrong(pole(text))[0] == (3, False)


def test_term_in_words() -> None:
    """The sentence speaks of the term of the entry, on its line."""
    text = matrices(forces=FORCES.replace("m*g*l*sin(theta)", "m*g*l*sin(theta) + m*l^2*thetad^2"))
    assert "In line 2, the term m l² θ̇² does not belong there" in pole(text).to_text().replace("\n", " ")


def test_force_that_is_used_wrongly() -> None:
    """A right force with the wrong sign in the equation, or matrices with a factor: the values are right."""
    assert wrong(pole(matrices("M + m, m*l*cos(theta); m*l*cos(theta), J + m*l^2", FORCES, "MM\\(2*rhs)"))) == [
        (3, False),
        (3, False),
    ]
    damped = "D = [b 0; 0 0];\n" + matrices(forces=FORCES.replace("- b*xd ", ""), solved="MM\\(rhs + D*qd)")
    assert wrong(pole(damped)) == [(4, False)]


def test_generalized_forces_of_a_program() -> None:
    """A force in the equation of another coordinate is told where the program has it."""
    program = """from sympy import *
t = symbols('t')
M, m, J, l, b, g, F = symbols('M m J l b g F')
x, theta = Function('x')(t), Function('theta')(t)
T = M*x.diff(t)**2/2 + m*(x.diff(t)**2 + 2*l*x.diff(t)*theta.diff(t)*cos(theta) + l**2*theta.diff(t)**2)/2
T = T + J*theta.diff(t)**2/2
V = m*g*l*cos(theta)
L = T - V
Q1 = F - b*x.diff(t)
Q2 = {force}
e1 = Eq(L.diff(x.diff(t)).diff(t) - L.diff(x), Q1)
e2 = Eq(L.diff(theta.diff(t)).diff(t) - L.diff(theta), Q2)
"""
    assert pole(program.format(force="0")).right
    checked = pole(program.format(force="-F*l*cos(theta)"))
    assert not checked.right
    assert wrong(checked) == [(10, False), (12, True)]


@pytest.mark.slow
def test_solved_equation() -> None:
    """An inertia in a denominator, and a numerator that is put together in steps."""
    text = """Jt = J + m*l^2 - m*l^2*cos(theta)^2*m/(M + m);
num = m*g*l*sin(theta);
num = num - m*l*cos(theta)*{push}/(M + m);
num = num - m^2*l^2*thetad^2*sin(theta)*cos(theta)/(M + m);
thetadd = num/Jt;
xdd = (F - b*xd + m*l*thetad^2*sin(theta) - m*l*cos(theta)*thetadd)/(M + m);
"""
    assert pole(text.format(push="(F - b*xd)")).right
    checked = pole(text.format(push="(F + b*xd)"))
    assert not checked.right
    assert (3, False) in wrong(checked)
    assert (5, True) in wrong(checked)
