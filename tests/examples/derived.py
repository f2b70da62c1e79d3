"""The package's own answer for a built-in example, as numbers and as expressions in plain symbols."""

from __future__ import annotations

import sympy as sp
from kane_route import Residual, residual, t

import lagrangian as lg
from built_in import derivation


def plain_symbols(d: lg.Derivation) -> dict[sp.Expr, sp.Symbol]:
    """Accelerations, rates, coordinates and inputs with the plain symbols that stand for them, longest first."""
    table: dict[sp.Expr, sp.Symbol] = {}
    for c in d.model.coordinates:
        table[sp.Derivative(c.symbol, (t, 2))] = sp.Symbol(f"{c.name}_acceleration")
    for c in d.model.coordinates:
        table[sp.Derivative(c.symbol, t)] = sp.Symbol(f"{c.name}_rate")
    for c in (*d.model.coordinates, *d.model.inputs):
        table[c.symbol] = sp.Symbol(c.name)
    return table


def in_plain_symbols(expr: sp.Expr, d: lg.Derivation) -> sp.Expr:
    for old, new in plain_symbols(d).items():
        expr = expr.xreplace({old: new})
    return expr


def ours(name: str) -> Residual:
    """Left-hand side minus Ξ of the equations as they are shown."""
    d = derivation(name)
    rows = [in_plain_symbols(d.model.expand(e.lhs - e.rhs, constants=True), d) for e in d.equations]
    return residual(rows, [c.name for c in d.model.coordinates])
