"""SymPy to graph and back, and evaluation, against SymPy's own numbers and mpmath."""

import math

import mpmath
import numpy as np
import pytest
import sympy as sp
from sympy.physics.mechanics import dynamicsymbols

from lagrangian.errors import ModelError
from lagrangian.graph import Graph, Output, Program, evaluate, from_sympy, to_sympy
from lagrangian.graph.graph import UNARY
from lagrangian.graph.together import evaluate_together

a, b = sp.symbols("a b", real=True)
q = dynamicsymbols("q")
t = dynamicsymbols._t

EXPRESSIONS = [
    sp.Rational(1, 3) * a + sp.pi * b - sp.E,
    -a * b / (2 * (a + b) ** 3),
    (a**2 + b**2) ** sp.Rational(-3, 2),
    (a + 2) ** sp.Rational(5, 2) * sp.sqrt(b),
    a ** sp.Rational(1, 3) - b**a,
    sp.sec(a) + sp.csc(b) + sp.cot(a) + sp.sech(b) + sp.csch(a) + sp.coth(b),
    sp.log(a, 3) + sp.exp(-b),
    sp.Min(a, b, 1) + sp.Max(a, -b, sp.Rational(1, 7)),
    sp.Piecewise((a, a > b), (b, sp.Ne(a, b) & (a <= 1)), (3, True)),
    sp.Piecewise((1, sp.Eq(a, b) | (a >= 2)), (2, True)),
    sp.Abs(a - b) * sp.sign(b - a) + sp.atan2(-a, b),
    sp.Heaviside(a - b) + sp.Heaviside(b - a),
    q.diff(t) * sp.cos(q),
]


def numbers(g, node, inputs, **options):
    names = tuple(f"x{k}" for k in range(len(inputs)))
    return evaluate(Program("t", g, {"x": names}, {"y": Output((node,), ())}), {"x": inputs}, **options)["y"]


@pytest.mark.parametrize("expr", EXPRESSIONS, ids=str)
def test_values_and_the_way_back(expr):
    g = Graph()
    symbols = [a, b, q, q.diff(t)]
    table = {s: g.input("x", k) for k, s in enumerate(symbols)}
    node = from_sympy(g, expr, table)
    at = [0.7, 1.9, 0.4, -1.3]
    pairs = list(zip(reversed(symbols), reversed(at), strict=True))
    expected = float(sp.N(expr.subs(pairs), 20))
    assert numbers(g, node, at) == pytest.approx(expected, rel=1e-14)
    back = to_sympy(g, node, {n: s for s, n in table.items()})
    assert float(sp.N(back.subs(pairs), 20)) == pytest.approx(expected, rel=1e-13)


def test_equal_subexpressions_are_converted_once():
    g = Graph()
    table = {a: g.input("x", 0), b: g.input("x", 1)}
    memo = {}
    shared = sp.sin(a * b) + a
    first = from_sympy(g, shared**2 + shared, table, memo)
    size = len(g)
    assert from_sympy(g, shared, table, memo) < first
    assert len(g) == size


def test_quotients_and_differences_are_not_detours():
    g = Graph()
    table = {a: g.input("x", 0), b: g.input("x", 1)}
    x, y = table[a], table[b]
    assert g.nodes[from_sympy(g, a / b, table)] == ("div", x, y)
    assert g.nodes[from_sympy(g, a - b, table)] == ("sub", x, y)


@pytest.mark.slow
def test_very_deep_and_very_long_expressions():
    g = Graph()
    table = {a: g.input("x", 0)}
    deep = a
    for _ in range(3000):
        deep = sp.sin(deep, evaluate=False)
        hash(deep)  # SymPy hashes without recursion only what is hashed from the inside out
    expected = 0.5
    for _ in range(3000):
        expected = math.sin(expected)
    assert numbers(g, from_sympy(g, deep, table), [0.5]) == pytest.approx(expected, rel=1e-12)
    long = sp.Add(*[sp.sin(k * a) for k in range(3000)])
    expected = math.fsum(math.sin(k * 0.5) for k in range(3000))
    assert numbers(g, from_sympy(g, long, table), [0.5]) == pytest.approx(expected, rel=1e-10)


@pytest.mark.parametrize(
    ("expr", "message"),
    [
        (sp.Symbol("lenght") * a, "symbol 'lenght' has no value"),
        (q, r"symbol 'q\(t\)' has no value"),
        (q.diff(t), "derivative 'Derivative"),
        (sp.gamma(a), "function 'gamma' is not supported"),
        (sp.Piecewise((a, a > 0)), "no value where none of its conditions"),
        (a + sp.oo * sp.I, "contains I"),
        (sp.Integer(10) ** 400 * a, "larger than the largest floating-point number"),
    ],
    ids=["symbol", "function of time", "rate", "function", "piecewise", "complex", "huge"],
)
def test_what_cannot_be_converted_is_named(expr, message):
    g = Graph()
    with pytest.raises(ModelError, match=message):
        from_sympy(g, expr, {a: g.input("x", 0), sp.Symbol("length"): g.input("x", 1)})


def test_a_near_miss_is_suggested():
    g = Graph()
    with pytest.raises(ModelError) as caught:
        from_sympy(g, sp.Symbol("lenght"), {sp.Symbol("length"): g.input("x", 1)})
    assert "Did you mean 'length'?" in str(caught.value)


@pytest.mark.parametrize("name", sorted(UNARY))
def test_functions_in_doubles_and_in_many_digits(name):
    g = Graph()
    node = g.unary(name, g.input("x", 0))
    x = 1.3 if name == "acosh" else 0.37
    expected = getattr(mpmath, name)(mpmath.mpf(x))
    assert numbers(g, node, [x]) == pytest.approx(float(expected), rel=4e-16)
    with mpmath.workdps(40):
        expected = getattr(mpmath, name)(mpmath.mpf(x))
        assert abs(numbers(g, node, [x], digits=40) - expected) < mpmath.mpf(10) ** -38


def test_the_ends_of_the_domains_are_ieee():
    g = Graph()
    x, y = g.input("x", 0), g.input("x", 1)
    assert numbers(g, g.log(x), [0.0, 0.0]) == -math.inf
    assert math.isnan(numbers(g, g.log(x), [-1.0, 0.0]))
    assert numbers(g, g.exp(x), [1e4, 0.0]) == math.inf
    assert numbers(g, g.sinh(x), [-1e4, 0.0]) == -math.inf
    assert numbers(g, g.atanh(x), [-1.0, 0.0]) == -math.inf
    assert math.isnan(numbers(g, g.sin(x), [math.inf, 0.0]))
    assert math.isnan(numbers(g, g.div(x, y), [0.0, 0.0]))
    assert numbers(g, g.div(x, y), [1.0, -0.0]) == -math.inf
    assert math.isnan(numbers(g, g.pow(x, y), [-2.0, 0.5]))
    assert numbers(g, g.pow(x, y), [-0.0, -1.0]) == -math.inf
    assert numbers(g, g.powi(x, -3), [0.0, 0.0]) == math.inf
    assert math.isnan(numbers(g, g.sqrt(x), [-1.0, 0.0], digits=30))


def test_many_places_at_once_have_the_values_of_each():
    """Conditions, poles, what is outside a domain and what overflows included."""
    g = Graph()
    x, y = g.input("x", 0), g.input("x", 1)
    unary = [g.unary(name, x) for name in (*UNARY, "abs", "sign")]
    binary = [op(x, y) for op in (g.add, g.sub, g.mul, g.div, g.pow, g.min, g.max, g.atan2)]
    chosen = [g.select(g.or_(g.and_(g.lt(x, y), g.not_(g.eq(x, y))), g.le(y, g.zero)), x, g.neg(y))]
    ids = (*unary, *binary, *chosen, *(g.powi(x, n) for n in (-3, -2, 3)), g.one, g.div(g.one, g.powi(y, 2)))
    places = [(a, b) for a in (-2.5, -1.0, -0.0, 0.0, 0.4, 1.0, 3.0, 800.0, math.nan) for b in (-2.0, 0.0, 0.5, 3.0)]
    program = Program("t", g, {"x": ("a", "b")}, {"y": Output(ids, (len(ids),)), "z": Output(ids[:1], ())})
    found = evaluate_together(program, {"x": list(np.array(places).T)})
    each = [evaluate(program, {"x": place}) for place in places]
    np.testing.assert_allclose(found["y"], np.array([row["y"] for row in each], float), rtol=1e-14)
    np.testing.assert_allclose(found["z"], np.array([row["z"] for row in each], float), rtol=1e-14)
