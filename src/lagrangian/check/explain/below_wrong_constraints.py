"""Lines that only follow from a constraint that an answer has wrong: V with −x/R for φ, below φ = −x/R."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, cast

import numpy as np
import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.constraints.counted_together import integrated
from lagrangian.check.explain.constraint_slips import WrongConstraint
from lagrangian.check.held import OnConstraints
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.stated import harmless, right_value, spanned
from lagrangian.check.verdict import AnsweredLine, Finding, Status
from lagrangian.derive.sampling import PLACES, SETS, CompiledExpressions
from lagrangian.model import time
from lagrangian.model.rows import rows_of


def with_consequences(truth: Reference, own: OnConstraints, number: int, findings: Sequence[Finding]) -> list[Finding]:
    """The findings, of which energies and equations below line ``number`` that are right where the answer's own
    constraint holds follow; of others, without terms in what it relates, which may be put in or not."""
    related = [x for c in own.table for x in (c, *own.table[c].atoms(AppliedUndef, sp.Derivative))]
    found: list[Finding] = []
    for f in findings:
        follows = f.status is Status.WRONG and f.line.number > number and _is_right_there(truth, own, f.line)
        kept = tuple(d for d in f.differences if not d.term.has(*related) and not d.written.has(*related))
        found.append(replace(f, follows=f.follows or follows, differences=kept))
    return found


def where_held(truth: Reference, wrong: Sequence[WrongConstraint]) -> OnConstraints | None:
    """The reference where the one wrong constraint of an answer holds; None unless it is linear in its coordinates."""
    coordinates, roots = truth.model.coordinates, [x for x in wrong if not x.follows]
    if len(roots) != 1:
        return None
    root = roots[0]
    g = cast("sp.Expr", root.expr.xreplace({c.rate: c.symbol for c in coordinates}))
    slopes = {c.symbol: bounded.diff(g, c.symbol) for c in coordinates if g.has(c.symbol)}
    moving: list[Any] = [time, *truth.derivation.coordinates]
    if len(truth.derivation.multipliers) != 1 or len(slopes) < 2 or any(x.has(*moving) for x in slopes.values()):
        return None
    q = next(iter(slopes))
    value = bounded.expand(q - g / slopes[q])
    if value.has(sp.Derivative):
        return None
    rate = bounded.diff(value, time)
    c = next(c for c in coordinates if c.symbol == q)
    return OnConstraints(truth, {q: value, c.rate: rate, c.acceleration: bounded.diff(rate, time)})


def with_reduced(truth: Reference, wrong: Sequence[WrongConstraint], findings: Sequence[Finding]) -> list[Finding]:
    """The findings, of which equations without a multiplier follow that eliminate it, and a coordinate, by the answer's
    own constraint or by what it says of rates or accelerations: Σ W_i δξ_i = 0 with these put in."""
    roots = [x for x in wrong if not x.follows and x.order in (0, 1, 2)]
    moved = [c.acceleration for c in truth.model.coordinates]
    if len(roots) != 1 or len(truth.derivation.multipliers) != 1:
        return list(findings)
    number, ways = roots[0].finding.line.number, list(_reduced_rows(truth, roots[0]))
    found: list[Finding] = []
    for f in findings:
        open_ = f.line.kind == "equation" and f.is_open and f.line.number > number
        if open_ and f.line.expr.has(*moved) and {*f.line.expr.free_symbols} <= truth.names:
            follows = any(is_spanned(truth, _put(f.line.expr, table), rows) for table, rows in ways)
            found.append(replace(f, follows=follows, differences=() if follows else f.differences))
        else:
            found.append(f)
    return found


def _right_values(truth: Reference, k: int) -> dict[Any, sp.Expr]:
    """A coordinate, its rate and its acceleration by the one constraint, if that is linear in it."""
    c, place = truth.model.coordinates[k], integrated(truth, rows_of(truth.model)[0])
    slope = bounded.diff(place, c.symbol) if place is not None else sp.S.Zero
    if place is None or slope == 0 or slope.has(*truth.derivation.coordinates, sp.Derivative):
        return {}
    value = bounded.expand(c.symbol - place / slope)
    rate = bounded.diff(value, time)
    return {c.symbol: value, c.rate: rate, c.acceleration: bounded.diff(rate, time)}


def is_spanned(truth: Reference, expr: sp.Expr, rows: Sequence[sp.Expr]) -> bool:
    """Whether an expression is a sum of rows, with factors that may depend on the place."""
    values = CompiledExpressions([expr, *rows]).at(truth.states)
    parts = np.split(values, SETS * PLACES, axis=1)
    return bool(np.isfinite(values).all()) and all(spanned(x[:1], x[1:]) for x in parts)


def _reduced_rows(truth: Reference, root: WrongConstraint) -> Iterator[tuple[dict[Any, sp.Expr], list[sp.Expr]]]:
    """What follows from a wrong constraint for one of its coordinates, its rate and its acceleration, and the equations
    of the others with that put in: by its own displacements or by the right ones, and by T* with its own rate."""
    model = truth.model
    orders = [[c.symbol for c in model.coordinates], [c.rate for c in model.coordinates]]
    orders.append([c.acceleration for c in model.coordinates])
    slopes = [bounded.diff(root.expr, x) for x in orders[root.order]]
    forces = [m.symbol for m in truth.derivation.multipliers.values()]
    free = [cast("sp.Expr", row.xreplace(dict.fromkeys(forces, sp.S.Zero))) for row in truth.rows]
    pairs = [(i, j) for i in range(truth.n) for j in range(i) if slopes[i] != 0 and slopes[j] != 0]
    alone = [row for row, a in zip(free, slopes, strict=True) if a == 0]
    yield {}, [*(slopes[j] * free[i] - slopes[i] * free[j] for i, j in pairs), *alone]
    places = [*truth.derivation.coordinates]
    solvable = [k for k, a in enumerate(slopes) if a != 0 and not a.has(*places, sp.Derivative)]
    for k in solvable:
        c = model.coordinates[k]
        value = bounded.expand(orders[root.order][k] - root.expr / slopes[k])
        table = {orders[root.order][k]: value}
        for x, _ in zip(orders[root.order + 1 :], range(2), strict=False):
            value = bounded.diff(value, time)
            table[x[k]] = value
        known = _right_values(truth, k)
        table = {**known, **table}
        own = [-a / slopes[k] for a in slopes]
        true = [bounded.diff(known[c.symbol], q) for q in places] if known else own
        put = [_put(row, table) for row in free]
        others = [i for i in range(truth.n) if i != k]
        for way in (own, true):
            yield table, [put[i] + way[i] * put[k] for i in others]
        if known and root.order == 1:  # T* with its own rate, V at the right place
            T, V = _put(truth.T, table), _put(truth.V, table)
            left = [bounded.diff(T, model.coordinates[i].rate, time) - bounded.diff(T - V, places[i]) for i in others]
            for way in (own, true):
                pulled = [_put(truth.Xi[i] + way[i] * truth.Xi[k], table) for i in others]
                yield table, [x - y for x, y in zip(left, pulled, strict=True)]


def _put(expr: sp.Expr, table: Mapping[Any, sp.Expr]) -> sp.Expr:
    return cast("sp.Expr", bounded.replaced(expr, table))


def _is_right_there(truth: Reference, own: OnConstraints, line: AnsweredLine) -> bool:
    """Whether an energy is right where the answer's own constraint holds, or an equation without its multiplier."""
    if line.kind in ("T", "V", "L", "D"):
        right = right_value(truth, line, None)
        left = own.put_in(line.expr - right) if right is not None else sp.S.One
        return zero_everywhere(truth, left) or harmless(truth, line, left) is not None
    forces = [m.symbol for m in truth.derivation.multipliers.values()]
    if line.kind != "equation" or not {*line.expr.free_symbols} <= truth.names or line.expr.has(*forces):
        return False
    free = [cast("sp.Expr", row.xreplace(dict.fromkeys(forces, sp.S.Zero))) for row in truth.rows]
    held = {c.symbol: i for i, c in enumerate(truth.model.coordinates) if c.symbol in own.table}
    rows = [own.force(free, i) for i, c in enumerate(truth.model.coordinates) if c.symbol not in held]
    values = CompiledExpressions([line.expr, *rows]).at(own.states)
    parts = np.split(values, SETS, axis=1)
    return bool(np.isfinite(values).all()) and all(spanned(x[:1], x[1:]) for x in parts)
