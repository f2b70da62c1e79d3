"""The rows of constraints in a listing: f, its rate c, the rate ċ of that, and the multiplier λ.

λ is the force of the row along c, as any other effort is: one pass backwards over the velocities, with every λ as the
weight of its c, leaves at each velocity node the constraint forces on everything that hangs there, and at every rate
Σ λ ∂c/∂ξ̇_i, which the equation of that rate gets.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping

import sympy as sp

from lagrangian.derive.multiplier import Multiplier
from lagrangian.derive.multipliers.rows import multiplier_of, multiplier_symbols
from lagrangian.dynamics.axes import Accelerations
from lagrangian.dynamics.drags import slipping_by, undetermined
from lagrangian.dynamics.mechanics import Mechanics, Pairs
from lagrangian.dynamics.rows import Drag
from lagrangian.model import Model
from lagrangian.model.rows import Row, rows_of
from lagrangian.page.formula import text
from lagrangian.records import dataclass


@dataclass(frozen=True, eq=False)
class ListedRow:
    """One row as nodes: ``held`` is f, None for a row on velocities; ``rate`` c, ``change`` ċ, ``multiplier`` λ."""

    row: Row
    symbol: sp.Expr
    held: int | None
    rate: int
    change: int
    multiplier: int

    def known(self, write: Callable[[int], sp.Expr], units: Mapping[str, str]) -> Multiplier:
        """Its multiplier, with the row as it is written; ``units`` are those of rows given as expressions."""
        held = None if self.held is None else write(self.held)
        words = text(*self.row.multiplier)
        return multiplier_of(self.row, self.symbol, words, (held, write(self.rate), write(self.change)), units)


def ties(model: Model, m: Mechanics, acc: Accelerations, names: Collection[str]) -> list[ListedRow]:
    """The rows with these names, in order; the others follow from them."""
    symbols = multiplier_symbols(model)
    found: list[ListedRow] = []
    changes = m.row_accelerations(acc)
    for k, (row, (made, change)) in enumerate(zip(rows_of(model), changes, strict=True)):
        if row.name in names:
            lam = m.graph.input("lambda", k)
            found.append(ListedRow(row, symbols[row.name], made.residual, made.rate, change, lam))
    return found


def slips(m: Mechanics, found: Collection[ListedRow]) -> list[tuple[Drag, int]]:
    """Every friction that a multiplier presses on, with its effort where it slips.

    Raises `ModelError` (E310) where such a row is not among those that count: its multiplier is then not unique.
    """
    known = {tie.row.name: tie.multiplier for tie in found}
    for drag in m.drags:
        for row in drag.rows:
            if row not in known:
                raise undetermined(row, drag.friction)
    return slipping_by(m.graph, m.drags, known)


def pushes(found: Collection[ListedRow]) -> Pairs:
    """(c, λ) of every row: the efforts of the constraints on their rates."""
    return [(tie.rate, tie.multiplier) for tie in found]
