"""Rows in the order given: which are independent, which are redundant, and which contradict others."""

# mpmath has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownVariableType=false
# pyright: reportUnknownArgumentType=false

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import mpmath

from lagrangian.derive.constraints.pfaffian import RowForm, Sheet
from lagrangian.derive.constraints.spans import DIGITS, GenericPoint, evaluated
from lagrangian.graph import reached

STARTS = 6
"""The number of points from which a position that satisfies the earlier rows is sought."""

STEPS = 60
"""The number of Newton steps from each of them."""


@dataclass(frozen=True)
class RedundantRow:
    """A redundant row, and the rows from which it follows."""

    name: str
    repeats: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class Sorted:
    """The independent rows, and the others; ``unsure`` names rows that are redundant in the rates alone."""

    kept: list[RowForm]
    redundant: list[RedundantRow]
    contradictions: list[RedundantRow]
    unsure: list[str]


def sort_rows(sheet: Sheet, place: GenericPoint, given: Sequence[RowForm]) -> Sorted:
    """Return which rows are independent for all q, t and parameters.

    A row whose coefficients of the rates depend on those of earlier rows is redundant if its right-hand side follows
    too; otherwise it contradicts them. Rows on positions with the same rates must also agree in the positions.
    """
    rates, whole = place.span(), place.span()
    found = Sorted([], [], [], [])
    for k, form in enumerate(given):
        names = rates.made_of(form.coefficients[:-1])
        if names is None:
            rates.take(k, form.coefficients[:-1])
            whole.take(k, form.coefficients)
            found.kept.append(form)
            continue
        repeated = [given[i] for i in names]
        said = RedundantRow(form.name, tuple(f.name for f in repeated))
        if whole.made_of(form.coefficients) is None:
            found.contradictions.append(said)
            continue
        agrees = _agrees(sheet, place, form, repeated)
        if agrees is None:
            found.unsure.append(form.name)
        (found.contradictions if agrees is False else found.redundant).append(said)
    return found


def _agrees(sheet: Sheet, place: GenericPoint, form: RowForm, repeated: Sequence[RowForm]) -> bool | None:
    """Whether f = 0 at positions that satisfy the rows that it repeats; None if no such position was found.

    There f is constant, because df is a combination of their differentials. A row on rates cannot disagree.
    """
    if form.position is None or any(f.position is None for f in repeated):
        return True
    if not place.nonzero([form.position])[0]:
        return True
    others = [f.position for f in repeated if f.position is not None]
    for start in range(STARTS):
        value = _at_satisfied(sheet, form.position, others, start)
        if value is not None:
            return value
    return None


def _at_satisfied(sheet: Sheet, position: int, others: list[int], start: int) -> bool | None:
    """Whether f = 0 at a position that satisfies the others, which Newton's method finds from a random start."""
    if not others:
        return False  # f does not depend on the coordinates, and is not 0
    graph, draw = sheet.graph, random.Random(start)
    slopes = [sheet.differential(f)[:-1] for f in others]
    wanted = [position, *others, *(x for row in slopes for x in row)]
    inputs = [i for i in reached(graph, wanted) if graph.nodes[i][0] == "input"]
    with mpmath.workdps(DIGITS):
        values: dict[int, Any] = {}
        for i in inputs:
            number = sheet.numbers.get(i)
            values[i] = (
                +mpmath.pi
                if i == sheet.pi
                else mpmath.mpf(draw.randrange(10**DIGITS)) / 10**DIGITS + mpmath.mpf("0.3")
                if number is None
                else mpmath.mpf(number.numerator) / number.denominator
            )
        columns = sheet.columns[:-1]
        for _ in range(STEPS):
            found = evaluated(sheet, wanted, values)
            if not all(mpmath.isfinite(x) for x in found):
                return None
            residual = mpmath.matrix(found[1 : 1 + len(others)])
            if mpmath.norm(residual) < mpmath.mpf(10) ** -40:
                return bool(abs(found[0]) < mpmath.mpf(10) ** -30)
            width = len(columns)
            flat = found[1 + len(others) :]
            slope = mpmath.matrix([flat[k * width : (k + 1) * width] for k in range(len(others))])
            try:
                step = slope.T * mpmath.lu_solve(slope * slope.T, residual)
            except ZeroDivisionError:
                return None
            for k, column in enumerate(columns):
                values[column] = values.get(column, mpmath.mpf(0)) - step[k]
    return None
