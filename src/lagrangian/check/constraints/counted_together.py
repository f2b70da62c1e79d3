"""Coordinates that an answer counts from the same place, x = R φ, where a constraint says only ẋ = R φ̇.

The equations then hold with R φ in place of x, or x/R in place of φ, wherever these stand without a rate.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine
from lagrangian.model import time
from lagrangian.model.rows import Row, rows_of
from lagrangian.page.formula import Text, text

MOST = 6
"""The most ways in which coordinates are counted together."""
HIGHEST = 3
"""The highest power of the time in a given rate."""


def counted_together(
    truth: Reference, lines: Sequence[AnsweredLine]
) -> Iterator[tuple[tuple[AnsweredLine, ...], tuple[Text, ...]]]:
    """The lines with one coordinate of every such constraint in others, and how they are counted then.

    A coordinate is replaced only where an equation or an energy has it without a rate.
    """
    for way in ways_together(truth):
        put = tuple(_with(line, way) for line in lines)
        if way and any(a is not b for a, b in zip(put, lines, strict=True)):
            yield (
                put,
                tuple(text("This counts ", q, " and the others so that ", q, " = ", x, ".") for q, x in way.items()),
            )


def ways_together(truth: Reference) -> list[dict[Any, sp.Expr]]:
    """One coordinate of every such constraint in the others, in all ways: φ = x/R or x = R φ."""
    ways: list[dict[Any, sp.Expr]] = [{}]
    for row in rows_of(truth.model):
        place = None if row.position is not None else integrated(truth, row)
        if place is not None:
            slopes = {c.symbol: bounded.diff(place, c.symbol) for c in truth.model.coordinates if place.has(c.symbol)}
            given = bounded.expand(place - sp.Add(*[a * q for q, a in slopes.items()]))
            table = {
                q: cast("sp.Expr", sp.Add(-given / a, *[-b * r / a for r, b in slopes.items() if r != q]))
                for q, a in slopes.items()
            }
            ways = [{**way, q: x} for way in ways for q, x in table.items() if not any(x.has(k) or q == k for k in way)]
    return ways[:MOST]


def integrated(truth: Reference, row: Row) -> sp.Expr | None:
    """What a constraint says of positions: itself, x − R φ for rates with constant factors, also beside a given rate
    such as a₀ t, or nothing."""
    if row.position is not None:
        return truth.expand(row.position)
    c, coordinates = truth.expand(row.rate), truth.model.coordinates
    factors = {k: bounded.diff(c, k.rate) for k in coordinates if c.has(k.rate)}
    whole = sp.Add(*[a * k.rate for k, a in factors.items()])
    moving = any(a.has(time, *truth.derivation.coordinates) for a in factors.values())
    given = None if len(factors) < 2 or moving else _from_the_start(bounded.expand(c - whole))
    if given is None:
        return None
    return cast("sp.Expr", sp.Add(given, *[a * k.symbol for k, a in factors.items()]))


def _from_the_start(rate: sp.Expr) -> sp.Expr | None:
    """The integral from t = 0 of a given rate that is a polynomial in time: a₀ t²/2 of a₀ t; None for any other."""
    found, left = list[sp.Expr](), rate
    for k in range(HIGHEST + 1):
        if left == 0:
            return sp.Add(*found)
        if left.has(AppliedUndef, sp.Derivative):
            return None
        found.append(cast("sp.Expr", left.xreplace({time: sp.S.Zero}) * time ** (k + 1) / sp.factorial(k + 1)))
        left = bounded.diff(left, time)
    return None


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
