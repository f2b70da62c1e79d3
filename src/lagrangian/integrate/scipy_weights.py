"""The error that a step of SciPy's solvers may make in each component of the state.

    w_i = atol + rtol |x_i|                           as SciPy has it
    w_i = atol + rtol max_{s ≤ t} |x_i(s)| + rtol |x_i|   over a run

With the first, w_i falls to atol where a component passes zero, twice in every oscillation. LSODA estimates how stiff a
problem is in the norm with these weights: it takes an oscillation for a stiff problem there, lowers its order and
shortens its steps. At 1e-12 it changes to its stiff method for good, and errs more than at 1e-11. With the second it
keeps one order and one length of steps, so that smaller tolerances are of use.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Weights:
    """``rtol`` and ``atol`` (nx,) as a solver takes them; ``atol`` is updated in place while a run goes on."""

    def __init__(self, rtol: float, atol: float | Array, x: Array, *, over_run: bool) -> None:
        self.rtol, self.over_run = rtol, over_run
        self._base, self._largest = np.broadcast_to(np.asarray(atol, float), x.shape), np.zeros(x.shape)
        self.atol: Array = np.array(self._base)
        self.note(x)

    def note(self, x: Array) -> None:
        """A state of the run."""
        if self.over_run:
            np.maximum(self._largest, np.abs(x), out=self._largest)
            np.multiply(self._largest, self.rtol, out=self.atol)
            self.atol += self._base

    def between(self, before: Array, after: Array) -> Array:
        """The weights of a step from one state to another, (nx,)."""
        return self.atol + self.rtol * np.maximum(np.abs(before), np.abs(after))
