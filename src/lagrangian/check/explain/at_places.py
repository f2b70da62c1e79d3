"""Compares values of all motions at one position with each other: whether one is a multiple of the other there."""

from __future__ import annotations

import numpy as np

from lagrangian.derive.sampling import Array

NEAR = 1e-9
"""The relative size of what is rounding."""


def changes(values: Array) -> bool:
    """Whether values (places, motions) are not the same for all motions at a place."""
    return bool((np.ptp(values, axis=1) > NEAR * np.abs(values).max(axis=1)).all())


def proportional_at_places(a: Array, b: Array) -> bool:
    """Whether values (places, motions) are multiples of others at every place."""
    scale = np.linalg.norm(a, axis=1) * np.linalg.norm(b, axis=1)
    return bool((np.abs(np.abs((a * b).sum(axis=1)) - scale) <= NEAR * scale).all())
