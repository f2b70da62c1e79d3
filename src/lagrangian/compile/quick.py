"""The quick ways into a kernel: what needs no closer look reaches the machine code with as little Python as can be.

One state, and many states that stand in arrays. Whatever else is handed over is answered by None: the kernel then takes
the way that converts, broadcasts, and explains what is wrong. A call here is as safe as there: every number is
checked, results are new arrays, and several threads may call at once. What is written out in one piece here, or asked
twice in other words, is so for the sake of time.
"""

from __future__ import annotations

import math
import struct
from collections import OrderedDict
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy import ndarray

from .arguments import FLOAT, PLAIN, Group
from .batch import Array, Engine, Shapes
from .driver import Sizes
from .stage import Slot, Stage, address

_WORD = 8  # bytes of a number
_PACKED = {n: struct.Struct(f"{n}q").pack for n in range(1, 64, 3)}
"""Tables as the machine code reads them, by the number of their entries."""


class Quick:
    """The quick ways into one kernel, and what they find ready: stages, parameter sets, machine code.

    ``block`` returns the shared block of one parameter set, where one group is hoisted.
    """

    def __init__(
        self,
        groups: Sequence[Group],
        late: Sequence[int],
        early: Sequence[int],
        outputs: Shapes,
        block: Callable[[Array], Array],
        threads: int | None,
    ) -> None:
        self.stages: list[Stage] = []  # not in use; there is one as soon as there is code for one state
        self.single: Callable[[Any], int] = _absent
        self.parameters: Callable[[Any], int] = _absent
        self.engines: dict[str, Engine] = {}
        self.blocks: OrderedDict[bytes, Array] = OrderedDict()  # shared blocks by the bytes of their parameters
        self.standard: Array | None = None  # the shared block of the default parameters, once used
        self.admit: Callable[[Array], None] | None = None  # looks at hoisted values before they are used; may raise
        self._block, self._threads = block, threads
        # What fills up a call with fewer groups, one more place for where there is no hoisted group, and nothing at all
        # where several groups are hoisted.
        count = len(groups) if len(early) < 2 else -1
        self._missing = {n: (None,) * (count + 1 - n) for n in range(count + 1)}
        self._early_at = early[0] if early else count
        self._early = Slot(early[0], groups[early[0]]) if early else None
        self._late = [Slot(k, groups[k]) for k in late]
        self._lead_at = next((slot.place for slot in self._late if not slot.scalar), count)
        self._outputs = outputs
        self._alone = len(outputs) == 1 and () not in outputs.values()  # one array
        self._sizes = [(shape, _WORD * math.prod(shape)) for shape in outputs.values()]

    def __call__(self, given: tuple[Any, ...]) -> Any:
        """The answer, or None if anything needs a closer look."""
        missing = self._missing.get(len(given))
        if missing is None:
            return None
        given += missing
        first = given[self._lead_at]
        if type(first) is ndarray and first.ndim > 1:
            return self._many(given, first.shape[:-1])
        try:
            stage = self.stages.pop()
        except IndexError:  # none yet, or other threads have them all
            return None
        early, answer = given[self._early_at], None
        shared = self.standard if early is None else self._own(stage, early)
        if shared is not None:
            for place, part, shape, scalar, default, row in stage.parts:
                array = given[place]
                if type(array) is ndarray:
                    if array.shape != shape or scalar or (array.dtype is not FLOAT and array.dtype != FLOAT):
                        break
                    part[...] = array  # a third of the time of part[:]
                elif array is None:
                    if default is None:
                        break
                    if default.size:
                        part[...] = default
                elif scalar:
                    if type(array) not in PLAIN:
                        break
                    part[0] = array
                else:
                    array = row(array)
                    if array is None:
                        break
                    part[...] = array
            else:
                if stage.shared is not shared:
                    stage.share(shared)
                if self.single(stage.where) == 0:
                    answer = stage.results[0].copy() if self._alone else self.answer(stage)
        self.stages.append(stage)
        return answer

    def _own(self, stage: Stage, early: Any) -> Array | None:
        """The stage's own shared block, made of these parameters; None if they need a closer look."""
        slot = self._early
        if slot is None:
            return None
        row = early if type(early) is ndarray else slot.row(early)
        if row is None or row.shape != slot.shape or (row.dtype is not FLOAT and row.dtype != FLOAT):
            return None
        key = row.tobytes()
        if key != stage.key:
            stage.key = None
            stage.hoisted[...] = row
            if self.parameters(stage.where) != 0:
                return None
            if self.admit is not None:
                self.admit(row)
            stage.key = key
        return stage.own

    def stage(self, sizes: Sizes) -> Stage:
        """A stage for one state: one that is not in use, or a new one."""
        try:
            return self.stages.pop()
        except IndexError:
            return Stage(sizes, self._late, tuple(self._outputs.values()))

    def answer(self, stage: Stage) -> Any:
        """The outputs of a stage, copied."""
        answers = [result.copy() if result.ndim else result[()] for result in stage.results]
        return answers[0] if len(answers) == 1 else dict(zip(self._outputs, answers, strict=True))

    def _many(self, given: tuple[Any, ...], lead: tuple[int, ...]) -> Any:
        """Many states in arrays of one leading shape, or with one row for all of them."""
        early, slot = given[self._early_at], self._early
        shared, slots = self.standard, self._late
        engine = self.engines.get("batch")
        if early is not None and slot is not None:
            row = early if type(early) is ndarray else slot.row(early)
            if row is None or (row.dtype is not FLOAT and row.dtype != FLOAT):
                return None
            if row.shape == slot.shape:
                shared = self.blocks.get(row.tobytes())
                if shared is None:
                    shared = self._block(row)
            elif row.shape != lead + slot.shape:
                return None
            else:
                if self.admit is not None:
                    self.admit(row)
                shared, slots = None, [*slots, slot]
                engine = self.engines.get("sweep")
        count = lead[0] if len(lead) == 1 else math.prod(lead)
        if engine is None or (shared is None and slots is self._late) or not count:
            return None
        if count < engine.lanes:
            return self._few(given, lead, count, engine.lanes)
        entries: list[int] = []
        held: list[Array] = []  # what was made here, kept while the machine code reads it
        for slot in slots:
            if not _reads(entries, held, slot, given[slot.place], lead):
                return None
        results = []
        for shape, size in self._sizes:
            made = np.empty(lead + shape)
            results.append(made)
            entries += (address(made), size, _WORD)
        entries.append(0 if shared is None else address(shared))
        pack = _PACKED.get(len(entries))
        if pack is None or engine.run(pack(*entries), count, self._threads) >= 0:
            return None  # something is not finite: where, is for the other way to find
        return results[0] if len(results) == 1 else dict(zip(self._outputs, results, strict=True))

    def _few(self, given: tuple[Any, ...], lead: tuple[int, ...], count: int, lanes: int) -> Any:
        """Fewer states than the machine code computes side by side: the last one fills up."""
        filled: list[Any] = list(given)
        for slot in self._late if self._early is None else [*self._late, self._early]:
            array, size = given[slot.place], () if slot.scalar else slot.shape
            if type(array) is ndarray and array.shape == lead + size and array.dtype == FLOAT:
                filled[slot.place] = made = np.empty((lanes, *size))
                rows = array.reshape(count, *size)
                made[:count], made[count:] = rows, rows[-1]
            elif type(array) is ndarray and array.shape != slot.shape:  # it might fit what is filled up
                return None
        answer = self._many(tuple(filled), (lanes,))
        if answer is None:
            return None
        if type(answer) is ndarray:
            return answer[:count].reshape(lead + answer.shape[1:])
        return {name: array[:count].reshape(lead + array.shape[1:]) for name, array in answer.items()}


def _reads(entries: list[int], held: list[Array], slot: Slot, given: Any, lead: tuple[int, ...]) -> bool:
    """Add a group of inputs to a table: its address, and strides in bytes; False if it needs a closer look."""
    if type(given) is not ndarray:
        if given is None:
            if slot.address is None:
                return False
            entries += (slot.address, 0, _WORD)
            return True
        row = np.array((given,), FLOAT) if slot.scalar and type(given) in PLAIN else slot.row(given)
        if row is None or row.shape != slot.shape:
            return False
        held.append(row)
        entries += (address(row), 0, _WORD)
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


def _absent(_: Any) -> int:
    return 1
