"""How many rows on positions are independent where all of them hold.

At a random position a closed loop's rows may all be independent, while along the motion one of them follows from the
others: a platform on three equal, parallel cranks moves, although four rows restrict four angles. So the rank is also
taken at positions that satisfy the rows, which Newton's method finds from random starts.

Positions may be of several kinds, between which no motion leads without passing through a position of both: where two
arms of Peaucellier's linkage lie on each other, it turns like two rods.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lagrangian.derive.constraints.pfaffian import Sheet
from lagrangian.derive.constraints.satisfied import CLEARLY, HARDLY, satisfied

STARTS = 24
"""The number of random starts."""

CLOSED = 1e-11
"""The largest residual of a position that satisfies the rows."""

AGREE = 2
"""The number of positions that must show a rank."""


def ranks_where_closed(sheet: Sheet, positions: Sequence[int]) -> tuple[int, ...]:
    """Return the ranks of the rows ``positions`` at positions that satisfy them, each once, the largest first.

    It is empty if too few positions were found.
    """
    ranks = [rank for start in range(STARTS) if (rank := _rank_from(sheet, positions, start)) is not None]
    return tuple(sorted({rank for rank in ranks if ranks.count(rank) >= AGREE}, reverse=True))


def _rank_from(sheet: Sheet, positions: Sequence[int], start: int) -> int | None:
    """The rank at the position that is found from a random start; None if there is none, or in doubt."""
    there = satisfied(sheet, positions, start, within=CLOSED)
    if there is None:
        return None
    sizes = np.linalg.svd(there.slopes, compute_uv=False)
    doubtful = bool(np.any((sizes > HARDLY * sizes.max()) & (sizes < CLEARLY * sizes.max())))
    return None if doubtful else int((sizes >= CLEARLY * sizes.max()).sum())
