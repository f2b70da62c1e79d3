"""What is minimized, φ(x, u, p, t) at the end of a run + ∫ c(x, u, p, t) dt, with its exact gradient.

Where a terminal event ends the run, its end moves: dφ = δφ + φ̇ δt, d∫c dt = δ∫c dt + c δt.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.errors import Error, RunError
from lagrangian.integrate import RunStatus
from lagrangian.page.formula import Check
from lagrangian.records import dataclass
from lagrangian.simulate import quotients
from lagrangian.simulate.admission import Admission, fitness
from lagrangian.simulate.allowance import Allowance
from lagrangian.simulate.inputs import SampledInput
from lagrangian.simulate.integrating import Task
from lagrangian.simulate.sensitivities import observed
from lagrangian.simulate.unknowns import with_values
from lagrangian.simulate.varied import Columns, VariedRun, varied_run

Array = NDArray[np.float64]

PIECES = 200
"""The number of even pieces into which a run is cut where an integral is computed by quadrature."""

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
        self.allowance: Allowance | None = None  # of a search that goes on

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
        if self.allowance is not None:
            self.allowance.check()
            self.allowance.take()
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

    def checks(self, z: Array, first: RunCost, unit: Array) -> tuple[Check, ...]:
        """Hold cost, what is missing and their gradients against ordinary runs, without variational equations.

        At a minimum the gradient is 0: a difference is related to the gradient of the first guess.
        """
        best, d = self.judged(z), quotients.direction(unit)
        size = np.array([max(abs(best.cost), abs(first.cost)) or 1.0, *np.maximum(np.abs(first.missing), 1.0)])
        slopes = np.array([best.gradient, *best.slopes]) @ d / size
        least = float(np.max(np.abs(np.array([first.gradient, *first.slopes]) @ d / size)))

        def values(given: Array) -> Array:
            return self._plain(given) / size

        return (
            quotients.agree(
                "the run, integrated without variational equations, has the same cost and end",
                np.array([best.cost, *best.missing]) / size,
                lambda: values(z),
                1.0,
            ),
            quotients.held("the gradients equal difference quotients of such runs", slopes, values, z, d, least),
        )

    def _plain(self, z: Array) -> Array:
        """Cost and what is missing, by ordinary runs and Gauss's quadrature of the integrand between its kinks."""
        goal, task = self.goal, with_values(self.task, self.columns, z)
        run = quotients.plain_run(task)
        asked = {f"reach {k}": x for k, (x, _) in enumerate(goal.reach.values())}
        asked |= {"final": goal.final} if goal.final is not None else {}
        found = run.quantities(asked) if asked else {}
        cost = float(found["final"][-1]) if goal.final is not None else 0.0
        if goal.integral is not None:
            cost += _quadrature(task, run, goal.integral)
        ends = [float(found[f"reach {k}"][-1]) - value for k, (_, value) in enumerate(goal.reach.values())]
        return np.array([cost, *ends])


def _quadrature(task: Task, run: quotients.PlainRun, integrand: sp.Expr) -> float:
    """∫ c dt by Gauss's quadrature with five nodes on short pieces between samples, knots of tables and events."""
    begin, end = float(run.t[0]), float(run.t[-1])
    knots = [s.times for s in task.drive.sources if isinstance(s, SampledInput)]
    edges = np.unique(np.concatenate([np.linspace(begin, end, PIECES + 1), run.t, run.hits, *knots]))
    edges = edges[(edges >= begin) & (edges <= end)]
    edges = edges[np.append(True, np.diff(edges) > 1e-12 * (end - begin))]
    x, w = np.polynomial.legendre.leggauss(5)
    half = np.diff(edges)[:, None] / 2
    nodes = (edges[:-1, None] + half * (1 + x)).ravel()
    made = quotients.plain_run(replace(task, times=np.array([begin, *nodes, float(task.times[-1])])))
    if len(made.t) < len(nodes) + 2:
        raise RunError("an event ends it at another time", code="E503")
    values = made.quantities({"integrand": integrand})["integrand"][1 : len(nodes) + 1]
    return float((half * w).ravel() @ values)


def _delay(task: Task, run: VariedRun) -> Array:
    """How the end of the run moves: by the terminal event that ended it, otherwise not at all."""
    if run.outcome.status != RunStatus.TERMINAL or not run.hits:
        return np.zeros(run.changes.shape[2])
    return run.delays[-1]
