"""A run with other values of what is varied: parameters, initial values, inputs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from lagrangian.simulate.inputs import SampledInput, Source
from lagrangian.simulate.integrating import Task
from lagrangian.simulate.varied import Columns

Array = NDArray[np.float64]


def values_of(task: Task, columns: Columns) -> Array:
    """The value of every column in a run."""
    found = []
    for column in columns:
        if column.kind in ("p", "x"):
            found.append(float((task.p if column.kind == "p" else task.x0)[column.at]))
            continue
        source = task.drive.sources[column.at]
        if isinstance(source, SampledInput):
            found.append(float(source.values[knot_of(columns, column.signal)]))
        else:
            assert isinstance(source, float)
            found.append(source)
    return np.array(found)


def knot_of(columns: Columns, signal: int) -> int:
    """Which value of its table a further input varies."""
    own = next(c for c in columns if c.kind == "knot" and c.signal == signal)
    return signal - next(c.signal for c in columns if c.kind == "knot" and c.at == own.at)


def with_values(task: Task, columns: Columns, values: Sequence[float] | Array) -> Task:
    """The run with other values of the columns."""
    p, x0, sources = task.p.copy(), task.x0.copy(), list(task.drive.sources)
    for column, value in zip(columns, values, strict=True):
        if column.kind == "p":
            p[column.at] = value
        elif column.kind == "x":
            x0[column.at] = value
        else:
            sources[column.at] = _changed(sources[column.at], columns, column.signal, float(value))
    return replace(task, p=p, x0=x0, drive=replace(task.drive, sources=tuple(sources)))


def _changed(source: Source, columns: Columns, signal: int, value: float) -> Source:
    """A constant, or a table with another value at one knot."""
    if not isinstance(source, SampledInput):
        return value
    values = source.values.copy()
    values[knot_of(columns, signal)] = value
    return SampledInput(source.times, values, source.hold)
