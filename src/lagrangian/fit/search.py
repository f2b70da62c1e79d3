"""The search of a fit: SciPy's least squares, from the first guess and by way of the beginnings of the runs."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import OptimizeResult, least_squares

from lagrangian.errors import Error
from lagrangian.fit.problem import FitProblem
from lagrangian.simulate.allowance import Allowance, OutOfTimeError
from lagrangian.simulate.guesses import Bounds

Array = NDArray[np.float64]

TOLERANCE = 1e-10
"""The search ends if a step changes the sum of squares or the unknowns by less than this fraction."""

BEGINNINGS = (1 / 16, 1 / 8, 1 / 4, 1 / 2)
"""The shares of the runs that are fitted one after another to find a start for the whole."""

SAMPLES_FOR_EACH = 3
"""The smallest number of samples for each unknown in such a share."""

OUT_OF_TIME = -2
"""The status of a search that `timeout` ended."""

ENDED = {
    -1: "SciPy refused the problem",
    OUT_OF_TIME: "timeout was not enough",
    0: "max_evaluations were not enough",
    1: "the slope of the sum of squares is 0",
    2: "the sum of squares no longer changes",
    3: "the unknowns no longer change",
    4: "neither the sum of squares nor the unknowns change any more",
}
"""How the search ended, by SciPy's status and `OUT_OF_TIME`."""


def searched(problem: FitProblem, z0: Array, bounds: Bounds, sigma: Array, allowance: Allowance) -> Any:
    """The better one of two searches: from the first guess, and from what fits growing beginnings of the runs.

    Over a long run the sum of squares of a motion that oscillates, or is chaotic, has many minima, over its beginning
    few.
    """
    direct = search(problem, z0, bounds, sigma, allowance)
    z = z0
    for share in BEGINNINGS:
        part = problem.beginning(share)
        if part.count < SAMPLES_FOR_EACH * len(z0) or allowance.used_up:
            continue
        try:
            part.compared(z)
            z = search(part, z, bounds, sigma, allowance).x
        except Error:  # this way leads to runs that are impossible; the direct one is left
            return direct
    if allowance.used_up or np.array_equal(z, z0) or not np.isfinite(problem.residuals(z, sigma)).all():
        return direct
    grown = search(problem, z, bounds, sigma, allowance)
    return grown if grown.cost < direct.cost else direct


def search(problem: FitProblem, z0: Array, bounds: Bounds, sigma: Array, allowance: Allowance) -> Any:
    """SciPy's trust-region search; a start on a bound is moved inside by SciPy itself.

    It takes at most `Allowance.part` evaluations, and returns the best unknowns so far if the time is over.
    """
    scale = np.where(z0 != 0, np.abs(z0), 1.0)
    best = OptimizeResult(x=z0, cost=np.inf, status=OUT_OF_TIME, success=False, nfev=0)

    def residuals(z: Array) -> Array:
        if best.nfev and allowance.over:
            raise OutOfTimeError
        best.nfev += 1
        found = problem.residuals(np.ascontiguousarray(z), sigma)
        cost = 0.5 * float(found @ found)
        if cost < best.cost:
            best.x, best.cost = np.array(z), cost
        return found

    try:
        return least_squares(
            residuals,
            z0,
            jac=lambda z: problem.slopes(np.ascontiguousarray(z), sigma),  # type: ignore[arg-type]
            bounds=bounds,
            x_scale=scale,
            method="trf",
            ftol=TOLERANCE,
            xtol=TOLERANCE,
            gtol=TOLERANCE,
            max_nfev=allowance.part(),
        )
    except OutOfTimeError:
        best.active_mask = np.zeros(len(z0), np.int64)  # SciPy keeps its iterates strictly inside
        return best
    finally:
        allowance.take(best.nfev)
