"""How many rows on positions are independent where all of them hold.

At a random position a closed loop's rows may all be independent, while along the motion one of them follows from the
others: a platform on three equal, parallel cranks moves, although four rows restrict four angles. So the rank is also
taken at positions that satisfy the rows, which Newton's method finds from random starts.
"""

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
from lagrangian.derive.constraints.spans import evaluated
from lagrangian.graph import reached

STARTS = 24
"""The number of random starts."""

STEPS = 40
"""The number of Newton steps from each of them."""

LONGEST = 0.7
"""The longest step of a coordinate."""

NEAR = 1e-2
"""A residual below which only the rows that are clearly independent lead on."""

CLOSED = 1e-11
"""The largest residual of a position that satisfies the rows."""

HARDLY, CLEARLY = 1e-9, 1e-4
"""A singular value below the first part of the largest one is 0, above the second it is not. Between them is doubt."""

AGREE = 2
"""The number of positions that must show a lower rank."""


def rank_where_closed(sheet: Sheet, positions: Sequence[int]) -> int | None:
    """Return the least rank of the rows ``positions`` at positions that satisfy them; None if too few were found."""
    slopes = [sheet.differential(f)[:-1] for f in positions]
    wanted = [*positions, *(x for row in slopes for x in row)]
    ranks = [rank for start in range(STARTS) if (rank := _rank_from(sheet, wanted, len(positions), start)) is not None]
    least = min(ranks, default=0)
    return least if ranks.count(least) >= AGREE else None


def _rank_from(sheet: Sheet, wanted: Sequence[int], count: int, start: int) -> int | None:
    """The rank at the position that Newton's method finds from a random start; None if there is none, or in doubt."""
    graph, draw = sheet.graph, random.Random(start)
    columns = sheet.columns[:-1]
    values: dict[int, Any] = {}
    for i in reached(graph, wanted):
        if graph.nodes[i][0] != "input":
            continue
        number = sheet.numbers.get(i)
        drawn = draw.uniform(-1.5, 1.5) if i in columns else draw.uniform(0.5, 1.5)
        values[i] = +mpmath.pi if i == sheet.pi else mpmath.mpf(drawn if number is None else float(number))
    for _ in range(STEPS):
        found = _floats(evaluated(sheet, list(wanted), values))
        if not np.isfinite(found).all():
            return None
        f, A = found[:count], found[count:].reshape(count, -1)
        sizes = np.linalg.svd(A, compute_uv=False)
        done = float(np.abs(f).max()) < CLOSED
        doubtful = bool(np.any((sizes > HARDLY * sizes.max()) & (sizes < CLEARLY * sizes.max())))
        if done:
            return None if doubtful else int((sizes >= CLEARLY * sizes.max()).sum())
        step = np.linalg.pinv(A, rcond=CLEARLY if np.abs(f).max() < NEAR else HARDLY) @ f
        step *= min(1.0, LONGEST / max(float(np.abs(step).max()), LONGEST))
        for column, change in zip(columns, step, strict=True):
            values[column] = values.get(column, mpmath.mpf(0)) - mpmath.mpf(float(change))
    return None


def _floats(values: Sequence[Any]) -> NDArray[np.float64]:
    return np.array([float(x) if mpmath.isfinite(x) else np.nan for x in values])
