"""Coordinates that an answer counts from the same place, x = R φ, where a constraint says only ẋ = R φ̇.

The equations then hold with R φ in place of x, or x/R in place of φ, wherever these stand without a rate.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine
from lagrangian.model import time
from lagrangian.model.rows import Row, rows_of
from lagrangian.page.formula import Text, text

MOST = 6
"""The most ways in which coordinates are counted together."""


def counted_together(
    truth: Reference, lines: Sequence[AnsweredLine]
) -> Iterator[tuple[tuple[AnsweredLine, ...], tuple[Text, ...]]]:
    """The lines with one coordinate of every such constraint in others, and how they are counted then.

    A coordinate is replaced only where an equation or an energy has it without a rate.
    """
    ways: list[dict[Any, sp.Expr]] = [{}]
    for table in filter(None, (relation_of(truth, row) for row in rows_of(truth.model))):
        ways = [{**way, q: x} for way in ways for q, x in table.items() if not any(x.has(k) or q == k for k in way)]
    for way in ways[:MOST]:
        put = tuple(_with(line, way) for line in lines)
        if way and any(a is not b for a, b in zip(put, lines, strict=True)):
            yield (
                put,
                tuple(text("This counts ", q, " and the others so that ", q, " = ", x, ".") for q, x in way.items()),
            )


def relation_of(truth: Reference, row: Row) -> dict[Any, sp.Expr] | None:
    """Each coordinate of a constraint on velocities in the others, x = R φ of ẋ = R φ̇; None if its factors change."""
    if row.position is not None:
        return None
    c = truth.expand(row.rate)
    rates = {k.symbol: k.rate for k in truth.model.coordinates if c.has(k.rate)}
    factors = {q: bounded.diff(c, v) for q, v in rates.items()}
    whole = sp.Add(*[a * rates[q] for q, a in factors.items()])
    moving = any(a.has(time, *truth.derivation.coordinates) for a in factors.values())
    if len(factors) < 2 or moving or bounded.expand(c - whole) != 0:
        return None
    return {q: cast("sp.Expr", sp.Add(*[-b * r / a for r, b in factors.items() if r != q])) for q, a in factors.items()}


def _with(line: AnsweredLine, way: Mapping[Any, sp.Expr]) -> AnsweredLine:
    """A line with others in place of coordinates without a rate; the same line if it has none of them."""
    if line.kind in ("definition", "identity", "statement", "given"):
        return line
    held = {d: sp.Dummy() for d in line.expr.atoms(sp.Derivative)}
    bare = cast("sp.Expr", line.expr.xreplace(held))
    if not bare.has(*way) or (not held and line.kind == "equation"):
        return line
    back = {dummy: d for d, dummy in held.items()}
    return replace(line, expr=cast("sp.Expr", bare.xreplace(dict(way)).xreplace(back)))
