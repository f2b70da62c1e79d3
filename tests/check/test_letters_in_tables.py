r"""Letters of an answer's own that tables set against those of the sheet: "mine | yours", "(sheet: $\theta$)".

Oracle: by hand, two carts on a spring k and a damper c,

    m1 ẍ + k (x − y) + c (ẋ − ẏ) = F,   m2 ÿ + k (y − x) + c (ẏ − ẋ) = 0

and a pendulum on a cart.
"""

from __future__ import annotations

import re

import pytest
from small_systems import cart
from test_letters_declared_in_words import carts

from lagrangian import ParseError
from lagrangian.derivation import Derivation

HEADS = [
    "| mine | yours | meaning |",
    "| my letter | your letter | |",
    "| hier | Aufgabenblatt | Bedeutung |",
    "| Symbol | sheet | what |",
    "mine | yours | meaning",
]
ROWS = "| $u$ | $x$ | first cart |\n| $w$ | $y$ | second cart |\n| D | k | spring |\n| `d` | `c` | damper |\n"
CARTS = "m1 u'' + D (u - w) + d (u' - w') = F\nm2 w'' + D (w - u) + d (w' - u') = 0"


def right(system: Derivation, answer: str) -> bool:
    """Whether an answer is judged right; one that is refused is not."""
    try:
        return system.check(answer, hint=0).right
    except ParseError:
        return False


@pytest.mark.parametrize("head", HEADS)
def test_a_table_of_both_letters(head: str) -> None:
    table = f"{head}\n|---|:---:|---|\n{ROWS}\n"
    table = table if head.startswith("|") else re.sub(r"(?m)^\|[ ]?|[ ]?\|$", "", table)
    assert right(carts(), table + CARTS)
    assert not right(carts(), table + CARTS.replace("+ D (w - u)", "- D (w - u)"))
    assert not right(carts(), CARTS)


def test_the_columns_may_be_turned() -> None:
    table = "| sheet | me (I write) |\n|---|---|\n| x | u |\n| y | w |\n| k | D |\n| c | d |\n\n"
    assert right(carts(), table + CARTS)
    assert not right(carts(), table + CARTS.replace("d (u' - w')", "d (u' + w')"))


def test_letters_may_cross() -> None:
    """What the system calls c is k, and its k is c; its m1 is M, and its m2 is m1."""
    table = "| mine | yours |\n|--|--|\n| c | k |\n| k | c |\n| M | m1 |\n| m1 | m2 |\n\n"
    crossed = "M x'' + c (x - y) + k (x' - y') = F\nm1 y'' + c (y - x) + k (y' - x') = 0"
    plain = "m1 x'' + k (x - y) + c (x' - y') = F\nm2 y'' + k (y - x) + c (y' - x') = 0"
    assert right(carts(), table + crossed)
    assert right(carts(), plain) and not right(carts(), table + plain) and not right(carts(), crossed)


def test_rows_of_the_same_letters_and_of_none() -> None:
    table = f"| mine | yours | |\n|---|---|---|\n| m1 | m1 | mass |\n{ROWS}| | F | as given |\n\n"
    assert right(carts(), table + CARTS)


TABULAR = r"""
\newcommand{\q}{\psi}
\begin{tabular}{lll}
\hline
mine & yours & meaning \\ \hline
$\q$ & $\varphi$ & pendulum \\
$m_0$ & $M$ & cart \\
$m_1$ & $m$ & bob \\
\end{tabular}
"""
NOTED = r"""
\newcommand{\q}{\psi}
\newcommand{\Th}{\Theta_0}
\begin{tabular}{ll}
$\q$ & pendulum (sheet: $\varphi$)\\
$m_0$, $m_1$ & cart and bob (sheet: $M$, $m$)\\
$\Th$ & $= m_1 l^2$
\end{tabular}
"""
CART = r"""
\[ (m_0 + m_1)\ddot x + m_1 l(\ddot\q\cos\q - \dot\q^2\sin\q) + k x = 0 \]
\[ INERTIA\ddot\q + m_1 l\ddot x\cos\q + m_1 g l\sin\q = 0 \]
"""


@pytest.mark.parametrize(("table", "inertia"), [(TABULAR, "m_1 l^2"), (NOTED, "m_1 l^2"), (NOTED, r"\Th")])
def test_a_table_of_latex_with_macros(table: str, inertia: str) -> None:
    answer = table + CART.replace("INERTIA", inertia)
    assert right(cart(), answer)
    assert not right(cart(), answer.replace(r"+ m_1 g l\sin", r"- m_1 g l\sin"))
    assert not right(cart(), table + CART.replace("INERTIA", f"2 {inertia}"))


def test_the_value_of_a_name_in_a_table_is_judged() -> None:
    wrong = NOTED.replace("= m_1 l^2", "= 2 m_1 l^2")
    assert not right(cart(), wrong + CART.replace("INERTIA", r"\Th"))


def test_letters_of_the_sheet_in_brackets_in_a_list() -> None:
    said = "- u, w: the two carts (sheet: x, y)\n- D: spring (sheet: k)\n- d: damper (sheet: c)\n\n"
    assert right(carts(), said + CARTS)
    assert not right(carts(), said + CARTS.replace("= 0", "= F"))


VALUES = [
    "| my letter | meaning |\n|---|---|\n| `e` | `x - y`, stretch of the spring |\n| `w` | x' - y', its rate |",
    "| letter | what |\n|---|---|\n| e | stretch of the spring: x - y |\n| w | its rate (x' - y') |\n| F | pulls |",
    "| symbol | value | what it is |\n|:--|:-:|---|\n| e | x - y | stretch |\n| w | x' - y' | rate of the stretch |",
    "| Zeichen | Bedeutung |\n|---|---|\n| **e** | Dehnung, x - y |\n| w | x' - y' |",
]


@pytest.mark.sampled(4)
@pytest.mark.parametrize("table", VALUES)
def test_a_table_of_own_letters_with_values_and_words(table: str) -> None:
    equations = "\n\nm1 x'' + k e + c w = F\n\nm2 y'' - k e - c w = 0"
    assert right(carts(), table + equations)
    assert not right(carts(), table.replace("x - y", "x + y") + equations)
    assert not right(carts(), table.replace("x' - y'", "y' - x'") + equations)


def test_units_in_a_table_are_no_values() -> None:
    table = "| symbol | unit | meaning |\n|---|---|---|\n| e | m | stretch of the spring |\n\n"
    assert not right(carts(), table + "m1 x'' + k e + c (x' - y') = F\n\nm2 y'' - k e - c (x' - y') = 0")
