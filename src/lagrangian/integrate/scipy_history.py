"""The history of a multistep method of SciPy: taken back after a step that is rejected from outside, at a shorter step.

A new solver would begin at order 1, and so would the next one; a run that rejects now and then would stay there.

BDF holds the backward differences ∇ʲ x_n of its interpolating polynomial. For a step that is shorter by a factor r they
are those of the same polynomial at the points t_n − i r h (Shampine and Reichelt, The MATLAB ODE Suite, 1997, eq. 3.2):

    D ← (R U)ᵀ D,    R_ij = Π_{k=1}^{i} (k − 1 − r j)/k,    U = R at r = 1.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.records import dataclass

Array = NDArray[np.float64]

LEAST_FACTOR = 0.2
"""The most that a step is made shorter at once."""

SAFETY = 0.9


@dataclass(frozen=True, eq=False)
class History:
    """What a solver knew before a step."""

    t: float
    y: Array
    D: Array
    h: float
    order: int

    @staticmethod
    def of(solver: Any) -> History | None:
        """The history of a solver that can take a step back; None for any other."""
        if type(solver).__name__ != "BDF":
            return None
        return History(solver.t, solver.y, solver.D.copy(), solver.h_abs, solver.order)

    def retry(self, solver: Any, size: float) -> None:
        """Put a solver back to before its step, with a shorter one; ``size`` is the error of that in tolerances."""
        taken = abs(solver.t - self.t)
        factor = max(LEAST_FACTOR, min(0.5, SAFETY * size ** (-1 / (self.order + 1)))) if np.isfinite(size) else 0.5
        solver.t, solver.y, solver.order = self.t, self.y, self.order
        solver.D[:] = self.D
        rescale(solver.D, self.order, factor * taken / self.h)
        solver.h_abs, solver.n_equal_steps, solver.LU = factor * taken, 0, None
        solver.status = "running"


def rescale(D: Array, order: int, factor: float) -> None:
    """Change backward differences to those of the same polynomial at a step that is ``factor`` times as long."""
    D[: order + 1] = (_turned(order, factor) @ _turned(order, 1.0)).T @ D[: order + 1]


def _turned(order: int, factor: float) -> Array:
    """R: the differences at a changed step of the polynomials of Newton's form."""
    i, j = np.arange(1, order + 1)[:, np.newaxis], np.arange(1, order + 1)
    steps = np.zeros((order + 1, order + 1))
    steps[1:, 1:], steps[0] = (i - 1 - factor * j) / i, 1.0
    return np.asarray(np.cumprod(steps, axis=0), float)
