"""Evaluates expressions at many states at once: quickly in doubles, and with 50 digits to be certain.

The states are in blocks, so that one can see what a factor depends on: ``SETS`` sets of parameters, each with
``PLACES`` positions (coordinates and time), each with as many motions (rates, accelerations, inputs) as requested.
Every value is a multiple of 2⁻¹², so that doubles and 50 digits represent the same state.
"""

# SymPy and mpmath have no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownArgumentType=false

from __future__ import annotations

import random
from collections.abc import Iterable, Mapping, Sequence
from functools import lru_cache
from typing import Any, Protocol, cast

import mpmath
import numpy as np
import sympy as sp
from numpy.typing import NDArray
from sympy.core.function import AppliedUndef

from lagrangian.graph import Graph, Output, Program, evaluate, from_sympy, reached, vjp
from lagrangian.model import Model, time
from lagrangian.page.plain import plain

SETS, PLACES = 2, 3
DIGITS = 50
SIZES = 3
"""The number of sizes of states with a reach, each with both signs."""
EXACT_INTEGER = 2**53
"""Larger whole numbers are not always exact in doubles."""

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

    def blocks(self) -> Iterable[slice]:
        """The states for each position."""
        return (slice(i, i + self.motions) for i in range(0, self.size, self.motions))


@lru_cache(maxsize=2_000)
def _numbers(symbol: sp.Basic, low: float, count: int) -> tuple[float, ...]:
    """Random numbers, with few digits, for a symbol; drawn once, as most symbols are needed at many sets of states."""
    source = random.Random(f"state of {plain(symbol)}")
    return tuple(round(source.uniform(low, 1.6) * 4096) / 4096 or 0.5 for _ in range(count))


class CompiledExpressions:
    """Expressions as one graph, for evaluation at states."""

    def __init__(self, exprs: Sequence[sp.Expr]) -> None:
        self.graph = Graph()
        self._numbers: dict[sp.Basic, Any] = {}
        self.symbols: list[sp.Basic] = []
        self.table: dict[sp.Basic, int] = {}
        self._memo: dict[Any, int] = {}
        self.ids = [self.node(e) for e in exprs]
        self._order: tuple[tuple[int, ...], list[int]] = (), []

    def node(self, expr: sp.Expr) -> int:
        """The node of an expression; its fractions become inputs, so that they can be exact."""
        expr = sp.sympify(expr)
        if expr in self._memo:
            return self._memo[expr]
        parts = self._fresh(expr)
        names = {x for x in parts if isinstance(x, (sp.Symbol, AppliedUndef, sp.Derivative))}
        names |= {x.expr for x in names if isinstance(x, sp.Derivative)}
        expr, exact = self._without_fractions(expr, parts)
        for s in sorted((names | exact) - self.table.keys(), key=sp.default_sort_key):
            self.input(s)
        return from_sympy(self.graph, expr, self.table, self._memo)

    def _fresh(self, expr: sp.Basic) -> set[sp.Basic]:
        """The parts of an expression that are in no expression before it: those have neither fractions nor new
        symbols."""
        found: set[sp.Basic] = set()
        stack = [expr]
        while stack:
            part = stack.pop()
            if part not in found and part not in self._memo:
                found.add(part)
                if not isinstance(part, (AppliedUndef, sp.Derivative)):
                    stack += part.args
        return found

    def input(self, symbol: sp.Basic) -> int:
        """The node of a symbol."""
        if symbol not in self.table:
            self.table[symbol] = self.graph.input("x", len(self.symbols))
            self.symbols.append(symbol)
        return self.table[symbol]

    def _without_fractions(self, expr: sp.Expr, parts: set[sp.Basic]) -> tuple[sp.Expr, set[sp.Basic]]:
        """An expression with symbols for fractions, and these symbols; ``parts`` are all parts of the expression."""
        table: dict[sp.Basic, sp.Expr] = {}
        for number in parts:
            if not isinstance(number, (sp.Rational, sp.Float, sp.NumberSymbol)):
                continue
            if isinstance(number, sp.Integer) and abs(int(number)) <= EXACT_INTEGER:
                continue
            if number in (sp.S.Half, -sp.S.Half):  # roots: x^(1/2) is the graph's square root
                continue
            exact = sp.Rational(str(number)) if isinstance(number, sp.Float) else number
            dummy = sp.Symbol(f"number {exact}")
            self._numbers[dummy] = exact
            table[number] = dummy
        for root in parts:  # the graph would evaluate √15 and sin 2 as doubles
            known = isinstance(root, (sp.Pow, sp.Function)) and not isinstance(root, AppliedUndef)
            whole, others = (root.args[0], root.args[1:]) if known and root.args else (None, ())
            if isinstance(whole, sp.Integer) and all(isinstance(x, sp.Rational) and x.q > 1 for x in others):
                dummy = table.get(whole, sp.Symbol(f"number {whole}"))
                self._numbers[dummy] = whole
                more: list[Any] = [table.get(x, x) for x in others]
                table[root] = cast("Any", root).func(dummy, *more)
        symbols = set[sp.Basic]().union(*(x.free_symbols for x in table.values()))
        return (cast("sp.Expr", expr.xreplace(table)) if table else expr), symbols

    def slopes(self, symbols: Sequence[sp.Basic]) -> CompiledExpressions:
        """∂expression/∂symbol for one expression after another."""
        by = [self.input(x) for x in symbols]
        other = CompiledExpressions([])
        other.graph, other.symbols, other.table, other._numbers = self.graph, self.symbols, self.table, self._numbers
        other.ids = [x for i in self.ids for x in vjp(self.graph, [i], [self.graph.one], by)]
        return other

    def at(self, states: States, instead: Mapping[sp.Basic, Array] | None = None) -> Array:
        """The values at every state, shape (expressions, size); ``instead`` overrides symbols."""
        instead = instead or {}
        inputs: list[Array] = []
        for s in self.symbols:
            if s in self._numbers:
                inputs.append(np.full(states.size, float(self._numbers[s])))
            else:
                inputs.append(instead[s] if s in instead else states.of(s))
        if self._order[0] != tuple(self.ids):
            self._order = tuple(self.ids), reached(self.graph, self.ids)
        return _walk(self.graph, self.ids, self._order[1], inputs, states.size)

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


def _walk(graph: Graph, ids: Sequence[int], order: Sequence[int], inputs: Sequence[Array], size: int) -> Array:
    """The values of nodes as arrays over the states, by all nodes that they need in ``order``; NaN if there is no
    value."""
    value: dict[int, Any] = {}
    with np.errstate(all="ignore"):
        for i in order:
            node = graph.nodes[i]
            op = node[0]
            if op == "const":
                value[i] = np.full(size, node[1])
            elif op == "input":
                value[i] = inputs[node[2]]
            elif op == "powi":
                value[i] = np.power(value[node[1]], float(node[2]))
            else:
                value[i] = _NUMPY[op](*(value[k] for k in node[1:]))
    return np.array([value[i] for i in ids], dtype=float).reshape(len(ids), size)
