"""``system.ensemble`` and ``system.sweep``: simulate a description many times."""

from __future__ import annotations

import hashlib
import importlib.metadata
import math
import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import cache
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from lagrangian.advice import Advice
from lagrangian.errors import RunError
from lagrangian.graph import Program
from lagrangian.integrate import Projection
from lagrangian.integrate.chunks import FEW, Portions, cut
from lagrangian.integrate.design import Design
from lagrangian.integrate.ensemble import Executor, Here, Memory, Progress, carry_out
from lagrangian.integrate.estimate import ask
from lagrangian.integrate.observe import Kept, Study
from lagrangian.integrate.places import place
from lagrangian.integrate.store import ChunkPlan, Variable, create, resume
from lagrangian.integrate.stored import explained
from lagrangian.model import Model
from lagrangian.page.plain import plain
from lagrangian.simulate import spared
from lagrangian.simulate.admission import check_masses, fitness
from lagrangian.simulate.drift import of_runs
from lagrangian.simulate.ensemble import Ensemble
from lagrangian.simulate.inputs import InputSignals, check_covers, driving
from lagrangian.simulate.integrating import remembered
from lagrangian.simulate.joint_forces import JointForce
from lagrangian.simulate.per_run import Observable, Recording, instants, study_of
from lagrangian.simulate.plot import Units
from lagrangian.simulate.settings import STORE, Execution, RunSettings, check_names, chosen, names_of, picked, whole
from lagrangian.simulate.starts import held, starts_of_runs
from lagrangian.simulate.switching import with_stops_of_all
from lagrangian.simulate.variation import EVENT, TIME, Varying, from_arrays, from_grid
from lagrangian.values.values import key_name

Array: TypeAlias = NDArray[np.float64]

OPTIONS = tuple(
    name
    for name in ("initial", "params", "inputs", *names_of(RunSettings, Recording, Execution), "settings", "execution")
    if name not in ("samples", "timeout")
)
"""The arguments of an ensemble other than initial values."""

MAX_CHUNK_BYTES = 2**30
"""The largest size of a chunk on disk in bytes: compressors accept at most 2 GiB at a time."""

DRIFT_WORDS = {
    "drift position": "largest residual of a constraint on positions at the end of a step, before correction",
    "drift velocity": "largest residual of a constraint on velocities at the end of a step, before correction",
    "drift left": "largest residual of a constraint after correction",
    "drift margin": "least margin by which the constraints are independent",
}
"""What is kept of every run of a system with constraints."""

MOST_MEMORY = 0.5
"""The fraction of the machine's memory that results without a store may take."""


def options(given: Mapping[str, Any]) -> tuple[RunSettings, Recording, Execution]:
    """Return the options from all arguments of a verb; a number of times becomes a number of samples."""
    settings: RunSettings | None = given["settings"]
    if settings is None:
        times = given["times"]
        counted = np.ndim(times) == 0
        sampled = {"samples": whole(times, "times", least=2), "times": None} if counted else {"times": times}
        settings = picked(RunSettings, {**given, **sampled})
    elif settings.timeout is not None:
        raise RunError(
            "a timeout applies only to a single run",
            fix="max_steps=100000 in the settings bounds each run",
            code="E501",
        )
    return settings, picked(Recording, given), chosen(Execution, given, "execution")


def ensemble(
    model: Model,
    settings: RunSettings,
    recording: Recording,
    execution: Execution,
    *,
    initial: Mapping[Any, Any] | None,
    params: Mapping[Any, Any] | None,
    inputs: Mapping[Any, Any] | None,
    dims: Sequence[str] | None,
    by_name: Mapping[str, Any],
) -> Ensemble:
    """Simulate many runs from arrays; see `lagrangian.System.ensemble`. ``by_name``: initial values, ``theta1=[0.1,
    0.2]``."""
    check_names(model, by_name, (*OPTIONS, "dims"))
    varied, driven = _split_inputs(inputs)
    varying = from_arrays(model, {"x": {**(initial or {}), **by_name}, "p": params, "u": varied}, dims)
    return _done(model, varying, settings, recording, driven, execution)


def sweep(
    model: Model,
    grid: Mapping[Any, Any] | Iterable[str] | str,
    settings: RunSettings,
    recording: Recording,
    execution: Execution,
    *,
    initial: Mapping[Any, Any] | None,
    params: Mapping[Any, Any] | None,
    inputs: Mapping[Any, Any] | None,
    draws: int | None,
    seed: int,
    by_name: Mapping[str, Any],
) -> Ensemble:
    """Simulate every combination of values; see `lagrangian.System.sweep`."""
    check_names(model, by_name, (*OPTIONS, "grid", "draws", "seed"))
    varying = from_grid(model, grid, {"x": {**(initial or {}), **by_name}, "p": params}, draws, seed)
    return _done(model, varying, settings, recording, dict(inputs or {}), execution)


def _split_inputs(inputs: Mapping[Any, Any] | None) -> tuple[dict[Any, Any], dict[Any, Any]]:
    """Split inputs into arrays of constants, one for each run, and others: numbers, expressions, tables."""
    varied, driven = {}, {}
    for key, value in (inputs or {}).items():
        array = (isinstance(value, np.ndarray) and value.ndim > 0) or isinstance(value, list)
        (varied if array else driven)[key] = value
    return varied, driven


# -- what every run does ----------------------------------------------------------------------------------------


def _done(
    model: Model,
    varying: Varying,
    settings: RunSettings,
    recording: Recording,
    inputs: dict[Any, Any],
    execution: Execution,
) -> Ensemble:
    """Compute the runs, or those that are missing."""
    drive = _drive(model, varying, inputs)
    times = instants(model, settings)
    check_covers(drive, float(times[0]), float(times[-1]))
    design = varying.design()
    drive, stops = with_stops_of_all(model, drive, design, times, float(settings.max_step))
    varied = [name for group, name in varying.columns if group == "p"]
    check_masses(model, design.base["p"], varied)
    closing = starts_of_runs(model, held(model, settings.fixed))
    knowing, spare = spared.of_runs(model, design, closing, float(times[0]))
    study, expressions = study_of(knowing, settings, recording, drive, times)
    study = replace(study, closing=closing)
    said = (*stops, *map(str, spare))
    (fit,) = remembered(model, ("fitness", *varied), lambda: (fitness(model, varied),))
    study = replace(study, fitness=fit)
    task = _task(model, varying, drive, study)
    if model.frictions and execution.scheduler is not None:
        raise RunError(
            f"runs with {model.frictions[0].title} are not sent to other machines",
            fix="leave out scheduler: the runs are computed here, one after another",
            code="E501",
        )
    executor, cutting = _executor(execution)
    memory = execution.memory if execution.store is None else min(execution.memory, MAX_CHUNK_BYTES)
    portions = cut(design.shape, study.bytes_per_run, memory=memory, **cutting)
    plan = _plan(model, varying, study, expressions, portions, task)

    def confirm(runs: int) -> None:
        if execution.confirm is not None:
            ask(execution.confirm, study, design, runs, _size(plan), executor)

    if execution.store is None:
        confirm(design.count)
        made = _in_memory(study, design, plan, executor, execution.progress)
        made.notices = (*said, *_drifted(made, study))
        return made
    path = place(execution.store)
    with explained(path, "open"):
        again = execution.resume and path.exists()
    if not again:
        confirm(design.count)
    with resume(path, plan) if again else create(path, plan, overwrite=execution.overwrite) as sink:
        if again:
            confirm(sum(stop - start for start, stop in map(sink.portions.range, np.flatnonzero(~sink.done).tolist())))
        carry_out(study, design, sink.portions, sink, executor=executor, progress=execution.progress)
    made = Ensemble.of_store(execution.store)
    made.notices = (*said, *sink.notices, *_drifted(made, study))
    return made


def _drifted(made: Ensemble, study: Study) -> tuple[str, ...]:
    """The notice about the drift of the runs from their constraints."""
    if study.projection is None:
        return ()
    found = (made[f"drift {name}"] for name in ("position", "velocity", "margin", "left"))
    return of_runs(study.method, study.projection.corrects, *found)


def _size(plan: ChunkPlan) -> int:
    """The size of the results in bytes."""
    return sum(np.dtype(v.dtype).itemsize * math.prod(v.shape) for v in plan.results.values())


def _in_memory(
    study: Study, design: Design, plan: ChunkPlan, executor: Executor, progress: Progress | None
) -> Ensemble:
    size = _size(plan)
    if size > MOST_MEMORY * _machine_memory():
        raise RunError(
            f"the results of {design.count} runs take {size / 2**30:.3g} GiB",
            fix=Advice("keep less of each run, or write to a store: ", STORE),
            code="E505",
        )
    sink = Memory(study, plan.portions)
    carry_out(study, design, plan.portions, sink, executor=executor, progress=progress)
    coordinates = {
        name: (variable.dims, np.concatenate([np.atleast_1d(a) for a in parts]).reshape(variable.shape))
        for name, (variable, parts) in plan.coordinates.items()
    }
    dims = {name: variable.dims for name, variable in plan.results.items()}
    words = {name: variable.words for name, variable in plan.results.items()}
    words.update({name: variable.words for name, (variable, _) in plan.coordinates.items()})
    return Ensemble(str(plan.task["system"]), sink.arrays, dims, coordinates, words, plan.task)


def _machine_memory() -> float:
    try:
        return float(os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"))
    except (AttributeError, ValueError, OSError):  # unknown on this system: 4 GiB are nearly always available
        return 4.0 * 2**30


def _executor(execution: Execution) -> tuple[Executor, dict[str, int]]:
    """Who computes the runs, and the size of chunks that it needs."""
    if execution.scheduler is None:
        return Here(execution.threads), {}
    from lagrangian.integrate.remote import Dask

    dask = Dask(execution.scheduler)
    return dask, {"held": dask.held, "few": max(FEW, 8 * dask.threads)}


def _drive(model: Model, varying: Varying, inputs: dict[Any, Any]) -> InputSignals:
    """The inputs that do not vary; an input given twice is an error."""
    varied = {name for group, name in varying.columns if group == "u"}
    for key in inputs:
        if key_name(key) in varied:
            raise RunError(
                f"input '{key_name(key)}' varies and also has a fixed value",
                fix="give only one of the two",
                code="E404",
            )
    settings = {k: v for k, v in model.settings.get("inputs", {}).items() if k not in varied}
    names = varying.entries.given.inputs
    drive = driving(model, inputs, settings, dict(zip(names.names, names.dims, strict=True)))
    if drive.calls_python:
        raise RunError(
            "an input of an ensemble cannot be a Python function",
            fix="give an expression of time and state, a table, or numbers; or run one at a time with simulate",
            code="E501",
        )
    if varied and not drive.constant:
        raise RunError(
            f"input '{min(varied)}' varies from run to run while another is a table",
            fix="give the table as an expression of time, with a parameter for what varies",
            code="E501",
        )
    for u, source in zip(drive.free, drive.sources, strict=True):
        if isinstance(source, float):
            varying.entries.base["u"][u.name] = source
    feedback = {plain(symbol) for symbol in drive.feedback}
    varying.entries.base["u"] = {n: v for n, v in varying.entries.base["u"].items() if n not in feedback}
    return drive


# -- description of the results --------------------------------------------------------------------------------


def _plan(
    model: Model,
    varying: Varying,
    study: Study,
    expressions: Mapping[str, Observable],
    portions: Portions,
    task: dict[str, Any],
) -> ChunkPlan:
    fields, units = study.fields(), Units(model)
    dims = varying.dims(fields)
    made_of = {k.name: (k, _unit(expressions[k.of], units)) for k in study.kept}
    results = {}
    for name, (dtype, extra) in fields.items():
        more = () if not extra else (EVENT,) if name.startswith("time ") else (TIME,)
        results[name] = Variable(dtype, (*dims, *more), (*portions.shape, *extra), _words(made_of, name))
    coordinates: dict[str, Any] = dict(varying.coordinates(fields, units))
    if any(k.reduction is None for k in study.kept):
        words = {"units": "s", "long_name": "time"}
        coordinates[TIME] = Variable("float64", (TIME,), study.times.shape, words), [study.times]
    beside = " ".join(
        name for name, (variable, _) in coordinates.items() if (name,) != variable.dims and " " not in name
    )
    words = {"title": model.name, **({"coordinates": beside} if beside else {})}
    return ChunkPlan(portions, results, coordinates, task, words)


def _unit(asked: Observable, units: Units) -> str:
    return asked.unit if isinstance(asked, JointForce) else units.of(asked)


def _words(made_of: Mapping[str, tuple[Kept, str]], name: str) -> dict[str, Any]:
    """Long name and unit of a result."""
    if name in made_of:
        kept, unit = made_of[name]
        words = name if kept.reduction is None else f"{kept.reduction} of {kept.of}"
        return {"long_name": words, **({"units": unit} if unit else {})}
    if name == "status":
        return {"long_name": "how the run ended: 0 its end, 1 a terminal event, negative a failure, -128 not run yet"}
    if name in DRIFT_WORDS:
        return {"long_name": DRIFT_WORDS[name]}
    if name == "reached":
        return {"long_name": "time of the last state", "units": "s"}
    return {"long_name": name, **({"units": "s"} if name.startswith("time ") else {})}


def _task(model: Model, varying: Varying, drive: InputSignals, study: Study) -> dict[str, Any]:
    """The task as plain data: tasks with equal data have identical results."""
    times = study.times
    return {
        "version": _version(),
        "system": model.name,
        "equations": digest(study.program),
        **varying.task(),
        "inputs": {
            **{plain(symbol): str(expr) for symbol, expr in drive.feedback.items()},
            **{u.name: _source(s) for u, s in zip(drive.free, drive.sources, strict=True)},
        },
        "times": f"{len(times)} from {float(times[0])} to {float(times[-1])} #{_hash(times.tobytes())}",
        "method": study.method,
        "options": {k: v if np.isfinite(v) else str(v) for k, v in study.options.items()},
        "kept": [k.name for k in study.kept],
        "outputs": digest(study.outputs),
        **({"further": [digest(more.program) for more in study.further]} if study.further else {}),
        "events": "none" if study.events is None else _events(study),
        **({} if study.projection is None else {"projection": _projection(study.projection)}),
        **({"friction": [str(f.sticking_limit) for f in model.frictions]} if model.frictions else {}),
    }


@cache
def _version() -> str:
    return importlib.metadata.version("lagrangian")


def _events(study: Study) -> str:
    """The events, how many times of each are stored, and everything that determines their effect."""
    e = study.events
    named = [f"{kept.name} {kept.times}" for kept in study.events_kept]
    return f"{named} #{_hash(repr((e.direction, e.terminal, e.reset, digest(e.program))).encode())}"


def _projection(projection: Projection) -> str:
    """The settings that determine how runs are kept on their constraints."""
    return f"{projection.corrects} {[digest(program) for program in projection.programs]}"


def _source(source: Any) -> Any:
    if isinstance(source, float):
        return source
    return f"table #{_hash(source.times.tobytes() + source.values.tobytes() + bytes([source.hold]))}"


def digest(program: Program) -> str:
    """A short text that differs if two programs compute different functions."""
    return program.remembered("digest", lambda: _digest(program))


def _digest(program: Program) -> str:
    said: list[Any] = [sorted(program.inputs.items()), [(n, o.ids, o.shape) for n, o in program.outputs.items()]]
    return _hash(repr([*said, program.graph.nodes]).encode())


def _hash(data: bytes) -> str:
    return hashlib.blake2b(data, digest_size=8).hexdigest()
