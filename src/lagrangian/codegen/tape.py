"""Converts a Program to tapes: what is computed per parameter set, and what per state, in operations close to the
machine's.

A tape is a list of operations on earlier entries, like the graph, with these differences:

* a node that depends only on the hoisted group (the parameters) belongs to the *prologue*; the *body* reads it from
  a shared slot;
* a division by a constant, by something shared, or repeated with one divisor becomes a product with the reciprocal;
* a product that is used once, in a sum, becomes one fused operation; small powers are products; tan is sin/cos;
* nodes that no output needs are removed, and sin and cos of the same angle are adjacent.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from lagrangian.graph import operands as sources
from lagrangian.graph import reached
from lagrangian.records import dataclass, field

if TYPE_CHECKING:
    from lagrangian.graph import Program

Op = tuple[Any, ...]

LEAVES = frozenset({"const", "in", "shared"})
FLAGS = frozenset({"lt", "le", "eq", "and", "or", "not"})
POWER_BY_PRODUCTS = 64  # largest |n| for x^n as products: 2 log2 n of them, relative error below n ulp


@dataclass
class Tape:
    """Operations, and which of them are the outputs.

    Operands are positions in ``ops``. Leaves: ``("const", c)``, ``("in", slot)``, ``("shared", slot)``. In addition to
    the operations of the graph there are ``("fma", a, b, c)`` = ab + c, ``("fms", …)`` = ab − c, ``("fnma", …)`` = c −
    ab.
    """

    ops: list[Op] = field(default_factory=list)
    outputs: list[int] = field(default_factory=list)

    @property
    def operations(self) -> int:
        """The number of entries that compute something; a fused product and sum counts as one."""
        return sum(op[0] not in LEAVES for op in self.ops)


@dataclass(frozen=True)
class Lowered:
    """A program as two tapes.

    ``prologue``: hoisted inputs → shared slots. ``body``: other inputs and shared slots → outputs, one after another.
    ``groups`` are the body's input groups in the order of the slots, ``hoisted`` those of the prologue.
    """

    prologue: Tape
    body: Tape
    groups: tuple[str, ...]
    hoisted: tuple[str, ...]


def operands(op: Op) -> tuple[int, ...]:
    """The positions that an operation reads."""
    return () if op[0] in LEAVES else op[1:]


class _Builder:
    """A tape under construction, in which equal operations are made only once."""

    def __init__(self) -> None:
        self.ops: list[Op] = []
        self._known: dict[Op, int] = {}

    def add(self, *op: Any) -> int:
        found = self._known.get(op)
        if found is None:
            found = self._known[op] = len(self.ops)
            self.ops.append(op)
        return found

    def const(self, c: float) -> int:
        key = ("const", c, math.copysign(1.0, c))  # −0 is not 0
        found = self._known.get(key)
        if found is None:
            found = self._known[key] = len(self.ops)
            self.ops.append(("const", c))
        return found

    def power(self, base: int, n: int) -> int:
        """``base^n`` by squaring, n ≥ 1."""
        result: int | None = None
        while True:
            if n & 1:
                result = base if result is None else self.add("mul", result, base)
            n >>= 1
            if not n:
                assert result is not None
                return result
            base = self.add("mul", base, base)

    def reciprocal(self, a: int) -> int:
        return self.add("div", self.const(1.0), a)


def lower(program: Program, hoist: Iterable[str] = ("p",)) -> Lowered:
    """Split ``program`` and convert it to operations close to the machine's.

    ``hoist`` names the groups that are constant over many states; without any, the prologue is empty.
    """
    hoist = frozenset(hoist)
    nodes = program.graph.nodes
    wanted = program.ids
    order = reached(program.graph, wanted)
    hoisted = tuple(g for g in program.inputs if g in hoist)
    groups = tuple(g for g in program.inputs if g not in hoist)
    early, late = _slots(program, hoisted), _slots(program, groups)

    varies: dict[int, bool] = {}  # depends on a group that is not hoisted
    for i in order:
        node = nodes[i]
        moved = node[1] not in hoist if node[0] == "input" else any(varies[k] for k in sources(node))
        varies[i] = moved or not hoist
    divisors: dict[int, int] = {}
    for i in order:
        if nodes[i][0] == "div":
            divisors[nodes[i][2]] = divisors.get(nodes[i][2], 0) + 1

    prologue = _Builder()
    first: dict[int, int] = {}
    for i in order:
        if not varies[i]:
            first[i] = _translate(prologue, nodes[i], first, early, divisors)
    shared: dict[int, int] = {}  # entry of the prologue → shared slot
    body = _Builder()
    second: dict[int, int] = {}

    def share(entry: int) -> int:
        if prologue.ops[entry][0] == "const":
            return body.const(prologue.ops[entry][1])
        return body.add("shared", shared.setdefault(entry, len(shared)))

    for i in order:
        if not varies[i]:
            continue
        node = nodes[i]
        for k in sources(node):
            if k in first and not (node[0] == "div" and k == node[2]):
                second[k] = share(first[k])
        if node[0] == "div" and node[2] in first:  # x / y = x · (1/y), with the reciprocal computed once
            inverse = share(_inverse(prologue, first[node[2]]))
            second[i] = _scaled(body, second[node[1]], inverse)
        else:
            second[i] = _translate(body, node, second, late, divisors)
    for i in wanted:
        if i in first:
            second[i] = share(first[i])
    return Lowered(
        finished(prologue.ops, list(shared)), finished(body.ops, [second[i] for i in wanted]), groups, hoisted
    )


def _scaled(builder: _Builder, a: int, b: int) -> int:
    """``a b``, or just b if a is 1."""
    return b if builder.ops[a] == ("const", 1.0) else builder.add("mul", *sorted((a, b)))


def _inverse(builder: _Builder, a: int) -> int:
    op = builder.ops[a]
    if op[0] == "const":
        return builder.const(1.0 / op[1] if op[1] else math.copysign(math.inf, op[1]))
    return builder.reciprocal(a)


def _slots(program: Program, groups: Iterable[str]) -> dict[tuple[str, int], int]:
    """(group, index) → slot, with the groups one after another."""
    slots: dict[tuple[str, int], int] = {}
    for group in groups:
        for index in range(len(program.inputs[group])):
            slots[group, index] = len(slots)
    return slots


def _translate(
    builder: _Builder, node: Op, at: dict[int, int], slots: dict[tuple[str, int], int], divisors: dict[int, int]
) -> int:
    """Add one graph node to a tape; ``at`` maps nodes to entries."""
    kind = node[0]
    if kind == "const":
        return builder.const(node[1])
    if kind == "input":
        return builder.add("in", slots[node[1], node[2]])
    if kind == "powi":
        return _power(builder, at[node[1]], node[2])
    if kind == "pow":
        exponent = builder.ops[at[node[2]]]
        if exponent[0] == "const":
            return _constant_power(builder, at[node[1]], exponent[1])
    if kind == "tan":
        return builder.add("div", builder.add("sin", at[node[1]]), builder.add("cos", at[node[1]]))
    if kind == "div":
        top, bottom = at[node[1]], at[node[2]]
        if builder.ops[bottom][0] == "const" or divisors[node[2]] > 1:
            return _scaled(builder, top, _inverse(builder, bottom))
    return builder.add(kind, *(at[k] for k in node[1:]))


def _power(builder: _Builder, base: int, n: int) -> int:
    """``base^n`` for a whole n."""
    if n == 0:
        return builder.const(1.0)
    if abs(n) > POWER_BY_PRODUCTS:
        return builder.add("pow", base, builder.const(float(n)))
    value = builder.power(base, abs(n))
    return builder.reciprocal(value) if n < 0 else value


def _constant_power(builder: _Builder, base: int, exponent: float) -> int:
    """``base^exponent``; whole and half exponents need no call: ``x^(n/2) = √x x^((n−1)/2)``."""
    if exponent.is_integer() and abs(exponent) <= POWER_BY_PRODUCTS:
        return _power(builder, base, int(exponent))
    twice = 2 * exponent
    if twice.is_integer() and abs(twice) <= 9:
        value = builder.add("sqrt", base)
        whole = (abs(int(twice)) - 1) // 2
        if whole:
            value = builder.add("mul", value, builder.power(base, whole))
        return builder.reciprocal(value) if exponent < 0 else value
    return builder.add("pow", base, builder.const(exponent))


def finished(ops: list[Op], outputs: list[int]) -> Tape:
    """Fuse operations, remove unused ones, place sin beside cos, and renumber."""
    ops = _fused(ops, outputs)
    seen = set(outputs)
    for i in range(len(ops) - 1, -1, -1):
        if i in seen:
            seen.update(operands(ops[i]))
    pairs: dict[int, list[int]] = {}
    for i in sorted(seen):
        if ops[i][0] in ("sin", "cos"):
            pairs.setdefault(ops[i][1], []).append(i)
    tape, new = Tape(), {}

    def emit(i: int) -> None:
        op = ops[i]
        new[i] = len(tape.ops)
        tape.ops.append(op if op[0] in LEAVES else (op[0], *(new[k] for k in op[1:])))

    for i in sorted(seen):
        if i in new:
            continue
        for k in pairs[ops[i][1]] if ops[i][0] in ("sin", "cos") else (i,):
            emit(k)
    tape.outputs = [new[i] for i in outputs]
    return tape


def _fused(ops: list[Op], outputs: list[int]) -> list[Op]:
    """Turn ``ab + c``, ``ab − c`` and ``c − ab`` into one operation if the product has no other use."""
    uses = [0] * len(ops)
    for op in ops:
        for k in operands(op):
            uses[k] += 1
    for i in outputs:
        uses[i] += 1
    fused: list[Op] = []
    for op in ops:
        if op[0] in ("add", "sub"):
            a, b = op[1], op[2]
            if a != b and ops[b][0] == "mul" and uses[b] == 1:
                op = ("fma" if op[0] == "add" else "fnma", ops[b][1], ops[b][2], a)
            elif a != b and ops[a][0] == "mul" and uses[a] == 1:
                op = ("fma" if op[0] == "add" else "fms", ops[a][1], ops[a][2], b)
        fused.append(op)
    return fused
