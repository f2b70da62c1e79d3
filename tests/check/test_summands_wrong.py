"""A row that is solved in the answer's own names is wrong in one of its summands, as they are written.

Oracle: Cramer's rule for a cart with a pendulum, M ẍ + S φ̈ = P and S ẍ + I φ̈ = Q.
"""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.check.explain.summands_wrong import one_wrong_summand
from lagrangian.check.lines import filled, lines_of
from lagrangian.check.reading import parse_answer
from lagrangian.check.reference import truth_of


@cache
def cart() -> lg.Derivation:
    """A cart with a pendulum, a spring, a damper, and a push."""
    s = lg.System("cart and pendulum")
    x, phi = s.coordinates("x phi")
    m, n, length, g, k, b, c = s.parameters("m n l g k b c")
    s.particle(m, at=s.point("A", (x, 0)), name="cart")
    s.particle(n, at=s.point("B", (x + length * sp.sin(phi), -length * sp.cos(phi))), name="bob")
    s.gravity(direction=(0, -1), g=g)
    s.spring(k, deflection=x, name="spring")
    s.damper(b, deflection=x, name="brake")
    s.damper(c, deflection=phi, name="pin")
    s.force(s.input("F"), deflection=x, name="push")
    return s.derive()


SOLVED = """\
(m + n) x'' + S phi'' = P
S x'' + n l^2 phi'' = Q
S = n l cos(phi)
P = F - b x' - k x + n l sin(phi) phi'^2
Q = -c phi' - n g l sin(phi)
D = (m + n) n l^2 - S^2
x'' = (n l^2 P - S Q)/D
phi'' = ({first} {sign} S P)/D"""


def test_the_solved_rows_are_right() -> None:
    assert cart().check(SOLVED.format(first="(m + n) Q", sign="-")).right


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("first", "sign", "said"),
    [("(m + n) Q", "+", "has the wrong sign"), ("2 (m + n) Q", "-", "should be"), ("(m + n) Q", "- 2", "should be")],
)
def test_one_summand_is_wrong(first: str, sign: str, said: str) -> None:
    """The sign or the number of one product of names."""
    verdict = cart().check(SOLVED.format(first=first, sign=sign))
    assert [f.line.number for f in verdict.findings if not f.status.right] == [8]
    assert len(verdict.mistakes) == 1 and said in str(verdict.mistakes[0].what)


@pytest.mark.parametrize(
    ("first", "sign", "factor"),
    [("(m + n) Q", "+", -1), ("2 (m + n) Q", "-", sp.S.Half), ("(m + n) Q - F^2 S", "-", 0), ("(m + n) Q", "-", None)],
)
def test_the_summand_is_found_as_it_is_written(first: str, sign: str, factor: sp.Expr | None) -> None:
    """However many terms it is multiplied out."""
    truth = truth_of(cart())
    read = filled(truth, lines_of(parse_answer(SOLVED.format(first=first, sign=sign), cart().model)))
    wrong = one_wrong_summand(truth, next(x for x in read if x.number == 8))
    assert (None if wrong is None else wrong.factor) == factor


def test_nothing_is_said_of_a_row_with_two_wrong_summands() -> None:
    verdict = cart().check(SOLVED.format(first="3 (m + n) Q", sign="+ 7"))
    assert not verdict.right and not any("has the wrong sign" in str(m.what) for m in verdict.mistakes)


NAMED = """\
A = m + n, B = n l^2, S = n l cos(phi)
P = F - b x' - k x + n l sin(phi) phi'^2
Q = -c phi' - n g l sin(phi)
A x'' + S phi'' = P
S x'' + B phi'' = Q
{left} x'' = {right}
phi'' = (Q - S x'')/B"""


@pytest.mark.parametrize(
    ("left", "right", "told"),
    [
        ("(A B - S^2)", "B P - S Q", None),
        ("", "(A P - S Q)/(A B - S^2)", "A*P/(A*B - S^2) should be B*P/(A*B - S^2)"),
        ("(A - S^2/B)", "P - S Q", "-Q*S should be -Q*cos(phi)/l"),
        ("(A B - S^2)", "B P - S Q/A", "-Q*S/A should be -Q*S"),
    ],
)
def test_a_summand_with_another_quantity_of_the_answer(left: str, right: str, told: str | None) -> None:
    verdict = cart().check(NAMED.format(left=left, right=right))
    if told is None:
        assert verdict.right
    else:
        assert [str(m.what).split(", ")[-1] for m in verdict.mistakes] == [f"{told}."]
        assert [f.line.number for f in verdict.open_findings] == [6]


def test_no_force_was_taken_out_where_the_answer_defines_its_right_sides_below() -> None:
    answer = "\n".join(NAMED.format(left="(A - S^2/B)", right="P - S Q").split("\n")[i] for i in (0, 3, 4, 1, 2, 5, 6))
    verdict = cart().check(answer)
    assert not any("unknown force" in str(n) for n in verdict.notes) and not verdict.right
    assert cart().check(answer.replace("P - S Q", "P - S Q/B")).right
    told = [str(m.what) for m in verdict.mistakes]
    assert told and "-Q*S should be -Q*cos(phi)/l" in told[0], told
