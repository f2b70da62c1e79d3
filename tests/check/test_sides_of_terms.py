"""Terms are told with the sign that they have on the side where they stand, and in the words of what was written.

Oracle: the equations of the cart with a pole, by hand.
"""

from __future__ import annotations

import pytest

from built_in import derivation

POLE = "(J + m l^2) theta'' + m l x'' cos(theta) - m g l sin(theta) = 0"


def report(answer: str) -> str:
    verdict = derivation("cart-pole").check(answer)
    assert not verdict.right
    return " ".join(verdict.to_text().split())


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
