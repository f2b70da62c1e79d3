"""A wrong answer with equations for some coordinates alone is told which equation it lacks.

Oracle: the crane has three coordinates; which of its equations an answer has is what was written here.
"""

from __future__ import annotations

import pytest

from built_in import derivation

CART = (
    "(M + m) x'' + m l'' sin theta + 2 m l' theta' cos theta + m l theta'' cos theta - m l theta'^2 sin theta"
    " + b x' = F"
)
TURN = "l theta'' + 2 l' theta' + x'' cos theta + g sin theta = 0"
ROPE = "m l'' + m x'' sin theta - m l theta'^2 - m g cos theta + Fh"
LACKS = "The equation of l is missing."


def told(*lines: str) -> list[str]:
    verdict = derivation("crane").check("\n".join(lines))
    assert not verdict.right
    return [str(note) for note in verdict.notes]


@pytest.mark.slow
@pytest.mark.parametrize("cart", [CART.replace("b x'", "2 b x'"), CART.replace("2 m l'", "m l'")])
def test_the_equation_that_a_wrong_answer_lacks_is_named(cart: str) -> None:
    assert LACKS in told(cart, TURN)


def test_nothing_is_said_to_be_missing_where_all_equations_are_or_one_was_not_judged() -> None:
    wrong = CART.replace("b x'", "2 b x'")
    assert LACKS not in told(wrong, TURN, f"{ROPE} = 0")
    assert LACKS not in told(wrong, TURN, f"{ROPE.replace('- m g cos theta ', '')} = 0")
    assert LACKS not in told(wrong, TURN, f"the rope: {ROPE}")
    assert LACKS not in told(wrong.replace(" = F", f" + {ROPE} = F"), TURN)
