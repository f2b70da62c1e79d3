"""How well least squares determine the unknowns: covariance, and combinations that the data do not determine.

With the Jacobian J of the residuals r in units of their standard deviation, the covariance of the estimate is
(JᵀJ)⁻¹. Columns of J that depend on each other leave combinations of unknowns undetermined: J n = 0. They are found
by singular values of J with columns of length 1, so that no unit matters.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from lagrangian.records import dataclass
from lagrangian.viewed import Brief

Array = NDArray[np.float64]

DEPENDENT = 1e-6
"""Columns whose combination is shorter than this fraction of their length depend on each other."""

NO_INFLUENCE = 1e-9
"""A column counts as 0 if its changes, over a change by its own scale, are below this fraction of a measured column."""

PART = 1e-4
"""Entries of a combination below this fraction of its largest are 0."""


@dataclass(frozen=True)
class Undetermined(Brief):
    """Unknowns that the data do not tell apart: changing them together in these proportions changes no residual.

    ``names`` and ``proportions`` belong together; ``relative`` says that these are relative changes, δz/z, and
    otherwise they are changes in SI units. With a single name the data do not depend on it at all.
    """

    names: tuple[str, ...]
    proportions: tuple[float, ...]
    relative: bool

    def __str__(self) -> str:
        """Return the names and why."""
        if len(self.names) == 1:
            return f"{self.names[0]}, on which the data do not depend"
        shares = " : ".join(f"{x:.4g}" for x in self.proportions)
        kind = "relative changes" if self.relative else "changes"
        return f"{', '.join(self.names)}, as {kind} in the proportion {shares} change nothing"


@dataclass(frozen=True, eq=False)
class Uncertainty:
    """The covariance of the unknowns, which of them are determined, and the combinations that are not."""

    covariance: Array
    determined: NDArray[np.bool_]
    rank: int
    undetermined: tuple[Undetermined, ...]


def uncertainty(J: Array, values: Array, names: Sequence[str], free: NDArray[np.bool_]) -> Uncertainty:
    """What a Jacobian of weighted residuals says of the unknowns; those that are not ``free`` lie on a bound.

    Entries of the covariance that belong to undetermined unknowns are infinite.
    """
    n = len(values)
    scale = np.where(values != 0, np.abs(values), 1.0)
    length = np.linalg.norm(J, axis=0)
    silent = (length * scale <= NO_INFLUENCE * np.sqrt(len(J))) & free
    used = np.flatnonzero(free & ~silent)
    unit = J[:, used] / length[used]
    _, singular, rows = np.linalg.svd(unit, full_matrices=False) if len(used) else (None, np.zeros(0), np.zeros((0, 0)))
    kept = singular > DEPENDENT
    rank = int(kept.sum())
    back = rows[kept] / length[used]
    covariance = np.zeros((n, n))
    covariance[np.ix_(used, used)] = (back.T / singular[kept] ** 2) @ back
    combinations = _combinations(rows[rank:] / (length * scale)[used]) if rank < len(used) else np.zeros((0, len(used)))
    lost = silent.copy()
    told = [Undetermined((names[i],), (1.0,), True) for i in np.flatnonzero(silent).tolist()]
    for row in combinations:
        own = np.flatnonzero(row)
        lost[used[own]] = True
        whole = bool((values[used[own]] != 0).all())
        shares = row[own] if whole else row[own] * scale[used[own]]
        shares = shares / shares[np.argmax(np.abs(shares) > 0)]
        together = tuple(str(names[i]) for i in used[own].tolist())
        told.append(Undetermined(together, tuple(float(x) for x in shares), whole))
    covariance[lost, :] = covariance[:, lost] = np.inf
    return Uncertainty(covariance, ~lost, rank, tuple(told))


def _combinations(rows: Array) -> Array:
    """A basis of the same space whose rows have as few entries as possible: reduced by the largest entries."""
    found, left = rows / np.abs(rows).max(axis=1, keepdims=True), list(range(len(rows)))
    while left:
        sizes = np.abs(found[left])
        r, k = np.unravel_index(int(np.argmax(sizes)), sizes.shape)
        row = left.pop(int(r))
        found[row] /= found[row, k]
        others = np.arange(len(found)) != row
        found[others] -= found[others, k : k + 1] * found[row]
    size = np.abs(found).max(axis=1, initial=0.0, keepdims=True)
    return np.where(np.abs(found) <= PART * size, 0.0, found)
