"""The expression grammar against the same expressions built by SymPy's own operators."""

import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st
from sympy.physics.vector import dynamicsymbols

from lagrangian import ParseError
from lagrangian.model.names import time
from lagrangian.page.plain import plain
from lagrangian.read.expression import parse_expression
from size import sized

x, y, theta1, theta2 = dynamicsymbols("x y theta1 theta2")
m, g, L, L_a, k, E, I, N, S, beta, gamma, lam = sp.symbols("m g L L_a k E I N S beta gamma lambda")
SCOPE = {
    **{str(s.func): s for s in (x, y, theta1, theta2)},
    **{s.name: s for s in (m, g, L, L_a, k, E, I, N, S, beta, gamma, lam)},
}
R = sp.Rational


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("m*L^2*theta1'' + m*g*L*sin(theta1)", m * L**2 * theta1.diff(time, 2) + m * g * L * sp.sin(theta1)),
        ("1/2*m*x'^2", R(1, 2) * m * x.diff(time) ** 2),
        ("-x^2", -(x**2)),
        ("(-x)^2", x**2),
        ("2^-2", R(1, 4)),
        ("x^y^2", x ** (y**2)),
        ("x**2", x**2),
        ("m/g/L", m / g / L),
        ("m/g*L", m / g * L),
        ("m - g - L", m - g - L),
        ("m - (g - L)", m - g + L),
        ("2*-x", -2 * x),
        ("x/-2", -x / 2),
        ("+x", x),
        ("((x))", x),
        ("0.1 + 0.2", R(3, 10)),
        (".5", R(1, 2)),
        ("1e3", sp.Integer(1000)),
        ("2.5e-3*k", R(1, 400) * k),
        ("pi*t", sp.pi * time),
        ("E*I*N*S*beta*gamma*lambda", E * I * N * S * beta * gamma * lam),
        ("sin(x) + cos(x) + tan(x)", sp.sin(x) + sp.cos(x) + sp.tan(x)),
        ("asin(m) + acos(m) + atan(m)", sp.asin(m) + sp.acos(m) + sp.atan(m)),
        ("sinh(x) + cosh(x) + tanh(x)", sp.sinh(x) + sp.cosh(x) + sp.tanh(x)),
        ("asinh(x) + acosh(x) + atanh(x)", sp.asinh(x) + sp.acosh(x) + sp.atanh(x)),
        ("atan2(y, x)", sp.atan2(y, x)),
        ("exp(x) + log(k) + ln(m) + sqrt(L)", sp.exp(x) + sp.log(k) + sp.log(m) + sp.sqrt(L)),
        ("abs(x)*sign(x')", sp.Abs(x) * sp.sign(x.diff(time))),
        ("min(x, y, 3) + max(0, x)", sp.Min(x, y, 3) + sp.Max(0, x)),
        ("max(1, 2)", sp.Integer(2)),
        ("piecewise(x > 0, k*x, 0)", sp.Piecewise((k * x, x > 0), (0, True))),
        ("piecewise(x < 0, 1, x <= 1, 2, 3)", sp.Piecewise((1, x < 0), (2, x <= 1), (3, True))),
        ("piecewise(x > 0 and y > 0, 1, 2)", sp.Piecewise((1, sp.And(x > 0, y > 0)), (2, True))),
        ("piecewise(x > 0 or not y > 0, 1, 2)", sp.Piecewise((1, sp.Or(x > 0, y <= 0)), (2, True))),
        ("piecewise((x > 0) & (y > 0), 1, 2)", sp.Piecewise((1, sp.And(x > 0, y > 0)), (2, True))),
        ("piecewise((x + 1) > 0, 1, 2)", sp.Piecewise((1, x + 1 > 0), (2, True), evaluate=False)),
        ("piecewise(x == 1, 1, x != 2, 2, 3)", sp.Piecewise((1, sp.Eq(x, 1)), (2, sp.Ne(x, 2)), (3, True))),
        ("piecewise(1 > 0, x, y)", x),
        ("piecewise(1 < 0, x, y)", y),
        ("m\n  + g", m + g),
    ],
)
def test_ascii(text: str, expected: sp.Expr) -> None:
    assert parse_expression(text, SCOPE) == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("½·m·ẋ²", m * x.diff(time) ** 2 / 2),
        ("x\u0307", x.diff(time)),
        ("ẍ", x.diff(time, 2)),
        ("x\u0307\u0307", x.diff(time, 2)),
        ("θ\u0308₁", theta1.diff(time, 2)),
        ("θ₁", theta1),
        ("θ1", theta1),
        ("θ_1", theta1),
        ("theta_1", theta1),
        ("θ̇_1'", theta1.diff(time, 2)),
        ("θ1̇", theta1.diff(time)),
        ("ϑ₁", theta1),
        ("𝜃₁", theta1),
        ("Lₐ", L_a),
        ("La", L_a),
        ("β·γ·λ", beta * gamma * lam),
        ("lamda", lam),
        ("π", sp.pi),
        ("x × y − m ÷ g", x * y - m / g),
        ("x⁻² + x¹⁰", x**-2 + x**10),
        ("¾ + ⅓", R(13, 12)),
        ("x′ + x″", x.diff(time) + x.diff(time, 2)),
        ("x’’", x.diff(time, 2)),
        (
            "piecewise(x ≤ 1, 1, x ≠ 2 ∧ y ≥ 0, 2, 3)",
            sp.Piecewise((1, x <= 1), (2, sp.And(sp.Ne(x, 2), y >= 0)), (3, True)),
        ),
    ],
)
def test_unicode(text: str, expected: sp.Expr) -> None:
    assert parse_expression(text, SCOPE) == expected


def test_exact_name_wins_over_another_way_of_writing_it() -> None:
    both = {"La": sp.Symbol("La"), "L_a": sp.Symbol("L_a")}
    assert parse_expression("La + 2*L_a", both) == both["La"] + 2 * both["L_a"]
    assert parse_expression("länge", {"länge": sp.Symbol("länge")}) == sp.Symbol("länge")


def test_rate_of_a_definition_is_a_derivative_of_its_name() -> None:
    X2 = dynamicsymbols("X2")
    assert parse_expression("X2'", {"X2": X2}) == sp.Derivative(X2, time)


@pytest.mark.slow
def test_a_long_sum_is_read_in_time_proportional_to_its_length() -> None:
    text = " + ".join(f"{i}*x^{i % 7}*sin({i}*theta1)" for i in range(1, 1200))
    assert len(parse_expression(text, SCOPE).args) == 1199


def test_quantities_are_real_so_that_abs_never_splits_into_real_and_imaginary_parts() -> None:
    assert not parse_expression("abs(exp(sin(x))) + sign(exp(x)) + abs(x^y)", SCOPE).has(sp.re, sp.im, sp.conjugate)


LEAVES = st.sampled_from([x, y, theta1, m, k, lam, x.diff(time), theta1.diff(time, 2), time, sp.pi])
NUMBERS = st.fractions(min_value=-20, max_value=20, max_denominator=12).map(lambda f: R(f.numerator, f.denominator))


def _grow(children: st.SearchStrategy[sp.Expr]) -> st.SearchStrategy[sp.Expr]:
    pairs = st.tuples(children, children)
    return st.one_of(
        pairs.map(lambda p: p[0] + p[1]),
        pairs.map(lambda p: p[0] - p[1]),
        pairs.map(lambda p: p[0] * p[1]),
        pairs.map(lambda p: p[0] / p[1] if p[1] != 0 else p[0]),
        st.tuples(children, st.integers(-3, 4)).map(lambda p: p[0] ** p[1] if p[0] != 0 else p[0]),
        children.map(sp.sin),
        children.map(lambda e: sp.sqrt(e**2 + 1)),
        children.map(sp.Abs),
        children.map(lambda e: e if e.is_number and e > 700 else sp.exp(e)),
        pairs.map(lambda p: sp.atan2(p[0], p[1] ** 2 + m)),
        pairs.map(lambda p: sp.Piecewise((p[0], x > 1), (p[1], True))),
    )


@pytest.mark.parametrize(
    "text",
    [
        "x + exp(exp(exp(20)))",
        "2^exp(exp(7))*x",
        "x^2*sinh(cosh(10))",
        "sin(exp(exp(exp(9)))) + x",
        "x*pi^(pi^(pi^pi))",
    ],
)
def test_a_number_beyond_those_of_a_computer_is_refused_before_it_is_printed(text: str) -> None:
    """SymPy orders terms by the values of their factors: of a tower of exponentials it would never have one."""
    with pytest.raises(ParseError, match="the number is too large"):
        parse_expression(text, SCOPE)


def test_numbers_that_a_computer_holds_are_read_and_printed() -> None:
    for text in ("x*exp(700) + 1", "x*exp(-3*exp(exp(6))) + 1", "x + exp(exp(6)/2)"):
        assert plain(parse_expression(text, SCOPE)) == text


@sized(150, 30)
@given(st.recursive(LEAVES | NUMBERS, _grow, max_leaves=8))
def test_what_is_printed_is_read_back(expr: sp.Expr) -> None:
    if expr.has(sp.zoo, sp.nan, sp.oo, sp.I, sp.re, sp.im, sp.E):
        return
    once = expr.replace(lambda e: isinstance(e, sp.Abs) and isinstance(e.args[0], sp.Abs), lambda e: e.args[0])
    assert parse_expression(plain(expr), SCOPE) == once  # SymPy keeps ||x|| only in products
