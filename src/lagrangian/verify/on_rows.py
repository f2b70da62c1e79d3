"""States that satisfy the rows of a system's constraints, for what is compared at random states."""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping
from typing import TypeAlias

import numpy as np
import sympy as sp

from lagrangian import dynamics
from lagrangian.derive.sample import Sampler
from lagrangian.graph import Program
from lagrangian.model import Model
from lagrangian.model.rows import named_conditions
from lagrangian.verify.states import evaluated, state_groups

Groups: TypeAlias = dict[str, list[float]]
State: TypeAlias = dict[sp.Basic, float]

DRAWS = 12
"""Random states that are tried for each that is asked for."""

STEPS = 60
"""Newton steps after which a position counts as one that cannot be assembled."""

LONGEST = 0.5
"""The longest step of a coordinate."""

POLISHED = 4
"""Newton steps with the rows that are clearly independent."""

CLEARLY = 1e-4
"""The part of the largest singular value from which on a direction is clearly one of the rows'."""

HARDLY = 1e-9
"""The part below which a direction is clearly none of them."""

MOST_BENT = 1e3
"""The most that a row's second rate may be, in squares of the rates."""

RANKED = 8
"""Random positions from which the usual rank of the rows is found."""

NEARBY = 1e-4
"""How far on both sides the rows are looked at once more."""

CLOSED = 1e-12
"""What is left of the rows, in parts of their size."""


class OnRows:
    """Moves states of a model onto its rows: q by Newton's method, then v by one step, both in the metric of M."""

    def __init__(self, model: Model) -> None:
        self.model = model
        self.position = dynamics.correction(model)
        self.velocity = dynamics.correction(model, position=False)
        self.residual, self.matrix = dynamics.residual(model), dynamics.constraint_matrix(model)
        self.positions = [named.condition.on_positions for named in named_conditions(model)]
        self._rank: int | None = None

    def states(self, sampler: Sampler, count: int, seed: int, *, given: bool = False) -> Iterator[tuple[State, Groups]]:
        """Up to ``count`` random states on the rows; with ``given`` the parameters keep the values they have."""
        coordinates, left = self.model.coordinates, count
        values: State = {**self.model.values} if given else {}
        for state, _ in sampler.states(DRAWS * count, seed=seed):
            state.update(values)
            groups = self.of(state_groups(self.model, state))
            if groups is None:
                continue
            state.update({c.symbol: x for c, x in zip(coordinates, groups["q"], strict=True)})
            state.update({c.rate: x for c, x in zip(coordinates, groups["v"], strict=True)})
            if np.isfinite(sampler.at(state)).all():
                left -= 1
                yield state, groups
                if not left:
                    return

    def of(self, state: Mapping[str, list[float]]) -> dict[str, list[float]] | None:
        """The state with q and v on the rows; None where no position near it was found.

        Positions of a special kind, where rows that are independent elsewhere depend on each other, are left out: there
        the motion can branch, and neighbours move in other ways.
        """
        if self._rank is None:
            self._rank = self._usual_rank(state)
        found = {group: list(x) for group, x in state.items()}
        if self.position is not None and not (self._closed(found, self.position) and self._polished(found)):
            return None
        if self.velocity is not None:
            step = self._step(self.velocity, found, "dv")
            if step is None:
                return None
            found["v"] = [float(x) for x in np.array(found["v"]) + step[0]]
        return found if self._moderate(found) else None

    def _usual_rank(self, state: Mapping[str, list[float]]) -> int:
        """The largest rank of the rows at positions that satisfy them, found from random ones."""
        if self.position is None or sum(self.positions) < 2:
            return 0
        draw, largest = random.Random(len(state["q"])), 0
        for _ in range(RANKED):
            found = {**state, "q": [draw.uniform(-1.5, 1.5) for _ in state["q"]]}
            if self._closed(found, self.position) and (sizes := self._sizes(found)) is not None:
                largest = max(largest, int((sizes > CLEARLY * sizes.max()).sum()))
        return largest

    def _sizes(self, found: Groups) -> np.ndarray | None:
        """The singular values of the rows on positions; None where they cannot be evaluated, and for frames that float,
        whose coordinates are not as many as their velocities."""
        try:
            A = np.array(evaluated(self.matrix, found)["A"], float).reshape(len(self.positions), -1)
        except (ZeroDivisionError, ValueError, OverflowError):
            return None
        return np.linalg.svd(A[self.positions], compute_uv=False) if len(found["q"]) == A.shape[1] else None

    def _moderate(self, found: Groups) -> bool:
        """Whether the rows bend no more than usual there: not where two points of a rope or a rod almost coincide.

        On a straight line such a row only changes its sign, so its coefficients are compared on both sides too.
        """
        q = np.array(found["q"])
        sides = [{**found, "q": [float(x) for x in q + step]} for step in (-NEARBY, NEARBY)]
        try:
            made = evaluated(self.matrix, found)
            before, after = (np.array(evaluated(self.matrix, side)["A"], float) for side in sides)
        except (ZeroDivisionError, ValueError, OverflowError):
            return False
        bend = np.abs(np.array(made["gamma"], float)).max(initial=0.0)
        speed = np.abs(np.array(found["v"], float)).max(initial=0.0)
        turned = np.abs(after - before).max(initial=0.0)
        return bool(bend <= MOST_BENT * (1.0 + speed**2) and turned <= MOST_BENT * 2 * NEARBY * np.abs(after).max())

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

    def _polished(self, found: Groups) -> bool:
        """Take the last digits by the rows that are clearly independent there; False if that leads nowhere.

        Where one row depends on the others along the whole motion (three equal cranks on one platform), its pivot is
        not zero beside the motion but tiny, and what is divided by it is noise.
        """
        for _ in range(POLISHED):
            try:
                f = np.array(evaluated(self.residual, found)["f"], float)
                A = np.array(evaluated(self.matrix, found)["A"], float).reshape(len(self.positions), -1)
            except (ZeroDivisionError, ValueError, OverflowError):
                return False
            if len(found["q"]) != A.shape[1]:
                return True  # quasi-velocities: Newton's own steps have to do
            sizes = np.linalg.svd(A[self.positions], compute_uv=False)
            if np.any((sizes > HARDLY * sizes.max()) & (sizes < CLEARLY * sizes.max())):
                return False  # near a position where the motion branches: no digits are certain there
            if (sizes >= CLEARLY * sizes.max()).sum() < (self._rank or 0):
                return False
            step = np.linalg.pinv(A[self.positions], rcond=CLEARLY) @ f
            if not np.isfinite(step).all():
                return False
            found["q"] = [float(x) for x in np.array(found["q"]) - step]
        return True

    def _step(self, program: Program, found: Groups, name: str) -> tuple[np.ndarray, float] | None:
        """A correction and the gap before it; None where there is none."""
        try:
            made = evaluated(program, found)
        except (ZeroDivisionError, ValueError, OverflowError):
            return None
        step = np.array(made[name], float)
        return (step, float(made["gap"])) if np.isfinite(step).all() else None
