"""Lines that cannot be read decide nothing where right equations of all coordinates stand beside them.

Oracle: the equations of the cart with a pole. The same lines beside a wrong or a missing equation, and equations that
cannot be read behind the last one that can, are errors at their place.
"""

from __future__ import annotations

import pytest

from built_in import derivation
from lagrangian import ParseError
from student_answers import CART, POLE, right

ASIDE = [
    "Ansatz: x'' ) = 2 theta''",
    "sol = solve({eq1, eq2}, {a(x, t, t)}):  x'' ]",
    "horizontal: x'' 2 F = ) theta''",
]


@pytest.mark.parametrize("line", ASIDE)
def test_a_line_that_cannot_be_read_does_not_stop_a_right_answer(line: str) -> None:
    verdict = derivation("cart-pole").check(f"{CART}\n{line}\n{POLE}")
    assert verdict.right
    assert any("Line 2 could not be read (" in str(note) for note in verdict.notes)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("line", ASIDE)
@pytest.mark.parametrize("rest", [f"{POLE.replace('- m g', '+ m g')}", "", f"{POLE}\n{CART.replace('b x', '2 b x')}"])
def test_a_line_that_cannot_be_read_is_an_error_beside_what_is_not_right(line: str, rest: str) -> None:
    with pytest.raises(ParseError) as error:
        derivation("cart-pole").check(f"{CART}\n{line}\n{rest}")
    assert error.value.place is not None
    assert error.value.place.line == 2


@pytest.mark.parametrize("line", ["x'' ) = F/M", "x_pp = ) F/M", r"[a ; b)) = \ddot x"])
def test_what_may_be_the_result_must_be_read(line: str) -> None:
    assert not right(f"{CART}\n{POLE}\n{line}")


def test_all_errors_of_an_answer_that_is_not_right_are_told_at_once() -> None:
    with pytest.raises(ParseError) as error:
        derivation("cart-pole").check(f"{ASIDE[0]}\n{CART}\n{ASIDE[2]}\n2 {POLE[:-1]}g")
    assert len(error.value.others) == 1


def test_a_vector_with_its_square_behind_it_does_not_stop_a_right_answer() -> None:
    """A vector times a number cannot be a number: one line with two statements is told as not read."""
    said = "r = (x + l sin θ, −l cos θ)\nṙ = (ẋ + l θ̇ cos θ, l θ̇ sin θ)    |ṙ|² = ẋ² + l² θ̇²"
    assert derivation("cart-pole").check(f"{said}\n{CART}\n{POLE}", hint=0).right
