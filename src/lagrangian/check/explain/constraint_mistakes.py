"""A constraint that an answer has wrong, told once: the factors of its multiplier that follow are no mistakes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.constraints.multipliers import ReadMultipliers
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
    pairs: list[tuple[list[sp.Expr], sp.Expr]] = []
    symbols: set[Any] = set()
    for expr, (i, c) in zip(rows, (coordinates[name] for name in said if name is not None), strict=True):
        names: set[Any] = {x for x in bounded.letters(expr) if x not in truth.names}
        symbols |= names
        mine, right = expr.diff(c.acceleration), truth.rows[i].diff(c.acceleration)
        if len(symbols) > 1 or mine == 0 or right == 0:
            return False
        factor = cast("sp.Expr", sum((expr.diff(s) for s in names), sp.S.Zero))
        moved = (c.symbol, c.rate, c.acceleration)[own.order]
        scaled = cast("sp.Expr", factor * right / mine)  # or as it stands, where the inertia is wrong
        pairs.append(([scaled, factor, -factor], bounded.diff(own.expr, moved)))
    if len(symbols) != 1 or len(pairs) < 2 or sum(bounded.size(x) for fs, x in pairs for x in (fs[0], x)) > LONGEST:
        return False
    firsts, b = next(((fs, x) for fs, x in pairs if fs[0] != 0 and x != 0), ([], sp.S.Zero))
    return any(all(any(bounded.cancel(w * b - x * a) == 0 for w in fs) for fs, x in pairs) for a in firsts)


def taken_as_fits(truth: Reference, read: ReadMultipliers) -> tuple[int, ...]:
    """The given lines with multipliers that were read so as to fit an equation: times what no constraint holds still.

    λ is a number times the system's multiplier, also of a distance √A = l that is written A = l².
    """
    moving = truth.derivation.coordinates
    factors = {m.symbol for m in truth.derivation.multipliers.values()}
    slopes = [bounded.diff(row, x) for row in truth.rows for x in factors]
    roots = {x.base for f in slopes for x in f.atoms(sp.Pow) if abs(x.exp) == sp.S.Half and x.has(*moving)}
    natural = [sp.S.One, *(base**e for base in roots for e in (sp.S.Half, -sp.S.Half))]
    odd = [
        s for s, c in read.scales.items() if c.has(*moving) and all(bounded.cancel(c * r).has(*moving) for r in natural)
    ]
    return tuple(j for (j, s) in read.pushes if s in odd)
