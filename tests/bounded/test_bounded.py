"""Sizes are predicted before anything is written out; the predictions are bounds."""

from collections.abc import Iterator
from random import Random
from typing import Any, cast

import pytest
import sympy as sp
from sympy.physics.mechanics import dynamicsymbols

import lagrangian as lg
from effort import at_most
from lagrangian import bounded
from lagrangian.bounded import products, searches, writing
from lagrangian.bounded.effort import CallCount

a, b, c, d, e = sp.symbols("a b c d e")
q, w = dynamicsymbols("q w")
t = sp.Symbol("t")

EXPRESSIONS = [
    (a + b) ** 5 * (c - d) ** 3,
    (a + b * (c + d * (e + a))) ** 4,
    sp.sin(a + b) ** 3 * (1 + sp.cos(c)) ** 2,
    1 / (a + b) ** 3 + (a + b) ** 2 / (c + d),
    sp.sqrt((a + b) ** 4 + (c + d) ** 2) * (a + 1) ** 3,
    (a + b + c) ** sp.Rational(9, 2),
]


@pytest.mark.parametrize("expr", EXPRESSIONS)
def test_an_expansion_has_no_more_terms_than_predicted(expr: sp.Expr) -> None:
    longest = max(len(s.args) for s in [*sp.expand(expr).atoms(sp.Add), sp.Add(a, b)])
    assert longest <= bounded.terms(expr)
    assert bounded.expand(expr) == sp.expand(expr)


def test_what_would_be_too_long_stays_as_it_is() -> None:
    power = (a + b + c + d + e) ** 50
    assert bounded.terms(power) == 316_251  # C(54, 4)
    assert bounded.expand(power) is power
    root = (a + b + c + d + e) ** sp.Rational(101, 2)
    assert bounded.terms(root) == 316_251
    assert bounded.expand(root) is root


def test_definitions_that_double_are_counted_and_not_written() -> None:
    """d_n = d_{n−1} + sin d_{n−1} holds x 2ⁿ times: refused from this number, at the element that uses it."""
    system = lg.System("doubling")
    x = system.coordinate("x")
    system.particle(1, at=system.origin + (x, 0))
    name = x
    for n in range(60):
        name = system.define(f"d{n}", name + sp.sin(name))
    with pytest.raises(bounded.TooLarge, match="uses 'd59' has 3e\\+18 operations once it is written out"):
        system.potential(name)


def test_written_out_is_what_sympy_substitutes() -> None:
    D, E = dynamicsymbols("D E")
    table = {D: q**2 + a * w, E: sp.sin(D) * D.diff(t)}
    found = bounded.written_out(E.diff(t) + a * E, table)
    expected = (E.diff(t) + a * E).subs(E, table[E]).doit().subs(D, table[D]).doit()
    assert sp.expand(found - expected) == 0


@pytest.mark.parametrize("kind", [sp.Max, sp.Min])
def test_the_slope_of_a_maximum_of_many_is_that_of_what_it_is(kind: type) -> None:
    parts = [n * q + (n - 2) ** 2 * w for n in range(6)]
    slope = bounded.diff(kind(*parts, evaluate=False) ** 2, q)
    for at in ({q: 0.3, w: 0.2}, {q: -0.7, w: 0.05}, {q: 0.1, w: -0.4}):
        values = [float(p.subs(at)) for p in parts]
        which = values.index((max if kind is sp.Max else min)(values))
        assert float(slope.subs(at)) == pytest.approx(2 * values[which] * which)


@pytest.mark.parametrize(
    ("vector", "unit"),
    [
        ((sp.sin(a) * sp.cos(b), sp.sin(a) * sp.sin(b), sp.cos(a)), True),
        ((sp.cos(a + b), sp.sin(a + b)), True),
        ((sp.Rational(3, 5), sp.Rational(4, 5)), True),
        ((sp.sqrt(2) / 2, sp.sqrt(2) / 2), True),
        ((a / sp.sqrt(a**2 + b**2), b / sp.sqrt(a**2 + b**2)), True),
        (tuple(v / sp.sqrt((a + b + c + d + e) ** 100 + 1) for v in ((a + b + c + d + e) ** 50, sp.S.One)), True),
        ((sp.sin(a), sp.cos(b)), False),
        ((sp.cos(a), sp.sin(2 * a)), False),
        (((a + b + c + d + e) ** 50, sp.S.One), False),
    ],
)
def test_unit_vectors_are_seen(vector: tuple[sp.Expr, ...], unit: bool) -> None:
    assert bounded.is_one(sp.Add(*(v**2 for v in vector))) is unit


def test_an_expansion_proves_nothing_about_maxima() -> None:
    kinked = sp.Max(*[n * q + (n - 2) ** 2 * w for n in range(9)], evaluate=False)
    with at_most(5_000):
        found = bounded.expand((a + b) * kinked + (a - b) * kinked)
    assert found == 2 * a * kinked


def test_names_are_found_once_however_often_they_are_shared() -> None:
    expr: sp.Expr = q.diff(t) + sp.sin(w)
    for _ in range(40):
        expr = sp.Mul(expr, sp.Add(expr, a, evaluate=False), evaluate=False)
    assert bounded.names(expr) == {a, q, w, q.diff(t)}


def test_the_sign_of_a_deeply_nested_argument_is_left_open() -> None:
    """Its real part, which SymPy looks for, would be exponentially long."""
    inner: sp.Expr = q
    for _ in range(7):
        inner = sp.exp(-sp.sqrt(1 + (inner + a) ** 2)) * w
    with at_most(50_000):
        for kind in (sp.Abs, sp.sign):
            assert bounded.absolute(kind, inner).func is kind
    with at_most(2_000_000):
        slope = bounded.diff(a * sp.Abs(inner, evaluate=False), q)
    assert slope.has(sp.sign) and not slope.has(sp.re, sp.im)
    assert bounded.absolute(sp.Abs, sp.Integer(-3)) == 3


def test_a_search_ends_where_the_last_call_is_that_of_a_generator_thrown_away() -> None:
    """Python ignores what is raised there, and no longer counts after it."""

    def half_used() -> Iterator[int]:
        yield from range(3)

    def nothing() -> None: ...

    def endless() -> None:
        for _ in range(10_000):
            next(half_used())
        pytest.fail("the calls were not counted")

    for calls in range(500, 510):
        assert bounded.searched(endless, calls=calls) is None
    assert bounded.searched(nothing, calls=10) is None


def _nested(depth: int) -> sp.Expr:
    inner: sp.Expr = q
    for _ in range(depth):
        inner = sp.sin(inner)
    return inner


@pytest.mark.parametrize(
    "expr",
    [
        -q / (3 * w) + sp.exp(-q) * a - 1,
        -(a + b) * c / (d - e) ** 2,
        sp.Max(a * q, w, -b) - sp.Abs(q.diff(t)),
        sp.Piecewise((a * q, q < -w), (sp.Rational(-2, 3) * b**-d, True)),
        -a - b,
        sp.Mul(2, a + b, evaluate=False) / -q,
        sp.E + sp.exp(-2),
        a ** (-q * w) * sp.sqrt(-b),
        _nested(7).diff(q),
    ],
)
def test_operations_are_those_that_sympy_counts(expr: sp.Expr) -> None:
    assert bounded.operations(expr) == sp.count_ops(expr)


def test_operations_of_several_expressions_are_added() -> None:
    a, b = sp.symbols("a b")
    exprs = (a * b + 1, sp.sqrt(a * b + 1) / 3, a * b + 1)
    assert bounded.operations(*exprs) == sum(sp.count_ops(x) for x in exprs)
    assert bounded.operations() == 0


def test_operations_of_what_is_shared_are_counted_once() -> None:
    """SymPy would look at 2⁶⁰ of them."""
    expr: sp.Expr = a / q - b
    for _ in range(60):
        expr = sp.sin(expr) + sp.cos(expr)
    with at_most(20_000):
        assert bounded.operations(expr) == 6 * 2**60 - 3  # n → 2 n + 3, from 3: q(t) is one


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "expr",
    [
        sp.atan(_nested(70)) * q.diff(t) ** 2,
        _nested(25).diff(q) * sp.exp(a * q * w),
        sp.Add(*[(a * q + k) ** (q / k) * sp.tan(w) for k in range(1, 30)]) ** 3 * _nested(30),
        sp.Mul(*[sp.sin(q * k + w) for k in range(1, 60)]) * (a + b * q),
    ],
)
def test_a_long_derivative_is_that_of_sympy(expr: sp.Expr) -> None:
    """At a point: both sides are sums of products that may be put in another way."""
    values: dict[Any, float] = {a: 0.7, b: 1.3, w: 0.45, q: 0.37, t: 0.0}

    def number(of: sp.Expr) -> float:
        for derivatives in ({q.diff(t, 2): 0.2}, {q.diff(t): 0.4, w.diff(t): 0.9}, values):
            of = cast("sp.Expr", of.xreplace({name: sp.Float(value) for name, value in derivatives.items()}))
        return float(of.evalf())

    for symbol in (q, w, q.diff(t), a, t):
        assert number(bounded.diff(expr, symbol)) == pytest.approx(number(sp.diff(expr, symbol)), rel=1e-9, abs=1e-12)


@pytest.mark.parametrize(
    "expr",
    [
        (a + b) * q.diff(t) ** 2 / 2 - (a * d + b * c) * sp.sin(q - w) * q.diff(t) * w.diff(t),
        (d + b * a**2) * (sp.sin(q) ** 2 * w.diff(t) ** 2 + q.diff(t) ** 2) / 2 - a * sp.sqrt(q**2 + (w - b) ** 2),
        q ** (w / 3) * sp.exp(-a * t) / (b + sp.cos(q)) ** 2 + sp.atan2(q, w + a),
        sp.Symbol("y") * q.diff(t, 2) - c * t**3,
    ],
)
def test_a_derivative_is_written_as_sympy_writes_it(expr: sp.Expr) -> None:
    for symbol in (q, w, q.diff(t), q.diff(t, 2), a, t):
        assert bounded.diff(expr, symbol) == sp.diff(expr, symbol)


@pytest.mark.slow
def test_the_derivative_of_a_deeply_nested_expression_takes_few_calls() -> None:
    """SymPy's own takes 2.6 million, this 470 thousand."""
    given = _nested(40).diff(q)
    with at_most(800_000):
        slope = bounded.diff(given, q)
    assert isinstance(slope, sp.Add) and len(slope.args) == 40


def test_what_was_once_sought_is_not_sought_again() -> None:
    """Lines of one answer, and of many, ask for the same."""
    whole = (a * q + b * q) ** 2 * (sp.sin(w) + c)
    asked = (bounded.cancel, bounded.factored, bounded.trigsimp, bounded.expand, lambda x: bounded.diff(x, q))
    for k, ask in enumerate(asked, 11):
        expr = cast("sp.Expr", whole / (a + b) + k * sp.sin(q) ** 2 + k * sp.cos(q) ** 2)
        first = ask(expr)
        with at_most(1_000):
            assert ask(expr) == first


def test_a_search_that_was_given_up_is_sought_again(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whether it ends may depend on what is counted around it."""
    expr = a**2 - b**2
    with monkeypatch.context() as patch:
        patch.setattr(searches, "_counted", lambda routine, arguments, calls: (None, calls))
        assert bounded.factored(expr) is None and bounded.cancel(expr) == expr
    assert bounded.factored(expr) == (a - b) * (a + b)


def test_sines_are_only_sought_where_there_are_some() -> None:
    with at_most(500):
        assert bounded.trigsimp((a + b) ** 2 * q - w / c) == (a + b) ** 2 * q - w / c
    assert bounded.trigsimp(sp.cosh(q) ** 2 - sp.sinh(q) ** 2) == 1


def test_a_kept_search_counts_each_time_in_a_question() -> None:
    """Else an answer that is refused as too long would be judged when it comes again."""
    expr = (a * q + b * q) ** 3 / (a + b) + (c * w + d * w) ** 2 / (c + d)

    def calls() -> int:
        count = CallCount(1_000_000, anywhere=False)
        count.run(lambda: bounded.cancel(bounded.together(expr)))
        return count.limit - count.left

    first, again = calls(), calls()
    assert first > 1_000 and abs(first - again) < 0.1 * first
    with at_most(first // 2):
        bounded.cancel(bounded.together(expr))  # it is still not sought again


PLAIN = [
    a * (b + c * (d - q)) * sp.sin(q * (a + b)) - (a + b) ** 3 / (c + d) ** 2,
    sp.Derivative(q, t) * (a + q) ** 2 * sp.cosh(2 * (a + b) * w),
    a * b - c * sp.cos(q) ** 2,
    sp.sqrt(a * b) * (c + d) + (a * b) ** e * (a + 1),
    sp.log(a * b) * (a + sp.exp(b + c)),
    sp.Pow(sp.Mul(a, b, evaluate=False), 2, evaluate=False) * (c + 1),
    sp.Piecewise((a * (b + c), a > b), (0, True)) * (d + e),
    (a + sp.sqrt(b + c)) ** 2 * sp.atan2(a * (b + c), d),
]


@pytest.mark.parametrize("expr", PLAIN)
def test_rules_that_change_nothing_are_left_out_of_an_expansion(expr: sp.Expr) -> None:
    assert writing._multiplied(expr) == sp.expand(expr)


def test_letters_that_are_kept_are_not_changed_by_who_asks() -> None:
    expr = a * q + b
    bounded.letters(expr).clear()
    assert bounded.letters(expr) == {a, b, q, t}


NOT_PLAIN = [(a + b) ** 2 / (c + d), sp.sin(a * (b + c)) * (d + e), 0.5 * a * (b + c), (a + b) * (c + d) ** -2]


@pytest.mark.parametrize("expr", NOT_PLAIN)
def test_only_exact_sums_of_products_are_multiplied_out_without_sympy(expr: sp.Expr) -> None:
    assert products.multiplied_out(expr) is None
    assert bounded.expand(expr) == sp.expand(expr)


@pytest.mark.slow
def test_sums_are_multiplied_out_as_sympy_does() -> None:
    source = Random(7)
    moving = [q, w, q.diff(t), sp.sin(q), sp.cos(q + w), a, b, c, sp.pi]

    def made(depth: int) -> sp.Expr:
        if depth == 0:
            return source.choice(moving) ** source.choice((1, 1, 2, -1))
        parts = [made(depth - 1) for _ in range(source.randint(2, 3))]
        if source.random() < 0.5:
            return sp.Mul(*parts)
        return sp.Add(*[source.choice((1, -2, sp.Rational(1, 3))) * x for x in parts]) ** source.choice((1, 1, 2))

    exprs = [x for x in (made(source.randint(1, 3)) for _ in range(150)) if sp.fraction(x)[1].is_Add is not True]
    found = [(x, products.multiplied_out(x)) for x in exprs if bounded.terms(x) < 100]
    assert sum(value is not None for _, value in found) > 60
    for expr, value in found:
        assert value is None or value == sp.expand(expr)


SHORT = [a * q**2 / (b * sp.sin(q)), (a + b) / (a * c + b * c), a / (a + b) + b / (a + b), (a**2 - b**2) / (a + b)]


@pytest.mark.parametrize("expr", SHORT)
def test_short_quotients_are_those_of_sympy_and_need_no_count(expr: sp.Expr, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delattr(searches, "_counted")
    assert bounded.cancel(expr) == sp.cancel(expr)
    assert bounded.together(expr) == sp.together(expr)


@pytest.mark.parametrize("expr", [(a**1_000 - b**1_000) / (a - b), sp.sqrt(a + b) / (a + b), (a + sp.exp(b)) / (c + 1)])
def test_high_powers_roots_and_other_functions_are_counted(expr: sp.Expr) -> None:
    assert not searches._is_brief(expr) and not searches._is_product(expr)
