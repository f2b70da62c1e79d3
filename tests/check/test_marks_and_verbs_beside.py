r"""Marks behind equations, axes in front of them and verbs in front of definitions say nothing of the system.

Oracle: the equations of a cart on a spring with a pendulum, and the same with another sign.
"""

from __future__ import annotations

import pytest
from small_systems import cart

from lagrangian.errors import ParseError

CART = r"(M+m)\ddot x+ml(\ddot\phi\cos\phi-\dot\phi^2\sin\phi)+kx=0"
BOB = r"l\ddot\phi+\ddot x\cos\phi+g\sin\phi=0"


def right(written: str) -> bool:
    """Whether an answer about the cart is right."""
    return cart().check(written, hint=0).right


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "mark",
    [
        r"\qquad\blacksquare",
        r"\quad\square",
        r"\;\checkmark",
        r"\hfill\qed",
        r",\quad\Box",
        r"~\qedhere",
        r"\quad ✓",
        r". ∎",
    ],
)
def test_a_mark_behind_an_equation_is_no_mathematics(mark: str) -> None:
    assert right(f"$${CART}$$\n$${BOB}{mark}$$")
    assert right(f"\\begin{{align}}\n{CART}{mark}\\\\\n\\boxed{{{BOB}}}{mark}\n\\end{{align}}")
    assert not right(f"$${CART.replace('+kx', '-kx')}$$\n$${BOB}{mark}$$")


@pytest.mark.parametrize("side", [r"\square", r"k\square x"])
def test_a_mark_in_the_place_of_a_side_or_a_factor_is_not_left_out(side: str) -> None:
    with pytest.raises(ParseError):
        right(f"$${CART}$$\n$${BOB[:-1]}{side}$$")


@pytest.mark.parametrize("labels", ["x':", "x'':", r"x^\prime:", r"x^{\prime}:", r"\xi':"])
def test_the_name_of_a_turned_axis_is_a_label(labels: str) -> None:
    written = f"\\begin{{align}}\n{labels}\\quad & {CART} \\label{{eq:x}}\\\\\ny':\\quad & {BOB}\n\\end{{align}}"
    assert right(f"{written}\nsee \\eqref{{eq:x}}.")
    assert not right(written.replace("+kx", "-kx"))


def test_a_name_below_a_brace_may_be_used_behind_another_name() -> None:
    cart_row = r"\underbrace{(M+m)}_{=:\,\mu}\ddot x+\underbrace{ml}_{s_1}\ddot\phi\cos\phi-\dot\phi^2s_1\sin\phi+kx=0"
    written = f"$${cart_row}$$\n" + r"$$ls_1\ddot\phi+s_1\ddot x\cos\phi+gs_1\sin\phi=0$$"
    assert right(written)
    assert not right(written.replace("^2s_1", "^2ls_1"))
    assert not right(written.replace("{ml}", "{mg}"))


X, P = "(M + m) x'' + m l (phi'' C - phi'^2 S) + k x = 0", "l phi'' + x'' C + g S = 0"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "said",
    [
        "Abbreviate C = cos phi and S = sin phi.",
        "Setze C = cos phi, S = sin phi.",
        "Bezeichne C = cos phi und S = sin phi.",
        "Denote C = cos phi, and define S = sin phi.",
        "1) Introduce C := cos phi; write S = sin phi.",
        "* Call C = cos phi\n* Put S = sin phi",
    ],
)
def test_a_verb_in_front_of_a_definition_is_no_factor(said: str) -> None:
    assert right(f"{said}\n{X}\n{P}")
    assert not right(f"{said}\n{X.replace('+ k', '- k')}\n{P}")
    assert not right(f"{said.replace('cos', 'sin')}\n{X}\n{P}")
