"""The position at rest of a system whose statics are linear, perhaps where its angles are 0."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from itertools import product
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.reference import Reference
from lagrangian.model import time

MOST_INPUTS = 3
"""The most inputs that are tried as what holds a system."""


def turning(truth: Reference) -> list[sp.Expr]:
    """The coordinates that occur in sines and cosines, in order."""
    angles = [f.args[0] for f in sp.Add(truth.T, truth.V, *truth.Xi).atoms(sp.sin, sp.cos)]
    return [q for q in truth.derivation.coordinates if any(a.has(q) for a in angles)]


@lru_cache(maxsize=32)
def position_at_rest(truth: Reference) -> dict[sp.Expr, sp.Expr]:
    """Return the equilibrium of a system with linear statics, perhaps where its angles are 0, coordinate by coordinate:
    only those that are not 0 there; where only an input holds the system, and anywhere along a coordinate, one where
    this is 0. Found once for the systems that were checked most recently."""
    still: dict[sp.Basic, sp.Expr] = {}
    for c in truth.model.coordinates:
        still |= {c.rate: sp.S.Zero, c.acceleration: sp.S.Zero}
    if truth.n > 4:
        return {}
    driven = [cast("sp.Expr", r.xreplace(still)) for r in truth.rows]
    rows = [cast("sp.Expr", r.xreplace({u.symbol: sp.S.Zero for u in truth.model.inputs})) for r in driven]
    turned = turning(truth)
    found = _solved_at_rest(truth, rows, []) or (_solved_at_rest(truth, rows, turned) if turned else {})
    return found or _held_at_rest(truth, driven)


def _held_at_rest(truth: Reference, rows: Sequence[sp.Expr]) -> dict[sp.Expr, sp.Expr]:
    """The coordinates that are not 0 where an input balances linear rows, with one coordinate that is 0: the drum of a
    lift, wherever its motor holds it."""
    inputs, q = [u.symbol for u in truth.model.inputs], truth.derivation.coordinates
    if not inputs:
        return {}
    free = sp.Matrix([[bounded.diff(r, x) for x in q] for r in rows])
    if free.has(*q, *inputs, time) or free.rank() != len(q) - 1:
        return {}
    for held, zero in product(inputs[:MOST_INPUTS], q):
        of = [held, *(x for x in q if x != zero)]
        others: Any = {x: sp.S.Zero for x in (zero, *inputs) if x != held}
        put = [bounded.expand(cast("sp.Expr", r.xreplace(others))) for r in rows]
        slopes = sp.Matrix([[bounded.diff(r, x) for x in of] for r in put])
        if slopes.has(*of) or slopes.det() == 0:
            continue
        place = slopes.LUsolve(-sp.Matrix([r.xreplace(cast("Any", dict.fromkeys(of, sp.S.Zero))) for r in put]))
        found = [(x, bounded.cancel(c)) for x, c in zip(of, place, strict=True)]
        return {x: c for x, c in found[1:] if c != 0}
    return {}


def _solved_at_rest(truth: Reference, rows: Sequence[sp.Expr], zero: Sequence[sp.Expr]) -> dict[sp.Expr, sp.Expr]:
    """The coordinates that are not 0 where linear rows hold, with some that are."""
    q = [x for x in truth.derivation.coordinates if x not in zero]
    straight = cast("Any", dict.fromkeys(zero, sp.S.Zero))
    put = [x for r in rows if (x := bounded.expand(cast("sp.Expr", r.xreplace(straight)))) != 0]
    if len(put) != len(q):
        return {}
    slopes = bounded.searched(lambda: sp.Matrix([[bounded.diff(r, x) for x in q] for r in put]))
    if slopes is None or slopes.has(*q) or slopes.has(time) or slopes.det() == 0:
        return {}
    place = slopes.LUsolve(-sp.Matrix([r.xreplace(cast("Any", dict.fromkeys(q, sp.S.Zero))) for r in put]))
    found = [(x, bounded.cancel(c)) for x, c in zip(q, place, strict=True)]
    return {x: c for x, c in found if c != 0}
