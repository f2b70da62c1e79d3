"""Derivatives on the graph, against SymPy and against numerical differentiation by mpmath."""

import mpmath
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from lagrangian.graph import (
    Graph,
    Output,
    Program,
    evaluate,
    from_sympy,
    gradient,
    hessian,
    jacobian,
    jvp,
    vjp,
)
from size import sized

x, y, z = sp.symbols("x y z", real=True)
AT = {x: sp.Rational(3, 7), y: sp.Rational(5, 4), z: sp.Rational(-2, 3)}

FUNCTIONS = [
    x * y + z,
    x - y * z,
    x / (y + z**2),
    x**5 / y**3,
    sp.sqrt(y) * sp.sin(x) * sp.cos(z),
    sp.tan(x) + sp.asin(x) + sp.acos(z) + sp.atan(y),
    sp.sinh(x) * sp.cosh(y) - sp.tanh(z) + sp.asinh(x) + sp.acosh(y) + sp.atanh(z),
    sp.exp(x * z) + sp.log(y),
    y**x + y ** sp.Rational(2, 3) + y**z,
    sp.atan2(y, x) * z,
    sp.Abs(z) * sp.Abs(x),
    sp.sign(z) * x,
    sp.Min(x, y) * sp.Max(y, z),
    sp.Piecewise((x**2, x < y), (y**3, True)) * z,
    sp.Piecewise((x**2, (x > y) | (z > 0)), (y**3 * x, ~(x >= y) & (z < 0)), (sp.S.One, True)),
]


def program(g, ids):
    return Program("t", g, {"x": ("x", "y", "z")}, {"y": Output(tuple(ids), (len(ids),))})


def setup(*exprs):
    g = Graph()
    inputs = [g.input("x", k) for k in range(3)]
    return g, inputs, [from_sympy(g, e, dict(zip((x, y, z), inputs, strict=True))) for e in exprs]


def values(g, ids, at=AT):
    return evaluate(program(g, ids), {"x": [mpmath.mpf(int(at[s].p)) / int(at[s].q) for s in (x, y, z)]}, digits=40)[
        "y"
    ]


def exact(expr, at=AT):
    return mpmath.mpf(str(sp.N(expr.subs(at).doit(), 30)))


@pytest.mark.parametrize("f", FUNCTIONS, ids=str)
def test_value_and_both_modes_against_sympy(f):
    with mpmath.workdps(30):
        g, inputs, (node,) = setup(f)
        wanted = [exact(sp.diff(f, s)) for s in (x, y, z)]
        forward = [jvp(g, [node], {i: g.one})[0] for i in inputs]
        backward = gradient(g, node, inputs)
        got = values(g, [node, *forward, *backward])
        for a, b in zip(got, [exact(f), *wanted, *wanted], strict=True):
            assert abs(a - b) <= 1e-14 * (1 + abs(b))  # constants such as 2/3 are doubles


def test_second_derivatives_against_sympy():
    f = x**2 * sp.sin(y) + sp.exp(x * z) / y
    with mpmath.workdps(30):
        g, inputs, (node,) = setup(f)
        second = hessian(g, node, inputs)
        keys = [(i, k) for i in range(3) for k in range(3)]
        wanted = [exact(sp.diff(f, a, b)) for a in (x, y, z) for b in (x, y, z)]
        got = values(g, [second.get(key, g.zero) for key in keys])
        assert all(abs(a - b) < 1e-14 for a, b in zip(got, wanted, strict=True))


def test_jacobian_holds_only_what_is_not_zero_by_structure():
    g, inputs, ids = setup(x * y, z**2, sp.S(3), x + 0 * z, y)
    assert set(jacobian(g, ids, inputs)) == {(0, 0), (0, 1), (1, 2), (3, 0), (4, 1)}
    assert set(jacobian(g, ids[:2], inputs)) == {(0, 0), (0, 1), (1, 2)}


def test_nodes_of_which_one_is_computed_from_another_count_as_independent():
    """f = c·(x·x) + (c·x)·y with m = c·x cut out is c x² + m y: its Hessian over (x, y, m) is known by hand."""
    g = Graph()
    c, x, y = (g.input("x", i) for i in range(3))
    m = g.mul(c, x)
    f = g.add(g.mul(c, g.mul(x, x)), g.mul(m, y))
    two_c, one = g.mul(g.const(2.0), c), g.one
    assert hessian(g, f, [x, y, m]) == {(0, 0): two_c, (1, 2): one, (2, 1): one}
    columns = jacobian(g, [m, y, g.mul(m, x)], [x, m])  # more rows than columns: forwards
    assert columns == {(0, 1): one, (2, 0): m, (2, 1): x}
    assert jacobian(g, [g.mul(m, x)], [x, m]) == {(0, 0): m, (0, 1): x}  # backwards


def test_derivatives_with_respect_to_nodes_inside():
    g, inputs, (inner,) = setup(x * y)
    outer = g.mul(g.sin(inner), inputs[0])
    assert gradient(g, outer, [inner]) == [g.mul(g.cos(inner), inputs[0])]
    assert jvp(g, [outer], {inner: g.one}) == [g.mul(g.cos(inner), inputs[0])]


def test_slope_of_abs_is_zero_at_zero_and_that_of_a_power_is_finite():
    g, inputs, ids = setup(sp.Abs(x), x**2, x**y)
    at = {x: sp.Integer(0), y: sp.Integer(2), z: sp.Integer(0)}
    slopes = [gradient(g, i, inputs)[0] for i in ids]
    assert values(g, [*slopes, gradient(g, ids[2], inputs)[1]], at) == [0, 0, 0, 0]


def test_vjp_of_many_outputs_adds():
    g, inputs, ids = setup(x * y, y * z)
    weights = [g.const(2.0), g.const(3.0)]
    got = vjp(g, ids, weights, inputs)
    with mpmath.workdps(30):
        expected = [2 * exact(y), 2 * exact(x) + 3 * exact(z), 3 * exact(y)]
        assert all(abs(a - b) < 1e-25 for a, b in zip(values(g, got), expected, strict=True))


steps = st.lists(
    st.tuples(
        st.sampled_from(["add", "sub", "mul", "div", "sin", "exp", "atan", "tanh"]),
        st.integers(0, 99),
        st.integers(0, 99),
    ),
    min_size=1,
    max_size=12,
)


@sized(60, 12)
@given(steps, st.lists(st.floats(0.3, 1.5), min_size=3, max_size=3))
def test_random_expressions_against_numerical_differentiation(steps, at):
    g = Graph()
    ids = [g.input("x", k) for k in range(3)]
    inputs = list(ids)
    for op, a, b in steps:
        a, b = ids[a % len(ids)], ids[b % len(ids)]
        if op == "div":
            node = g.div(a, g.add(g.const(1.5), g.mul(b, b)))
        elif op in ("add", "sub", "mul"):
            node = getattr(g, op)(a, b)
        else:
            node = getattr(g, op)(g.tanh(a) if op == "exp" else a)
        ids.append(node)
    last = ids[-1]

    def f(t):
        moved = [mpmath.mpf(at[0]) + t, at[1], at[2]]
        return evaluate(program(g, [last]), {"x": moved}, digits=60)["y"][0]

    with mpmath.workdps(60):
        numeric = mpmath.diff(f, 0, h=mpmath.mpf(10) ** -20)
        got = evaluate(program(g, gradient(g, last, inputs)), {"x": at}, digits=60)["y"][0]
        tangent = evaluate(program(g, jvp(g, [last], {inputs[0]: g.one})), {"x": at}, digits=60)["y"][0]
        assert abs(got - numeric) <= 1e-15 * (1 + abs(numeric))
        assert abs(got - tangent) <= 1e-15 * (1 + abs(numeric))
