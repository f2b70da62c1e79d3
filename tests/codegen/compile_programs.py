"""Programs for the tests: a few made by hand, random ones, and what rounding may do to their results."""

import mpmath
from hypothesis import strategies as st

from lagrangian.graph import Graph, Output, Program, Scalar, evaluate

EPS = mpmath.mpf(2) ** -52


def program(build, **groups):
    """``build(graph, entry scalars by name) → {output: Scalar or nested list}`` as a Program."""
    graph = Graph()
    symbols = {
        name: Scalar(graph, graph.input(group, k)) for group, names in groups.items() for k, name in enumerate(names)
    }
    outputs = {}
    for name, value in build(graph, symbols).items():
        shape, flat = (), value
        if isinstance(value, list):
            nested = isinstance(value[0], list)
            shape = (len(value), len(value[0])) if nested else (len(value),)
            flat = [x for row in value for x in row] if nested else value
        ids = tuple(x.id for x in flat) if isinstance(flat, list) else (flat.id,)
        outputs[name] = Output(ids, shape)
    return Program("test", graph, {g: tuple(n) for g, n in groups.items()}, outputs, {})


def double_pendulum(defaults=(1.0, 2.0, 0.7, 0.9, 9.81)):
    """Point masses, absolute angles.

    M q̈ = h with M = [[(m1+m2) l1², m2 l1 l2 c], [·, m2 l2²]], solved by Cramer's rule.
    """

    def build(graph, x):
        m1, m2, l1, l2, g = (x[n] for n in ("m1", "m2", "l1", "l2", "g"))
        a, b, va, vb = x["a"], x["b"], x["va"], x["vb"]
        s, c = (a - b).apply("sin"), (a - b).apply("cos")
        m11, m12, m22 = (m1 + m2) * l1 * l1, m2 * l1 * l2 * c, m2 * l2 * l2
        h1 = x["tau"] - m2 * l1 * l2 * s * vb * vb - (m1 + m2) * g * l1 * a.apply("sin")
        h2 = m2 * l1 * l2 * s * va * va - m2 * g * l2 * b.apply("sin")
        det = m11 * m22 - m12 * m12
        return {"acc": [(h1 * m22 - h2 * m12) / det, (m11 * h2 - m12 * h1) / det]}

    names = ("m1", "m2", "l1", "l2", "g")
    made = program(build, q=("a", "b"), v=("va", "vb"), u=("tau",), p=names, t=("t",))
    return Program("double pendulum", made.graph, made.inputs, made.outputs, dict(zip(names, defaults, strict=True)))


UNARY = ("sin", "cos", "tan", "atan", "tanh", "asinh", "abs", "sign", "neg")
BINARY = ("add", "sub", "mul", "min", "max", "atan2")


@st.composite
def random_programs(draw, size=40):
    """A random program over groups q (3), p (2) and t, every operation of the graph among its nodes."""
    graph = Graph()
    names = {"q": ("x", "y", "z"), "p": ("k", "m"), "t": ("t",)}
    nodes = [graph.input(g, i) for g, entries in names.items() for i in range(len(entries))]
    nodes += [graph.const(c) for c in (1.0, 0.5, -2.25, 3.0)]
    one = graph.one

    def pick():  # mostly recent nodes, so that programs are deep
        places = st.integers(0, len(nodes) - 1)
        return nodes[-1 - min(draw(places), draw(places))]

    for _ in range(draw(st.integers(3, size))):
        a, b = pick(), pick()
        kind = draw(st.sampled_from([*UNARY, *BINARY, *BINARY, "div", "safe", "powi", "select", "sincos"]))
        if kind in UNARY or kind in BINARY:
            nodes.append(getattr(graph, kind)(a) if kind in UNARY else getattr(graph, kind)(a, b))
        elif kind == "div":
            nodes.append(graph.div(a, graph.add(graph.mul(b, b), one)))
        elif kind == "safe":  # functions with a bounded domain, brought inside it
            inside = graph.div(a, graph.sqrt(graph.add(graph.mul(a, a), graph.const(2.0))))
            which = draw(
                st.sampled_from(["asin", "acos", "atanh", "exp", "sinh", "cosh", "sqrt", "log", "acosh", "pow"])
            )
            above = graph.add(graph.mul(inside, inside), graph.const(1.5))
            if which == "pow":
                nodes.append(
                    graph.pow(above, draw(st.sampled_from([b, graph.const(1.5), graph.const(-2.5), graph.const(0.3)])))
                )
            else:
                nodes.append(getattr(graph, which)(above if which in ("sqrt", "log", "acosh") else inside))
        elif kind == "powi":
            nodes.append(graph.powi(graph.add(graph.mul(a, a), one), draw(st.integers(-5, 7))))
        elif kind == "select":
            truth = getattr(graph, draw(st.sampled_from(["lt", "le", "eq"])))(a, b)
            other = graph.lt(pick(), pick())
            truth = draw(st.sampled_from([truth, graph.not_(truth), graph.and_(truth, other), graph.or_(truth, other)]))
            nodes.append(graph.select(truth, pick(), pick()))
        else:
            nodes += [graph.sin(a), graph.cos(a)]
    ids = tuple(draw(st.lists(st.sampled_from(nodes[-12:]), min_size=1, max_size=4)))
    outputs = {"f": Output(ids, (len(ids),)), "g": Output((nodes[-1],), ())}
    return Program("random", graph, names, outputs, {"k": 0.75, "m": None})


SLOPE = {
    "sin": mpmath.cos,
    "cos": mpmath.sin,
    "tan": lambda a: 1 + mpmath.tan(a) ** 2,
    "asin": lambda a: 1 / mpmath.sqrt(1 - a * a),
    "acos": lambda a: 1 / mpmath.sqrt(1 - a * a),
    "atan": lambda a: 1 / (1 + a * a),
    "sinh": mpmath.cosh,
    "cosh": mpmath.sinh,
    "tanh": lambda a: 1 - mpmath.tanh(a) ** 2,
    "asinh": lambda a: 1 / mpmath.sqrt(1 + a * a),
    "acosh": lambda a: 1 / mpmath.sqrt(a * a - 1),
    "atanh": lambda a: 1 / (1 - a * a),
    "exp": mpmath.exp,
    "log": lambda a: 1 / a,
    "sqrt": lambda a: 1 / (2 * mpmath.sqrt(a)) if a else mpmath.inf,
    "abs": lambda a: 1,
    "neg": lambda a: 1,
    "sign": lambda a: 0,
}


class Ambiguous(Exception):
    """A condition hangs on rounding: either branch is right."""


def rounding(made, inputs):
    """For each output, in order: the exact value, and how much rounding may add up to (Wilkinson's running error
    bound).

    Every operation contributes four units in the last place of its result and carries its operands' errors on by its
    slopes; the bound holds for any order of fused or separate rounding.
    """
    from lagrangian.graph import reached
    from lagrangian.graph.evaluate import MANY_DIGITS

    value, error = {}, {}
    nodes = made.graph.nodes
    with mpmath.workdps(50):
        for i in reached(made.graph, made.ids):
            op, *rest = nodes[i]
            if op in ("const", "input"):
                value[i], error[i] = mpmath.mpf(rest[0] if op == "const" else inputs[rest[0]][rest[1]]), mpmath.mpf(0)
                continue
            if op == "powi":
                a, n = rest
                value[i] = MANY_DIGITS[op](value[a], n)
                error[i] = error[a] * abs(n * MANY_DIGITS[op](value[a], n - 1)) + abs(n) * EPS * abs(value[i])
                continue
            v, e = [value[k] for k in rest], [error[k] for k in rest]
            value[i] = MANY_DIGITS[op](*v)
            error[i] = _carried(op, v, e)
            if op not in ("lt", "le", "eq", "and", "or", "not"):
                if not mpmath.isfinite(value[i]) or abs(value[i]) > 1e100:
                    raise Ambiguous
                error[i] += 4 * EPS * abs(value[i])
        return [(value[i], error[i]) for i in made.ids]


def _carried(op, v, e):
    """What an operation's operands' errors become in its result, to first order."""
    if op in SLOPE:
        if op == "sign" and abs(v[0]) <= 2 * e[0] and e[0]:
            raise Ambiguous
        return abs(SLOPE[op](v[0])) * e[0]
    if op in ("add", "sub", "min", "max"):
        return e[0] + e[1]
    if op == "mul":
        return abs(v[0]) * e[1] + abs(v[1]) * e[0]
    if op == "div":
        return (e[0] + abs(v[0] / v[1]) * e[1]) / abs(v[1])
    if op == "pow":
        return abs(v[0] ** v[1]) * (abs(v[1] / v[0]) * e[0] + abs(mpmath.log(v[0])) * e[1])
    if op == "atan2":
        distance = v[0] ** 2 + v[1] ** 2
        if distance == 0 or (v[1] <= 0 and abs(v[0]) <= 2 * e[0]):  # at the origin, or across the cut
            raise Ambiguous
        return (abs(v[1]) * e[0] + abs(v[0]) * e[1]) / distance
    if op in ("lt", "le", "eq"):
        if abs(v[0] - v[1]) <= 2 * (e[0] + e[1]) and e[0] + e[1]:
            raise Ambiguous
        return 0
    if op == "select":
        return e[1] if v[0] else e[2]
    return 0


def flat(results):
    """Outputs of the interpreter or of a kernel as one list of numbers."""
    if isinstance(results, dict):
        return [x for value in results.values() for x in flat(value)]
    if isinstance(results, list):
        return [x for value in results for x in flat(value)]
    return [float(x) for x in getattr(results, "ravel", lambda: [results])()]


def oracle(made, inputs):
    """The interpreter's answer as a flat list."""
    return flat(evaluate(made, inputs))
