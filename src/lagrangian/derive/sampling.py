"""Evaluates expressions at many states at once: quickly in doubles, and with 50 digits to be certain.

The states are in blocks, so that one can see what a factor depends on: ``SETS`` sets of parameters, each with
``PLACES`` positions (coordinates and time), each with as many motions (rates, accelerations, inputs) as requested.
Every value is a multiple of 2⁻¹², so that doubles and 50 digits represent the same state.
"""

# SymPy and mpmath have no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownArgumentType=false

from __future__ import annotations

import random
import threading
from collections import OrderedDict
from collections.abc import Iterable, Mapping, Sequence
from functools import lru_cache
from typing import Any, Protocol, cast

import mpmath
import numpy as np
import sympy as sp
from numpy.typing import NDArray
from sympy.core.function import AppliedUndef

from lagrangian.bounded import is_counted
from lagrangian.graph import Graph, Output, Program, evaluate, from_sympy, reached, vjp
from lagrangian.model import Model, time
from lagrangian.page.plain import plain

SETS, PLACES = 2, 3
DIGITS = 50
SIZES = 3
"""The number of sizes of states with a reach, each with both signs."""
EXACT_INTEGER = 2**53
"""Larger whole numbers are not always exact in doubles."""
MOST_KEPT, LONGEST_KEPT = 200, 2_000
"""The most lists of expressions whose graphs are kept, and the most nodes of such a graph."""

Array = NDArray[np.float64]


class Placed(Protocol):
    """A coordinate that is restricted to one side; see `branches` in `check`."""

    @property
    def q(self) -> sp.Expr:
        """The coordinate."""
        ...

    def put(self, values: Array, states: States) -> Array:
        """Its values, all on that side."""
        ...


class States:
    """Random states in blocks; the values of a symbol depend only on its name.

    With a ``reach``, moving quantities have either sign and any size up to it, for expressions that are not smooth. A
    distance stays on its side.
    """

    def __init__(self, model: Model, motions: int, *, reach: float = 0.0, sides: Sequence[Placed] = ()) -> None:
        self.model = model
        self.sides: dict[sp.Basic, Placed] = {side.q: side for side in sides}
        self.reach = reach
        self.motions = motions
        self.size = SETS * PLACES * motions
        self._known: dict[sp.Basic, Array] = {}
        self.fixed = 0
        """How often a symbol was given other values."""

    def of(self, symbol: sp.Basic) -> Array:
        """The values of a symbol, shape (size,): constant within a set for parameters, within a position for
        coordinates."""
        if symbol not in self._known:
            self._known[symbol] = self._drawn(symbol)
        return self._known[symbol]

    def _drawn(self, symbol: sp.Basic) -> Array:
        inputs = {u.symbol for u in self.model.inputs}
        if symbol == time or (isinstance(symbol, AppliedUndef) and symbol not in inputs):
            count, low = SETS * PLACES, 0.3
        elif isinstance(symbol, sp.Symbol):
            count, low = SETS, 0.4
        else:
            count, low = self.size, -1.6
        drawn: Sequence[float] = _numbers(symbol, low, count)
        if self.reach and not isinstance(symbol, sp.Symbol):
            far = [(-1) ** k * self.reach ** (k // 2 % SIZES / (SIZES - 1)) for k in range(count)]
            drawn = [round(x * f * 4096) / 4096 for x, f in zip(drawn, far, strict=True)]
        values = np.repeat(np.array(drawn), self.size // count)
        return self.sides[symbol].put(values, self) if symbol in self.sides else values

    def fix(self, symbol: sp.Basic, values: Array) -> None:
        """Give a symbol values that follow from those of others."""
        self._known[symbol] = values
        self.fixed += 1

    def blocks(self) -> Iterable[slice]:
        """The states for each position."""
        return (slice(i, i + self.motions) for i in range(0, self.size, self.motions))


@lru_cache(maxsize=2_000)
def _numbers(symbol: sp.Basic, low: float, count: int) -> tuple[float, ...]:
    """Random numbers, with few digits, for a symbol; drawn once, as most symbols are needed at many sets of states."""
    source = random.Random(f"state of {plain(symbol)}")
    return tuple(round(source.uniform(low, 1.6) * 4096) / 4096 or 0.5 for _ in range(count))


class CompiledExpressions:
    """Expressions as one graph, for evaluation at states.

    Many questions are asked of the same lines: a graph, and its values, are made once for those seen most recently.
    """

    def __init__(self, exprs: Iterable[sp.Expr]) -> None:
        listed: tuple[sp.Expr, ...] = tuple(sp.sympify(e) for e in exprs)
        recent = None if not listed or is_counted() else _recent.graphs
        if recent is not None and (made := recent.get(listed)) is not None:
            recent.move_to_end(listed)
            vars(self).update(made)
            return
        self.graph = Graph()
        self._numbers: dict[sp.Basic, Any] = {}
        self.symbols: list[sp.Basic] = []
        self.table: dict[sp.Basic, int] = {}
        self._memo: dict[Any, int] = {}
        self.ids = [self.node(e) for e in listed]
        self._walked: dict[tuple[int, ...], list[_Step]] = {}
        self._values: dict[tuple[int, ...], tuple[States, int, Array]] = {}
        self._slopes: dict[tuple[sp.Basic, ...], CompiledExpressions] = {}
        if recent is not None and len(self.graph.nodes) <= LONGEST_KEPT:
            recent[listed] = vars(self).copy()
            while len(recent) > MOST_KEPT:
                recent.popitem(last=False)

    def node(self, expr: sp.Expr) -> int:
        """The node of an expression; its fractions become inputs, so that they can be exact."""
        expr = sp.sympify(expr)
        if expr in self._memo:
            return self._memo[expr]
        names, numbers, roots = self._fresh(expr)
        expr, exact = self._without_fractions(expr, numbers, roots)
        for s in sorted((names | exact) - self.table.keys(), key=_place):
            self.input(s)
        return from_sympy(self.graph, expr, self.table, self._memo)

    def _fresh(self, expr: sp.Basic) -> tuple[set[sp.Basic], list[Any], list[Any]]:
        """What is in an expression and in none before it, whose parts have neither fractions nor new symbols: its
        symbols, its numbers that may be no doubles, and the powers and functions of whole numbers."""
        found, names = set[sp.Basic](), set[sp.Basic]()
        numbers: list[Any] = []
        roots: list[Any] = []
        stack: list[Any] = [expr]
        memo = self._memo
        while stack:
            part = stack.pop()
            if part in found or part in memo:
                continue
            found.add(part)
            if isinstance(part, (sp.Symbol, AppliedUndef)):
                names.add(part)
            elif isinstance(part, sp.Derivative):
                names |= {part, part.expr}
            elif isinstance(part, (sp.Rational, sp.Float, sp.NumberSymbol)):
                if not (isinstance(part, sp.Integer) and abs(int(part)) <= EXACT_INTEGER):
                    numbers.append(part)
            else:
                stack += part.args
                whole = bool(part.args) and isinstance(part.args[0], sp.Integer)
                halved = isinstance(part, sp.Function) and part.args[0] in (sp.S.Half, -sp.S.Half)
                if (whole and isinstance(part, (sp.Pow, sp.Function))) or halved:
                    roots.append(part)
        return names, numbers, roots

    def input(self, symbol: sp.Basic) -> int:
        """The node of a symbol."""
        if symbol not in self.table:
            self.table[symbol] = self.graph.input("x", len(self.symbols))
            self.symbols.append(symbol)
        return self.table[symbol]

    def _without_fractions(
        self, expr: sp.Expr, numbers: Sequence[Any], roots: Sequence[Any]
    ) -> tuple[sp.Expr, set[sp.Basic]]:
        """An expression with symbols for its fractions ``numbers`` and for whole numbers in its ``roots``, and these
        symbols."""
        table: dict[sp.Basic, sp.Expr] = {}
        for number in numbers:
            if number in (sp.S.Half, -sp.S.Half):  # roots: x^(1/2) is the graph's square root
                continue
            exact = sp.Rational(str(number)) if isinstance(number, sp.Float) else number
            dummy = sp.Symbol(f"number {exact}")
            self._numbers[dummy] = exact
            table[number] = dummy
        for root in roots:  # the graph would evaluate √15, sin 2 and cos ½ as doubles
            whole, *others = root.args
            if all(isinstance(x, sp.Rational) and x.q > 1 for x in others):
                dummy = table.get(whole, sp.Symbol(f"number {whole}"))
                self._numbers[dummy] = whole
                more: list[Any] = [table.get(x, x) for x in others]
                table[root] = root.func(dummy, *more)
        symbols = set[sp.Basic]().union(*(x.free_symbols for x in table.values()))
        return (cast("sp.Expr", expr.xreplace(table)) if table else expr), symbols

    def slopes(self, symbols: Sequence[sp.Basic]) -> CompiledExpressions:
        """∂expression/∂symbol for one expression after another."""
        if (made := self._slopes.get(tuple(symbols))) is not None:
            return made
        by = [self.input(x) for x in symbols]
        other = CompiledExpressions([])
        other.graph, other.symbols, other.table, other._numbers = self.graph, self.symbols, self.table, self._numbers
        other.ids = [x for i in self.ids for x in vjp(self.graph, [i], [self.graph.one], by)]
        self._slopes[tuple(symbols)] = other
        return other

    def at(self, states: States, instead: Mapping[sp.Basic, Array] | None = None) -> Array:
        """The values at every state, shape (expressions, size); ``instead`` overrides symbols."""
        if instead:
            return self.at_each(states, [instead])[:, 0]
        ids = tuple(self.ids)
        known = self._values.get(ids)
        if known is None or known[0] is not states or known[1] != states.fixed:
            known = self._values[ids] = states, states.fixed, self.at_each(states, [{}])[:, 0]
        return known[2].copy()

    def at_each(self, states: States, instead: Sequence[Mapping[sp.Basic, Array]]) -> Array:
        """The values at every state, once with each of the values in ``instead``: shape (expressions, times, size)."""
        times = len(instead)
        inputs: list[Array] = []
        for s in self.symbols:
            if s in self._numbers:
                inputs.append(_constant(float(self._numbers[s]), states.size * times))
            elif times == 1:
                inputs.append(instead[0][s] if s in instead[0] else states.of(s))
            elif not any(s in x for x in instead):
                inputs.append(np.tile(states.of(s), times))
            else:
                inputs.append(np.concatenate([x[s] if s in x else states.of(s) for x in instead]))
        ids = tuple(self.ids)
        if ids not in self._walked:
            self._walked[ids] = _steps(self.graph, reached(self.graph, self.ids))
        found = _walk(self._walked[ids], self.ids, inputs, states.size * times)
        return found.reshape(len(self.ids), times, states.size)

    def exactly(self, states: States, index: int, instead: Mapping[sp.Basic, Any] | None = None) -> list[Any]:
        """The values at one state, with 50 digits."""
        instead = instead or {}
        with mpmath.workdps(DIGITS):
            x: list[Any] = []
            for s in self.symbols:
                if s in self._numbers:
                    x.append(_precise(self._numbers[s]))
                else:
                    x.append(instead[s] if s in instead else mpmath.mpf(float(states.of(s)[index])))
            program = Program(
                "check",
                self.graph,
                {"x": tuple(map(str, range(len(x))))},
                {"y": Output(tuple(self.ids), (len(self.ids),))},
                {},
            )
            return list(evaluate(program, {"x": x}, digits=DIGITS)["y"]) if self.ids else []


class _Recent(threading.local):
    """What was compiled most recently in a thread, as graphs grow."""

    def __init__(self) -> None:
        self.graphs: OrderedDict[tuple[sp.Expr, ...], dict[str, Any]] = OrderedDict()


_recent = _Recent()


def _precise(number: sp.Expr) -> Any:
    if isinstance(number, sp.Rational):
        return cast("Any", mpmath.mpf(int(number.p)) / int(number.q))
    return cast("Any", mpmath.mpf(str(sp.N(number, DIGITS + 5))))


def _select(condition: Array, yes: Array, no: Array) -> Array:
    return np.where(condition.astype(bool), yes, no)


_NUMPY: dict[str, Any] = {
    "add": np.add,
    "sub": np.subtract,
    "mul": np.multiply,
    "div": np.divide,
    "neg": np.negative,
    "abs": np.abs,
    "sign": np.sign,
    "min": np.minimum,
    "max": np.maximum,
    "pow": np.power,
    "atan2": np.arctan2,
    "asin": np.arcsin,
    "acos": np.arccos,
    "atan": np.arctan,
    "asinh": np.arcsinh,
    "acosh": np.arccosh,
    "atanh": np.arctanh,
    "lt": np.less,
    "le": np.less_equal,
    "eq": np.equal,
    "and": np.logical_and,
    "or": np.logical_or,
    "not": np.logical_not,
    "select": _select,
    **{name: getattr(np, name) for name in ("sqrt", "sin", "cos", "tan", "sinh", "cosh", "tanh", "exp", "log")},
}


_Step = tuple[int, Any, tuple[Any, ...]]
"""A node, how its values are found (a function, or the kind of a leaf), and from what."""


def _steps(graph: Graph, order: Sequence[int]) -> list[_Step]:
    """What there is to do, one after the other, for the values of the nodes in ``order``."""
    steps: list[_Step] = []
    for i in order:
        node = graph.nodes[i]
        op = node[0]
        steps.append((i, op, node[1:]) if op in ("const", "input", "powi") else (i, _NUMPY[op], node[1:]))
    return steps


def _walk(steps: Sequence[_Step], ids: Sequence[int], inputs: Sequence[Array], size: int) -> Array:
    """The values of nodes as arrays over the states, step by step; NaN if there is no value."""
    value: dict[int, Any] = {}
    with np.errstate(all="ignore"):
        for i, op, parts in steps:
            if op == "input":
                value[i] = inputs[parts[1]]
            elif op == "const":
                value[i] = _constant(parts[0], size)
            elif op == "powi":
                value[i] = np.power(value[parts[0]], float(parts[1]))
            elif len(parts) == 2:
                value[i] = op(value[parts[0]], value[parts[1]])
            else:
                value[i] = op(*[value[k] for k in parts])
    return np.array([value[i] for i in ids], dtype=float).reshape(len(ids), size)


@lru_cache(maxsize=1_000)
def _constant(number: float, size: int) -> Array:
    """A number at every state; to be read only."""
    found = np.full(size, number)
    found.flags.writeable = False
    return found


@lru_cache(maxsize=5_000)
def _place(symbol: sp.Basic) -> Any:
    """The place of a symbol among others, which SymPy takes long to find."""
    return cast("Any", sp.default_sort_key(symbol))
