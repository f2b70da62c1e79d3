"""Angles of an answer's own that its geometry determines: a cos θ + l cos β = c and a sin θ + l sin β = z.

Both lines say what cos β and sin β are. These are written out, and cos² β + sin² β = 1 is left of the two lines:
the constraint of the system. Equations with N sin β, or with two multipliers and an equation of β, are then compared as
any other. Where the cosine alone is used, one line says what it is, and nothing is left of that line.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine

MOST, LONGEST = 2, 60
"""The most such angles, and the most operations of a line that says what one is."""


def without_own_angles(truth: Reference, lines: Sequence[AnsweredLine]) -> tuple[AnsweredLine, ...]:
    """The lines with the sines and cosines of such angles written out."""
    every = {x for line in lines for x in bounded.letters(line.expr)}
    turning = {x for line in lines for f in line.expr.atoms(sp.sin, sp.cos) for x in bounded.letters(f)}
    for angle in sorted((every - truth.names) & turning, key=str)[:MOST]:
        lines = _without(truth, lines, angle) or lines
    return tuple(lines)


def _without(truth: Reference, lines: Sequence[AnsweredLine], angle: Any) -> tuple[AnsweredLine, ...] | None:
    """The lines without an angle; None if no two of them say what it is."""
    cosine, sine = sp.Dummy("cos"), sp.Dummy("sin")
    table = {sp.cos(angle): cosine, sp.sin(angle): sine}
    put = [cast("sp.Expr", _expanded(line.expr, angle).xreplace(table)) for line in lines]
    if any(expr.has(angle) for expr in put):
        return None
    alone = [x for x in (cosine, sine) if any(expr.has(x) for expr in put)]
    places = [k for k, (line, expr) in enumerate(zip(lines, put, strict=True)) if _is_place(truth, line, expr, table)]
    if len(alone) == 1 and places:
        return _by_one(lines, put, places[0], alone[0])
    for pair in combinations(places, 2):
        matrix = sp.Matrix([[bounded.diff(put[k], x) for x in (cosine, sine)] for k in pair])
        det = cast("sp.Expr", matrix.det())
        if matrix.has(cosine, sine) or det == 0:
            continue
        rest = sp.Matrix([-cast("sp.Expr", put[k].xreplace(dict.fromkeys((cosine, sine), sp.S.Zero))) for k in pair])
        solved: Any = matrix.adjugate() * rest / det
        values = dict(zip((cosine, sine), solved, strict=True))
        left = cast("sp.Expr", solved[0] ** 2 + solved[1] ** 2 - 1)
        return tuple(
            replace(line, expr=left if k in pair else cast("sp.Expr", expr.xreplace(values)))
            for k, (line, expr) in enumerate(zip(lines, put, strict=True))
        )
    return None


def _by_one(
    lines: Sequence[AnsweredLine], put: Sequence[sp.Expr], k: int, function: sp.Dummy
) -> tuple[AnsweredLine, ...] | None:
    """The lines where the cosine alone, or the sine alone, of an angle is used, and line ``k`` says what it is."""
    slope = cast("sp.Expr", bounded.diff(put[k], function))
    if slope == 0 or slope.has(function) or not any(x.has(function) for j, x in enumerate(put) if j != k):
        return None
    value = -cast("sp.Expr", put[k].xreplace({function: sp.S.Zero})) / slope
    return tuple(
        replace(line, kind="definition")
        if j == k
        else replace(line, expr=cast("sp.Expr", expr.xreplace({function: value})))
        for j, (line, expr) in enumerate(zip(lines, put, strict=True))
    )


def _is_place(truth: Reference, line: AnsweredLine, expr: sp.Expr, table: dict[Any, sp.Dummy]) -> bool:
    """Whether a line is about positions alone, and linear in the sine and the cosine."""
    new = {*table.values()}
    if line.kind != "equation" or expr.has(sp.Derivative) or not expr.has(*new):
        return False
    return bounded.letters(expr) - new <= truth.names and bounded.operations(expr) <= LONGEST


def _expanded(expr: sp.Expr, angle: Any) -> sp.Expr:
    """An expression with sin(β − θ) as sin β cos θ − cos β sin θ."""
    sums = {
        f: sp.expand_trig(f) for f in expr.atoms(sp.sin, sp.cos) if f.args[0] != angle and angle in bounded.letters(f)
    }
    return cast("sp.Expr", expr.xreplace(sums))
