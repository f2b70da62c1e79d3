"""The expression graph: scalar operations in static single assignment, every one of them made once.

A node is ``(operation, operand ids)``; the same pair never exists twice, so what two expressions share is computed
once. Operands are smaller than the node itself: increasing ids are an order of evaluation. Nodes are only added.

What is rewritten when a node is made is exact in real arithmetic and never longer: ``0·x``, ``1·x``, ``x − x``,
``−(−x)``, ``a + (−b) → a − b``, signs pulled out of products and odd functions, constants folded, operands of
commutative operations ordered.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from lagrangian.errors import ModelError

Node = tuple  # (operation, *operands)

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
"""Functions of one number, and what folds them on constants; outside their domain nothing is folded."""

ODD = frozenset({"sin", "tan", "asin", "atan", "sinh", "tanh", "asinh", "atanh"})
EVEN = frozenset({"cos", "cosh"})
CONDITIONS = frozenset({"lt", "le", "eq", "and", "or", "not"})
LEAVES = frozenset({"const", "input"})
MAX_EXPONENT = 1 << 20
"""Greatest whole exponent: beyond it a power is ``pow``, not repeated products."""


def operands(node: Node) -> tuple[int, ...]:
    """The ids a node reads, in order."""
    op = node[0]
    if op == "const" or op == "input":
        return ()
    if op == "powi":
        return (node[1],)
    return node[1:]


class Graph:
    """A hash-consed graph of scalar operations.

    ``nodes[i]`` is ``("const", x)``, ``("input", group, index)``, ``("powi", a, n)`` with a literal whole ``n``, or an
    operation followed by the ids of its operands. Conditions (``lt le eq and or not``) are read by ``select`` and by
    each other alone; one that is known when it is made is the constant 1 or 0, and what reads it is simplified.

    >>> g = Graph()
    >>> x = g.input("x", 0)
    >>> g.sub(g.add(x, g.const(0.0)), x) == g.zero
    True
    """

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
        """A number. Raises `ModelError` where it is not one."""
        x = float(x) + 0.0  # −0 is 0
        if x != x:
            raise ModelError("a constant of an expression is not a number (nan)", code="E101")
        return self._make(("const", x))

    def input(self, group: str, index: int) -> int:
        """Entry ``index`` of the input group."""
        return self._make(("input", group, index))

    def value(self, a: int) -> float | None:
        """The number a constant node is, else None."""
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
        na, nb = nodes[a], nodes[b]
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
            if ob == "mul" and nodes[nb[1]][0] == "const":
                return self.mul(self._folded(c * nodes[nb[1]][1], ("mul", a, nb[1])), nb[2])
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
        """a / b. A division by the constant 0 is kept: it is infinite or not a number when it is evaluated."""
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
            if abs(mantissa) == 0.5 and abs(nb[1]) > 1e-300:  # a power of two: its reciprocal is exact
                return self.mul(self.const(1.0 / nb[1]), a)
            if nb[1] < 0.0:
                return self.neg(self.div(a, self.const(-nb[1])))
        if na[0] == "neg":
            return self.neg(self.div(na[1], b))
        if nb[0] == "neg":
            return self.neg(self.div(a, nb[1]))
        return self._make(("div", a, b))

    def powi(self, a: int, n: int) -> int:
        """a^n for a whole number n known here."""
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

    def _folded(self, x: float, node: Node) -> int:
        """The constant x where it is finite; else the operation itself, so that nothing becomes infinite unseen."""
        return self.const(x) if math.isfinite(x) else self._make(node)

    def _attempt(self, compute: Callable[[], float], node: Node) -> int:
        try:
            x = compute()
        except (ValueError, OverflowError, ZeroDivisionError):  # outside the domain: left to the evaluation
            return self._make(node)
        return self._folded(x, node)

    # -- functions ----------------------------------------------------------------------------------------------

    def unary(self, op: str, a: int) -> int:
        """A function of `UNARY` by name."""
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
                other = self._known.get((op, mirrored))  # sin(a − b) = −sin(b − a), where the latter is there already
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
        """The smaller one."""
        return self._extreme("min", a, b)

    def max(self, a: int, b: int) -> int:
        """The greater one."""
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
        """Both conditions."""
        if self.zero in (a, b):
            return self.zero
        if a == self.one or a == b:
            return b
        return a if b == self.one else self._make(("and", *sorted((a, b))))

    def or_(self, a: int, b: int) -> int:
        """Either condition."""
        if self.one in (a, b):
            return self.one
        if a == self.zero or a == b:
            return b
        return a if b == self.zero else self._make(("or", *sorted((a, b))))

    def not_(self, a: int) -> int:
        """The opposite condition."""
        if a in (self.zero, self.one):
            return self.one if a == self.zero else self.zero
        node = self.nodes[a]
        return node[1] if node[0] == "not" else self._make(("not", a))

    def select(self, condition: int, a: int, b: int) -> int:
        """``a`` where the condition holds, else ``b``."""
        if a == b or condition == self.one:
            return a
        if condition == self.zero:
            return b
        node = self.nodes[condition]
        if node[0] == "not":
            return self.select(node[1], b, a)
        return self._make(("select", condition, a, b))
