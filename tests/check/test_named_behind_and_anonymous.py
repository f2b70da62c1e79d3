"""Factors that a chain names behind it, names between marks of Markdown, and functions and quotients of MATLAB.

Oracle: the equations of a pendulum and of a cart on a spring with a pendulum; every answer has wrong twins.
"""

from __future__ import annotations

import pytest
from small_systems import cart, pendulum

from lagrangian import Derivation
from lagrangian.errors import ParseError

HAMILTON = """*p* = (m l^2) phi' =: I(phi) phi'

- phi' = p / I(phi)
- p' = -m g l sin(phi) - b p / I(phi) + M
"""


def right(derivation: Derivation, written: str) -> bool:
    """Whether an answer is right; one that cannot be read is not."""
    try:
        return derivation.check(written, hint=0).right
    except ParseError:
        return False


def test_a_factor_is_named_behind_a_chain() -> None:
    assert right(pendulum(), HAMILTON)
    assert right(pendulum(), HAMILTON.replace("(phi)", "").replace("sin", "sin(phi)").replace("*p*", "p"))
    for was, now in (("- b p", "+ b p"), ("(m l^2)", "(m l)"), ("p / I(phi)\\n-", "p I(phi)\\n-"), ("-m g", "m g")):
        assert was not in HAMILTON or not right(pendulum(), HAMILTON.replace(was, now))


def test_what_stands_behind_the_factor_must_be_the_same() -> None:
    assert not right(pendulum(), HAMILTON.replace("=: I(phi) phi'", "=: I(phi) phi"))


@pytest.mark.parametrize("mark", ["*", "_"])
def test_a_name_between_single_marks_is_a_name(mark: str) -> None:
    written = f"{mark}I{mark} = m l^2 and {mark}G{mark} = m g l\n\nI phi'' + b phi' + G sin phi = M"
    assert right(pendulum(), written)
    assert not right(pendulum(), written.replace("+ G", "- G"))
    assert not right(pendulum(), written.replace("= m l^2", "= m l"))


MATLAB = """% w = phi'
I    = @(phi) m*l^2 + 0*cos(phi);
G    = @(phi) m*g*l*sin(phi);
wdot = @(phi, w, M) (M - b*w - G(phi))./I(phi);   % acceleration
"""


def test_functions_without_a_name_that_are_called_as_they_are_defined_are_values() -> None:
    assert right(pendulum(), MATLAB)
    assert not right(pendulum(), MATLAB.replace("- b*w", "+ b*w"))
    assert not right(pendulum(), MATLAB.replace("g*l*sin", "g*sin"))
    assert not right(pendulum(), MATLAB.replace("G(phi))", "G(w))"))


QUOTIENT = """Mm = [M + m, m*l*cos(phi); m*l*cos(phi), m*l^2];
f = [m*l*sin(phi)*phid^2; -m*g*l*sin(phi)];
K = [k, 0; 0, 0];
q = [x; phi];
qdd = Mm \\ (f - K*q);
"""


def test_a_column_divided_by_a_matrix_from_the_left_is_solved_for() -> None:
    assert right(cart(), QUOTIENT)
    assert not right(cart(), QUOTIENT.replace("f - K", "f + K"))
    assert not right(cart(), QUOTIENT.replace("-m*g", "m*g"))
    assert not right(cart(), QUOTIENT.replace("M + m,", "M,"))
