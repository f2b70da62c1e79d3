"""Coordinates of an answer's own that are those of the system, counted from elsewhere or the other way: θ = π/2 − β.

Where the system has constraints, such an answer is read in the coordinates of the system: β = π/2 − θ.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.constraints.without_constraints import without_constraints
from lagrangian.check.coordinates.tried import ProposedChange
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine
from lagrangian.page.formula import text


def without_own_counts(truth: Reference, lines: Sequence[AnsweredLine]) -> tuple[AnsweredLine, ...]:
    """The lines in the system's coordinates, if the answer gives some of these as its own and a constant; as they are
    if its own are such that the constraints hold by themselves."""
    solved = {k: pair for k, line in enumerate(lines) if (pair := _solved(truth, line)) is not None}
    table = dict(solved.values())
    if len(table) < len(solved) or not table or without_constraints(truth, lines) is not None:
        return tuple(lines)
    change = ProposedChange(table, text(), True)
    return tuple(
        replace(line, name=str(solved[k][0].func), expr=solved[k][1]) if k in solved else _moved(truth, line, change)
        for k, line in enumerate(lines)
    )


def _moved(truth: Reference, line: AnsweredLine, change: ProposedChange) -> AnsweredLine:
    """A line in the system's coordinates; what it says that one of these is, x = r ψ, is then judged."""
    named = {c.name: c.symbol for c in truth.model.coordinates}
    expr = change.put(line.expr)
    if line.kind == "definition" and line.name in named and line.expr.has(*change.table):
        return replace(line, kind="equation", name=None, expr=cast("sp.Expr", named[line.name] - expr))
    return replace(line, expr=expr)


def _solved(truth: Reference, line: AnsweredLine) -> tuple[Any, sp.Expr] | None:
    """A coordinate of the answer's own, and what it is by a line that gives one of the system by it."""
    named = {c.name: c.symbol for c in truth.model.coordinates}
    own = [x for x in line.expr.atoms(AppliedUndef) if x not in truth.names]
    if line.kind != "definition" or line.name not in named or len(own) != 1:
        return None
    slope = bounded.diff(line.expr, own[0])
    level = cast("sp.Expr", line.expr.xreplace({own[0]: sp.S.Zero}))
    if slope not in (1, -1) or level.atoms(AppliedUndef, sp.Derivative):
        return None
    return own[0], cast("sp.Expr", slope * (named[line.name] - level))
