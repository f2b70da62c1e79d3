"""The right equations at states that satisfy the constraints, where these are linear in a coordinate: y = r φ.

An answer may write y″ or r φ″ for the same thing, and may have put one into the other. At such states both are equal.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any, cast

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.reference import Reference
from lagrangian.derive.sampling import Array, CompiledExpressions, States
from lagrangian.model import Model, time
from lagrangian.model.rows import rows_of


class OnConstraints(Reference):
    """A reference whose states satisfy the constraints; ``table`` has the coordinates that follow from the others.

    It holds their rates and accelerations, too. Everything but the states is that of another reference.
    """

    def __init__(self, truth: Reference, table: Mapping[sp.Expr, sp.Expr]) -> None:
        vars(self).update({k: x for k, x in vars(truth).items() if k not in ("W", "accelerations")})
        self.table, self.others = table, {}
        self.states = States(truth.model, truth.states.motions, sides=truth.sides)
        for x, values in zip(table, CompiledExpressions(list(table.values())).at(self.states), strict=True):
            self.states.fix(x, values)

    @cached_property
    def accelerations(self) -> dict[sp.Basic, Array]:
        """The true accelerations and multipliers at every state; NaN where they are not determined."""
        moving = [c.acceleration for c in self.model.coordinates]
        unknown = [x for x in moving if x not in self.table]
        unknown += [m.symbol for m in self.derivation.multipliers.values()]
        size, count = self.states.size, len(unknown)
        found = {x: np.full(size, np.nan) for x in (*moving, *unknown)}
        rows, still = CompiledExpressions(list(map(self.put_in, self.rows))), dict.fromkeys(unknown, np.zeros(size))
        slopes = rows.slopes(unknown).at(self.states, still).reshape(len(self.rows), count, size).transpose(2, 0, 1)
        rest = rows.at(self.states, still).T
        for s in range(size) if count == len(self.rows) else ():
            if np.isfinite(slopes[s]).all() and np.linalg.cond(slopes[s]) < 1e12:
                for x, value in zip(unknown, np.linalg.solve(slopes[s], -rest[s]), strict=True):
                    found[x][s] = value
        others = [x for x in moving if x in self.table]
        values = CompiledExpressions([self.table[x] for x in others]).at(self.states, found)
        return found | dict(zip(others, values, strict=True))

    def put_in(self, expr: sp.Expr) -> sp.Expr:
        """An expression in the other coordinates alone."""
        return _with(expr, self.table)

    def force(self, Xi: Sequence[sp.Expr], i: int) -> sp.Expr:
        """Ξ_i where a motion of ξ_i moves the coordinates that follow from it: Ξ_i + Σ Ξ_d ∂ξ_d/∂ξ_i."""
        coordinates = self.model.coordinates
        moved = [bounded.diff(self.table.get(c.symbol, c.symbol), coordinates[i].symbol) for c in coordinates]
        return sp.Add(*[x * y for x, y in zip(Xi, moved, strict=True)])


def held(truth: Reference) -> OnConstraints | None:
    """The reference at states on the constraints, made once; None unless every row is linear in a coordinate."""
    key = ("held",)
    if key not in truth.others:
        truth.others[key] = _held(truth)
    return cast("OnConstraints | None", truth.others[key])


def _held(truth: Reference) -> OnConstraints | None:
    solved = _solved(truth.model)
    if not solved:
        return None
    table: dict[sp.Expr, sp.Expr] = {}
    for c in truth.model.coordinates:
        if c.symbol in solved:
            value = truth.put(solved[c.symbol])
            rate = bounded.diff(value, time)
            table |= {c.symbol: value, c.rate: rate, c.acceleration: bounded.diff(rate, time)}
    return OnConstraints(truth, table)


def _solved(model: Model) -> dict[Any, sp.Expr] | None:
    """For every row one coordinate in terms of those that are left; None if a row is not linear in any."""
    found: dict[Any, sp.Expr] = {}
    coordinates = {c.rate: c.symbol for c in model.coordinates}
    for row in rows_of(model):
        if row.position is None and bounded.replaced(row.rate, dict.fromkeys(coordinates, sp.S.Zero)) != 0:
            return None
        zero = row.position if row.position is not None else cast("sp.Expr", row.rate.xreplace(coordinates))
        zero = bounded.expand(_with(model.expand(zero, constants=True), found))
        slopes = {c.symbol: bounded.diff(zero, c.symbol) for c in model.coordinates if zero.has(c.symbol)}
        q = next((x for x, slope in slopes.items() if slope != 0 and not slope.has(time, *coordinates.values())), None)
        if q is None:
            return None
        value = bounded.expand(q - zero / slopes[q])
        found = {x: bounded.expand(_with(e, {q: value})) for x, e in found.items()} | {q: value}
    return found


def _with(expr: sp.Expr, table: Mapping[Any, sp.Expr]) -> sp.Expr:
    return cast("sp.Expr", bounded.replaced(expr, dict(table)))
