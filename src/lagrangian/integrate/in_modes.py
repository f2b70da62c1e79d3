"""Outputs of runs whose equations change on the way, such as those with dry friction: every sample in its own mode."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from lagrangian.codegen import Kernel, compile
from lagrangian.errors import RunError
from lagrangian.integrate.design import Rows
from lagrangian.integrate.status import RunStatus
from lagrangian.records import dataclass

if TYPE_CHECKING:
    from lagrangian.graph import Program

Array: TypeAlias = NDArray[np.float64]

LEAST = 8
"""The smallest number of states that are observed together, so that machine code never has to pad."""

NOT_FINITE = "E503"


def kernel_of(program: Program, **optional: float) -> Kernel:
    """The code of a program, compiled once."""
    return program.remembered("kernel", lambda: compile(program, optional=optional, threads=1))


def lost(status: NDArray[Any]) -> NDArray[np.bool_]:
    """Which runs have no results: those that failed, except those whose events accumulate, because their motion is
    over."""
    return (status < 0) & (status != RunStatus.ZENO)


def signals_at(signals: Any, times: Array) -> Array:
    """Piecewise linear inputs at ``times`` (…), shape (…, nu); at a knot, those of the piece that begins there."""
    k = np.searchsorted(signals.knots, times, side="right") - 1
    return signals.start[k] + signals.slope[k] * (times - signals.knots[k])[..., None]


@dataclass(frozen=True)
class InModes:
    """The outputs of the runs in ``part`` whose equations change with their modes: each sample in its own.

    ``regimes``, ``times``, ``signals`` and ``whole`` are those of the study; the ``solution`` has ``modes``.
    """

    regimes: Any
    whole: bool
    times: Array
    signals: Any
    solution: Any
    rows: Rows
    part: slice

    def observed(self, states: Array, times: Array) -> dict[str, Array]:
        """Each output along each run, (n, S), from states (n, S, nx) at times (S,) or (n, S)."""
        runs, samples = states.shape[:2]
        t = np.broadcast_to(times, (runs, samples)).reshape(-1)
        x, u, p = (
            states.reshape(runs * samples, -1),
            self._inputs(times, runs, samples),
            self._parameters(runs, samples),
        )
        modes = self._modes(times, runs, samples)
        found: dict[str, Array] = {}
        kinds, which = np.unique(modes.reshape(runs * samples, -1), axis=0, return_inverse=True)
        for k, kind in enumerate(kinds.tolist()):
            at = np.flatnonzero(which.reshape(-1) == k)
            outputs, further = self.regimes.programs(tuple(kind))
            values = _called(outputs, x[at], u[at], p[at], t[at])
            for more in further:
                values |= more(_called(more.program, x[at], u[at], p[at], t[at]))
            for name, y in values.items():
                found.setdefault(name, np.empty(runs * samples))[at] = y
        return {name: y.reshape(runs, samples) for name, y in found.items()}

    def _inputs(self, times: Array, runs: int, samples: int) -> Array:
        """The inputs at every sample, (n S, nu)."""
        u = self.rows.u
        if self.signals is not None:
            whole = signals_at(self.signals, times)
        else:
            whole = u[self.part][:, None, :] if u.ndim == 2 else u
        return np.broadcast_to(whole, (runs, samples, whole.shape[-1])).reshape(runs * samples, -1)

    def _parameters(self, runs: int, samples: int) -> Array:
        p = self.rows.p if self.rows.p.ndim == 1 else self.rows.p[self.part][:, None, :]
        return np.broadcast_to(p, (runs, samples, p.shape[-1])).reshape(runs * samples, -1)

    def _modes(self, times: Array, runs: int, samples: int) -> NDArray[np.int8]:
        """The modes at every sample; of failed runs, whose results are dropped, any."""
        solution, part = self.solution, self.part
        last = solution.last_modes[part][:, None, :]
        modes = np.broadcast_to(last, (runs, samples, last.shape[-1])).copy()
        if self.whole:
            status, ended = solution.status[part], solution.reached[part]
            over = (status != 0)[:, None] & (self.times >= ended[:, None])
            modes = np.where(over[..., None], modes, solution.modes[part])
        modes[lost(solution.status[part])] = 1
        return modes


def _called(program: Program, x: Array, u: Array, p: Array, t: Array) -> dict[str, Array]:
    """The outputs of a program at states; values that are not finite are returned unchanged."""
    kernel = kernel_of(program)
    fill = max(0, LEAST - len(x))
    x, u, p, t = (np.concatenate([a, np.repeat(a[-1:], fill, axis=0)]) if fill else a for a in (x, u, p, t))
    out = {name: np.empty((len(x), *o.shape)) for name, o in program.outputs.items()}
    try:
        kernel(x=np.ascontiguousarray(x), u=np.ascontiguousarray(u), p=np.ascontiguousarray(p), t=t, out=out)
    except RunError as trouble:  # every state is computed in any case
        if trouble.code != NOT_FINITE:
            raise
    return {name: values[: len(x) - fill] for name, values in out.items()}
