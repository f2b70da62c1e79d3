"""Solver: a right-hand side and a method, compiled together; it integrates arrays of initial states."""

from __future__ import annotations

import logging
import math
import threading
import time
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lagrangian.codegen import native, workers
from lagrangian.codegen.arguments import InputGroup
from lagrangian.codegen.buffers import address
from lagrangian.errors import RunError, did_you_mean
from lagrangian.graph import reached
from lagrangian.integrate.status import RunStatus

from . import check
from .chattering import NEAR, Pace, Sticking
from .in_modes import signals_at
from .machine import Machine, build_of
from .methods import METHODS, memory_layout
from .methods.events import ROUNDS
from .methods.loop import IntegratorVariant
from .problem import Events, Signals
from .projection import DRIFT, Drift, Projection
from .solution import Solution

if TYPE_CHECKING:
    from lagrangian.graph import Program

_log = logging.getLogger(__name__)
Array = NDArray[np.float64]

BUDGET = 50_000_000
"""The number of operations, each for a vector of runs, between two checks of the clock: some hundredths of a second."""

OFTEN = 16
"""By what factor the clock is checked more often if the right-hand side jumps, so that a run may stick."""

ROWS = 4096
"""The number of samples of a run with fixed steps that are examined together."""

MAX_PAIRED_NODES = 300
"""Nodes of the longest program of which two vectors of runs are computed together."""

GROUPS = frozenset({"x", "u", "p", "t"})


class Solver:
    """Integrates ``ẋ = f(x, u, p, t)`` by a method whose steps are compiled together with f.

    ``program`` has the groups ``x`` (nx), ``u`` (nu), ``p`` (np) and ``t`` if it needs them, and one output of shape
    (nx,). ``method`` is a name in `METHODS`. ``lanes`` runs are computed side by side (1, 2, 4, 8, 16; by default the
    fastest number here), each with its own time and step size, on ``threads`` cores (by default all). The result of a
    run depends neither on the runs beside it nor on the number of threads. ``keep``: cache the code on disk.
    ``projection``: its rows are satisfied at the end of every accepted step, by every state inside a step that is
    returned, and by every state that events leave or change; an adaptive method rejects a step whose correction exceeds
    the tolerances. The initial state is projected too, but the first sample is the state as given.

    >>> from lagrangian.graph import Graph, Output, Program
    >>> g = Graph()
    >>> q, v = g.input("x", 0), g.input("x", 1)
    >>> swing = Program("swing", g, {"x": ("q", "v")}, {"xdot": Output((v, g.neg(g.sin(q))), (2,))})
    >>> run = Solver(swing, keep=False).solve([1.0, 0.0], [0.0, 5.0, 10.0])
    >>> run.states[0].round(6)
    array([[ 1.      ,  0.      ],
           [-0.023951,  0.958552],
           [-0.99895 , -0.042033]])

    Raises `RunError` if the program, the method or the events do not fit together.
    """

    def __init__(
        self,
        program: Program,
        method: str = "dop853",
        *,
        events: Events | None = None,
        projection: Projection | None = None,
        lanes: int | None = None,
        threads: int | None = None,
        keep: bool = True,
    ) -> None:
        if method not in METHODS:
            hint = did_you_mean(str(method), METHODS) or f"known: {', '.join(METHODS)}"
            raise RunError(f"there is no method '{method}'", code="E402", fix=hint)
        check.lanes_wanted(lanes)
        check.threads_wanted(threads)
        size = len(program.inputs.get("x", ()))
        shapes = [output.shape for output in program.outputs.values()]
        if size == 0 or shapes != [(size,)]:
            raise RunError(
                f"program '{program.name}' is not a right-hand side: {size} states, outputs {shapes}",
                code="E501",
                fix="a group 'x' and one output of its length",
            )
        if strange := set(program.inputs) - GROUPS:
            raise RunError(f"group '{strange.pop()}' is none of x, u, p, t", code="E402")
        self.program, self.method, self.sticking = program, METHODS[method], Sticking(program)
        check.suits(self.method, program)
        self.events = None if events is None else events.checked(program)
        self.projection = None if projection is None else projection.checked(program)
        self.threads, self._lanes = threads, lanes
        self._keep = keep
        self._machines: dict[tuple[IntegratorVariant, int], Machine] = {}
        self._groups = {
            name: InputGroup(
                name, tuple(entries), tuple(program.defaults.get(e) if name == "p" else None for e in entries)
            )
            for name, entries in {**{"u": (), "p": ()}, **program.inputs}.items()
        }

    def __repr__(self) -> str:
        """Name the program and the method."""
        return f"<Solver {self.program.name!r} by {self.method.name}>"

    def __reduce__(self) -> Any:
        """A solver that is sent to another process is compiled there."""
        given = (self.program, self.method.name, self.events, self.projection, self._lanes, self.threads, self._keep)
        return _rebuilt, given

    def solve(
        self,
        x0: ArrayLike,
        times: ArrayLike,
        *,
        u: Any = None,
        p: Any = None,
        rtol: float = 1e-9,
        atol: ArrayLike = 1e-12,
        step: float | None = None,
        max_steps: int = 10_000_000,
        max_step: float = math.inf,
        max_events: int = 10_000,
        deadline: float | None = None,
        store: bool = True,
    ) -> Solution:
        """Integrate from ``x0`` (nx,) or (N, nx) at ``times[0]``; return the states at ``times`` (S,).

        ``u``: constant inputs, (nu,) or (N, nu), or `Signals`. ``p``: parameters, (np,) or (N, np); None means the
        defaults of the program. ``rtol``, ``atol``: an adaptive method keeps its estimate of the error of a step below
        ``atol + rtol |x|``. ``step``: the longest step of a method with fixed steps; stop points (requested times,
        knots of the inputs) are met exactly by equal steps between them. ``max_steps``, ``max_events``: limits that end
        a run. ``deadline`` [s]: all runs end after this computing time. ``store=False``: return only final states.

        Raises `RunError` if an argument does not fit; a failure during a run ends it with a status (`RunStatus`).
        """
        task = _Task(self, x0, times, u, p, store, rtol)
        task.accuracy(rtol, atol, step, max_steps, max_step, max_events)
        return task.run(None if deadline is None else check.number(deadline, "deadline"))

    def machine(self, count: int, own: bool, signals: bool, tolerance: float) -> Machine:
        """The machine code for this number of runs."""
        method = self.method.suited(tolerance)
        lanes = 1 if count == 1 else self._lanes or self._side_by_side(count)
        variant = IntegratorVariant(lanes, own or lanes == 1, signals, self.events is not None)
        found = self._machines.get((variant, method.order))
        if found is None:
            found = Machine(build_of(self.program, lanes, self._keep), method, variant, self.events, self.projection)
            self._machines[variant, method.order] = found
        return found

    def _side_by_side(self, count: int) -> int:
        """How many runs are computed together: of short programs two vectors full, whose operations overlap."""
        lanes, program = native.host().lanes, self.program
        short = len(reached(program.graph, program.ids)) <= MAX_PAIRED_NODES and len(program.inputs["x"]) <= 8
        return 2 * lanes if short and count >= 2 * lanes and not self.method.expands else lanes


def _rebuilt(
    program: Program,
    method: str,
    events: Events | None,
    projection: Projection | None,
    lanes: int | None,
    threads: int | None,
    keep: bool,
) -> Solver:
    return Solver(program, method, events=events, projection=projection, lanes=lanes, threads=threads, keep=keep)


class _Task:
    """One call of `Solver.solve`: its arrays, and the table of their addresses."""

    def __init__(self, solver: Solver, x0: Any, times: Any, u: Any, p: Any, store: bool, rtol: Any) -> None:
        self.solver, groups = solver, solver._groups
        self.times = check.instants(times)
        x0 = check.rows(groups["x"], x0, "state")
        signals = None
        if isinstance(u, Signals):
            signals = u.checked(len(groups["u"].entries), float(self.times[0]))
            u = np.zeros(len(groups["u"].entries))
        inputs, parameters = check.rows(groups["u"], u, "input"), check.rows(groups["p"], p, "parameter")
        given = (x0, inputs, parameters)
        counts = {len(a) for a in given if a.ndim == 2}
        if len(counts) > 1:
            shapes = ", ".join(f"{n} {a.shape}" for n, a in zip(("x0", "u", "p"), given, strict=True))
            raise RunError(f"the numbers of runs differ: {shapes}", code="E501", fix="one row each, or one for all")
        self.count = counts.pop() if counts else 1
        self.signals, self.inputs, self.parameters = signals, inputs, parameters
        tolerance = check.number(rtol, "rtol")
        self.machine = solver.machine(self.count, parameters.ndim == 2, signals is not None, tolerance)
        size, count, samples = x0.shape[-1], self.count, len(self.times)
        self.states = np.full((count, samples if store else 0, size), math.nan)
        self.final = np.array(np.broadcast_to(x0, (count, size)), order="C")
        if store and count:
            self.states[:, 0] = x0
        self.status = np.full(count, RunStatus.LATE)
        self.reached = np.full(count, self.times[0])
        self.counts = {n: np.zeros(count, np.int64) for n in ("steps", "rejected", "evaluations", "event_count")}
        self.drift = Drift.blank(count) if solver.projection is not None else np.empty((0, len(DRIFT)))
        self.shared = self.machine.shared(parameters) if parameters.ndim == 1 else {}
        if not store:
            self.times_used = self.times[[0, -1]]
        else:
            self.times_used = self.times
        place, row = (self.states, 8 * size * samples) if store else (self.final, 8 * size)
        self.table: dict[str, Any] = {
            "x0": x0, "x0_row": x0.strides[0] if x0.ndim == 2 else 0,
            "u": inputs, "u_row": inputs.strides[0] if inputs.ndim == 2 else 0,
            "p": parameters, "p_row": parameters.strides[0] if parameters.ndim == 2 else 0,
            **self.shared, "times": self.times_used, "samples": len(self.times_used),
            "states": place, "states_row": row, "states_step": 8 * size if store else 0,
            "final": self.final, "status": self.status, "reached": self.reached, **self.counts,
            "drift": self.drift,
        }  # fmt: skip
        if signals is not None:
            self.table |= {"knots": signals.knots, "knot_count": len(signals.knots)}
            self.table |= {"knot_start": signals.start, "knot_slope": signals.slope}

    def accuracy(self, rtol: Any, atol: Any, step: Any, max_steps: Any, max_step: Any, max_events: Any) -> None:
        """Check and store the settings that determine step sizes and the ends of runs."""
        method, size = self.solver.method, self.final.shape[1]
        relative, absolute = check.tolerances(rtol, atol, size)
        if method.adaptive and step is not None:
            raise RunError(
                f"method '{method.name}' chooses its step size itself", code="E501", fix="give rtol and atol, no step"
            )
        if not method.adaptive and step is None:
            raise RunError(f"method '{method.name}' needs a step", code="E501", fix="give step, in the unit of time")
        self.table |= {
            "rtol": relative,
            "atol": absolute,
            "step": 0.0 if step is None else check.step_length(step, self.times),
            "max_step": check.number(max_step, "max_step", infinite=True),
            "max_steps": check.whole(max_steps, "max_steps"),
            "max_events": check.whole(max_events, "max_events"),
        }

    def run(self, deadline: float | None) -> Solution:
        """Integrate all runs."""
        entries = [self.table.get(name, 0) for name in memory_layout.TABLE]
        self._table = np.empty(len(entries), np.int64)
        for k, x in enumerate(entries):
            if isinstance(x, float):
                self._table[k : k + 1] = np.array([x]).view(np.int64)
            else:
                self._table[k] = address(x) if isinstance(x, np.ndarray) else x
        self._deadline = math.inf if deadline is None else time.monotonic() + deadline
        self._halt = threading.Event()
        self._events: list[Array] = []
        cost = len(self.solver.program.graph.nodes) * self.solver.method.cost
        if self.solver.projection is not None:
            cost += sum(len(program.graph.nodes) for program in self.solver.projection.programs)
        self._budget = max(1, BUDGET // max(1, cost) // (OFTEN if self.solver.sticking else 1))
        _log.info("integrating %d run%s", self.count, "" if self.count == 1 else "s")
        try:
            if self.count:
                workers.over(self.count, self.machine.variant.lanes, 100 * cost, self.solver.threads, self._range)
        except BaseException:
            self._halt.set()  # the other threads stop at their next pause
            raise
        if self.solver.sticking:
            self._stuck_at_last()
            if not self.solver.method.adaptive:
                self._stuck_on_the_way()
        return self._solution()

    def _range(self, start: int, stop: int) -> int:
        """Integrate runs start … stop − 1."""
        space = self.machine.space()
        words = space.view(np.int64)
        words[memory_layout.CURSOR], words[memory_layout.LAST] = start, stop
        here, table = address(space), address(self._table)
        log = self._log(words)
        paces: dict[int, Pace] = {}
        while not self._halt.is_set():
            why = self.machine.call(table, here, self._budget)
            if why == memory_layout.DONE:
                break
            if why == memory_layout.FULL:
                self._keep(words, log)
            if time.monotonic() > self._deadline:
                words[memory_layout.QUIT], words[memory_layout.CURSOR] = 1, stop
            if why == memory_layout.PAUSED and self.solver.sticking:
                self._look(space, words, paces)
        self._keep(words, log)
        return -1

    def _look(self, space: Array, words: NDArray[np.int64], paces: dict[int, Pace]) -> None:
        """End the runs in the work space that stick and make no progress."""
        lanes, at = self.machine.variant.lanes, self.machine.places
        end, most = float(self.times[-1]), int(self.table["max_steps"])
        for lane in range(lanes):
            state, code, run, t, steps, rejected, x = (at[name] * lanes + lane for name in memory_layout.PLACES)
            if words[state] != memory_layout.RUNNING:
                continue
            here = int(words[run])
            pace = paces.setdefault(here, Pace(float(self.times[0])))
            if not pace.hopeless(float(space[t]), int(words[steps] + words[rejected]), end, most):
                continue
            if self._sticks(here, space[x : x + lanes * self.final.shape[1] : lanes], float(space[t])):
                words[state], words[code] = memory_layout.ENDED, RunStatus.CHATTERS

    def _sticks(self, run: int, x: Array, t: float) -> bool:
        """Whether a run sticks in a state; `lagrangian.integrate.chattering`."""
        return bool(self._stuck(run, x[np.newaxis], np.array([t]))[0])

    def _stuck(self, run: int, x: Array, t: Array) -> NDArray[np.bool_]:
        """In which of the states (n, nx) at times (n,) a run sticks."""
        u = self.inputs if self.inputs.ndim == 1 else self.inputs[run]
        u = u if self.signals is None else signals_at(self.signals, t)
        p = self.parameters if self.parameters.ndim == 1 else self.parameters[run]
        near = NEAR * float(self.times[-1] - self.times[0])
        return self.solver.sticking.among(x, u, p, t, near, float(self.table["step"]))

    def _stuck_at_last(self) -> None:
        """Give runs that were abandoned, and stick where they stopped, the status for that."""
        for run in np.flatnonzero(
            np.isin(self.status, (RunStatus.TOO_MANY, RunStatus.UNDERFLOW, RunStatus.NO_CONVERGENCE))
        ):
            if self._sticks(int(run), self.final[run], float(self.reached[run])):
                self.status[run] = RunStatus.CHATTERS

    def _stuck_on_the_way(self) -> None:
        """End runs with fixed steps, which always get through, at the first sample at which they stick."""
        for run in np.flatnonzero(self.status != RunStatus.CHATTERS).tolist():
            x, t = self.final[run : run + 1], self.reached[run : run + 1]
            if self.states.shape[1]:
                went = int((self.times <= t[0]).sum())
                x, t = np.concatenate([self.states[run, :went], x]), np.append(self.times[:went], t)
            for start in range(0, len(t), ROWS):
                part = slice(start, start + ROWS)
                found = np.flatnonzero(self._stuck(run, x[part], t[part]))
                if len(found):
                    k = start + int(found[0])
                    self.status[run], self.reached[run], self.final[run] = RunStatus.CHATTERS, t[k], x[k]
                    self.states[run, k + 1 :] = math.nan
                    break

    def _log(self, words: NDArray[np.int64]) -> Array:
        """Allocate memory for events, and pass it to the machine code."""
        count = 0 if self.solver.events is None else len(self.solver.events.direction)
        room = max(1024, 3 * ROUNDS * count * self.machine.variant.lanes) if count else 0
        log = np.empty((room, 3 + self.final.shape[1]))
        words[memory_layout.LOG], words[memory_layout.ROOM] = address(log), room
        return log

    def _keep(self, words: NDArray[np.int64], log: Array) -> None:
        """Copy the logged events, so that the log can be used again."""
        if words[memory_layout.LOGGED]:
            self._events.append(log[: words[memory_layout.LOGGED]].copy())
            words[memory_layout.LOGGED] = 0

    def _solution(self) -> Solution:
        size, count = self.final.shape[1], self.count
        log = np.concatenate(self._events) if self._events else np.empty((0, 3 + size))
        log = log[np.argsort(log[:, 0], kind="stable")]  # a run's events stay in order
        log = log[log[:, 2] <= self.reached[log[:, 0].astype(np.int64)]]  # of those that stick, none from afterwards
        runs = log[:, 0].astype(np.int64)
        each = np.bincount(runs, minlength=count)
        most = int(each.max(initial=0))
        place = np.arange(len(runs)) - np.searchsorted(runs, runs)
        index = np.full((count, most), -1)
        when, where = np.full((count, most), math.nan), np.full((count, most, size), math.nan)
        index[runs, place], when[runs, place], where[runs, place] = log[:, 1].astype(np.int64), log[:, 2], log[:, 3:]
        return Solution(
            self.times if self.states.shape[1] else np.empty(0), self.states, self.status, self.reached, self.final,
            self.counts["steps"], self.counts["rejected"], self.counts["evaluations"], each, index, when, where,
            None if self.solver.projection is None else Drift.of_rows(self.drift),
        )  # fmt: skip
