"""Floating frames in the search for equilibria: h has fewer entries than q, and each quaternion e has length 1.

    h(q) = 0,  |e|² − 1 = 0        with the slopes ∂h/∂q, 2eᵀ

h depends on the direction of e alone, so that these slopes are independent where those of h along the velocities are.
e and −e are the same orientation; of the two that one is shown whose last entry that is not 0 is positive.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lagrangian.errors import RunError
from lagrangian.model import Model
from lagrangian.records import dataclass

Array = NDArray[np.float64]

SIDE = 1.25
"""Half the side of the box of an entry of a quaternion: a little more than the largest there is."""

NOTHING = 1e-9
"""An entry of a quaternion below this is 0 when its sign is chosen."""


@dataclass(frozen=True)
class SoughtOrientations:
    """The first of the four places of every quaternion in q, and the number of velocities."""

    places: tuple[int, ...] = ()
    velocities: int = 0

    @classmethod
    def of(cls, model: Model) -> SoughtOrientations:
        """Those of a model; raises `RunError` for floating frames beside circuits."""
        names = [c.name for c in model.coordinates]
        floating = [f.floating for f in model.floating if f.floating is not None]
        if floating and model.charges:
            raise RunError(
                f"system '{model.name}' has a floating frame beside charges: its equilibria are not sought",
                fix="describe its orientation by three angles instead (frames about axes)",
                code="E202",
            )
        return cls(tuple(names.index(f.orientation[0].name) for f in floating), len(model.velocities))

    def __bool__(self) -> bool:
        return bool(self.places)

    @property
    def entries(self) -> tuple[int, ...]:
        """The places of all entries of quaternions."""
        return tuple(at + k for at in self.places for k in range(4))

    def resting(self, q: Array) -> Array:
        """The velocities 0 for positions (…, n)."""
        return np.zeros((*np.shape(q)[:-1], self.velocities))

    def with_lengths(self, q: Array, h: Array, K: Array) -> tuple[Array, Array]:
        """h (N, m) and K (N, m, n) with a row for the length of each quaternion."""
        rows, slopes = [], []
        for at in self.places:
            e = q[:, at : at + 4]
            rows.append((e**2).sum(axis=1) - 1)
            slope = np.zeros(q.shape)
            slope[:, at : at + 4] = 2 * e
            slopes.append(slope)
        return np.concatenate([h, np.array(rows).T], axis=1), np.concatenate([K, np.stack(slopes, axis=1)], axis=1)

    def signed(self, q: Array) -> Array:
        """Positions (N, n) with the signs of quaternions that are shown."""
        q = q.copy()
        for at in self.places:
            e = q[:, at : at + 4]
            big = np.abs(e) > NOTHING
            last = np.where(big.any(axis=1), 3 - np.argmax(big[:, ::-1], axis=1), 3)
            negative = e[np.arange(len(e)), last] < 0
            q[negative, at : at + 4] *= -1
        return q

    def widths(self, width: Array) -> Array:
        """The sizes of changes along the velocities, from those of the coordinates: 1 for a turn."""
        if not self.places:
            return width
        found: list[float] = []
        i = 0
        while i < len(width):
            turns = i in self.places
            found += [1.0, 1.0, 1.0] if turns else [float(width[i])]
            i += 4 if turns else 1
        return np.array(found)
