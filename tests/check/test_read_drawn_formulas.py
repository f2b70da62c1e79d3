"""Formulas that programs draw over several lines: SymPy's and Maxima's, cut into pieces or whole.

Oracle: SymPy draws the equations of the cart with a pole and of the pendulum, of which one has a wrong twin; the drawn
ones by hand are copies of what Maxima prints.
"""

from contextlib import suppress
from typing import Any

import pytest
import sympy as sp
from drawn_carts import F, J, M, b, cart, g, l, m, t, theta, x

from built_in import derivation
from lagrangian import ParseError
from lagrangian.check.reading.drawn.layout import LayoutError, in_line

L = sp.Symbol("L")


def drawn(thing: Any, wide: bool = True) -> str:
    """What SymPy's pprint shows, whole or in pieces as in a window of 80 columns."""
    return sp.pretty(thing, use_unicode=True, wrap_line=not wide, num_columns=80)


def right(written: str, name: str = "cart-pole") -> bool:
    """Whether an answer is judged right."""
    return derivation(name).check(written, hint=0).right


@pytest.mark.sampled(8)
@pytest.mark.parametrize("wide", [True, False])
@pytest.mark.parametrize(
    "form",
    ["equations", "names", "matrix", "list", "fractions", pytest.param("solution", marks=pytest.mark.slow), "said"],
)
def test_what_sympy_draws_is_read(form: str, wide: bool) -> None:
    def answer(sign: int) -> str:
        first, second = cart(sign)
        if form == "equations":
            return f"{drawn(sp.Eq(first + F, F), wide)}\n\n{drawn(sp.Eq(second, 0), wide)}"
        if form == "names":  # both begin with a minus, which is no bullet
            weight = sign * m * g * l * sp.sin(theta)
            shown = [drawn(sp.Eq(-first - F, -F), wide), drawn(sp.Eq(-second - weight, -weight), wide)]
            return "\n\n".join(f"In [{k}]: eq{k}\nOut[{k}]: \n{each}" for k, each in enumerate(shown))
        if form == "matrix":
            return f"In [3]: LM.eom\nOut[3]:\n{drawn(sp.Matrix([first, second]), wide)}"
        if form == "list":
            return f">>> pprint([e1, e2])\n{drawn([first, second], wide)}"
        if form == "fractions":
            rest = (second / (J + m * l**2)).expand() - theta.diff(t, 2)
            solved = sp.factor_terms(rest).subs(theta.diff(t, 2), 0)
            assert sp.simplify(second / (J + m * l**2) - theta.diff(t, 2) - solved) == 0
            return f"{drawn(sp.Eq(first, 0), wide)}\n\n{drawn(sp.Eq(theta.diff(t, 2), sp.simplify(-solved)), wide)}"
        if form == "solution":
            found = sp.solve([first, second], [x.diff(t, 2), theta.diff(t, 2)])
            return f"sol = solve([e1, e2], [xdd, thetadd])\n{drawn(sp.factor(found), wide)}"
        return f"The first equation is:\n{drawn(sp.Eq(first, 0), wide)}\n\n(2)\n\n{drawn(sp.Eq(0, second), wide)}"

    assert right(answer(1))
    assert not right(answer(-1))


def test_what_a_loop_shows_is_no_part_of_it() -> None:
    shown = "\n".join(drawn(sp.Eq(each, 0)) for each in cart(1))
    assert right(f"In [9]: for e in (e1, e2):\n   ...:     pprint(Eq(e, 0))\n{shown}")


@pytest.mark.parametrize("wide", [True, False])
def test_roots_and_nested_fractions_are_put_on_one_line(wide: bool) -> None:
    length = sp.sqrt(x**2 + l**2)
    made = in_line(drawn(sp.Eq(m * x.diff(t, 2) / 2, -M * (1 - l / length) * x / (1 + b / J)), True).split("\n"))
    assert made.replace(" ", "").replace("⋅", "*").startswith("((m*d^2/dt^2(x(t)))/(2))=")
    assert "sqrt(l^2 + x^2(t))" in made


MAXIMA = """
(%i4) eom;
                2
           2   d                    d
(%o4)     L  m --- (theta) + b      -- (theta) + L g m sin(theta) = 0
                 2                  dt
               dt
"""
QUOTIENT = """
  2
 d                 b theta' + L g m sin(theta)
 --- (theta)  =  - ---------------------------
   2                           2
 dt                           L  m
"""


LEIBNIZ = """
      2
   2 d θ     dθ
m⋅L ⋅─── + b⋅── + L g m sin(θ) = 0
       2     dt
     dt
"""


@pytest.mark.parametrize("shown", [MAXIMA, QUOTIENT, LEIBNIZ])
def test_what_maxima_draws_is_read(shown: str) -> None:
    assert right(shown, "pendulum")
    assert not right(shown.replace("L g m", "L L m"), "pendulum")


@pytest.mark.parametrize(
    "lines",
    [
        ["  2", "m  + x", "y"],
        ["x = ──────", "      2   "],
        ["    ⎛ a", "x = ⎝ b ⎞"],
        ["x = ⎛  ⎞", "    ⎝  ⎠"],
        ["  a     2", "x = ───   ", "  b  "],
        ["⎛" * 40, "⎝" * 40],
        ["─", "─", "─"],
        ["    d      ", "m x ──(x)", "      2    ", "    dt     "],
    ],
)
def test_signs_that_do_not_fit_together_are_never_guessed(lines: list[str]) -> None:
    with pytest.raises(LayoutError):
        in_line(lines)


def test_a_fraction_that_cannot_be_put_together_is_an_error_at_its_place() -> None:
    with pytest.raises(ParseError, match="drawn over several lines") as error:
        right(
            "m*L^2*theta'' + b*theta' = 0\n\n        m g L sin(theta)  x\nq = - ────────────────\n    2     m L^2",
            "pendulum",
        )
    assert error.value.place is not None
    assert error.value.place.line == 3


def test_what_goes_on_is_never_read_without_it() -> None:
    first = drawn(sp.Eq(m * L**2 * theta.diff(t, 2) + b * theta.diff(t), 0)).split("\n")
    rest = ["                2", "                ⎛", "+ g⋅m⋅L⋅sin(θ) ⎜x", "                ⎝", "    ⎠"]
    assert len(first) == len(rest)
    with pytest.raises(ParseError):
        right("\n".join(first) + "\n\n" + "\n".join(rest), "pendulum")


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    "text",
    [
        "x = ─ ⎛\n    b ⎝\n\n" * 800,
        "\n".join(["a" * 3_000, "x = " + "─" * 2_990, *["a" * 30] * 70]) + "\n\n",
        "⎛\n⎝\n\n" * 2_000,
    ],
)
def test_drawings_are_looked_at_up_to_a_bounded_size(text: str) -> None:
    with pytest.raises(ParseError):
        right(text, "pendulum")


def test_rules_under_headings_are_no_fractions() -> None:
    assert right("Equation\n────────\n\nm*L^2*theta'' + b*theta' + m*g*L*sin(theta) = 0", "pendulum")
    assert right("Equation\n────────\nm*L^2*theta'' + b*theta' + m*g*L*sin(theta) = 0", "pendulum")
    assert right("Equation\n--------\nm*L^2*theta'' + b*theta' + m*g*L*sin(theta) = 0", "pendulum")


SCRIPT = """e1 = expand(L.diff(x.diff(t)).diff(t) - L.diff(x)) + b*x.diff(t) - F
e2 = L.diff(theta.diff(t)).diff(t) - L.diff(theta)
{}
{}"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("shown", "between"),
    [
        ("print(pprint(Eq(e1, 0)))", "\n"),
        ("In [4]: pprint(Eq(simplify(e1), 0))", "\n\n"),
        ("pprint(e1 == 0)\n\n--- output ---", "\n"),
        (">>> eqs = LM.form_lagranges_equations()\n>>> for e in eqs: pprint(e, use_unicode=True); print()", "\n\n"),
    ],
)
@pytest.mark.parametrize("sign", [1, -1])
def test_what_shows_an_equation_by_its_name_and_rules_with_words_are_no_part_of_a_drawing(
    shown: str, between: str, sign: int
) -> None:
    pieces = [sp.pretty(sp.Eq(x, 0), use_unicode=True, num_columns=60) for x in cart(sign)]
    written = SCRIPT.format(shown, between.join(pieces))
    assert "↪" in written
    assert derivation("cart-pole").check(written, hint=0).right == (sign == 1)


TYPED = """        {over}
x'' = {bar}
        {under}

theta'' = ((M + m)*m*g*l*sin(theta) - m*l*cos(theta)*(F - b*x' + m*l*theta'^2*sin(theta)))/D
D = (M + m)*(J + m*l^2) - m^2*l^2*cos(theta)^2
"""
OVER = "(J + m*l^2)*(F - b*x' + m*l*theta'^2*sin(theta)) - m^2*g*l^2*sin(theta)*cos(theta)"


@pytest.mark.sampled(6)
@pytest.mark.parametrize("bar", ["-" * 20, "-" * len(OVER), "─" * 90])
@pytest.mark.parametrize("under", [" " * 12 + "D", "     (M + m)*(J + m*l^2) - m^2*l^2*cos(theta)^2"])
def test_a_fraction_over_three_lines_need_not_be_as_wide_as_its_bar(bar: str, under: str) -> None:
    assert right(TYPED.format(over=OVER, bar=bar, under=under))
    for over in (OVER.replace(" - m^2*g", " + m^2*g"), OVER.replace("- b*x'", "+ b*x'"), OVER.replace("F ", "2*F ")):
        assert over != OVER and not right(TYPED.format(over=over, bar=bar, under=under))


@pytest.mark.parametrize(
    ("over", "under"),
    [
        (OVER + ")", " " * 12 + "D"),
        (OVER, " " * 12 + "D)"),
        (OVER, " " * 30 + "D"),
        ("a = " + OVER, " " * 12 + "D"),
    ],
)
def test_three_lines_that_are_no_fraction_are_not_taken_for_a_right_one(over: str, under: str) -> None:
    with suppress(ParseError):
        assert not right(TYPED.format(over=over, bar="-" * 20, under=under))


@pytest.mark.parametrize("above", ["Solved for ẍ:", "for θ'':", ""])
def test_a_fraction_right_below_words_with_a_colon_is_read(above: str) -> None:
    """The words are no part of it: "for θ'':", and the three lines of a fraction."""
    assert right(f"{above}\n" + TYPED.format(over=OVER, bar="-" * 20, under=" " * 12 + "D"))
