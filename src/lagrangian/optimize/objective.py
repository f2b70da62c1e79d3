"""What is minimized, φ(x, u, p, t) at the end of a run + ∫ c(x, u, p, t) dt, with its exact gradient.

Where a terminal event ends the run, its end moves: dφ = δφ + φ̇ δt, d∫c dt = δ∫c dt + c δt.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.errors import Error, RunError
from lagrangian.integrate import RunStatus
from lagrangian.simulate.admission import Admission, fitness
from lagrangian.simulate.integrating import Task
from lagrangian.simulate.sensitivities import observed
from lagrangian.simulate.unknowns import with_values
from lagrangian.simulate.varied import Columns, VariedRun, varied_run

Array = NDArray[np.float64]

FAR = 1e8
"""The cost, in units of that of the first guess, of values with which a run is impossible."""


@dataclass(frozen=True)
class Goal:
    """What is wanted of a run: the cost at its end and along it, and quantities with the values they must end at."""

    final: sp.Expr | None
    integral: sp.Expr | None
    reach: Mapping[str, tuple[sp.Expr, float]]


@dataclass(frozen=True, eq=False)
class RunCost:
    """A run as it is judged: its cost, what is missing to what must be reached, and the gradients of both."""

    cost: float
    gradient: Array
    missing: Array
    slopes: Array


class Objective:
    """The cost of a run and what it misses, as functions of the unknowns."""

    def __init__(self, task: Task, columns: Columns, goal: Goal) -> None:
        self.task, self.columns, self.goal = task, columns, goal
        varied = {c.name for c in columns if c.kind == "p"}
        check = fitness(task.model, varied) if varied else None
        self._admit = None if check is None else Admission(task.model, check)
        self._last: tuple[bytes, RunCost | None] | None = None
        self.evaluations = 0

    def judged(self, z: Array) -> RunCost:
        """The run with these values. Raises `Error` if it is impossible or fails."""
        key = np.ascontiguousarray(z).tobytes()
        if self._last is None or self._last[0] != key or self._last[1] is None:
            self._last = key, None
            self._last = key, self._computed(np.ascontiguousarray(z))
        assert self._last[1] is not None
        return self._last[1]

    def tried(self, z: Array) -> RunCost | None:
        """The same, None for values with which the run is impossible or fails."""
        if self._last is not None and self._last[0] == np.ascontiguousarray(z).tobytes():
            return self._last[1]
        try:
            return self.judged(z)
        except Error:
            return None

    def _computed(self, z: Array) -> RunCost:
        self.evaluations += 1
        task = with_values(self.task, self.columns, z)
        if self._admit is not None:
            self._admit(task.p)
        goal = self.goal
        run = varied_run(task, self.columns, () if goal.integral is None else (goal.integral,))
        asked = {f"reach {k}": x for k, (x, _) in enumerate(goal.reach.values())}
        asked |= {"final": goal.final} if goal.final is not None else {}
        asked |= {"integrand": goal.integral} if goal.integral is not None else {}
        found = observed(task, self.columns, run, asked)
        late = _delay(task, run)

        def end(name: str) -> tuple[float, Array]:
            """A quantity at the end, and its gradient."""
            return float(found[name][-1]), found[f"change of {name}"][-1] + found[f"rate of {name}"][-1] * late

        cost, gradient = end("final") if goal.final is not None else (0.0, np.zeros(len(z)))
        if goal.integral is not None:
            cost += float(run.integrals[-1, 0])
            gradient = gradient + run.integral_changes[-1, 0] + found["integrand"][-1] * late
        ends = [end(f"reach {k}") for k in range(len(goal.reach))]
        wanted = np.array([value for _, value in goal.reach.values()])
        missing = np.array([value for value, _ in ends]) - wanted
        slopes = np.array([slope for _, slope in ends]).reshape(len(ends), len(z))
        if not (np.isfinite(cost) and np.isfinite(gradient).all() and np.isfinite(slopes).all()):
            raise RunError("the cost of the run or its gradient is not finite", code="E503")
        return RunCost(cost, gradient, missing, slopes)


def _delay(task: Task, run: VariedRun) -> Array:
    """How the end of the run moves: by the terminal event that ended it, otherwise not at all."""
    if run.outcome.status != RunStatus.TERMINAL or not run.hits:
        return np.zeros(run.changes.shape[2])
    return run.delays[-1]
