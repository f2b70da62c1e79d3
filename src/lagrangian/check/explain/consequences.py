"""Which wrong equations of an answer follow from others above them: the same ones solved, divided or put together.

As many equations as there are coordinates, P = A ξ̈ + b, determine a motion, ξ̈ = −A⁻¹ b, where A is regular. An equation
below that holds for this motion follows from them, whatever was wrong in them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import sympy as sp

from lagrangian.check.reference import Reference
from lagrangian.derive.sampling import Array, CompiledExpressions

MOST_SETS = 12
"""The largest number of sets of equations from which others may follow."""
SMALL = 1e-9
"""The size, relative to the terms of an equation, below which its value is rounding."""
SINGULAR = 1e-9
"""The smallest determinant, relative to the size of the rows, of equations that are solved."""


def follow_from_above(truth: Reference, exprs: Sequence[sp.Expr], wrong: Sequence[int]) -> set[int]:
    """The places of the wrong equations that follow from equations above them."""
    n, accelerations = truth.n, [c.acceleration for c in truth.model.coordinates]
    moving = [j for j, x in enumerate(exprs) if x.has(*accelerations)]
    later = [j for j in wrong if j in moving[n:]]
    if not later:
        return set()
    compiled = CompiledExpressions([exprs[j] for j in moving])
    size = truth.states.size
    A = compiled.slopes(accelerations).at(truth.states).reshape(len(moving), n, size)
    b = compiled.at(truth.states, dict.fromkeys(accelerations, np.zeros(size)))
    found: set[int] = set()
    for rows in _sets(moving, wrong, n):
        motion = _motion(A[rows], b[rows])
        if motion is None:
            continue
        for j in later:
            k = moving.index(j)
            if k > rows[-1] and j not in found and _holds(A[k], b[k], motion):
                found.add(j)
    return found


def _sets(moving: Sequence[int], wrong: Sequence[int], n: int) -> Iterator[list[int]]:
    """Neighbouring equations, as many as there are coordinates, of which at least one is wrong."""
    every = [list(range(k, k + n)) for k in range(len(moving) - n)]
    yield from [rows for rows in every if any(moving[k] in wrong for k in rows)][:MOST_SETS]


def _motion(A: Array, b: Array) -> Array | None:
    """The accelerations (n, S) of equations A ξ̈ + b = 0; None where they determine none."""
    matrices = np.moveaxis(A, -1, 0)
    if not (np.isfinite(A).all() and np.isfinite(b).all()):
        return None
    size = np.linalg.norm(matrices, axis=2).prod(axis=1)
    if (np.abs(np.linalg.det(matrices)) <= SINGULAR * size).any():
        return None
    return np.asarray(np.linalg.solve(matrices, -b.T[:, :, None])[:, :, 0].T, dtype=np.float64)


def _holds(A: Array, b: Array, motion: Array) -> bool:
    """Whether an equation A ξ̈ + b = 0 holds for a motion at every state."""
    terms = A * motion
    scale = np.abs(terms).sum(axis=0) + np.abs(b)
    return bool(np.isfinite(scale).all() and (np.abs(terms.sum(axis=0) + b) <= SMALL * scale).all())
