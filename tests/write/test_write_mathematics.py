"""How an expression reads: by eye against the textbook, and by a parser that knows nothing of the printer."""

from __future__ import annotations

import math
import re
import unicodedata
from typing import ClassVar

import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from lagrangian.model import Builder, Particle, time
from lagrangian.write.breaking import break_lines
from lagrangian.write.expression import Expressions
from lagrangian.write.expression_tree import Addition, Grid, Letter, Number, Power, Quotient, Tagged, Times, tokens
from lagrangian.write.html_page import _terms
from lagrangian.write.lines import lines, measure, set_columns
from lagrangian.write.mathml import mathml
from lagrangian.write.names import letters
from lagrangian.write.tex import PAGE, WEB
from lagrangian.write.unicode_math import columns, join, unicode
from size import sized


def _model():
    builder = Builder("x")
    for name in ["theta1", "theta2", "x1", "x2r", "x"]:
        builder.coordinate(name)
    parameters = "m m1 m2 M L_m L_a L_b L_k L_0 g k b l1 l2 theta_dot_ref lambda_ beta m_cart pos L I_zz"
    for name in parameters.split():
        builder.parameter(name)
    builder.input("tau")
    builder.input("F")
    builder.add(Particle(mass=builder.lookup("m"), at=builder.point(None, (builder.lookup("x"), 0))))
    return builder.model()


MODEL = _model()
WRITE = Expressions(MODEL)
S = MODEL.symbols


def d(symbol, order=1):
    return sp.diff(symbol, (time, order))


th1, th2, x1, x2r, x = (S[n] for n in ["theta1", "theta2", "x1", "x2r", "x"])
m, m1, m2, M, g, k, L = (S[n] for n in ["m", "m1", "m2", "M", "g", "k", "L"])

TEXTBOOK = [
    (S["L_m"] ** 2 * m * d(th1, 2), "m L_m² θ̈₁", r"m L_{m}^{2} \ddot{\theta}_{1}"),
    (m * g * S["L_m"] * sp.sin(th1), "m g L_m sin θ₁", r"m g L_{m} \sin \theta_{1}"),
    (k * S["L_k"] ** 2 * th1, "k L_k² θ₁", r"k L_{k}^{2} \theta_{1}"),
    (
        (m1 + m2) * d(x1, 2) + m2 * d(x2r, 2),
        "(m₁ + m₂) ẍ₁ + m₂ ẍ_2r",
        r"(m_{1} + m_{2}) \ddot{x}_{1} + m_{2} \ddot{x}_{2r}",
    ),
    (k * (x1 - x2r), "k (x₁ − x_2r)", r"k (x_{1} - x_{2r})"),
    (-k * (x1 - x2r), "−k (x₁ − x_2r)", r"-k (x_{1} - x_{2r})"),
    (-x1 + x2r, "x_2r − x₁", r"x_{2r} - x_{1}"),
    (
        m * S["l1"] * S["l2"] * d(th2, 2) * sp.cos(th1 - th2),
        "m l₁ l₂ θ̈₂ cos(θ₁ − θ₂)",
        r"m l_{1} l_{2} \ddot{\theta}_{2} \cos(\theta_{1} - \theta_{2})",
    ),
    (S["L_a"] ** 2 * (m1 + m2) * d(th1, 2), "(m₁ + m₂) L_a² θ̈₁", r"(m_{1} + m_{2}) L_{a}^{2} \ddot{\theta}_{1}"),
    (m * d(x) ** 2 / 2, "½ m ẋ²", r"\tfrac{1}{2} m \dot{x}^{2}"),
    (m * sp.sin(th1) ** 2, "m sin²θ₁", r"m \sin^{2} \theta_{1}"),
    (sp.sin(2 * th1), "sin 2θ₁", r"\sin 2 \theta_{1}"),
    ((M + m * sp.sin(th1) ** 2) * d(x, 2), "(M + m sin²θ₁) ẍ", r"(M + m \sin^{2} \theta_{1}) \ddot{x}"),
    (m * g / (2 * L), "m g/(2 L)", r"\frac{m g}{2 L}"),
    (sp.Rational(3, 7) * m, "(3/7) m", r"\tfrac{3}{7} m"),
    (sp.sqrt(x**2 + L**2), "√(L² + x²)", r"\sqrt{L^{2} + x^{2}}"),
    (k * sp.Abs(d(x)) * d(x), "k ẋ |ẋ|", r"k \dot{x} \lvert \dot{x}\rvert"),
    (1 - sp.cos(th1), "1 − cos θ₁", r"1 - \cos \theta_{1}"),
    (x - S["L_0"], "x − L₀", r"x - L_{0}"),
    (S["tau"] - S["F"], "τ − F", r"\tau - F"),
    (S["lambda_"] * S["beta"] * S["pos"], "β λ pos", r"\beta \lambda\, \mathrm{pos}"),
    (S["m_cart"] * d(x, 2), "m_cart ẍ", r"m_{\mathrm{cart}} \ddot{x}"),
    (
        S["theta_dot_ref"] * d(th1),
        "θ_dot_ref θ̇₁",
        r"\theta_{\text{dot ref}} \dot{\theta}_{1}",
    ),
    (x ** sp.Rational(3, 2), "x^(3/2)", r"x^{\tfrac{3}{2}}"),
    (sp.cos(th1) / L, "cos(θ₁)/L", r"\frac{\cos \theta_{1}}{L}"),
    (
        sp.Piecewise((x, x < 0), (0, True)),
        "{x if x < 0; 0 otherwise}",
        r"\begin{cases} x & \text{if } x < 0 \\ 0 & \text{otherwise} \end{cases}",
    ),
    (sp.S.Zero, "0", "0"),
    (-sp.S(2), "−2", "-2"),
]


@pytest.mark.parametrize(("expr", "text", "tex"), TEXTBOOK, ids=[t for _, t, _ in TEXTBOOK])
def test_reads_like_the_textbook(expr, text, tex):
    laid = WRITE(expr)
    assert unicode(laid) == unicodedata.normalize("NFC", text)
    assert PAGE.latex(laid) == tex
    assert WEB.latex(laid) == tex


def test_combining_dots_take_no_column():
    assert columns("θ̈₁") == 2
    assert columns("ẋ") == 1
    assert columns("中") == 2


def test_names_that_would_look_the_same_are_told_apart():
    shown = [unicode(x) for x in letters(["x1", "x_1", "theta", "θ", "lambda", "lambda_", "beta", "Delta_x"]).values()]
    assert len(set(shown)) == len(shown)
    assert shown[0] == "x₁"
    assert shown[2] == "θ"


def test_what_is_no_expression_is_refused():
    with pytest.raises(TypeError, match="cannot write"):
        WRITE(sp.Interval(0, 1))


# -- a reader of what was printed, written without a look at the printer ---------------------------------------


class Reader:
    """Reads ``m g/(2 L)``: a sign, factors side by side, one fraction bar; functions take an atom or parentheses."""

    TOKEN = re.compile(
        r"\s*(√|sin|cos|exp|[½⅓⅔¼¾⅕⅙⅛]|\d+(?:\.\d+)?|[^\W\d_][\u0300-\u036f]*(?:[₀-₉]+|_\w+)?|[()+−/|^]|[⁰¹²³⁴-⁹⁻]+)"
    )
    SMALL: ClassVar = dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-", strict=True))

    def __init__(self, text: str, values: dict[str, float]) -> None:
        self.parts: list[str] = []
        at = 0
        while at < len(text):
            found = self.TOKEN.match(text, at)
            assert found, (text, at)
            self.parts.append(found.group(1))
            at = found.end()
        self.values, self.at = values, 0

    def peek(self) -> str:
        return self.parts[self.at] if self.at < len(self.parts) else ""

    def take(self, expected: str = "") -> str:
        part = self.peek()
        assert not expected or part == expected, (self.parts, self.at)
        self.at += 1
        return part

    def sum(self) -> float:
        total = 0.0
        sign = -1 if self.peek() == "−" else 1
        if sign < 0:
            self.take()
        while True:
            total += sign * self.term()
            if self.peek() not in ("+", "−"):
                return total
            sign = 1 if self.take() == "+" else -1

    def term(self) -> float:
        value = self.factor()
        while (self.peek() and self.peek() not in "+−)/|") or (self.peek() == "|" and not self.bar):
            value *= self.factor()
        if self.peek() == "/":
            self.take()
            value /= self.factor()
        return value

    bar = False

    def factor(self) -> float:
        part = self.take()
        if part in ("sin", "cos", "exp"):
            power = self.raised(default=1)
            return getattr(math, part)(self.argument()) ** power
        if part == "√":
            return math.sqrt(self.argument())
        if part == "(":
            value = self.sum()
            self.take(")")
        elif part == "|":
            self.bar = True
            value = abs(self.sum())
            self.take("|")
            self.bar = False
        elif part in "½⅓⅔¼¾⅕⅙⅛":
            value = unicodedata.numeric(part)
        elif part[0].isdigit():
            value = float(part)
        else:
            value = self.values[part]
        return value ** self.raised(default=1)

    def argument(self) -> float:
        if self.peek() == "(":
            self.take()
            value = self.sum()
            self.take(")")
            return value
        value = 1.0
        if self.peek()[0].isdigit():
            value = float(self.take())
        return value * self.values[self.take()] if self.peek() in self.values else value

    def raised(self, default: float) -> float:
        part = self.peek()
        if part and part[0] in self.SMALL:
            return float("".join(self.SMALL[c] for c in self.take()))
        if part == "^":
            self.take()
            return self.argument()
        return default


ATOMS = {
    "m₁": m1,
    "m₂": m2,
    "g": g,
    "L": L,
    "x₁": x1,
    "θ₁": th1,
    "θ₂": th2,
    "ẋ₁": d(x1),
    "θ̈₁": d(th1, 2),
    "τ": S["tau"],
}
VALUES = {unicodedata.normalize("NFC", name): 0.3 + 0.17 * i for i, name in enumerate(ATOMS)}
numbers = st.sampled_from([sp.S(-2), sp.S(3), sp.Rational(1, 2), sp.Rational(-3, 7), sp.Rational(5, 4)])
atoms = st.one_of(st.sampled_from(list(ATOMS.values())), numbers)


def _grow(children):
    return st.one_of(
        st.tuples(children, children).map(lambda p: p[0] + p[1]),
        st.tuples(children, children).map(lambda p: p[0] * p[1]),
        st.tuples(children, children).map(lambda p: p[0] - p[1]),
        children.map(sp.sin),
        children.map(sp.cos),
        children.map(lambda e: e**2),
        children.map(lambda e: 1 / (e**2 + 1)),
        children.map(lambda e: sp.sqrt(e**2 + 2)),
        st.tuples(atoms, atoms).map(lambda p: sp.Abs(p[0] - p[1])),
    )


expressions = st.recursive(atoms, _grow, max_leaves=7)


@sized(200, 25)
@given(expressions)
def test_what_is_printed_means_what_was_meant(expr):
    table = {symbol: sp.Float(VALUES[unicodedata.normalize("NFC", name)]) for name, symbol in ATOMS.items()}
    derivatives = {s: v for s, v in table.items() if isinstance(s, sp.Derivative)}
    expected = complex(sp.sympify(expr).xreplace(derivatives).xreplace(table))
    text = unicode(WRITE(expr))
    reader = Reader(text, VALUES)
    assert reader.sum() == pytest.approx(expected.real, rel=1e-9, abs=1e-9), text
    assert not reader.peek(), text


@sized(60, 10)
@given(expressions, st.integers(16, 60))
def test_a_formula_cut_into_lines_still_means_the_same_and_fits(expr, width):
    """Cut at any width and read line by line; only a line with one symbol or number on it may be longer."""
    whole = unicode(WRITE(expr))
    rows = break_lines(list(tokens(WRITE(expr))), width, measure)
    value = Reader(whole, VALUES).sum()
    reader = Reader(" ".join(join(row.tokens) for row in rows).replace("·", " "), VALUES)
    assert reader.sum() == pytest.approx(value, rel=1e-12) and not reader.peek()
    for row in rows:
        line = join(row.tokens)
        assert columns(line) + 2 * row.depth <= width or len(line.split()) <= 3, (line, row.depth)


def cut(expr, width, **options):
    return [" " * 2 * row.depth + join(row.tokens) for row in break_lines(list(tokens(WRITE(expr))), width, **options)]


def test_breaks_are_taken_outside_of_parentheses_first():
    expr = m1 * (L + S["L_a"] + S["L_b"]) * x1 + m2 * (L + S["L_a"] + S["L_b"]) * x2r
    assert cut(expr, 34, measure=measure) == ["m₁ (L + L_a + L_b) x₁", "+ m₂ (L + L_a + L_b) x_2r"]


def test_a_factor_stays_with_its_parenthesis_and_its_acceleration():
    """A product is cut inside a long parenthesis, or before a function with a dot, never between the two."""
    inertia = (m1 * S["l1"] ** 2 + m2 * S["l2"] ** 2 + 2 * m2 * S["l1"] * S["l2"] * sp.cos(th2)) * d(th1, 2)
    assert cut(inertia, 30, measure=measure) == ["(m₁ l₁² + m₂ l₂²", "  + 2 m₂ l₁ l₂ cos θ₂) θ̈₁"]
    turning = m2 * S["l1"] * S["l2"] * (d(th1) + d(th2)) * sp.sin(th1 - th2)
    assert cut(-turning, 26, measure=measure) == ["−m₂ l₁ l₂ (θ̇₁ + θ̇₂)", "  · sin(θ₁ − θ₂)"]
    for width in range(24, 50):
        for line in cut(inertia + turning, width, measure=measure)[1:]:
            assert not line.strip().startswith(("θ̈", "· θ̈", "(", "· ("))


def test_a_line_inside_a_parenthesis_is_set_in_by_its_depth():
    expr = (m1 * L**2 + m2 * (L + S["L_a"] * sp.cos(th2) + S["L_b"] * sp.cos(th1)) ** 2 + m * g) * d(th1, 2)
    assert cut(expr, 26, measure=measure) == [
        "(m₁ L²",
        "  + m₂ (L + L_a cos θ₂",
        "    + L_b cos θ₁)²",
        "  + m g) θ̈₁",
    ]


def test_a_fraction_is_as_wide_as_its_wider_side_where_it_is_set():
    long = sum(S[n] for n in ["L_a", "L_b", "L_m", "L_k", "L_0"])
    ratio = WRITE(long / (long + m1 * x1))
    (piece,) = tokens(ratio)
    assert set_columns(piece) < measure(piece) / 1.5
    assert len(break_lines([piece], 50, set_columns, flat=False)) == 1
    assert len(break_lines([piece], 50, measure)) == 2


def test_a_dot_over_a_letter_of_a_name_would_look_like_a_product() -> None:
    """The rate of lift is lift′ in every format: l̇ift reads as l̇ · ift, and a dot in the middle hits that of the i."""
    assert [unicode(Letter("lift", (), n)) for n in (0, 1, 2)] == ["lift", "lift′", "lift″"]
    square = Power(Letter("front", ("wheel",), 1), Number("2"))
    assert unicode(square) == "front_wheel′²"
    assert unicode(Letter("theta", ("1",), 2)) == "θ̈₁" and unicode(Letter("x", ("2r",), 1)) == "ẋ_2r"
    assert unicode(Letter("Lift", (), 1, literal=True)) == "Lift′" and unicode(Letter("x", (), 1, literal=True)) == "ẋ"
    assert PAGE.latex(Letter("lift", (), 2)) == r"\mathrm{lift}''"
    assert PAGE.latex(square) == r"\mathrm{front}_{\mathrm{wheel}}'^{2}"
    assert '<mrow><mi>lift</mi><mo form="postfix" lspace="0" rspace="0">′</mo></mrow>' in mathml(Letter("lift", (), 1))
    assert "′</mo></mrow></mrow><mrow><mn>2</mn></mrow></msup>" in mathml(square)


def test_numbers_are_small_subscripts_and_letters_never_are() -> None:
    """Unicode has no small b: no letter is set small, so that L_a and L_b look alike on every page."""
    assert unicode(Letter("p", ("phi1",))) == "p_φ₁" and unicode(Letter("V", ("k2",))) == "V_k₂"
    assert unicode(Letter("V", ("suspension",))) == "V_suspension"
    assert unicode(Letter("V", ("tyre",))) == "V_tyre"
    assert unicode(Letter("x", ("2r",))) == "x_2r" and unicode(Letter("x", ("2",))) == "x₂"
    assert [unicode(Letter("L", (c,))) for c in "ab"] == ["L_a", "L_b"]
    assert unicode(Letter("xi", ("i",), 1)) == "ξ̇ᵢ"
    assert PAGE.latex(Letter("p", ("phi1",))) == r"p_{\phi_{1}}" and PAGE.latex(Letter("V", ("k2",))) == "V_{k_{2}}"
    assert "<msub><mi>φ</mi><mn>1</mn></msub>" in mathml(Letter("p", ("phi1",)))
    assert "<msub><mi>k</mi><mn>2</mn></msub>" in mathml(Letter("V", ("k2",)))


def test_words_of_a_subscript_are_one_part() -> None:
    """λ of a constraint named "front wheel rolls", row 2; a Greek letter and a single letter are no words."""
    row = Letter("lambda", ("front", "wheel", "rolls", "2"))
    assert PAGE.latex(row) == r"\lambda_{\text{front wheel rolls},2}" and unicode(row) == "λ_front_wheel_rolls_2"
    assert "<mtext>front wheel rolls</mtext>" in mathml(row)
    assert PAGE.latex(Letter("R", ("x", "theta", "f", "tip"))) == r"R_{x,\theta,f,\mathrm{tip}}"


def test_a_fraction_too_long_for_a_line_lets_what_follows_be_cut() -> None:
    """No line is longer than the width, whatever stands first, and every letter is still there."""
    long = Addition(tuple((False, Letter("a", (str(k),))) for k in range(30)))
    ratio = Quotient(Number("1"), Times((Number("2"), long)))
    whole = Addition(((False, ratio), (False, Power(long, Number("2"))), (True, Letter("b"))))
    for flat, width_of in ((True, measure), (False, set_columns)):
        rows = [join(row.tokens) for row in break_lines(list(tokens(whole)), 60, width_of, flat=flat)]
        assert max(len(line) for line in rows) <= 60
        assert sum(line.count("a") for line in rows) == 60 and rows[-1].endswith("− b")


def test_a_matrix_that_fits_keeps_its_name() -> None:
    grid = Grid(tuple(tuple(Number(f"−{i}.{j}4567") for j in range(6)) for i in range(6)))
    (line,) = lines((Letter("A"), grid), 96)
    assert [t.math for t in line.right if t.role == "leaf"] == [Letter("A"), grid]


@pytest.mark.parametrize(
    ("number", "written"),
    [
        (sp.Rational("0.7071067811865476"), "0.7071067811865476"),  # √2/2 as the machine has it, digit for digit
        (sp.Rational(1, 65536), "1/65536"),
        (sp.Rational(3, 20), "3/20"),
        (sp.Rational("0.000000003"), "3 · 10⁻⁹"),
        (sp.Rational(10**20 + 1, 10**15), "100000000000000000001/1000000000000000"),  # too many digits to be one
    ],
)
def test_decimal_numbers_are_written_as_such_where_a_fraction_is_long(number: sp.Rational, written: str) -> None:
    assert unicode(WRITE(number)).strip("()") == written
    assert written in unicode(WRITE(number * m1))
    assert unicode(WRITE(-number * m1 / L)).startswith("−")


def test_a_sum_that_is_subtracted_keeps_its_parentheses_in_a_page() -> None:
    """As one term of a page's equation, which has a colour of its own, too."""
    total = Addition(((False, Letter("a")), (False, Letter("b"))))
    for term in (total, Tagged(total, ("spring 'k'",), "spring")):
        page = _terms(Addition(((False, Letter("c")), (True, term))), [])
        assert re.sub(r"<[^>]+>|\s", "", page) == "c−(a+b)"
        page = _terms(Addition(((False, Letter("c")), (False, term))), [])
        assert re.sub(r"<[^>]+>|\s", "", page) == "c+a+b"
