"""The verbs of a system that integrate: one run, an ensemble of arrays, a sweep over combinations."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lagrangian.calls import worded
from lagrangian.describing import Described

if TYPE_CHECKING:  # describing a system does not wait for what integrates it
    from numpy.typing import ArrayLike

    from lagrangian.simulate.ensemble import Ensemble
    from lagrangian.simulate.events import Event
    from lagrangian.simulate.per_run import Outputs
    from lagrangian.simulate.trajectory import Trajectory


@worded
class Simulated(Described):
    """What can be run; options have the names and defaults of `lagrangian.RunSettings` and `lagrangian.Execution`."""

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
        rtol: float = 1e-9,
        atol: float = 1e-12,
        events: Sequence[Event] | Event = (),
        max_step: float | str = math.inf,
        max_steps: int = 10_000_000,
        max_events: int = 100_000,
        timeout: float | None = None,
        **initial_by_name: Any,
    ) -> Trajectory:
        """Run the system for ``duration`` [s] and return a `lagrangian.Trajectory`.

        >>> from lagrangian import example
        >>> run = example("pendulum").simulate(2.0, theta=0.5, params={"b": 0.0})
        >>> run.success, float(run.audit) < 1e-9
        (True, True)

        Initial values by name, ``theta1=0.2``, or in ``initial={"theta1'": 0.1, theta2: "12 deg"}``; what a model file
        says under [simulate], and else 0, where not given. ``params`` and ``inputs`` are mappings by name or symbol;
        an input is a number, text, an expression of time and state (compiled in), a table
        ``(times, values[, "hold"])`` or a Python function f(t, x), which is slow. The run is kept at ``samples``
        times (1001), or at ``times``. ``method`` is one of ours in machine code (dop853, the default; taylor; tsit5;
        rk4 and gauss4, which need ``step``) or one of SciPy's (Radau, BDF, LSODA, RK45, DOP853). ``rtol`` and ``atol``
        are aimed at for the whole run; for SciPy's methods they are those of a step. ``events`` come from
        `lagrangian.event`. ``max_steps``, ``max_events`` and ``timeout`` [s] bound the run.

        Raises `RunError` or `ModelError` for what is wrong before the run; a run that fails on its way is returned as
        far as it went, with the reason in its ``message``.
        """
        given = locals()
        from lagrangian.simulate.settings import RunSettings, picked
        from lagrangian.simulate.simulation import simulate

        named = {"initial": initial, "params": params, "inputs": inputs, "by_name": initial_by_name}
        return simulate(self.model, picked(RunSettings, given), **named)

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
        rtol: float = 1e-9,
        atol: float = 1e-12,
        events: Sequence[Event] | Event = (),
        event_times: int = 1,
        max_step: float | str = math.inf,
        max_steps: int = 10_000_000,
        max_events: int = 10_000,
        memory: int = 256 * 2**20,
        threads: int | None = None,
        progress: Callable[[int, int], None] | None = None,
        store: str | Path | None = None,
        resume: bool = False,
        overwrite: bool = False,
        scheduler: Any = None,
        **initial_by_name: Any,
    ) -> Ensemble:
        """Run the system once for every entry of arrays that broadcast together; return a `lagrangian.Ensemble`.

        >>> from lagrangian import example
        >>> runs = example("pendulum").ensemble(2.0, theta=[0.1, 0.2, 0.3], method="rk4", step=0.01)
        >>> runs["final theta"].shape
        (3,)

        ``initial``, ``params``, ``inputs``: name or symbol → number, text with a unit, or array; ``dims`` names the
        axes. ``outputs``: expressions, by name or alone, ("theta1", "max theta1"); ``reduce``: what is kept of each
        over time (`lagrangian.integrate.observe.REDUCTIONS`), None for samples at ``times`` (a number of them, or the
        times). ``method``, ``rtol``, ``atol``, ``step``, ``events`` as in `simulate`; ``memory`` [bytes] bounds what is
        held at a time, ``threads`` the cores; ``progress(done, all)`` is called on the way. ``store="name.zarr"`` keeps
        results on disk as they come, ``resume=True`` goes on after an end of any kind; ``scheduler`` is the address of
        a Dask scheduler. A run that fails is NaN, with a status, and counted. Raises `RunError` for what does not fit.
        """
        given = locals()
        from lagrangian.simulate.sweeping import chosen, ensemble

        named = {"initial": initial, "params": params, "inputs": inputs, "by_name": initial_by_name}
        return ensemble(self.model, *chosen(given), dims=dims, **named)

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
        rtol: float = 1e-9,
        atol: float = 1e-12,
        events: Sequence[Event] | Event = (),
        event_times: int = 1,
        max_step: float | str = math.inf,
        max_steps: int = 10_000_000,
        max_events: int = 10_000,
        memory: int = 256 * 2**20,
        threads: int | None = None,
        progress: Callable[[int, int], None] | None = None,
        store: str | Path | None = None,
        resume: bool = False,
        overwrite: bool = False,
        scheduler: Any = None,
        **initial_by_name: Any,
    ) -> Ensemble:
        """Run the system for every combination of values, each for every draw of what is random.

        >>> from lagrangian import example
        >>> pendulum = example("pendulum")
        >>> runs = pendulum.sweep(2.0, ["L=0.5:2:4", "theta~normal(0, 0.1)"], draws=5, method="rk4", step=0.01)
        >>> runs.dims, runs.shape
        (('L', 'sample'), (4, 5))

        ``grid``: texts as here, or name or symbol → values, an array or text: parameters, coordinates and rates at the
        start, inputs. ``draws`` is the number of random draws; the same ``seed`` gives the same ones. Everything else
        as in `ensemble`.
        """
        given = locals()
        from lagrangian.simulate.sweeping import chosen, sweep

        named = {"initial": initial, "params": params, "inputs": inputs, "by_name": initial_by_name}
        return sweep(self.model, grid, *chosen(given), draws=draws, seed=seed, **named)
