"""Rows of constraints in the expression graph: A(q, t) q̇ + a0(q, t) = 0 as one-forms in the variables (q, t)."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownArgumentType=false

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from typing import Any, Protocol, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.errors import ModelError
from lagrangian.graph import Graph, Program, from_sympy, gradient, reached, replaced, to_sympy
from lagrangian.records import dataclass, field


class HasRow(Protocol):
    """The interface of a row: a name, its form c = 0 (linear in the rates), and f = 0 if c = ḟ."""

    @property
    def name(self) -> str:
        """The name that messages use."""
        ...

    @property
    def rate(self) -> sp.Expr:
        """The form c on velocities, zero if the constraint is satisfied."""
        ...

    @property
    def position(self) -> sp.Expr | None:
        """The form f on positions, zero if the constraint is satisfied; None for a row on velocities."""
        ...


@dataclass(frozen=True, eq=False)
class Variables:
    """The coordinates q(t) as SymPy functions, the time t, and the symbols of constants."""

    coordinates: tuple[sp.Expr, ...]
    time: sp.Symbol

    @property
    def all(self) -> tuple[sp.Expr, ...]:
        """The coordinates, then time: the columns of every form."""
        return (*self.coordinates, self.time)

    @property
    def rates(self) -> tuple[sp.Expr, ...]:
        """The rates of the coordinates."""
        return tuple(cast("sp.Expr", sp.Derivative(q, self.time)) for q in self.coordinates)


@dataclass(eq=False)
class Sheet:
    """A graph with nodes for the variables, and for exact numbers that doubles cannot represent."""

    variables: Variables
    graph: Graph = field(default_factory=Graph)
    symbols: dict[Any, int] = field(default_factory=dict[Any, int])
    numbers: dict[int, Fraction] = field(default_factory=dict[int, Fraction])
    programs: dict[Any, Program] = field(default_factory=dict[Any, Program])
    _memo: dict[Any, int] = field(default_factory=dict[Any, int])
    _differentials: dict[int, list[int]] = field(default_factory=dict[int, list[int]])

    def __post_init__(self) -> None:
        graph = self.graph
        for k, q in enumerate(self.variables.coordinates):
            self.symbols[q] = graph.input("q", k)
        self.symbols[self.variables.time] = graph.input("t", 0)
        for k, rate in enumerate(self.variables.rates):
            self.symbols[rate] = graph.input("rate", k)
        self.columns = tuple(self.symbols[x] for x in self.variables.all)
        self.rates = tuple(self.symbols[x] for x in self.variables.rates)
        self.pi = self.symbols[sp.pi] = graph.input("pi", 0)

    def node(self, expr: sp.Expr) -> int:
        """Return the node of an expression; symbols other than coordinates and time are constants."""
        expr = _spread_arguments(expr)
        for symbol in sorted(expr.free_symbols - set(self.symbols), key=str):
            self.symbols[symbol] = self.graph.input("p", len(self.symbols))
        for number in sorted(expr.atoms(sp.Rational), key=sp.default_sort_key):
            if number not in (0, 1, -1) and number not in self.symbols:
                made = self.symbols[number] = self.graph.input("number", len(self.numbers))
                self.numbers[made] = Fraction(int(number.p), int(number.q))
        return from_sympy(self.graph, expr, self.symbols, self._memo)

    def expression(self, node: int) -> sp.Expr:
        """Return the expression of a node."""
        return to_sympy(self.graph, node, {made: symbol for symbol, made in self.symbols.items()})

    def differential(self, node: int) -> list[int]:
        """Return df, one entry for every variable."""
        if node not in self._differentials:
            self._differentials[node] = gradient(self.graph, node, self.columns)
        return self._differentials[node]


def _spread_arguments(expr: sp.Expr) -> sp.Expr:
    """The expression with multiplied-out arguments of sines and exponentials: sin 2(x + y) is sin (2x + 2y)."""
    made: dict[sp.Basic, sp.Basic] = {}
    for part in expr.atoms(sp.sin, sp.cos, sp.tan, sp.exp, sp.sinh, sp.cosh, sp.tanh):
        inner = bounded.expand(cast("sp.Expr", part.args[0]))
        if inner != part.args[0]:
            made[part] = part.func(inner)
    return cast("sp.Expr", bounded.replaced(expr, made)) if made else expr


@dataclass(frozen=True, eq=False)
class RowForm:
    """A row as a one-form: its coefficients over (q, t), and the node of f if it is the differential df."""

    name: str
    coefficients: tuple[int, ...]
    position: int | None = None


def forms(sheet: Sheet, rows: Iterable[HasRow], values: Mapping[Any, Any] | None = None) -> list[RowForm]:
    """Return the rows as one-forms; ``values`` replace parameters.

    Raises `ModelError` for a row that is not linear in the rates.
    """
    found: list[RowForm] = []
    for row in rows:
        rate = cast("sp.Expr", row.rate.xreplace(dict(values)) if values else row.rate)
        f = row.position
        if f is not None and values:
            f = cast("sp.Expr", f.xreplace(dict(values)))
        found.append(_form(sheet, row.name, rate, None if f is None else sheet.node(f)))
    return found


def _form(sheet: Sheet, name: str, rate: sp.Expr, position: int | None) -> RowForm:
    if position is not None:
        return RowForm(name, tuple(sheet.differential(position)), position)
    graph = sheet.graph
    node = sheet.node(rate)
    slopes = gradient(graph, node, sheet.rates)
    rates = set(sheet.rates)
    if rates & set(reached(graph, slopes)):  # perhaps only as it was written: (x' + 1)² − x'² is linear
        node = sheet.node(sp.expand(rate))
        slopes = gradient(graph, node, sheet.rates)
        if rates & set(reached(graph, slopes)):
            raise ModelError(
                "a constraint on velocities is linear in the rates",
                element=f"constraint '{name}'",
                fix="such as y'*cos(theta) - x'*sin(theta): rates times functions of coordinates and t, and what does "
                "not move",
                code="E301",
            )
    (rest,) = replaced(graph, [node], dict.fromkeys(sheet.rates, graph.zero))
    return RowForm(name, (*slopes, rest))


def combined(graph: Graph, factors: Sequence[int], rows: Sequence[Sequence[int]]) -> list[int]:
    """Return Σ factor · row, entry by entry."""
    total = [graph.zero] * len(rows[0])
    for factor, row in zip(factors, rows, strict=True):
        if factor != graph.zero:
            total = [graph.add(a, graph.mul(factor, b)) for a, b in zip(total, row, strict=True)]
    return total
