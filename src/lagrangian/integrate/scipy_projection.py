"""Projection for SciPy's solvers: their own state is moved, so that a multistep method keeps its order.

A method of one step (RK45, RK23, DOP853, Radau) goes on from the projected state and the derivative there. A multistep
method has a history. If it were restarted after every step, it would stay at order 1. If only its output were
projected, its own state would drift away. So the history is corrected by δ, by which the projection changed the last
state:

    BDF      backward differences ∇ʲ x_n, each of which contains x_n once:    D_j ← D_j + δ for all j
    LSODA    Nordsieck's vector (x, h ẋ, h² ẍ/2, …), of the last state:          the first entry ← + δ

δ is of the size of the step's own error, so the order is preserved. The output is projected in any case. A solver whose
history is not found at the expected place is restarted.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.codegen import Kernel, compile
from lagrangian.errors import RunError
from lagrangian.graph import Program
from lagrangian.integrate.projection import (
    CLOSED,
    MARGIN,
    MARGIN_TIME,
    MORE_STEPS,
    NEARLY_DEPENDENT,
    RESET,
    ROUNDING,
    SEEN,
    START,
    Drift,
    Projection,
    at_branch,
)
from lagrangian.integrate.scipy_weights import Weights

Array = NDArray[np.float64]
Control = Callable[[float, Array], Array]

NOT_FINITE = ("E502", "E503")

ONE_STEP = frozenset({"RK45", "RK23", "DOP853", "Radau"})
"""Methods without a history."""

NORDSIECK = 20
"""The index at which Nordsieck's vector begins in LSODA's work space (ODEPACK, opkda1.f)."""


class Projected:
    """The projected states of one run, and the record of their drift."""

    def __init__(self, projection: Projection, rates: Program, p: Array, weights: Weights) -> None:
        projection = projection.checked(rates)
        self.corrects, self.p, self.weights = projection.corrects, p, weights
        approach, landing = projection.approach, projection.landing(rates)
        self._approach: Kernel | None = None if approach is None else compile(approach, threads=1)
        self._landing: Kernel = compile(landing, threads=1)
        self.worst = Drift.blank(1)[0]

    @property
    def drift(self) -> Drift:
        """The drift so far."""
        return Drift.of_rows(self.worst[np.newaxis])

    def at_branch(self, t: float) -> bool:
        """Whether, shortly before t, the run has come near a position where rows depend on each other."""
        return at_branch(self.worst[MARGIN], self.worst[MARGIN_TIME], t)

    def state(self, t: float, x: Array, u: Control) -> tuple[Array, dict[str, float]]:
        """Return a projected state and the residuals; NaN if it cannot be projected."""
        x, first = np.array(x, float), 0.0
        try:
            if self._approach is not None:
                found = self._at(self._approach, t, x, u)
                first, x = float(found["gap"]), x + found["dx"]
            found = self._at(self._landing, t, x, u)
            if self._approach is None:
                first = float(found["rest"])
            for _ in range(0 if self._approach is None else MORE_STEPS):
                if self._approach is None or not found["rest"] > CLOSED:
                    break
                x = x + self._at(self._approach, t, x, u)["dx"]
                found = self._at(self._landing, t, x, u)
        except RunError as trouble:
            if trouble.code not in NOT_FINITE:
                raise
            return np.full_like(x, np.nan), {}
        if self.corrects:
            x = x + found["dx"]
        return x, {"before": first, "margin": np.inf, **{n: float(found[n]) for n in SEEN if n in found}}

    def _at(self, kernel: Kernel, t: float, x: Array, u: Control) -> dict[str, Array]:
        given = {"x": np.ascontiguousarray(x), "u": u(t, x), "p": self.p, "t": t}
        found: Any = kernel(**{name: value for name, value in given.items() if name in kernel.program.inputs})
        return found

    def _note(self, t: float, seen: dict[str, float], kind: int) -> None:
        if not seen:
            return
        gaps = [seen["before"], seen["gap"]] if kind else [seen[n] for n in ("before", "rest", "gap", "left")]
        place = slice(kind, kind + len(gaps))
        self.worst[place] = np.maximum(self.worst[place], gaps)
        if seen["margin"] < self.worst[MARGIN]:
            self.worst[MARGIN], self.worst[MARGIN_TIME] = seen["margin"], t

    def begin(self, t: float, x: Array, u: Control) -> Array:
        """Project the state from which a run starts."""
        moved, seen = self.state(t, x, u)
        self._note(t, seen, START)
        return moved

    def reset(self, t: float, x: Array, u: Control) -> Array:
        """Project the state after an event."""
        moved, seen = self.state(t, x, u)
        self._note(t, seen, RESET)
        return moved

    def settle(self, solver: Any, before: Array, u: Control) -> tuple[float, bool]:
        """Move a solver that made a step to the projected state, unless the correction is greater than the tolerances.

        Return the size of the correction in tolerances, and whether the solver must be restarted there.
        """
        moved, seen = self.state(solver.t, solver.y, u)
        change = moved - solver.y
        size = float(np.sqrt(np.mean((change / self.weights.between(before, moved)) ** 2)))
        rounding = ROUNDING * max(1.0, float(np.abs(moved).max()))
        worst, margin = max(seen["before"], seen["gap"]), min(seen["margin"], 1.0)
        if np.isfinite(size) and (margin < NEARLY_DEPENDENT or worst * math.sqrt(margin) <= rounding):
            size = 0.0
        if not size <= 1.0:
            return size, False
        self._note(solver.t, seen, 0)
        return size, self.corrects and not _moved(solver, moved, change)

    def along(self, dense: Any, u: Control) -> Any:
        """A solver's values inside a step, projected: t → x (nx,), or times (k,) → (nx, k)."""
        if not self.corrects:
            return dense

        def inside(t: Any) -> Array:
            if np.ndim(t) == 0:
                return self.state(float(t), dense(t), u)[0]
            columns = [self.state(float(at), x, u)[0] for at, x in zip(t, dense(t).T, strict=True)]
            return np.array(columns).reshape(len(t), -1).T

        return inside


def _moved(solver: Any, state: Array, change: Array) -> bool:
    """Put a state into a solver; return whether the solver can continue from it."""
    name, size = type(solver).__name__, float(np.abs(solver.y).max())
    if name == "BDF" and np.allclose(solver.D[0], solver.y, 1e-12, 1e-12 * size):
        solver.D[: solver.order + 3] += change
        solver.y = state
        return True
    if name == "LSODA":
        work = solver._lsoda_solver._integrator.rwork[NORDSIECK : NORDSIECK + len(state)]
        if not np.array_equal(work, solver.y):
            return False
        work[:], solver.y = state, state
        return True
    if name in ONE_STEP:
        solver.y, solver.f = state, solver.fun(solver.t, state)
        return True
    return False
