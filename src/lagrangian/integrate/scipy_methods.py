"""SciPy's solvers with a compiled right-hand side and a compiled analytic Jacobian, step by step.

They are meant for stiff systems (``Radau``, ``BDF``, ``LSODA``), for inputs that are Python functions, and for
comparison. Each step is made here, so that the results up to then remain whatever ends the run: an event, a state that
is not finite, a step that cannot become smaller, a limit on steps or time.
"""

from __future__ import annotations

import math
import time as clock
import warnings
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.errors import RunError
from lagrangian.integrate.chattering import LEAST, NEAR, Pace, Sticking
from lagrangian.integrate.crossings import Crossings, Hit
from lagrangian.integrate.methods.memory_layout import MARGIN
from lagrangian.integrate.projection import Drift, Projection
from lagrangian.integrate.scipy_history import History
from lagrangian.integrate.scipy_projection import Projected
from lagrangian.integrate.scipy_weights import Weights
from lagrangian.integrate.status import RunStatus
from lagrangian.records import dataclass, field

Array = NDArray[np.float64]
Control = Callable[[float, Array], Array]

IMPLICIT = frozenset({"Radau", "BDF", "LSODA"})
"""The methods that use a Jacobian."""

LEAST_STEP = 2.0**-50
"""The smallest step that is tried, relative to t."""

PATIENCE = 100_000
"""The number of steps after which a run is given up that makes no progress where a linkage can branch."""

MAX_NOT_FINITE = 1000
"""After this many consecutive evaluations without a finite result, a solver does not try a smaller step."""


@dataclass(frozen=True)
class Interval:
    """An interval of time up to ``end`` on which all inputs u(t, x), except those ``asked``, are linear in time."""

    end: float
    u: Control
    asked: tuple[int, ...] = ()


@dataclass
class Outcome:
    """A run as far as it went: states (S, nx) at ``times`` (S,), and how it ended.

    ``reached`` and ``final`` are the last time and state; ``hits`` are the events; ``reason`` says more where there is
    more to say. ``drift``: how far it came from the rows of a projection.
    """

    times: Array
    states: Array
    status: RunStatus
    reached: float
    final: Array
    steps: int = 0
    rejected: int = 0
    evaluations: int = 0
    hits: list[Hit] = field(default_factory=list)
    reason: str = ""
    drift: Drift | None = None


@dataclass
class Bounds:
    """Limits that end a run: numbers of steps and events, and seconds of computing."""

    max_steps: int = 10_000_000
    max_events: int = 100_000
    max_step: float = math.inf
    seconds: float | None = None


class _NotFiniteError(Exception):
    """The right-hand side is not finite, however small the step is."""


class _Field:
    """f(t, x) and its Jacobian for SciPy, with counters; values that are not finite become NaN, so that the step is
    reduced."""

    def __init__(self, rhs: Any, jacobian: Any, p: Array, nx: int) -> None:
        self.rhs, self.jacobian, self.p = rhs, jacobian, p
        self.evaluations = self.trouble = 0
        self.why = ""  # the latest evaluation that was not finite
        self.nothing = np.full(nx, np.nan)
        self.u: Control = lambda t, x: np.empty(0)
        self.last = math.inf  # the time to use in evaluations at the end of an interval

    def __call__(self, t: float, x: Array) -> Array:
        self.evaluations += 1
        t = min(t, self.last)
        try:
            value = self.rhs(np.ascontiguousarray(x), self.u(t, x), self.p, t)
        except RunError as error:
            if error.code not in ("E502", "E503"):
                raise
            if not self.trouble:  # the first error is the cause; later ones are only consequences
                self.why = f"[{error.code}] {error.what}"
            self.trouble += 1
            if self.trouble > MAX_NOT_FINITE:
                raise _NotFiniteError from None
            return self.nothing
        self.trouble = 0
        return value

    def slope(self, t: float, x: Array) -> Array:
        """∂f/∂x, shape (nx, nx)."""
        t = min(t, self.last)
        try:
            return self.jacobian(np.ascontiguousarray(x), self.u(t, x), self.p, t)
        except RunError as error:
            if error.code not in ("E502", "E503"):
                raise
            raise _NotFiniteError from None


def integrate_scipy(
    method: str,
    rhs: Any,
    x0: Array,
    times: Array,
    legs: Sequence[Interval],
    p: Array,
    *,
    jacobian: Any = None,
    crossings: Crossings | None = None,
    rtol: float = 1e-9,
    atol: float | Array = 1e-12,
    over_run: bool = False,
    bounds: Bounds | None = None,
    projection: Projection | None = None,
) -> Outcome:
    """Run ẋ = rhs(x, u, p, t) from ``times[0]`` and return the states at ``times``.

    ``rhs`` and ``jacobian`` are kernels (`lagrangian.codegen`) of the groups x, u, p, t; ``legs`` cover the time from
    ``times[0]`` to ``times[-1]``. ``over_run``: see `Weights`. ``projection``: as for `Solver`. Nothing is raised for a
    run that fails on its way: its outcome says so.
    """
    weights = Weights(rtol, atol, x0, over_run=over_run)
    ground = None if projection is None else Projected(projection, rhs.program, p, weights)
    field = _Field(rhs, jacobian, p, len(x0))
    march = _March(method, field, x0, times, crossings, weights, bounds or Bounds(), ground)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # LSODA warns about what its return code also says
        try:
            for leg in legs:
                if not march.over(leg):
                    if march.status in (RunStatus.TOO_MANY, RunStatus.UNDERFLOW):
                        march.sticks(leg, last=True)
                    break
            else:
                march.status = RunStatus.REACHED
        except _NotFiniteError:
            march.status, march.reason = RunStatus.NOT_FINITE, march.f.why
    return march.outcome()


class _March:
    """A run while it is computed."""

    def __init__(
        self,
        method: str,
        f: _Field,
        x0: Array,
        times: Array,
        crossings: Crossings | None,
        weights: Weights,
        bounds: Bounds,
        ground: Projected | None = None,
    ) -> None:
        from scipy import integrate  # imported here because it takes longer to load than most runs need

        self.make: Callable[..., Any] = getattr(integrate, method)
        self.f, self.crossings, self.bounds, self.ground = f, crossings, bounds, ground
        self.weights = weights
        self.options: dict[str, Any] = {"rtol": weights.rtol, "atol": weights.atol, "max_step": bounds.max_step}
        if method in IMPLICIT and f.jacobian is not None:
            self.options["jac"] = f.slope
        self.t, self.x = float(times[0]), np.array(x0, float)
        self.times, self.states = times, np.empty((len(times), len(x0)))
        self.states[0], self.stored = self.x, 1
        self.status, self.reason, self.steps, self.rejected = RunStatus.REACHED, "", 0, 0
        self.deadline = math.inf if bounds.seconds is None else clock.monotonic() + bounds.seconds
        self.hits: list[Hit] = []
        self.pace, self.pace_at_branch = Pace(self.t), Pace(self.t)
        self.sticking: Sticking | None = None

    def over(self, leg: Interval) -> bool:
        """Integrate over an interval; return whether to continue after it."""
        self.f.u, self.f.last = leg.u, max(leg.end - MARGIN * abs(leg.end), self.t)
        if self.ground is not None and self.steps == 0:
            self.x = self.ground.begin(self.t, self.x, leg.u)
        shorter: float | None = None
        while self.t < leg.end:
            # a new solver at the start, after an event that changes the state, and for a shorter step
            if self.crossings is not None:
                self.crossings.start(self.t, self.x, leg.u, self.f)
                if self.crossings.blind is not None:
                    self.status = RunStatus.BLIND
                    return False
            solver = self.make(self.f, self.t, self.x, leg.end, first_step=shorter, **self.options)
            shorter = None
            jumped = False
            while solver.status == "running" and not jumped:
                if not self._within_bounds() or self.sticks(leg) or self._held_at_branch():
                    return False
                # one step of SciPy's solver
                history = None if self.ground is None else History.of(solver)
                words = solver.step()
                self.steps += 1
                if solver.status == "failed":
                    self._failed(words)
                    return False
                if not np.all(np.isfinite(solver.y)):
                    self.status, self.reason = RunStatus.NOT_FINITE, "the state is not finite after this step"
                    return False
                dense = solver.dense_output()
                # its end is projected; if the correction exceeds the tolerance, a shorter step is tried
                if self.ground is not None:
                    dense = self.ground.along(dense, leg.u)
                    size, anew = self.ground.settle(solver, self.x, leg.u)
                    if not size <= 1.0:
                        shorter = self._shorter(solver.t, size)
                        if shorter is None:
                            return False
                        if history is None:
                            break
                        history.retry(solver, size)
                        shorter = None
                        continue
                    jumped = anew
                self.weights.note(solver.y)
                jumped = self._advance(solver, dense, leg) or jumped
                if self.status != RunStatus.REACHED:
                    return False
        return True

    def _shorter(self, end: float, size: float) -> float | None:
        """The step to try after one to ``end`` whose correction was too great; None if there is none."""
        self.steps, self.rejected = self.steps - 1, self.rejected + 1
        if (end - self.t) / 2 > LEAST_STEP * max(abs(self.t), abs(end)):
            return (end - self.t) / 2
        known = math.isfinite(size)
        self.status = RunStatus.UNDERFLOW if known else RunStatus.NOT_FINITE
        self.reason = "however short a step is, it must be corrected by more than the tolerance" if known else ""
        return None

    def _within_bounds(self) -> bool:
        if self.steps + self.rejected >= self.bounds.max_steps:
            self.status = RunStatus.TOO_MANY
        elif clock.monotonic() > self.deadline:
            self.status = RunStatus.LATE
        return self.status == RunStatus.REACHED

    def sticks(self, leg: Interval, *, last: bool = False) -> bool:
        """Whether the run sticks where ẋ jumps and gets on no more: looked at now and then, and at the ``last``."""
        if not last and (self.steps == 0 or self.steps % (2 * LEAST)):
            return False
        self.sticking = self.sticking or Sticking(self.f.rhs.program)
        start, end = float(self.times[0]), float(self.times[-1])
        if not self.sticking or not (last or self.pace.hopeless(self.t, self.steps, end, self.bounds.max_steps)):
            return False
        u = leg.u(self.t, self.x)
        if self.sticking.at(self.x, u, self.f.p, self.t, NEAR * (end - start)):
            self.status, self.reason = RunStatus.CHATTERS, ""
        return self.status == RunStatus.CHATTERS

    def _held_at_branch(self) -> bool:
        """Whether the run makes no progress where rows come to depend on each other: noise makes its steps short."""
        if self.ground is None or not self.ground.at_branch(self.t):
            return False
        end, tried = float(self.times[-1]), self.steps + self.rejected
        if self.pace_at_branch.hopeless(self.t, tried, end, self.bounds.max_steps, PATIENCE):
            self.status = RunStatus.UNDERFLOW
        return self.status == RunStatus.UNDERFLOW

    def _failed(self, words: str | None) -> None:
        broken = self.f.trouble > 0
        self.status = RunStatus.NOT_FINITE if broken else RunStatus.UNDERFLOW
        self.reason = self.f.why if broken else (words or "").strip().rstrip(".")

    def _advance(self, solver: Any, dense: Any, leg: Interval) -> bool:
        """Process one step up to its end, or to an event that stops the run or changes the state; return whether one
        did."""
        end = solver.t
        hits = [] if self.crossings is None else self.crossings.between(self.t, end, dense, leg.u, leg.asked)
        for hit in hits:
            self.hits.append(hit)
            crowded = len(self.hits) >= self.bounds.max_events and not hit.terminal
            if hit.terminal or hit.after is not None or crowded:
                self._store(dense, hit.time)
                stuck = (
                    hit.after is not None and hit.time <= self.t and self.steps > 1
                )  # the first event may be at the start
                self.t, self.x = hit.time, hit.before if hit.after is None else hit.after
                if self.ground is not None and hit.after is not None and np.all(np.isfinite(hit.after)):
                    self.x = self.ground.reset(hit.time, hit.after, leg.u)
                if hit.terminal:
                    self.status = RunStatus.TERMINAL
                elif not np.all(np.isfinite(self.x)):
                    self.status, self.x = RunStatus.NOT_FINITE, hit.before
                    self.reason = "the state after an event is not finite"
                elif stuck:
                    self.status = RunStatus.ZENO
                elif crowded:
                    self.status = RunStatus.CROWDED if hit.after is None else RunStatus.ZENO
                return True
        if self.crossings is not None and self.crossings.settled is not None:
            self.status = RunStatus.ZENO
            return True
        if self.crossings is not None and self.crossings.blind is not None:
            self.status, end = RunStatus.BLIND, self.crossings.blind
            self._store(dense, end)
            self.t, self.x = end, np.array(dense(end)) if end > self.t else self.x
            return True
        self._store(dense, end)
        self.t, self.x = end, solver.y
        if self.stored and self.times[self.stored - 1] == end:
            self.states[self.stored - 1] = solver.y  # the step's own end, not the value of the polynomial
        return False

    def _store(self, dense: Any, until: float) -> None:
        upto = int(np.searchsorted(self.times, until, side="right"))
        if upto > self.stored:
            self.states[self.stored : upto] = dense(self.times[self.stored : upto]).T
            self.stored = upto

    def outcome(self) -> Outcome:
        """The outcome so far."""
        return Outcome(
            self.times[: self.stored],
            self.states[: self.stored],
            self.status,
            self.t,
            self.x,
            self.steps,
            self.rejected,
            self.f.evaluations,
            self.hits,
            self.reason,
            None if self.ground is None else self.ground.drift,
        )
