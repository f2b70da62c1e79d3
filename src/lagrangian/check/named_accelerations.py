"""Puts accelerations that lines below say into the balances that use them: m x_P'' = N, then x_P'' = l theta''."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.reading.line_forms import accelerates
from lagrangian.check.verdict import AnsweredLine
from lagrangian.model import time
from lagrangian.read.letters import key


def with_accelerations(lines: Sequence[AnsweredLine]) -> tuple[AnsweredLine, ...]:
    """The lines, with what definitions say of the accelerations of points put into the equations that have them."""
    said = {key(x.name): x.expr for x in lines if x.kind == "definition" and x.name and accelerates(x.expr)}
    if not said:
        return tuple(lines)

    def put(line: AnsweredLine) -> AnsweredLine:
        moving = bounded.atoms(line.expr, AppliedUndef) if line.kind == "equation" else set[Any]()
        table = {
            sp.Derivative(x, (time, 2)): said[own]
            for x in moving
            if (own := key(x.func.__name__)) in said and not said[own].has(x)
        }
        if not table:
            return line
        sides = None if line.sides is None else (bounded.replaced(x, table) for x in line.sides)
        return replace(line, expr=bounded.replaced(line.expr, table), sides=None if sides is None else tuple(sides))

    return tuple(map(put, lines))
