"""Programs that evaluate expressions of a moving system for runs.

The inputs are x = [q; v], the inputs u, the parameters p and time t. The outputs may contain coordinates, rates,
accelerations (from forward dynamics, computed only if needed), definitions, positions of points and anything made of
these.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.dynamics.constrained import drive
from lagrangian.dynamics.describe import _symbols, described
from lagrangian.dynamics.description import Inputs
from lagrangian.dynamics.programs import _program
from lagrangian.errors import ModelError, did_you_mean
from lagrangian.graph import Graph, Output, Program, from_sympy
from lagrangian.model import Model, Point, as_expr, time
from lagrangian.model.names import multiplier_symbol
from lagrangian.model.rows import drive_symbol
from lagrangian.page.plain import plain


class Observed:
    """A model described over x = [q; v] in one graph (or over q and v), and the nodes of expressions in it."""

    def __init__(self, model: Model, *, state: bool = True) -> None:
        if not model.coordinates:
            raise ModelError(f"system '{model.name}' has no coordinates, so nothing can move", code="E201")
        self.model, self.graph = model, Graph()
        self.inputs = Inputs.of(self.graph, model, state=state)
        self.mechanics, self.description = described(model, self.graph, self.inputs)
        self.places = self.description.places
        self._still = self._table()
        self._memo: dict[Any, int] = {}

    def _table(self) -> dict[Any, int]:
        """Symbols, rates and definitions with their rates; what needs no accelerations."""
        motion = self.mechanics.motion
        table = _symbols(self.model, self.inputs, motion.rates)
        for definition in self.model.definitions:
            node = table[definition.symbol] = from_sympy(self.graph, definition.expression, table)
            if definition.moving:
                table[sp.Derivative(definition.symbol, time)] = motion.rate([node])[0]
        return table

    @cached_property
    def vdot(self) -> list[int]:
        """v̇ by forward dynamics."""
        return self.mechanics.forward()

    @cached_property
    def _accelerated(self) -> dict[Any, int]:
        """The table with the accelerations of coordinates and the second rates of definitions."""
        motion, table = self.mechanics.motion, dict(self._still)
        rates = motion.second_rate(motion.rates, self.vdot)
        table.update((c.acceleration, a) for c, a in zip(self.model.coordinates, rates, strict=True))
        for velocity, rate in zip(self.model.velocities, self.vdot, strict=True):
            if not isinstance(velocity.symbol, sp.Derivative):  # a quasi-velocity's own rate
                table[sp.Derivative(velocity.symbol, time)] = rate
        for definition in self.model.definitions:
            if definition.moving:
                rate = table[sp.Derivative(definition.symbol, time)]
                table[sp.Derivative(definition.symbol, (time, 2))] = motion.second_rate([rate], self.vdot)[0]
        return table

    @cached_property
    def restrained(self) -> dict[Any, int]:
        """The multipliers of the rows and what time alone does to them, by their symbols; a skipped row has 0."""
        m, g = self.mechanics, self.graph
        found = m.constrained
        lam = [g.select(c, x, g.zero) for c, x in zip(found.regular, found.multipliers, strict=True)]
        table: dict[Any, int] = {}
        for row, value, moved in zip(m.rows, lam, drive(m), strict=True):
            table[multiplier_symbol(row.name)], table[drive_symbol(row.name)] = value, moved
        return table

    def multiplier(self, row: str) -> int:
        """λ of a row, by its name."""
        return self.restrained[multiplier_symbol(row)]

    def _of_constraints(self, expr: sp.Expr) -> bool:
        """Whether an expression holds the multiplier of a row, or what drives it."""
        names = {row.name for row in self.mechanics.rows}
        known = {symbol(name) for name in names for symbol in (multiplier_symbol, drive_symbol)}
        return bool(known) and not known.isdisjoint(expr.free_symbols)

    def node(self, expr: Any, what: str) -> int:
        """The node of an expression; ``what`` describes it in messages. Raises `ModelError` for unknown symbols."""
        worked = self.plain_derivatives(as_expr(expr, what))
        table = self._accelerated if holds_acceleration(worked, self.model) else self._still
        if self._of_constraints(worked):
            table = {**table, **self.restrained}
        self._check(worked, table, what)
        return from_sympy(self.graph, worked, table, self._memo)

    def plain_derivatives(self, expr: sp.Expr) -> sp.Expr:
        """The expression with every derivative of anything but a symbol carried out."""
        if any(not isinstance(d.expr, AppliedUndef) for d in expr.atoms(sp.Derivative)):
            return expr.doit(integrals=False, sums=False)  # type: ignore[return-value]
        return expr

    def point(self, point: Point) -> list[int]:
        """The components of a point's position, in the fixed axes."""
        if point.is_origin:
            return [self.graph.zero] * self.model.dimension
        if point in self.places:
            return self.mechanics.motion.position(self.places[point])
        return [self.node(x, "a point's component") for x in self.model.position(point)]

    def _check(self, expr: sp.Expr, table: Mapping[Any, int], what: str) -> None:
        for atom in sorted(_symbols_in(expr) - table.keys(), key=str):
            name = plain(atom)
            if isinstance(atom, sp.Derivative) and atom.expr in {u.symbol for u in self.model.inputs}:
                raise ModelError(
                    f"{what} contains {name}, the rate of an input, which is not known",
                    fix="give the input as an expression, so that its rate is known",
                    code="E417",
                )
            fix = did_you_mean(name, self.model.symbols) or f"known: {', '.join(list(self.model.symbols)[:12])}"
            raise ModelError(f"unknown symbol '{name}' in {what}", fix=fix, code="E402")


def _symbols_in(expr: sp.Expr) -> set[Any]:
    """Symbols, functions of time and derivatives, each of these as a whole."""
    found: set[Any] = set()
    stack: list[Any] = [expr]
    while stack:
        e = stack.pop()
        if isinstance(e, (sp.Symbol, AppliedUndef, sp.Derivative)):
            found.add(e)
        else:
            stack.extend(e.args)
    return found


def holds_acceleration(expr: sp.Expr, model: Model) -> bool:
    """Whether an expression contains a second derivative, or the rate of a quasi-velocity."""
    quasi = {v.symbol for v in model.velocities if not isinstance(v.symbol, sp.Derivative)}
    return any(d.derivative_count >= 2 or d.expr in quasi for d in expr.atoms(sp.Derivative))


def observe(model: Model, outputs: Mapping[str, sp.Expr | Point], *, state: bool = True) -> Program:
    """x, u, p, t → each of ``outputs`` by name: one number for an expression, shape (d,) for the position of a point.

    Unless ``state``, q and v replace x. Expressions may contain coordinates, rates, accelerations, inputs, parameters,
    definitions and t. Raises `ModelError` for a symbol that the model does not have.
    """
    seen = Observed(model, state=state)
    groups = ("x",) if state else ("q", "v")
    return _program(model, "observe", seen.graph, observed(seen, outputs), groups=groups)


def observed(seen: Observed, outputs: Mapping[str, sp.Expr | Point]) -> dict[str, Output]:
    """The nodes of the requested quantities, as outputs."""
    found: dict[str, Output] = {}
    for name, asked in outputs.items():
        if isinstance(asked, Point):
            ids = seen.point(asked)
            found[name] = Output(tuple(ids), (len(ids),))
        else:
            found[name] = Output((seen.node(asked, f"'{name}'"),), ())
    return found
