"""Reads an answer's multipliers as those of the system, so that mistakes in equations with constraints can be named.

The equations m_i(ξ̈, ξ̇, ξ) = Ξ_i + Σ_k A_ki λ_k are compared with λ as with an input of the system.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import permutations, product
from typing import Any, cast

import numpy as np
import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.model import time
from lagrangian.page.formula import Text, text
from lagrangian.page.plain import plain

MOST = 3
"""The largest number of multipliers for which all orders and signs are tried."""


def with_own_multipliers(
    truth: Reference, lines: Sequence[AnsweredLine]
) -> tuple[tuple[AnsweredLine, ...], tuple[Text, ...]] | None:
    """The lines that can be compared one by one with the system's, and how the answer's multipliers were read.

    The constraints themselves, which hold no acceleration and no multiplier, are left out. None if there is no reading.
    """
    model = truth.model
    own: list[Any] = [m.symbol for m in truth.derivation.multipliers.values()]
    accelerations = [c.acceleration for c in model.coordinates]
    known = {time, *(x.symbol for x in (*model.parameters, *model.coordinates, *model.inputs)), *own}
    rows = [line for line in lines if line.kind == "equation"]
    used: set[Any] = {x for line in rows for x in (*line.expr.free_symbols, *line.expr.atoms(AppliedUndef))}
    unknown = sorted(used - known, key=str)
    free = [x for x in own if x not in used]
    rows = [line for line in rows if line.expr.has(*accelerations, *unknown, *own)]
    if not own or len(unknown) > len(free) or len(unknown) > MOST or not rows:
        return None
    best = max(_readings(unknown, free), key=lambda table: _agreeing(truth, rows, table, own))
    told = tuple(text(f"'{plain(a)}' was read as ", b, ".") for a, b in best.items())
    read = {id(line): replace(line, expr=cast("sp.Expr", line.expr.xreplace(best))) for line in rows}
    kept = [read.get(id(line), line) for line in lines if line.kind != "equation" or id(line) in read]
    return tuple(kept), told


def _readings(unknown: Sequence[sp.Basic], free: Sequence[sp.Expr]) -> Iterator[dict[sp.Basic, sp.Expr]]:
    """Every assignment of multipliers with every sign, the plain ones first."""
    for chosen in permutations(free, len(unknown)):
        for signs in product((1, -1), repeat=len(unknown)):
            yield {a: cast("sp.Expr", g * b) for a, b, g in zip(unknown, chosen, signs, strict=True)}


def _agreeing(
    truth: Reference, rows: Sequence[AnsweredLine], table: dict[sp.Basic, sp.Expr], own: Sequence[Any]
) -> float:
    """How many terms of the rows agree with those of right rows: slopes that are equal, or all of the other sign."""
    exprs = [cast("sp.Expr", line.expr.xreplace(table)) for line in rows]
    right = _slopes(truth, truth.rows, own)
    count = 0.0
    for mine in _slopes(truth, exprs, own):
        found = [0]
        for theirs in right:
            held = np.abs(theirs).max(axis=1) > 1e-9
            for sign in (1, -1):
                same = np.abs(mine - sign * theirs).max(axis=1) <= 1e-8 * (1 + np.abs(theirs).max(axis=1))
                found.append(int((same & held).sum()))
        count += max(found)
    return count


def _slopes(truth: Reference, exprs: Sequence[sp.Expr], own: Sequence[Any]) -> Array:
    """The slopes of every row by accelerations, inputs, rates, parameters and multipliers, (k, m, S)."""
    model = truth.model
    by = [*(x for c in model.coordinates for x in (c.acceleration, c.rate))]
    by += [x.symbol for x in (*model.inputs, *model.parameters)]
    slopes = CompiledExpressions(exprs).slopes([*by, *own]).at(truth.states)
    return slopes.reshape(len(exprs), len(by) + len(own), truth.states.size)
