"""The sizes of expressions, also of results: predicted from the structure, with shared parts visited once."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import lru_cache
from math import comb
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.bounded.effort import count_operations
from lagrangian.errors import ModelError

MAX_OPERATIONS = 20_000
"""The largest number of operations of an expanded expression."""

TERMS = 3_000
"""The largest number of terms of an expansion."""

BEYOND = 10**30
"""Where predictions stop counting: far above every limit."""


class TooLarge(ModelError):
    """An expression would be too long when expanded."""


class Budget:
    """A number of operations that may still be made; it is a count, so that results do not depend on the machine."""

    def __init__(self, limit: int, error: Callable[[int], BaseException]) -> None:
        self.limit = self.left = limit
        self._error = error

    def spend(self, operations: int) -> None:
        """Subtract operations; raise an error if none are left."""
        self.left -= operations
        count_operations(operations)
        if self.left < 0:
            raise self._error(self.limit)


def each(expr: sp.Basic) -> Iterator[sp.Basic]:
    """Yield every part of an expression once, its own parts before it; shared parts are visited once."""
    done: set[int] = set()
    begun: set[int] = set()
    stack: list[sp.Basic] = [expr]
    while stack:
        node = stack[-1]
        if id(node) in done:
            stack.pop()
        elif id(node) in begun or not (parts := node.args) or isinstance(node, (AppliedUndef, sp.Derivative)):
            stack.pop()
            done.add(id(node))
            yield node
        else:
            begun.add(id(node))
            stack += parts


def size(expr: sp.Basic, names: Mapping[Any, int] | None = None) -> int:
    """Return how many operands and operations an expression has when written out.

    A shared part counts as often as it occurs. ``names`` maps symbols to the size of what they stand for.
    """
    return _size(expr, names) if names else _plain_size(expr)


@lru_cache(maxsize=5_000)
def _plain_size(expr: sp.Basic) -> int:
    """The size of an expression, kept: every bound asks for it."""
    return _size(expr, None)


def _size(expr: sp.Basic, names: Mapping[Any, int] | None) -> int:
    found: dict[int, int] = {}
    for node in each(expr):
        if names and node in names:
            found[id(node)] = names[node]
        elif isinstance(node, sp.Derivative):
            own = names.get(node.expr, 1) if names else 1
            found[id(node)] = own if own == 1 else min(own * (own + 1), BEYOND)  # the product rule: one term per factor
        elif not node.args or isinstance(node, AppliedUndef):
            found[id(node)] = 1
        else:
            found[id(node)] = min(1 + sum(found[id(a)] for a in node.args), BEYOND)
    return found[id(expr)]


def names(expr: sp.Basic) -> set[sp.Basic]:
    """Return the symbols, functions of time and derivatives in an expression; shared parts are visited once."""
    found = {node for node in each(expr) if isinstance(node, (sp.Symbol, AppliedUndef, sp.Derivative))}
    return found | {node.expr for node in found if isinstance(node, sp.Derivative)}


def letters(expr: sp.Basic) -> set[Any]:
    """Return the symbols and functions of time in an expression, with time and what stands only below a derivative."""
    return set(_letters(expr))


@lru_cache(maxsize=5_000)
def _letters(expr: sp.Basic) -> frozenset[Any]:
    """The same, kept: every reader of a line asks for them."""
    return symbols(expr) | atoms(expr, AppliedUndef)


@lru_cache(maxsize=20_000)
def atoms(expr: sp.Basic, *kinds: type) -> frozenset[Any]:
    """Return the parts of an expression that are of one of these kinds, which is asked of every line many times."""
    return frozenset(expr.atoms(*kinds))


@lru_cache(maxsize=5_000)
def symbols(expr: sp.Basic) -> frozenset[Any]:
    """Return the symbols in an expression, with time, kept as well."""
    return frozenset(expr.free_symbols)


def terms(expr: sp.Basic) -> int:
    """Return an upper bound on the number of terms in the longest sum that expanding an expression makes."""
    found: dict[int, int] = {}
    longest = 1
    for node in each(expr):
        inner = [found[id(a)] for a in node.args] if not isinstance(node, (AppliedUndef, sp.Derivative)) else []
        count = 1
        if isinstance(node, sp.Add):
            count = sum(inner)
        elif isinstance(node, sp.Mul):
            for n in inner:
                count = min(count * n, BEYOND)
        elif isinstance(node, sp.Pow) and isinstance(node.exp, sp.Rational):
            power = abs(node.exp.p) // node.exp.q  # SymPy multiplies out (a + b)^(7/2) as (a + b)³ √(a + b)
            raised = inner[0] if inner[0] == 1 else min(comb(min(inner[0], 10**6) + power - 1, power), BEYOND)
            count, longest = (raised, longest) if node.exp > 0 else (1, max(longest, raised))  # so does a denominator
        found[id(node)] = count
        longest = max(longest, count)
    return longest


@lru_cache(maxsize=5_000)
def slope_size(expr: sp.Basic) -> int:
    """Return an upper bound on the size of the derivative of an expression."""
    sizes: dict[int, int] = {}
    found: dict[int, int] = {}
    for node in each(expr):
        if not node.args or isinstance(node, (AppliedUndef, sp.Derivative)):
            sizes[id(node)] = found[id(node)] = 1
            continue
        own = sizes[id(node)] = min(1 + sum(sizes[id(a)] for a in node.args), BEYOND)
        below = sum(found[id(a)] for a in node.args)
        found[id(node)] = min(below if isinstance(node, sp.Add) else below + own * len(node.args), BEYOND)
    return found[id(expr)]


def check_size(count: int, what: str) -> None:
    """Raise an error if an expression is longer than `MAX_OPERATIONS`; ``what`` is the subject of the sentence."""
    if count > MAX_OPERATIONS:
        many = f"{float(count):.0e}" if count < BEYOND else "more than 1e30"
        raise TooLarge(
            f"{what} has {many} operations once it is written out",
            fix=f"at most {MAX_OPERATIONS}: refer to each definition fewer times, or describe the system by points and "
            "frames",
            code="E601",
        )
