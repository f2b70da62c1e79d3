"""What is drawn of a mechanism as linear equations A v = 0 of its velocities, and what the model moves, A M = 0."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lagrangian.look.holds import Motions
from lagrangian.records import dataclass, field

Array = NDArray[np.float64]

NONE = 1e-7
"""A number is zero below this share of the largest one beside it."""


@dataclass
class Drawn:
    """What is drawn, as rows A of A v = 0: ``rows`` are lists of (slice, block), blocks of shape (rows, columns).

    ``points`` and ``frames`` are the places of their velocities in v, ``ground`` those that do not move.
    """

    motions: Motions
    points: dict[int, slice] = field(default_factory=dict[int, slice])
    frames: dict[int, slice] = field(default_factory=dict[int, slice])
    rows: list[list[tuple[slice, Array]]] = field(default_factory=list[list[tuple[slice, Array]]])
    size: int = 0

    def point(self, k: int) -> slice:
        """The place of a point's velocity."""
        return self._place(self.points, k, self.motions.stage.dimension)

    def frame(self, f: int) -> slice:
        """The place of a frame's angular velocity."""
        return self._place(self.frames, f, 1 if self.motions.stage.dimension == 2 else 3)

    def _place(self, known: dict[int, slice], key: int, width: int) -> slice:
        if key not in known:
            known[key] = slice(self.size, self.size + width)
            self.size += width
        return known[key]

    def say(self, *blocks: tuple[slice, Array]) -> None:
        """Rows Σ block · v[slice] = 0."""
        if blocks and blocks[0][1].size:
            self.rows.append(list(blocks))

    # -- numbers --------------------------------------------------------------------------------------------------

    def matrix(self) -> Array:
        """A (rows, size)."""
        stacked: list[Array] = []
        for blocks in self.rows:
            row = np.zeros((len(blocks[0][1]), self.size))
            for place, block in blocks:
                row[:, place] += block
            stacked.append(row)
        return np.vstack(stacked) if stacked else np.zeros((0, self.size))

    def model(self) -> Array:
        """M (size, n): the velocities for a unit rate of each coordinate."""
        views = self.motions.views
        M = np.zeros((self.size, views.J.shape[-1]))
        for k, place in self.points.items():
            M[place] = views.J[0, k]
        for f, place in self.frames.items():
            M[place] = turning(self.motions, f)
        return M


def turning(motions: Motions, frame: int) -> Array:
    """The angular velocity of a frame for a unit rate of each coordinate: (1, n) in the plane, (3, n) in space."""
    R, RJ = motions.views.R[0, frame], motions.views.RJ[0, frame]
    W = np.einsum("ijn,kj->ikn", RJ, R)
    W = (W - W.swapaxes(0, 1)) / 2  # a quaternion also changes its length
    return W[1:2, 0] if len(R) == 2 else np.array([W[2, 1], W[0, 2], W[1, 0]])


def cross_of(lever: Array) -> Array:
    """The matrix of ω × d as a map of ω: (2, 1) in the plane, (3, 3) in space."""
    if len(lever) == 2:
        return np.array([[-lever[1]], [lever[0]]])
    x, y, z = lever
    return np.array([[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]])


FEW = 24
"""Up to this dimension a singular value decomposition is quickest; LAPACK's uses several threads soon beyond."""


def complement(columns: Array, least: float = 1e-3) -> Array:
    """Orthonormal rows (d − rank, d) at right angles to all columns; those far below ``least`` are zero."""
    if len(columns) > FEW:
        found = _orthonormal(columns, NONE * max(float(np.abs(columns).max(initial=0.0)), least))
        return _orthonormal(np.eye(len(columns)) - found.T @ found, 0.0, len(columns) - len(found))
    left, sizes, _ = np.linalg.svd(columns, full_matrices=columns.shape[1] < len(columns))
    rank = int((sizes > NONE * max(float(sizes.max(initial=0.0)), least)).sum())
    return left[:, rank:].T


def _orthonormal(columns: Array, least: float, most: int | None = None) -> Array:
    """Orthonormal rows that span the columns: the longest of what is left next, until it is not above ``least``."""
    rest, count = columns.copy(), min(columns.shape) if most is None else most
    found = np.zeros((count, len(columns)))
    for k in range(count):
        sizes = np.einsum("dn,dn->n", rest, rest)
        longest = int(np.argmax(sizes))
        if sizes[longest] <= least**2:
            return found[:k]
        e = rest[:, longest] / np.sqrt(sizes[longest])
        e -= (found[:k] @ e) @ found[:k]  # once more, because rounding grows where little is left
        found[k] = e / np.linalg.norm(e)
        rest -= np.outer(found[k], found[k] @ rest)
    return found
