"""Letters of constants that an answer equates with coordinates and that have rates in it: (a = alpha, b = beta).

Oracle: by hand, two wheels with a shaft between them, of which a brake of the length a holds the first:

    J α̈ + k (α − β) + b a² α̇ = M,   I β̈ + k (β − α) = 0
"""

from functools import cache

import pytest

import lagrangian as lg
from lagrangian.check.verdict import Status

EQUATIONS = "J a'' + k (a - b) + BRAKE a' = M\nI b'' + k (b - a) = 0"
SAID = {
    "in brackets": "(a = alpha, b = beta)",
    "with a reason": "(a = alpha, b = beta; because of this I call the brake's constant B and its length q)",
    "a sentence": "Here a = alpha and b = beta.",
    "two lines": "a = alpha\nb = beta",
    "in words": "(a is alpha, b is beta)",
}


@cache
def wheels() -> lg.Derivation:
    """Two wheels on an elastic shaft."""
    s = lg.System("two wheels")
    alpha, beta = s.coordinates("alpha beta")
    J, I, k, b, a = s.parameters("J I k b a")
    s.kinetic(J * alpha.diff() ** 2 / 2, name="first")
    s.kinetic(I * beta.diff() ** 2 / 2, name="second")
    s.spring(k, deflection=alpha - beta)
    s.damper(b, deflection=a * alpha)
    s.torque(s.input("M"), on=alpha)
    return s.derive()


@pytest.mark.sampled(4)
@pytest.mark.parametrize("said", SAID)
@pytest.mark.parametrize("first", [True, False])
def test_they_are_the_coordinates(said: str, first: bool) -> None:
    def answer(brake: str, more: str = "") -> str:
        equations = EQUATIONS.replace("BRAKE", brake) + more
        return f"{SAID[said]}\n\n{equations}" if first else f"{equations}\n\n{SAID[said]}"

    verdict = wheels().check(answer("B q^2"))
    assert verdict.right
    assert any("a stands for alpha, b for beta" in str(x) for x in verdict.notes)
    assert not wheels().check(answer("b a^2")).right  # β α² α̇, as the answer says
    assert wheels().check(answer("B q^2", " + J a''")).status is Status.WRONG


def test_latex_too() -> None:
    said = r"With $a = \alpha$ and $b = \beta$, $B$ instead of $b$, $q$ instead of $a$." + "\n\n"
    said += r"$J\ddot a + k(a - b) + B q^2 \dot a = M$" + "\n\n" + r"$I\ddot b + k(b - a) = 0$"
    assert wheels().check(said).right
    assert wheels().check(said.replace("k(a - b)", "k(a + b)")).status is Status.WRONG


def test_without_rates_nothing_is_renamed() -> None:
    """a = alpha of an answer whose a is a constant is a statement, and no name."""
    verdict = wheels().check(
        "J alpha'' + k (alpha - beta) + b a^2 alpha' = M\nI beta'' + k (beta - alpha) = 0\na = alpha"
    )
    assert not any("stands for" in str(x) for x in verdict.notes)
