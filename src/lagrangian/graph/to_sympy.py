"""Converts graph nodes to SymPy, without recursion."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownLambdaType=false

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import sympy as sp

from lagrangian.graph.graph import UNARY, Graph, Node
from lagrangian.graph.program import reached

OPERATIONS: dict[str, Callable[..., Any]] = {
    "add": sp.Add,
    "sub": lambda a, b: a - b,
    "mul": sp.Mul,
    "div": lambda a, b: a / b,
    "neg": lambda a: -a,
    "pow": sp.Pow,
    "abs": sp.Abs,
    "sign": sp.sign,
    "atan2": sp.atan2,
    "min": sp.Min,
    "max": sp.Max,
    "lt": sp.Lt,
    "le": sp.Le,
    "eq": sp.Eq,
    "and": sp.And,
    "or": sp.Or,
    "not": sp.Not,
    "select": lambda c, a, b: sp.Piecewise((a, c), (b, True)),
    **{name: getattr(sp, name) for name in UNARY},
}


def number(x: float) -> sp.Expr:
    """The shortest decimal or fraction that equals the double exactly; infinity stays infinity."""
    if x != x or x in (float("inf"), float("-inf")):
        return sp.Float(x)
    if x.is_integer() and abs(x) < 2**53:
        return sp.Integer(int(x))
    fraction: Any = sp.Rational(repr(x))
    small = fraction.limit_denominator(10_000)
    return small if int(small.p) / int(small.q) == x else fraction


def to_sympy(graph: Graph, node: int, symbols: Mapping[int, sp.Expr]) -> sp.Expr:
    """The SymPy expression of ``node``; ``symbols`` gives the symbols of the input nodes."""
    value: dict[int, Any] = {}
    for i in reached(graph, [node], symbols):
        if i in symbols:
            value[i] = symbols[i]
        else:
            value[i] = _expression(graph.nodes[i], value)
    return value[node]


def _expression(node: Node, value: Mapping[int, Any]) -> Any:
    op = node[0]
    if op == "const":
        return number(node[1])
    if op == "input":
        return sp.Symbol(f"{node[1]}{node[2]}")
    if op == "powi":
        return value[node[1]] ** node[2]
    return OPERATIONS[op](*(value[k] for k in node[1:]))
