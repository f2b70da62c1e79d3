"""Describes how a run ended: the time, the state, the reason, and possible remedies."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lagrangian import dynamics
from lagrangian.advice import Advice, Argument
from lagrangian.errors import RunError
from lagrangian.graph import evaluate
from lagrangian.integrate.method_names import SCIPY
from lagrangian.integrate.scipy_methods import IMPLICIT, Outcome
from lagrangian.integrate.status import RunStatus
from lagrangian.page.plain import plain
from lagrangian.simulate import drift, sticking
from lagrangian.simulate.integrating import Task, right_hand_side
from lagrangian.simulate.settling import PARADOX_FIX

Array = NDArray[np.float64]

SINGULAR, NEARLY = 1e-10, 1e-6
"""M caused the end of a run if its smallest eigenvalue, relative to the largest elsewhere, is below this."""

SHOWN = 8
"""The largest number of states in a message."""

JUMP = "a force that jumps with the state is better smooth (tanh for sign) or an event's reset"
"""Advice for jumps, which no smaller step can resolve."""

RADAU = Argument("method", "'Radau'")
"""Advice for stiff systems."""


def message(task: Task, outcome: Outcome) -> Advice:
    """Return a sentence for a run that reached its end; otherwise time, state, reason and advice."""
    slow = (
        " (an input is a Python function: SciPy's solver called it at every evaluation)"
        if task.drive.calls_python
        else ""
    )
    if outcome.status == RunStatus.REACHED:
        return Advice(f"the end of the interval was reached, t = {outcome.reached:g} s{slow}")
    if outcome.status == RunStatus.TERMINAL:
        name = task.events[outcome.hits[-1].index].title
        return Advice(f"event '{name}' ended the run at t = {outcome.reached:.9g} s{slow}")
    reason, fix = _reason(task, outcome)
    return Advice(f"stopped at t = {outcome.reached:.9g} s: {reason}; state {_state(task, outcome.final)}. Fix: ", fix)


def _reason(task: Task, outcome: Outcome) -> tuple[str, str]:
    said = outcome.reason or outcome.status.message
    match outcome.status:
        case RunStatus.UNDERFLOW | RunStatus.NOT_FINITE:
            singular = _singular(task, outcome)
            if singular:
                return (
                    singular,
                    "add a mass or an inertia that they move, or choose other coordinates near this configuration",
                )
            broken = _not_finite(task, outcome)
            if broken:
                return broken, "look for a division by zero or a root of a negative number there"
            if said.startswith("["):  # the solver kept the message of an evaluation
                return said, "a finite value everywhere the run may reach"
            if branch := drift.branches(task, outcome):
                return f"[E504] {branch}", _stepping_over(task)
            return f"[E504] {said}", _gentler(task, outcome)
        case RunStatus.TOO_MANY | RunStatus.LATE if branch := drift.branches(task, outcome):
            return f"[E505] gave up after {outcome.steps} steps: {branch}", _stepping_over(task)
        case RunStatus.TOO_MANY:
            return (
                f"[E505] gave up after {task.bounds.max_steps} steps",
                Advice("a shorter run, a larger ", Argument("max_steps"), ", or ", RADAU),
            )
        case RunStatus.ZENO | RunStatus.CROWDED if task.model.frictions:
            return said, Advice("a shorter run, or a larger ", Argument("max_events"))
        case RunStatus.PARADOX:
            return f"[E505] {said}", PARADOX_FIX
        case RunStatus.ZENO:
            return (
                f"[E505] event '{_last_event(task, outcome)}' repeats itself without end: {len(outcome.hits)} events, "
                "each of which changes the state",
                Advice("end the run with a terminal event where bodies touch, or raise ", Argument("max_events")),
            )
        case RunStatus.CROWDED:
            return (
                f"[E505] gave up after {len(outcome.hits)} events, the last of them '{_last_event(task, outcome)}'",
                Advice("a shorter run, or a larger ", Argument("max_events")),
            )
        case RunStatus.CHATTERS:
            return sticking.stuck(task, outcome)
        case RunStatus.BLIND:
            return _blind(task, outcome), (
                "a condition with a value wherever the run gets to, such as sqrt(max(x, 0)) for sqrt(x), or a terminal "
                "event where it has none any more"
            )
        case RunStatus.BROKEN:
            return said, "a reset that leaves positions and rates with which the constraints hold"
        case RunStatus.APART:
            return said, (
                "look at what these constraints say from there on; a run that starts there says whether they "
                "contradict each other"
            )
        case RunStatus.LATE:
            over = f"[E505] the time allowed for computing was over after {outcome.steps} steps"
            return over, Advice("a larger ", Argument("timeout"))
        case _:
            return f"[E504] {said}", f"a shorter step; {JUMP}"


def _last_event(task: Task, outcome: Outcome) -> str:
    return task.events[outcome.hits[-1].index].title if outcome.hits else task.events[0].title


def _state(task: Task, x: Array) -> str:
    names = [*(c.name for c in task.model.coordinates), *(v.name for v in task.model.velocities)]
    shown = [f"{name} = {value:.6g}" for name, value in zip(names, x, strict=False)]
    return ", ".join(shown[:SHOWN]) + (", …" if len(shown) > SHOWN else "")


def _stepping_over(task: Task) -> Advice:
    """Methods that may pass a position where a linkage can branch."""
    other = Argument("method", "'taylor'" if task.method == "dop853" else "'dop853'")
    return Advice(other, " or ", Argument("method", "'rk4'"), " with a step, which may step over it")


def _singular(task: Task, outcome: Outcome) -> str:
    """Whether M is singular where the run stopped, and which coordinates move no mass there."""
    q, t = outcome.final[: len(task.model.coordinates)].tolist(), outcome.reached
    u = [0.0] * len(task.model.inputs)  # a kinetic energy does not depend on inputs
    for near, how in ((SINGULAR, ""), (NEARLY, "all but ")):
        if moved := dynamics.loose(task.model, q, u, task.p.tolist(), t, near):
            return f"[E203] the mass matrix is {how}singular there: {moved}"
    return ""


def _rates(task: Task, outcome: Outcome) -> tuple[tuple[str, ...], Array]:
    """ẋ where the run stopped, as far as it can be computed, with the names of the states."""
    program = right_hand_side(task.model, task.drive)
    x = np.zeros(len(program.inputs["x"]))
    x[: len(outcome.final)] = outcome.final
    u = task.drive.at(np.array([outcome.reached]), outcome.final[np.newaxis, : task.size])[0]
    found = evaluate(program, {"x": list(x), "u": list(u), "p": list(task.p), "t": [outcome.reached]})
    return program.inputs["x"][: task.size], np.array(found["xdot"][: task.size], float)


def _not_finite(task: Task, outcome: Outcome) -> str:
    """The rates that are not finite at the last state."""
    try:
        names, rates = _rates(task, outcome)
    except RunError as trouble:  # an input that is a function gave no number there
        return f"[{trouble.code}] {trouble.what}"
    broken = [f"the rate of '{n}' is {r}" for n, r in zip(names, rates, strict=True) if not np.isfinite(r)]
    return f"[E503] {', '.join(broken[:3])}" if broken else ""


def _blind(task: Task, outcome: Outcome) -> str:
    """The events whose condition is NaN at the last state, or a moment later along ẋ."""
    program = dynamics.impacts(task.model, task.impacts, task.drive.feedback)
    x, t = outcome.final[: task.size], outcome.reached
    _, rates = _rates(task, outcome)
    ahead = (task.times[-1] - task.times[0]) * 2.0 ** -np.arange(60, 0, -4)
    for h in [0.0, *ahead.tolist()] if np.isfinite(rates).all() else [0.0]:
        u = task.drive.at(np.array([t + h]), x[np.newaxis])[0]
        found = evaluate(program, {"x": list(x + h * rates), "u": list(u), "p": list(task.p), "t": [t + h]})
        dark = [e for e, g in zip(task.events, found["g"], strict=True) if np.isnan(g)]
        if dark:
            e, where = dark[0], "a moment later" if h else "there"
            condition = "" if e.title == plain(e.expression) else f", {plain(e.expression)},"
            return f"[E503] the condition of event '{e.title}'{condition} is not a number {where}"
    return f"[E503] {RunStatus.BLIND.message}"


def _gentler(task: Task, outcome: Outcome) -> str:
    """Advice for a run whose steps became too small."""
    names, rates = _rates(task, outcome)
    fast = names[int(np.argmax(np.abs(rates) / (np.abs(outcome.final[: task.size]) + task.atol)))]
    if task.method in SCIPY and task.method in IMPLICIT:
        return f"looser tolerances; '{fast}' changes fastest there; {JUMP}"
    return Advice(RADAU, f" if the system is stiff; '{fast}' changes fastest there; {JUMP}")
