"""Null spaces in a readable form: reduced row echelon form, with the earliest columns leading."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

ZERO_TOLERANCE = 1e-8

NULL_TOLERANCE = 1e-11
"""Singular values up to this, relative to the largest, count as 0."""


def null_space(matrix: Array) -> Array:
    """An orthonormal basis, in rows (k, n), of {c : matrix c = 0}. Singular values are taken relative to the
    largest."""
    n = matrix.shape[1]
    _, values, rows = np.linalg.svd(matrix, full_matrices=True) if matrix.size else (None, np.zeros(0), np.eye(n))
    full = np.zeros(n)
    full[: len(values)] = values
    return rows[full <= NULL_TOLERANCE * max(float(full.max(initial=0.0)), 1e-300)]


def reduced(rows: NDArray[Any]) -> tuple[NDArray[Any], list[int]]:
    """The reduced row echelon form of independent rows and its leading columns; rounding errors are set to 0."""
    rows = rows.copy()
    leading: list[int] = []
    for k in range(rows.shape[1]):
        r = len(leading)
        if r == len(rows):
            break
        best = r + int(np.argmax(np.abs(rows[r:, k])))
        if abs(rows[best, k]) <= ZERO_TOLERANCE * float(np.abs(rows[r:]).max()):
            continue
        rows[[r, best]] = rows[[best, r]]
        rows[r] /= rows[r, k]
        others = np.arange(len(rows)) != r
        rows[others] -= rows[others, k : k + 1] * rows[r]
        leading.append(k)
    size = np.abs(rows).max(axis=1, initial=0.0, keepdims=True)
    return np.where(np.abs(rows) <= ZERO_TOLERANCE * size, 0.0, rows), leading
