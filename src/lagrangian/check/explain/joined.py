"""Joins mistakes that are one: the same at two places, or in one ledger what another is in all."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations

import numpy as np

from lagrangian.check.align import Alignment
from lagrangian.check.explain.changes.pool import Pool
from lagrangian.check.explain.search import Told

SHOWN = 1e-9
"""The size from which on a mistake is seen in an energy or a force."""


def joined(pool: Pool, chosen: Sequence[tuple[Told, Alignment | None]]) -> list[tuple[Told, Alignment | None]]:
    """The chosen mistakes, the same one at two places as one: in the springs and in the dampers, everywhere."""
    left = list(chosen)
    of_lines = [(t, under) for t, under in chosen if under is None]  # an equation may be the right one times −1
    for (a, under), (b, _) in combinations(of_lines, 2):
        one, two = a.mistake.change, b.mistake.change
        if one is None or two is None or (one.kind, a.times) != (two.kind, b.times) or one.written != two.written:
            continue
        if (whole := pool.together(a.mistake, b.mistake)) is not None and (a, under) in left:
            left[left.index((a, under))] = (replace(a, mistake=whole), under)
            left = [x for x in left if x[0] is not b]
    return left


def is_part(pool: Pool, told: Told, of: Told) -> bool:
    """Whether a mistake is what another one is in T*, in V or in Ξ: of a spring and a damper, the damper alone."""
    k, j = pool.places[id(told.mistake)], pool.places[id(of.mistake)]
    felt = False
    for values in (pool.T, pool.V, pool.Xi):
        own, whole = float(told.times) * values[k], float(of.times) * values[j]
        if not np.abs(own).max() > SHOWN:
            continue
        if np.abs(own - whole).max() > SHOWN * np.abs(whole).max():
            return False
        felt = True
    return felt and not (pool.felt[k] & ~pool.felt[j]).any()
