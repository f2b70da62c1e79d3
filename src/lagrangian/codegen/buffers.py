"""Memory that machine code reads and writes: aligned blocks, and the stage of a call for one state."""

from __future__ import annotations

import ctypes
import struct
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from operator import itemgetter, setitem
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from lagrangian.records import dataclass

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

    ``owner`` keeps the code in memory; ``call`` takes an address and a number of rows.
    """

    def __init__(self, address: int, owner: object) -> None:
        self.address, self._owner = address, owner
        self.call: Callable[[int, int], int] = _LOOK(address)

    def __call__(self, rows: NDArray[np.float64]) -> int:
        """Call it with rows (..., n) in C order, of which there is at least one."""
        return self.call(address(rows), rows.size // rows.shape[-1])


class Slot:
    """The position of a group of inputs in a call, and the values that are accepted there."""

    __slots__ = (
        "address", "default", "only", "pack", "pick", "place", "places", "put", "scalar", "shape", "size", "spelled",
        "values",
    )  # fmt: skip

    def __init__(self, place: int, group: InputGroup) -> None:
        self.place, self.size, self.scalar, self.values = place, len(group.entries), group.scalar, group.defaults
        self.shape = (self.size,)
        self.places: dict[Any, int] = {name: k for k, name in enumerate(group.entries)}
        self.pick = _picking(group.entries)
        self.spelled: tuple[tuple[Any, ...] | None, Callable[[Any], Any]] = None, tuple
        self.only = group.entries[0] if self.size == 1 else None
        numbers = struct.Struct(f"{self.size}d")
        self.pack = numbers.pack
        self.put: Callable[..., None] = setitem if self.size == 1 else numbers.pack_into
        self.default: NDArray[np.float64] | None = None if None in group.defaults else np.array(group.defaults, float)
        self.address = None if self.default is None else address(self.default)

    def one(self, given: Any) -> Sequence[float] | None:
        """`plain`, sooner if the group has one entry, a float by its name; that one may also be given alone."""
        if type(given) is float:
            return (given,)
        if type(given) is dict and len(given) == 1 and type(number := given.get(self.only)) is float:
            return (number,)
        return self.plain(given)

    def plain(self, given: Any) -> Sequence[float] | None:
        """The numbers in a list or a mapping, one for each entry; None if they need a closer look."""
        kind = type(given)
        if kind is dict:
            if len(given) == self.size:
                keys, order = self.spelled
                if keys is not None and next(iter(given)) is keys[0] and tuple(given) == keys:
                    given = order(tuple(given.values()))
                else:
                    try:
                        given = self.pick(given)
                    except KeyError:  # the keys are symbols, or there is an unknown entry instead of this one
                        given = self._spelled(given)
            else:
                given = self._filled(given)
            if given is None:
                return None
        elif (kind is not list and kind is not tuple) or len(given) != self.size:
            return None
        for number in given:
            if type(number) is not float and type(number) not in PLAIN:  # the first is quicker
                return None
        return given

    def _spelled(self, given: Mapping[Any, Any]) -> Sequence[Any] | None:
        """The values of a mapping for all entries whose keys are not their names; they are known from then on."""
        filled = self._filled(given)
        places = [self.places.get(key) for key in given]
        if filled is not None and len(set(places)) == self.size:
            order = itemgetter(*map(places.index, range(self.size))) if self.size > 1 else tuple
            self.spelled = tuple(given), order  # together, as another thread may read them
        return filled

    def _filled(self, given: Mapping[Any, Any]) -> list[Any] | None:
        """The values of a mapping, completed by the defaults; None if one of the names is unknown."""
        filled: list[Any] = list(self.values)
        for name, value in given.items():
            place = self.places.get(name)
            if place is None:
                return None
            filled[place] = value
        return filled


def _picking(names: Sequence[str]) -> Callable[[Any], Sequence[Any]]:
    """A function that takes the values of all names out of a mapping, in order."""
    if len(names) == 1:
        return lambda given, only=names[0]: (given[only],)
    return itemgetter(*names) if names else tuple


Row: TypeAlias = tuple[Slot, NDArray[np.float64], int]
"""A group of inputs, the array in which a stage holds one row of it, and the address of this array."""

Part: TypeAlias = tuple[int, Any, Any, Callable[[Any], Sequence[float] | None] | None, Callable[..., None]]
"""A group of inputs for one state: its position, a `memoryview` of the doubles to write, the default (None: a value
must be given), `Slot.plain` (None for time, a single number), and a function that writes numbers to the view."""


class Stage:
    """The blocks for one call with one state, and the table of their addresses that is passed to machine code.

    ``own`` is a shared block for parameters that are passed with a state: those with the bytes ``key``. ``parts`` are
    written before a call. ``reads`` are the outputs: names, and functions that return new copies; ``first`` is that of
    the first.
    """

    def __init__(self, sizes: Sizes, slots: Sequence[Slot], shapes: Mapping[str, tuple[int, ...]]) -> None:
        block, self.hoisted, self.own = aligned(sum(sizes.groups)), aligned(sum(sizes.hoisted)), aligned(sizes.shared)
        self.out, self.scratch = aligned(sum(sizes.outputs)), aligned(sizes.scratch)
        places = (block, None, self.out, self.scratch, self.hoisted, self.own, None)
        self.table = (ctypes.c_void_p * 7)(*(None if array is None else address(array) for array in places))
        self.where = ctypes.c_void_p(ctypes.addressof(self.table))
        self.shared: NDArray[np.float64] | None = None
        self.key: bytes | None = None
        self.look: Look | None = None
        self.rows: list[Row] = []
        self.parts: list[Part] = []
        start = 0
        for slot in slots:
            part = block[start : start + slot.size]
            self.rows.append((slot, part, self.table[0] + 8 * start))
            plain = None if slot.scalar else slot.plain if slot.only is None else slot.one
            default = slot.values[0] if slot.scalar else slot.default
            self.parts.append((slot.place, part.data, default, plain, slot.put))
            start += slot.size
        self.reads: list[tuple[str, Callable[[], Any]]] = []
        start = 0
        for size, (name, shape) in zip(sizes.outputs, shapes.items(), strict=True):
            result = self.out[start : start + size].reshape(shape)
            self.reads.append((name, result.copy if shape else partial(result.__getitem__, ())))
            start += size
        self.first: Callable[[], Any] = self.reads[0][1] if self.reads else dict

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
