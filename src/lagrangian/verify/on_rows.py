"""States that satisfy the rows of a system's constraints, for what is compared at random states."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeAlias

import numpy as np

from lagrangian import dynamics
from lagrangian.graph import Program
from lagrangian.model import Model
from lagrangian.verify.states import evaluated

Groups: TypeAlias = Mapping[str, list[float]]

STEPS = 60
"""Newton steps after which a position counts as one that cannot be assembled."""

LONGEST = 0.5
"""The longest step of a coordinate."""

CLOSED = 1e-12
"""What is left of the rows, in parts of their size."""


class OnRows:
    """Moves states of a model onto its rows: q by Newton's method, then v by one step, both in the metric of M."""

    def __init__(self, model: Model) -> None:
        self.position = dynamics.correction(model)
        self.velocity = dynamics.correction(model, position=False)

    def of(self, state: Groups) -> dict[str, list[float]] | None:
        """The state with q and v on the rows; None where no position near it was found."""
        found = {group: list(x) for group, x in state.items()}
        if self.position is not None and not self._closed(found, self.position):
            return None
        if self.velocity is not None:
            step = self._step(self.velocity, found, "dv")
            if step is None:
                return None
            found["v"] = [float(x) for x in np.array(found["v"]) + step[0]]
        return found

    def _closed(self, found: dict[str, list[float]], program: Program) -> bool:
        for _ in range(STEPS):
            step = self._step(program, found, "dq")
            if step is None:
                return False
            dq, gap = step
            dq *= min(1.0, LONGEST / float(np.max(np.abs(dq), initial=LONGEST)))
            found["q"] = [float(x) for x in np.array(found["q"]) + dq]
            if gap < CLOSED:
                return True
        return False

    def _step(self, program: Program, found: Groups, name: str) -> tuple[np.ndarray, float] | None:
        """A correction and the gap before it; None where there is none."""
        try:
            made = evaluated(program, found)
        except (ZeroDivisionError, ValueError, OverflowError):
            return None
        step = np.array(made[name], float)
        return (step, float(made["gap"])) if np.isfinite(step).all() else None
