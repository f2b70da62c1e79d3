"""Functions that return accelerations, and comments that say which names are rates.

Oracle: a cart with a bob, and a mass on a spring, by hand.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp
from small_systems import mass

import lagrangian as lg


@cache
def cart() -> lg.Derivation:
    """A cart on a spring, with a bob that hangs from it."""
    s = lg.System("cart with a bob")
    x, th = s.coordinates("x theta")
    M, m, l_, g, b, k = s.parameters("M m l g b k")
    s.particle(M, at=s.point("C", (x, 0)), name="cart")
    s.particle(m, at=s.point("P", (x + l_ * sp.sin(th), -l_ * sp.cos(th))), name="bob")
    s.gravity((0, -1), g)
    s.spring(k, deflection=x)
    s.damper(b, deflection=x)
    s.force(s.input("F"), deflection=x)
    return s.derive()


FIELDS = "M = p.M; m = p.m; l = p.l; g = p.g; k = p.k; b = p.b;"
COLUMN = "M = p(1); m = p(2); l = p(3); g = p(4); k = p(5); b = p(6);"
DEALT = "[M, m, l, g, k, b] = deal(p.M, p.m, p.l, p.g, p.k, p.b);"
SOLVED = """xdd = (F - b*xd - k*x + m*l*thd^2*sin(th) + m*g*sin(th)*cos(th))/(M + m*sin(th)^2);
thdd = -(xdd*cos(th) + g*sin(th))/l;"""
CRAMER = """a11 = M + m; a12 = m*l*cos(th); a22 = m*l^2;
b1 = F - b*xd - k*x + m*l*thd^2*sin(th); b2 = -m*g*l*sin(th);
det = a11*a22 - a12^2;
xdd = (a22*b1 - a12*b2)/det;
thdd = (a11*b2 - a12*b1)/det;"""
LINEAR = """A = [M+m, m*l*cos(th); m*l*cos(th), m*l^2];
sol = A\\[F - b*xd - k*x + m*l*thd^2*sin(th); -m*g*l*sin(th)];
xdd = sol(1); thdd = sol(2);"""


@pytest.mark.sampled(8)
@pytest.mark.parametrize("body", [SOLVED, CRAMER, LINEAR])
@pytest.mark.parametrize("given", [FIELDS, COLUMN, DEALT])
def test_accelerations_as_outputs(given: str, body: str) -> None:
    program = f"function [xdd, thdd] = eom(x, xd, th, thd, F, p)\n{given}\n{body}\nend\n"
    assert cart().check(program).right
    assert not cart().check(program.replace("m*l*thd^2", "2*m*l*thd^2")).right
    assert not cart().check(program.replace("- b*xd", "+ b*xd")).right


def test_a_comment_of_a_program_that_is_carried_out_says_which_names_are_rates() -> None:
    program = """% p = thetadot, v = xdot
function [xdd, thdd] = eom(x, v, theta, p, F, M, m, l, g, k, b)
A = [M+m, m*l*cos(theta); m*l*cos(theta), m*l^2];
r = [F - b*v - k*x + m*l*p^2*sin(theta); -m*g*l*sin(theta)];
s = A\\r;
xdd = s(1); thdd = s(2);
end
"""
    assert cart().check(program).right
    assert not cart().check(program.replace("p^2", "2*p^2")).right
    assert not cart().check(program.replace("p = thetadot, v = xdot", "v = thetadot, p = xdot")).right


@pytest.mark.parametrize("comment", ["% p = xdot", "% p = x'", "# with p := xdot", "// p is x_dot"])
def test_a_comment_says_which_name_is_a_rate(comment: str) -> None:
    assert mass().check(f"{comment}\nxdd = (F - b*p - k*x)/m;").right
    assert mass().check(f"xdd = (F - b*p - k*x)/m;   {comment}").right
    assert not mass().check(f"{comment}\nxdd = (F - 2*b*p - k*x)/m;").right


def test_comments_that_say_two_things_of_a_name_are_not_read() -> None:
    with pytest.raises(lg.ParseError):
        mass().check("% p = xdot\n% p = xddot\nxdd = (F - b*p - k*x)/m;")


@pytest.mark.parametrize("said", ["only x remains", "so only r remains.", "Then only x remains unknown"])
def test_what_remains_is_no_equation(said: str) -> None:
    assert mass().check(f"m x'' + b x' + k x = F\n{said}").right
