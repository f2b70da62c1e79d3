"""The quick way into a kernel: arguments that need no closer look reach the machine code with as little Python as
possible.

It handles one state, and many states in arrays. For all other arguments it returns None, and the kernel takes the
general way, which converts, broadcasts, and explains errors. A quick call is as safe as a general one: every number is
checked, results are new arrays, and several threads may call at once. Some code here is long or repeated because that
is faster.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from typing import Any, TypeAlias

import numpy as np
from numpy import ndarray
from numpy.typing import NDArray

from lagrangian.quantities.largest import LARGEST

from .arguments import FLOAT, PLAIN, InputGroup
from .batch import Array, Engine, Shapes
from .buffers import Look, Row, Slot, Stage, address
from .driver import NOT_FINITE
from .sizes import Sizes

Entry: TypeAlias = Callable[[Any], int]
"""A function in machine code that is called with the table of a stage; it returns 0 if everything is finite."""

_WORD = 8  # bytes of a number
_ALL = slice(None)
_SQUARE = LARGEST**2
"""If the squares of numbers add up to at most this, all are finite, and none is larger than `LARGEST`."""
_PACKED = {n: struct.Struct(f"{n}q").pack for n in range(1, 64, 3)}
"""Tables as machine code reads them, by the number of their entries."""


class Quick:
    """The quick way into one kernel, with its stages, shared blocks and machine code.

    ``owner`` keeps the machine code in memory. At most one group is hoisted.
    """

    def __init__(
        self,
        groups: Sequence[InputGroup],
        late: Sequence[int],
        early: Sequence[int],
        outputs: Shapes,
        threads: int | None,
        owner: object,
    ) -> None:
        self.stages: list[Stage] = []  # free
        self.sizes: Sizes | None = None  # whether machine code exists once they are known
        self.single: Entry = absent
        self.both: Entry = absent
        self.parameters: Entry = absent
        self.engines: dict[str, Engine] = {}
        self.standard: Array | None = None  # the shared block of the default parameters, after its first use
        self.admit: Callable[[Array], Look | None] | None = None  # checks hoisted values before their use
        self._threads, self._owner = threads, owner
        self._hoisted_groups = Slot(early[0], groups[early[0]]) if early else None
        self._early_at = early[0] if early else None
        self._state_groups = [Slot(k, groups[k]) for k in late]
        self._lead_at = next((slot.place for slot in self._state_groups if not slot.scalar), None)
        self._outputs = outputs
        self._alone = len(outputs) == 1
        self._sizes = [(shape, _WORD * math.prod(shape)) for shape in outputs.values()]

    def __call__(self, given: Sequence[Any]) -> Any:
        """The result of a call with a value, or None, for each group; None if anything needs a closer look."""
        try:
            stage = self.stages.pop()
        except IndexError:  # there is no machine code yet, or other threads use all stages
            if self.sizes is None:
                return None
            stage = self.stage()
        bad = 1
        try:
            if self._lead_at is not None and type(first := given[self._lead_at]) is ndarray and first.ndim > 1:
                answer = self._many(stage, given, first.shape[:-1])
                self.stages.append(stage)
                return answer
            for place, view, default, plain, put in stage.parts:
                found = given[place]
                if found is None:
                    found = default
                if plain is None:  # time
                    if type(found) not in PLAIN:
                        break
                    view[0] = found
                elif type(found) is ndarray:
                    view[_ALL] = found  # a ValueError unless it is one row of as many doubles
                else:
                    numbers = plain(found)
                    if numbers is None:
                        break
                    put(view, 0, *numbers)
            else:
                early = None if self._early_at is None else given[self._early_at]
                if early is not None:
                    bad = self._own(stage, early, self.single, self.both)
                elif self.standard is not None:
                    if stage.shared is not self.standard:
                        stage.share(self.standard)
                    bad = self.single(stage.where)
        except (ValueError, struct.error):  # or an integer larger than all floats
            bad = 1
        answer = None if bad else stage.first() if self._alone else {name: read() for name, read in stage.reads}
        self.stages.append(stage)
        return answer

    def _own(self, stage: Stage, early: Any, known: Entry, new: Entry) -> int:
        """Call machine code with a stage's own shared block for these parameters; not 0 if they need a closer look.

        ``known`` is called if the block already contains them; otherwise ``new``, which computes it.
        """
        slot = self._hoisted_groups
        assert slot is not None
        if type(early) is ndarray:
            if early.shape != slot.shape or (early.dtype is not FLOAT and early.dtype != FLOAT):
                return NOT_FINITE
            key = early.tobytes()
        else:
            early = slot.plain(early)
            if early is None:
                return NOT_FINITE
            try:
                key = slot.pack(*early)
            except struct.error:  # an integer larger than all floats
                return NOT_FINITE
        if stage.shared is not stage.own:
            stage.share(stage.own)
        if key == stage.key:
            return known(stage.where)
        stage.key = None
        stage.hoisted[...] = early
        bad = new(stage.where)
        if bad & NOT_FINITE:
            return bad
        if self.admit is not None and (bad or stage.look is None):
            look = self.admit(stage.hoisted)
            if look is not None:
                stage.ask(look)
        stage.key = key
        return 0

    def also(self, keys: Mapping[Any, str]) -> None:
        """Let mappings use other keys beside the names of entries."""
        for slot in (*self._state_groups, self._hoisted_groups):
            if slot is not None:
                slot.places.update({key: slot.places[name] for key, name in keys.items() if name in slot.places})

    def stage(self) -> Stage:
        """A stage for one state: a free one, or a new one."""
        try:
            return self.stages.pop()
        except IndexError:
            assert self.sizes is not None
            return Stage(self.sizes, self._state_groups, self._outputs)

    def answer(self, stage: Stage) -> Any:
        """The outputs of a stage, copied."""
        return stage.first() if self._alone else {name: read() for name, read in stage.reads}

    def _many(self, stage: Stage, given: Sequence[Any], lead: tuple[int, ...]) -> Any:
        """Evaluate many states in arrays of one leading shape; an argument may have one row for all states, held in the
        stage."""
        count = lead[0] if len(lead) == 1 else math.prod(lead)
        if not count:
            return None
        slot, rows, engine = self._hoisted_groups, stage.rows, self.engines.get("batch")
        early = None if slot is None else given[slot.place]
        if slot is None or early is None:
            if self.standard is None:
                return None
            if stage.shared is not self.standard:
                stage.share(self.standard)
        elif type(early) is ndarray and early.ndim > 1:
            if early.shape != lead + slot.shape or (early.dtype is not FLOAT and early.dtype != FLOAT):
                return None
            flags, engine, place = early.flags, self.engines.get("sweep"), 0
            if flags.c_contiguous and flags.aligned:
                place = address(early)
            if not self._fit(stage, early, place, count):
                return None
            if place and engine is not None and count >= engine.lanes:
                return self._computed(stage, engine, rows, given, lead, count, (place, _WORD * slot.size, _WORD))
            rows = [*rows, (slot, stage.hoisted, 0)]
        elif self._own(stage, early, _made, self.parameters) != 0:
            return None
        if engine is None:
            return None
        if count >= engine.lanes:
            return self._computed(stage, engine, rows, given, lead, count)
        filled = _filled(rows, given, lead, count, engine.lanes)
        if filled is None:
            return None
        answer = self._computed(stage, engine, rows, filled, (engine.lanes,), engine.lanes)
        if type(answer) is dict:
            return {name: array[:count].reshape(lead + array.shape[1:]) for name, array in answer.items()}
        return None if answer is None else answer[:count].reshape(lead + answer.shape[1:])

    def _fit(self, stage: Stage, early: Array, place: int, count: int) -> bool:
        """Whether no number in many rows of hoisted values is too large or not finite.

        They are checked for admission, too: all by machine code, once there is some, if the rows are packed at an
        address ``place``.
        """
        if place and stage.look is not None and stage.look.call(place, count) == 0:
            return True
        if not np.vdot(early, early) <= _SQUARE:
            return False
        if self.admit is not None:
            look = self.admit(early)
            if look is not None:
                stage.ask(look)
        return True

    def _computed(
        self,
        stage: Stage,
        engine: Engine,
        rows: Sequence[Row],
        given: Sequence[Any],
        lead: tuple[int, ...],
        count: int,
        last: tuple[int, ...] = (),
    ) -> Any:
        """Evaluate at least as many states as lanes; ``last`` is what the table has of a group that follows the
        others."""
        entries: list[int] = []
        try:
            for slot, part, place in rows:
                if not _reads(entries, slot, part, place, given[slot.place], lead):
                    return None
        except OverflowError:  # an integer larger than all floats
            return None
        entries += last
        results = []
        for shape, size in self._sizes:
            made = np.empty(lead + shape)
            results.append(made)
            entries += (address(made), size, _WORD)
        entries.append(stage.table[1] or 0)
        pack = _PACKED.get(len(entries))
        if pack is None or engine.run(pack(*entries), count, self._threads) >= 0:
            return None  # something is not finite: the general way finds out where
        return results[0] if self._alone else dict(zip(self._outputs, results, strict=True))


def _filled(
    rows: Sequence[Row], given: Sequence[Any], lead: tuple[int, ...], count: int, lanes: int
) -> list[Any] | None:
    """Evaluate fewer states than lanes, filled up by repeating the last; None if that is not possible."""
    filled = list(given)
    for slot, _, _ in rows:
        array, size = given[slot.place], () if slot.scalar else slot.shape
        if type(array) is ndarray and array.shape == lead + size and array.dtype == FLOAT:
            filled[slot.place] = array.reshape(count, *size).take(_filling(count, lanes), 0)
        elif type(array) is ndarray and array.shape != slot.shape:  # it might match the filled shape by accident
            return None
    return filled


def _reads(entries: list[int], slot: Slot, part: Array, place: int, given: Any, lead: tuple[int, ...]) -> bool:
    """Add a group of inputs to a table: its address, and strides in bytes; False if it needs a closer look.

    Numbers that are not in an array are written to ``part``, whose address is ``place``.
    """
    if type(given) is not ndarray:
        if given is None:
            if slot.address is None:
                return False
            entries += (slot.address, 0, _WORD)
            return True
        if slot.scalar and type(given) in PLAIN:
            part[0] = given
        else:
            numbers = slot.plain(given)
            if numbers is None:
                return False
            part[...] = numbers
        entries += (place, 0, _WORD)
        return True
    flags, shape = given.flags, given.shape
    if (given.dtype is not FLOAT and given.dtype != FLOAT) or not flags.aligned:
        return False
    if shape == (lead if slot.scalar else lead + slot.shape):
        if flags.c_contiguous:
            entries += (address(given), _WORD * slot.size, _WORD)
        elif len(lead) == 1 and not slot.scalar:
            entries += (address(given), *given.strides)
        else:
            return False
    elif shape == slot.shape and not slot.scalar:  # one row for all states
        entries += (address(given), 0, given.strides[0])
    else:
        return False
    return True


@cache
def _filling(count: int, lanes: int) -> NDArray[np.intp]:
    """The state, among ``count``, for each lane."""
    return np.minimum(np.arange(lanes), count - 1)


def absent(_: Any) -> int:
    """A stand-in for machine code that does not exist yet."""
    return NOT_FINITE


def _made(_: Any) -> int:
    """Do nothing, because everything is done."""
    return 0
