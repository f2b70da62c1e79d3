"""The notation of LibreOffice's formula editor is read; so are t as an index and names of accelerations beside it.

Oracle: the equations of the cart with a pole.
"""

import pytest

from student_answers import CART, POLE, right

T = "T = {1 over 2} (M + m) dot x^2 + m l dot x dot %theta cos %theta + {1 over 2} (J + m l^2) dot %theta^2"
ROWS = [
    "(M + m) ddot x + m l ddot %theta cos %theta - m l dot %theta^2 sin %theta + b dot x = F newline",
    "(J + m l^2) ddot %theta + m l ddot x cos %theta - m g l sin %theta = 0",
]
COLUMN = "stack{F - b dot x + m l {dot %theta}^2 sin %theta # m g l sin %theta}"
MATRIX = "matrix{M + m # m l cos %theta ## m l cos %theta # J + m l^{2}}"
SOLVED = "\nnewline\n".join(
    [
        "ddot x = { F - b dot x - m l ddot %vartheta cos %vartheta + m l dot %vartheta^2 sin %vartheta } over {M + m}",
        "ddot %vartheta = {m l} over {J + m l^2} left ( g sin %vartheta - ddot x cos %vartheta right )",
    ]
)


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    "sheet",
    [
        "\n".join([T, *ROWS]),
        "\n".join(ROWS).replace("dot x", "dot{x}").replace("dot %theta", "dot{%theta}").replace("(", "left ("),
        f"left[ {MATRIX} right] left[ stack{{ddot x # ddot %theta}} right] = left[ {COLUMN} right]",
        SOLVED,
    ],
)
def test_formulas_of_the_editor_are_read(sheet: str) -> None:
    assert right(sheet)
    assert not right(
        sheet.replace("+ m l dot", "- m l dot").replace("- m l dot", "- 2 m l dot").replace("m g l", "m g")
    )
    assert not right(sheet.replace("sin ", "cos "))


def test_words_of_the_editor_are_words_elsewhere() -> None:
    assert right(f"The pole leans over to the {{right}}, dot by dot.\n{CART}\n{POLE}")
    assert not right(f"The pole leans over to the {{right}}.\n{CART}\n{POLE.replace('- m g', '+ m g')}")


INDEXED = """(M + m)*x_tt + m*l*u_tt*cos(u) - m*l*u_t^2*sin(u) + b*x_t = F
(J + m*l^2)*u_tt + m*l*x_tt*cos(u) - m*g*l*sin(u) = 0"""


@pytest.mark.sampled(3)
@pytest.mark.parametrize("said", ["u = theta", "x: cart, u = theta, dots: x_t, x_tt, u_t, u_tt", ""])
def test_t_is_an_index_of_an_own_coordinate(said: str) -> None:
    assert right(f"{said}\n{INDEXED}")
    assert not right(f"{said}\n{INDEXED.replace('- m*l*u_t^2', '+ m*l*u_t^2')}")
    assert not right(f"{said}\n{INDEXED.replace('u_tt*cos', 'u_t*cos')}")


NAMED = """x2 = (F - b x1 - m l p2 cos p + m l p1^2 sin p)/(M + m)
p2 = [m g l sin p - m l x2 cos p]/(J + m l^2)"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "said",
    [
        "I write x1 = dx/dt, x2 = d^2x/dt^2, p = theta, p1 = dtheta/dt, p2 = d^2theta/dt^2.",
        "x1 = x', x2 = x'', p = theta, p1 = p', p2 = p''",
        "x1 = x', x2 = dx1/dt, p = theta, p1 = dp/dt, p2 = dp1/dt",
    ],
)
def test_names_of_accelerations_that_need_each_other_are_those_of_the_legend(said: str) -> None:
    assert right(f"{said}\n{NAMED}")
    assert right(f"{NAMED}\nwith {said.removeprefix('I write ')}")
    assert not right(f"{said}\n{NAMED.replace('[m g', '[-m g')}")
    assert not right(f"{said}\n{NAMED.replace('p1^2 sin', 'p1 sin')}")
    assert not right(said)
