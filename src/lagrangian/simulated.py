"""The verbs of a system that integrate: simulate (one run), ensemble (arrays of values), sweep (combinations of
values)."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import wraps
from pathlib import Path
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar

from lagrangian.calls import worded
from lagrangian.describing import Described

if TYPE_CHECKING:  # imported here only for types: describing a system does not have to wait for the integrators
    from numpy.typing import ArrayLike

    from lagrangian.integrate.estimate import SweepEstimate
    from lagrangian.simulate.ensemble import Ensemble
    from lagrangian.simulate.events import Event
    from lagrangian.simulate.per_run import Outputs
    from lagrangian.simulate.settings import Execution, RunSettings
    from lagrangian.simulate.trajectory import Trajectory

P = ParamSpec("P")
R = TypeVar("R")


def _given_once(verb: Callable[P, R]) -> Callable[P, R]:
    """Decorate a verb: an option given beside the ``settings`` or the ``execution`` that contains it is an error."""

    @wraps(verb)
    def call(*given: P.args, **named: P.kwargs) -> R:
        if named.get("settings") is not None or named.get("execution") is not None:
            from lagrangian.simulate.settings import check_given_once

            check_given_once({**named, "duration": given[1]} if len(given) > 1 else named)
        return verb(*given, **named)

    return call


@worded
class Simulated(Described):
    """The methods that run a system.

    Their options can be given one by one, or as a `lagrangian.RunSettings` and a `lagrangian.Execution`.
    """

    @_given_once
    def simulate(
        self,
        duration: float | str | None = None,
        *,
        initial: Mapping[Any, Any] | Sequence[float] | None = None,
        params: Mapping[Any, Any] | None = None,
        inputs: Mapping[Any, Any] | None = None,
        times: ArrayLike | Sequence[float | str] | None = None,
        samples: int | None = None,
        start: float | str = 0.0,
        method: str | None = None,
        step: float | str | None = None,
        rtol: float | None = None,
        atol: float | None = None,
        events: Sequence[Event] | Event = (),
        fixed: Sequence[Any] | str | None = None,
        project: bool = True,
        max_step: float | str = math.inf,
        max_steps: int = 10_000_000,
        max_events: int = 100_000,
        timeout: float | None = None,
        settings: RunSettings | None = None,
        **initial_by_name: Any,
    ) -> Trajectory:
        """Simulate the system for ``duration`` [s] and return a `lagrangian.Trajectory`.

        >>> from lagrangian import example
        >>> run = example("pendulum").simulate(2.0, theta=0.5, params={"b": 0.0})
        >>> run.success, float(run.audit) < 1e-9
        (True, True)

        Give initial values by name, ``theta1=0.2``, or in ``initial={"theta1'": 0.1, theta2: "12 deg"}``. Others are
        taken from [simulate] in the model file, and are otherwise 0. ``params`` and ``inputs`` are mappings from names
        or symbols. An input is a number, text, an expression of time and state (which is compiled), a table ``(times,
        values[, "hold"])`` or a Python function f(t, x), which is slow.

        Results are stored at ``samples`` evenly spaced times (1001 by default), or at the given ``times``. ``method``
        is one of our own in machine code (dop853, the default; taylor; tsit5; rk4 and gauss4, which need ``step``) or
        one of SciPy's (Radau, BDF, LSODA, RK45, DOP853). ``rtol`` (by default 1e-9) and ``atol`` (1e-12) apply to the
        error of the whole run; values given to one of SciPy's methods apply to each step. With constraints, initial
        values are guesses, except for the coordinates named in ``fixed``; every state satisfies the constraints, unless
        ``project=False``; ``run.drift`` says how far steps came from them. ``events`` are made with
        `lagrangian.event`. ``max_steps``, ``max_events`` and ``timeout`` [s] limit the run. ``settings`` is a
        `lagrangian.RunSettings` with all options from ``duration`` to ``timeout``, none of which can then be given
        beside it.

        Raises `RunError` or `ModelError` for mistakes that are found before the run. A run that fails later is returned
        up to that time, with the reason in its ``message``.
        """
        given = locals()
        from lagrangian.simulate.settings import RunSettings, chosen
        from lagrangian.simulate.simulation import simulate

        named = {"initial": initial, "params": params, "inputs": inputs, "by_name": initial_by_name}
        return simulate(self.model, chosen(RunSettings, given, "settings"), **named)

    @_given_once
    def ensemble(
        self,
        duration: float | str | None = None,
        *,
        initial: Mapping[Any, Any] | None = None,
        params: Mapping[Any, Any] | None = None,
        inputs: Mapping[Any, Any] | None = None,
        dims: Sequence[str] | None = None,
        outputs: Outputs = None,
        reduce: str | Sequence[str] | None = ("final",),
        times: int | ArrayLike | Sequence[float | str] = 1001,
        start: float | str = 0.0,
        method: str | None = None,
        step: float | str | None = None,
        rtol: float | None = None,
        atol: float | None = None,
        events: Sequence[Event] | Event = (),
        event_times: int = 1,
        fixed: Sequence[Any] | str | None = None,
        project: bool = True,
        max_step: float | str = math.inf,
        max_steps: int = 10_000_000,
        max_events: int = 10_000,
        memory: int = 256 * 2**20,
        threads: int | None = None,
        progress: Callable[[int, int], None] | None = None,
        confirm: Callable[[SweepEstimate], Any] | None = None,
        store: str | Path | None = None,
        resume: bool = False,
        overwrite: bool = False,
        scheduler: Any = None,
        settings: RunSettings | None = None,
        execution: Execution | None = None,
        **initial_by_name: Any,
    ) -> Ensemble:
        """Simulate the system once for every entry of arrays that broadcast together; return a `lagrangian.Ensemble`.

        >>> from lagrangian import example
        >>> runs = example("pendulum").ensemble(2.0, theta=[0.1, 0.2, 0.3], method="rk4", step=0.01)
        >>> runs["final theta"].shape
        (3,)

        ``initial``, ``params``, ``inputs`` map names or symbols to numbers, text with a unit, or arrays; ``dims`` names
        the axes. ``outputs``: expressions, as a list or by name, ("theta1", "max theta1"). ``reduce`` says how each is
        reduced over time (`lagrangian.integrate.observe.REDUCTIONS`); None returns samples at ``times``, a number of
        times or an array. ``method``, ``rtol``, ``atol``, ``step`` and ``events`` are those of `simulate`.

        ``memory`` [bytes] limits the memory in use, ``threads`` the number of cores; ``progress(done, all)`` is called
        now and then. ``confirm(estimate)`` is called first with a `lagrangian.SweepEstimate`; if it returns False,
        `lagrangian.NotStarted` is raised. ``store="name.zarr"`` writes results as they are computed, ``resume=True``
        continues. ``scheduler`` is the address of a Dask scheduler. A run that fails has NaN results.

        ``settings``: a `lagrangian.RunSettings` without ``timeout``, whose ``max_events`` is 100 000 by default;
        ``execution``: a `lagrangian.Execution`; then without their options. Raises `RunError` for wrong arguments.
        """
        given = locals()
        from lagrangian.simulate.sweeping import ensemble, options

        named = {"initial": initial, "params": params, "inputs": inputs, "by_name": initial_by_name}
        return ensemble(self.model, *options(given), dims=dims, **named)

    @_given_once
    def sweep(
        self,
        duration: float | str | None = None,
        grid: Mapping[Any, Any] | Iterable[str] | str = (),
        *,
        initial: Mapping[Any, Any] | None = None,
        params: Mapping[Any, Any] | None = None,
        inputs: Mapping[Any, Any] | None = None,
        draws: int | None = None,
        seed: int = 0,
        outputs: Outputs = None,
        reduce: str | Sequence[str] | None = ("final",),
        times: int | ArrayLike | Sequence[float | str] = 1001,
        start: float | str = 0.0,
        method: str | None = None,
        step: float | str | None = None,
        rtol: float | None = None,
        atol: float | None = None,
        events: Sequence[Event] | Event = (),
        event_times: int = 1,
        fixed: Sequence[Any] | str | None = None,
        project: bool = True,
        max_step: float | str = math.inf,
        max_steps: int = 10_000_000,
        max_events: int = 10_000,
        memory: int = 256 * 2**20,
        threads: int | None = None,
        progress: Callable[[int, int], None] | None = None,
        confirm: Callable[[SweepEstimate], Any] | None = None,
        store: str | Path | None = None,
        resume: bool = False,
        overwrite: bool = False,
        scheduler: Any = None,
        settings: RunSettings | None = None,
        execution: Execution | None = None,
        **initial_by_name: Any,
    ) -> Ensemble:
        """Simulate the system for every combination of values, and for every random draw.

        >>> from lagrangian import example
        >>> pendulum = example("pendulum")
        >>> runs = pendulum.sweep(2.0, ["L=0.5:2:4", "theta~normal(0, 0.1)"], draws=5, method="rk4", step=0.01)
        >>> runs.dims, runs.shape
        (('L', 'sample'), (4, 5))

        ``grid``: texts as above, or a mapping from names or symbols to values, arrays or such texts. The names are
        those of parameters, inputs, and initial values of coordinates and rates. ``draws`` is the number of random
        draws; the same ``seed`` gives the same draws. All other arguments are those of `ensemble`.
        """
        given = locals()
        from lagrangian.simulate.sweeping import options, sweep

        named = {"initial": initial, "params": params, "inputs": inputs, "by_name": initial_by_name}
        return sweep(self.model, grid, *options(given), draws=draws, seed=seed, **named)
