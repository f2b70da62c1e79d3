"""Memory that machine code reads and writes: aligned blocks, and the stage of a call for one state."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .arguments import FLOAT, Group
from .driver import Sizes


@dataclass(frozen=True)
class RawFunction:
    """A tape's function for callers in machine code: ``void f(double *in, double *shared, double *out, double
    *scratch)``.

    ``in``, ``out`` and ``scratch`` hold ``lanes`` doubles a slot, one system a lane, ``shared`` one; blocks are
    aligned to ``8 lanes`` bytes and do not overlap. ``in`` holds the groups that are not hoisted, one after the
    other; ``out`` the outputs. The other fields count slots. ``owner`` keeps the code in memory.
    """

    address: int
    lanes: int
    inputs: int
    shared: int
    outputs: int
    scratch: int
    owner: object


class Slot:
    """Where a group of inputs stands in a call, and what may stand there."""

    __slots__ = ("address", "default", "place", "row", "scalar", "shape", "size")

    def __init__(self, place: int, group: Group) -> None:
        self.place, self.size, self.scalar, self.row = place, len(group.entries), group.scalar, group.row
        self.shape = (self.size,)
        self.default: NDArray[np.float64] | None = None if None in group.defaults else np.array(group.defaults, float)
        self.address = None if self.default is None else address(self.default)


class Stage:
    """The blocks of one call for one state, and the table of their addresses that the machine code is handed.

    ``own`` is a shared block for parameters that are handed over with a state: those of the bytes ``key``.
    """

    __slots__ = ("hoisted", "key", "out", "own", "parts", "results", "scratch", "shared", "table", "where")

    def __init__(self, sizes: Sizes, slots: Sequence[Slot], shapes: Sequence[tuple[int, ...]]) -> None:
        block, self.hoisted, self.own = aligned(sum(sizes.groups)), aligned(sum(sizes.hoisted)), aligned(sizes.shared)
        self.out, self.scratch = aligned(sum(sizes.outputs)), aligned(sizes.scratch)
        places = (block, None, self.out, self.scratch, self.hoisted, self.own)
        self.table = (ctypes.c_void_p * 6)(*(None if array is None else address(array) for array in places))
        self.where = ctypes.c_void_p(ctypes.addressof(self.table))
        self.shared: NDArray[np.float64] | None = None
        self.key: bytes | None = None
        self.parts: list[tuple[int, NDArray[np.float64], tuple[int], bool, NDArray[np.float64] | None, Any]] = []
        start = 0
        for slot in slots:
            part = block[start : start + slot.size]
            self.parts.append((slot.place, part, slot.shape, slot.scalar, slot.default, slot.row))
            start += slot.size
        self.results: list[NDArray[np.float64]] = []
        start = 0
        for size, shape in zip(sizes.outputs, shapes, strict=True):
            self.results.append(self.out[start : start + size].reshape(shape))
            start += size

    def share(self, shared: NDArray[np.float64]) -> None:
        """Point the table at a shared block."""
        self.shared = shared
        self.table[1] = address(shared)


def aligned(count: int) -> NDArray[np.float64]:
    """Uninitialised doubles that start at a multiple of 64 bytes."""
    raw = np.empty(8 * count + 64, np.uint8)
    start = -address(raw) % 64
    return raw[start : start + 8 * count].view(FLOAT)


def address(array: NDArray[Any]) -> int:
    """Where an array's first element is."""
    try:
        return ctypes.addressof(_CHARACTER(array))  # a quarter of the time of the other way
    except (TypeError, ValueError):  # read-only, strided, or empty
        return array.__array_interface__["data"][0]


_CHARACTER: Any = ctypes.c_char.from_buffer
