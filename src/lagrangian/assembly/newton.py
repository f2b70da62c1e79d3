"""Many guesses at once, each moved onto the rows by damped Newton steps of least motion.

    δq = −N M⁻¹ Aᵀ (A M⁻¹ Aᵀ)⁺ f

The metric is M, so that the steps do not depend on the units of the coordinates. A step turns no angle by more than
1 rad, and is halved while it makes the gap larger.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lagrangian import codegen, dynamics
from lagrangian.codegen import Kernel
from lagrangian.model import Model

Array = NDArray[np.float64]

MAX_STEPS = 60
"""Newton steps: a start that is going to close needs five."""

HALVINGS = 12
"""How often one step is halved."""

MAX_TURN = 1.0
"""[rad] The most that one step turns an angle."""

SETTLED = 1e-12
"""A step of this part of the coordinates ends the search."""

SEEN = 1e-9
"""A change of a gap that is more than rounding."""

CLOSED = 1e-11
"""A gap of this part of the terms that make it up is none."""


@dataclass(frozen=True)
class LoopSearch:
    """The compiled programs of one search: which coordinates stay as they are, and what the rows say of a state."""

    model: Model
    fixed: tuple[str, ...]
    correct: Kernel
    rows: Kernel
    matrix: Kernel

    @classmethod
    def of(cls, model: Model, fixed: Sequence[str]) -> LoopSearch | None:
        """The search for a model; None where no row is on positions."""
        step = dynamics.correction(model, fixed, position=True)
        if step is None:
            return None
        kernels = [
            codegen.compile(program, optional={"u": 0.0, "v": 0.0, "t": 0.0})
            for program in (step, dynamics.residual(model), dynamics.constraint_matrix(model))
        ]
        return cls(model, tuple(fixed), *kernels)

    def angles(self, q: Array, p: Array, t: float) -> NDArray[np.bool_]:
        """Which coordinates are angles: those that the rows depend on, but not on a whole turn of them."""
        return self.moving(q, p, t) & ~self._changes(q, p, t, [2 * np.pi])

    def moving(self, q: Array, p: Array, t: float) -> NDArray[np.bool_]:
        """Which coordinates the rows depend on."""
        return self._changes(q, p, t, [0.37, 1.1])

    def _changes(self, q: Array, p: Array, t: float, by: Sequence[float]) -> NDArray[np.bool_]:
        """Which coordinates change the gaps by more than rounding where they are changed; looked at three places."""
        n = len(q)
        found = np.zeros(n, bool)
        for place in (q, q + np.linspace(0.3, 1.1, n), q - np.linspace(0.7, 0.2, n)):
            here = self.gaps(place[None, :], p, t)
            for step in by:
                there = self.gaps(place + step * np.eye(n), p, t)
                found |= np.abs(there - here).max(axis=-1) > SEEN * (1.0 + np.abs(here).max())
        return found

    def gaps(self, q: Array, p: Array, t: float) -> Array:
        """f of every row on positions, shape (guesses, rows)."""
        return np.asarray(self.rows(q, None, None, p, t)["f"])

    def closed(self, q: Array, p: Array, t: float) -> NDArray[np.bool_]:
        """Whether every gap is rounding, measured by the terms Σ |A_rj| |q_j| that it is made of."""
        sizes = np.abs(np.asarray(self.matrix(q, None, None, p, t)["A"]))
        scale = 1.0 + sizes.max(axis=(-1, -2)) * np.maximum(np.abs(q).max(axis=-1), 1.0)
        return np.abs(self.gaps(q, p, t)).max(axis=-1) <= CLOSED * scale

    def run(self, guesses: Array, p: Array, t: float) -> tuple[Array, NDArray[np.bool_]]:
        """Move every guess (rows of (guesses, n)) towards the rows; where it ends, and whether it closed."""
        q, angles = guesses.copy(), self.angles(guesses[0], p, t)
        going = np.arange(len(q))
        for _ in range(MAX_STEPS):
            step = self._step(q[going], p, t, angles)
            q[going], settled = self._damped(q[going], step, p, t)
            going = going[~settled]
            if not len(going):
                break
        return q, self.closed(q, p, t)

    def _step(self, q: Array, p: Array, t: float, angles: NDArray[np.bool_]) -> Array:
        step = np.asarray(self.correct(q, None, None, p, t)["dq"])
        turn = np.abs(np.where(angles, step, 0.0)).max(axis=-1, keepdims=True)
        return step * np.minimum(1.0, MAX_TURN / np.maximum(turn, MAX_TURN))

    def _damped(self, q: Array, step: Array, p: Array, t: float) -> tuple[Array, NDArray[np.bool_]]:
        """q after a step that does not enlarge the gap, and whether it has settled there."""
        before = np.linalg.norm(self.gaps(q, p, t), axis=-1)
        tiny = np.abs(step).max(axis=-1) <= SETTLED * (1.0 + np.abs(q).max(axis=-1))
        length = np.ones((len(q), 1))
        taken = q + step
        for _ in range(HALVINGS):
            worse = (np.linalg.norm(self.gaps(taken, p, t), axis=-1) > before) & ~tiny
            if not worse.any():
                break
            length[worse] *= 0.5
            taken = q + length * step
        worse = (np.linalg.norm(self.gaps(taken, p, t), axis=-1) > before) & ~tiny
        return np.where(worse[:, None], q, taken), tiny | worse
