"""Equations of motion that stand in the form of other lines: p' = F + H, and d/dt ∂T/∂φ̇ = τ − c φ̇."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from lagrangian import bounded
from lagrangian.check.reading.line_forms import accelerates
from lagrangian.check.reference import Reference
from lagrangian.check.rows import compare
from lagrangian.check.verdict import AnsweredLine
from lagrangian.model import time

RATES = ("p-rate", "T-rate")


def with_balances(truth: Reference, lines: Sequence[AnsweredLine], *, moved: bool) -> list[AnsweredLine]:
    """The lines; one on the rate of a name of the answer's own, p' = F + H, that holds only along the motions is an
    equation of motion, and so is the rate of a momentum that is equal to forces.

    ``moved``: the lines were converted from other coordinates, whose momenta are not those of the system.
    """
    lines = [x if moved and x.kind == "p-rate" else as_equation(truth, x) for x in lines]
    moving = [i for i, x in enumerate(lines) if x.kind == "identity" and accelerates(x.expr)]
    rows = compare(truth, [lines[i].expr for i in moving]).rows if moving else ()
    true = {i for i, row in zip(moving, rows, strict=True) if row.true}
    return [replace(x, kind="equation", name=None) if i in true else x for i, x in enumerate(lines)]


def as_equation(truth: Reference, line: AnsweredLine) -> AnsweredLine:
    """A line d/dt ∂L/∂ξ̇ = … with what no momentum has, inputs, stiffnesses and dampers, as an equation of motion."""
    row = next((r for c, r in zip(truth.model.coordinates, truth.rows, strict=True) if c.name == line.name), None)
    if line.kind not in RATES or row is None:
        return line
    more = bounded.letters(line.expr) - bounded.letters(truth.T) - {c.symbol for c in truth.model.coordinates} - {time}
    if not more:
        return line
    if line.kind == "T-rate":
        return replace(line, kind="equation", name=None)
    momentum = next(bounded.diff(truth.L, c.rate) for c in truth.model.coordinates if c.name == line.name)
    if line.expr.has(*(c.acceleration for c in truth.model.coordinates)):
        return line
    return replace(line, kind="equation", name=None, expr=bounded.diff(momentum, time) - line.expr)
