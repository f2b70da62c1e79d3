"""A constraint that an answer has wrong, told once: the factors of its multiplier that follow are no mistakes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.constraint_slips import SLOPE, WrongConstraint
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake
from lagrangian.page.formula import text

LONGEST = 400
"""Factors with more operations together are not compared."""


def beside_constraints(
    truth: Reference,
    lines: Sequence[AnsweredLine],
    found: Sequence[WrongConstraint],
    judged: Sequence[Finding],
    of_multipliers: Sequence[Mistake],
) -> tuple[Mistake, ...]:
    """The mistakes of the multipliers and of the constraints that an answer has wrong, ``found``.

    If the multiplier's factors are λ ∂g/∂ξ of the answer's own constraint g = 0, that constraint is the one mistake.
    ``judged`` say which equation each line is.
    """
    own = [x for x in found if not x.follows]
    told = tuple(x.mistake for x in own)
    if len(own) == 1 and own[0].order == SLOPE and len(of_multipliers) == 1:
        return (_with_factors(told[0]),)
    if not own or any(bounded.cancel(x.expr**2 - own[0].expr ** 2) != 0 for x in own[1:]):
        return (*of_multipliers, *told)
    if not of_multipliers or not _follow(truth, own[0], lines, judged):
        return (*told[:1], *of_multipliers)
    return (_with_factors(told[0]),)


def _with_factors(mistake: Mistake) -> Mistake:
    """A mistake from which the factors of a multiplier follow."""
    return replace(mistake, what=text(*mistake.what.parts, " The factors of the multiplier follow from it."))


def _follow(truth: Reference, own: WrongConstraint, lines: Sequence[AnsweredLine], judged: Sequence[Finding]) -> bool:
    """Whether the one multiplier of an answer has the factors ∂g/∂ξ_i, all times the same; ∂g/∂ξ̇_i of a rate g = 0."""
    model = truth.model
    accelerations = [c.acceleration for c in model.coordinates]
    coordinates = {c.name: (i, c) for i, c in enumerate(model.coordinates)}
    rows = [line.expr for line in lines if line.kind == "equation" and line.expr.has(*accelerations)]
    said = [f.coordinate for f in judged if f.line.kind == "equation"]
    if len(rows) != len(said) or not all(name in coordinates for name in said):
        return False
    pairs: list[tuple[sp.Expr, sp.Expr]] = []
    symbols: set[Any] = set()
    for expr, (i, c) in zip(rows, (coordinates[name] for name in said if name is not None), strict=True):
        names: set[Any] = {x for x in bounded.letters(expr) if x not in truth.names}
        symbols |= names
        mine, right = expr.diff(c.acceleration), truth.rows[i].diff(c.acceleration)
        if len(symbols) > 1 or mine == 0 or right == 0:
            return False
        factor = sum((expr.diff(s) for s in names), sp.S.Zero) * right / mine
        moved = (c.symbol, c.rate, c.acceleration)[own.order]
        pairs.append((cast("sp.Expr", factor), bounded.diff(own.expr, moved)))
    if len(symbols) != 1 or len(pairs) < 2 or sum(bounded.size(x) for p in pairs for x in p) > LONGEST:
        return False
    a, b = next(((w, x) for w, x in pairs if w != 0 and x != 0), (sp.S.Zero, sp.S.Zero))
    return a != 0 and all(bounded.cancel(w * b - x * a) == 0 for w, x in pairs)
