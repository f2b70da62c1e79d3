"""Coordinates that an answer says it uses, "u = x − y": mistakes are then named in these, not in the system's own.

The reader writes such names out, so that a term that is missing in the answer's coordinates would seem too much in the
system's: with u = x − Y sin ωt, m ü = 0 says m ẍ + m Y ω² sin ωt = 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.coordinates.chart import replaced
from lagrangian.check.coordinates.tried import ProposedChange, in_these
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine
from lagrangian.model import time
from lagrangian.page.formula import text
from lagrangian.records import dataclass

MOST = 4
"""The largest number of coordinates that are replaced."""


@dataclass(frozen=True, eq=False)
class InStatedCoordinates:
    """The system in the coordinates of an answer, the answer's lines in these, and what they are."""

    truth: Reference
    lines: tuple[AnsweredLine, ...]
    change: ProposedChange


def in_stated_coordinates(truth: Reference, lines: Sequence[AnsweredLine]) -> InStatedCoordinates | None:
    """The answer in the coordinates that it defines in place of some of the system's; None if it only names these.

    A coordinate is replaced if no equation names it any more. The definitions must determine those that are replaced.
    """
    q = list(truth.derivation.coordinates)
    stated, gone = replaced(truth, lines)
    if not stated or all(line.expr in q for line in stated) or len(stated) != len(gone) or len(gone) > MOST:
        return None
    J = sp.Matrix([[bounded.diff(line.expr, x) for x in gone] for line in stated])
    if J.has(*q, time) or J.det() == 0:
        return None
    new: dict[Any, sp.Expr] = {sp.Function(str(line.name))(time): line.expr for line in stated}
    change = ProposedChange(new, _words(new), True)
    other = in_these(truth, change)
    if other is None:
        return None
    symbols = {c.name: c.symbol for c in other.model.coordinates}
    if any(str(line.name) not in symbols for line in stated):
        return None
    rest = [symbols[str(x.name)] - cast("sp.Expr", x.expr.xreplace(dict.fromkeys(gone, sp.S.Zero))) for x in stated]
    values = cast("list[sp.Expr]", list(J.LUsolve(sp.Matrix(rest))))
    back = ProposedChange({x: bounded.expand(v) for x, v in zip(gone, values, strict=True)}, change.words, True)
    moved = tuple(replace(line, expr=bounded.expand(back.put(line.expr))) for line in lines if line not in stated)
    return InStatedCoordinates(other, moved, change)


def _words(new: dict[Any, sp.Expr]) -> Any:
    parts: list[Any] = []
    for eta, psi in new.items():
        parts += [eta, " = ", psi, ", "]
    return text("with ", *parts[:-1])
