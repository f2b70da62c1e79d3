"""Replaces parts of expressions without letting SymPy prove their conditions again."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.bounded.searches import PROOFS, absolute, searched
from lagrangian.bounded.sizes import each, size

INSIDE = 50
"""If an absolute value or a sign has more operations, SymPy is not asked whether its argument is real."""


def replaced(expr: sp.Basic, table: Mapping[Any, Any]) -> sp.Basic:
    """Return an expression with parts replaced; parts without any of these stay, and no condition is proved again."""
    made: dict[int, sp.Basic] = {}
    for node in each(expr):
        if node in table:
            made[id(node)] = table[node]
        elif not node.args or isinstance(node, (AppliedUndef, sp.Derivative)):
            made[id(node)] = node
        else:
            made[id(node)] = rebuilt(node, [made[id(a)] for a in node.args])
    return made[id(expr)]


def rebuilt(node: sp.Basic, arguments: list[Any]) -> sp.Basic:
    """Return an expression of the same kind with other arguments; cases, comparisons and long maxima stay unproved."""
    if all(a is b for a, b in zip(arguments, node.args, strict=True)):
        return node
    unproved = (sp.Piecewise, sp.core.relational.Relational)
    if isinstance(node, unproved) or (isinstance(node, (sp.Max, sp.Min)) and len(arguments) > 2):
        return node.func(*arguments, evaluate=False)
    if isinstance(node, (sp.Abs, sp.sign)):
        return absolute(node.func, arguments[0])
    # SymPy tries to prove which argument of a maximum is the larger, and asks for the sign of what a function is of
    if isinstance(node, (sp.Max, sp.Min, sp.Function)) and not isinstance(node, (sp.sin, sp.cos)):
        function: Any = node.func
        made: Any = searched(function, *arguments, calls=PROOFS)
        return function(*arguments, evaluate=False) if made is None else made
    return node.func(*arguments)


def bent(expr: sp.Basic) -> list[sp.Expr]:
    """The outermost maxima, minima and cases, and long absolute values and signs."""
    found: dict[sp.Expr, None] = {}
    stack, seen = [expr], {id(expr)}
    while stack:
        node = stack.pop()
        long = isinstance(node, (sp.Abs, sp.sign)) and size(node) > INSIDE
        if long or isinstance(node, (sp.Piecewise, sp.Max, sp.Min)):
            found[cast("sp.Expr", node)] = None
            continue
        fresh = [a for a in node.args if id(a) not in seen]
        seen.update(map(id, fresh))
        stack += fresh
    return list(found)
