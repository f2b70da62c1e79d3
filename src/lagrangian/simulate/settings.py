"""The options of runs, checked in one place for single runs and ensembles: integration and execution."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import fields
from pathlib import Path
from typing import Any, TypeAlias, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lagrangian.advice import Advice, Argument
from lagrangian.codegen.arguments import numbers
from lagrangian.errors import RunError, did_you_mean
from lagrangian.integrate import METHODS
from lagrangian.integrate.chunks import MEMORY
from lagrangian.integrate.ensemble import Progress
from lagrangian.integrate.estimate import Confirm
from lagrangian.integrate.method_names import MULTISTEP, SCIPY
from lagrangian.model import Model
from lagrangian.records import dataclass
from lagrangian.simulate.events import Event, listed_events
from lagrangian.values.dimensions import NONE, SECOND
from lagrangian.values.values import number

Array: TypeAlias = NDArray[np.float64]
Options = TypeVar("Options")

SAMPLES = 1001
"""The default number of times at which a run is sampled."""

MAX_STORED = 1 << 28
"""The largest number of values that a run may store: 2 GiB."""

DEFAULT = "dop853"
"""The default method, in machine code."""

STORE = Argument("store", '"sweep.zarr"')
"""The ending of stores on disk."""

RTOL, ATOL = 1e-9, 1e-12
"""The default tolerances of a run, whichever method it uses."""

STEP_SHARE = 1e-3
"""The fraction of a run's tolerances for one step, because errors add up. Values given to SciPy's methods are used as
they are."""

SHARES = {"Radau": (1.0, 1.0), "RK23": (1e-2, 1e-2), "BDF": (1e-2, 1e-2), "LSODA": (1e-2, 1e-2)}
"""Other fractions, of ``rtol`` and of ``atol``: Radau's steps are more accurate than its estimate, which is of lower
order; RK23 would take too many steps; and the corrector of BDF and LSODA does not get below rounding.
"""

SMOOTH = (1e-2, 10.0)
"""Factors of these for BDF and LSODA where ẋ does not jump (`RunSettings.over_run`): they keep their order with smaller
errors, and lower it where rounding in a component that stays near zero is more than ``atol``."""

FINEST_RTOL = 100 * float(np.finfo(float).eps)
"""The smallest relative tolerance of a step that is possible with doubles."""


@dataclass(frozen=True, kw_only=True)
class RunSettings:
    """The duration of a run, the times of its samples, and how it is integrated; see `lagrangian.System.simulate`.

    >>> import lagrangian as lg
    >>> fine = lg.RunSettings(duration="2 s", rtol=1e-12, samples=11)
    >>> len(lg.example("pendulum").simulate(settings=fine, theta=0.5).t)
    11

    Texts with a unit are converted to SI numbers. Raises `RunError` for a value that does not fit.
    """

    duration: float | str | None = None
    times: ArrayLike | Sequence[float | str] | None = None
    samples: int | None = None
    start: float | str = 0.0
    method: str | None = None
    step: float | str | None = None
    rtol: float | None = None
    atol: float | None = None
    events: Sequence[Event] | Event = ()
    fixed: Sequence[Any] | str | None = None
    project: bool = True
    max_step: float | str = math.inf
    max_steps: int = 10_000_000
    max_events: int = 100_000
    timeout: float | None = None

    def __post_init__(self) -> None:
        if self.times is not None and (self.duration is not None or self.samples is not None):
            raise RunError("times are given together with a duration or samples", code="E501")
        _checked(self, {name: check for name, check in _CHECKS.items() if getattr(self, name) is not None})
        _check_method(self.method, self.step)

    def instants(self, model: Model, states: int) -> Array:
        """Return the times of the samples, beginning with the start, if that many states can be stored.

        The default duration is that of the model file. Raises `RunError` if there is none, and if the times are too
        close to be distinct doubles.
        """
        begin = float(self.start)
        if self.times is not None:
            listed = np.array(self.times, float)
            if listed[0] < begin:
                raise RunError(
                    f"times begin at {listed[0]:g}, before the start at {begin:g}", fix="start=…", code="E501"
                )
            return listed if listed[0] == begin else np.concatenate([[begin], listed])
        duration = model.settings.get("duration") if self.duration is None else self.duration
        if duration is None:
            fix = Advice(Argument("duration", "10"), ", or duration = '10 s' under [simulate] in the model file")
            raise RunError("no duration is given", fix=fix, code="E401")
        length = _duration(duration, "duration")
        count = SAMPLES if self.samples is None else self.samples
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

    @property
    def tolerances(self) -> tuple[float, float]:
        """The relative and the absolute tolerance, `RTOL` and `ATOL` if they are not given."""
        return RTOL if self.rtol is None else self.rtol, ATOL if self.atol is None else self.atol

    @property
    def over_run(self) -> bool:
        """Whether errors are measured by the largest values of the run so far: by BDF and LSODA without ``rtol``."""
        return self.method in MULTISTEP and self.rtol is None

    def of_a_step(self) -> tuple[float, float]:
        """Return the relative and the absolute tolerance of one step; values given to SciPy's methods are these."""
        relative, absolute = self.tolerances
        known, shares = self.method in SCIPY, SHARES.get(self.method or "", (STEP_SHARE, STEP_SHARE))
        relative *= 1.0 if known and self.rtol is not None else shares[0]
        absolute *= 1.0 if known and self.atol is not None else shares[1]
        return max(relative, FINEST_RTOL), absolute


@dataclass(frozen=True, kw_only=True)
class Execution:
    """How the runs of an ensemble are executed, and where their results are stored; see `lagrangian.System.ensemble`.

    Raises `RunError` for a value that does not fit.
    """

    memory: int = MEMORY
    threads: int | None = None
    progress: Progress | None = None
    confirm: Confirm | None = None
    store: str | Path | None = None
    resume: bool = False
    overwrite: bool = False
    scheduler: Any = None

    def __post_init__(self) -> None:
        _checked(self, {"memory": whole} if self.threads is None else {"memory": whole, "threads": whole})
        if self.progress is not None and not callable(self.progress):
            raise RunError(
                f"progress must be a function (got {self.progress!r:.30})",
                fix="progress=lambda done, all: print(done, all)",
                code="E501",
            )
        if self.confirm is not None and not callable(self.confirm):
            raise RunError(
                f"confirm must be a function (got {self.confirm!r:.30})",
                fix="confirm=lambda estimate: estimate.seconds < 3600",
                code="E501",
            )
        if self.store is None and (self.resume or self.overwrite):
            raise RunError("resume and overwrite apply only to a store", fix=Advice(STORE), code="E501")
        if self.resume and self.overwrite:
            raise RunError(
                "a store is either continued or replaced, not both", fix="give resume or overwrite", code="E501"
            )
        if self.store is not None and not isinstance(self.store, (str, Path)):
            raise RunError(
                f"a store must be text or a Path (got {type(self.store).__name__})", fix=Advice(STORE), code="E501"
            )
        if self.store is not None and Path(self.store).suffix != ".zarr":
            raise RunError(f"the store '{Path(self.store).name}' must end in .zarr", fix=Advice(STORE), code="E801")


def whole(value: Any, what: str, *, least: int = 1) -> int:
    """Return a whole number. Raises `RunError` for anything else, and for a number below ``least``."""
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or value < least:
        raise RunError(f"{what} must be a whole number, at least {least} (got {value!r:.30})", code="E501")
    return int(value)


def check_names(model: Model, by_name: Iterable[str], options: Iterable[str]) -> None:
    """Raise `RunError` for a keyword that is not a state of the model, and suggest a state or an option.

    ``options``: the names of the options of the verb.
    """
    states = [*(c.name for c in model.coordinates), *(v.name for v in model.velocities)]
    for name in by_name:
        if name in states:
            continue
        if any(p.name == name for p in model.parameters):
            fix = Advice("it is a parameter: ", Argument("params", "…", name))
        elif any(u.name == name for u in model.inputs):
            fix = Advice("it is an input: ", Argument("inputs", "…", name))
        else:
            fix = _meant(name, states, options) or did_you_mean(name, [*states, *options])
            fix = fix or f"states: {', '.join(states[:12])}"
        raise RunError(f"there is no option or state '{name[:64]}'", fix=fix, code="E402")


def picked(kind: type[Options], given: Mapping[str, Any]) -> Options:
    """Return the options of one kind from all arguments of a verb."""
    return kind(**{name: given[name] for name in names_of(kind) if name in given})


def chosen(kind: type[Options], given: Mapping[str, Any], name: str) -> Options:
    """Return the argument ``name`` of a verb, a whole settings object, or make one from the verb's other arguments."""
    return picked(kind, given) if given[name] is None else given[name]


def check_given_once(given: Mapping[str, Any]) -> None:
    """Raise `RunError` if an option is given beside the settings object that contains it.

    ``given``: the arguments that were written in the call of a verb. None counts as not given.
    """
    for name, article, kind in (("settings", "a", RunSettings), ("execution", "an", Execution)):
        whole = given.get(name)
        if whole is None:
            continue
        if not isinstance(whole, kind):
            raise RunError(
                f"{name} must be {article} {kind.__name__} (got {type(whole).__name__})",
                fix=f"{name}=lagrangian.{kind.__name__}(…)",
                code="E501",
            )
        for option in names_of(kind):
            if given.get(option) is not None:
                raise RunError(
                    f"'{option}' is given twice: as an argument, and in {name}",
                    fix=f"{name}=dataclasses.replace({name}, {option}=…)",
                    code="E404",
                )


def names_of(*settings: type) -> tuple[str, ...]:
    """Return the names of the options in dataclasses."""
    return tuple(field.name for kind in settings for field in fields(kind))


def _checked(settings: Any, checks: Mapping[str, Callable[[Any, str], Any]]) -> None:
    """Replace the fields by the values that the checks return."""
    for name, check in checks.items():
        object.__setattr__(settings, name, check(getattr(settings, name), name))


def _time(value: Any, what: str) -> float:
    return number(value, what, SECOND)


def _positive(value: Any, what: str) -> float:
    if isinstance(value, float) and value == math.inf and what == "max_step":
        return value
    seconds = _time(value, what)
    if seconds <= 0:
        raise RunError(f"{what} must be above 0 (got {seconds:g})", fix="give a time in seconds", code="E501")
    return seconds


def _tolerance(value: Any, what: str) -> float:
    real = number(value, what, NONE)
    if real <= 0:
        raise RunError(f"{what} must be above 0 (got {real:g})", fix="such as 1e-9", code="E501")
    return real


def _truth(value: Any, what: str) -> bool:
    if not isinstance(value, (bool, np.bool_)):
        raise RunError(f"{what} is True or False (got {value!r:.30})", code="E501")
    return bool(value)


def _duration(value: Any, what: str) -> float:
    if isinstance(value, (tuple, list)) and len(value) == 2:
        raise RunError(
            f"the {what} is one number, not a span (got {value!r:.40})",
            fix="write simulate(10.0) to run for 10 s; start=2.0 sets the initial time",
            code="E501",
        )
    seconds = _time(value, what)
    if seconds < 0:
        raise RunError(f"the {what} is negative ({seconds:g} s)", fix="give 0 or more", code="E501")
    return seconds


def _times(value: Any, what: str) -> tuple[float, ...]:
    """Return increasing times in seconds."""
    if isinstance(value, (tuple, list)) and any(isinstance(time, str) for time in value):
        value = [_time(time, "a time") for time in value]
    array = np.array(numbers(value, what))
    if array.ndim != 1 or not array.size:
        raise RunError(f"{what} must be one row of numbers (got shape {array.shape})", code="E501")
    if not np.all(np.isfinite(array)):
        raise RunError(f"time number {int(np.flatnonzero(~np.isfinite(array))[0]) + 1} is not finite", code="E502")
    if np.any(np.diff(array) <= 0):
        place = int(np.flatnonzero(np.diff(array) <= 0)[0])
        raise RunError(
            f"the {what} are out of order: {array[place]:g} is followed by {array[place + 1]:g}",
            fix="sort them and give each only once",
            code="E501",
        )
    return tuple(array.tolist())


_CHECKS: dict[str, Callable[[Any, str], Any]] = {
    "duration": _duration,
    "times": _times,
    "samples": lambda value, what: whole(value, what, least=2),
    "start": _time,
    "step": _positive,
    "rtol": _tolerance,
    "atol": _tolerance,
    "project": _truth,
    "events": lambda value, _: listed_events(value),
    "max_step": _positive,
    "max_steps": whole,
    "max_events": whole,
    "timeout": _positive,
}


def _check_method(method: Any, step: Any) -> None:
    """Raise `RunError` for an unknown method, or one that does not fit the step."""
    known = [*METHODS, *SCIPY]
    if method is not None and (not isinstance(method, str) or method not in known):
        same = [name for name in known if name.lower() == str(method).lower()]
        fix = f"write '{same[0]}'" if same else did_you_mean(str(method), known) or f"use one of {', '.join(known)}"
        raise RunError(f"there is no method {method!r:.40}", fix=fix, code="E402")
    fixed = method in METHODS and not METHODS[str(method)].adaptive
    if fixed and step is None:
        raise RunError(
            f"method '{method}' uses a constant step size, and none is given",
            fix=Advice("give ", Argument("step", "0.01")),
            code="E401",
        )
    if not fixed and step is not None:
        fix = Advice("give ", Argument("rtol"), " and ", Argument("atol"), ", or ", Argument("max_step"))
        raise RunError(f"method '{method or DEFAULT}' chooses its step size itself", fix=fix, code="E501")


def _meant(name: str, states: Sequence[str], options: Iterable[str]) -> str | None:
    """The option here for a keyword of other packages, or the state for one that means a rate."""
    if name in ("y0", "x0", "q0", "ic", "ics", "initial_conditions", "initial_state"):
        return f"write initial={{'{states[0]}': 0.2}}, or {states[0]}=0.2"
    if name in ("t_span", "tspan", "t_end", "tend", "tf", "t", "T", "time", "t_max"):
        return "give the duration as the first argument: simulate(10.0)"
    count = "samples=1001" if "samples" in options else "times=1001"
    if name in ("dt", "h", "step_size", "timestep"):
        return f'write step=0.01 with method="rk4"; {count} sets the number of times in the results'
    if name in ("t_eval", "saveat", "teval"):
        return "write times=[0, 0.1, …]"
    if name == "timeout":
        return "max_steps=100000 bounds each run"
    if name == "samples":
        return f"{count} sets the number of times" + (", draws=1000 that of the draws" if "draws" in options else "")
    for state in (s for s in states if s.endswith("'")):
        base = state[:-1]
        if name in (f"{base}_dot", f"{base}dot", f"d{base}", f"{base}_d", f"{base}p", f"v_{base}", f"{base}_rate"):
            return f'the rate of {base} is {state}: initial={{"{state}": …}}'
    return None
