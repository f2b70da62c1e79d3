"""Runs of systems with dry friction, regime by regime: every friction slips in one sense or sticks, until it changes.

Within a regime the right-hand side is smooth, and what sticks is a constraint. A regime ends where a friction comes to
rest (δ̇ = 0), where it breaks away (|λ| = F_s), or where an event changes the state. Then a verdict on that state tells
the next regime: every friction at rest that can hold its place sticks, the others slip as their forces drive them.
"""

from __future__ import annotations

import math
import time
from collections.abc import Mapping, Sequence
from dataclasses import fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian import dynamics
from lagrangian.integrate import Drift, RunStatus, Signals, Solution
from lagrangian.integrate.in_modes import signals_at
from lagrangian.records import dataclass, field
from lagrangian.simulate.regimes import Modes, Regimes
from lagrangian.simulate.settling import Crossroads, Paradox

Array = NDArray[np.float64]

REST = 1e-12
"""A speed of slip below this, in SI units, is rest."""

SOON, MOST_SOON = 1e-13, 20
"""Regimes that last less than this part of the time are counted; more of them in a row are refused."""


@dataclass(frozen=True)
class Transition:
    """A friction that begins to slip (``mode`` ±1) or to stick (0), and the state there."""

    friction: int
    mode: int
    time: float
    state: Array


@dataclass
class SlipSolution(Solution):
    """N runs with friction: besides, the ``modes`` (N, S, k) at the samples, the ``last_modes`` (N, k), both with the
    sides of rows that press after the frictions, and the transitions of every run."""

    modes: NDArray[np.int8] = field(kw_only=True)
    last_modes: NDArray[np.int8] = field(kw_only=True)
    transitions: list[list[Transition]] = field(kw_only=True)


class StickSlip(Regimes):
    """Integrates ``ẋ = f(x, u, p, t)`` of a model with friction, as `Solver` does, one run after another."""

    def solve(
        self,
        x0: Any,
        times: Any,
        *,
        u: Any = None,
        p: Any = None,
        max_steps: int = 10_000_000,
        max_events: int = 10_000,
        deadline: float | None = None,
        store: bool = True,
        **accuracy: Any,
    ) -> SlipSolution:
        """Integrate runs from ``x0`` (nx,) or (N, nx); the arguments and the result are those of `Solver.solve`."""
        rows = [np.asarray(a, float) for a in (x0, [] if isinstance(u, Signals) or u is None else u, p)]
        count = max((len(a) for a in rows if a.ndim == 2), default=1)
        until = math.inf if deadline is None else time.monotonic() + deadline
        runs: list[_Run] = []
        for n in range(count):
            x, own, parameters = (np.array(a[n] if a.ndim == 2 else a) for a in rows)
            signals = u if isinstance(u, Signals) else None
            run = _Run(self, np.asarray(times, float), signals, own, parameters, accuracy, store)
            run.go(x, max_steps, max_events, until)
            runs.append(run)
        return _gathered(runs)


class _Run:
    """One run: what is known so far, and the limits that are left."""

    def __init__(
        self,
        way: StickSlip,
        times: Array,
        signals: Signals | None,
        u: Array,
        p: Array,
        accuracy: Mapping[str, Any],
        store: bool,
    ) -> None:
        self.way, self.times, self.signals, self.p, self.accuracy = way, times, signals, p, accuracy
        self.u, self.store = u, store
        self.rest = min(REST, float(np.min(accuracy.get("atol", REST))))
        self.states: list[Array] = []
        self.modes: list[Modes] = []
        self.hits: list[tuple[int, float, Array]] = []
        self.transitions: list[Transition] = []
        self.status, self.steps, self.rejected, self.evaluations = RunStatus.LATE, 0, 0, 0
        self.drift: Drift | None = None

    def inputs(self, t: float) -> Array:
        """The inputs at a time; at a jump, those after it."""
        return self.u if self.signals is None else signals_at(self.signals, np.array([t]))[0]

    def crossroads(self, x: Array, t: float) -> Crossroads:
        """A state at which the regime may change."""
        return Crossroads(self.way, x, self.inputs(t), self.p, t, max(2 * self.rest, REST))

    def go(self, x: Array, max_steps: int, max_events: int, until: float) -> None:
        """Integrate from the first time to the last, regime by regime."""
        t, end = float(self.times[0]), float(self.times[-1])
        modes, paradox = self.way.start, False
        try:
            modes = self.crossroads(x, t).settled(modes, set(), {})
        except Paradox:
            paradox = True
        self.states.append(x)
        self.modes.append(modes)
        x, soon = (x if paradox else self.landed(modes, x, t)), 0
        while not paradox:
            left = until - time.monotonic()
            if t >= end or left <= 0:
                self.status = RunStatus.REACHED if t >= end else RunStatus.LATE
                break
            room = max_events - len(self.hits) - len(self.transitions)
            before = t
            x, t, fired = self.regime_from(modes, x, t, max_steps - self.steps, room, left)
            if not fired:
                break
            if paradox := self.way.paradox(modes) in fired:
                break
            soon = soon + 1 if t - before <= SOON * max(abs(t), end - float(self.times[0])) else 0
            if soon > MOST_SOON or room <= 1:
                self.status = RunStatus.ZENO if soon > MOST_SOON else RunStatus.CROWDED
                break
            try:
                x, modes = self.turned(modes, x, t, fired)
            except Paradox:
                paradox = True
        if paradox:
            self.status = RunStatus.PARADOX
        self.reached, self.final, self.last = t, x, modes

    def regime_from(
        self, modes: Modes, x: Array, t: float, steps: int, room: int, left: float
    ) -> tuple[Array, float, list[int]]:
        """Integrate one regime; return the state and time where it ends, and what ended it (nothing: the run)."""
        way = self.way
        here = way.regime(modes, self.rest)
        rest = self.times[self.times > t] if self.store else self.times[-1:]
        size = way.size
        found = here.solver.solve(
            x if here.supplies else x[:size],
            np.concatenate([[t], rest]),
            u=self.u if self.signals is None else self.signals,
            p=self.p,
            max_steps=max(1, steps),
            max_events=max(1, room),
            deadline=None if math.isinf(left) else left,
            **self.accuracy,
        )
        more = x[size:] if not here.supplies else x[:0]
        self.status, reached = RunStatus(int(found.status[0])), float(found.reached[0])
        if self.store:
            whole = rest <= reached
            new = found.states[0, 1:][whole]
            self.states += [np.append(row, more) for row in new]
            self.modes += [modes] * len(new)
        self.steps += int(found.steps[0])
        self.rejected += int(found.rejected[0])
        self.evaluations += int(found.evaluations[0])
        if found.drift is not None and way.drifts:
            self.drift = found.drift if self.drift is None else _wider(self.drift, found.drift)
        fired: list[int] = []
        known = {k for k, when, _ in self.hits if when == t and not way.events[k].reset}
        for e in range(int(found.event_count[0])):
            k, when = int(found.event_index[0, e]), float(found.event_time[0, e])
            if when == t and k in known:  # where one regime ended and the next begins
                continue
            if k < len(way.events):
                self.hits.append((k, when, np.append(found.event_state[0, e], more)))
            if when == reached and (k >= len(way.events) or way.events[k].reset):
                fired.append(k)
        final = np.append(found.final[0], more)
        ended = any(k < len(way.events) and way.events[k].terminal for k, when, _ in self.hits if when == reached)
        if self.status != RunStatus.TERMINAL or ended:
            return final, reached, []
        return final, reached, fired

    def turned(self, modes: Modes, x: Array, t: float, fired: Sequence[int]) -> tuple[Array, Modes]:
        """The state and the regime after what ended one."""
        way = self.way
        own = [k for k in fired if k < len(way.events)]
        if own:
            before = self.crossroads(x, t)
            x = way.after(own[0], x, self.inputs(t), self.p, t)
            after = self.crossroads(x, t)
            changed = np.abs(after.judged(modes)["rate"] - before.judged(modes)["rate"]) > before.near
            new = after.settled(modes, {i for i, mode in enumerate(modes) if not mode and not changed[i]}, {})
        else:
            ends = [dynamics.watches(way.model, modes)[k - len(way.events)] for k in fired]
            forced = {end.friction: end.sense for end in ends if end.sense}
            turned = {end.friction for end in ends if end.friction >= way.count}
            resting = ({i for i, mode in enumerate(modes) if not mode} | {end.friction for end in ends}) - turned
            forced.update((i, -modes[i]) for i in turned)
            new = self.crossroads(x, t).settled(modes, resting, forced)
        for i, (a, b) in enumerate(zip(modes, new, strict=True)):
            if a != b and i < way.count:
                self.transitions.append(Transition(i, b, t, x))
        return self.landed(new, x, t), new

    def landed(self, modes: Modes, x: Array, t: float) -> Array:
        """The state with the velocities that what sticks allows."""
        if all(modes[: self.way.count]):
            return x
        x = x.copy()
        n = len(self.way.model.coordinates)
        x[n : self.way.size] += self.way.judged(modes, x, self.inputs(t), self.p, t)["dv"]
        return x


def _wider(a: Drift, b: Drift) -> Drift:
    """The larger of two drifts, and the smaller margin with its time."""
    made = {f.name: np.maximum(getattr(a, f.name), getattr(b, f.name)) for f in fields(Drift)}
    first = a.margin <= b.margin
    made["margin"] = np.where(first, a.margin, b.margin)
    made["margin_time"] = np.where(first, a.margin_time, b.margin_time)
    made["start_position"], made["start_velocity"] = a.start_position, a.start_velocity
    return Drift(**made)


def _gathered(runs: Sequence[_Run]) -> SlipSolution:
    """The runs as arrays over runs and samples; NaN after the end of a run."""
    first = runs[0]
    samples, size = len(first.times) if first.store else 0, len(first.final)
    states = np.full((len(runs), samples, size), math.nan)
    modes = np.zeros((len(runs), samples, len(first.way.start)), np.int8)
    most = max(len(r.hits) for r in runs)
    index = np.full((len(runs), most), -1)
    when, where = np.full((len(runs), most), math.nan), np.full((len(runs), most, size), math.nan)
    for n, run in enumerate(runs):
        kept = min(samples, len(run.states))
        if kept:
            states[n, :kept], modes[n, :kept] = run.states[:kept], run.modes[:kept]
        for e, (k, t, x) in enumerate(run.hits):
            index[n, e], when[n, e], where[n, e] = k, t, x
    whole: dict[str, Any] = {
        "status": [int(r.status) for r in runs],
        "steps": [r.steps for r in runs],
        "rejected": [r.rejected for r in runs],
        "evaluations": [r.evaluations for r in runs],
        "event_count": [len(r.hits) for r in runs],
    }
    drift = None
    if first.way.drifts:
        drifts = [Drift.of_rows(Drift.blank(1)) if r.drift is None else r.drift for r in runs]
        drift = Drift(*(np.concatenate([getattr(d, f.name) for d in drifts]) for f in fields(Drift)))
    return SlipSolution(
        times=first.times if first.store else np.empty(0),
        states=states,
        reached=np.array([r.reached for r in runs]),
        final=np.array([r.final for r in runs]),
        event_index=index,
        event_time=when,
        event_state=where,
        drift=drift,
        modes=modes,
        last_modes=np.array([r.last for r in runs], np.int8),
        transitions=[r.transitions for r in runs],
        **{name: np.array(values, np.int64) for name, values in whole.items()},
    )
