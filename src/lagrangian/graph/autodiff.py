"""Derivatives on the graph: forward tangents, reverse cotangents, and what is made of them.

Both visit only active nodes, which lie between the outputs and the nodes that are varied. With y = f(x),

    jvp:  ẏ = Σ_k ∂f/∂x_k ẋ_k        vjp:  x̄_k = Σ_i ȳ_i ∂f_i/∂x_k

The varied nodes may be any nodes, not only inputs. They are treated as independent of each other, even if one is
computed from another, and nodes behind them are not visited. At a kink the derivative is that of the branch that is
evaluated; abs has slope sign(a), which is 0 at 0.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from lagrangian.graph.graph import CONDITIONS, Graph, Node, operands
from lagrangian.graph.program import reached
from lagrangian.graph.replace import replaced

Partial = Callable[[Graph, int, int], int]

# f′(a), given the graph, a and y = f(a)
SLOPES: dict[str, Partial] = {
    "sqrt": lambda g, a, y: g.div(g.const(0.5), y),
    "sin": lambda g, a, y: g.cos(a),
    "cos": lambda g, a, y: g.neg(g.sin(a)),
    "tan": lambda g, a, y: g.add(g.one, g.mul(y, y)),
    "asin": lambda g, a, y: g.div(g.one, g.sqrt(g.sub(g.one, g.mul(a, a)))),
    "acos": lambda g, a, y: g.div(g.negative, g.sqrt(g.sub(g.one, g.mul(a, a)))),
    "atan": lambda g, a, y: g.div(g.one, g.add(g.one, g.mul(a, a))),
    "sinh": lambda g, a, y: g.cosh(a),
    "cosh": lambda g, a, y: g.sinh(a),
    "tanh": lambda g, a, y: g.sub(g.one, g.mul(y, y)),
    "asinh": lambda g, a, y: g.div(g.one, g.sqrt(g.add(g.mul(a, a), g.one))),
    "acosh": lambda g, a, y: g.div(g.one, g.mul(g.sqrt(g.sub(a, g.one)), g.sqrt(g.add(a, g.one)))),
    "atanh": lambda g, a, y: g.div(g.one, g.sub(g.one, g.mul(a, a))),
    "exp": lambda g, a, y: y,
    "log": lambda g, a, y: g.div(g.one, a),
    "abs": lambda g, a, y: g.sign(a),
    "sign": lambda g, a, y: g.zero,
}


def _power_slopes(g: Graph, node: Node, y: int) -> tuple[int, int]:
    """∂(a^b)/∂a = b a^(b−1) and ∂(a^b)/∂b = a^b ln a."""
    a, b = node[1], node[2]
    base = g.mul(b, g.pow(a, g.sub(b, g.one)))
    if g.value(b) is not None:
        return base, g.zero
    # 0^b does not depend on b for b > 0, and ln 0 · 0 would be NaN
    log = g.select(g.eq(a, g.zero), g.zero, g.mul(y, g.log(a)))
    return base, log


def slopes(g: Graph, i: int) -> tuple[int, ...]:
    """∂(node i)/∂(each operand), as nodes."""
    node = g.nodes[i]
    op = node[0]
    if op in SLOPES:
        return (SLOPES[op](g, node[1], i),)
    if op == "add":
        return g.one, g.one
    if op == "sub":
        return g.one, g.negative
    if op == "mul":
        return node[2], node[1]
    if op == "neg":
        return (g.negative,)
    if op == "div":
        return g.div(g.one, node[2]), g.neg(g.div(i, node[2]))
    if op == "powi":
        return (g.mul(g.const(float(node[2])), g.powi(node[1], node[2] - 1)),)
    if op == "pow":
        return _power_slopes(g, node, i)
    if op == "atan2":  # ∂/∂y = x/(x² + y²), ∂/∂x = −y/(x² + y²)
        y, x = node[1], node[2]
        square = g.add(g.mul(x, x), g.mul(y, y))
        return g.div(x, square), g.neg(g.div(y, square))
    if op in ("min", "max"):
        a, b = node[1], node[2]
        first = g.le(a, b) if op == "min" else g.le(b, a)
        return g.select(first, g.one, g.zero), g.select(first, g.zero, g.one)
    if op == "select":
        c = node[1]
        return g.zero, g.select(c, g.one, g.zero), g.select(c, g.zero, g.one)
    return tuple(g.zero for _ in operands(node))  # conditions are piecewise constant


def jvp(graph: Graph, outputs: Sequence[int], tangents: Mapping[int, int]) -> list[int]:
    """The tangents of ``outputs`` when every node x of ``tangents`` has the tangent ``tangents[x]``.

    A tangent is stored as a factor times a base until two bases meet: the tangent of L sin φ becomes (L cos φ)·φ̇ and
    not L·(cos φ·φ̇). Then the factor depends only on positions, and is often a node that already exists.
    """
    return Tangents(graph, tangents)(outputs)


class Tangents:
    """`jvp` for one direction and many calls; earlier results are reused."""

    def __init__(self, graph: Graph, tangents: Mapping[int, int]) -> None:
        self._graph = graph
        self._seen: set[int] = set(tangents)
        self._moving: dict[int, Tangent] = {x: (graph.one, t) for x, t in tangents.items() if t != graph.zero}

    def __call__(self, outputs: Sequence[int]) -> list[int]:
        """The tangents of ``outputs``."""
        graph, seen, moving = self._graph, self._seen, self._moving
        nodes = graph.nodes
        fresh: list[tuple[int, tuple[int, ...]]] = []
        stack = list(outputs)
        while stack:
            i = stack.pop()
            if i not in seen:
                seen.add(i)
                if ids := operands(nodes[i]):
                    fresh.append((i, ids))
                    stack.extend(ids)
        fresh.sort()
        for i, ids in fresh:
            active = [k for k, a in enumerate(ids) if a in moving]
            if active and (t := _tangent(graph, i, ids, active, moving)) is not None:
                moving[i] = t
        return [_value(graph, moving[i]) if i in moving else graph.zero for i in outputs]


Tangent = tuple[int, int]
"""A pair (factor, base) whose product is the tangent."""


def _value(g: Graph, tangent: Tangent) -> int:
    """factor · base; (x b)·b becomes x·b², because b² can be shared by all components of a rotating vector."""
    factor, base = tangent
    node = g.nodes[factor]
    if node[0] == "neg":
        return g.neg(_value(g, (node[1], base)))
    if node[0] == "mul" and base in node[1:] and g.value(base) is None:
        other = node[1] if node[2] == base else node[2]
        return g.mul(other, g.mul(base, base))
    return g.mul(factor, base)


def _joined(g: Graph, a: Tangent | None, b: Tangent | None) -> Tangent | None:
    """The sum of two tangents."""
    if a is None or b is None:
        return b if a is None else a
    if a[1] == b[1]:
        factor = g.add(a[0], b[0])
        return None if factor == g.zero else (factor, a[1])
    total = g.add(_value(g, a), _value(g, b))
    return None if total == g.zero else (g.one, total)


def _tangent(
    g: Graph, i: int, ids: tuple[int, ...], active: Sequence[int], moving: Mapping[int, Tangent]
) -> Tangent | None:
    """The tangent of node i from those of its operands that vary: the places ``active`` of ``ids``."""
    node = g.nodes[i]
    op = node[0]
    if op in CONDITIONS:
        return None
    if op in ("select", "min", "max"):
        return _branch(g, node, moving)
    if op == "mul" and ids[0] == ids[1]:
        factor, base = moving[ids[0]]
        return g.mul(g.const(2.0), g.mul(ids[0], factor)), base
    if op == "div":  # (ȧ − y ḃ)/b
        top = moving.get(ids[0])
        if ids[1] in moving:
            factor, base = moving[ids[1]]
            top = _joined(g, top, (g.neg(g.mul(i, factor)), base))
        return None if top is None else (g.div(top[0], ids[1]), top[1])
    partial = slopes(g, i)
    total: Tangent | None = None
    for k in active:
        factor, base = moving[ids[k]]
        factor = g.mul(partial[k], factor)
        if factor != g.zero:
            total = _joined(g, total, (factor, base))
    return total


def _branch(g: Graph, node: Node, moving: Mapping[int, Tangent]) -> Tangent | None:
    """The tangent of the active branch."""
    if node[0] == "select":
        condition, a, b = node[1:]
    else:
        a, b = node[1:]
        condition = g.le(a, b) if node[0] == "min" else g.le(b, a)
    ta, tb = moving.get(a), moving.get(b)
    bases = {t[1] for t in (ta, tb) if t is not None}
    if len(bases) == 1:
        factor = g.select(condition, ta[0] if ta else g.zero, tb[0] if tb else g.zero)
        return factor, bases.pop()
    assert ta is not None and tb is not None
    return g.one, g.select(condition, _value(g, ta), _value(g, tb))


def vjp(graph: Graph, outputs: Sequence[int], cotangents: Sequence[int], inputs: Sequence[int]) -> list[int]:
    """Σ_i cotangent_i · ∂output_i/∂x for every node x of ``inputs``, computed in one backward pass."""
    found = backwards(graph, outputs, cotangents, inputs)
    return [found.get(i, graph.zero) for i in inputs]


def backwards(graph: Graph, outputs: Sequence[int], cotangents: Sequence[int], inputs: Sequence[int]) -> dict[int, int]:
    """The cotangents of all nodes between ``inputs`` and ``outputs`` (and these) in one backward pass."""
    g, nodes = graph, graph.nodes
    ends = set(inputs)
    zero = g.zero
    order = reached(g, outputs, ends)
    active: set[int] = set()
    for i in order:
        if i in ends or any(k in active for k in operands(nodes[i])):
            active.add(i)
    bar: dict[int, int] = {}
    for i, c in zip(outputs, cotangents, strict=True):
        if i in active:
            bar[i] = g.add(bar.get(i, zero), c)
    for i in reversed(order):
        c = bar.get(i, zero)
        if c == zero or i in ends:
            continue
        node = nodes[i]
        if node[0] == "mul" and node[1] == node[2]:
            a = node[1]
            bar[a] = g.add(bar.get(a, zero), g.mul(g.const(2.0), g.mul(a, c)))
            continue
        _spread(g, i, node, c, bar, active)
    return bar


def _spread(g: Graph, i: int, node: Node, c: int, bar: dict[int, int], active: set[int]) -> None:
    """Add the contributions of the cotangent c of node i to those of its operands."""
    op = node[0]
    zero = g.zero
    if op == "div":
        share = g.div(c, node[2])
        parts: tuple[int, ...] = (share, g.neg(g.mul(i, share)) if node[2] in active else zero)
    elif op == "select":
        parts = (zero, g.select(node[1], c, zero), g.select(node[1], zero, c))
    elif op in ("min", "max"):
        first = g.le(node[1], node[2]) if op == "min" else g.le(node[2], node[1])
        parts = (g.select(first, c, zero), g.select(first, zero, c))
    elif op == "add":
        parts = (c, c)
    elif op == "sub":
        parts = (c, g.neg(c))
    else:
        parts = tuple(g.mul(c, s) for s in slopes(g, i))
    for a, part in zip(operands(node), parts, strict=True):
        if a in active and part != zero:
            bar[a] = g.add(bar.get(a, zero), part)


def gradient(graph: Graph, output: int, inputs: Sequence[int]) -> list[int]:
    """∂output/∂x for every x of ``inputs``."""
    return vjp(graph, [output], [graph.one], inputs)


def jacobian(graph: Graph, outputs: Sequence[int], inputs: Sequence[int]) -> dict[tuple[int, int], int]:
    """The entries ∂output_i/∂x_k that are not structurally zero, at ``[i, k]``.

    It is computed backwards by rows or forwards by columns, whichever are fewer.
    """
    entries: dict[tuple[int, int], int] = {}
    if len(outputs) <= len(inputs):
        for i, y in enumerate(outputs):
            for k, d in enumerate(vjp(graph, [y], [graph.one], inputs)):
                if d != graph.zero:
                    entries[i, k] = d
    else:
        held = dict.fromkeys(inputs, graph.zero)
        for k, x in enumerate(inputs):
            for i, d in enumerate(jvp(graph, outputs, {**held, x: graph.one})):
                if d != graph.zero:
                    entries[i, k] = d
    return entries


def hessian(graph: Graph, output: int, inputs: Sequence[int]) -> dict[tuple[int, int], int]:
    """The entries ∂²output/∂x_i∂x_k that are not structurally zero; ``[i, k]`` and ``[k, i]`` are the same node.

    If an x is computed from other nodes, it is first cut out of the graph: the gradient of c a²/2 + (c a) b with
    respect to a is c a, which must not be mistaken for an x that happens to be c a.
    """
    cut = [x if graph.nodes[x][0] == "input" else graph.input("cut", k) for k, x in enumerate(inputs)]
    (output,) = replaced(graph, [output], dict(zip(inputs, cut, strict=True)))
    first = gradient(graph, output, cut)
    entries: dict[tuple[int, int], int] = {}
    for k, x in enumerate(cut):
        column = jvp(graph, first[: k + 1], {x: graph.one})
        for i, d in enumerate(replaced(graph, column, dict(zip(cut, inputs, strict=True)))):
            if d != graph.zero:
                entries[i, k] = entries[k, i] = d
    return entries
