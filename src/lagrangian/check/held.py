"""The right equations at states that satisfy the constraints, where these are linear in a coordinate: y = r φ, and what
is equal at states on constraints of any kind.

An answer may write y″ or r φ″ for the same thing, and may have put one into the other. At such states both are equal.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property, lru_cache
from typing import Any, cast

import numpy as np
import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.functions.elementary.trigonometric import InverseTrigonometricFunction

from lagrangian import bounded
from lagrangian.check.reference import Reference
from lagrangian.derive import Derived
from lagrangian.derive.sample import Sampler
from lagrangian.derive.sampling import Array, CompiledExpressions, States
from lagrangian.errors import ModelError
from lagrangian.model import Model, time
from lagrangian.model.rows import Row, rows_of
from lagrangian.verify.on_rows import OnRows

STATES = 8
"""Random states on constraints at which a quantity is looked at."""

SMALL = 1e-9
"""The size, in parts of that of its terms, below which a quantity is rounding."""


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
        unknown: list[sp.Basic] = [x for x in moving if x not in self.table]
        unknown += [m.symbol for m in self.derivation.multipliers.values()]
        size, count = self.states.size, len(unknown)
        found: dict[sp.Basic, Array] = {x: np.full(size, np.nan) for x in (*moving, *unknown)}
        rows = CompiledExpressions(list(map(self.put_in, self.rows)))
        still: dict[sp.Basic, Array] = dict.fromkeys(unknown, np.zeros(size))
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
        moved = [bounded.diff(self.table.get(c.rate, c.rate), coordinates[i].rate) for c in coordinates]
        return sp.Add(*[x * y for x, y in zip(Xi, moved, strict=True)])


def held(truth: Reference) -> OnConstraints | None:
    """The reference at states on the constraints, made once; None unless every row is linear in a coordinate."""
    key = ("held",)
    if key not in truth.others:
        truth.others[key] = _held(truth)
    return cast("OnConstraints | None", truth.others[key])


def _held(truth: Reference) -> OnConstraints | None:
    solved, turning = _solved(truth.model), _turning(truth.model)
    if solved is None or not (solved or turning):
        return None
    table: dict[sp.Expr, sp.Expr] = {}
    for c in truth.model.coordinates:
        if c.symbol in solved:
            value = truth.put(solved[c.symbol])
            rate = bounded.diff(value, time)
            table |= {c.symbol: value, c.rate: rate, c.acceleration: bounded.diff(rate, time)}
    rates = _rates(truth, turning, table)
    return None if rates is None else OnConstraints(truth, table | rates)


def _turning(model: Model) -> list[Row]:
    """The rows on velocities whose factors move, s ψ̇ = r φ̇: they hold no coordinate."""
    q = [c.symbol for c in model.coordinates]
    rows = [row for row in rows_of(model) if row.position is None]
    return [r for r in rows if any(bounded.diff(r.rate, c.rate).has(time, *q) for c in model.coordinates)]


def _rates(truth: Reference, rows: Sequence[Row], held: Mapping[sp.Expr, sp.Expr]) -> dict[sp.Expr, sp.Expr] | None:
    """For every such row one rate, and its acceleration, in terms of those that are left; None if a row has no rate
    with a constant factor."""
    found: dict[Any, sp.Expr] = {}
    coordinates = truth.model.coordinates
    for row in rows:
        zero = bounded.expand(_with(truth.put(truth.expand(row.rate)), {**held, **found}))
        slopes = {c.rate: bounded.diff(zero, c.rate) for c in coordinates if zero.has(c.rate)}
        fixed = (v for v, x in slopes.items() if x != 0 and not x.has(time, *(c.symbol for c in coordinates)))
        if (v := next(fixed, None)) is None or bounded.replaced(zero, dict.fromkeys(slopes, sp.S.Zero)) != 0:
            return None
        value = bounded.expand(v - zero / slopes[v])
        found = {x: bounded.expand(_with(e, {v: value})) for x, e in found.items()} | {v: value}
    return found | {bounded.diff(v, time): bounded.diff(x, time) for v, x in found.items()}


def _solved(model: Model) -> dict[Any, sp.Expr] | None:
    """For every row with constant factors one coordinate in terms of those that are left; None if a row is not linear
    in any."""
    found: dict[Any, sp.Expr] = {}
    coordinates = {c.rate: c.symbol for c in model.coordinates}
    turning = _turning(model)
    for row in (x for x in rows_of(model) if not any(x is y or x.name == y.name for y in turning)):
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


def vanishes_on_constraints(truth: Reference, expr: sp.Expr) -> bool:
    """Whether what two energies differ in is 0 at states on constraints on positions, b sin β = a sin α, whose rates
    satisfy these, too; what no rate changes, a difference of potentials, may be a constant.

    Not if it has roots of its own, which have another sign on another branch.
    """
    model = truth.model
    if any(row.position is None for row in rows_of(model)) or not bounded.letters(expr) <= truth.names:
        return False
    if not _branches(expr) <= _branches(truth.T) | _branches(truth.V):
        return False
    expr = expr if expr.has(sp.Derivative) else bounded.diff(expr, time)
    size = sp.Add(*[sp.Abs(x, evaluate=False) for x in sp.Add.make_args(expr)])
    atoms = [x for c in model.coordinates for x in (c.symbol, c.rate, c.acceleration)]
    atoms += [x.symbol for x in (*model.parameters, *model.inputs)]
    sampler = Sampler(model, [*atoms, expr, size])
    try:
        found = [
            sampler.at(state)[-2:]
            for state, _ in _on_rows(truth.derivation).states(sampler, STATES, 1, given=bool(truth.values))
        ]
    except ModelError as error:
        if error.code != "E503":  # roots that are real at few states
            raise
        return False
    return len(found) == STATES and all(abs(value) <= SMALL * whole for value, whole in found)


def _branches(expr: sp.Expr) -> set[sp.Basic]:
    """The roots and the inverse functions of what moves in an expression."""
    roots = {x for x in expr.atoms(sp.Pow) if not x.exp.is_integer}
    return {x for x in roots | expr.atoms(InverseTrigonometricFunction) if x.atoms(AppliedUndef)}


@lru_cache(maxsize=32)
def _on_rows(derivation: Derived) -> OnRows:
    return OnRows(derivation.model)
