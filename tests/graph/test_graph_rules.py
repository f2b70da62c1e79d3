"""What is rewritten when a node is made."""

import math

import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from effort import at_most
from lagrangian.errors import ModelError, RunError
from lagrangian.graph import Graph, Output, Program, Scalar, Valuation, count_operations, evaluate, to_sympy
from size import sized


def value(graph, node, **inputs):
    names = {k: tuple(f"{k}{i}" for i in range(len(v))) for k, v in inputs.items()}
    return evaluate(Program("t", graph, names, {"y": Output((node,), ())}), inputs)["y"]


def test_equal_pairs_are_one_node():
    g = Graph()
    x, y = g.input("x", 0), g.input("x", 1)
    assert g.add(x, y) == g.add(y, x)
    assert g.mul(x, y) == g.mul(y, x)
    assert g.sub(x, y) != g.sub(y, x)
    assert g.sub(y, x) == g.neg(g.sub(x, y))


def test_local_rules():
    g = Graph()
    x, y = g.input("x", 0), g.input("x", 1)
    assert g.mul(g.zero, x) == g.zero
    assert g.mul(g.one, x) == g.add(x, g.zero) == g.div(x, g.one) == g.powi(x, 1) == x
    assert g.sub(x, x) == g.zero
    assert g.div(x, x) == g.powi(x, 0) == g.one
    assert g.neg(g.neg(x)) == x
    assert g.add(x, g.neg(y)) == g.sub(x, y)
    assert g.sub(x, g.neg(y)) == g.add(x, y)
    assert g.mul(g.neg(x), g.neg(y)) == g.mul(x, y)
    assert g.cos(g.neg(x)) == g.cos(x)
    assert g.sin(g.neg(x)) == g.neg(g.sin(x))
    assert g.mul(g.const(2.0), g.mul(g.const(3.0), x)) == g.mul(g.const(6.0), x)
    assert g.value(g.add(g.const(2.0), g.const(3.0))) == 5.0
    assert g.abs(g.neg(g.abs(x))) == g.abs(x)
    assert g.pow(x, g.const(0.5)) == g.sqrt(x)
    assert g.pow(x, g.const(3.0)) == g.powi(x, 3)
    assert g.powi(g.neg(x), 3) == g.neg(g.powi(x, 3))


def test_conditions_that_are_known_disappear():
    g = Graph()
    x, y = g.input("x", 0), g.input("x", 1)
    c = g.lt(x, y)
    yes, no = g.lt(g.one, g.const(2.0)), g.le(x, x)
    assert g.select(yes, x, y) == x
    assert g.select(g.not_(yes), x, y) == y
    assert g.and_(yes, c) == c == g.or_(g.not_(no), c)
    assert g.select(g.not_(c), x, y) == g.select(c, y, x)
    assert g.not_(g.not_(c)) == c


def test_what_is_infinite_or_undefined_is_kept_for_the_evaluation():
    g = Graph()
    assert g.nodes[g.div(g.one, g.zero)][0] == "div"
    assert g.nodes[g.sqrt(g.const(-1.0))][0] == "sqrt"
    assert g.nodes[g.exp(g.const(1e4))][0] == "exp"
    assert math.isnan(value(g, g.sqrt(g.const(-1.0))))
    assert value(g, g.div(g.negative, g.zero)) == -math.inf


def test_not_a_number_is_refused():
    with pytest.raises(ModelError, match="not a number"):
        Graph().const(math.nan)


def test_an_output_needs_as_many_ids_as_its_shape():
    with pytest.raises(ValueError, match="needs 4 ids, not 1"):
        Output((0,), (2, 2))


def test_wrong_inputs_are_named():
    g = Graph()
    program = Program("t", g, {"p": ("m", "k")}, {"y": Output((g.input("p", 0),), ())}, {"m": 2.0, "k": None})
    with pytest.raises(RunError, match="k have no value"):
        evaluate(program, {})
    with pytest.raises(RunError, match="'p' has 1 values, 2 are needed: m, k"):
        evaluate(program, {"p": [1.0]})


def test_outputs_are_nested_by_shape():
    g = Graph()
    ids = tuple(g.const(float(k)) for k in range(6))
    program = Program("t", g, {}, {"y": Output(ids, (2, 3)), "none": Output((), (0,))})
    assert evaluate(program, {}) == {"y": [[0.0, 1.0, 2.0], [3.0, 4.0, 5.0]], "none": []}


def test_operations_are_counted_without_leaves_and_with_hoisting():
    g = Graph()
    x, p = g.input("x", 0), g.input("p", 0)
    y = g.add(g.mul(g.sin(x), g.mul(p, p)), g.powi(g.cos(x), 5))
    assert count_operations(g, [y]) == type(count_operations(g, [y]))(6, 1, 0)
    hoisted = count_operations(g, [y], hoist=["p"])
    assert (hoisted.operations, hoisted.sincos, hoisted.prologue) == (5, 1, 1)


steps = st.lists(
    st.tuples(st.sampled_from(["add", "sub", "mul", "neg", "sin", "cos"]), st.integers(0, 99), st.integers(0, 99))
)


@sized(150, 40)
@given(steps, st.lists(st.floats(-2, 2), min_size=3, max_size=3))
def test_rewriting_keeps_the_value(steps, x):
    g = Graph()
    ids = [g.zero, g.one, g.negative, *(g.input("x", k) for k in range(3))]
    plain = [0.0, 1.0, -1.0, *x]
    size = [0.0, 1.0, 1.0, *(abs(v) for v in x)]
    for op, a, b in steps:
        a, b = a % len(ids), b % len(ids)
        arguments = (ids[a], ids[b]) if op in ("add", "sub", "mul") else (ids[a],)
        ids.append(getattr(g, op)(*arguments))
        p, q = plain[a], plain[b]
        exact = {"add": p + q, "sub": p - q, "mul": p * q, "neg": -p}.get(op)
        plain.append(exact if exact is not None else getattr(math, op)(p))
        size.append(size[a] * size[b] + size[a] + size[b] + 1)
        if abs(plain[-1]) > 1e6 or size[-1] > 1e12:
            break
    assert value(g, ids[-1], x=x) == pytest.approx(plain[-1], rel=1e-9, abs=1e-12 * size[-1])
    for k, node in enumerate(g.nodes):
        assert all(i < k for i in node[1:] if isinstance(i, int) and node[0] not in ("const", "input"))


def test_scalar_reads_like_a_formula():
    g = Graph()
    x, y = Scalar(g, g.input("x", 0)), Scalar(g, g.input("x", 1))
    f = (1 - 2 * x) / y + abs(-y) ** 3 - y.apply("atan2", x) + 2 / x - (x - 1) ** 0.5
    expected = (1 - 2 * 3.0) / 2.0 + 8.0 - math.atan2(2.0, 3.0) + 2 / 3.0 - math.sqrt(2.0)
    assert value(g, f.id, x=[3.0, 2.0]) == pytest.approx(expected, rel=1e-14)
    with pytest.raises(ValueError, match="different graphs"):
        x + Scalar(Graph(), 0)


def test_to_sympy_and_its_numbers():
    g = Graph()
    x = g.input("x", 0)
    s = sp.Symbol("s", positive=True)
    node = g.add(g.mul(g.const(0.1), g.powi(x, 3)), g.select(g.lt(x, g.one), g.sqrt(x), g.const(1 / 3)))
    expected = s**3 / 10 + sp.Piecewise((sp.sqrt(s), s < 1), (sp.Rational(1, 3), True))
    assert to_sympy(g, node, {x: s}) == expected


def test_a_node_costs_the_same_few_calls_however_many_there_are():
    g = Graph()
    x = [g.input("x", k) for k in range(50)]
    costs = []
    for _ in range(3):
        before = len(g)
        with at_most(200_000) as effort:
            for k in range(5_000):
                x.append(g.mul(x[-1], x[-37]) if k % 2 else g.add(x[-1], x[-23]))
        costs.append(effort.calls / (len(g) - before))
    assert max(costs) < 8 and max(costs) < 1.05 * min(costs)


class CountedReads(list):
    """Numbers that count how often they are read."""

    reads = 0

    def __getitem__(self, k):
        self.reads += 1
        return super().__getitem__(k)


def test_a_graph_that_grows_is_computed_only_where_it_grew():
    """Against the evaluation of the whole program, infinite values included."""
    g = Graph()
    x, y = g.input("x", 0), g.input("x", 1)
    given = CountedReads([0.7, 0.0])
    at = Valuation(g, {"x": given})
    first = [g.sin(x), g.powi(g.add(x, y), -3), g.div(x, y), g.log(y), g.select(g.lt(x, y), x, g.exp(y))]
    assert at(first) == [value(g, node, x=[0.7, 0.0]) for node in first]
    later = g.mul(first[0], g.atan2(first[2], x))
    assert at([later]) == [value(g, later, x=[0.7, 0.0])]
    assert given.reads == 2
