"""Memory that machine code reads and writes: aligned blocks, and the stage of a call for one state."""

from __future__ import annotations

import ctypes
import struct
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from operator import itemgetter
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from .arguments import FLOAT, PLAIN, InputGroup
from .sizes import Sizes


@dataclass(frozen=True)
class RawFunction:
    """The function of a tape for callers in machine code: ``void f(double *in, double *shared, double *out, double
    *scratch)``.

    ``in``, ``out`` and ``scratch`` hold ``lanes`` doubles per slot, one for each system; ``shared`` holds one. Blocks
    are aligned to ``8 lanes`` bytes and do not overlap. ``in`` contains the groups that are not hoisted, one after
    another; ``out`` contains the outputs. The other fields are numbers of slots. ``owner`` keeps the code in memory.
    """

    address: int
    lanes: int
    inputs: int
    shared: int
    outputs: int
    scratch: int
    owner: object


class Look:
    """A function ``i64 look(ptr rows, i64 count)`` in machine code that returns 0, or `DOUBTFUL` if values need a
    closer look.

    ``owner`` keeps the code in memory.
    """

    def __init__(self, address: int, owner: object) -> None:
        self.address, self._owner, self._call = address, owner, _LOOK(address)

    def __call__(self, rows: NDArray[np.float64]) -> int:
        """Call it with rows (k, n), k > 0, in C order."""
        return self._call(address(rows), len(rows))


class Slot:
    """The position of a group of inputs in a call, and the values that are accepted there."""

    __slots__ = ("address", "default", "pack", "pick", "place", "places", "scalar", "shape", "size", "values")

    def __init__(self, place: int, group: InputGroup) -> None:
        self.place, self.size, self.scalar, self.values = place, len(group.entries), group.scalar, group.defaults
        self.shape = (self.size,)
        self.places = {name: k for k, name in enumerate(group.entries)}
        self.pick = _picking(group.entries)
        self.pack = struct.Struct(f"{self.size}d").pack
        self.default: NDArray[np.float64] | None = None if None in group.defaults else np.array(group.defaults, float)
        self.address = None if self.default is None else address(self.default)

    def plain(self, given: Any) -> Sequence[float] | None:
        """The numbers in a list or a mapping, one for each entry; None if they need a closer look."""
        kind = type(given)
        if kind is dict and len(given) == self.size:
            try:
                given = self.pick(given)
            except KeyError:  # there is an unknown entry instead of this one
                return None
        elif kind is dict:
            filled: list[Any] = list(self.values)
            for name, value in given.items():
                place = self.places.get(name)
                if place is None:
                    return None
                filled[place] = value
            given = filled
        elif kind is not list and kind is not tuple:
            return None
        if len(given) != self.size:
            return None
        for number in given:
            if type(number) not in PLAIN:
                return None
        return given


def _picking(names: Sequence[str]) -> Callable[[Any], Sequence[Any]]:
    """A function that takes the values of all names out of a mapping, in order."""
    if len(names) == 1:
        (only,) = names
        return lambda given: (given[only],)
    return itemgetter(*names) if names else tuple


Row: TypeAlias = tuple[Slot, NDArray[np.float64], int]
"""A group of inputs, the array in which a stage holds one row of it, and the address of this array."""


class Stage:
    """The blocks for one call with one state, and the table of their addresses that is passed to machine code.

    ``own`` is a shared block for parameters that are passed with a state: those with the bytes ``key``. ``parts`` are
    written before a call: position, array, shape (None for a single number), default (None: a value must be given;
    `NOTHING`: no numbers at all), `Slot.plain`. ``reads`` return new copies of the outputs.
    """

    def __init__(self, sizes: Sizes, slots: Sequence[Slot], shapes: Sequence[tuple[int, ...]]) -> None:
        block, self.hoisted, self.own = aligned(sum(sizes.groups)), aligned(sum(sizes.hoisted)), aligned(sizes.shared)
        self.out, self.scratch = aligned(sum(sizes.outputs)), aligned(sizes.scratch)
        places = (block, None, self.out, self.scratch, self.hoisted, self.own, None)
        self.table = (ctypes.c_void_p * 7)(*(None if array is None else address(array) for array in places))
        self.where = ctypes.c_void_p(ctypes.addressof(self.table))
        self.shared: NDArray[np.float64] | None = None
        self.key: bytes | None = None
        self.look: Look | None = None
        self.rows: list[Row] = []
        self.parts: list[tuple[int, NDArray[np.float64], tuple[int] | None, NDArray[np.float64] | None, Any]] = []
        start = 0
        for slot in slots:
            part = block[start : start + slot.size]
            shape = None if slot.scalar else slot.shape
            self.rows.append((slot, part, self.table[0] + 8 * start))
            self.parts.append((slot.place, part, shape, slot.default if slot.size else NOTHING, slot.plain))
            start += slot.size
        self.reads: list[Callable[[], Any]] = []
        start = 0
        for size, shape in zip(sizes.outputs, shapes, strict=True):
            result = self.out[start : start + size].reshape(shape)
            self.reads.append(result.copy if shape else partial(result.__getitem__, ()))
            start += size

    def share(self, shared: NDArray[np.float64]) -> None:
        """Set the address of the shared block in the table."""
        self.shared, self.table[1] = shared, address(shared)

    def ask(self, look: Look) -> None:
        """Let machine code examine hoisted values from now on."""
        self.look, self.table[6] = look, look.address


def aligned(count: int) -> NDArray[np.float64]:
    """Uninitialized doubles that start at a multiple of 64 bytes."""
    raw = np.empty(8 * count + 64, np.uint8)
    start = -address(raw) % 64
    return raw[start : start + 8 * count].view(FLOAT)


def address(array: NDArray[Any]) -> int:
    """The address of an array's first element."""
    try:
        return ctypes.addressof(_CHARACTER(array))  # a quarter of the time of the other method
    except (TypeError, ValueError):  # read-only, strided, or empty
        return array.__array_interface__["data"][0]


_CHARACTER: Any = ctypes.c_char.from_buffer
_LOOK = ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_void_p, ctypes.c_int64)
NOTHING = np.empty(0)
