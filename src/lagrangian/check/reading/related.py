"""Coordinates that an answer gives in others before it differentiates its energies, where constraints allow it.

With φ = x/R put in, ½ J φ̇² has the slope J ẋ/R² by ẋ. A program does so where φ is a function that it defines; a sheet
may do so, or hold φ.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.reading.answer import AnswerLine
from lagrangian.model import Model
from lagrangian.model.names import time


class StatedRelations:
    """The coordinates of a system with constraints that an answer gives in others, line by line."""

    def __init__(self, model: Model) -> None:
        self.put = False
        """Whether they are put into energies before these are differentiated."""
        self.asked = False
        """Whether an energy was differentiated in which they stand."""
        self._coordinates = {c.symbol for c in model.coordinates} if model.constraints else set[sp.Expr]()
        self._table: dict[sp.Expr, sp.Expr] = {}

    def add(self, lines: Iterable[AnswerLine]) -> None:
        """Note the lines that say what a coordinate is in others: φ = x/R."""
        for line in lines:
            q, value = line.lhs, sp.sympify(line.rhs)
            if q is None or line.kind != "equation" or q not in self._coordinates or value.has(sp.Derivative):
                continue
            others = value.atoms(AppliedUndef)
            if others and others <= self._coordinates - {q} and not others & self._table.keys():
                self._table = {x: v for x, v in self._table.items() if not v.has(q)} | {q: value}

    def into(self, energy: sp.Expr, variable: sp.Expr) -> sp.Expr:
        """An energy that is differentiated by a variable, with these put in if they are to be."""
        table = {q: x for q, x in self._table.items() if not variable.has(q) and energy.has(q)}
        self.asked = self.asked or bool(table)
        if not table or not self.put:
            return energy
        rates = {q.diff(time): bounded.diff(x, time) for q, x in table.items()}
        return cast("sp.Expr", bounded.replaced(energy, table | rates))
