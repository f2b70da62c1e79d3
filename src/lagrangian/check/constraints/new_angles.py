"""Angles of an answer that step 0 proposes: on a circle x² + y² = l², x and y become x = l sin θ, y = −l cos θ.

A name that the system does not have, and that the answer differentiates twice, is no multiplier but a coordinate. If
the answer does not define it, it is an angle on a circle of the constraints, from any of the four axis directions and
in either sense: the meaning that makes the answer right is taken, otherwise the one that step 0 proposes.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from itertools import starmap
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.constraints.constrained import check_constrained
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Verdict
from lagrangian.model import time
from lagrangian.page.formula import Text, text


def check_in_any_angle(truth: Reference, lines: Sequence[AnsweredLine], hint: int) -> Verdict:
    """The verdict of `check_constrained`, on an answer that may use a new angle."""
    proposed: Verdict | None = None
    for put, note in _readings(truth, lines):
        verdict = check_constrained(truth, put, hint)
        verdict = replace(verdict, notes=(note, *verdict.notes))
        onto = put if verdict.right else tuple(starmap(partial(_where_held, truth), zip(lines, put, strict=True)))
        held = check_constrained(truth, onto, hint) if onto != put else verdict
        if held.right_lines > verdict.right_lines:
            verdict = replace(held, notes=(note, *held.notes))
        if verdict.right:
            return verdict
        proposed = verdict if proposed is None else proposed
    return check_constrained(truth, lines, hint) if proposed is None else proposed


def _where_held(truth: Reference, was: AnsweredLine, now: AnsweredLine) -> AnsweredLine:
    """An energy or a force in the new angle as the statement that it is the system's where the constraints hold."""
    return now if was.expr == now.expr else where_held(truth, now)


def where_held(truth: Reference, line: AnsweredLine) -> AnsweredLine:
    """An energy or a force as the statement that it is the system's where the constraints hold: T = ½ m l² φ̇².

    That of V is differentiated by time, because its level is free.
    """
    forces = {c.name: force for c, force in zip(truth.model.coordinates, truth.Xi, strict=True)}
    if line.kind == "Xi" and line.name in forces:
        return replace(line, kind="equation", expr=line.expr - forces[line.name])
    if line.kind not in ("T", "V"):
        return line
    if line.kind == "T":
        return replace(line, kind="equation", expr=line.expr - truth.T)
    return replace(line, kind="equation", expr=bounded.diff(line.expr - truth.V, time))


def _readings(truth: Reference, lines: Sequence[AnsweredLine]) -> Iterator[tuple[tuple[AnsweredLine, ...], Text]]:
    """The lines in the system's own coordinates, and how the new angle was read; nothing if there is no such angle."""
    known = {c.symbol for c in truth.model.coordinates}
    turned = {d.expr for line in lines for d in line.expr.atoms(sp.Derivative) if d.derivative_count > 1}
    new = [x for x in turned - known if isinstance(x, AppliedUndef)]
    constraints = truth.derivation.constraints
    if len(new) != 1 or constraints is None:
        return
    for way in constraints.proposals:
        if way.new is None or len(way.written) != 2:
            continue
        (x, along), (y, up) = way.written
        for quarter in range(4):
            for sense in (1, -1):
                turn = sense * new[0] + quarter * sp.pi / 2
                there = [(q, cast("sp.Expr", v.xreplace({way.new: turn}))) for q, v in ((x, along), (y, up))]
                if not all(_agrees(line, dict(there), new[0]) for line in lines):
                    continue
                value = sense * (_angle(way.new, (x, along), (y, up)) - quarter * sp.pi / 2)
                table: dict[Any, sp.Expr] = {new[0]: value}
                put = tuple(_put(a, table) for a in lines)
                (p, a), (q, b) = there
                yield put, text("Read with ", p, " = ", a, ", ", q, " = ", b, ".")


def _put(line: AnsweredLine, table: dict[Any, sp.Expr]) -> AnsweredLine:
    """A line with the angle written out; a slope by the angle or by its rate, of which the system knows nothing, is a
    statement."""
    by = {x for d in line.expr.atoms(sp.Derivative) for x in d.variables} - {time}
    if by:
        return replace(line, kind="statement")
    return replace(line, expr=cast("sp.Expr", line.expr.xreplace(table).doit()))


def _agrees(line: AnsweredLine, there: dict[sp.Expr, sp.Expr], new: sp.Expr) -> bool:
    """Whether a line does not say of a coordinate, in the new angle, what contradicts this reading: y = l cos θ."""
    said = {str(q.func): value for q, value in there.items()}.get(str(line.name)) if line.kind == "definition" else None
    return said is None or not line.expr.has(new) or sp.expand_trig(said - line.expr).expand() == 0


def _angle(new: sp.Expr, first: tuple[sp.Expr, sp.Expr], second: tuple[sp.Expr, sp.Expr]) -> sp.Expr:
    """The angle at a position, of x = a + r sin θ and y = b − r cos θ."""
    (x, along), (y, up) = first, second
    a, b = along.xreplace({new: sp.S.Zero}), up.xreplace({new: sp.pi / 2})
    return cast("sp.Expr", sp.atan2(x - a, b - y))
