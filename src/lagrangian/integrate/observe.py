"""What is done with the runs of an ensemble: how they are integrated, and which few numbers of them are stored.

A run is sampled at the requested times, and compiled code evaluates expressions along it. Of each expression, a
reduction over time or the samples themselves are stored. Everything here is computed for a chunk of runs at once.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from lagrangian.codegen import Kernel
from lagrangian.codegen.workers import over
from lagrangian.errors import RunError
from lagrangian.integrate.closing import Closing
from lagrangian.integrate.design import Rows
from lagrangian.integrate.fitness import Fitness
from lagrangian.integrate.in_modes import LEAST, NOT_FINITE, InModes, kernel_of, lost, signals_at
from lagrangian.integrate.projection import BREAKS, Drift, Projection
from lagrangian.integrate.status import RunStatus
from lagrangian.records import dataclass, field

if TYPE_CHECKING:
    from lagrangian.graph import Program

Array: TypeAlias = NDArray[np.float64]
Values: TypeAlias = dict[str, NDArray[Any]]

STATES = 1 << 15  # number of states that are observed together
LOGGED = 3  # copies of an event's numbers in memory: as logged, in order, and run by run
MANY = 1000  # number of events of a run for which memory is reserved; few runs have more


def _mean(y: Array, t: Array) -> Array:
    """The mean over time by the trapezoidal rule: (1/(t₁ − t₀)) ∫ y dt."""
    length = t[..., -1] - t[..., 0]
    area = np.trapezoid(y, t, axis=-1) if hasattr(np, "trapezoid") else np.trapz(y, t, axis=-1)  # type: ignore
    return np.where(length > 0, area / np.where(length > 0, length, 1.0), y[..., 0])


REDUCTIONS: Mapping[str, Callable[[Array, Array], Array]] = {
    "final": lambda y, _: y[..., -1],
    "max": lambda y, _: y.max(axis=-1),
    "min": lambda y, _: y.min(axis=-1),
    "mean": _mean,
    "rms": lambda y, t: np.sqrt(_mean(y * y, t)),
    "range": lambda y, _: y.max(axis=-1) - y.min(axis=-1),
}
"""The reductions of an expression y (n, S) at times t (S,) or (n, S), by name."""


@dataclass(frozen=True)
class Kept:
    """A result of every run: ``name``, the output ``of`` which it is made, and the reduction (None: the samples)."""

    name: str
    of: str
    reduction: str | None


@dataclass(frozen=True)
class EventsKept:
    """The count of event ``index``, and its first ``times`` times."""

    name: str
    index: int
    times: int


DRIFTED = {
    "drift position": ("position_before",),
    "drift velocity": ("velocity_before",),
    "drift left": ("position_after", "velocity_after"),
    "drift margin": ("margin",),
}
"""What is kept of every run with a projection: the greatest of these of its `Drift`."""


@dataclass(frozen=True)
class Study:
    """What is done with every run of an ensemble; small, and can be sent to another process.

    ``program`` is x, u, p, t → ẋ; ``outputs`` is a program over the same groups, each of whose outputs is one number;
    ``times`` (S,) are those of the samples. ``projection`` keeps runs on their rows. ``signals`` are inputs that change
    with time and are the same for all runs. ``canonical``: if ``program`` is over [q; p], the programs x → p and
    [q; p] → v. A run whose parameters ``fitness`` refuses is not started. ``options`` are passed to the solver (rtol,
    atol, step, …). ``solver``: what integrates if it is not a `Solver` of ``program``, with the same method ``solve``.
    ``further`` are functions that compute more outputs, by name, from the outputs of a ``program`` that they have.
    ``regimes``: where solutions have ``modes``, ``programs(modes)`` of it are the ``outputs`` and ``further`` of each.
    """

    program: Program
    method: str
    times: Array
    outputs: Program
    kept: tuple[Kept, ...]
    events: Any = None
    closing: Closing | None = None
    projection: Projection | None = None
    events_kept: tuple[EventsKept, ...] = ()
    signals: Any = None
    canonical: tuple[Program, Program] | None = None
    fitness: Fitness | None = None
    options: Mapping[str, Any] = field(default_factory=dict)
    solver: Any = None
    further: tuple[Any, ...] = ()
    regimes: Any = None

    @property
    def whole(self) -> bool:
        """Whether more than the last sample of a run is needed."""
        return any(k.reduction != "final" for k in self.kept)

    @property
    def bytes_per_run(self) -> int:
        """The approximate memory for one run of a chunk: its samples, its results, and its events."""
        samples = len(self.times) if self.whole else 1
        stored = sum(1 if k.reduction else len(self.times) for k in self.kept)
        stored += sum(1 + e.times for e in self.events_kept)
        states = len(self.program.inputs["x"])
        if self.events is not None:
            stored += LOGGED * min(self.options.get("max_events", MANY), MANY) * (3 + states)
        return 8 * (samples * states + stored + states + 8)

    def fields(self) -> dict[str, tuple[str, tuple[int, ...]]]:
        """The results of `run` by name: type, and shape after the axis of runs."""
        made: dict[str, tuple[str, tuple[int, ...]]] = {}
        for k in self.kept:
            made[k.name] = ("float64", () if k.reduction else (len(self.times),))
        for e in self.events_kept:
            made[f"count {e.name}"] = ("int32", ())
            made[f"time {e.name}"] = ("float64", (e.times,) if e.times > 1 else ())
        if self.projection is not None:
            made |= dict.fromkeys(DRIFTED, ("float64", ()))
        made["reached"] = ("float64", ())
        made["status"] = ("int8", ())
        return made

    @cached_property
    def _kernel(self) -> Kernel | None:
        """The code of the outputs; None if each is an entry of the state, so that nothing has to be computed."""
        if all(entry is not None for entry in self._entries.values()):
            return None
        return kernel_of(self.outputs)

    @cached_property
    def _transforms(self) -> tuple[Kernel, Kernel]:
        """The code that converts velocities to momenta, and momenta to velocities."""
        assert self.canonical is not None
        return kernel_of(self.canonical[0], u=0.0), kernel_of(self.canonical[1], u=0.0)

    @cached_property
    def _entries(self) -> dict[str, int | None]:
        """For each output, the entry of x that it is, if it is nothing else."""
        nodes = self.outputs.graph.nodes
        first = {name: nodes[output.ids[0]] for name, output in self.outputs.outputs.items()}
        return {name: node[2] if node[:2] == ("input", "x") else None for name, node in first.items()}

    def __getstate__(self) -> dict[str, Any]:
        return {k: v for k, v in self.__dict__.items() if not k.startswith("_")}

    def run(self, solver: Any, rows: Rows, threads: int | None = None) -> Values:
        """Integrate the runs in ``rows`` and return their results: arrays (n, …) by name.

        A failed run has its status and NaN results. If a terminal event ends a run, or its events accumulate, the
        results are taken over the part that was simulated.
        """
        unfit = self._unfit(rows)
        if unfit.any():
            return self._without(unfit, solver, rows, threads)
        return self._all(solver, rows, threads)

    def _unfit(self, rows: Rows) -> NDArray[np.bool_]:
        """Which runs have impossible parameters."""
        if self.fitness is None:
            return np.zeros(len(rows), bool)
        return self.fitness.unfit(np.ascontiguousarray(np.broadcast_to(rows.p, (len(rows), rows.p.shape[-1]))))

    def _without(self, unfit: NDArray[np.bool_], solver: Any, rows: Rows, threads: int | None) -> Values:
        """Compute the possible runs among those whose parameters are not."""
        made, fit = self._unfilled(len(rows), RunStatus.UNFIT), ~unfit
        if fit.any():
            for name, values in self._all(solver, rows.only(fit), threads).items():
                made[name][fit] = values
        return made

    def _all(self, solver: Any, rows: Rows, threads: int | None) -> Values:
        """Compute all runs in ``rows``, each from a start on its rows."""
        if self.closing is None:
            return self._solved(solver, rows, threads)
        x, arrived = self.closing.closed(rows.x, rows.p, float(self.times[0]))
        if arrived.all():
            return self._solved(solver, Rows(x, rows.u, rows.p), threads)
        made = self._unfilled(len(rows), RunStatus.OPEN)
        if arrived.any():
            for name, values in self._solved(solver, Rows(x, rows.u, rows.p).only(arrived), threads).items():
                made[name][arrived] = values
        return made

    def _unfilled(self, count: int, why: RunStatus) -> Values:
        """The results of runs that are not started."""
        made: Values = {}
        for name, (dtype, shape) in self.fields().items():
            made[name] = np.full((count, *shape), np.nan if dtype == "float64" else 0, dtype)
        made["status"][:], made["reached"][:] = why, self.times[0]
        return made

    def _solved(self, solver: Any, rows: Rows, threads: int | None) -> Values:
        """Integrate all runs in ``rows``."""
        u = self.signals if self.signals is not None else rows.u
        times = self.times if self.whole else self.times[[0, -1]]
        solution = solver.solve(self._started(rows), times, u=u, p=rows.p, store=self.whole, **self.options)
        made: Values = {n: np.empty((len(rows), *shape), dtype) for n, (dtype, shape) in self.fields().items()}
        made["status"][:], made["reached"][:] = solution.status, solution.reached
        if solution.drift is not None:
            self._drifted(solution, made)
        self._events(solution, made)
        size = max(LEAST, STATES // (len(self.times) if self.whole else 1))  # runs that are observed together

        def reduced(start: int, stop: int) -> int:
            for k in range(start, stop, size):
                self._reduced(solution, rows, slice(k, min(stop, k + size)), made)
            return -1

        over(len(rows), size, 50 * (len(self.times) if self.whole else 1), threads, reduced)
        failed = lost(made["status"])
        for k in self.kept:
            made[k.name][failed] = np.nan
        return made

    def _reduced(self, solution: Any, rows: Rows, part: slice, made: Values) -> None:
        """The results of the runs in ``part``."""
        states, times, beyond = self._samples(solution, rows, part)
        if self.regimes is not None:
            y = InModes(self.regimes, self.whole, self.times, self.signals, solution, rows, part).observed(
                states, times
            )
        else:
            y = self._observed(states, times, rows, part)
            for more in self.further:
                u = rows.u if self.signals is None else signals_at(self.signals, times)
                y |= more(self._evaluated(kernel_of(more.program), states, u, times, rows, part))
        for k in self.kept:
            if k.reduction is None:
                made[k.name][part] = y[k.of] if beyond is None else np.where(beyond, np.nan, y[k.of])
            else:
                made[k.name][part] = REDUCTIONS[k.reduction](y[k.of], times)

    def _samples(self, solution: Any, rows: Rows, part: slice) -> tuple[Array, Array, NDArray[np.bool_] | None]:
        """States (n, S, nx), times (S,) or (n, S), and which samples lie beyond the end of their run.

        After its end, a run keeps its last state, so that maxima and averages over time need no special case. A failed
        run keeps its first state, so that everything observed is finite; its results are dropped later.
        """
        status, reached = solution.status[part], solution.reached[part]
        failed = lost(status)
        ended = np.where(failed, self.times[0], reached)
        last = np.where(failed[:, None], 0.0, solution.final[part])
        if not self.whole:
            states, times, beyond = last[:, None, :], ended[:, None], None
        elif (status == 0).all():
            states, times, beyond = solution.states[part], self.times, None
        else:
            stopped = (status != 0)[:, None] & (self.times >= ended[:, None])
            states = np.where(stopped[..., None], last[:, None, :], solution.states[part])
            times, beyond = np.minimum(self.times, ended[:, None]), failed[:, None] | (self.times > ended[:, None])
        if self.canonical is not None:
            states = self._with_velocities(states, times, rows, part)
        if failed.any():
            states = np.where(failed[:, None, None], rows.x[part][:, None, :], states)
        return states, times, beyond

    def _with_velocities(self, states: Array, times: Array, rows: Rows, part: slice) -> Array:
        """[q; p] converted to [q; v]."""
        v = self._evaluated(self._transforms[1], states, None, times, rows, part)["v"]
        return np.concatenate([states[..., : states.shape[-1] - v.shape[-1]], v], axis=-1)

    def _started(self, rows: Rows) -> Array:
        """The initial states in the variables that are integrated."""
        if self.canonical is None:
            return rows.x
        x = rows.x[:, None, :]
        p = self._evaluated(self._transforms[0], x, None, self.times[:1], rows, slice(0, len(rows)))["p"][:, 0]
        return np.concatenate([rows.x[:, : rows.x.shape[1] - p.shape[1]], p], axis=1)

    def _observed(self, states: Array, times: Array, rows: Rows, part: slice) -> dict[str, Array]:
        """Each output along each run, (n, S)."""
        if self._kernel is None:
            return {name: states[..., entry] for name, entry in self._entries.items() if entry is not None}
        u = rows.u if self.signals is None else signals_at(self.signals, times)
        return self._evaluated(self._kernel, states, u, times, rows, part)

    def _evaluated(
        self, kernel: Kernel, states: Array, u: Array | None, times: Array, rows: Rows, part: slice
    ) -> dict[str, Array]:
        """The outputs of a kernel along each run, (n, S, …); values that are not finite are returned unchanged."""
        runs, samples = states.shape[:2]
        fill = max(0, math.ceil(LEAST / samples) - runs)

        def padded(a: Array) -> Array:
            return np.concatenate([a, np.repeat(a[-1:], fill, axis=0)]) if fill else a

        if self.signals is None and u is not None and u.ndim == 2:
            u = padded(u[part])[:, None, :]
        elif u is not None and u.ndim == 3:
            u = padded(u)
        p = rows.p if rows.p.ndim == 1 else padded(rows.p[part])[:, None, :]
        t = padded(times) if times.ndim == 2 else times
        lead = (runs + fill, samples)
        out = {name: np.empty((*lead, *o.shape)) for name, o in kernel.program.outputs.items()}
        try:
            kernel(x=padded(states), u=u, p=p, t=t, out=out)
        except RunError as trouble:  # every state is computed in any case
            if trouble.code != NOT_FINITE:
                raise
        return {name: values[:runs] for name, values in out.items()}

    def _drifted(self, solution: Any, made: Values) -> None:
        """How far the runs came from their rows; those that an event sent elsewhere have failed."""
        drift: Drift = solution.drift
        for name, fields in DRIFTED.items():
            found = [getattr(drift, field) for field in fields]
            made[name][:] = np.maximum.reduce(found)
        broken = np.maximum(drift.reset_position, drift.reset_velocity) > BREAKS
        made["status"][broken & (solution.status >= 0)] = RunStatus.BROKEN
        if self.projection is not None and self.projection.spare and self.projection.corrects:
            apart = np.maximum(drift.position_after, drift.velocity_after) > BREAKS
            made["status"][apart & (solution.status >= 0)] = RunStatus.APART

    def _events(self, solution: Any, made: Values) -> None:
        """The counts and first times of the events that are stored."""
        for e in self.events_kept:
            mine = solution.event_index == e.index
            made[f"count {e.name}"][:] = mine.sum(axis=1)
            order = np.argsort(~mine, axis=1, kind="stable")[:, : e.times]
            times = np.full((len(mine), e.times), np.nan)
            times[:, : order.shape[1]] = np.where(
                np.take_along_axis(mine, order, axis=1), np.take_along_axis(solution.event_time, order, axis=1), np.nan
            )
            made[f"time {e.name}"][:] = times if e.times > 1 else times[:, 0]
