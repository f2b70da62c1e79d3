"""Texts that are no expressions: what the message says and where its caret stands."""

import sys

import pytest
import sympy as sp
from hypothesis import example, given
from hypothesis import strategies as st
from sympy.physics.vector import dynamicsymbols

from effort import at_most
from lagrangian.errors import ParseError, Place
from lagrangian.read.expression import parse_expression
from size import sized

NAMES = "m g L L_a k E I N S beta gamma a b length"
SCOPE = {n: sp.Symbol(n) for n in NAMES.split()} | {n: dynamicsymbols(n) for n in ("theta1", "theta2", "x", "y")}
DEEP = "(" * 60 + "x" + ")" * 60

BAD = [
    # text, column, fragments of the message
    ("", 1, "empty", "E406"),
    ("   ", 1, "empty", "E406"),
    # products that are not written
    ("2x", 2, "must be written with *", "2*x"),
    ("2 x", 3, "must be written with *", "2*x"),
    ("a b", 3, "must be written with *", "a*b"),
    ("a*(x)(y)", 6, "must be written with *"),
    ("2(x + 1)", 2, "must be written with *"),
    ("a(b)", 1, "'a' is not a function", "a*("),
    ("½m", 2, "½*m"),
    ("x(t)", 1, "'x' is not a function", "function of time already"),
    ("sin x", 5, "argument of sin must be in parentheses", "sin(x)"),
    ("sin^2(x)", 6, "before the power", "sin(x)^2"),
    ("sin²(x)", 5, "before the power", "sin(x)^2"),
    ("0x10", 2, "must be written with *"),
    ("1_000", 2, "must be written with *"),
    # numbers
    ("1,5", 2, "cannot read '1,5' as a number", "1.5", "E406"),
    ("m*1,5", 4, "cannot read '1,5' as a number"),
    ("1 2", 3, "two numbers"),
    ("1.5.2", 4, "two numbers"),
    ("10 kg", 4, "value with a unit", "[parameters]"),
    ("1e999", 1, "too long", "E703"),
    ("1e-999", 1, "too long", "E703"),
    ("m + 1e99999999999", 5, "too long", "E703"),
    ("1" * 100, 1, "too long", "E703"),
    # brackets and ends
    ("(x^2", 1, "never closed"),
    ("m*(x + (y)", 3, "never closed"),
    ("x^2)", 4, "has no matching"),
    ("()", 2, "parentheses are empty"),
    ("x +", 4, "ends after '+'"),
    ("x ^", 4, "ends after '^'"),
    ("* x", 1, "starts with '*'"),
    ("x + * y", 5, "found '*' after '+'"),
    ("--x", 2, "found '-' after '-'", "-(-x)"),
    ("x // y", 4, "found '/' after '/'"),
    # what other languages write
    ("x.diff(t)", 2, "attribute access", "x'"),
    ("().__class__.__bases__", 2, "parentheses are empty"),
    ("x.__class__", 2, "attribute access"),
    ("__import__('os').system('true')", 12, "text in quotes", "E701"),
    ("__import__(x)", 1, "unknown function '__import__'"),
    ("eval(x)", 1, "unknown function 'eval'"),
    ("exec(x)", 1, "unknown function 'exec'"),
    ("open(x)", 1, "unknown function 'open'"),
    ("lambda x: x", 1, "lambda"),
    ("[x for x in y]", 1, "lists and indexing"),
    ("(x for x in y)", 4, "Python word 'for'"),
    ("x[0]", 2, "lists and indexing"),
    ("{x}", 1, "braces"),
    ("x_{1}", 3, "braces", "x_1"),
    ("\\theta", 1, "LaTeX"),
    ("$x$", 1, "LaTeX"),
    ("x if y else a", 3, "Python word 'if'"),
    ("import os", 1, "Python word 'import'"),
    ("f'{x}'", 3, "braces"),
    ("'os'", 1, "text in quotes"),
    ('"os"', 1, "text in quotes"),
    ("x = 1", 3, "assignment"),
    ("x := 1", 3, "assignments"),
    ("x == 1", 3, "outside a condition"),
    ("x < 1", 3, "outside a condition"),
    ("x and y", 3, "outside a condition"),
    ("not x", 1, "outside a condition"),
    ("x; y", 2, "several statements"),
    ("x # y", 3, "comment"),
    ("x % 2", 3, "remainders"),
    ("x!", 2, "factorials"),
    ("a @ b", 3, "matrix products"),
    ("|x|", 1, "abs(x)"),
    ("√x", 1, "sqrt(x)"),
    ("5°", 2, "30 deg"),
    ("x..y", 2, "found '.'"),
    ("x, y", 2, "','"),
    ("²", 1, "SUPERSCRIPT TWO"),
    ("x\0y", 2, "control character U+0000"),
    ("x 😀", 3, "U+1F600"),
    ('x"', 2, "x''"),
    ("(x + y)'", 8, "prime must follow a name"),
    # names
    ("lenght*a", 1, "unknown symbol 'lenght'", "Did you mean 'length'?", "E402"),
    ("a + tehta1", 5, "unknown symbol 'tehta1'", "Did you mean 'theta1'?"),
    ("α", 1, "unknown symbol 'α'", "known: "),
    ("a*х", 3, "unknown symbol", "CYRILLIC SMALL LETTER HA", "write 'x'"),
    ("а*b", 1, "CYRILLIC SMALL LETTER A", "write 'a' in Latin letters"),
    ("x_dot", 1, "unknown symbol 'x_dot'", "write x' for the rate of x"),
    ("thetaddot1", 1, "write theta1'' for the acceleration of theta1"),
    ("dx", 1, "write x' for the rate of x"),
    ("e^x", 1, "exp(x)"),
    ("x'''", 1, "3 dots or primes"),
    ("m'", 1, "does not change with time"),
    ("pi'", 1, "does not change with time"),
    ("sin", 1, "no argument in parentheses"),
    ("x" * 300, 1, "300 characters", "E703"),
    # functions
    ("foo(x)", 1, "unknown function 'foo'", "known: abs acos"),
    ("arcsin(x)", 1, "unknown function 'arcsin'", "write asin"),
    ("Sin(x)", 1, "Did you mean 'sin'?"),
    ("sin()", 1, "sin takes 1 argument (got 0)", "E704"),
    ("sin(1,5)", 1, "sin takes 1 argument (got 2)", "1.5"),
    ("atan2(x)", 1, "atan2 takes 2 arguments (got 1)"),
    ("atan(y, x)", 1, "write atan2(y, x)"),
    ("log(x, 10)", 1, "log(x)/log(10)"),
    ("max()", 1, "max takes 1 to 32 arguments (got 0)"),
    ("piecewise(x > 0, 1)", 1, "odd number of arguments", "otherwise"),
    ("piecewise(x, 1, 2)", 11, "value where a condition is expected"),
    ("piecewise(x > 0, x > 1, 2)", 18, "condition where a value is expected"),
    ("max(x > 0, 1)", 5, "condition where a value is expected"),
    ("piecewise(0 < x < 1, 1, 2)", 17, "comparison '<'"),
    # values that are not finite or not real
    ("1/0", 3, "division by zero", "E705"),
    ("x/(1 - 1)", 3, "division by zero"),
    ("x/0.0", 3, "division by zero"),
    ("0^-1", 1, "division by zero"),
    ("log(0)", 5, "logarithm of zero"),
    ("tan(pi/2)", 1, "not finite"),
    ("sqrt(-1)", 1, "not a real number"),
    ("(-8)^(1/3)", 1, "not a real number"),
    ("log(-2)", 1, "not a real number"),
    ("asin(2)", 1, "not a real number"),
    ("acosh(1/2)", 1, "not a real number"),
    # sizes
    ("9**9**9", 1, "exponent is too large", "E703"),
    ("9^9^9^9^9^9", 7, "too large"),
    ("x^1000000000", 1, "exponent is too large"),
    ("x^-101", 1, "exponent is too large"),
    ("x²³⁴", 1, "exponent is too large"),
    ("x⁹⁹⁹⁹⁹⁹⁹⁹⁹", 2, "9 digits"),
    ("2^(1/1000)", 1, "exponent is too large"),
    ("(x^60)^60", 1, "power is too large"),
    ("*".join(["1e300"] * 9), 25, "too large"),
    (DEEP, 51, "nested more than 50 deep"),
    ("m*" * 30_000 + "m", None, "60001 characters"),
]


CALLS = 10_000_000
"""Of Python functions, that any one of these takes at most."""


@pytest.mark.parametrize(
    ("text", "column", "fragments"), [(t, c, f) for t, c, *f in BAD], ids=[t[:25] for t, *_ in BAD]
)
def test_message_and_caret(text: str, column: int | None, fragments: list[str]) -> None:
    with pytest.raises(ParseError) as caught, at_most(CALLS):
        parse_expression(text, SCOPE, what="k of spring 's1'")
    message = str(caught.value)
    assert message.count("spring 's1'") == 1
    for fragment in fragments:
        assert fragment in message
    assert caught.value.fix
    if column is not None:
        assert caught.value.place is not None
        assert (caught.value.place.line, caught.value.place.column) == (1, column)


def test_place_in_a_file_is_kept() -> None:
    place = Place("arm.toml", 7, 6, 'k = "40*lenght"')
    with pytest.raises(ParseError) as caught:
        parse_expression("40*lenght", SCOPE, place=place, what="k of spring 's1'")
    assert str(caught.value) == (
        "arm.toml:7:9: [E402] k of spring 's1': unknown symbol 'lenght'\n"
        '7 | k = "40*lenght"\n'
        "  |         ^\n"
        "Fix: Did you mean 'length'?"
    )


def test_second_line_of_a_text_is_pointed_at() -> None:
    with pytest.raises(ParseError) as caught:
        parse_expression("m*x +\n  2y", SCOPE, place=Place("a.toml", 4, 1, "m*x +"))
    assert caught.value.place is not None
    assert (caught.value.place.line, caught.value.place.column, caught.value.place.text) == (5, 4, "  2y")


def test_ambiguous_name() -> None:
    with pytest.raises(ParseError, match="can mean 'La' or 'L_a'"):
        parse_expression("Lₐ_", {"La": sp.Symbol("La"), "L_a": sp.Symbol("L_a")})


@pytest.mark.parametrize("thing", [None, 3, b"x", ["x"], sp.Symbol("x")])
def test_only_text_is_read(thing: object) -> None:
    with pytest.raises(ParseError, match="must be text"):
        parse_expression(thing, SCOPE)  # type: ignore[arg-type]


def test_nothing_is_declared() -> None:
    with pytest.raises(ParseError, match="nothing is declared yet"):
        parse_expression("x", {})


def test_no_module_of_the_grammar_can_run_text() -> None:
    import pathlib

    from lagrangian import read

    for file in pathlib.Path(read.__file__).parent.glob("*.py"):
        for word in ("eval(", "exec(", "sympify(", "parse_expr(", "lambdify(", "S("):
            assert not any(w.endswith(word) and w in (word, "sp." + word) for w in file.read_text().split()), (
                file,
                word,
            )


@pytest.mark.thinned(3)
@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "text",
    [
        "(" * 1_000_000,
        "x" * 10_000_000,
        "-" * 40_000 + "x",
        "+".join("x" * 2_000),
        pytest.param("+".join("x" * 20_000), marks=pytest.mark.slow),
        "*".join("x" * 2_000),
        pytest.param("*".join("x" * 20_000), marks=pytest.mark.slow),
        "^".join("x" * 2_000),
        pytest.param("^".join("x" * 20_000), marks=pytest.mark.slow),
        "x" + "'" * 40_000,
        "x" + "\u0307" * 40_000,
        "²" * 40_000,
        "sin(" * 49 + "x" + ")" * 49,
        "sqrt(" * 49 + "x+1" + ")" * 49,
        "abs(" * 49 + "x+m" + ")" * 49,
        "max(" + ",".join(f"x*{i}+y" for i in range(32)) + ")",
        pytest.param("max(" * 45 + "x,y" + "".join(f",{i}*x)" for i in range(45)), marks=pytest.mark.slow),
        pytest.param(
            "piecewise(" + ",".join(f"x*m+{i} > y*{i},{i}" for i in range(300)) + ",0)", marks=pytest.mark.slow
        ),
        "piecewise(" + " and ".join(f"x > {i}*y" for i in range(500)) + ",1,0)",
        "abs(" + "+".join(f"{i}*m^{i % 9}*sin({i}*x)" for i in range(100)) + ")",
        pytest.param("abs(" + "+".join(f"{i}*m^{i % 9}*sin({i}*x)" for i in range(500)) + ")", marks=pytest.mark.slow),
        "sign(" + "*".join(f"(x+{i})" for i in range(500)) + ")",
        "(" + "+".join(f"a^{i}" for i in range(100)) + ")^100",
        "*".join(f"{n}^(1/{d})" for n in range(100_003, 100_100) for d in (3, 7, 97)),
        "+".join(f"1/{n}" for n in range(3, 600, 2)),
        pytest.param("+".join(f"1/{n}" for n in range(3, 3000, 2)), marks=pytest.mark.slow),
        "^".join(["2"] * 5000),
        "*".join(["9^99"] * 500),
        pytest.param("*".join(["9^99"] * 5000), marks=pytest.mark.slow),
        "cos(pi/" + "7" * 59 + ")",
        "sin(1e300)*cos(1e300*pi+x)",
        "log(" + "9" * 60 + ")^(1/99)",
    ],
    ids=lambda t: t[:12],
)
def test_hostile_texts_are_answered_with_bounded_effort(text: str) -> None:
    try:
        with at_most(CALLS):
            value = parse_expression(text, SCOPE)
    except ParseError as error:
        assert len(str(error)) < 1500
    else:
        assert isinstance(value, sp.Expr)


ALPHABET = list("xyma12.,()+-*/^'θ̇²½ ") + [
    "sin(",
    "max(",
    "piecewise(",
    "theta1",
    " and ",
    ">",
    "==",
    "\n",
    "[",
    "\\",
    "lambda ",
]


@sized(300, 60)
@example("x\u0307\u0308'")
@given(st.one_of(st.text(max_size=40), st.lists(st.sampled_from(ALPHABET), max_size=14).map("".join)))
def test_any_text_gives_an_expression_or_a_parse_error(text: str) -> None:
    depth = sys.getrecursionlimit()
    try:
        value = parse_expression(text, SCOPE)
        assert isinstance(value, sp.Expr)
        assert not value.has(sp.I, sp.zoo, sp.nan, sp.oo)
    except ParseError as error:
        place = error.place
        assert place is not None and place.line is not None and place.column is not None
        lines = text.split("\n")
        assert 1 <= place.line <= len(lines) and 1 <= place.column <= len(lines[place.line - 1]) + 1
        assert error.fix
    assert sys.getrecursionlimit() == depth
