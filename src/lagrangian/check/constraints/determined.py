"""How many accelerations true equations determine, together with the constraints."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lagrangian.check.constraints.answer_on_rows import AnswerAt, Array

SMALL = 1e-9
"""The relative size below which a difference is rounding."""


def accelerations_determined(places: Sequence[AnswerAt]) -> int:
    """The largest number of accelerations that the answer and the constraints determine at a place.

    The answer's multipliers are unknowns beside them.
    """
    ranks: list[int] = []
    for p in places:
        m = p.by_multiplier.shape[1]
        whole = np.vstack(
            [np.hstack([p.by_acceleration, p.by_multiplier]), np.hstack([p.rows, np.zeros((len(p.rows), m))])]
        )
        size = np.abs(whole).max(axis=1, keepdims=True)
        ranks.append(int(np.linalg.matrix_rank(whole / np.where(size > 0, size, 1.0), tol=1e-8)) - m)
    return max(ranks)


def in_span(slope: Array, rows: Array) -> bool:
    """Whether a slope is a combination of the rows of the constraints."""
    left = slope - rows.T @ np.linalg.lstsq(rows.T, slope, rcond=1e-10)[0]
    return bool(np.abs(left).max() <= SMALL * np.abs(slope).max())


def of_lines(place: AnswerAt, rows: slice | Sequence[int], columns: Sequence[int]) -> AnswerAt:
    """Some lines at a state, with some of the multipliers."""
    chosen = rows if isinstance(rows, slice) else list(rows)
    return replace(
        place,
        value=place.value[chosen],
        by_acceleration=place.by_acceleration[chosen],
        by_multiplier=place.by_multiplier[chosen][:, list(columns)],
        size=place.size[chosen],
    )


def ends_right(places: Sequence[AnswerAt], true: Sequence[bool], count: int) -> bool:
    """Whether the lines behind the last untrue one that accelerates determine all ``count`` accelerations."""
    moving = np.any([np.abs(p.by_acceleration).max(axis=1, initial=0.0) > 0 for p in places], axis=0)
    wrong = [j for j, holds in enumerate(true) if not holds and moving[j]]
    first = wrong[-1] + 1 if wrong else 0
    rows = [j for j in range(first, len(true)) if true[j]]
    if not rows:
        return False
    chosen = [_chosen(p, rows) for p in places]
    return accelerations_determined(chosen) >= count


def _chosen(place: AnswerAt, rows: Sequence[int]) -> AnswerAt:
    """Some lines with the multipliers that they hold."""
    held = np.flatnonzero(np.abs(place.by_multiplier[list(rows)]).max(axis=0, initial=0.0) > 0)
    return of_lines(place, rows, held.tolist())
