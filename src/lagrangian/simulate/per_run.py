"""What is done in each run of an ensemble: how it is integrated, what is observed, and which results are stored."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, TypeAlias

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian import dynamics
from lagrangian.advice import Advice, Argument
from lagrangian.errors import ModelError, RunError, did_you_mean
from lagrangian.integrate import METHODS, Events, Signals
from lagrangian.integrate.observe import REDUCTIONS, EventsKept, Kept, Study
from lagrangian.model import Model
from lagrangian.page.plain import plain
from lagrangian.records import dataclass
from lagrangian.simulate import slipping
from lagrangian.simulate.drift import check_method
from lagrangian.simulate.events import events_of
from lagrangian.simulate.inputs import InputSignals
from lagrangian.simulate.integrating import SYMPLECTIC, projection, remembered
from lagrangian.simulate.joint_forces import JointForce, joint_force, observed_joints
from lagrangian.simulate.quantities import quantity
from lagrangian.simulate.regime_outputs import RegimeOutputs
from lagrangian.simulate.settings import DEFAULT, RunSettings
from lagrangian.simulate.variation import TAKEN

Array: TypeAlias = NDArray[np.float64]
Outputs: TypeAlias = Mapping[str, Any] | Iterable[Any] | str | sp.Expr | None

Observable: TypeAlias = sp.Expr | JointForce

MOST_CHARACTERS = 200
"""The longest name of a result, which is also the name of a folder in a store."""


@dataclass(frozen=True, kw_only=True)
class Recording:
    """What is stored of each run; see `lagrangian.System.ensemble`."""

    outputs: Outputs = None
    reduce: str | Sequence[str] | None = ("final",)
    event_times: int = 1


def instants(model: Model, settings: RunSettings) -> Array:
    """The times of the samples, at least two, beginning with the start."""
    times = settings.instants(model, len(model.coordinates) + len(model.velocities))
    if len(times) < 2:
        fix = Advice(Argument("duration", "10"))
        raise RunError("an ensemble needs a duration above 0, or times after the start", fix=fix, code="E501")
    return times


def study_of(
    model: Model, settings: RunSettings, recording: Recording, drive: InputSignals, times: Array
) -> tuple[Study, dict[str, Observable]]:
    """What is done with every run, and the observed expressions by name.

    Raises `RunError` or `ModelError` for unknown names and values that do not fit.
    """
    method = settings.method or DEFAULT
    if method not in METHODS:
        fix = f"use one of {', '.join(METHODS)}, or run one at a time with simulate"
        raise RunError(f"method '{method}' is one of SciPy's, which are not for ensembles", fix=fix, code="E402")
    asked, kept = _kept(model, recording.outputs, recording.reduce)
    expressions = {name: x for name, x in asked.items() if not isinstance(x, JointForce)}
    joints = {name: x for name, x in asked.items() if isinstance(x, JointForce)}
    events, events_kept = _events(model, settings, recording, drive)
    check_method(model, method)
    slipping.check_method(model, method)
    signals = None if drive.constant else Signals(*drive.pieces(float(times[0]), float(times[-1])))
    canonical, feedback = method in SYMPLECTIC, frozenset(drive.feedback.items())
    make = dynamics.canonical if canonical else dynamics.closed
    rates = remembered(model, ("runs", canonical, feedback), lambda: make(dynamics.slips(model), drive.feedback))
    study = Study(
        program=rates,
        method=method,
        times=times,
        outputs=remembered(
            model,
            ("observed", tuple(expressions.items()), feedback),
            lambda: dynamics.observe_closed(dynamics.slips(model), expressions, drive.feedback),
        ),
        kept=kept,
        events=events,
        events_kept=events_kept,
        projection=projection(model, rates, project=settings.project),
        signals=signals,
        canonical=remembered(model, "canonical", lambda: (dynamics.momenta(model), dynamics.velocities(model)))
        if canonical
        else None,
        options=_accuracy(settings, method),
        solver=slipping.solver_of_runs(model, settings, method, drive) if model.frictions else None,
        regimes=RegimeOutputs(model, expressions, joints, drive.feedback) if model.frictions else None,
        further=remembered(
            model,
            ("joints", tuple(joints.items()), feedback),
            lambda: observed_joints(dynamics.slips(model), joints, drive.feedback),
        ),
    )
    return study, asked


def _accuracy(settings: RunSettings, method: str) -> dict[str, Any]:
    """The settings that determine step sizes and the ends of runs; tolerances have the same meaning as for one run."""
    options: dict[str, Any] = {name: getattr(settings, name) for name in ("max_steps", "max_events", "max_step")}
    if METHODS[method].adaptive:
        options["rtol"], options["atol"] = settings.of_a_step()
    if settings.step is not None:
        options["step"] = settings.step
    return options


def _kept(
    model: Model, outputs: Outputs, reduce: str | Sequence[str] | None
) -> tuple[dict[str, Observable], tuple[Kept, ...]]:
    """The expressions to observe by name, and the results to store of each."""
    reductions = list(reduce) if isinstance(reduce, Iterable) and not isinstance(reduce, str) else [reduce]
    for r in reductions:
        _reduction(r)
    if not reductions:
        raise RunError("reduce is empty", fix='reduce=("final",), or reduce=None for samples', code="E501")
    expressions: dict[str, Observable] = {}
    kept: dict[str, Kept] = {}
    for name, asked in _named(model, outputs):
        own, expr, title = _asked(model, name, asked)
        if expressions.setdefault(title, expr) != expr:
            raise RunError(f"two outputs are called '{title}'", fix="give them other names", code="E404")
        for r in reductions if own is None else [own]:
            result = title if r is None or (own and name) else f"{r} {title}"
            _check_result(result)
            kept[result] = Kept(result, title, r)
    if not kept:
        raise RunError("no output is given", fix="outputs=['theta1']", code="E401")
    return expressions, tuple(kept.values())


def _check_result(name: str) -> None:
    """Raise an error for a name that an array in a file cannot have, or that another result has."""
    if name in TAKEN:
        raise RunError(f"a result cannot be called '{name}'", fix=f"not one of {', '.join(sorted(TAKEN))}", code="E403")
    strange = next((c for c in name if c in "/\\" or not c.isprintable()), None)
    if strange is not None or name.startswith(".") or len(name) > MOST_CHARACTERS:
        why = f"its {strange!r}" if strange else "its first character" if name.startswith(".") else "its length"
        shown = name if len(name) <= 60 else name[:59] + "…"
        raise RunError(
            f"{shown!r} cannot be the name of a result, for {why}",
            fix='give it a name: {"half": "theta/2"}, or half=theta/2',
            code="E702",
        )


def _reduction(name: Any) -> None:
    if name is not None and name not in REDUCTIONS:
        fix = did_you_mean(str(name), REDUCTIONS) or f"use one of {', '.join(REDUCTIONS)}"
        raise RunError(f"there is no reduction {name!r:.40}", fix=fix, code="E402")


def _named(model: Model, outputs: Outputs) -> list[tuple[str | None, Any]]:
    """Outputs with the names that were given, if any."""
    if outputs is None:
        return [(None, s.symbol) for s in (*model.coordinates, *model.velocities)]
    if isinstance(outputs, Mapping):
        return [(str(name), asked) for name, asked in outputs.items()]
    if isinstance(outputs, str) or not isinstance(outputs, Iterable):
        return [(None, outputs)]
    return [(None, asked) for asked in outputs]


def _asked(model: Model, name: str | None, asked: Any) -> tuple[str | None, Observable, str]:
    """The reduction that an output requests ("max theta1"), its expression, and its name."""
    if isinstance(asked, sp.Expr):
        return None, asked, name or plain(asked)
    if not isinstance(asked, str):
        raise RunError(f"an output is text or an expression (got {type(asked).__name__})", code="E501")
    first, space, rest = asked.strip().partition(" ")
    own = first if space and first in REDUCTIONS else None
    text = rest.strip() if own else asked.strip()
    if (force := joint_force(model, text)) is not None:
        return own, force, name or text
    try:
        expr = quantity(model, text, f"output '{text[:40]}'")
    except ModelError as trouble:
        if space and own is None and rest[:1].isidentifier() and first.isidentifier() and first not in model.symbols:
            raise RunError(
                f"there is no reduction '{first[:40]}'",
                fix=did_you_mean(first, REDUCTIONS) or f"use one of {', '.join(REDUCTIONS)}",
                code="E402",
            ) from None
        raise trouble
    return own, expr, name or text


def _events(
    model: Model, settings: RunSettings, recording: Recording, drive: InputSignals
) -> tuple[Events | None, tuple[EventsKept, ...]]:
    listed = events_of(model, settings.events)
    if not listed:
        return None, ()
    titles = [e.title for e in listed]
    for title in titles:
        _check_result(f"count {title}")
    times = recording.event_times
    if isinstance(times, bool) or not isinstance(times, int) or not 1 <= times <= 10_000:
        raise RunError(f"event_times, the number of times to keep, must be at least 1 (got {times!r:.30})", code="E501")
    make = dynamics.canonical_impacts if settings.method in SYMPLECTIC else dynamics.impacts
    program = make(model, [(e.title, e.expression, e.reset) for e in listed], drive.feedback)
    directions, terminal = tuple(e.direction for e in listed), tuple(e.terminal for e in listed)
    made = Events(program, directions, terminal, tuple(bool(e.reset) for e in listed))
    return made, tuple(EventsKept(title, k, times) for k, title in enumerate(titles))
