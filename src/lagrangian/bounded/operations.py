"""The number of operations that a reader sees in an expression: SymPy's count, with shared parts visited once."""

from __future__ import annotations

from functools import lru_cache
from typing import Any, cast

import sympy as sp
from sympy.core.operations import LatticeOp


def operations(*exprs: sp.Basic) -> int:
    """Return what ``sympy.count_ops`` counts in all of the expressions: −, /, and one + or · less than the operands.

    A part that occurs in many places, or in several expressions, is examined once; SymPy examines it in every place.
    """
    return _operations(exprs)


@lru_cache(maxsize=5_000)
def _operations(exprs: tuple[sp.Basic, ...]) -> int:
    known: dict[sp.Basic, int] = {}
    stack: list[sp.Basic] = list(exprs)
    parts: dict[sp.Basic, tuple[int, list[Any]]] = {}
    while stack:
        node = stack[-1]
        if node in known:
            stack.pop()
        elif node in parts:
            own, below = parts.pop(stack.pop())
            known[node] = own + sum(known[part] for part in below)
        else:
            own, below = parts[node] = _looked_at(cast("Any", node))
            stack += [part for part in below if part not in known]
    return sum(known[expr] for expr in exprs)


def _looked_at(node: Any) -> tuple[int, list[Any]]:
    """The operations for which a node itself counts, and the parts to examine next."""
    own = 0
    if node.is_Rational:
        return (0 if node is sp.S.One else int(node.p < 0) + int(node.q != 1)), []
    if node.is_Mul:
        if _negative(node):
            own += 1
            node = node.as_two_terms()[1] if node.args[0] is sp.S.NegativeOne else -node
        over, under = sp.fraction(node)
        if over.is_Integer:
            return own + 1 + int(bool(over < 0)), [under]
        if under is not sp.S.One:
            return own + 1, [over] if under.is_Integer else [under, over]
    elif node.is_Add:
        negative = [_negative(term) for term in node.args]
        parts = [-term if minus else term for term, minus in zip(node.args, negative, strict=True)]
        return len(parts) - 1 + int(all(negative)), parts
    if node.is_Pow and node.exp is sp.S.NegativeOne:
        return own + 1, [node.base]
    if node is sp.S.Exp1:
        return own + 1, []
    if node.is_Mul or isinstance(node, LatticeOp):
        own += len(node.args) - 1
    elif node.args and (node.is_Pow or node.is_Function or isinstance(node, sp.Derivative)):
        own += 1
    return own, [] if node.is_Symbol else list(node.args)


def _negative(term: Any) -> bool:
    """Whether a term is written with a minus sign."""
    coefficient = term.args[0] if term.is_Mul else term
    return bool(coefficient.is_Number and coefficient.is_extended_negative)
