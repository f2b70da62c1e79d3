"""Answers that are wrong, broken or meant to harm: a message with a place, with bounded effort, and nothing is run."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

import built_in
from effort import at_most
from lagrangian.check.reading import Answer, parse_answer
from lagrangian.errors import ParseError
from size import rest_slow, sized

PENDULUM = built_in.system("pendulum").model
CARTS = built_in.system("lecture-3b").model

DOUBLING = "a0 = x1\n" + "\n".join(f"a{i + 1} = sin(a{i})*cos(a{i}) + a{i}" for i in range(60)) + "\na60 + x1'' = 0"
HOSTILE = {
    "code": "__import__('os').system('touch /tmp/owned') = 0",
    "lambda": "(lambda: 0)() = 0",
    "attribute": "x1.__class__.__mro__ = 0",
    "tower": "9**9**9**9*x1'' = 0",
    "tower in LaTeX": r"9^{9^{9^{9}}} \ddot x_1 = 0",
    "big number": "9" * 5000 + "*x1'' = 0",
    "long": "x1'' + " * 8_500 + "x1 = 0",
    "too long": "x1'' + " * 200_000 + "x1 = 0",
    "megabytes of brackets": "(" * 1_000_000,
    "deep": "(" * 2000 + "x1" + ")" * 2000 + " = 0",
    "deep braces": r"\frac{" * 3000 + "1" + "}{2}" * 3000,
    "deep signs": "-" * 20_000 + "x1 = 0",
    "deep dots": r"\dot{" * 3000 + "x" + "}" * 3000,
    "deep subscripts": "x_{" * 3000 + "1" + "}" * 3000,
    "deep accents": r"\dot" * 5000 + "x",
    "deep matrices": "[" * 3000,
    "deep tuples": "x = (" * 2000 + "(" * 3000,
    "a row that nothing closes": r"\[(" + r"\alpha " * 5000,
    "deep differentials": r"\frac{d}{dt}" * 3000 + "x",
    "deep exponents": "x^-" * 3000 + "1 \\quad",
    "boxes": r"\boxed{" * 5000,
    "texts": r"\text{" * 5000,
    "environments": r"\begin{align}" * 3000,
    "dollars": "$" * 20_001,
    "doubling definitions": DOUBLING,
    "doubling powers": "a0 = x1 + 1\n" + "\n".join(f"a{i + 1} = a{i}*(a{i} + x1)" for i in range(60)),
    "definitions of themselves": "a = b\nb = a\na + x1'' = 0",
    "a chain of definitions upward": "\n".join(f"a{i} = a{i + 1} + 1" for i in range(400)) + "\na400 = x1",
    "many statements": "x1 = 0\n" * 10_000,
    "many names": " + ".join(f"n{i}" for i in range(7000)) + " = 0",
    "nested functions": "sin(" * 49 + "x1" + ")" * 49 + " = 0",
    "derivative of nested functions": "d/dt(" + "sin(x1*" * 45 + "x1" + ")" * 45 + ") = 0",
    "derivative of a product": "d^2/dt^2(" + "*".join(f"sin(x1 + {i})" for i in range(300)) + ") = 0",
    "expanding powers": "(x1 + x2r)^100*(x1 - 2*x2r)^100 = 0",
    "a large matrix": "[" + "; ".join(", ".join(["x1"] * 60) for _ in range(60)) + "]*[1] = 0",
    "matrix powers": "M = [x1, 1; 1, x2r]\n" + "\n".join(f"M{i} = M*M" for i in range(20)) + "\nM^100 = 0",
    "matrix doubling": "M0 = [x1, 1; 1, x2r]\n" + "\n".join(f"M{i + 1} = M{i}*M{i}" for i in range(40)),
    "roots": " + ".join(f"sqrt({i})" for i in range(2, 400)) + " = 0",
    "half a line of words": "and so on and on" * 3000,
    "labels": "a:" * 20_000,
    "equals": "=" * 50_000,
    "commas": ",;" * 30_000,
    "backslashes": "\\" * 50_000,
    "combining dots": "x" + "\u0308" * 50_000 + " = 0",
    "primes": "x1" + "'" * 50_000 + " = 0",
    "subscripts": "x" + "₁" * 50_000 + " = 0",
    "spaces": "x1 =" + " " * 50_000 + "0",
    "spaces in LaTeX": "\\ddot x_1 =" + "\\quad " * 15_000 + "0",
    "ampersands": "\\begin{align}" + "&" * 50_000 + "\\end{align}",
    "open numbers": "(1)\\quad " * 9000,
    "nul": "x1\x00'' = 0",
    "surrogate": "x1 = \ud800",
    "control": "x1'' = 0\x1b[31m",
    "bidirectional": "x1\u202e'' = 0",
    "look-alike": "х1'' = 0",
    "empty": "",
    "blank": "  \n\t\n",
    "only comments": "# nothing\n% at all",
    "only words": "I do not know",
}


CALLS = 10_000_000
"""Of Python functions, that any one of these takes at most."""


LONGEST = {"many names", "derivative of nested functions", "long", "combining dots", "labels", "subscripts"}
LONGEST |= {"a chain of definitions upward"}


@pytest.mark.thinned(8)
@pytest.mark.sampled(48)
@pytest.mark.parametrize("name", rest_slow(HOSTILE, set(HOSTILE) - LONGEST))
def test_hostile_answers_take_bounded_effort(name):
    try:
        with at_most(CALLS):
            answer = parse_answer(HOSTILE[name], CARTS, name="answer.txt")
    except ParseError as error:
        assert error.place is not None and error.what
        assert len(str(error)) < 2000
    else:
        assert isinstance(answer, Answer)


REFUSED = [
    ("m*L^2*θ'' + b*theta' + foo bar*sin(θ) = 0", "E701", 1, 28, "*"),
    ("2 3 = x", "E701", 1, 3, "2*3"),
    ("x1 = 0\nm*(g + L = 0", "E701", 2, 3, "closed"),
    ("m*theta'' + = 0", "E701", 1, 13, "one side"),
    ("= 3", "E701", 1, 1, "one side"),
    ("help", "E701", 1, 1, "no equation"),
    ("m*θ''' = 0", "E701", 1, 3, "3 dots"),
    ("sin = 3", "E701", 1, 1, "argument"),
    ("sin^-1(θ) = 3", "E701", 1, 1, "asin"),
    ("m*theta'' = 1, 5*b", "E701", 1, 14, "comma"),
    ("L' = 0", "E701", 1, 1, "does not change"),
    ("m*theta'' = sinn(theta)", "E402", 1, 13, "sin"),
    ("m/0 = theta''", "E705", 1, 3, "zero"),
    ("[m, L, 1]*[theta''; theta'] = 0 + 3", "E701", 1, 11, "×"),
    ("[m, L]*[theta''; theta'] = 0 + 3", "E701", 1, 28, "equals a number"),
    ("[m, L; b]*theta'' = 0", "E701", 1, 1, "entries"),
    ("d/dt = 3", "E701", 1, 6, "one side"),
    ("diff(theta, t, 3) = 0", "E701", 1, 16, "second"),
    ("∂m/∂theta' = 0", "E701", 1, 1, ""),
    (r"\frac{m}{", "E701", 1, 9, "closed"),
    (r"m\ddot{\theta = 0", "E701", 1, 7, "closed"),
    (r"\input{/etc/passwd} = 0", "E701", 1, 1, "command"),
    (r"\sin = 0 \quad", "E701", 1, 6, "argument"),
    (r"\ddot\theta^2^3 = 0", "E701", 1, 14, "exponents"),
    (r"\begin{cases}1\end{cases} = \theta", "E701", 1, 1, "environment"),
    (r"m 2 3 \ddot\theta = 0", "E701", 1, 5, "next to each other"),
    (r"m\theta_{/} = 0", "E701", 1, 8, "subscript"),
    (r"\frac{\partial m}{\partial \dot\theta} = 0", "E701", 1, 1, "energy"),
    (r"\begin{bmatrix}1&2\\3\end{bmatrix}\ddot\theta = 0", "E701", 1, 1, "entries"),
]


@pytest.mark.parametrize(("text", "code", "line", "column", "word"), REFUSED)
def test_what_cannot_be_read_is_said_with_its_place(text, code, line, column, word):
    with pytest.raises(ParseError) as caught:
        parse_answer(text, PENDULUM, name="mine.txt")
    error = caught.value
    assert (error.code, error.place.line, error.place.column) == (code, line, column), str(error)
    assert error.place.file == "mine.txt"
    assert word in f"{error.what} {error.fix}"


PIECES = [
    "x1", "x2r", "x1''", "x2r'", "m1", "k", "F", "t", "(", ")", "[", "]", "{", "}", "+", "-", "*", "/", "^", "**", "=",
    "2", "0.5", "½", "²", "'", "''", ",", ";", "\n", " ", "  ", ":", "(1)", "T", "T*", "V", "L", "Xi_1", "sin", "sqrt",
    "d/dt", "d2x1/dt2", "∂L/∂x1'", "diff(", "\\frac", "\\dot", "\\ddot", "\\sin", "\\left(", "\\right)", "\\\\", "&",
    "\\begin{bmatrix}", "\\end{bmatrix}", "$", "\\[", "\\]", "\\text{and}", "\\cdot", "_", "_{1}", "^{2}", "\\partial",
    "\\theta", "\\Xi", "\\quad", "\\begin{align}", "\\end{align}", "%", "#", "so", "where", "h", "ẍ", "θ̈",
    "\\mathrm{d}", "\\boxed{", "\\delta", "\\sqrt", "|", "\\mathbf{M}",
]  # fmt: skip
VALID = [
    "(m1+m2)*x1'' + m2*x2r'' = 0\nm2*(x1'' + x2r'') + k*x2r = F",
    "T = m1*x1'^2/2 + m2*(x1'+x2r')^2/2\nV = k*x2r^2/2\nL = T - V\nd/dt(∂L/∂x1') - ∂L/∂x1 = Xi_1\nXi_2 = F",
    r"\begin{align}(m_1+m_2)\ddot x_1 + m_2\ddot{x}_{2r} &= 0\\ m_2\frac{d^2 x_1}{dt^2} + k x_{2r} &= F\end{align}",
    r"\begin{bmatrix}m_1 & m_2\\ 0 & m_2\end{bmatrix}\begin{bmatrix}\ddot x_1\\ \ddot x_{2r}\end{bmatrix} = 0",
]


def check_readable_or_said(text: str) -> None:
    try:
        answer = parse_answer(text, CARTS)
    except ParseError as error:
        assert error.place is not None and error.place.line is not None
        assert 1 <= error.place.line <= len(re.split(r"\r\n|[\n\r\x85\u2028\u2029]", text))  # all of these end a line
    else:
        assert all(line.place.line and line.rhs is not None for line in answer.lines)


@sized(400, 60)
@given(st.lists(st.sampled_from(PIECES), max_size=25).map("".join))
def test_any_row_of_pieces_is_read_or_refused_with_its_place(text):
    check_readable_or_said(text)


@sized(300, 40)
@given(st.sampled_from(VALID), st.data())
def test_any_change_of_a_good_answer_is_read_or_refused_with_its_place(text, data):
    for _ in range(data.draw(st.integers(1, 4))):
        at = data.draw(st.integers(0, len(text)))
        until = data.draw(st.integers(at, min(at + 6, len(text))))
        text = text[:at] + data.draw(st.sampled_from([*PIECES, ""])) + text[until:]
    check_readable_or_said(text)


@pytest.mark.slow
@sized(100, 8)
@given(st.text(max_size=60))
def test_any_text_is_read_or_refused_with_its_place(text):
    check_readable_or_said(text)
