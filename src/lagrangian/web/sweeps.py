"""The job of a sweep: one or two quantities vary, and results are reported row by row while they are computed."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.cli.formats import as_json
from lagrangian.cli.sweep_summary import figures
from lagrangian.errors import Error
from lagrangian.simulate.joining import joined
from lagrangian.web.jobs import MODEL, opened, rounded
from lagrangian.web.requests import Arguments, Part

MAX_COUNT = 200
"""The largest number of values along an axis."""

MAX_RUNS = 10_000

PIECES = 20
"""A sweep along one axis is reported in so many pieces."""


def sweep_job(given: dict[str, Any], part: Part) -> dict[str, Any]:
    """Simulate all combinations: the data of ``lagrangian sweep --json``; before it, every row as soon as it is there.

    ``axes`` is a list of one or two objects with name, low, high and count; ``output`` is what to keep of each run,
    such as "max theta1".
    """
    arguments = Arguments(given, (*MODEL, "axes", "output", "duration", "initial", "params", "inputs"))
    tables = arguments.tables("axes", 1, 2)
    axes = dict(map(_axis, tables))
    if len(axes) < len(tables):
        raise Error("both axes have the same name", fix="vary two different quantities", code="E404")
    runs = int(np.prod([len(values) for values in axes.values()]))
    if runs > MAX_RUNS:
        raise Error(
            f"these are {runs} runs, more than {MAX_RUNS}", fix="take fewer values, or the command", code="E703"
        )
    output = arguments.text("output")
    system = opened(arguments)
    (first, values), *other = axes.items()
    size = 1 if other else -(-len(values) // PIECES)
    done = []
    part({"axes": [{"name": name, "values": rounded(found)} for name, found in axes.items()]})
    for start in range(0, len(values), size):
        piece = system.sweep(
            arguments.value("duration"),
            {first: values[start : start + size], **dict(other)},
            initial=arguments.values("initial"),
            params=arguments.values("params"),
            inputs=arguments.values("inputs"),
            outputs={output: output},
            threads=1,
        )
        done.append(piece)
        (name,) = (n for n in piece if n == output or n.endswith(f" {output}"))
        unit = str(piece.words_of(name).get("units", ""))
        part({"start": start, "name": name, "unit": unit, "rows": [rounded(row) for row in _rows(piece[name])]})
    return {"data": json.loads(as_json(figures(joined(done))))}


def _axis(table: dict[str, Any]) -> tuple[str, NDArray[np.float64]]:
    axis = Arguments(table, ("name", "low", "high", "count"))
    return axis.text("name"), np.linspace(axis.number("low"), axis.number("high"), axis.whole("count", 2, 2, MAX_COUNT))


def _rows(values: NDArray[Any]) -> NDArray[Any]:
    return values.reshape(len(values), -1)
