"""Rates that an answer says of one body after another: ẋ = l θ̇ cos θ of the table, then ẋ = l θ̇ cos θ + u̇ of the axle.

The second is no contradiction of the first if it is right for another quantity of the system.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from lagrangian import bounded
from lagrangian.check.explain.said_wrongly import right_quantities
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine
from lagrangian.read.letters import key

VELOCITIES = ("component", "along", "speed", "turning")
"""The kinds of quantities that are rates of a place."""


def as_said_of_others(truth: Reference, lines: Sequence[AnsweredLine]) -> tuple[AnsweredLine, ...]:
    """The lines, with those that give the rate of a name once more as definitions if they are right for a velocity."""
    return tuple(_of_another(truth, x, lines[:k]) if _is_open(truth, x) else x for k, x in enumerate(lines))


def _is_open(truth: Reference, line: AnsweredLine) -> bool:
    """Whether a line says that two rates are equal that differ."""
    return line.kind == "identity" and line.name not in truth.model.symbols and bounded.expand(line.expr) != 0


def _of_another(truth: Reference, line: AnsweredLine, above: Sequence[AnsweredLine]) -> AnsweredLine:
    """A rate as a definition, if it is right for a velocity of the system."""
    for first in (x for x in above if x.kind == "definition" and x.name and key(x.name) in line.names):
        value = bounded.expand(first.expr - line.expr)
        other = replace(line, kind="definition", name=first.name, expr=value)
        if any(q.kind in VELOCITIES for q in right_quantities(truth, other)):
            return other
    return line
