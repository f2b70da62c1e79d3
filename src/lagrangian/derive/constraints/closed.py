"""How many rows on positions are independent where all of them hold.

At a random position a closed loop's rows may all be independent, while along the motion one of them follows from the
others: a platform on three equal, parallel cranks moves, although four rows restrict four angles. So the rank is also
taken at positions that satisfy the rows, which Newton's method finds from random starts.

Positions may be of several kinds, between which no motion leads without passing through a position of both: where two
arms of Peaucellier's linkage lie on each other, it turns like two rods.
"""

from __future__ import annotations

from collections.abc import Sequence
from random import Random

import numpy as np
from numpy.typing import NDArray

from lagrangian.derive.constraints.pfaffian import Sheet
from lagrangian.derive.constraints.satisfied import CLEARLY, HARDLY, STEPS, drawn, newton_step
from lagrangian.derive.constraints.spans import asked
from lagrangian.graph.together import evaluate_together

STARTS = 24
"""The number of random starts."""

CLOSED = 1e-11
"""The largest residual of a position that satisfies the rows."""

AGREE = 2
"""The number of positions that must show a rank."""


def ranks_where_closed(sheet: Sheet, positions: Sequence[int]) -> tuple[int, ...]:
    """Return the ranks of the rows ``positions`` at positions that satisfy them, each once, the largest first.

    It is empty if too few positions were found. A position where the rank is in doubt does not count.
    """
    sizes = np.linalg.svd(_slopes_where_closed(sheet, positions), compute_uv=False)
    largest = sizes.max(axis=-1, keepdims=True)
    doubtful = ((sizes > HARDLY * largest) & (sizes < CLEARLY * largest)).any(axis=-1)
    ranks = (sizes >= CLEARLY * largest).sum(axis=-1)[~doubtful].tolist()
    return tuple(sorted({rank for rank in ranks if ranks.count(rank) >= AGREE}, reverse=True))


def _slopes_where_closed(sheet: Sheet, positions: Sequence[int]) -> NDArray[np.float64]:
    """The slopes (found, rows, coordinates) at the positions that satisfy the rows, from all starts at once."""
    count, columns = len(positions), sheet.columns[:-1]
    wanted = [*positions, *(x for f in positions for x in sheet.differential(f)[:-1])]
    starts = [drawn(sheet, wanted, Random(start)) for start in range(STARTS)]
    values = {i: np.array([float(start[i]) for start in starts]) for i in starts[0]}
    values |= {i: np.zeros(STARTS) for i in columns if i not in values}
    found: list[NDArray[np.float64]] = []
    for _ in range(STEPS):
        numbers = evaluate_together(*asked(sheet, wanted, values, np.zeros(1)))["x"]
        f, A = numbers[:, :count], numbers[:, count:].reshape(len(numbers), count, -1)
        closed, known = np.abs(f).max(axis=-1) < CLOSED, np.isfinite(numbers).all(axis=-1)
        found.extend(A[known & closed])
        going = known & ~closed
        if not going.any():
            break
        values = {i: x[going] for i, x in values.items()}
        step = newton_step(f[going], A[going])
        values |= {i: values[i] - step[:, k] for k, i in enumerate(columns)}
    return np.array(found).reshape(-1, count, len(columns))
