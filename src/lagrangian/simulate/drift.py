"""The drift of a run from its constraints, and the notices about it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import fields, replace

import numpy as np
from numpy.typing import NDArray

from lagrangian import dynamics
from lagrangian.codes import Code
from lagrangian.errors import Notice, RunError
from lagrangian.graph import Program, evaluate
from lagrangian.integrate import METHODS, Drift, RunStatus
from lagrangian.integrate.method_names import MULTISTEP
from lagrangian.integrate.projection import BRANCHING, BREAKS, at_branch
from lagrangian.integrate.scipy_methods import Outcome
from lagrangian.model import Model
from lagrangian.model.rows import rows_of
from lagrangian.records import dataclass
from lagrangian.simulate.integrating import SYMPLECTIC, Task, remembered
from lagrangian.simulate.resets import cut_at
from lagrangian.viewed import Brief

Array = NDArray[np.float64]

LARGEST = 1e-6
"""The largest residual of a step, before correction, without a notice."""

CLOSE = 1e-6
"""Below this margin, a notice says that the run came close to a position where constraints depend on each other."""

DEPENDENT = 1e-9
"""If the margin stays below this, a row depends on others throughout."""

FALLEN = 0.1
"""A margin that is not tiny has become small if it is below this part of that at the start."""

WHERE = "constraints"
"""The subject of notices about a run's constraints."""


@dataclass(frozen=True)
class RunDrift(Brief):
    """How far a run came from its constraints: the largest |f| of rows on positions and |A v + a₀| of all rows.

    ``…_before`` and ``…_after``: at the ends of steps, before and after the state is projected onto the constraints;
    equal with ``project=False``. ``margin`` is the least sin² of the angle between one row and the span of the others,
    measured by M⁻¹, and ``margin_time`` [s] is the time of that minimum.
    """

    position_before: float
    position_after: float
    velocity_before: float
    velocity_after: float
    margin: float
    margin_time: float

    @classmethod
    def of_run(cls, drift: Drift, run: int = 0) -> RunDrift:
        """The drift of one of many runs."""
        return cls(*(float(getattr(drift, f.name)[run]) for f in fields(cls)))

    def __str__(self) -> str:
        """Read as ``constraints kept to 2.2e-16 (positions) and 4.4e-16 (velocities)``."""
        return f"constraints kept to {self.position_after:.1e} (positions) and {self.velocity_after:.1e} (velocities)"


def notices(task: Task, outcome: Outcome) -> tuple[Notice, ...]:
    """Return the notices about the constraints of a run."""
    if outcome.drift is None:
        return ()
    drift = RunDrift.of_run(outcome.drift)
    return (*_too_long(task.method, max(drift.position_before, drift.velocity_before), task.project),
            *_close(task, outcome, drift), *_missed(task, outcome, drift))  # fmt: skip


def _missed(task: Task, outcome: Outcome, drift: RunDrift) -> tuple[Notice, ...]:
    """A notice if states miss the constraints after the projection too."""
    left = max(drift.position_after, drift.velocity_after)
    if not task.project or left <= LARGEST or outcome.status == RunStatus.APART:  # which has its own message
        return ()
    return (Notice(Code.E508, WHERE, _still_missed(left)),)


def of_runs(
    method: str, project: bool, position: Array, velocity: Array, margin: Array, left: Array
) -> tuple[str, ...]:
    """The notices about many runs, from the drift before and after (``left``) correction, and the least margins."""
    largest = max((float(np.nanmax(a)) for a in (position, velocity) if np.isfinite(a).any()), default=0.0)
    said = [str(notice) for notice in _too_long(method, largest, project)]
    near = np.flatnonzero((margin.ravel() < CLOSE) & (margin.ravel() >= DEPENDENT))
    if len(near):
        text = f"{len(near)} runs come within a margin of {CLOSE:g} of a position where a constraint depends on others"
        said.append(str(Notice(Code.E508, WHERE, text)))
    missed = left[left > LARGEST] if project else left[:0]  # NaN of runs without results is not greater
    if missed.size:
        text = f"in {missed.size} runs {_still_missed(float(missed.max()))}"
        said.append(str(Notice(Code.E508, WHERE, text)))
    return tuple(said)


def _still_missed(most: float) -> str:
    return (
        f"after the projection they are still missed by up to {most:.2g} (SI units), so that fewer digits are right "
        "than the tolerances say; leave out rows that follow from others, or compare with a smaller max_step"
    )


def _too_long(method: str, largest: float, project: bool) -> tuple[Notice, ...]:
    if method not in METHODS or METHODS[method].adaptive or not largest > LARGEST:
        return ()
    if not project:
        return (Notice(Code.E507, WHERE, f"they are missed by up to {largest:.2g} (SI units) without projection"),)
    text = f"steps miss them by up to {largest:.2g} (SI units) before they are corrected: use a shorter step"
    return (Notice(Code.E507, WHERE, text),)


def _close(task: Task, outcome: Outcome, drift: RunDrift) -> tuple[Notice, ...]:
    """The words that say when rows depend on others: near one time, or throughout."""
    if not drift.margin < CLOSE or not len(outcome.times):
        return ()
    nearest = int(np.argmin(np.abs(outcome.times - drift.margin_time)))
    rows = rows_of(task.model)
    there, first = (_margins(task, outcome, k) for k in (nearest, 0))
    always = [row.name for row, a, b in zip(rows, there, first, strict=True) if a < DEPENDENT and b < DEPENDENT]
    if always:
        names = " and ".join(f"'{name}'" for name in always)
        text = f"{names} follow{'s' if len(always) == 1 else ''} from the others here: multipliers are not unique"
        return (Notice(Code.E508, WHERE, text),)
    row = rows[int(np.argmin(there))]
    angle = math.sqrt(max(drift.margin, 0.0))
    text = (
        f"at t = {drift.margin_time:.4g} s '{row.element.name}' comes within {angle:.2g} rad "
        "of a position where the system can move in more than one way"
    )
    if task.method in MULTISTEP:
        text += (
            f"; there rounding is a noise in the accelerations, through which '{task.method}' takes very short steps "
            f"({outcome.steps} in this run) and 'dop853' a few"
        )
    return (Notice(Code.E508, WHERE, text),)


def _margins(task: Task, outcome: Outcome, k: int) -> Array:
    found = _at(dynamics.slips(task.model), dynamics.multipliers, task, outcome.times[k], outcome.states[k])
    return np.array(found["margins"], float)


def _at(model: Model, make: object, task: Task, t: float, x: Array) -> dict[str, list[float]]:
    """The outputs, at a state, of a program of a model's constraints."""
    name = getattr(make, "__name__", "")
    program: Program = remembered(model, ("constraints", name), lambda: make(model))  # type: ignore[operator]
    n, size = len(model.coordinates), task.size
    given = {"q": x[:n], "v": x[n:size], "u": np.zeros(len(model.inputs)), "p": task.p, "t": [t]}
    return evaluate(program, {g: list(map(float, values)) for g, values in given.items()})  # type: ignore[return-value]


def branches(task: Task, outcome: Outcome) -> str:
    """What is to be said of a run that could not go on where constraints come to depend on each other; else empty."""
    if outcome.drift is None:
        return ""
    drift = RunDrift.of_run(outcome.drift)
    if not at_branch(drift.margin, drift.margin_time, outcome.reached, task.rtol):
        return ""
    start = float(_margins(task, outcome, 0).min()) if len(outcome.times) else 0.0
    if (start < BRANCHING and drift.margin < DEPENDENT) or drift.margin > max(BRANCHING, FALLEN * start):
        return ""  # not there alone
    return (
        f"the constraints come to depend on each other there (margin {drift.margin:.1g}): the system can move in more "
        "than one way, and rounding is a noise in its accelerations"
    )


# -- the border of a run ----------------------------------------------------------------------------------------


def check_method(model: Model, method: str) -> None:
    """Raise `RunError` for a symplectic method of a system with constraints."""
    if model.constraints and method in SYMPLECTIC:
        raise RunError(
            f"method '{method}' integrates momenta, which constraints do not leave independent",
            fix="use 'dop853', which keeps the energy of a constrained system to its tolerance, or 'rk4' with a step",
            code="E501",
        )


def ended(outcome: Outcome, task: Task) -> Outcome:
    """Return the outcome, ended at the first event whose reset makes a state that violates a constraint, or where a
    row that was left out does not hold."""
    drift = outcome.drift
    if drift is not None and task.model.spare and task.project:
        outcome = _apart(outcome, task, max(float(drift.position_after[0]), float(drift.velocity_after[0])))
    broken = drift is not None and max(drift.reset_position[0], drift.reset_velocity[0]) > BREAKS
    for k, hit in enumerate(outcome.hits if broken else ()):
        if hit.after is None or not (said := _breaks(task, hit.time, hit.after)):
            continue
        why = f"[E509] the reset of event '{task.events[hit.index].title}' breaks {said}"
        return cut_at(outcome, k, RunStatus.BROKEN, why)
    return outcome


def _apart(outcome: Outcome, task: Task, left: float) -> Outcome:
    """The outcome, ended before the first sample that violates a row, if a state was off by more than rounding."""
    for k in range(1, len(outcome.times) if left > BREAKS else 0):
        if said := _breaks(task, float(outcome.times[k]), outcome.states[k]):
            names = " and ".join(f"'{name}'" for spare in task.model.spare for name in spare.names[:6])
            return replace(
                outcome,
                times=outcome.times[:k],
                states=outcome.states[:k],
                status=RunStatus.APART,
                reached=float(outcome.times[k - 1]),
                final=outcome.states[k - 1],
                hits=[hit for hit in outcome.hits if hit.time <= outcome.times[k - 1]],
                reason=f"[E510] the rows {names} do not depend on each other as they did at the start: the next sample "
                f"breaks {said}",
            )
    return outcome


def _breaks(task: Task, t: float, x: Array) -> str:
    """The row that a state violates, and by how much."""
    found = _at(task.model, dynamics.residual, task, t, x)
    rows = rows_of(task.model)
    positions: Sequence[str] = [row.name for row in rows if row.position is not None]
    values = [(abs(f), f"'{name}': it is off by {f:.4g}") for f, name in zip(found["f"], positions, strict=True)]
    values += [(abs(c), f"'{r.name}': its rate is {c:.4g}") for c, r in zip(found["Av"], rows, strict=True)]
    size, said = max(values, default=(0.0, ""))
    return f"the constraint {said}" if size > BREAKS else ""
