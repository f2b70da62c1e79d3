"""A slow and simple interpreter of programs, with which all back ends are compared.

In double precision every operation follows IEEE 754: a division by zero or an argument outside the domain gives
infinity or NaN, never an exception. With mpmath, the same evaluation uses the requested number of decimal digits.
"""

# mpmath has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownVariableType=false
# pyright: reportUnknownArgumentType=false, reportUnknownLambdaType=false

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import mpmath

from lagrangian.errors import RunError
from lagrangian.graph.arithmetic import Node
from lagrangian.graph.graph import LEAVES, UNARY, Graph, operands
from lagrangian.graph.program import Program, reached

Table = Mapping[str, Callable[..., Any]]


def _guarded(function: Callable[..., float]) -> Callable[..., float]:
    """The function, with NaN outside its domain and infinity beyond the largest double."""

    def call(*x: float) -> float:
        try:
            return function(*x)
        except ValueError:
            return math.nan
        except OverflowError:
            return math.inf

    return call


def _divide(a: float, b: float) -> float:
    if b == 0.0:
        return math.nan if a == 0.0 or a != a else math.copysign(math.inf, a) * math.copysign(1.0, b)
    return a / b


def _log(a: float) -> float:
    return -math.inf if a == 0.0 else math.log(a) if a > 0.0 else math.nan


def _atanh(a: float) -> float:
    return math.copysign(math.inf, a) if abs(a) == 1.0 else _guarded(math.atanh)(a)


def _pow(a: float, b: float) -> float:
    try:
        return math.pow(a, b)
    except ValueError:  # 0 to a negative power is infinite; a negative base to a fractional power is NaN
        return math.nan if a else (math.copysign(math.inf, a) if b % 2 == 1 else math.inf)
    except OverflowError:
        return -math.inf if a < 0 and b % 2 == 1 else math.inf


def _sinh(a: float) -> float:
    return math.copysign(_guarded(math.sinh)(abs(a)), a)


def _sign(a: Any) -> Any:
    return a if a != a else (a > 0) - (a < 0)


def _min(a: Any, b: Any) -> Any:
    return a if a != a or a <= b else b


def _max(a: Any, b: Any) -> Any:
    return a if a != a or a >= b else b


_SHARED: Table = {
    "add": operator.add,
    "sub": operator.sub,
    "mul": operator.mul,
    "neg": operator.neg,
    "abs": abs,
    "min": _min,
    "max": _max,
    "lt": operator.lt,
    "le": operator.le,
    "eq": operator.eq,
    "and": lambda a, b: bool(a) and bool(b),
    "or": lambda a, b: bool(a) or bool(b),
    "not": operator.not_,
    "select": lambda c, a, b: a if c else b,
}

DOUBLE: Table = {
    **_SHARED,
    **{name: _guarded(function) for name, function in UNARY.items()},
    "div": _divide,
    "log": _log,
    "atanh": _atanh,
    "sinh": _sinh,
    "pow": _pow,
    "powi": lambda a, n: _pow(a, float(n)),
    "sign": lambda a: float(_sign(a)),
    "atan2": math.atan2,
}


def _real(function: Callable[..., Any]) -> Callable[..., Any]:
    """The mpmath function, with NaN where its value is not real or not defined."""

    def call(*x: Any) -> Any:
        try:
            y = function(*x)
        except (ValueError, ZeroDivisionError):
            return mpmath.nan
        return mpmath.nan if isinstance(y, mpmath.mpc) else y

    return call


def _divide_exactly(a: Any, b: Any) -> Any:
    if b == 0:
        return mpmath.nan if a == 0 or a != a else mpmath.sign(a) * mpmath.inf
    return a / b


MANY_DIGITS: Table = {
    **_SHARED,
    **{name: _real(getattr(mpmath, name)) for name in UNARY},
    "div": _divide_exactly,
    "log": lambda a: mpmath.log(a) if a > 0 else -mpmath.inf if a == 0 else mpmath.nan,
    "pow": _real(mpmath.power),
    "powi": lambda a, n: _divide_exactly(mpmath.mpf(1), a**-n) if n < 0 else a**n,
    "sign": lambda a: a if a != a else mpmath.sign(a),
    "atan2": mpmath.atan2,
}


def evaluate(program: Program, inputs: Mapping[str, Sequence[Any]], *, digits: int | None = None) -> dict[str, Any]:
    """The outputs of ``program``, each a number or nested lists of its shape.

    ``inputs`` contains a sequence of numbers for each group. ``digits`` requests mpmath numbers with that many decimal
    digits (constants remain doubles). A group that is omitted takes the defaults of its entries. Raises `RunError` if a
    group is missing or has the wrong length.
    """
    values = {group: _entries(program, group, inputs) for group in program.inputs}
    if digits is None:
        flat = computed(program, values, DOUBLE, float)
    else:
        with mpmath.workdps(digits):
            flat = computed(program, values, MANY_DIGITS, mpmath.mpf)
    return {name: _shaped(flat[name], out.shape) for name, out in program.outputs.items()}


class Valuation:
    """The values of the nodes of a graph at one place, in double precision; where it grows, only the rest is computed.

    ``inputs`` has the numbers of every group that is asked for.
    """

    def __init__(self, graph: Graph, inputs: Mapping[str, Sequence[float]]) -> None:
        self._graph, self._inputs = graph, inputs
        self._known: dict[int, Any] = {}

    def value(self, i: int) -> float:
        """The value of a node."""
        return self._known[i] if i in self._known else self((i,))[0]

    def __call__(self, ids: Sequence[int]) -> list[float]:
        """The values of nodes."""
        nodes, known = self._graph.nodes, self._known
        fresh: set[int] = set()
        stack = [i for i in ids if i not in known]
        while stack:
            i = stack.pop()
            if i not in fresh:
                fresh.add(i)
                stack.extend(k for k in operands(nodes[i]) if k not in known)
        for i in sorted(fresh):
            node = nodes[i]
            if node[0] in LEAVES:
                known[i] = _leaf(node, self._inputs, float)
            elif node[0] == "powi":
                known[i] = DOUBLE["powi"](known[node[1]], node[2])
            else:
                known[i] = DOUBLE[node[0]](*[known[k] for k in node[1:]])
        return [known[i] for i in ids]


def _entries(program: Program, group: str, inputs: Mapping[str, Sequence[Any]]) -> Sequence[Any]:
    names = program.inputs[group]
    if group not in inputs:
        defaults = [program.defaults.get(name) for name in names]
        missing = [name for name, value in zip(names, defaults, strict=True) if value is None]
        if missing:
            raise RunError(f"input group '{group}' is missing: {', '.join(missing)} have no value", code="E501")
        return defaults
    given = inputs[group]
    if len(given) != len(names):
        raise RunError(f"'{group}' has {len(given)} values, {len(names)} are needed: {', '.join(names)}", code="E501")
    return given


def computed(
    program: Program, inputs: Mapping[str, Sequence[Any]], table: Table, number: Callable[..., Any]
) -> dict[str, list[Any]]:
    """The entries of every output, by a table of operations on what ``number`` makes of inputs and constants."""
    leaves, steps, ends = program.remembered("interpreted", lambda: _plan(program))
    value = [_leaf(node, inputs, number) for node in leaves]
    for op, read in steps:
        value.append(table[op](*read(value)))
    return {name: [value[k] for k in places] for name, places in ends.items()}


Plan = tuple[list[Node], list[tuple[str, Callable[[list[Any]], Sequence[Any]]]], dict[str, list[int]]]
"""Leaves, then operations with what takes their operands out of the values so far, and the places of the outputs."""


def _plan(program: Program) -> Plan:
    """The operations of a program in order; the whole number of a power is a leaf of its own."""
    nodes, order = program.graph.nodes, reached(program.graph, program.ids)
    leaves: list[Node] = [nodes[i] for i in order if nodes[i][0] in LEAVES]
    place = {i: k for k, i in enumerate(i for i in order if nodes[i][0] in LEAVES)}
    powers = sorted({nodes[i][2] for i in order if nodes[i][0] == "powi"})
    literal = {n: len(leaves) + k for k, n in enumerate(powers)}
    leaves += [("literal", n) for n in powers]
    steps: list[tuple[str, Callable[[list[Any]], Sequence[Any]]]] = []
    for i in order:
        node = nodes[i]
        if node[0] not in LEAVES:
            where = [place[k] for k in operands(node)] + ([literal[node[2]]] if node[0] == "powi" else [])
            taken = where if len(where) > 1 else [slice(where[0], where[0] + 1)]
            steps.append((node[0], operator.itemgetter(*taken)))
            place[i] = len(leaves) + len(steps) - 1
    return leaves, steps, {name: [place[i] for i in out.ids] for name, out in program.outputs.items()}


def _leaf(node: Node, inputs: Mapping[str, Sequence[Any]], number: Callable[..., Any]) -> Any:
    if node[0] == "input":
        return number(inputs[node[1]][node[2]])
    return number(node[1]) if node[0] == "const" else node[1]


def _shaped(flat: list[Any], shape: tuple[int, ...]) -> Any:
    """A flat list as nested lists, row after row."""
    if not shape:
        return flat[0]
    if len(shape) == 1:
        return flat
    step = len(flat) // shape[0] if shape[0] else 0
    return [_shaped(flat[k * step : (k + 1) * step], shape[1:]) for k in range(shape[0])]
