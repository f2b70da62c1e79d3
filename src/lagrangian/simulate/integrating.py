"""Integrates one run, in machine code if possible, and with SciPy's solvers if requested.

In both cases the state is [q; v], followed by the supplied energy. A symplectic method integrates [q; p]; states are
converted to momenta before and back afterwards.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian import codegen as machine
from lagrangian import dynamics
from lagrangian.graph import Output, Program, jacobian
from lagrangian.integrate import Events, Projection, RunStatus, Signals, Solution, Solver
from lagrangian.integrate.crossings import Crossings, Hit
from lagrangian.integrate.method_names import SCIPY
from lagrangian.integrate.scipy_methods import IMPLICIT, Bounds, Outcome, integrate_scipy
from lagrangian.model import Model
from lagrangian.records import dataclass
from lagrangian.simulate import resets
from lagrangian.simulate.events import Event
from lagrangian.simulate.inputs import InputSignals

_log = logging.getLogger(__name__)
Array = NDArray[np.float64]

SYMPLECTIC = frozenset({"gauss4"})
"""Methods that need canonical coordinates and momenta."""

REMEMBERED = 32
"""The number of compiled functions that are cached with a model; the most recently used stay."""


@dataclass(frozen=True, eq=False)
class Task:
    """Everything that a run needs, after all checks; ``rtol`` and ``atol`` are those of one step.

    ``over_run``: rtol is relative to the largest values of the run so far (`lagrangian.integrate.scipy_weights`).
    """

    model: Model
    drive: InputSignals
    times: Array
    x0: Array
    p: Array
    method: str
    rtol: float
    atol: float
    step: float | None
    events: tuple[Event, ...]
    bounds: Bounds
    project: bool = True
    over_run: bool = False

    @property
    def size(self) -> int:
        """The number of states [q; v]."""
        return len(self.model.coordinates) + len(self.model.velocities)

    @property
    def states(self) -> list[str]:
        """The names of the states, coordinates first."""
        return [*(c.name for c in self.model.coordinates), *(v.name for v in self.model.velocities)]

    @property
    def impacts(self) -> list[tuple[str, Any, Mapping[Any, Any]]]:
        """The events in the form that `lagrangian.dynamics.impacts` needs."""
        return [(e.title, e.expression, e.reset) for e in self.events]


def remembered(model: Model, key: Any, make: Callable[[], Any]) -> Any:
    """Return what was compiled for a model under a key; compile it at the first request."""
    return model.recent("compiled", key, make, REMEMBERED)


def run(task: Task) -> Outcome:
    """Integrate; the states of the outcome are [q; v] and, if anything supplies energy, the supplied energy."""
    if len(task.times) == 1:
        return Outcome(task.times, task.x0[np.newaxis], RunStatus.REACHED, float(task.times[0]), task.x0)
    if task.method in SCIPY:
        _log.info("integrating by %s of SciPy", task.method)
        return _by_scipy(task)
    outcome = _by_machine(task)
    return _from_momenta(task, outcome) if task.method in SYMPLECTIC else outcome


# -- programs ---------------------------------------------------------------------------------------------------


def right_hand_side(model: Model, drive: InputSignals, *, canonical: bool = False) -> Program:
    """ẋ with feedback compiled in and, if anything can supply energy, the supplied energy as a last state."""
    key = ("rhs", canonical, frozenset(drive.feedback.items()))
    make = dynamics.canonical if canonical else dynamics.closed
    return remembered(model, key, lambda: make(dynamics.slips(model), drive.feedback, supply=True))


def projection(model: Model, rates: Program, *, project: bool) -> Projection | None:
    """What keeps the states of ``rates`` on the constraints, or measures how far they are off; None without any."""
    if not model.constraints:
        return None
    (found,) = remembered(model, "projection", lambda: (dynamics.projection(model),))
    if found == (None, None):
        return None
    beside = (None if program is None else _beside(program, rates) for program in found)
    return Projection(*beside, corrects=project, spare=bool(model.spare))


def _beside(program: Program, rates: Program) -> Program:
    """A projection for the groups of a right-hand side, which may have more states, such as the energy supplied."""
    g, dx = program.graph, program.outputs["dx"]
    more = len(rates.inputs["x"]) - len(dx.ids)
    outputs = {**program.outputs, "dx": Output((*dx.ids, *[g.zero] * more), (len(dx.ids) + more,))}
    return Program(program.name, g, {**rates.inputs, "t": ("t",)}, outputs, program.defaults)


def _event_key(task: Task) -> Any:
    return tuple((e.expression, e.direction, e.terminal, frozenset(e.reset.items())) for e in task.events)


def event_program(
    model: Model, events: Iterable[Event], drive: InputSignals, rates: Program, *, momenta: bool
) -> Program:
    """The functions of events, and the states after them, over the groups of the right-hand side ``rates``."""
    make = dynamics.canonical_impacts if momenta else dynamics.impacts
    impacts = [(e.title, e.expression, e.reset) for e in events]
    return make(model, impacts, drive.feedback, supply=dynamics.SUPPLY in rates.inputs["x"])


def _event_program(task: Task, program: Program) -> Program:
    return event_program(task.model, task.events, task.drive, program, momenta=task.method in SYMPLECTIC)


def _jacobian(program: Program) -> Program:
    """x, u, p, t → ∂ẋ/∂x, shape (nx, nx)."""
    g, n = program.graph, len(program.inputs["x"])
    entries = jacobian(g, program.outputs["xdot"].ids, [g.input("x", i) for i in range(n)])
    ids = tuple(entries.get((i, k), g.zero) for i in range(n) for k in range(n))
    return Program("jacobian", g, program.inputs, {"J": Output(ids, (n, n))}, program.defaults)


# -- machine code -----------------------------------------------------------------------------------------------


def _by_machine(task: Task) -> Outcome:
    drive = task.drive
    program = right_hand_side(task.model, drive, canonical=task.method in SYMPLECTIC)

    def make() -> Solver:
        events = None
        if task.events:
            events = Events(
                _event_program(task, program),
                tuple(e.direction for e in task.events),
                tuple(e.terminal for e in task.events),
                tuple(bool(e.reset) for e in task.events),
            )
        rows = projection(task.model, program, project=task.project)
        return Solver(program, task.method, events=events, projection=rows)

    key = ("solver", task.method, frozenset(drive.feedback.items()), _event_key(task), task.project)
    solver: Solver = remembered(task.model, key, make)
    x0 = _to_momenta(task, task.x0) if task.method in SYMPLECTIC else task.x0
    return outcome_of(task, solver.solve(x0, task.times, **solver_options(task)))


def solver_options(task: Task) -> dict[str, Any]:
    """What a solver takes besides the start and the times: inputs, parameters, tolerances and limits."""
    drive, times, bounds = task.drive, task.times, task.bounds
    start, end = float(times[0]), float(times[-1])
    return {
        "u": drive.at(times[:1], task.x0[np.newaxis])[0] if drive.constant else Signals(*drive.pieces(start, end)),
        "p": task.p,
        "step": task.step,
        "max_steps": bounds.max_steps,
        "max_step": bounds.max_step,
        "max_events": bounds.max_events,
        "deadline": bounds.seconds,
        "rtol": task.rtol,
        "atol": task.atol,
    }


def outcome_of(task: Task, found: Solution) -> Outcome:
    """The only run of a solution, as far as its states are finite."""
    states = found.states[0]
    whole = np.isfinite(states).all(axis=1)
    kept = len(whole) if whole.all() else int(np.argmin(whole))
    status = RunStatus(int(found.status[0]))
    outcome = Outcome(
        task.times[:kept],
        states[:kept],
        status,
        float(found.reached[0]),
        found.final[0],
        int(found.steps[0]),
        int(found.rejected[0]),
        int(found.evaluations[0]),
        _hits(task, found),
        "" if status >= 0 else status.message,
        found.drift,
    )
    return resets.ended(outcome, task.states, [e.title for e in task.events])


def _hits(task: Task, found: Any) -> list[Hit]:
    """The events of the only run, with the states after those that changed it."""
    hits: list[Hit] = []
    for e in range(int(found.event_count[0]) if task.events else 0):
        k, time, before = int(found.event_index[0, e]), float(found.event_time[0, e]), found.event_state[0, e]
        hits.append(Hit(k, time, before, None, task.events[k].terminal))
    if any(task.events[h.index].reset for h in hits):
        program = right_hand_side(task.model, task.drive, canonical=task.method in SYMPLECTIC)
        kernel = resets.valued(machine.compile(_event_program(task, program)))
        for n, h in enumerate(hits):
            if task.events[h.index].reset:
                t = np.array([h.time])
                u = task.drive.at(t, h.before[np.newaxis])[0]
                hits[n] = replace(h, after=kernel(np.array(h.before), u, task.p, h.time)["after"][h.index])
    return hits


# -- momenta ----------------------------------------------------------------------------------------------------


def _to_momenta(task: Task, x: Array) -> Array:
    kernel = remembered(task.model, "momenta", lambda: machine.compile(dynamics.momenta(task.model)))
    n, size = len(task.model.coordinates), task.size
    u = np.zeros(len(task.model.inputs))  # a kinetic energy does not depend on inputs
    return np.concatenate([x[:n], kernel(np.array(x[:size]), u, task.p, float(task.times[0])), x[size:]])


def _from_momenta(task: Task, outcome: Outcome) -> Outcome:
    kernel = remembered(task.model, "velocities", lambda: machine.compile(dynamics.velocities(task.model)))
    n, size = len(task.model.coordinates), task.size
    u = np.zeros(len(task.model.inputs))

    def back(x: Array, t: Any) -> Array:
        x = np.array(x)
        x[..., n:size] = kernel(np.ascontiguousarray(x[..., :size]), u, task.p, t)
        return x

    hits = [
        replace(h, before=back(h.before, h.time), after=None if h.after is None else back(h.after, h.time))
        for h in outcome.hits
    ]
    states = back(outcome.states, outcome.times)
    return replace(outcome, states=states, final=back(outcome.final, outcome.reached), hits=hits)


# -- SciPy ------------------------------------------------------------------------------------------------------


def _by_scipy(task: Task) -> Outcome:
    drive, times, model = task.drive, task.times, task.model
    program = right_hand_side(model, drive)
    feedback = frozenset(drive.feedback.items())
    rhs = remembered(model, ("kernel", feedback), lambda: machine.compile(program))
    slope = None
    if task.method in IMPLICIT and not drive.calls_python:
        slope = remembered(model, ("jacobian", feedback), lambda: machine.compile(_jacobian(program)))
    crossings = None
    if task.events:
        watched = _event_program(task, program)
        crossings = Crossings(
            resets.valued(machine.compile(watched)),
            watched,
            task.p,
            [e.direction for e in task.events],
            [e.terminal for e in task.events],
            [bool(e.reset) for e in task.events],
        )
    outcome = integrate_scipy(
        task.method,
        rhs,
        task.x0,
        times,
        drive.legs(float(times[0]), float(times[-1])),
        task.p,
        jacobian=slope,
        crossings=crossings,
        rtol=task.rtol,
        atol=task.atol,
        over_run=task.over_run,
        bounds=task.bounds,
        projection=projection(model, program, project=task.project),
    )
    return resets.ended(outcome, task.states, [e.title for e in task.events])
