"""Numbers of equations in circles, and of equations that are subtracted, are no factors; and Spanish joins by "y"."""

from __future__ import annotations

import pytest

from built_in import derivation
from lagrangian import ParseError
from student_answers import CART, POLE, right


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    "written",
    [
        f"① {CART}\n② {POLE}",
        f"① {CART}\n② {POLE}\n\n①+② (M + m + m l cos theta) x'' + (J + m l^2 + m l cos theta) theta''"
        " - m l theta'^2 sin theta + b x' - m g l sin theta = F",
        f"(1) {CART}\n(2) {POLE}\n\n(1) + (2)   (M + m + m l cos theta) x'' + (J + m l^2 + m l cos theta) theta''"
        " - m l theta'^2 sin theta + b x' - m g l sin theta = F",
    ],
)
def test_numbers_in_front_of_equations_are_none_of_their_factors(written: str) -> None:
    assert right(written)
    assert not right(written.replace("+ b x'", "- b x'"))
    assert not right(written.replace("= F", "= 2 F"))


@pytest.mark.sampled(2)
@pytest.mark.parametrize("written", ["x'' = ② F", "T = ½ m x'^2 ⑵", "k ③ x'' = ٣ x", "x₍₂₎ ⅲ = ⓪"])
def test_other_signs_for_numbers_are_read_or_refused(written: str) -> None:
    try:
        assert not derivation("cart-pole").check(written, hint=0).right
    except ParseError as error:
        assert error.place is not None


def test_a_spanish_and_joins_two_definitions() -> None:
    said = "u = x' y w = theta' (velocidades)\n"
    rows = f"{CART}\n{POLE}".replace("b x'", "b u").replace("theta'^2", "w^2")
    assert right(said + rows)
    assert not right(said.replace("w = theta'", "w = 2 theta'") + rows)
