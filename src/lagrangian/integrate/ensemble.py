"""Computes an ensemble of runs, chunk by chunk.

The results do not depend on the chunks, on their order, or on the number of threads, because a run depends only on its
own row of the design.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from lagrangian.advice import Advice, Argument
from lagrangian.errors import RunError
from lagrangian.integrate.chunks import Portions
from lagrangian.integrate.design import Design
from lagrangian.integrate.observe import Study, Values

Progress = Callable[[int, int], None]
"""A callback that receives the number of finished runs and the number of all runs after every chunk."""


class Sink(Protocol):
    """A destination of results: arrays in memory, or a store on disk. ``done`` says which chunks exist already."""

    done: NDArray[np.bool_]

    def write(self, index: int, box: tuple[slice, ...], values: Values) -> None:
        """Store the results of chunk ``index``, whose runs are at ``box``."""
        ...


class Executor(Protocol):
    """Something that computes: it takes chunks from ``portions`` and returns their results in any order."""

    def __call__(self, study: Study, design: Design, portions: Portions, todo: Iterable[int]) -> Iterator[Any]:
        """Yield pairs (chunk, values)."""
        ...


class Memory:
    """A sink that consists of plain arrays over the ensemble's shape."""

    def __init__(self, study: Study, portions: Portions) -> None:
        self.done = np.zeros(len(portions), bool)
        self.arrays: dict[str, NDArray[Any]] = {}
        for name, (dtype, shape) in study.fields().items():
            try:
                self.arrays[name] = np.empty((*portions.shape, *shape), dtype)
            except MemoryError:
                raise RunError(
                    f"the results '{name}' of {np.prod(portions.shape):.0f} runs do not fit in memory",
                    code="E505",
                    fix=Advice("keep less of each run, or write to a store: ", Argument("store", '"sweep.zarr"')),
                ) from None

    def write(self, index: int, box: tuple[slice, ...], values: Values) -> None:
        """Copy the results of a chunk to their place."""
        for name, array in self.arrays.items():
            target = array[(*box, ...)]  # an array even if there are no axes
            target[...] = values[name].reshape(target.shape)
        self.done[index] = True


class Here:
    """Computes chunks one after another in this process, each with ``threads`` threads (by default all cores)."""

    def __init__(self, threads: int | None = None) -> None:
        self.threads = threads

    def __call__(self, study: Study, design: Design, portions: Portions, todo: Iterable[int]) -> Iterator[Any]:
        """Yield pairs (chunk, values), as they are finished."""
        solver = None
        for index in todo:
            solver = solver or solver_of(study, self.threads)
            yield index, study.run(solver, design.rows(*portions.range(index)), self.threads)


def solver_of(study: Study, threads: int | None) -> Any:
    """The solver for a study."""
    from lagrangian.integrate import Solver

    def made() -> Any:
        given = {"events": study.events, "projection": study.projection}
        return Solver(study.program, study.method, threads=threads, **given)

    if study.solver is not None:
        return study.solver
    if study.events is not None:
        return made()
    corrects = None if study.projection is None else study.projection.corrects
    return study.program.remembered(("solver", study.method, threads, corrects), made)


def carry_out(
    study: Study,
    design: Design,
    portions: Portions,
    sink: Sink,
    *,
    executor: Executor | None = None,
    progress: Progress | None = None,
) -> None:
    """Compute every chunk that the sink does not have, and store it as soon as it is finished."""
    todo = np.flatnonzero(~sink.done).tolist()
    finished = sum(stop - start for start, stop in map(portions.range, np.flatnonzero(sink.done).tolist()))
    if progress is not None:
        progress(finished, design.count)
    for index, values in (executor or Here())(study, design, portions, todo):
        sink.write(index, portions.box(index), values)
        finished += len(values["status"])
        if progress is not None:
            progress(finished, design.count)
