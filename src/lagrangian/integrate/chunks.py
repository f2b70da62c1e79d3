"""An ensemble cut into chunks: consecutive runs that are also a box of the ensemble's shape.

Shape (…, n_a, …, n_last): a chunk holds part of axis a and all of the axes behind it, for one place along the axes
before. It is therefore at once a range of runs and, exactly, one chunk of an array on disk.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

MEMORY = 256 * 2**20
"""Bytes of trajectories that are held at a time unless told otherwise."""

FEW, FEWEST, MOST = 128, 256, 1 << 18
"""About how many chunks there shall be at least, the fewest runs worth a chunk then, and the most in one."""


@dataclass(frozen=True)
class Portions:
    """The chunks of ``shape``: each a box of ``block``, cut at the edges."""

    shape: tuple[int, ...]
    block: tuple[int, ...]

    @property
    def grid(self) -> tuple[int, ...]:
        """How many chunks there are along each axis."""
        return tuple(-(-n // b) for n, b in zip(self.shape, self.block, strict=True))

    def __len__(self) -> int:
        return math.prod(self.grid)

    def box(self, index: int) -> tuple[slice, ...]:
        """Where the runs of a chunk stand in the ensemble's shape."""
        place = np.unravel_index(index, self.grid) if self.grid else ()
        return tuple(
            slice(int(k) * b, min(n, (int(k) + 1) * b)) for k, b, n in zip(place, self.block, self.shape, strict=True)
        )

    def range(self, index: int) -> tuple[int, int]:
        """The first run of a chunk, and the one behind its last."""
        box = self.box(index)
        start = 0
        for part, n in zip(box, self.shape, strict=True):
            start = start * n + part.start
        return start, start + math.prod(part.stop - part.start for part in box)


def cut(shape: tuple[int, ...], bytes_per_run: int, *, memory: int = MEMORY, held: int = 1, few: int = FEW) -> Portions:
    """Chunks of ``shape`` so that ``held`` of them together take at most ``memory`` bytes.

    Chunks are no larger than that a kill loses little: a large ensemble has at least about ``few``. Results do not
    depend on how they are cut.
    """
    count = math.prod(shape)
    fits = max(1, memory // (held * bytes_per_run))
    target = min(fits, MOST, max(FEWEST, -(-count // few)))
    block = [1] * len(shape)
    room = target
    for axis in reversed(range(len(shape))):
        n = shape[axis]
        if n > room:
            block[axis] = -(-n // -(-n // room))  # parts of equal size
            break
        block[axis], room = n, room // n
    return Portions(shape, tuple(block))
