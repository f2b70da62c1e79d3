"""Marks and words beside an equation that may be factors: where only the equation without them is right, it is meant.

Oracle: the equations of the cart with a pole; each mark has twins with a wrong equation, which are not accepted.
"""

from __future__ import annotations

import pytest

from built_in import derivation
from lagrangian import ParseError
from student_answers import CART, POLE, right

MARKED = ["(x) {}", "x   {}", "2  {}", "{} N", "{}   x", "{} -- Newton for cart and pole", "{}  [cart, N]"]


@pytest.mark.sampled(8)
@pytest.mark.parametrize("mark", MARKED)
def test_a_mark_that_may_be_a_factor_is_left_out_where_only_that_is_right(mark: str) -> None:
    verdict = derivation("cart-pole").check(f"{mark.format(CART)}\n{POLE}")
    assert verdict.right
    assert any("was read without '" in str(note) for note in verdict.notes)
    assert not right(f"{mark.format(CART)}\n{POLE.replace('- m g', '+ m g')}")
    assert not right(f"{mark.format(CART.replace('+ b', '- b'))}\n{POLE}")


@pytest.mark.parametrize("row", ["(l) {}", "l   {}", "{} * x", "{} + lambda", "{} damping", "half {}", "{} (1 + x)"])
def test_what_changes_an_equation_is_no_mark(row: str) -> None:
    assert not right(f"{row.format(CART)}\n{POLE}")


def test_mistakes_are_named_in_lines_without_their_marks() -> None:
    verdict = derivation("cart-pole").check(
        f"(x) {CART}\n(theta)   {POLE.replace('- m g', '+ m g')}\nV = m g l cos theta"
    )
    assert [f.line.number for f in verdict.findings if not f.status.right] == [2]
    assert verdict.mistake is not None


def test_where_no_reading_is_right_the_error_is_that_of_the_likeliest() -> None:
    with pytest.raises(ParseError, match="matrix"):
        derivation("cart-pole").check(f"{CART}  [cart, N]\n{POLE.replace('- m g', '+ m g')}")
