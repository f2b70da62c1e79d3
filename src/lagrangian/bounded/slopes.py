"""Derivatives within bounds."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.bounded.parts import bent, replaced
from lagrangian.bounded.sizes import TooLarge, each, size, slope_size

SLOPES = 1_000_000
"""The largest number of operations that the product rule may make, most of which are zero."""


def diff(expr: sp.Expr, *symbols: Any) -> sp.Expr:
    """Return the derivative by symbols, coordinates, rates or time in turn; raise `TooLarge` if it gets too long.

    A maximum has the derivative of its larger argument, a piecewise expression that of its case; conditions stay.
    """
    for symbol in symbols:
        if (count := slope_size(expr)) > SLOPES:
            raise TooLarge(
                f"a derivative of an expression with {size(expr)} operations has up to {float(count):.0e}",
                fix="describe the system by points and frames instead of long products",
                code="E601",
            )
        expr = _diff(expr, symbol)
    return expr


@lru_cache(maxsize=5_000)
def _diff(expr: sp.Expr, symbol: Any) -> sp.Expr:
    letters = {node: sp.Dummy(f"bent{k}", real=True) for k, node in enumerate(bent(expr))}
    if not letters:
        return _smooth(expr, symbol)
    outer = cast("sp.Expr", replaced(expr, letters))
    total = _smooth(outer, symbol)
    for node, letter in letters.items():
        inner = _case(node, symbol)
        if inner != 0:
            total += _smooth(outer, letter) * inner
    return cast("sp.Expr", replaced(total, {letter: node for node, letter in letters.items()}))


def _smooth(expr: sp.Expr, symbol: Any) -> sp.Expr:
    """The derivative of an expression without kinks, node by node, with shared parts once.

    The rules and the order of the factors are SymPy's. SymPy itself makes an object of every derivative of every part
    and multiplies the factors of a product again for every addend: it takes fifteen times as long for textbook
    examples, and n³ steps for a product of n factors.
    """
    found: dict[sp.Basic, sp.Expr] = {}
    for node in each(expr):
        if node not in found:
            found[node] = _slope(cast("sp.Expr", node), found, symbol)
    return found[expr]


def _slope(node: sp.Expr, found: Mapping[sp.Basic, sp.Expr], symbol: Any) -> sp.Expr:
    """The derivative of a node from those of its parts in ``found``."""
    if not isinstance(node, sp.Expr):
        return sp.S.Zero
    if not node.args or isinstance(node, (AppliedUndef, sp.Derivative)):
        return _leaf(node, symbol)
    inner = [found[a] for a in node.args]
    moving = [i for i, slope in enumerate(inner) if slope != 0]
    if not moving:
        return sp.S.Zero
    if isinstance(node, sp.Add):
        return sp.Add(*inner)
    if isinstance(node, sp.log) and isinstance(node.args[0], sp.cosh):  # as books write it, not sinh u/cosh u
        u = node.args[0].args[0]
        return sp.tanh(u) * found[u]
    if isinstance(node, sp.Mul):
        return sp.Add(*[sp.Mul(*node.args[:i], inner[i], *node.args[i + 1 :]) for i in moving])
    if isinstance(node, sp.Pow):
        base, exponent = cast("tuple[sp.Expr, sp.Expr]", node.args)
        by_base = inner[0] * exponent / base
        return node * (inner[1] * sp.log(base) + by_base if inner[1] != 0 else by_base)
    if isinstance(node, sp.Function) and type(node)._eval_derivative is sp.Function._eval_derivative:
        return sp.Add(*[cast("Any", node).fdiff(i + 1) * inner[i] for i in moving])
    return cast("sp.Expr", sp.diff(node, symbol))


@lru_cache(maxsize=10_000)
def _leaf(node: sp.Expr, symbol: Any) -> sp.Expr:
    """The derivative of a symbol, a number, a function of time or a rate."""
    if node == symbol:
        return sp.S.One
    moves = isinstance(node, (AppliedUndef, sp.Derivative)) and not (
        isinstance(symbol, sp.Symbol) and symbol not in node.free_symbols
    )
    return cast("sp.Expr", sp.diff(node, symbol)) if moves else sp.S.Zero


def _case(node: sp.Expr, symbol: Any) -> sp.Expr:
    """The derivative of a maximum, a minimum or cases is that of the active branch; d|u| = sign(u) du, d sign(u) =
    0."""
    if isinstance(node, (sp.Abs, sp.sign)):
        inner = _diff(cast("sp.Expr", node.args[0]), symbol) if isinstance(node, sp.Abs) else sp.S.Zero
        return inner if inner == 0 else inner * sp.sign(node.args[0], evaluate=False)
    if isinstance(node, sp.Piecewise):
        cases = [(_diff(pair.args[0], symbol), pair.args[1]) for pair in cast("tuple[Any, ...]", node.args)]
    else:
        is_it, beyond = (
            (sp.GreaterThan, sp.StrictGreaterThan) if isinstance(node, sp.Max) else (sp.LessThan, sp.StrictLessThan)
        )
        if len(node.args) == 2:  # if both arguments are equal the first counts, as in the graph
            a, b = cast("list[sp.Expr]", sorted(node.args, key=sp.default_sort_key))
            first = sp.Piecewise((1, is_it(a, b, evaluate=False)), (0, True), evaluate=False)
            second = sp.Piecewise((1, beyond(b, a, evaluate=False)), (0, True), evaluate=False)
            return _diff(a, symbol) * first + _diff(b, symbol) * second
        arguments = cast("tuple[sp.Expr, ...]", node.args)
        cases = [(_diff(a, symbol), is_it(a, node, evaluate=False)) for a in arguments]
        cases[-1] = (cases[-1][0], sp.true)
    if all(value == cases[0][0] for value, _ in cases):
        return cases[0][0]
    return sp.Piecewise(*cases, evaluate=False)
