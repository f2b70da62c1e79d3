"""The expression graph: scalar operations in static single assignment, each made only once.

A node is ``(operation, operand ids)``; the same pair never exists twice, so a subexpression that occurs twice is
computed once. The ids of the operands are smaller than that of the node, so ascending ids are a valid order of
evaluation. Nodes are never removed.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from lagrangian.graph.arithmetic import MAX_EXPONENT, Arithmetic, Node

UNARY: dict[str, Callable[[float], float]] = {
    "sqrt": math.sqrt,
    "sin": math.sin,
    "cos": math.cos,
    "tan": math.tan,
    "asin": math.asin,
    "acos": math.acos,
    "atan": math.atan,
    "sinh": math.sinh,
    "cosh": math.cosh,
    "tanh": math.tanh,
    "asinh": math.asinh,
    "acosh": math.acosh,
    "atanh": math.atanh,
    "exp": math.exp,
    "log": math.log,
}
"""Functions of one variable with the Python function that folds constants; outside the domain nothing is folded."""

ODD = frozenset({"sin", "tan", "asin", "atan", "sinh", "tanh", "asinh", "atanh"})
EVEN = frozenset({"cos", "cosh"})
CONDITIONS = frozenset({"lt", "le", "eq", "and", "or", "not"})
LEAVES = frozenset({"const", "input"})
_NOT_ALL_OPERANDS = LEAVES | {"powi"}  # the entries of every other node are its operands


def operands(node: Node) -> tuple[int, ...]:
    """The ids that a node reads, in order."""
    if node[0] not in _NOT_ALL_OPERANDS:
        return node[1:]
    return (node[1],) if node[0] == "powi" else ()


class Graph(Arithmetic):
    """A hash-consed graph of scalar operations.

    ``nodes[i]`` is ``("const", x)``, ``("input", group, index)``, ``("powi", a, n)`` with a literal whole ``n``, or an
    operation followed by the ids of its operands. Only ``select`` and other conditions may read conditions (``lt le eq
    and or not``). A condition that is known when it is made becomes the constant 1 or 0, and what reads it is
    simplified.

    >>> g = Graph()
    >>> x = g.input("x", 0)
    >>> g.sub(g.add(x, g.const(0.0)), x) == g.zero
    True
    """

    __slots__ = ()

    # -- functions ----------------------------------------------------------------------------------------------

    def pow(self, a: int, b: int) -> int:
        """a^b; whole and half exponents become `powi` and `sqrt`."""
        exponent = self.value(b)
        if exponent is not None:
            if exponent == 0.5:
                return self.sqrt(a)
            if exponent == -0.5:
                return self.div(self.one, self.sqrt(a))
            if exponent.is_integer() and abs(exponent) <= MAX_EXPONENT:
                return self.powi(a, int(exponent))
            base = self.value(a)
            if base is not None:
                return self._attempt(lambda: math.pow(base, exponent), ("pow", a, b))
        return self._make(("pow", a, b))

    def unary(self, op: str, a: int) -> int:
        """The function in `UNARY` with this name."""
        node = self.nodes[a]
        if node[0] == "const":
            return self._attempt(lambda: UNARY[op](node[1]), (op, a))
        if node[0] == "neg":
            if op in ODD:
                return self.neg(self.unary(op, node[1]))
            if op in EVEN:
                a = node[1]
        elif node[0] == "sub" and (op in ODD or op in EVEN):
            found = self._known.get((op, a))
            if found is None and (mirrored := self._known.get(("sub", node[2], node[1]))) is not None:
                other = self._known.get((op, mirrored))  # sin(a − b) = −sin(b − a), if the latter already exists
                if other is not None:
                    return self.neg(other) if op in ODD else other
        return self._make((op, a))

    def sqrt(self, a: int) -> int:
        """√a."""
        return self.unary("sqrt", a)

    def sin(self, a: int) -> int:
        """sin a."""
        return self.unary("sin", a)

    def cos(self, a: int) -> int:
        """cos a."""
        return self.unary("cos", a)

    def tan(self, a: int) -> int:
        """tan a."""
        return self.unary("tan", a)

    def asin(self, a: int) -> int:
        """arcsin a."""
        return self.unary("asin", a)

    def acos(self, a: int) -> int:
        """arccos a."""
        return self.unary("acos", a)

    def atan(self, a: int) -> int:
        """arctan a."""
        return self.unary("atan", a)

    def sinh(self, a: int) -> int:
        """sinh a."""
        return self.unary("sinh", a)

    def cosh(self, a: int) -> int:
        """cosh a."""
        return self.unary("cosh", a)

    def tanh(self, a: int) -> int:
        """tanh a."""
        return self.unary("tanh", a)

    def asinh(self, a: int) -> int:
        """arsinh a."""
        return self.unary("asinh", a)

    def acosh(self, a: int) -> int:
        """arcosh a."""
        return self.unary("acosh", a)

    def atanh(self, a: int) -> int:
        """artanh a."""
        return self.unary("atanh", a)

    def exp(self, a: int) -> int:
        """e^a."""
        return self.unary("exp", a)

    def log(self, a: int) -> int:
        """ln a."""
        return self.unary("log", a)

    def abs(self, a: int) -> int:
        """|a|."""
        node = self.nodes[a]
        if node[0] == "const":
            return self.const(math.fabs(node[1]))
        if node[0] == "neg":
            return self.abs(node[1])
        if node[0] in ("abs", "sqrt", "exp", "cosh") or (node[0] == "mul" and node[1] == node[2]):
            return a
        return self._make(("abs", a))

    def sign(self, a: int) -> int:
        """−1, 0 or 1."""
        node = self.nodes[a]
        if node[0] == "const":
            return self.const(math.copysign(1.0, node[1]) if node[1] else 0.0)
        if node[0] == "neg":
            return self.neg(self.sign(node[1]))
        return self._make(("sign", a))

    def atan2(self, y: int, x: int) -> int:
        """The angle of the point (x, y) from the x axis, in (−π, π]."""
        vy, vx = self.value(y), self.value(x)
        if vy is not None and vx is not None:
            return self.const(math.atan2(vy, vx))
        return self._make(("atan2", y, x))

    def min(self, a: int, b: int) -> int:
        """The smaller of two nodes."""
        return self._extreme("min", a, b)

    def max(self, a: int, b: int) -> int:
        """The larger of two nodes."""
        return self._extreme("max", a, b)

    def _extreme(self, op: str, a: int, b: int) -> int:
        if a == b:
            return a
        va, vb = self.value(a), self.value(b)
        if va is not None and vb is not None:
            return self.const(min(va, vb) if op == "min" else max(va, vb))
        return self._make((op, a, b) if a < b else (op, b, a))

    # -- conditions ---------------------------------------------------------------------------------------------

    def lt(self, a: int, b: int) -> int:
        """Whether a < b."""
        return self._compared("lt", a, b, same=False)

    def le(self, a: int, b: int) -> int:
        """Whether a ≤ b."""
        return self._compared("le", a, b, same=True)

    def eq(self, a: int, b: int) -> int:
        """Whether a = b."""
        return self._compared("eq", *sorted((a, b)), same=True)

    def _compared(self, op: str, a: int, b: int, *, same: bool) -> int:
        va, vb = self.value(a), self.value(b)
        if va is not None and vb is not None:
            truth = va < vb if op == "lt" else va <= vb if op == "le" else va == vb
            return self.one if truth else self.zero
        if a == b:
            return self.one if same else self.zero
        return self._make((op, a, b))

    def and_(self, a: int, b: int) -> int:
        """Whether both conditions hold."""
        if self.zero in (a, b):
            return self.zero
        if a == self.one or a == b:
            return b
        return a if b == self.one else self._make(("and", *sorted((a, b))))

    def or_(self, a: int, b: int) -> int:
        """Whether either condition holds."""
        if self.one in (a, b):
            return self.one
        if a == self.zero or a == b:
            return b
        return a if b == self.zero else self._make(("or", *sorted((a, b))))

    def not_(self, a: int) -> int:
        """The negation of a condition."""
        if a in (self.zero, self.one):
            return self.one if a == self.zero else self.zero
        node = self.nodes[a]
        return node[1] if node[0] == "not" else self._make(("not", a))

    def select(self, condition: int, a: int, b: int) -> int:
        """``a`` if the condition holds, otherwise ``b``."""
        if a == b or condition == self.one:
            return a
        if condition == self.zero:
            return b
        node = self.nodes[condition]
        if node[0] == "not":
            return self.select(node[1], b, a)
        return self._make(("select", condition, a, b))
