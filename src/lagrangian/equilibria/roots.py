"""Finds roots of h(q) = 0 by damped Gauss–Newton steps from many starting points at once, in machine code.

The steps are those of Levenberg and Marquardt, (KᵀK + μ diag KᵀK) s = −Kᵀh with h relative to its own size; see Moré,
The Levenberg–Marquardt algorithm (1978). The starting points are Roberts' additive recurrence (the golden ratio in more
dimensions).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from lagrangian.records import dataclass

Array = NDArray[np.float64]
Forces = Callable[[Array], tuple[Array, Array]]
"""q (N, n) → h (N, m) and K = ∂h/∂q (N, m, n)."""

STEPS = 80
NEAR = 1e-5
"""Below this residual, relative to the size of h, a point is polished."""

ENOUGH = 5
"""Every root should be found this number of times."""

EXACT = 1e-11
"""Below this residual, relative to the size of h, a point is a root."""

SAME = 1e-8
"""Roots within this distance, in widths of the box, are the same."""


def starting_points(count: int, low: Array, high: Array, skip: int = 0) -> Array:
    """``count`` points that fill the box evenly, the centre first: shape (count, n)."""
    n = len(low)
    ratio = 2.0
    for _ in range(40):  # x^(n+1) = x + 1
        ratio = (1 + ratio) ** (1 / (n + 1))
    alpha = ratio ** -np.arange(1.0, n + 1)
    k = np.arange(skip, skip + count)[:, None]
    return low + (high - low) * ((0.5 + k * alpha) % 1.0)


@dataclass(frozen=True, eq=False)
class Search:
    """The search in the coordinates ``seek`` of q; the others keep the values of ``base``.

    ``scale`` (m,) is the size of each entry of h, ``width`` (n,) that of the box, and ``turns`` marks the coordinates
    that are periodic with a whole turn. ``last``: of equally simple roots of a family that of the greatest last
    coordinate is taken, which for a quaternion is the one that is not turned; otherwise that of the greatest first.
    """

    forces: Forces
    base: Array
    seek: NDArray[np.int64]
    scale: Array
    width: Array
    turns: NDArray[np.bool_]
    last: bool = False

    def residual(self, q: Array) -> Array:
        """The largest entry of h relative to its size, for every q (N, n)."""
        h, _ = self.forces(q)
        return np.abs(h / self.scale).max(axis=1, initial=0.0)

    def descend(self, q: Array) -> Array:
        """The end of the iteration from every starting point: (N, n)."""
        q = q.copy()
        damping = np.full(len(q), 1e-2)
        h, K = self._scaled(q)
        cost = (h**2).sum(axis=1)
        for _ in range(STEPS):
            # one damped step from every point at once; points that improve move and reduce their damping
            trial = q.copy()
            trial[:, self.seek] += self._step(h, K, damping) * self.width[self.seek]
            h2, K2 = self._scaled(trial)
            cost2 = (h2**2).sum(axis=1)
            better = cost2 < cost
            q[better], h[better], K[better], cost[better] = trial[better], h2[better], K2[better], cost2[better]
            damping = np.where(better, np.maximum(damping / 5, 1e-14), np.minimum(damping * 4, 1e8))
            if (np.sqrt(cost) < EXACT).all():
                break
        return q

    def _scaled(self, q: Array) -> tuple[Array, Array]:
        """h and ∂h/∂q, relative to the size of h and the width of the box, for the coordinates that are sought."""
        h, K = self.forces(q)
        return h / self.scale, (K / self.scale[:, None] * self.width)[:, :, self.seek]

    @staticmethod
    def _step(h: Array, K: Array, damping: Array) -> Array:
        # normal equations (KᵀK + μ diag KᵀK) s = −Kᵀh, with a floor for vanishing columns
        square = np.einsum("sij,sik->sjk", K, K)
        diagonal = np.einsum("sjj->sj", square)
        floor = 1e-12 * diagonal.max(axis=1, initial=0.0)[:, None] + 1e-300
        n = square.shape[1]
        square[:, np.arange(n), np.arange(n)] += damping[:, None] * np.maximum(diagonal, floor) + floor
        step = np.linalg.solve(square, -np.einsum("sij,si->sj", K, h)[..., None])[..., 0]
        return np.clip(step, -0.25, 0.25)

    def polish(self, q: Array) -> Array:
        """Undamped Gauss–Newton steps of minimal length, as long as they reduce the residual: shape (N, n)."""
        q = q.copy()
        h, K = self._scaled(q)
        for _ in range(12):
            step = -np.einsum("sjk,sk->sj", np.linalg.pinv(K, rcond=1e-9), h)
            trial = q.copy()
            trial[:, self.seek] += np.clip(step, -0.05, 0.05) * self.width[self.seek]
            h2, K2 = self._scaled(trial)
            better = np.abs(h2).max(axis=1, initial=0.0) < np.abs(h).max(axis=1, initial=0.0)
            if not better.any():
                break
            q[better], h[better], K[better] = trial[better], h2[better], K2[better]
        return q

    def roots(self, q: Array) -> Array:
        """The roots that were reached, a row for each successful start, with whole turns subtracted."""
        q = self.descend(q)
        q = q[self.residual(q) < NEAR]
        if not len(q):
            return q
        q = self.polish(q)
        return self.wrapped(q[self.residual(q) < EXACT])

    def wrapped(self, q: Array) -> Array:
        """Angles with whole turns subtracted: (−π, π], where −π to within rounding becomes π."""
        angle = np.pi - (np.pi - q) % (2 * np.pi)
        angle = np.where(angle < -np.pi + SAME, angle + 2 * np.pi, angle)
        return np.where(self.turns, angle, q)

    def distance(self, a: Array, b: Array) -> Array:
        """The distance of roots in widths of the box; the shorter way round for periodic coordinates."""
        apart = np.abs(a - b)
        apart = np.where(self.turns, np.minimum(apart, 2 * np.pi - apart), apart)
        return (apart / self.width).max(axis=-1, initial=0.0)

    def singular(self, q: Array) -> tuple[Array, Array]:
        """Singular values (falling) and right vectors (rows, in widths of the box) of K at one root."""
        _, K = self._scaled(q[None])
        _, values, rows = np.linalg.svd(K[0])
        full = np.zeros(len(self.seek))
        full[: len(values)] = values
        return full, rows


def distinct(search: Search, found: Array) -> tuple[Array, NDArray[np.int64]]:
    """The distinct roots, the most accurate of each, and how many starts led to it."""
    kept: list[Array] = []
    counts: list[int] = []
    left = found[np.argsort(search.residual(found), kind="stable")] if len(found) else found
    while len(left):
        near = search.distance(left, left[0]) <= SAME
        kept.append(left[0])
        counts.append(int(near.sum()))
        left = left[~near]
    return np.array(kept).reshape(-1, found.shape[1]), np.array(counts, np.int64)
