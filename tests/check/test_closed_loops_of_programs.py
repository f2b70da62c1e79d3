"""What a program gives an input is no mistake in the equations of motion, and neither are quantities without units.

Oracle: a mass on a spring, and a cart with a bob, by hand.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp
from small_systems import mass

import lagrangian as lg

COMMENT = "# m x'' + b x' + k x = F"
HEAD = """import numpy as np
from scipy.integrate import solve_ivp
m, k, b = 2.0, 50.0, 0.5
kp, kd = 10.0, 2.0
"""
NAMED = """def f(t, y):
    x, v = y
    F = -kp*x - kd*v
    return [v, (F - b*v - k*x)/m]
"""
CALLED = """def F(t, y):
    return -kp*y[0] - kd*y[1]
def f(t, y):
    x, v = y
    return [v, (F(t, y) - b*v - k*x)/m]
"""
PUT_IN = """def f(t, y):
    x, v = y
    return [v, (-kp*x - kd*v - b*v - k*x)/m]
"""
WITHOUT_UNITS = """# dimensionless: time in sqrt(m/k)
zeta = 0.1
def f(t, y):
    x, v = y
    return [v, -2*zeta*v - x]
"""
MATLAB = """m = 2; k = 50; b = 0.5; kp = 10; kd = 2;
F = @(t,y) -kp*y(1) - kd*y(2);
f = @(t,y) [y(2); (F(t,y) - b*y(2) - k*y(1))/m];
[t,y] = ode45(f,[0 10],[1;0]);
"""


@cache
def cart() -> lg.Derivation:
    """A cart with a bob that hangs from it, and one force on the cart."""
    s = lg.System("cart with a bob")
    x, th = s.coordinates("x theta")
    M, m, l_, g = s.parameters("M m l g")
    s.particle(M, at=s.point("C", (x, 0)), name="cart")
    s.particle(m, at=s.point("P", (x + l_ * sp.sin(th), -l_ * sp.cos(th))), name="bob")
    s.gravity((0, -1), g)
    s.force(s.input("F"), deflection=x)
    return s.derive()


CART = """# (M + m) x'' + m l theta'' cos(theta) - m l theta'^2 sin(theta) = F
# m l^2 theta'' + m l x'' cos(theta) + m g l sin(theta) = 0
import numpy as np
M, m, l, g = 2.0, 1.0, 0.5, 9.81
def f(t, y):
    x, theta, v, w = y
    F = m*g - 3*theta - 4*w
    A = np.array([[M + m, m*l*np.cos(theta)], [m*l*np.cos(theta), m*l**2]])
    a, e = np.linalg.solve(A, [F + m*l*w**2*np.sin(theta), -m*g*l*np.sin(theta)])
    return [v, w, a, e]
"""


@pytest.mark.sampled(3)
@pytest.mark.parametrize("program", [HEAD + NAMED, HEAD + CALLED, HEAD + PUT_IN, HEAD + WITHOUT_UNITS])
def test_equations_in_comments_are_the_answer(program: str) -> None:
    assert mass().check(f"{COMMENT}\n{program}").right
    assert not mass().check(f"{COMMENT.replace('b x', '2 b x')}\n{program}").right


@pytest.mark.parametrize("program", [HEAD + NAMED, HEAD + CALLED, MATLAB])
def test_a_program_alone_is_right_with_its_input_as_it_is(program: str) -> None:
    verdict = mass().check(program)
    assert verdict.right
    assert "What the program gives F was not judged." in map(str, verdict.notes)


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("old", "new"), [("F - b*v", "F"), ("- k*x)", "+ k*x)"), ("-kp*x - kd*v - b*v", "-kp*x - kd*v"), ("/m]", "/k]")]
)
@pytest.mark.parametrize("program", [HEAD + NAMED, HEAD + PUT_IN])
@pytest.mark.parametrize("comment", [COMMENT, "#"])
def test_a_wrong_program_is_wrong(program: str, comment: str, old: str, new: str) -> None:
    if old in program:
        assert not mass().check(f"{comment}\n{program.replace(old, new)}").right


def test_all_forces_under_the_name_of_the_input_are_not_read_as_the_input() -> None:
    program = HEAD + NAMED.replace("F = -kp*x - kd*v", "F = -kp*x - k*x").replace("- b*v - k*x)", "- b*v)")
    assert not mass().check(program).right


def test_a_law_with_letters_of_the_system_beside_right_comments() -> None:
    assert cart().check(CART).right
    assert not cart().check(CART.replace("m*l*w**2", "2*m*l*w**2")).right
    assert not cart().check(CART.replace("# m l^2 theta''", "# 2 m l^2 theta''")).right


@pytest.mark.parametrize(
    "program",
    [
        "# ratio z is dimensionless\n" + HEAD + "def f(t, y):\n    x, v = y\n    return [v, (F - 50*x + v)/2]\n",
        "# unit less\ndef f(t, y):\n    x, v = y\n    a = F - x + 3*v # dimensionless\n    return [v, a]\n",
        HEAD + NAMED.replace("F = -kp*x - kd*v", "F = -k*x - b*v"),
    ],
)
def test_a_wrong_program_stays_wrong_beside_a_right_comment(program: str) -> None:
    """A ratio without a dimension says nothing of the equations, and −k x − b x' may be all forces."""
    assert not mass().check(f"{COMMENT}\n{program}").right
