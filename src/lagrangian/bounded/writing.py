"""Expands expressions within bounds: sums of products, and definitions."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.functions.elementary.hyperbolic import HyperbolicFunction
from sympy.functions.elementary.trigonometric import TrigonometricFunction

from lagrangian.bounded.parts import bent, replaced
from lagrangian.bounded.products import multiplied_out
from lagrangian.bounded.searches import cancel, together
from lagrangian.bounded.sizes import MAX_OPERATIONS, TERMS, check_size, each, size, terms
from lagrangian.bounded.slopes import diff

HIGH = 8
"""A higher power of a sum is not multiplied out in a search for a common factor."""


def expand(expr: sp.Expr) -> sp.Expr:
    """Return the sum of products that an expression equals, or the expression unchanged if that would be too long.

    Maxima and cases stay as they are, as SymPy would try to prove their conditions.
    """
    return _expanded(expr)


@lru_cache(maxsize=5_000)
def _expanded(expr: sp.Expr) -> sp.Expr:
    return expr if terms(expr) > TERMS or size(expr) > MAX_OPERATIONS else _unbent(_multiplied, expr)


def _multiplied(expr: sp.Expr) -> sp.Expr:
    """What SymPy's expand returns, without its rules for logarithms and powers of products where none of these is."""
    sums = False
    for node in each(expr):
        if isinstance(node, sp.Pow):
            if not isinstance(node.args[1], sp.Integer) or isinstance(node.args[0], sp.Mul):
                return cast("sp.Expr", sp.expand(expr))
            sums = sums or isinstance(node.args[0], sp.Add)
        elif isinstance(node, sp.Mul):
            sums = sums or any(isinstance(a, sp.Add) for a in node.args)
        elif node.args and not isinstance(node, _PLAIN) and not _is_of_time(node):
            return cast("sp.Expr", sp.expand(expr))
    if not sums:
        return expr
    found = multiplied_out(expr)
    return cast("sp.Expr", sp.expand(expr, **_SUMS_ONLY)) if found is None else found


def _is_of_time(node: sp.Basic) -> bool:
    """Whether a node is a coordinate or an input, or a rate, in which nothing can be multiplied out."""
    function = node.expr if isinstance(node, sp.Derivative) else node
    return isinstance(function, AppliedUndef) and all(a.is_Atom for a in function.args)


_PLAIN: tuple[Any, ...] = (sp.Add, TrigonometricFunction, HyperbolicFunction)
_SUMS_ONLY: dict[str, bool] = {"basic": False, "log": False, "power_base": False, "power_exp": False}


def _unbent(routine: Callable[[sp.Expr], Any], expr: sp.Expr) -> sp.Expr:
    """Apply a routine to an expression in which symbols replace maxima and cases."""
    letters = {node: sp.Dummy(f"bent{k}", real=True) for k, node in enumerate(bent(expr))}
    if not letters:
        return cast("sp.Expr", routine(expr))
    made = routine(cast("sp.Expr", replaced(expr, letters)))
    return cast("sp.Expr", replaced(made, {letter: node for node, letter in letters.items()}))


def written_out(expr: sp.Expr, table: Mapping[Any, Any]) -> sp.Expr:
    """Return ``expr`` with symbols replaced by their expressions and derivatives by time carried out.

    Raises `TooLarge` if the result would have more than `MAX_OPERATIONS` operations.
    """
    while used := [node for node in each(expr) if (node.expr if isinstance(node, sp.Derivative) else node) in table]:
        lengths: dict[Any, int] = {}
        for symbol, value in table.items():  # definitions come after those that they use
            lengths[symbol] = size(value, lengths)
        symbols = [node.expr if isinstance(node, sp.Derivative) else node for node in used]
        longest = str(max(symbols, key=lambda symbol: lengths[symbol])).removesuffix("(t)")
        check_size(size(expr, lengths), f"an expression that uses '{longest}'")
        values = {node: _rates(node, table) if isinstance(node, sp.Derivative) else table[node] for node in used}
        expr = cast("sp.Expr", replaced(expr, values))
    return expr


def _rates(node: sp.Derivative, table: Mapping[Any, Any]) -> sp.Expr:
    value = table[node.expr]
    for _ in range(int(node.derivative_count)):
        value = diff(value, node.variables[0])
    return value


def is_one(expr: sp.Expr) -> bool:
    """Whether an expression equals 1 by arithmetic and sin² + cos² = 1, as the square of a unit vector does."""
    whole = expr = expand(expr)
    for angle in sorted({c.args[0] for c in expr.atoms(sp.cos)}, key=sp.default_sort_key):
        if expr == 1:
            return True
        cosine, square = sp.cos(angle), 1 - sp.sin(angle) ** 2

        def even(power: Any, base: Any = cosine, square: Any = square) -> sp.Expr:
            return square ** (power.exp // 2) * base ** (power.exp % 2)

        powers = [p for p in expr.atoms(sp.Pow) if p.base == cosine and isinstance(p.exp, sp.Integer) and p.exp > 1]
        expr = expand(cast("sp.Expr", expr.xreplace({p: even(p) for p in powers})))
    if expr == 1:
        return True
    high = [p.base for p in whole.atoms(sp.Pow) if isinstance(p.exp, sp.Integer) and p.exp > HIGH and p.base.is_Add]
    letters = {base: sp.Dummy(f"sum{k}") for k, base in enumerate(dict.fromkeys(high))}  # 1 for any sum is 1 for this
    return cancel(together(cast("sp.Expr", replaced(whole, letters)))) == 1
