"""Equations of an answer that only relate a coordinate of its own to those of the system: r β = (R − r) θ."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine

FAR = 1e-6
"""What is farther from 0 than this at one place is not 0."""


def solutions(expr: sp.Expr, unknown: sp.Expr) -> list[sp.Expr]:
    """Return the value of the unknown at which an expression is 0, if the expression is linear in it, or in its tangent
    or its sine, y = h tan α: then it is the angle between −90° and 90°."""
    for function, inverse in ((sp.tan, sp.atan), (sp.sin, sp.asin)):
        name = sp.Dummy()
        inside = cast("sp.Expr", expr.xreplace({function(unknown): name}))
        if inside.has(name) and not inside.has(unknown):
            return [cast("sp.Expr", inverse(x)) for x in solutions(inside, name)]
    slope = expr.diff(unknown)
    if slope == 0 or slope.has(unknown):
        return []
    rest = cast("sp.Expr", expr.xreplace({unknown: sp.S.Zero}))
    return [bounded.expand(-rest / slope)]


def related(truth: Reference, new: sp.Expr, lines: Sequence[AnsweredLine]) -> list[sp.Expr]:
    """Return what the equations of positions alone say that a new name is, each value once."""
    own = list(truth.derivation.coordinates)
    said = [line.expr for line in lines if _relates(line, new)]
    known = {*own, new}
    values = [v for expr in said if expr.atoms(AppliedUndef) <= known for v in solutions(expr, new) if v.has(*own)]
    return list(dict.fromkeys(values))


def relations(new: Sequence[sp.Expr], lines: Sequence[AnsweredLine]) -> list[AnsweredLine]:
    """Return the lines that relate one of the new names to other positions."""
    return [line for line in lines if any(_relates(line, x) for x in new)]


def without_relations(
    found: Sequence[AnsweredLine], put: Callable[[sp.Expr], sp.Expr], lines: Sequence[AnsweredLine]
) -> tuple[AnsweredLine, ...]:
    """Return the lines, in which those of the ``found`` relations that hold once ``put`` has replaced the new names are
    definitions.

    Any other relation stays an equation, which is judged.
    """
    holding = {id(line) for line in found if _is_zero(put(line.expr))}
    return tuple(replace(line, kind="definition") if id(line) in holding else line for line in lines)


def _is_zero(expr: sp.Expr) -> bool:
    """Whether an expression of positions is 0, as it may be only if it is at some place."""
    letters = sorted(bounded.letters(expr), key=sp.default_sort_key)
    value = cast("sp.Expr", expr.xreplace({x: sp.Float((7 * k + 5) / 11) for k, x in enumerate(letters)}))
    return not (value.is_Float and abs(value) > FAR) and bounded.cancel(expr) == 0


def _relates(line: AnsweredLine, new: sp.Expr) -> bool:
    """Whether a line is an equation of positions that names a coordinate of the answer."""
    return line.kind == "equation" and line.expr.has(new) and not line.expr.has(sp.Derivative)
