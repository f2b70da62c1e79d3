"""Converts the arguments of a kernel to arrays that it can read, or raises an error with a remedy.

A *group* of inputs (``q``, ``v``, ``u``, ``p``, ``t``) is an array of shape ``(..., n)`` with the entries in declared
order, or a mapping from entry names to numbers or arrays of shape ``(...)``. The group of time, ``t``, is a number or
an array of shape ``(...)``.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.errors import RunError, did_you_mean
from lagrangian.quantities.largest import SMALLER, too_large
from lagrangian.records import dataclass

FLOAT = np.dtype(np.float64)
NOUNS = {"q": "coordinate", "v": "velocity", "a": "acceleration", "x": "state", "p": "parameter"}
PLAIN = frozenset((float, int, np.float64))  # neither booleans nor text
SHOWN = 12  # the number of names that a message lists before "…"


def is_scalar(group: str, entries: Sequence[str]) -> bool:
    """Whether the arrays of a group have the shape (...) of the states, without an axis for entries: only time does."""
    return group == "t" and len(entries) == 1


@dataclass(frozen=True)
class InputGroup:
    """A group of inputs: its name, its entries, and their default values (None: a value must be given)."""

    name: str
    entries: tuple[str, ...]
    defaults: tuple[float | None, ...]

    @property
    def scalar(self) -> bool:
        """Whether arrays of this group have no axis for entries, as for time."""
        return is_scalar(self.name, self.entries)

    @property
    def noun(self) -> str:
        """The word for an entry in a message."""
        return NOUNS.get(self.name, "input")

    def array(self, given: Any) -> NDArray[np.float64]:
        """Return ``given`` as an array of shape ``(..., n)``."""
        if given is None:
            return self._standard
        if isinstance(given, Mapping):
            return self._filled(given)
        array = numbers(given, f"'{self.name}'")
        if self.scalar:
            return array[..., np.newaxis]
        size = len(self.entries)
        if array.ndim == 0 and size == 1:
            return array.reshape(1)
        if array.ndim == 0 or array.shape[-1] != size:
            found = "is a single number" if array.ndim == 0 else f"has {array.shape[-1]} values (shape {array.shape})"
            raise RunError(
                f"{self.name} {found}, but needs {size}: {listed(self.entries)}",
                code="E501",
                fix=f"give an array of shape (..., {size}), entries in that order",
            )
        return array

    @cached_property
    def _standard(self) -> NDArray[np.float64]:
        """The array of the defaults, made once."""
        made = self._filled({})
        made.flags.writeable = False
        return made

    def _filled(self, given: Mapping[Any, Any]) -> NDArray[np.float64]:
        """The array of a mapping, completed by the defaults."""
        named = {str(name): value for name, value in given.items()}
        for name in named:
            if name not in self.entries:
                hint = did_you_mean(name, self.entries) or f"known: {listed(self.entries)}"
                raise RunError(f"unknown {self.noun} '{name}'", code="E402", fix=hint)
        values = [named.get(name, default) for name, default in zip(self.entries, self.defaults, strict=True)]
        missing = [name for name, value in zip(self.entries, values, strict=True) if value is None]
        if missing:
            raise RunError(
                f"{self.noun} '{missing[0]}' has no value. Missing: {', '.join(missing)}",
                code="E401",
                fix=f"give {self.name} = {{'{missing[0]}': …}}",
            )
        if not values:
            return np.empty(0)
        arrays = [numbers(value, f"{self.noun} '{name}'") for name, value in zip(self.entries, values, strict=True)]
        try:
            return np.stack(np.broadcast_arrays(*arrays), axis=-1)
        except ValueError as cause:
            shapes = ", ".join(f"'{n}': {a.shape}" for n, a in zip(self.entries, arrays, strict=True) if a.ndim)
            raise RunError(
                f"the arrays in {self.name} do not fit together: {shapes}", code="E501", fix="make their shapes equal"
            ) from cause


def numbers(given: Any, what: str) -> NDArray[np.float64]:
    """Return ``given`` as float64 if nothing is lost: no text, no complex numbers, no masked entries."""
    if type(given) is np.ndarray and given.dtype is FLOAT:
        return given
    try:
        array = np.asarray(given)
    except ValueError as cause:
        raise RunError(f"{what} is ragged: its rows have different lengths", code="E501") from cause
    # nothing can be masked unless numpy.ma is loaded, and loading it takes longer than compiling two links
    if "numpy.ma" in sys.modules and np.ma.is_masked(given):
        raise RunError(f"{what} has masked entries", code="E502", fix="fill them, or leave those states out")
    if array.dtype == object:
        array = _unboxed(array, what)
    if not np.can_cast(array.dtype, FLOAT, "safe"):
        raise RunError(f"{what} must be real numbers (got {array.dtype})", code="E501", fix="convert to float64")
    return np.asarray(array, dtype=FLOAT)


def _unboxed(array: NDArray[Any], what: str) -> NDArray[np.float64]:
    """Convert numbers that NumPy stores as objects (fractions, SymPy numbers, large integers) one by one."""
    for item in array.flat:
        if isinstance(item, str | bytes | complex) or not hasattr(item, "__float__"):
            raise RunError(f"{what} must be real numbers (got {type(item).__name__} {item!r:.40})", code="E501")
    try:
        return array.astype(FLOAT)
    except (TypeError, ValueError, OverflowError) as cause:
        raise RunError(f"{what} must be real numbers: {cause}", code="E501") from cause


def listed(names: tuple[str, ...]) -> str:
    """Names for a message; of many, only the first few."""
    return ", ".join(names[:SHOWN]) + (", …" if len(names) > SHOWN else "")


def rows(array: NDArray[np.float64], lead: tuple[int, ...]) -> NDArray[np.float64]:
    """Return ``array`` of shape (..., n) as (states, n), with the leading shape broadcast; a view if the strides
    allow it."""
    flags = array.flags
    if array.shape[:-1] == lead and flags.c_contiguous and flags.aligned:
        return array if array.ndim == 2 else array.reshape(math.prod(lead), array.shape[-1])
    if array.ndim == 1 and flags.c_contiguous and flags.aligned:  # one row for all states
        return np.ndarray((math.prod(lead), array.shape[0]), FLOAT, array, 0, (0, 8))
    full = np.broadcast_to(array, (*lead, array.shape[-1]))
    if flags.aligned:
        view = _merged(full, len(lead))
        if view is not None:
            return view
    return np.ascontiguousarray(full).reshape(math.prod(lead), array.shape[-1])


def _merged(full: NDArray[np.float64], axes: int) -> NDArray[np.float64] | None:
    """Combine the leading axes into one without copying, if a single stride covers them."""
    count, stride = 1, 0
    for length, step in zip(reversed(full.shape[:axes]), reversed(full.strides[:axes]), strict=True):
        if length == 1:
            continue
        if count > 1 and step != stride * count:
            return None
        if count == 1:
            stride = step
        count *= length
    shape, strides = (count, full.shape[-1]), (stride, full.strides[-1])
    return np.lib.stride_tricks.as_strided(full, shape, strides, writeable=full.flags.writeable)


def where(lead: tuple[int, ...], state: int) -> str:
    """The index of the state for a message; empty for a single state."""
    if not lead:
        return ""
    index = tuple(int(k) for k in np.unravel_index(state, lead))
    return f" at state {index[0] if len(index) == 1 else index}"


def unfit_input(group: InputGroup, row: NDArray[np.float64], at: str, most: float = math.inf) -> RunError | None:
    """The error for the first entry of a row that is NaN, infinite or larger than ``most``, if there is one."""
    if np.isfinite(row).all() and (most == math.inf or within(row, most)):
        return None
    for name, value in zip(group.entries, row, strict=True):
        if not np.isfinite(value):
            return RunError(f"{group.noun} '{name}' is {value}{at}", code="E502", fix="give a finite number")
        if abs(value) > most and (trouble := too_large(value)):
            return RunError(f"{group.noun} '{name}' {trouble}{at}", code="E101", fix=SMALLER)
    return None


def within(array: NDArray[np.float64], most: float) -> bool:
    """Whether all numbers of an array are finite and at most as large as ``most``."""
    return not array.size or (float(array.max()) <= most and float(array.min()) >= -most)
