"""``system.simulate``: from a description to a run."""

from __future__ import annotations

import inspect
import logging
import math
from collections.abc import Mapping, Sequence
from typing import Any, NoReturn

import numpy as np
from numpy.typing import NDArray

from lagrangian import codegen as machine
from lagrangian import dynamics
from lagrangian.advice import Advice, Argument
from lagrangian.codegen.arguments import numbers
from lagrangian.codes import Code
from lagrangian.errors import Notice, RunError, did_you_mean
from lagrangian.graph import Graph, Program
from lagrangian.integrate import METHODS
from lagrangian.integrate.crossings import Hit
from lagrangian.integrate.scipy_methods import SCIPY, Bounds, Outcome
from lagrangian.model import Model
from lagrangian.simulate.admission import check_masses
from lagrangian.simulate.diagnosis import message
from lagrangian.simulate.disagreement import disagreement
from lagrangian.simulate.events import Event, listed_events
from lagrangian.simulate.inputs import Driving, check_covers, driving
from lagrangian.simulate.integrating import Task, remembered, right_hand_side, run
from lagrangian.simulate.recorded import Occurrences
from lagrangian.simulate.switching import with_stops
from lagrangian.simulate.trajectory import Trajectory
from lagrangian.values.dimensions import SECOND
from lagrangian.values.values import Given, number
from lagrangian.viewed import Entries

_log = logging.getLogger(__name__)
Array = NDArray[np.float64]

SAMPLES = 1001
"""Times at which a run is sampled unless told otherwise."""

MAX_STORED = 1 << 28
"""Numbers a run may store: 2 GiB."""

DEFAULT, IN_PYTHON = "dop853", "DOP853"
"""The methods taken unless told: in machine code, and for inputs that are Python functions."""

NO_DURATION = Advice(Argument("duration", "10"), ", or duration = '10 s' under [simulate] in the model file")
"""What says how long a run is."""

SHARE = 1e-3
"""Share of the run's tolerances for one step of a method of ours or one chosen by itself: errors add up."""

FEW = 12
"""Coordinates up to which M is looked at before a run."""

FINEST = 100 * float(np.finfo(float).eps)
"""The least relative tolerance of a step that doubles can hold."""


def simulate(
    model: Model,
    duration: Any = None,
    *,
    initial: Mapping[Any, Any] | Sequence[float] | None = None,
    params: Mapping[Any, Any] | None = None,
    inputs: Mapping[Any, Any] | None = None,
    times: Any = None,
    samples: int | None = None,
    start: Any = 0.0,
    method: str | None = None,
    step: Any = None,
    rtol: float = 1e-9,
    atol: float = 1e-12,
    events: Sequence[Event] | Event = (),
    max_step: Any = math.inf,
    max_steps: int = 10_000_000,
    max_events: int = 100_000,
    timeout: float | None = None,
    **by_name: Any,
) -> Trajectory:
    """Run a model; see `lagrangian.System.simulate`.

    Values for states by name may stand beside the options: ``theta1=0.2``.
    """
    states = [*(c.name for c in model.coordinates), *(v.name for v in model.velocities)]
    for unknown in (name for name in by_name if name not in states):
        _not_a_state(model, unknown, states)
    settings = dict(model.settings)
    given = Given.of(model, _named(model))
    dims = dict(zip(given.inputs.names, given.inputs.dims, strict=True))
    drive = driving(model, inputs, settings.get("inputs", {}), dims)
    program = right_hand_side(model, drive)
    instants = _times(duration, times, samples, start, settings, len(program.inputs["x"]))
    check_covers(drive, float(instants[0]), float(instants[-1]))
    bounds = Bounds(
        _count(max_steps, "max_steps"),
        _count(max_events, "max_events"),
        _positive(max_step, "max_step", infinite=True),
        None if timeout is None else _positive(timeout, "timeout"),
    )
    name = _method(method, drive, step)
    share = 1.0 if method in SCIPY else SHARE
    p = given.parameter_values(params)
    notices = check_masses(model, p)
    _log.info("simulating from t = %g s to %g s", instants[0], instants[-1])
    task = Task(
        model,
        with_stops(model, drive, p, instants),
        instants,
        _initial(given, model, program, settings.get("initial", {}), initial, by_name),
        p,
        name,
        max(_tolerance(rtol, "rtol") * share, FINEST),
        _tolerance(atol, "atol") * share,
        None if step is None else _positive(step, "step"),
        listed_events(events),
        bounds,
    )
    made = _trajectory(task, run(task), {"rtol": rtol, "atol": atol})
    made.notices = (*notices, *(_undecided(task) if made.success else ()))  # a failed one says so itself
    return _judged(made)


def _undecided(task: Task) -> tuple[Notice, ...]:
    """A notice where M is singular at the start of a run of a few coordinates."""
    model, n = task.model, len(task.model.coordinates)
    if n > FEW or not (
        moved := dynamics.loose(
            model, task.x0[:n].tolist(), [0.0] * len(model.inputs), task.p.tolist(), float(task.times[0])
        )
    ):
        return ()
    said = f"the mass matrix is singular there: {moved}, so that nothing decides the accelerations"
    return (Notice(Code.E203, "start of the run", said),)


def _judged(made: Trajectory) -> Trajectory:
    """The run, with a missed energy balance in its message; a failed one where motion and energy contradict."""
    try:
        missed = made.audit.missed
    except RunError as trouble:  # an energy that is not finite somewhere must not hide the run
        missed = f"no energy balance: {trouble.what}"
    if missed and (contradiction := disagreement(made)):
        made.success, made.message = False, contradiction
    elif missed:
        made.message = Advice(made.message, "; ", missed)
    return made


def _named(model: Model) -> Program:
    """The names of a model's states, inputs and parameters as the groups of a program that computes nothing."""
    states = (*(c.name for c in model.coordinates), *(v.name for v in model.velocities))
    groups = {"x": states, "u": tuple(u.name for u in model.inputs), "p": tuple(p.name for p in model.parameters)}
    return Program("names", Graph(), groups, {})


# -- what was given ---------------------------------------------------------------------------------------------


def _times(
    duration: Any, times: Any, samples: int | None, start: Any, settings: Mapping[str, Any], states: int
) -> Array:
    """The times of the samples, the start first, no more than can be stored with so many states."""
    begin = number(start, "start", SECOND)
    if times is not None:
        return _listed_times(times, begin, duration, samples)
    if duration is None:
        duration = settings.get("duration")
    if duration is None:
        raise RunError("no duration is given", fix=NO_DURATION, code="E401")
    if isinstance(duration, (tuple, list)) and len(duration) == 2:
        raise RunError(
            f"the duration is one number, not a span (got {duration!r:.40})",
            fix="write simulate(10.0) to run for 10 s; start=2.0 sets the initial time",
            code="E501",
        )
    length = number(duration, "duration", SECOND)
    if length < 0:
        raise RunError(f"the duration is negative ({length:g} s)", fix="give 0 or more", code="E501")
    count = SAMPLES if samples is None else _count(samples, "samples", least=2)
    if count * states > MAX_STORED:
        raise RunError(
            f"{count} samples of {states} states are more than a run can store",
            fix=f"at most {MAX_STORED // states} samples",
            code="E505",
        )
    if length == 0:
        return np.array([begin])
    if begin + length == begin:
        raise RunError(f"a duration of {length:g} s is too short to change the time t = {begin:g}", code="E501")
    grid = np.linspace(begin, begin + length, count)
    if np.any(np.diff(grid) <= 0):
        raise RunError(
            f"{count} samples in {length:g} s are too close to each other at t = {begin:g}",
            fix="use fewer samples, or a start nearer to 0",
            code="E501",
        )
    return grid


def _listed_times(times: Any, begin: float, duration: Any, samples: int | None) -> Array:
    if duration is not None or samples is not None:
        raise RunError("times are given together with a duration or samples", code="E501")
    array = np.array(numbers(times, "times"))
    if array.ndim != 1 or not array.size:
        raise RunError(f"times must be one row of numbers (got shape {array.shape})", code="E501")
    if not np.all(np.isfinite(array)):
        raise RunError(f"time number {int(np.flatnonzero(~np.isfinite(array))[0]) + 1} is not finite", code="E502")
    if np.any(np.diff(array) <= 0):
        place = int(np.flatnonzero(np.diff(array) <= 0)[0])
        raise RunError(
            f"the times are out of order: {array[place]:g} is followed by {array[place + 1]:g}",
            fix="sort them and give each only once",
            code="E501",
        )
    if array[0] < begin:
        raise RunError(f"times begin at {array[0]:g}, before the start at {begin:g}", fix="start=…", code="E501")
    return array if array[0] == begin else np.concatenate([[begin], array])


def _initial(
    given: Given, model: Model, program: Program, fallback: Mapping[str, Any], initial: Any, by_name: Mapping[str, Any]
) -> Array:
    """x at the start: what is given over what the file says over the resting configuration."""
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
                fix=f"give a start above 0: {c.name}=…",
                code="E501",
            )
    extra = len(program.inputs["x"]) - len(values)
    return np.array([*values.values(), *[0.0] * extra])


def _not_a_state(model: Model, name: str, states: Sequence[str]) -> NoReturn:
    """A keyword that is neither an option nor a state."""
    if any(p.name == name for p in model.parameters):
        fix = Advice("it is a parameter: ", Argument("params", "…", name))
    elif any(u.name == name for u in model.inputs):
        fix = Advice("it is an input: ", Argument("inputs", "…", name))
    else:
        options = [p for p in inspect.signature(simulate).parameters if p not in ("model", "by_name")]
        fix = _meant(name, states) or did_you_mean(name, [*states, *options]) or f"states: {', '.join(states[:12])}"
    raise RunError(f"there is no option or state '{name[:64]}'", fix=fix, code="E402")


def _meant(name: str, states: Sequence[str]) -> str | None:
    """What a keyword is called here that other packages have, or that means a rate."""
    if name in ("y0", "x0", "q0", "ic", "ics", "initial_conditions", "initial_state"):
        return f"write initial={{'{states[0]}': 0.2}}, or {states[0]}=0.2"
    if name in ("t_span", "tspan", "t_end", "tend", "tf", "t", "T", "time", "t_max"):
        return "give the duration as the first argument: simulate(10.0)"
    if name in ("dt", "h", "step_size", "timestep"):
        return 'write step=0.01 with method="rk4"; samples=1001 sets the number of times in the results'
    if name in ("t_eval", "saveat", "teval"):
        return "write times=[0, 0.1, …]"
    for state in (s for s in states if s.endswith("'")):
        base = state[:-1]
        if name in (f"{base}_dot", f"{base}dot", f"d{base}", f"{base}_d", f"{base}p", f"v_{base}", f"{base}_rate"):
            return f'the rate of {base} is {state}: initial={{"{state}": …}}'
    return None


def _method(method: str | None, drive: Driving, step: Any) -> str:
    """The method that will run, or a `RunError` where it does not go with what is asked."""
    if method is None:
        method = IN_PYTHON if drive.calls_python else DEFAULT
    known = [*METHODS, *SCIPY]
    if not isinstance(method, str) or method not in known:
        same = [name for name in known if name.lower() == str(method).lower()]
        fix = f"write '{same[0]}'" if same else did_you_mean(str(method), known) or f"use one of {', '.join(known)}"
        raise RunError(f"there is no method {method!r:.40}", fix=fix, code="E402")
    if method in METHODS and drive.calls_python:
        called = [u.name for u, s in zip(drive.free, drive.sources, strict=True) if callable(s)]
        raise RunError(
            f"method '{method}' runs in machine code and cannot call the Python function of input '{called[0]}'",
            fix="give the input as an expression or a table, or take one of SciPy's methods: " + ", ".join(SCIPY),
            code="E501",
        )
    fixed = method in METHODS and not METHODS[method].adaptive
    if fixed and step is None:
        raise RunError(
            f"method '{method}' uses a constant step size, and none is given",
            fix=Advice("give ", Argument("step", "0.01")),
            code="E401",
        )
    if not fixed and step is not None:
        fix = Advice("give ", Argument("rtol"), " and ", Argument("atol"), ", or ", Argument("max_step"))
        raise RunError(f"method '{method}' chooses its step size itself", fix=fix, code="E501")
    return method


def _tolerance(value: Any, what: str) -> float:
    real = number(value, what)
    if real <= 0:
        raise RunError(f"{what} must be above 0 (got {real:g})", fix="such as 1e-9", code="E501")
    return real


def _positive(value: Any, what: str, *, infinite: bool = False) -> float:
    if infinite and isinstance(value, float) and value == math.inf:
        return value
    real = number(value, what, SECOND)
    if real <= 0:
        raise RunError(f"{what} must be above 0 (got {real:g})", fix="give a time in seconds", code="E501")
    return real


def _count(value: Any, what: str, *, least: int = 1) -> int:
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or value < least:
        raise RunError(f"{what} must be a whole number, at least {least} (got {value!r:.30})", code="E501")
    return int(value)


# -- what came of it --------------------------------------------------------------------------------------------


def _trajectory(task: Task, outcome: Outcome, settings: Mapping[str, Any]) -> Trajectory:
    n = task.size
    t, x = outcome.times, outcome.states
    further = outcome.status != 0 and outcome.reached > t[-1]
    if further:  # what was reached last is kept too, after whatever event changed it
        t, x = np.append(t, outcome.reached), np.vstack([x, outcome.final])
    return Trajectory(
        model=task.model,
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
    )


def _occurrences(task: Task, hits: Sequence[Hit], n: int) -> dict[str, Occurrences]:
    found: dict[str, Occurrences] = {}
    for k, e in enumerate(task.events):
        own = [h for h in hits if h.index == k]
        states = np.array([h.before[:n] for h in own]).reshape(len(own), n).T
        found[e.title] = Occurrences(np.array([h.time for h in own]), states)
    return found


def _jumps(task: Task, hits: Sequence[Hit], t: Array, n: int, *, after_last: bool) -> Array:
    """What events that change the state have changed h by, until each time.

    A sample at the very time of an event is of the state before it; with ``after_last`` the last one is after it.
    """
    total = np.zeros(len(t))
    changed = [h for h in hits if h.after is not None]
    if not changed:
        return total
    key = ("power", frozenset(task.drive.feedback.items()))
    kernel = remembered(
        task.model, key, lambda: machine.compile(dynamics.power_closed(task.model, task.drive.feedback))
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
