"""What tests of students' answers share: the cart with a pole, whether an answer is right, or why not."""

from __future__ import annotations

from built_in import derivation
from lagrangian import ParseError

CART = "(M + m) x'' + m l theta'' cos theta - m l theta'^2 sin theta + b x' = F"
POLE = "(J + m l^2) theta'' + m l x'' cos theta - m g l sin theta = 0"


def right(written: str, name: str = "cart-pole") -> bool:
    """Whether an answer is judged right; one that cannot be read is not."""
    try:
        return derivation(name).check(written, hint=0).right
    except ParseError as error:
        assert error.place is not None
        return False


def told(name: str, answer: object) -> tuple[str, str | None, str]:
    """The name, the element and the words of the one mistake that is told."""
    verdict = derivation(name).check(answer)
    assert not verdict.right
    (mistake,) = verdict.mistakes
    return mistake.name, mistake.element, str(mistake.what)
