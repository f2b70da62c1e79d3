"""The nodes of an expression graph, and the four arithmetic operations on them.

Simplifications when a node is made are exact in real arithmetic and never make an expression longer: ``0·x``, ``1·x``,
``x − x``, ``−(−x)``, ``a + (−b) → a − b``, signs are pulled out of products and odd functions, constants are folded,
and operands of commutative operations are sorted.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from lagrangian.errors import ModelError

Node = tuple[Any, ...]  # (operation, *operands)

MAX_EXPONENT = 1 << 20
"""The largest whole exponent that is written as products; larger ones use ``pow``."""


class Arithmetic:
    """Nodes, each made only once: constants, inputs, sums, products, quotients and whole powers."""

    __slots__ = ("_known", "negative", "nodes", "one", "zero")

    def __init__(self) -> None:
        self.nodes: list[Node] = []
        self._known: dict[Node, int] = {}
        self.zero = self.const(0.0)
        self.one = self.const(1.0)
        self.negative = self.const(-1.0)

    def __len__(self) -> int:
        """The number of nodes made so far."""
        return len(self.nodes)

    def _make(self, node: Node) -> int:
        known = self._known
        found = known.get(node)
        if found is None:
            nodes = self.nodes
            found = known[node] = len(nodes)
            nodes.append(node)
        return found

    # -- leaves -------------------------------------------------------------------------------------------------

    def const(self, x: float) -> int:
        """A constant. Raises `ModelError` if it is NaN."""
        x = float(x) + 0.0  # −0 becomes 0
        if x != x:
            raise ModelError("a constant of an expression is not a number (nan)", code="E101")
        return self._make(("const", x))

    def input(self, group: str, index: int) -> int:
        """The input with ``index`` in an input group."""
        return self._make(("input", group, index))

    def value(self, a: int) -> float | None:
        """The number of a constant node, otherwise None."""
        node = self.nodes[a]
        return node[1] if node[0] == "const" else None

    # -- arithmetic ---------------------------------------------------------------------------------------------

    def neg(self, a: int) -> int:
        """−a."""
        node = self.nodes[a]
        op = node[0]
        if op == "neg":
            return node[1]
        if op == "const":
            return self.const(-node[1])
        if op == "sub":
            mirrored = self._known.get(("sub", node[2], node[1]))
            if mirrored is not None:
                return mirrored
        return self._make(("neg", a))

    def add(self, a: int, b: int) -> int:
        """a + b."""
        nodes = self.nodes
        if a > b:
            a, b = b, a
        na, nb = nodes[a], nodes[b]
        oa, ob = na[0], nb[0]
        if oa == "const":
            if na[1] == 0.0:
                return b
            if ob == "const":
                return self._folded(na[1] + nb[1], ("add", a, b))
        elif ob == "const" and nb[1] == 0.0:
            return a
        if ob == "neg":
            return self.sub(a, nb[1])
        if oa == "neg":
            return self.sub(b, na[1])
        if a == b:
            return self.mul(self.const(2.0), a)
        key = ("add", a, b)
        found = self._known.get(key)
        if found is None:
            found = self._known[key] = len(nodes)
            nodes.append(key)
        return found

    def sub(self, a: int, b: int) -> int:
        """a − b."""
        if a == b:
            return self.zero
        nodes = self.nodes
        na, nb = nodes[a], nodes[b]
        oa, ob = na[0], nb[0]
        if ob == "const":
            if nb[1] == 0.0:
                return a
            if oa == "const":
                return self._folded(na[1] - nb[1], ("sub", a, b))
        elif oa == "const" and na[1] == 0.0:
            return self.neg(b)
        if ob == "neg":
            return self.add(a, nb[1])
        if oa == "neg":
            return self.neg(self.add(na[1], b))
        known = self._known
        key = ("sub", a, b)
        found = known.get(key)
        if found is None:
            mirrored = known.get(("sub", b, a))
            if mirrored is not None:
                return self._make(("neg", mirrored))
            found = known[key] = len(nodes)
            nodes.append(key)
        return found

    def mul(self, a: int, b: int) -> int:
        """a b."""
        nodes = self.nodes
        if a > b:
            a, b = b, a
        na: Node = nodes[a]
        nb: Node = nodes[b]
        if nb[0] == "const":
            a, b, na, nb = b, a, nb, na
        oa, ob = na[0], nb[0]
        if oa == "const":
            c = na[1]
            if c == 0.0:
                return self.zero
            if c == 1.0:
                return b
            if c == -1.0:
                return self.neg(b)
            if ob == "const":
                return self._folded(c * nb[1], ("mul", a, b))
            if c < 0.0:
                return self.neg(self.mul(self.const(-c), b))
            if ob == "mul":
                first: int = nb[1]
                if nodes[first][0] == "const":
                    return self.mul(self._folded(c * nodes[first][1], ("mul", a, first)), nb[2])
        elif oa == "neg":
            return self.neg(self.mul(na[1], b))
        if ob == "neg":
            return self.neg(self.mul(a, nb[1]))
        key = ("mul", a, b)
        found = self._known.get(key)
        if found is None:
            found = self._known[key] = len(nodes)
            nodes.append(key)
        return found

    def div(self, a: int, b: int) -> int:
        """a / b. A division by the constant 0 is not folded; its value is infinite or NaN when it is evaluated."""
        if a == b:
            return self.one
        nodes = self.nodes
        na, nb = nodes[a], nodes[b]
        if na[0] == "const" and na[1] == 0.0:
            return self.zero
        if nb[0] == "const" and nb[1] != 0.0:
            if na[0] == "const":
                return self._folded(na[1] / nb[1], ("div", a, b))
            mantissa, _ = math.frexp(nb[1])
            if abs(mantissa) == 0.5 and abs(nb[1]) > 1e-300:  # the reciprocal of a power of two is exact
                return self.mul(self.const(1.0 / nb[1]), a)
            if nb[1] < 0.0:
                return self.neg(self.div(a, self.const(-nb[1])))
        if na[0] == "neg":
            return self.neg(self.div(na[1], b))
        if nb[0] == "neg":
            return self.neg(self.div(a, nb[1]))
        return self._make(("div", a, b))

    def powi(self, a: int, n: int) -> int:
        """a^n for a known whole number n."""
        if n == 0:
            return self.one
        if n == 1:
            return a
        if n == 2:
            return self.mul(a, a)
        if n == -1:
            return self.div(self.one, a)
        if abs(n) > MAX_EXPONENT:
            return self._make(("pow", a, self.const(float(n))))
        node = self.nodes[a]
        if node[0] == "const":
            return self._attempt(lambda: math.pow(node[1], n), ("powi", a, n))
        if node[0] == "neg":
            inner = self.powi(node[1], n)
            return inner if n % 2 == 0 else self.neg(inner)
        if node[0] == "powi" and abs(node[2] * n) <= MAX_EXPONENT:
            return self.powi(node[1], node[2] * n)
        return self._make(("powi", a, n))

    def _folded(self, x: float, node: Node) -> int:
        """The constant x if it is finite, otherwise the operation itself, so that the problem appears when it is
        evaluated."""
        return self.const(x) if math.isfinite(x) else self._make(node)

    def _attempt(self, compute: Callable[[], float], node: Node) -> int:
        try:
            x = compute()
        except (ValueError, OverflowError, ZeroDivisionError):  # outside the domain: left for the evaluation
            return self._make(node)
        return self._folded(x, node)
