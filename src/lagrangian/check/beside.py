"""What right equations have beside them that is not about every motion: a single position, or the small motions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import cast

import numpy as np
import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.check.explain.misconceptions.small_angle import first_order, small
from lagrangian.check.places import AT_REST, is_rate, only_places, place_or_approximation, rests
from lagrangian.check.reference import Reference
from lagrangian.check.rows import Kind, RowComparison, factors_of
from lagrangian.check.verdict import AnsweredLine
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.page.formula import Text, text


def beside(
    truth: Reference, lines: Sequence[AnsweredLine], comparison: RowComparison
) -> tuple[Sequence[AnsweredLine], tuple[Text, ...]]:
    """The lines, with those that are not judged as statements, and notes that say so.

    Only if the equations of all motions are there: θ = 0 where the answer goes on to equilibria, and the equations for
    small angles that follow from them. Equations for small angles alone are a mistake.
    """
    equations = [line for line in lines if line.kind == "equation"]
    wrong = [line for line, row in zip(equations, comparison.rows, strict=True) if row.kind is Kind.WRONG]
    values = [line for line in lines if line.kind == "identity" and rests(truth, line.expr)]
    if not (wrong or values) or comparison.rank < truth.n:
        return lines, ()
    aside = {id(line): why for line in wrong if (why := place_or_approximation(truth, line.expr, line.text))}
    aside |= {id(line): AT_REST for line in values}
    places = {line.number for line in wrong if id(line) in aside}  # for θ = π/2 and θ′ = 0
    aside |= {
        id(line): "it is about one motion" for line in wrong if line.number in places and is_rate(truth, line.expr)
    }
    others = [line for line in wrong if id(line) not in aside]
    held = _small_ones(truth, [line.expr for line in others]) if others else []
    aside |= {id(line): "it is about small motions" for line, holds in zip(others, held, strict=True) if holds}
    kept = [replace(line, kind="statement") if id(line) in aside else line for line in lines]
    told = [f"'{line.text}' was not judged: {aside[id(line)]}." for line in lines if id(line) in aside]
    untrue = [line for line in wrong if id(line) not in aside and only_places(truth, line.expr)]
    told += [f"'{line.text}' is not true: neither of every motion nor of a position at rest." for line in untrue]
    return kept, tuple(text(note) for note in dict.fromkeys(told))


def _small_ones(truth: Reference, exprs: Sequence[sp.Expr]) -> list[bool]:
    """Which equations are the right ones for small motions, with sin θ = θ or of first order, and their sums."""
    moving = [f for row in truth.rows for f in row.atoms(sp.sin, sp.cos) if f.atoms(AppliedUndef)]
    if not moving:
        return [False] * len(exprs)
    table = {f: small(f) for f in moving}
    changed = [cast("sp.Expr", row.xreplace(table)) for row in truth.rows]
    coordinates = truth.model.coordinates
    names = [x for c in coordinates for x in (c.symbol, c.rate, c.acceleration)]
    P = CompiledExpressions(exprs).at(truth.states)
    holds = np.zeros(len(exprs), bool)
    for rows in filter(None, (changed, first_order(changed, names))):
        W: Array = CompiledExpressions(rows).at(truth.states)
        holds |= factors_of(truth, P, W)[1]
    return [bool(x) for x in holds]
