"""Names one mistake where the factors of a multiplier in two equations are exchanged: S cos α for S sin α, and S sin α
for S cos α."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.constraints.multiplier_words import CLASH, Pushing
from lagrangian.check.constraints.multipliers import ReadMultipliers
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.verdict import AnsweredLine, Mistake
from lagrangian.page.formula import text

WHOLE = ("multiplier_factor", "multiplier_sign")
"""The mistakes that an exchange may be taken for."""


def with_exchanged(truth: Reference, read: ReadMultipliers, lines: Sequence[AnsweredLine]) -> ReadMultipliers:
    """How the multipliers of an answer were read, with an exchange of two factors as one mistake, also where one of
    them stands in a sum of equations."""
    clashing = [(j, s) for j in read.clashing for s in read.own if (j, s) in read.pushes]
    wrong = clashing or list(read.slips)
    if len(wrong) != 2 or any(m.name not in WHOLE for m in read.mistakes):
        return read
    (one, s), (other, t) = wrong
    pushes = [read.pushes[one, s], read.pushes[other, t]]
    if s != t or not _are_exchanged(truth, pushes):
        return read
    told = _mistake(truth, s, pushes, read.mistakes[0])
    slips = [(one, s), (other, s)]
    found = dict(zip(read.sources, read.lines, strict=True))
    own = [m.symbol for m in truth.derivation.multipliers.values() if found[one].expr.has(m.symbol)]
    for j in read.sources if len(own) == 1 else ():
        factor = cast("sp.Expr", lines[j].expr.diff(s)) if lines[j].kind == "equation" else sp.S.Zero
        times = None if factor == 0 or j in (one, other) else _put_right(truth, factor, *(x.written for x in pushes))
        if times is not None:
            scale = found[one].expr.diff(own[0]) / lines[one].expr.diff(s) * pushes[0].written / pushes[1].written
            more = bounded.cancel(factor * times * scale) - found[j].expr.diff(own[0])
            found[j] = replace(found[j], expr=cast("sp.Expr", found[j].expr + more * own[0]))
            slips.append((j, s))
    return replace(read, lines=tuple(found[j] for j in read.sources), mistakes=(told,), slips=tuple(slips), clashing=())


def _put_right(truth: Reference, factor: sp.Expr, one: sp.Expr, other: sp.Expr) -> sp.Expr | None:
    """By what a factor is multiplied where two are exchanged back; None for any other factor."""
    for a, b in ((one, other), (other, one)):
        if zero_everywhere(truth, factor - a) or zero_everywhere(truth, factor + a):
            return cast("sp.Expr", b / a)
    return None


def _are_exchanged(truth: Reference, pushes: Sequence[Pushing]) -> bool:
    """Whether two factors are as the right ones, the other way round, and not as these."""
    one, other = pushes
    alike = zero_everywhere(truth, one.written * other.right - other.written * one.right)
    return not alike and zero_everywhere(truth, one.written * one.right - other.written * other.right)


def _mistake(truth: Reference, s: Any, pushes: Sequence[Pushing], wrong: Mistake) -> Mistake:
    one, other = pushes
    q, p = (truth.derivation.coordinates[x.row] for x in pushes)
    what = text("The factors of the multiplier ", s, " are exchanged: ", one.written, " belongs in the equation of ")
    words: tuple[str | sp.Expr, ...] = (p, ", and ", other.written, " in that of ", q, ".")
    return replace(wrong, name="multiplier_exchanged", what=text(*what.parts, *words), coordinate=None, brief=CLASH)
