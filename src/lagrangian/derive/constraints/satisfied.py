"""Positions that satisfy rows, which Newton's method finds from random starts."""

# mpmath has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownVariableType=false
# pyright: reportUnknownArgumentType=false

from __future__ import annotations

import random
from collections.abc import Sequence
from typing import Any

import mpmath
import numpy as np
from numpy.typing import NDArray

from lagrangian.derive.constraints.pfaffian import Sheet
from lagrangian.derive.constraints.spans import DIGITS, evaluated
from lagrangian.graph import reached

STEPS = 40
"""The number of Newton steps from a start."""

LONGEST = 0.7
"""The longest step of a coordinate."""

NEAR = 1e-2
"""A residual below which only the rows that are clearly independent lead on."""

HARDLY, CLEARLY = 1e-9, 1e-4
"""A singular value below the first part of the largest one is 0, above the second it is not. Between them is doubt."""


def satisfied(
    sheet: Sheet, positions: Sequence[int], start: int, *, within: float, others: Sequence[int]
) -> list[Any] | None:
    """Return the nodes ``others`` at a position at which the nodes ``positions`` are 0, with 50 digits.

    None if none is found from the start of that number. The residuals are at most ``within``. Steps have the precision
    of doubles, so each of the last ones makes the residual smaller by at least ten digits.
    """
    count, columns = len(positions), sheet.columns[:-1]
    slopes = [x for f in positions for x in sheet.differential(f)[:-1]]
    wanted = [*positions, *slopes, *others]
    with mpmath.workdps(DIGITS):
        values = drawn(sheet, wanted, random.Random(start))
        for _ in range(STEPS):
            found = evaluated(sheet, wanted, values)
            numbers = np.array(found, float)
            if not np.isfinite(numbers).all():
                return None
            f, A = numbers[:count], numbers[count : count + len(slopes)].reshape(count, -1)
            if float(np.abs(f).max()) < within:
                return found[count + len(slopes) :]
            for column, change in zip(columns, newton_step(f, A), strict=True):
                values[column] = values.get(column, mpmath.mpf(0)) - mpmath.mpf(float(change))
    return None


def newton_step(f: NDArray[np.float64], A: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return what is subtracted from coordinates where rows are f (…, rows) and their slopes are A (…, rows, n)."""
    rcond = np.where(np.abs(f).max(axis=-1) < NEAR, CLEARLY, HARDLY)
    step = (np.linalg.pinv(A, rcond=rcond) @ f[..., None])[..., 0]
    return step * (LONGEST / np.maximum(np.abs(step).max(axis=-1, keepdims=True), LONGEST))


def drawn(sheet: Sheet, wanted: Sequence[int], draw: random.Random) -> dict[int, Any]:
    """Random values of the coordinates and of the constants without a value that the nodes ``wanted`` need."""
    columns = sheet.columns[:-1]
    values: dict[int, Any] = {}
    for i in reached(sheet.graph, wanted):
        if sheet.graph.nodes[i][0] != "input":
            continue
        drawn = draw.uniform(-1.5, 1.5) if i in columns else draw.uniform(0.5, 1.5)
        number = sheet.numbers.get(i)
        if i == sheet.pi:
            values[i] = +mpmath.pi
        else:
            values[i] = mpmath.mpf(drawn) if number is None else mpmath.mpf(number.numerator) / number.denominator
    return values
