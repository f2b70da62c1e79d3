"""Whether an answer's multipliers are those of the system in a scale of the answer's own.

A scale depends on the position and on what the constraint is made of, such as the radius of what rolls. One that
changes with masses or moments of inertia is none: the name, which no other line has, takes up a wrong inertia there.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lagrangian.check.constraints.answer_on_rows import AnswerAt, Array
from lagrangian.check.constraints.determined import SMALL

ROUGH = 1e-6
"""The relative size of a difference of multipliers that is more than rounding."""


def solved(place: AnswerAt) -> Array:
    """The answer's multipliers at a state."""
    return np.asarray(np.linalg.lstsq(place.by_multiplier, -place.value, rcond=1e-10)[0], float)


def are_scaled(found: Sequence[AnswerAt], heavier: Sequence[AnswerAt]) -> bool | None:
    """Whether the answer's multipliers are those of the system times what depends on the position alone, where the
    answer is ``found`` at several motions from one position; None if that cannot be decided there.

    With other inertias, ``heavier``, a multiplier that only one line has must keep its scale.
    """
    own, right = _multipliers(found)
    if len(found) <= right.shape[1] + 1 or not (np.isfinite(own).all() and np.isfinite(right).all()):
        return None
    scales = np.linalg.lstsq(right, own, rcond=1e-10)[0]
    if not _fit(own, right @ scales):
        return False
    sizes = np.abs(own).max(axis=0), np.abs(right).max(axis=0)
    if min(sizes[0]) <= SMALL * max(sizes[1]) < min(sizes[1]):
        return False  # no force at all, where every constraint has one
    alone = np.flatnonzero(np.count_nonzero(np.any([p.by_multiplier != 0 for p in found], axis=0), axis=0) == 1)
    if not len(heavier) or not len(alone) or np.linalg.matrix_rank(right, tol=1e-8) < right.shape[1]:
        return True
    own, right = _multipliers(heavier)
    if not (np.isfinite(own).all() and np.isfinite(right).all()):
        return True
    return _fit(own[:, alone], (right @ scales)[:, alone])


def _multipliers(places: Sequence[AnswerAt]) -> tuple[Array, Array]:
    """The answer's multipliers and those of the system, a row for each motion."""
    return np.array([solved(p) for p in places]), np.array([p.multipliers for p in places])


def _fit(own: Array, right: Array) -> bool:
    """Whether there is no difference but rounding."""
    return bool(np.abs(own - right).max() <= ROUGH * np.abs(own).max())
