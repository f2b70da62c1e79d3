"""Right answers of imagined students are accepted whatever they look like, and wrong ones in the same clothes are not.

Oracle: the derived equations, which `Students` writes; a wrong answer lacks one term or has it with the other sign.
"""

from __future__ import annotations

from collections import Counter

import pytest
from students import Students

import size
from built_in import derivation
from lagrangian import ParseError

FEW = ("cart-pole", "two-disk-shaft", "elastic-pendulum")
MANY = (*FEW, "two-carts", "quarter-car", "wedge", "dc-motor", "bead-on-hoop", "atwood", "lecture-3b", "loudspeaker")


def told(name: str, count: int, seed: str, *, wrong: bool = False) -> Counter[str]:
    """What is said of some answers: right, not right, or that one cannot be read, with the place."""
    own = derivation(name)
    students, found = Students(own, seed), Counter[str]()
    for _ in range(count):
        answer = students.answer(students.spoiled() if wrong else None)
        try:
            right = own.check(answer, hint=0).right
        except ParseError as error:
            assert error.place is not None, answer
            found["unread"] += 1
            continue
        assert right is not wrong, f"{name}: {answer}\n{own.check(answer).to_text()}"
        found["wrong" if wrong else "right"] += 1
    return found


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", FEW)
def test_a_few_right_answers_in_random_clothes_are_accepted(name: str) -> None:
    assert told(name, 8, "few")["unread"] == 0


@pytest.mark.slow
def test_a_few_wrong_answers_in_random_clothes_are_not() -> None:
    assert told("two-disk-shaft", 6, "few", wrong=True)["wrong"] > 4


@pytest.mark.slow
def test_many_answers_in_random_clothes() -> None:
    many = 60 if size.EVERY else 25
    right = sum((told(name, many, "many") for name in MANY), Counter[str]())
    wrong = sum((told(name, many // 5, "many", wrong=True) for name in MANY), Counter[str]())
    assert right["unread"] <= 0.02 * right.total() and wrong["unread"] <= 0.05 * wrong.total()
