"""``system.simulate``: simulates a description once."""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian import codegen as machine
from lagrangian import dynamics
from lagrangian.advice import Advice, Argument
from lagrangian.codes import Code
from lagrangian.errors import Notice, RunError
from lagrangian.graph import Graph, Program
from lagrangian.integrate import METHODS
from lagrangian.integrate.chattering import Sticking
from lagrangian.integrate.crossings import Hit
from lagrangian.integrate.method_names import SCIPY
from lagrangian.integrate.scipy_methods import Bounds, Outcome
from lagrangian.model import Model
from lagrangian.simulate import drift, slipping, spared
from lagrangian.simulate.admission import check_masses
from lagrangian.simulate.diagnosis import message
from lagrangian.simulate.disagreement import disagreement
from lagrangian.simulate.events import events_of
from lagrangian.simulate.inputs import InputSignals, check_covers, driving
from lagrangian.simulate.integrating import Task, remembered, right_hand_side, run
from lagrangian.simulate.recorded import Occurrences
from lagrangian.simulate.settings import ATOL, DEFAULT, RTOL, SMOOTH, RunSettings, check_names, names_of
from lagrangian.simulate.starts import held, onto_constraints
from lagrangian.simulate.switching import with_stops
from lagrangian.simulate.trajectory import Trajectory
from lagrangian.values.values import Given, key_name
from lagrangian.viewed import Entries

_log = logging.getLogger(__name__)
Array = NDArray[np.float64]

IN_PYTHON = "DOP853"
"""The default method if an input is a Python function."""

KEPT = 1e-8
"""The error of the energy, relative to what moves, that the default tolerances keep over 100 s of most linkages."""

MAX_CHECKED_COORDINATES = 12
"""M is examined before a run if there are at most this many coordinates."""

OPTIONS = ("initial", "params", "inputs", *names_of(RunSettings), "settings")
"""The arguments of a run other than initial values."""


def simulate(
    model: Model,
    settings: RunSettings,
    *,
    initial: Mapping[Any, Any] | Sequence[float] | None = None,
    params: Mapping[Any, Any] | None = None,
    inputs: Mapping[Any, Any] | None = None,
    by_name: Mapping[str, Any],
) -> Trajectory:
    """Simulate a model; see `lagrangian.System.simulate`. ``by_name``: initial values, ``theta1=0.2``."""
    check_names(model, by_name, OPTIONS)
    in_file = model.settings
    for joint in in_file.get("reactions", ()):
        remembered(model, ("joint", joint), partial(dynamics.check_joint, model, joint))
    given = Given.of(model, named(model))
    dims = dict(zip(given.inputs.names, given.inputs.dims, strict=True))
    drive = driving(model, inputs, in_file.get("inputs", {}), dims)
    program = right_hand_side(model, drive)
    instants = settings.instants(model, len(program.inputs["x"]))
    check_covers(drive, float(instants[0]), float(instants[-1]))
    name = _method(settings.method, drive)
    drift.check_method(model, name)
    slipping.check_method(model, name)
    rtol, atol, smooth = _tolerances(settings, program)
    p = given.parameter_values(params)
    notices = check_masses(model, p)
    guess = initial_state(given, model, program, in_file.get("initial", {}), initial, by_name)
    told = [*map(key_name, initial if isinstance(initial, Mapping) else ()), *by_name]
    x0, moved = onto_constraints(model, guess, p, float(instants[0]), held(model, settings.fixed), told=told)
    knowing, spare = spared.of_run(model, x0, p, float(instants[0]))
    _log.info("simulating from t = %g s to %g s", instants[0], instants[-1])
    task = Task(
        knowing,
        with_stops(model, drive, p, instants),
        instants,
        x0,
        p,
        name,
        rtol,
        atol,
        None if settings.step is None else float(settings.step),
        events_of(model, settings.events),
        Bounds(settings.max_steps, settings.max_events, float(settings.max_step), settings.timeout),
        settings.project,
        smooth,
    )
    slips = slipping.run(task) if model.frictions else None
    outcome = drift.ended(run(task) if slips is None else slips.outcome, task)
    made = _trajectory(task, model, outcome, dict(zip(("rtol", "atol"), settings.tolerances, strict=True)))
    if slips is not None:
        slips.noted(made)
    said = drift.notices(task, outcome)
    made.notices = (
        *notices,
        *moved,
        *spare,
        *(_undecided(task) if made.success else ()),
        *said,
    )  # a failed run has its own message
    return _judged(made)


def run_of(task: Task, settings: Mapping[str, Any]) -> Trajectory:
    """The run of a task whose arguments were checked, in a system without friction that sticks.

    ``settings``: the tolerances to report.
    """
    return _judged(_trajectory(task, task.model, drift.ended(run(task), task), settings))


def _undecided(task: Task) -> tuple[Notice, ...]:
    """A notice if M is singular at the start of a run with few coordinates."""
    model, n = task.model, len(task.model.coordinates)
    if n > MAX_CHECKED_COORDINATES or not (
        moved := dynamics.loose(
            model, task.x0[:n].tolist(), [0.0] * len(model.inputs), task.p.tolist(), float(task.times[0])
        )
    ):
        return ()
    said = f"the mass matrix is singular there: {moved}, so that nothing decides the accelerations"
    return (Notice(Code.E203, "start of the run", said),)


def _judged(made: Trajectory) -> Trajectory:
    """The run, with an error of the energy balance in its message; it has failed if motion and energy contradict."""
    try:
        missed = made.audit.missed
        made.notices = (*made.notices, *_energy_kept(made))
    except RunError as trouble:  # an energy that is not finite somewhere must not hide the run
        missed = f"no energy balance: {trouble.what}"
    if missed and (contradiction := disagreement(made)):
        made.success, made.message = False, contradiction
    elif missed:
        made.message = Advice(made.message, "; ", missed)
    return made


def _energy_kept(made: Trajectory) -> tuple[Notice, ...]:
    """A notice if a conservative system with constraints misses its energy by more than `KEPT`, though no larger
    tolerance or step was asked for."""
    tight = made.settings["rtol"] <= RTOL and made.settings["atol"] <= ATOL
    adaptive = made.method in SCIPY or METHODS[made.method].adaptive
    if not (made.model.constraints and made.success and adaptive and tight and made.audit.conserved):
        return ()
    lost, cure = made.audit.figure, "smaller tolerances keep it"
    if lost <= KEPT:
        return ()
    if made.method in SCIPY:
        cure = "'dop853', 'taylor' and 'tsit5' keep it closer"
    said = f"it is missed by {lost:.1e} of what moves: errors of '{made.method}' add up in {made.steps} steps"
    return (Notice(Code.E511, "energy", f"{said}; {cure}"),)


def named(model: Model) -> Program:
    """The names of a model's states, inputs and parameters as the groups of a program without outputs."""
    states = (*(c.name for c in model.coordinates), *(v.name for v in model.velocities))
    groups = {"x": states, "u": tuple(u.name for u in model.inputs), "p": tuple(p.name for p in model.parameters)}
    return Program("names", Graph(), groups, {})


# -- the arguments -------------------------------------------------------------------------------------------------


def initial_state(
    given: Given, model: Model, program: Program, fallback: Mapping[str, Any], initial: Any, by_name: Mapping[str, Any]
) -> Array:
    """x at the start: given values, else those of the file, else 0 at rest."""
    values = dict.fromkeys(given.states.names, 0.0)
    values.update({c.name: c.start for c in model.coordinates})
    values.update(given.states.values(dict(fallback)))
    listed = given.states.values(initial)
    for name in by_name:
        if name in listed and initial is not None:
            raise RunError(f"'{name}' is given twice, by itself and in initial", code="E404")
    values.update(listed)
    values.update(given.states.values(by_name))
    for c in model.coordinates:
        if c.positive and not values[c.name] > 0:
            raise RunError(
                f"'{c.name}' is declared positive, and starts at {values[c.name]:g}",
                fix=Advice("give a start above 0: ", Argument("initial", "1", c.name)),
                code="E501",
            )
    extra = len(program.inputs["x"]) - len(values)
    return np.array([*values.values(), *[0.0] * extra])


def _method(method: str | None, drive: InputSignals) -> str:
    """The method to use, or a `RunError` if it cannot call an input."""
    if method is None:
        return IN_PYTHON if drive.calls_python else DEFAULT
    if method in METHODS and drive.calls_python:
        called = [u.name for u, s in zip(drive.free, drive.sources, strict=True) if callable(s)]
        raise RunError(
            f"method '{method}' runs in machine code and cannot call the Python function of input '{called[0]}'",
            fix="give the input as an expression or a table, or take one of SciPy's methods: " + ", ".join(SCIPY),
            code="E501",
        )
    return method


# -- the result ----------------------------------------------------------------------------------------------------


def _trajectory(task: Task, model: Model, outcome: Outcome, settings: Mapping[str, Any]) -> Trajectory:
    n = task.size
    t, x = outcome.times, outcome.states
    further = outcome.status != 0 and outcome.reached > t[-1]
    if further:  # the last state is stored, too, after any event that changed it
        t, x = np.append(t, outcome.reached), np.vstack([x, outcome.final])
    return Trajectory(
        model=model,
        t=t,
        y=np.ascontiguousarray(x[:, :n].T),
        status=outcome.status,
        success=outcome.status >= 0,
        message=message(task, outcome),
        method=task.method,
        nfev=outcome.evaluations,
        steps=outcome.steps,
        rejected=outcome.rejected,
        p=task.p,
        u=task.drive.at(t, x[:, :n]),
        feedback=task.drive.feedback,
        events=Entries(_occurrences(task, outcome.hits, n), "events"),
        supplied=x[:, n] if x.shape[1] > n else np.zeros(len(t)),
        jumps=_jumps(task, outcome.hits, t, n, after_last=further),
        settings=dict(settings),
        drift=None if outcome.drift is None else drift.RunDrift.of_run(outcome.drift),
        reactions=tuple(task.model.settings.get("reactions", ())),
        task=task,
    )


def _occurrences(task: Task, hits: Sequence[Hit], n: int) -> dict[str, Occurrences]:
    found: dict[str, Occurrences] = {}
    for k, e in enumerate(task.events):
        own = [h for h in hits if h.index == k]
        states = np.array([h.before[:n] for h in own]).reshape(len(own), n).T
        found[e.title] = Occurrences(np.array([h.time for h in own]), states)
    return found


def _jumps(task: Task, hits: Sequence[Hit], t: Array, n: int, *, after_last: bool) -> Array:
    """The sum of the changes of h by events, up to each time.

    A sample at the time of an event is the state before it; with ``after_last``, the last sample is the state after it.
    """
    total = np.zeros(len(t))
    changed = [h for h in hits if h.after is not None]
    if not changed:
        return total
    key = ("power", frozenset(task.drive.feedback.items()))
    kernel = remembered(
        task.model, key, lambda: machine.compile(dynamics.power_closed(dynamics.slips(task.model), task.drive.feedback))
    )
    at = np.array([h.time for h in changed])
    before = np.array([h.before[:n] for h in changed])
    after = np.array([h.after[:n] for h in changed if h.after is not None])
    h0, h1 = (kernel(x, task.drive.at(at, x), task.p, at)["h"] for x in (before, after))
    for time, gain in zip(at, h1 - h0, strict=True):
        total[t > time] += gain
    if after_last:
        total[-1] = np.sum(h1 - h0)
    return total


def _tolerances(settings: RunSettings, program: Program) -> tuple[float, float, bool]:
    """The tolerances of a step, and whether they are relative to the largest values of the run so far."""
    rtol, atol = settings.of_a_step()
    if not settings.over_run or Sticking(program):
        return rtol, atol, False
    return rtol * SMOOTH[0], atol * (SMOOTH[1] if settings.atol is None else 1.0), True
