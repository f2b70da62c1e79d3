"""Limits on the size of the expressions of an answer, and of their derivatives, before they are computed."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp
from sympy.matrices.matrixbase import MatrixBase

from lagrangian.check.reading.names import Value

MAX_SIZE = 20_000
"""The largest number of nodes of all expanded definitions in one answer."""

MAX_DERIVED = 120_000
"""The largest number of nodes of all derivatives in one answer, before terms are collected."""


class ReadingBudget:
    """A limit on the nodes of expressions as trees, in which shared parts count as often as they occur."""

    def __init__(self, size: int = MAX_SIZE) -> None:
        self.left = size
        self.derived = MAX_DERIVED
        self._sizes: dict[sp.Basic, int] = {}
        self._slopes: dict[sp.Basic, int] = {}

    def spend(self, value: Value) -> bool:
        """Subtract the size of a value; return False if too little is left."""
        parts = value.flat() if isinstance(value, MatrixBase) else [value]
        self.left -= sum(self.size(x) for x in parts)
        return self.left >= 0

    def affords_derivative(self, value: Value) -> bool:
        """Subtract the cost of a derivative, which is its number of nodes before terms are collected; False if too
        little is left.

        A sum costs the derivatives of its terms, a product of n factors n products, anything else itself and the
        derivative of what is inside.
        """
        parts = value.flat() if isinstance(value, MatrixBase) else [value]
        self.derived -= sum(self._slope(x) for x in parts)
        return self.derived >= 0

    def _slope(self, expr: sp.Basic) -> int:
        self.size(expr)
        for part in self._inner_first(expr, self._slopes):
            inner = sum(self._slopes[a] for a in part.args)
            own = len(part.args) if part.is_Mul else 0 if part.is_Add else 1
            self._slopes[part] = inner + own * self._sizes[part] + 1
        return self._slopes[expr]

    def size(self, expr: sp.Basic) -> int:
        """The number of nodes; each distinct part is visited once."""
        for part in self._inner_first(expr, self._sizes):
            self._sizes[part] = 1 + sum(self._sizes[a] for a in part.args)
        return self._sizes[expr]

    @staticmethod
    def _inner_first(expr: sp.Basic, known: dict[sp.Basic, int]) -> Iterator[sp.Basic]:
        """The parts of an expression whose size is not known, inner ones first."""
        stack = [expr]
        while stack:
            part = stack[-1]
            waiting = [a for a in part.args if a not in known]
            if waiting and part not in known:
                stack.extend(waiting)
                continue
            stack.pop()
            if part not in known:
                yield part
