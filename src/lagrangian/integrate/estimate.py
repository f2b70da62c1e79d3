"""How long an ensemble takes, and how large its results are: measured on a few of its runs before it begins."""

from __future__ import annotations

import itertools
import time
from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np

from lagrangian.codegen.workers import cores
from lagrangian.errors import RunError
from lagrangian.integrate.design import Design, Rows
from lagrangian.integrate.ensemble import solver_of
from lagrangian.integrate.observe import Study
from lagrangian.records import dataclass

PLACES = 16
"""The number of places in the ensemble at which runs are measured."""

LONG_ENOUGH = 0.5
"""The time [s] that a measurement must take; one that is shorter is repeated with four times as many runs."""

LANES = 8
"""The number of runs for each core in the first measurement: as many as are computed side by side."""


@dataclass(frozen=True)
class SweepEstimate:
    """What a sweep will take.

    ``seconds``: the time for the ``runs`` that are to be computed, without compilation; ``bytes``: the size of all
    results before compression; ``measured``: the number of runs that were simulated to find out; ``threads``: the
    number of cores, those of the workers included.
    """

    runs: int
    seconds: float
    bytes: int
    measured: int
    threads: int

    def __str__(self) -> str:
        """Return ``about 40 min and at most 12 GB for 10000000 runs on 16 cores (measured on 512 runs)``."""
        cores = f"{self.threads} core{'s' if self.threads > 1 else ''}"
        runs = f"{self.runs} run{'s' if self.runs != 1 else ''}"
        return (
            f"about {_duration(self.seconds)} and at most {_size(self.bytes)} for {runs} on {cores} "
            f"(measured on {self.measured} run{'s' if self.measured != 1 else ''})"
        )


Confirm: TypeAlias = Callable[[SweepEstimate], Any]
"""A function that receives the estimate; if it returns False, the sweep is not started."""


class NotStarted(RunError):
    """A sweep was not started, because ``confirm`` returned False; ``estimate`` is what it was asked about."""

    def __init__(self, estimate: SweepEstimate) -> None:
        super().__init__(
            f"the sweep was not started: {estimate}", fix="let confirm return True, or leave it out", code="E501"
        )
        self.estimate = estimate

    def __reduce__(self) -> tuple[Any, ...]:
        return NotStarted, (self.estimate,)


def ask(confirm: Confirm, study: Study, design: Design, runs: int, size: int, executor: Any) -> None:
    """Ask whether to go on with ``runs`` runs of an ensemble whose results have ``size`` bytes.

    Workers on other machines are taken to be as fast as this one. Raises `NotStarted` if the answer is False, and
    `RunError` if it is neither True, nor False, nor None.
    """
    away = getattr(executor, "held", None) is not None
    threads = 1 if away else executor.threads or cores()
    total = executor.threads if away else threads
    per_run, measured = measure(study, design, threads) if runs else (0.0, 0)
    estimate = SweepEstimate(runs, per_run * threads / total * runs, size, measured, total)
    answer = confirm(estimate)
    if answer is None:
        return
    if not isinstance(answer, (bool, np.bool_)):
        raise RunError(
            f"confirm must return True or False, or nothing to go on (got {answer!r:.30})",
            fix="confirm=lambda estimate: estimate.seconds < 3600",
            code="E501",
        )
    if not answer:
        raise NotStarted(estimate)


def measure(study: Study, design: Design, threads: int) -> tuple[float, int]:
    """The time [s] that each run takes if many run on ``threads`` cores, and the number of runs that were measured."""
    solver = solver_of(study, threads)
    count = min(design.count, LANES * threads)
    study.run(solver, some_rows(design, count), threads)  # the first runs also compile what their outputs need
    while True:
        rows = some_rows(design, count)
        begun = time.perf_counter()
        study.run(solver, rows, threads)
        taken = time.perf_counter() - begun
        if taken >= LONG_ENOUGH or len(rows) == design.count:
            return taken / len(rows), len(rows)
        count = min(4 * count, design.count)


def some_rows(design: Design, count: int) -> Rows:
    """Rows of about ``count`` runs from places that are spread evenly over an ensemble."""
    places = min(PLACES, count)
    ends = np.linspace(0, design.count, places + 1).astype(int).tolist()
    size = -(-count // places)
    parts = [design.rows(a, min(a + size, b)) for a, b in itertools.pairwise(ends)]
    x, u, p = ([getattr(part, group) for part in parts] for group in ("x", "u", "p"))
    u, p = (a[0] if a[0].ndim == 1 else np.concatenate(a) for a in (u, p))
    return Rows(np.concatenate(x), u, p)


def _duration(seconds: float) -> str:
    """A duration with two digits, in a unit that suits it."""
    for unit, length in (("days", 86400.0), ("h", 3600.0), ("min", 60.0)):
        if seconds >= 2 * length:
            return f"{float(f'{seconds / length:.2g}'):g} {unit}"
    return f"{float(f'{max(seconds, 0.01):.2g}'):g} s"


def _size(count: int) -> str:
    """A number of bytes with two digits, in a unit that suits it."""
    for unit, length in (("TB", 1e12), ("GB", 1e9), ("MB", 1e6)):
        if count >= length:
            return f"{float(f'{count / length:.2g}'):g} {unit}"
    return f"{max(1, round(count / 1000))} kB"
