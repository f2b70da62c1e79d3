"""Programs as JavaScript, run in Node, against the graph's interpreter."""

import json
import math
import shutil
import subprocess

import numpy as np
import pytest
from compile_programs import double_pendulum, oracle, program
from test_backends import every_function

from lagrangian.codegen import brief_javascript, to_javascript
from lagrangian.graph import Graph, Output, Program, evaluate
from lagrangian.graph.graph import UNARY

NODE = shutil.which("node")
pytestmark = pytest.mark.skipif(NODE is None, reason="node is not installed")

ODD = (0.0, -0.0, 1.0, -1.0, 0.3, -2.5, 3.0, -3.0, 1e300, -1e300, 5e-324, math.inf, -math.inf, math.nan)
"""Numbers at which operations have rules of their own."""


def called(source: str, name: str, calls) -> list[list[float]]:
    """The results of a function for lists of arguments; numbers travel as text, because JSON has no infinity."""
    words = [[[str(x) for x in a] if isinstance(a, (list, tuple)) else str(a) for a in call] for call in calls]
    code = (
        source + "\nconst number = (x) => Array.isArray(x) ? x.map(number) : "
        'Number(x.replace("inf", "Infinity").replace("nan", "NaN"));\n'
        f"for (const call of {json.dumps(words)}) "
        f'console.log(Array.from({name}(...call.map(number)), String).join(" "));\n'
    )
    done = subprocess.run([NODE, "-"], input=code, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[-2000:]
    return [[float(x) for x in line.split()] for line in done.stdout.splitlines()]


def close(found: float, wanted: float) -> bool:
    if math.isnan(wanted) or math.isinf(wanted):
        return found == wanted or (math.isnan(wanted) and math.isnan(found))
    return abs(found - wanted) <= 4e-16 * 4 * abs(wanted) + 1e-320


def every_operation() -> Program:
    """One output for every operation of the graph, of the numbers a and b."""
    g = Graph()
    a, b = g.input("q", 0), g.input("q", 1)
    rows = [g.unary(name, a) for name in UNARY]
    rows += [getattr(g, name)(a, b) for name in ("add", "sub", "mul", "div", "min", "max", "pow", "atan2")]
    rows += [g.neg(a), g.abs(a), g.sign(a), *(g.powi(a, n) for n in (-3, 2, 7, 70))]
    flags = [g.lt(a, b), g.le(a, b), g.eq(a, b)]
    flags += [g.and_(flags[0], flags[1]), g.or_(flags[0], flags[2]), g.not_(flags[1])]
    rows += [g.select(flag, a, g.const(7.0)) for flag in flags]
    return Program("operations", g, {"q": ("a", "b")}, {"r": Output(tuple(rows), (len(rows),))}, {})


printers = pytest.mark.parametrize("printed", [to_javascript, brief_javascript])


@printers
def test_every_operation_also_where_numbers_are_odd(printed):
    made = every_operation()
    pairs = [(a, b) for a in ODD for b in ODD]
    found = called(printed(made, name="f", checked=False), "f", [[list(pair)] for pair in pairs])
    for pair, row in zip(pairs, found, strict=True):
        wanted = evaluate(made, {"q": pair})["r"]
        for k, (x, y) in enumerate(zip(row, wanted, strict=True)):
            assert close(x, float(y)), (pair, k, made.graph.nodes[made.outputs["r"].ids[k]], x, y)


@printers
def test_every_function_by_hand(printed):
    made = program(every_function, q=("a", "b"), p=("c",))
    q = np.random.default_rng(2).uniform(-3, 3, (40, 2))
    found = called(printed(made, name="f"), "f", [[row.tolist(), [1.7]] for row in q])
    wanted = [oracle(made, {"q": row, "p": [1.7]}) for row in q]
    np.testing.assert_allclose(found, wanted, rtol=1e-12)


def test_time_is_a_number_and_outputs_follow_one_another():
    g = Graph()
    x, t = g.input("q", 0), g.input("t", 0)
    outputs = {"a": Output((g.mul(x, t),), ()), "M": Output((x, t, g.one, g.sin(t)), (2, 2))}
    made = Program("two", g, {"q": ("x",), "t": ("t",)}, outputs, {})
    source = to_javascript(made, name="f")
    assert called(source, "f", [[[3.0], 2.0]]) == [[6.0, 3.0, 2.0, 1.0, pytest.approx(math.sin(2.0), rel=1e-15)]]
    assert "out[0]: a, one number" in source and "out[1] to out[4]: M, 2 x 2, row by row" in source


@printers
def test_a_long_program_is_cut_into_parts(printed):
    g = Graph()
    x = node = g.input("q", 0)
    for k in range(3000):
        node = g.sin(g.add(node, g.const(1.0 + k)))
    chosen = g.select(g.lt(x, g.zero), node, g.mul(node, x))
    made = Program("long", g, {"q": ("x",)}, {"r": Output((chosen, x), (2,))}, {})
    source = printed(made, name="f")
    assert source.count("() => {") + source.count("()=>{") > 1
    for (found, _), x in zip(called(source, "f", [[[0.5]], [[-0.5]]]), (0.5, -0.5), strict=True):
        assert found == pytest.approx(evaluate(made, {"q": [x]})["r"][0], rel=1e-12)


def test_names_of_users_stay_in_comments():
    names = ("class", "__proto__", "</script><script>alert(1)", "*/ alert(2) /*", "\u2028alert(3)", "x\nalert(4)")
    g = Graph()
    ids = tuple(g.mul(g.input("q", k), g.const(2.0)) for k in range(len(names)))
    made = Program("*/ alert(5)", g, {"q": names}, {"</script>": Output(ids, (len(ids),))}, {})
    source = to_javascript(made)
    assert source.isascii() and "</" not in source and source.count("*/") == 1
    assert called(source, "lg_alert_5", [[[1.0] * len(names)]]) == [[2.0] * len(names)]


@pytest.mark.parametrize("name", ["class", "a b", "1x", "é", "await"])
def test_a_word_of_the_language_names_no_function(name):
    with pytest.raises(ValueError, match="cannot name"):
        to_javascript(double_pendulum(), name=name)


@printers
def test_a_result_that_is_not_finite_is_thrown(printed):
    g = Graph()
    made = Program("ratio", g, {"q": ("x",)}, {"r": Output((g.div(g.one, g.input("q", 0)),), ())}, {})
    code = printed(made, name="f") + "\ntry { f([0]); } catch (e) { console.log(e.name, e.message); }"
    done = subprocess.run([NODE, "-e", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "RangeError ratio: a result is not finite"


def test_an_array_that_is_passed_is_filled():
    made = double_pendulum()
    code = to_javascript(made, name="f")
    code += "\nconst out = new Float64Array(2); const r = f([0.1, 0.2], [0, 0], [0], [1, 2, 0.7, 0.9, 9.81], 0, out);"
    done = subprocess.run(
        [NODE, "-e", code + "console.log(r === out, [...out].join(' '))"], capture_output=True, text=True, check=True
    )
    same, *numbers = done.stdout.split()
    wanted = oracle(made, {"q": [0.1, 0.2], "v": [0, 0], "u": [0], "p": [1, 2, 0.7, 0.9, 9.81], "t": [0.0]})
    assert same == "true"
    np.testing.assert_allclose([float(x) for x in numbers], wanted, rtol=1e-12)


def test_in_few_characters_the_numbers_are_the_same_to_the_last_digit():
    made = double_pendulum()
    call = [[[0.1, 0.2], [0.3, -0.4], [0.5], [1, 2, 0.7, 0.9, 9.81], 0]]
    long, short = to_javascript(made, name="f"), brief_javascript(made, name="f")
    assert called(short, "f", call) == called(long, "f", call)
    assert len(short) < 0.5 * len(long)


def test_parentheses_stand_where_order_matters():
    g = Graph()
    a, b, c, d = (g.input("q", k) for k in range(4))
    rows = (
        g.sub(a, g.sub(b, c)), g.mul(a, g.mul(b, c)), g.div(a, g.div(b, c)), g.mul(g.add(a, b), g.sub(c, d)),
        g.neg(g.add(a, b)), g.sub(a, g.neg(g.mul(b, c))), g.add(a, g.add(b, g.add(c, d))),
        g.div(g.mul(a, b), g.mul(c, d)), g.min(g.add(a, b), g.sub(c, d)), g.sqrt(g.add(g.mul(a, a), g.mul(b, b))),
        g.sub(g.mul(a, b), g.mul(c, d)),
    )  # fmt: skip
    made = Program("order", g, {"q": ("a", "b", "c", "d")}, {"r": Output(rows, (len(rows),))}, {})
    q = [[0.1, 0.7, 1.3, 2.9]]
    assert called(brief_javascript(made, name="f"), "f", [q]) == called(to_javascript(made, name="f"), "f", [q])
