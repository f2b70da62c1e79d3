"""Holds the derivatives of runs against difference quotients of ordinary runs, which know no variational equations.

(y(z + h d) − y(z − h d))/2h = (∂y/∂z) d + O(h²)        at h, h/2 and h/4, extrapolated to h → 0 (Richardson)
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian import codegen as machine
from lagrangian import dynamics
from lagrangian.errors import Error, RunError
from lagrangian.integrate import RunStatus
from lagrangian.page.formula import Check, text
from lagrangian.records import dataclass
from lagrangian.simulate.integrating import Task, remembered, run

Array = NDArray[np.float64]

TOLERANCE = 1e-4
"""The allowed difference from a quotient, relative to the largest one: the accuracy of quotients of runs."""

SETTLED = 1e-5
"""A quotient is used if its last refinement changed it by at most this, relative to the largest one."""

WIDTH = 1e-3
"""The largest of the three steps of a quotient, relative to the unit of each unknown."""

TIGHT = 1e-12
"""The relative tolerance of the runs whose differences are taken."""


@dataclass(frozen=True, eq=False)
class PlainRun:
    """A run without variational equations: states (S, nx) at times (S,), and the times of its events."""

    task: Task
    t: Array
    x: Array
    hits: Array

    def quantities(self, asked: Mapping[str, Any]) -> dict[str, Array]:
        """Expressions or points by name, at all times."""
        model, feedback = self.task.model, self.task.drive.feedback
        key = ("plain quantities", tuple(asked.items()), frozenset(feedback.items()))
        kernel = remembered(model, key, lambda: machine.compile(dynamics.observe_closed(model, asked, feedback)))
        answer = kernel(np.ascontiguousarray(self.x), self.task.drive.at(self.t, self.x), self.task.p, self.t)
        return answer if isinstance(answer, dict) else {next(iter(kernel.program.outputs)): answer}


def plain_run(task: Task) -> PlainRun:
    """Integrate a task without variational equations, by tight tolerances. Raises `RunError` if the run fails."""
    found = run(replace(task, rtol=min(task.rtol, TIGHT), atol=min(task.atol, TIGHT * 1e-3)))
    if found.status < 0:
        raise RunError(f"it ends at t = {found.reached:.6g} s: {found.reason or found.status.message}", code="E503")
    t, x = found.times, found.states[:, : task.size]
    if found.status != RunStatus.REACHED and found.reached > t[-1]:
        t, x = np.append(t, found.reached), np.vstack([x, found.final[: task.size]])
    return PlainRun(task, t, x, np.array([h.time for h in found.hits]))


def direction(unit: Array, seed: int = 1) -> Array:
    """A direction in which every unknown changes by its unit, up or down."""
    return unit * np.random.default_rng(seed).choice((-1.0, 1.0), len(unit))


def units_of(z: Array) -> Array:
    """The size of every unknown, 1 for one that is 0."""
    return np.where(z != 0, np.abs(z), 1.0)


def held(what: str, exact: Array, values: Callable[[Array], Array], z: Array, d: Array, least: float = 0.0) -> Check:
    """Return the check of ``exact`` = (∂y/∂z) d against quotients of ``values``, the function y.

    The entries must be comparable. ``least`` is the size to which a difference is related where all derivatives are
    smaller, as at a minimum. Where the quotients do not settle, or a run beside z fails, nothing is checked.
    """
    widths = (WIDTH, WIDTH / 2, WIDTH / 4)
    try:
        first, second, third = ((values(z + h * d) - values(z - h * d)) / (2 * h) for h in widths)
    except Error as error:
        return Check(text(what), None, f"not checked: a run with values beside these fails: {error.what}")
    coarse, fine = (4 * second - first) / 3, (4 * third - second) / 3
    quotients = (16 * fine - coarse) / 15
    size = max(float(np.max(np.abs(quotients), initial=0.0)), least) or 1.0
    if not float(np.max(np.abs(fine - coarse), initial=0.0)) <= SETTLED * size:
        return Check(text(what), None, "not checked: the difference quotients do not settle")
    return _judged(what, exact - quotients, size)


def agree(what: str, found: Array, expected: Callable[[], Array], size: float) -> Check:
    """Return the check that values equal those of an ordinary run, relative to ``size``."""
    try:
        other = expected()
    except Error as error:
        return Check(text(what), None, f"not checked: {error.what}")
    return _judged(what, found - other, size or 1.0)


def _judged(what: str, difference: Array, size: float) -> Check:
    worst = float(np.max(np.abs(difference), initial=0.0)) / size
    return Check(text(what), worst < TOLERANCE, f"largest relative difference {worst:.1e}")
