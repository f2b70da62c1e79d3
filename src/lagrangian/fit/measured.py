"""Measured data: columns of numbers over time, with missing samples, for one run or for several."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from lagrangian.codegen.arguments import numbers
from lagrangian.errors import RunError
from lagrangian.model import Model, as_expr
from lagrangian.records import dataclass
from lagrangian.simulate.quantities import quantity
from lagrangian.values.values import key_name

Array = NDArray[np.float64]

TIME_NAMES = ("t", "time")
"""The names of the column with the times."""

FORM = 'such as {"t": times, "theta1": values}, or {"theta1": (times, values)}'


@dataclass(frozen=True, eq=False)
class MeasuredColumn:
    """A measured quantity: its expression, the samples that are not missing, and where these are among the times."""

    name: str
    expression: sp.Expr
    at: NDArray[np.int64]
    values: Array
    missing: int


@dataclass(frozen=True, eq=False)
class MeasuredRun:
    """The data of one run: all times at which anything was measured, and the quantities."""

    t: Array
    columns: tuple[MeasuredColumn, ...]


def measured(model: Model, data: Any) -> tuple[MeasuredRun, ...]:
    """The data of all runs: one mapping or table, or a list of these. Raises `RunError` for data that do not fit."""
    several = isinstance(data, Sequence) and not isinstance(data, (str, bytes))
    listed = list(data) if several else [data]
    if not listed:
        raise RunError("data has no run", fix=FORM, code="E401")
    names = [f" of run {k}" if several else "" for k in range(len(listed))]
    runs = tuple(_run(model, _table(one, which), which) for one, which in zip(listed, names, strict=True))
    wanted = [c.name for c in runs[0].columns]
    for run, which in zip(runs, names, strict=True):
        if [c.name for c in run.columns] != wanted:
            have = ", ".join(c.name for c in run.columns)
            raise RunError(
                f"the data{which} have the columns {have}, those of run 0 {', '.join(wanted)}",
                fix="give the same columns for every run, in the same order; what was not measured is NaN",
                code="E501",
            )
    return runs


def _table(data: Any, which: str) -> dict[str, Any]:
    """A mapping by name from a mapping, a data frame of pandas or a data set of xarray."""
    if hasattr(data, "data_vars") and hasattr(data, "coords"):
        return {str(k): x.values for k, x in {**data.coords, **data.data_vars}.items()}
    if hasattr(data, "columns") and hasattr(data, "index"):
        found = {str(name): data[name].to_numpy() for name in data.columns}
        if not any(name in found for name in TIME_NAMES):
            found["t"] = np.asarray(data.index)
        return found
    if isinstance(data, Mapping):
        return {key_name(key): value for key, value in data.items()}
    raise RunError(f"the data{which} must be columns by name (got {type(data).__name__})", fix=FORM, code="E501")


def _run(model: Model, table: dict[str, Any], which: str) -> MeasuredRun:
    """The data of one run, checked."""
    time = next((name for name in TIME_NAMES if name in table and name not in model.symbols), "t")
    common = _times(table.pop(time), f"the times '{time}'{which}") if time in table else None
    if not table:
        raise RunError(f"the data{which} have no column beside the times", fix=FORM, code="E401")
    read = {name: _column(name, given, common, which) for name, given in table.items()}
    t = np.unique(np.concatenate([times for times, _ in read.values()]))
    if len(t) < 2:
        raise RunError(f"the data{which} have {len(t)} time; a run needs two or more", fix=FORM, code="E501")
    columns = []
    for name, (times, values) in read.items():
        known = np.isfinite(values)
        place = np.searchsorted(t, times[known])
        expression = as_expr(quantity(model, name, f"the column '{name}'{which}"), f"'{name}'")
        columns.append(MeasuredColumn(name, expression, place, values[known], int((~known).sum())))
    return MeasuredRun(t, tuple(columns))


def _times(given: Any, what: str) -> Array:
    """Times that increase; raises `RunError` for anything else."""
    times = np.array(numbers(given, what))
    if times.ndim != 1 or not len(times):
        raise RunError(f"{what} have the shape {times.shape}", fix="give one number for each sample", code="E501")
    if not np.isfinite(times).all():
        k = int(np.flatnonzero(~np.isfinite(times))[0])
        raise RunError(
            f"{what}: number {k} is {times[k]}",
            fix="every sample needs a time; what was not measured is NaN in its own column",
            code="E502",
        )
    if np.any(np.diff(times) <= 0):
        k = int(np.flatnonzero(np.diff(times) <= 0)[0])
        raise RunError(
            f"{what} do not increase: {times[k]:g} is followed by {times[k + 1]:g}",
            fix="sort the samples, and give data of several runs as a list of tables",
            code="E501",
        )
    return times


def _column(name: str, given: Any, common: Array | None, which: str) -> tuple[Array, Array]:
    """Times and values of a column; NaN and masked entries are missing samples."""
    what = f"the column '{name}'{which}"
    if isinstance(given, tuple) and len(given) == 2 and np.ndim(given[0]) == 1:
        times, given = _times(given[0], f"the times of {what}"), given[1]
    elif common is None:
        raise RunError(f"{what} has no times", fix=FORM, code="E401")
    else:
        times = common
    filled = np.ma.filled(given, np.nan) if isinstance(given, np.ma.MaskedArray) else given
    values = np.array(numbers(filled, what))
    if values.shape != times.shape:
        raise RunError(
            f"{what} has the shape {values.shape}, and its times {times.shape}",
            fix="give one value for each time; NaN where nothing was measured",
            code="E501",
        )
    if np.isinf(values).any():
        k = int(np.flatnonzero(np.isinf(values))[0])
        raise RunError(f"{what}: number {k} is {values[k]}", fix="NaN marks a missing sample", code="E502")
    if np.isnan(values).all():
        raise RunError(f"{what}: every sample is missing (NaN)", fix="leave the column out", code="E502")
    return times, values
