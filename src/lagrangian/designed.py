"""The verbs of a system that run it many times to find values: fit, optimize."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from lagrangian.calls import worded
from lagrangian.simulated import Simulated

if TYPE_CHECKING:  # imported here only for types: describing a system does not have to wait for SciPy
    from numpy.typing import ArrayLike

    from lagrangian.fit.base_parameters import BaseParameters
    from lagrangian.fit.result import Fit
    from lagrangian.optimize.result import Optimum
    from lagrangian.simulate.events import Event


@worded
class Designed(Simulated):
    """The methods that find parameters, initial values and inputs of runs."""

    def fit(
        self,
        data: Any,
        parameters: Sequence[Any] | Mapping[Any, Any] | str,
        *,
        initial: Any = None,
        params: Mapping[Any, Any] | Sequence[Mapping[Any, Any]] | None = None,
        inputs: Mapping[Any, Any] | Sequence[Mapping[Any, Any]] | None = None,
        sigma: float | Mapping[str, float] | None = None,
        bounds: Mapping[Any, Any] | None = None,
        start: float | str | None = None,
        method: str | None = None,
        step: float | str | None = None,
        rtol: float = 1e-8,
        atol: float = 1e-11,
        events: Sequence[Event] | Event = (),
        max_step: float | str = math.inf,
        max_steps: int = 1_000_000,
        max_events: int = 100_000,
        timeout: float | None = None,
        max_evaluations: int = 500,
        **initial_by_name: Any,
    ) -> Fit:
        """Find the parameters and initial values whose runs fit measured data best; return a `lagrangian.Fit`.

        >>> import numpy as np
        >>> from lagrangian import example
        >>> pendulum, t = example("pendulum"), np.linspace(0, 2, 41)
        >>> swing = pendulum.simulate(times=t, theta=0.5, params={"L": 0.8})
        >>> found = pendulum.fit({"t": t, "theta": swing["theta"]}, ["L", "theta"])
        >>> round(found.estimate["L"], 6)
        0.8

        ``data`` are columns by name, ``{"t": times, "theta1": values}`` or ``{"theta1": (times, values)}``, a data
        frame of pandas, or a list of these, one for each run. A name may be any expression; NaN is a missing sample.
        ``parameters`` names the unknowns, or maps them to first guesses (by default their declared values). The name of
        a state is its unknown initial value, another one in each run: ``theta1[0]``, ``theta1[1]``, … ``bounds`` maps
        names to ``(low, high)``.

        It minimizes Σ (model − data)²/σ² by SciPy's `least_squares` with the exact derivatives of the runs. ``sigma``
        is the standard deviation of the noise of the columns; where it is not given it is estimated, for each column,
        from what is left over. A run begins at ``start``, by default at its first time. ``initial``, ``params`` and
        ``inputs`` are those of `simulate`, or lists with one mapping for each run; the others are its options, too.

        ``max_evaluations``, of all runs together, and ``timeout`` [s] limit the whole search; the best so far is then
        returned, with ``success`` False.

        Raises `RunError` for data, names and guesses that do not fit, and what `Trajectory.sensitivities` raises.
        """
        from lagrangian.fit.verb import FitOptions, fit

        run_options = {
            "method": method, "step": step, "rtol": rtol, "atol": atol, "events": events, "max_step": max_step,
            "max_steps": max_steps, "max_events": max_events, "timeout": timeout,
        }  # fmt: skip
        options = FitOptions(initial, params, inputs, sigma, bounds, start, max_evaluations)
        return fit(self.model, data, parameters, options, initial_by_name, run_options)

    def optimize(
        self,
        unknowns: Sequence[Any] | Mapping[Any, Any] | str,
        duration: float | str | None = None,
        *,
        final: Any = None,
        integral: Any = None,
        reach: Mapping[Any, Any] | None = None,
        bounds: Mapping[Any, Any] | None = None,
        initial: Mapping[Any, Any] | None = None,
        params: Mapping[Any, Any] | None = None,
        inputs: Mapping[Any, Any] | None = None,
        times: ArrayLike | Sequence[float | str] | None = None,
        samples: int | None = None,
        start: float | str = 0.0,
        method: str | None = None,
        step: float | str | None = None,
        rtol: float = 1e-8,
        atol: float = 1e-11,
        events: Sequence[Event] | Event = (),
        max_step: float | str = math.inf,
        max_steps: int = 1_000_000,
        max_events: int = 100_000,
        timeout: float | None = None,
        max_evaluations: int = 500,
        tolerance: float = 1e-9,
        **initial_by_name: Any,
    ) -> Optimum:
        """Find the parameters, initial values and inputs that make a run best; return a `lagrangian.Optimum`.

        >>> from lagrangian import System
        >>> cart = System("cart")
        >>> x, F = cart.coordinate("x"), cart.input("F")
        >>> _ = cart.particle(1.0, at=cart.origin + (x, 0))
        >>> _ = cart.force((F, 0), at=cart.origin + (x, 0))
        >>> push = {"F": ([0, 1], [0.0, 0.0])}
        >>> best = cart.optimize("F", 1.0, integral="F^2", reach={"x": 1, "x'": 0}, inputs=push)
        >>> round(best.cost, 4), best.inputs["F"][1].round(3)  # the least effort from rest to rest: 6 − 12 t
        (12.0, array([ 6., -6.]))

        It minimizes ``final`` + ∫ ``integral`` dt, expressions of state, inputs, parameters and t, the first at the end
        of the run. ``reach`` maps expressions to the values that they must have at the end. ``unknowns`` names them, or
        maps them to first guesses: parameters (also in expressions of inputs), states, for their initial values, and
        inputs, constants or tables, of which every value is an unknown, ``F[0]``, ``F[1]``, … ``bounds`` maps names to
        ``(low, high)``. A terminal event may end the run; its time is then part of what is optimized.

        The search is SciPy's L-BFGS-B, with ``reach`` SLSQP, with the exact gradients of the run. It is local, ends if
        a step improves the cost by less than ``tolerance``, relatively, or after ``max_evaluations`` of the run or
        ``timeout`` [s] in all, with ``success`` False. All other options are those of `simulate`. Raises `RunError` for
        what does not fit, and what `Trajectory.sensitivities` raises.
        """
        from lagrangian.optimize.verb import OptimizeOptions, optimize

        run_options = {
            "duration": duration, "times": times, "samples": samples, "start": start, "method": method, "step": step,
            "rtol": rtol, "atol": atol, "events": events, "max_step": max_step, "max_steps": max_steps,
            "max_events": max_events, "timeout": timeout,
        }  # fmt: skip
        options = OptimizeOptions(final, integral, reach, bounds, initial, params, inputs, max_evaluations, tolerance)
        return optimize(self.model, unknowns, options, initial_by_name, run_options)

    def base_parameters(self, params: Mapping[Any, Any] | None = None) -> BaseParameters:
        """Return the combinations of masses, first moments and inertias on which the motion depends.

        >>> from lagrangian import example
        >>> arm = example("robot-arm").base_parameters()
        >>> len(arm), len(arm.names)
        (15, 30)

        Nothing else of them can be found from any motion. `BaseParameters.regressor` is the matrix Y_b of
        Y_b(q, v, v̇) π_b = generalized forces, with which they are found by linear least squares. Lengths and g need
        values, in ``params`` or declared; masses and inertias do not. Raises `ModelError` for a system without bodies,
        and `RunError` for lengths without values.
        """
        from lagrangian.fit.base_parameters import base_parameters

        return base_parameters(self.model, params)
