"""Writes lines of an answer in the coordinates and their rates alone, for systems with constraints."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.constraints.own_constraints import with_rates
from lagrangian.check.held import vanishes_on_constraints
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine
from lagrangian.model import time
from lagrangian.page.plain import plain
from lagrangian.read.letters import key

_SLOPE = re.compile(
    r"d\\?(?P<name>\w{1,24})/d\\?(?P<by>\w{1,24})|\\[dt]?frac\{d\\?(?P<above>\w{1,24})\}\{d\\?(?P<below>\w{1,24})\}"
)
"""The slope of a name by another one, du/dα."""

_MARKS = re.compile(r"\\(?:mathrm|text)\b|[\s$&()]")
"""What may stand in such a slope and says nothing."""


def in_coordinates(truth: Reference, lines: Sequence[AnsweredLine]) -> list[AnsweredLine]:
    """The lines with new speeds written out in rates, and a constraint that was integrated as one on rates."""
    lines = [_along(truth, line, lines) for line in lines]
    return [with_rates(truth, _in_rates(truth, _of_motion(truth, line))) for line in lines]


def _along(truth: Reference, line: AnsweredLine, lines: Sequence[AnsweredLine]) -> AnsweredLine:
    """A line du/dα = w that is true where the constraints move the other coordinates, too, as u̇ = w α̇."""
    if line.kind != "equation" or line.expr.has(sp.Derivative):
        return line
    left = _MARKS.sub("", line.text.partition("=")[0][:200]).replace("{d}", "d")
    if (found := _SLOPE.fullmatch(left)) is None:
        return line
    name, by = (key(found[x] or found[y] or "") for x, y in (("name", "above"), ("by", "below")))
    c = next((c for c in truth.model.coordinates if key(c.name) == by), None)
    meaning = next((x.expr for x in lines if x.kind == "definition" and key(x.name or "") == name), None)
    if c is None or meaning is None or meaning.has(sp.Derivative) or not bounded.letters(meaning) <= truth.names:
        return line
    if not meaning.has(*(x.symbol for x in truth.model.coordinates if x is not c)):
        return line  # the same with and without the constraints
    if vanishes_on_constraints(truth, c.rate):
        return line
    slope = bounded.diff(meaning, c.symbol) - line.expr
    along = bounded.diff(meaning, time) - slope * c.rate
    return replace(line, expr=along) if vanishes_on_constraints(truth, along) else line


def _in_rates(truth: Reference, line: AnsweredLine) -> AnsweredLine:
    """A line with the new speeds of the equations without multipliers written out in rates."""
    minimal = truth.derivation.minimal
    if minimal is None or not minimal.meanings:
        return line
    table: dict[sp.Basic, sp.Expr] = {}
    for speed, meaning in minimal.meanings.items():
        moving = cast("sp.Expr", sp.diff(meaning, time))
        table |= {sp.Derivative(speed, time): moving, speed: meaning, sp.Symbol(plain(speed)): meaning}
    expr = cast("sp.Expr", line.expr.xreplace(table))
    return replace(line, expr=expr)


def _of_motion(truth: Reference, line: AnsweredLine) -> AnsweredLine:
    """A line such as v' = a θ'², with a speed of the equations without multipliers, as an equation of motion."""
    minimal = truth.derivation.minimal
    if minimal is None or line.kind not in ("identity", "definition"):
        return line
    for speed in minimal.meanings:
        name, rate = plain(speed), cast("sp.Expr", sp.Derivative(speed, time))
        expr = line.expr if line.expr.has(rate) else None
        if line.kind == "definition" and line.name == name and _left(line) in (f"{name}'", rf"\dot{{{name}}}"):
            expr = rate - line.expr
        if expr is not None:
            return replace(line, kind="equation", expr=expr)
    return line


def _left(line: AnsweredLine) -> str:
    """The left side as it was written."""
    return line.text.partition("=")[0].strip(" $&")
