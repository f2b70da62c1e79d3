"""Calls for many states: arrays become a table of addresses, cores compute ranges of states, and results are
checked."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.errors import RunError
from lagrangian.quantities.largest import LARGEST
from lagrangian.records import dataclass, field

from . import workers
from .arguments import FLOAT, InputGroup, rows, unfit_input, where
from .buffers import address, aligned

Array = NDArray[np.float64]
Shapes = Mapping[str, tuple[int, ...]]  # outputs by name


@dataclass(frozen=True)
class Engine:
    """One of a program's ``batch`` functions: its groups of inputs in the order of the table, and its requirements."""

    call: Callable[[int | bytes, int, int, int], int]
    groups: tuple[InputGroup, ...]
    outputs: Shapes
    lanes: int
    work: int  # doubles of work space
    cost: int  # approximate number of operations per state
    owner: object  # keeps the code in memory
    spaces: list[tuple[int, Array]] = field(default_factory=list)  # free work areas with their addresses

    def run(self, table: int | bytes, count: int, threads: int | None) -> int:
        """Compute states 0 … count − 1 on a suitable number of cores; return −1, or the index of a state that is not
        finite.

        ``count`` is at least ``lanes``.
        """
        if workers.alone(count, self.cost, threads):
            return self._range(table, 0, count)
        return workers.over(count, self.lanes, self.cost, threads, lambda *ends: self._range(table, *ends))

    def _range(self, table: int | bytes, start: int, stop: int) -> int:
        """Compute states start … stop − 1."""
        try:
            space = self.spaces.pop()
        except IndexError:
            made = aligned(self.work)
            space = address(made), made
        bad = self.call(table, start, stop, space[0])
        self.spaces.append(space)
        return bad


class Batch:
    """A call for the states in certain arrays, after all checks of shapes and types; calling it computes and checks
    values.

    The arrays are read at every call. Without ``out``, each batch has its own results, which its next call overwrites.
    """

    def __init__(
        self,
        engine: Engine,
        given: Sequence[Array],
        lead: tuple[int, ...],
        *,
        shared: Array | None,
        out: Any = None,
        threads: int | None = None,
    ) -> None:
        self._engine, self._lead, self._shared, self._threads = engine, lead, shared, threads
        self._count = math.prod(lead)
        self._finals = dict.fromkeys(engine.outputs) if out is None else targets(engine.outputs, out, lead)
        self._results = [self._home(name, given) for name in engine.outputs]
        self.inputs, self._direct = [rows(a, lead) for a in given], self._results
        if self._count == 0:
            return
        if self._count < engine.lanes:  # machine code needs full lanes: the last state is repeated to fill them
            fill = np.minimum(np.arange(engine.lanes), self._count - 1)
            self.inputs = [a[fill] for a in self.inputs]
            self._direct = [np.empty((engine.lanes, r.shape[1])) for r in self._results]
        entries = [n for a in (*self.inputs, *self._direct) for n in (address(a), *a.strides)]
        self._table = np.array([*entries, 0 if shared is None else address(shared)], np.int64)
        self._at = address(self._table)
        self._views: list[Any] = []  # the returned arrays that are computed in place
        if out is None and self.direct and lead:
            shapes = engine.outputs.values()
            self._views = [r.reshape(*lead, *shape) for r, shape in zip(self._results, shapes, strict=True)]

    @property
    def direct(self) -> bool:
        """Whether the given arrays are read in place, so that a later call sees changes in them."""
        return self._count >= self._engine.lanes

    def _home(self, name: str, given: Sequence[Array]) -> Array:
        """The array in which an output is computed, as (states, size): the target itself if possible."""
        size, final = math.prod(self._engine.outputs[name]), self._finals[name]
        if final is None or not (final.flags.c_contiguous and final.flags.aligned):
            return np.empty((self._count, size))
        if any(np.may_share_memory(final, a) for a in given):
            return np.empty((self._count, size))
        return final.reshape(self._count, size)

    def __call__(self) -> Any:
        """Compute; return the output, or a dict of the outputs. ``out`` is written even if an error is raised."""
        bad = -1
        if self._count:
            engine, count = self._engine, self._count
            whole = max(count, engine.lanes)
            bad = engine.run(self._at, whole, self._threads)
            if self._views and bad < 0:
                return self._views[0] if len(self._views) == 1 else dict(zip(engine.outputs, self._views, strict=True))
            if self._direct is not self._results:
                for result, full in zip(self._results, self._direct, strict=True):
                    result[:] = full[:count]
        made: dict[str, Any] = {}
        for (name, shape), result in zip(self._engine.outputs.items(), self._results, strict=True):
            final = self._finals[name]
            if final is None:
                made[name] = result.reshape(*self._lead, *shape)[()]
                continue
            if not np.may_share_memory(result, final):
                final[...] = result.reshape(*self._lead, *shape)
            made[name] = final
        if bad >= 0:
            raise self._trouble(bad, min(bad + self._engine.lanes, self._count))
        return made.popitem()[1] if len(made) == 1 else made

    def _trouble(self, start: int, stop: int) -> RunError:
        for state in range(start, stop):
            inputs, outputs = [a[state] for a in self.inputs], [r[state] for r in self._direct]
            found = trouble(self._engine.groups, inputs, self._engine.outputs, outputs, where(self._lead, state))
            if found:
                return found
        return RunError(
            "a result was not finite for a moment",
            code="E503",
            fix="do not change the arrays while a call is using them",
        )


def targets(outputs: Shapes, out: Any, lead: tuple[int, ...]) -> dict[str, Array]:
    """The arrays to write to, by output, after checks."""
    named = out if isinstance(out, Mapping) else {next(iter(outputs)): out} if len(outputs) == 1 else {}
    if set(named) != set(outputs):
        raise RunError("out does not fit", code="E501", fix=f"give arrays for {', '.join(outputs)}")
    for name, shape in outputs.items():
        a, wanted = named[name], (*lead, *shape)
        if not isinstance(a, np.ndarray) or a.dtype != FLOAT or a.shape != wanted or not a.flags.writeable:
            found = f"{a.dtype} {a.shape}" if isinstance(a, np.ndarray) else type(a).__name__
            raise RunError(
                f"out for '{name}' must be a writable float64 array of shape {wanted} (got {found})", code="E501"
            )
    return dict(named)


def trouble(
    groups: Sequence[InputGroup], inputs: Sequence[Array], outputs: Shapes, results: Sequence[Array], at: str
) -> RunError | None:
    """The error for the first number of a state that is not finite, inputs first; None if all are finite.

    If a result is not finite, an input that is too large to compute with explains it.
    """
    for group, row in zip(groups, inputs, strict=True):
        if found := unfit_input(group, row, at):
            return found
    for (name, shape), row in zip(outputs.items(), results, strict=True):
        for j in np.flatnonzero(~np.isfinite(row)):
            for group, given in zip(groups, inputs, strict=True):
                if found := unfit_input(group, given, at, LARGEST):
                    return found
            index = [int(i) for i in np.unravel_index(j, shape)] if shape else ""
            return RunError(
                f"output '{name}'{index} is {np.ravel(row)[j]}{at}",
                code="E503",
                fix="the inputs are finite: look for a division by zero or a root of a negative number there",
            )
    return None
