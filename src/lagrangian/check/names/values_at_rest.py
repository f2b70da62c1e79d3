"""Values at rest that an answer subtracts and may leave open: p = φ − φ₀ and u = τ − τ₀ are deviations from rest.

The system rests at these values: its equations hold there, with all rates 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, cast

import sympy as sp

from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine


def values_at_rest(truth: Reference, lines: Sequence[AnsweredLine]) -> dict[sp.Expr, sp.Symbol]:
    """Return the names that an answer gives to values of coordinates and inputs, of which the deviations have names."""
    moving = [*(c.symbol for c in truth.model.coordinates), *(u.symbol for u in truth.model.inputs)]
    known = {p.symbol for p in truth.model.parameters}
    found: dict[sp.Expr, sp.Symbol] = {}
    for line in lines:
        if line.kind != "definition" or not line.expr.is_Add or len(line.expr.args) != 2:
            continue
        for x in moving:
            own = x - line.expr
            if isinstance(own, sp.Symbol) and own not in known:
                found.setdefault(x, own)
    return found


def equations_at_rest(truth: Reference, lines: Sequence[AnsweredLine]) -> list[sp.Expr]:
    """Return what is 0 where a system rests at the values of which an answer names the deviations; none without."""
    found = values_at_rest(truth, lines)
    if truth.derivation.multipliers or not any(c.symbol in found for c in truth.model.coordinates):
        return []
    rest: dict[Any, Any] = {x: sp.S.Zero for c in truth.model.coordinates for x in (c.rate, c.acceleration)}
    rest |= {c.symbol: found.get(c.symbol, c.symbol) for c in truth.model.coordinates}
    rest |= {u.symbol: found.get(u.symbol, sp.S.Zero) for u in truth.model.inputs}
    return [cast("sp.Expr", row.xreplace(rest)) for row in truth.rows]
