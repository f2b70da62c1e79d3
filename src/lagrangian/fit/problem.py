"""The least-squares problem of a fit: residuals of all runs and their exact derivatives.

    r = (y(z) − y_measured)/σ        ∂r/∂z = (∂y/∂z)/σ

y(z) are the quantities of runs with the unknowns z, and ∂y/∂z their sensitivities.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.errors import Error, RunError
from lagrangian.fit.measured import MeasuredColumn, MeasuredRun
from lagrangian.model import Model
from lagrangian.page.formula import Check
from lagrangian.records import dataclass
from lagrangian.simulate import quotients
from lagrangian.simulate.admission import Admission, fitness
from lagrangian.simulate.integrating import Task
from lagrangian.simulate.sensitivities import observed
from lagrangian.simulate.unknowns import with_values
from lagrangian.simulate.varied import Columns, varied_run

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class FittedRun:
    """One run of a fit: what is integrated, its columns, their places among the unknowns, its data, its tolerances."""

    task: Task
    columns: Columns
    places: NDArray[np.int64]
    data: MeasuredRun
    settings: Mapping[str, Any]


class FitProblem:
    """Residuals and Jacobian of all runs; an impossible set of parameters has residuals that are not finite."""

    def __init__(self, model: Model, runs: Sequence[FittedRun], names: Sequence[str]) -> None:
        self._model, self.runs, self.names = model, tuple(runs), tuple(names)
        varied = {c.name for run in runs for c in run.columns if c.kind == "p"}
        check = fitness(model, varied) if varied else None
        self._admit = None if check is None else Admission(model, check)
        self._last: tuple[bytes, tuple[list[Array], list[Array]]] | None = None
        self.evaluations = 0

    @property
    def titles(self) -> tuple[str, ...]:
        """The names of the measured columns, the same in every run."""
        return tuple(c.name for c in self.runs[0].data.columns)

    def ranges(self) -> dict[str, float]:
        """The greatest minus the least measured value of every column, over all runs."""
        columns = [[run.data.columns[k].values for run in self.runs] for k in range(len(self.titles))]
        return {name: float(np.ptp(np.concatenate(x))) for name, x in zip(self.titles, columns, strict=True)}

    def compared(self, z: Array) -> tuple[list[Array], list[Array]]:
        """y(z) − y_measured of every column of every run, and the derivatives, each (samples, unknowns).

        Raises `Error` for parameters with which a run is impossible or fails.
        """
        key = z.tobytes()
        if self._last is None or self._last[0] != key:
            self._last = key, self._computed(z)
        return self._last[1]

    def _computed(self, z: Array) -> tuple[list[Array], list[Array]]:
        self.evaluations += 1
        away: list[Array] = []
        slopes: list[Array] = []
        for run in self.runs:
            task = with_values(run.task, run.columns, z[run.places])
            if self._admit is not None:
                self._admit(task.p)
            made = varied_run(task, run.columns)
            asked = {f"column {k}": c.expression for k, c in enumerate(run.data.columns)}
            found = observed(task, run.columns, made, asked)
            before = len(task.times) - len(run.data.t)  # 1 if the run starts before its first sample
            for k, c in enumerate(run.data.columns):
                at = c.at + before
                wide = np.zeros((len(at), len(z)))
                wide[:, run.places] = found[f"change of column {k}"][at]
                away.append(found[f"column {k}"][at] - c.values)
                slopes.append(wide)
        return away, slopes

    def residuals(self, z: Array, sigma: Array) -> Array:
        """All residuals one after another; infinite where a run is impossible, so that a smaller step is taken."""
        try:
            away, _ = self.compared(z)
        except Error:
            return np.full(self.count, np.inf)
        return np.concatenate([r / s for r, s in zip(away, self.spread(sigma), strict=True)])

    def slopes(self, z: Array, sigma: Array) -> Array:
        """∂r/∂z, (residuals, unknowns)."""
        _, slopes = self.compared(z)
        return np.concatenate([J / s for J, s in zip(slopes, self.spread(sigma), strict=True)])

    def checks(self, z: Array, sigma: Array) -> tuple[Check, ...]:
        """Hold residuals and Jacobian against ordinary runs, which are integrated without variational equations."""
        d = quotients.direction(quotients.units_of(z))
        found = self.residuals(z, sigma)
        size = max(float(np.max(np.abs(c.values)) / s) for c, s in self._weighed(sigma))
        return (
            quotients.agree(
                "runs with the estimate, integrated without variational equations, leave the same residuals",
                found,
                lambda: self._plain_residuals(z, sigma),
                size,
            ),
            quotients.held(
                "the derivatives of the residuals equal difference quotients of such runs",
                self.slopes(z, sigma) @ d,
                lambda values: self._plain_residuals(values, sigma),
                z,
                d,
            ),
        )

    def _plain_residuals(self, z: Array, sigma: Array) -> Array:
        """All residuals by ordinary runs. Raises `RunError` if one fails."""
        found: list[Array] = []
        for run in self.runs:
            made = quotients.plain_run(with_values(run.task, run.columns, z[run.places]))
            if len(made.t) != len(run.task.times):
                raise RunError("an event ends it before its last sample", code="E503")
            before = len(made.t) - len(run.data.t)
            values = made.quantities({f"column {k}": c.expression for k, c in enumerate(run.data.columns)})
            found += [values[f"column {k}"][c.at + before] - c.values for k, c in enumerate(run.data.columns)]
        return np.concatenate([r / s for r, s in zip(found, self.spread(sigma), strict=True)])

    def _weighed(self, sigma: Array) -> list[tuple[MeasuredColumn, float]]:
        """All columns of all runs with their σ."""
        columns = [c for run in self.runs for c in run.data.columns]
        return list(zip(columns, self.spread(sigma), strict=True))

    def beginning(self, share: float) -> FitProblem:
        """The same problem with the samples of the first ``share`` of every run alone."""
        runs = []
        for run in self.runs:
            t = run.data.t
            kept = max(2, int(np.searchsorted(t, t[0] + share * (t[-1] - t[0]), side="right")))
            columns = []
            for c in run.data.columns:
                inside = c.at < kept
                columns.append(replace(c, at=c.at[inside], values=c.values[inside]))
            more = len(run.task.times) - len(t)  # a start before the first sample
            task = replace(run.task, times=run.task.times[: kept + more])
            runs.append(replace(run, task=task, data=MeasuredRun(t[:kept], tuple(columns))))
        return FitProblem(self._model, runs, self.names)

    @property
    def count(self) -> int:
        """The number of residuals."""
        return sum(len(c.at) for run in self.runs for c in run.data.columns)

    def spread(self, sigma: Array) -> list[float]:
        """σ of every column of every run, from those of the columns."""
        return list(np.tile(sigma, len(self.runs)))

    def by_column(self, away: Sequence[Array]) -> list[Array]:
        """The residuals of every column, of all runs together."""
        width = len(self.titles)
        return [np.concatenate(away[k::width]) for k in range(width)]
