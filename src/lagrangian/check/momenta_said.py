"""Rates of names that an answer gave to momenta: ṗ_φ = … below p_φ = ∂T*/∂φ̇ is d/dt (∂L/∂φ̇), and judged as that."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.reading.line_forms import accelerates
from lagrangian.check.reference import Reference
from lagrangian.check.rows import compare, zero_everywhere
from lagrangian.check.verdict import AnsweredLine
from lagrangian.model import time
from lagrangian.read.letters import key


def with_rates_of_momenta(truth: Reference, lines: Sequence[AnsweredLine]) -> tuple[AnsweredLine, ...]:
    """The lines, with those as d/dt (∂L/∂ξ̇) that give another value with accelerations for the rate of a name that was
    rightly given to ∂L/∂ξ̇."""
    return tuple(_as_rate(truth, x, lines[:k]) if _is_open(truth, x) else x for k, x in enumerate(lines))


def _is_open(truth: Reference, line: AnsweredLine) -> bool:
    """Whether a line says, wrongly, what a rate is, with accelerations in it and nothing that is in no momentum."""
    if line.kind not in ("identity", "equation") or line.sides is None or not accelerates(line.sides[1]):
        return False
    more = bounded.letters(line.sides[1]) - bounded.letters(truth.T) - {c.symbol for c in truth.model.coordinates}
    return not more - {time} and bounded.expand(line.expr) != 0


def _as_rate(truth: Reference, line: AnsweredLine, above: Sequence[AnsweredLine]) -> AnsweredLine:
    """A line as the rate of the momentum that its name is; as it is if the name is none."""
    for said in above[::-1]:
        if said.kind != "definition" or not said.name or not _is_of(line, said):
            continue
        own = [c for c in truth.model.coordinates if said.expr.has(c.rate)]
        own = [c for c in own if zero_everywhere(truth, bounded.diff(truth.L, c.rate) - said.expr)]
        if not own or compare(truth, [line.expr]).rows[0].true:
            return line  # of no momentum, or what holds along the motions
        value = cast("sp.Expr", bounded.diff(said.expr, time) - line.expr)
        written = truth.expand(line.sides[1]) if line.sides is not None else value
        same = zero_everywhere(truth, written - value)
        return replace(line, kind="p-rate", name=own[0].name, expr=written if same else value, sides=None)
    return line


def _is_of(line: AnsweredLine, said: AnsweredLine) -> bool:
    """Whether a line gives the rate of what is said: by its name, or as d/dt of the name and nothing else."""
    if line.kind == "identity":
        return line.name == said.name
    named = line.sides is not None and key(said.name or "") in line.names
    return named and line.sides is not None and bounded.expand(line.sides[0] - bounded.diff(said.expr, time)) == 0
