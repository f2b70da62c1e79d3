"""Divides an ensemble into chunks: consecutive runs that also form a box in the ensemble's shape.

With the shape (…, n_a, …, n_last), a chunk contains part of axis a and all of the later axes, for one position along
the earlier axes. So it is both a range of runs and exactly one chunk of an array on disk.
"""

from __future__ import annotations

import math

import numpy as np

from lagrangian.records import dataclass

MEMORY = 256 * 2**20
"""The default limit on the bytes of trajectories in memory."""

FEW, FEWEST, MOST = 128, 256, 1 << 18
"""The approximate smallest number of chunks, the fewest runs for which this is worthwhile, and the most in a chunk."""


@dataclass(frozen=True)
class Portions:
    """The chunks of ``shape``: each is a box of ``block``, smaller at the edges."""

    shape: tuple[int, ...]
    block: tuple[int, ...]

    @property
    def grid(self) -> tuple[int, ...]:
        """The number of chunks along each axis."""
        return tuple(-(-n // b) for n, b in zip(self.shape, self.block, strict=True))

    def __len__(self) -> int:
        return math.prod(self.grid)

    def box(self, index: int) -> tuple[slice, ...]:
        """The position of a chunk's runs in the ensemble's shape."""
        place = np.unravel_index(index, self.grid) if self.grid else ()
        return tuple(
            slice(int(k) * b, min(n, (int(k) + 1) * b)) for k, b, n in zip(place, self.block, self.shape, strict=True)
        )

    def range(self, index: int) -> tuple[int, int]:
        """The index of the first run of a chunk, and the index after its last."""
        box = self.box(index)
        start = 0
        for part, n in zip(box, self.shape, strict=True):
            start = start * n + part.start
        return start, start + math.prod(part.stop - part.start for part in box)


def cut(shape: tuple[int, ...], bytes_per_run: int, *, memory: int = MEMORY, held: int = 1, few: int = FEW) -> Portions:
    """Divide ``shape`` into chunks, so that ``held`` of them together take at most ``memory`` bytes.

    Chunks are small enough that little is lost if the process is killed: a large ensemble has at least about ``few``.
    Results do not depend on the division.
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
