"""Holds a store of a sweep against single runs: it is read back by the package zarr, not by our own reader."""

from __future__ import annotations

import itertools
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from lagrangian.errors import Error, MissingExtra
from lagrangian.model import Model
from lagrangian.page.formula import Check, text
from lagrangian.simulate.per_run import Recording
from lagrangian.simulate.settings import Execution, RunSettings
from lagrangian.simulate.simulation import simulate
from lagrangian.simulate.sweeping import sweep
from lagrangian.verify.states import State, named_values, relative
from lagrangian.write.tables import needed

DURATION = 0.1
"""The length of the runs [s]."""

SAMPLES = 5
"""Their instants."""

AWAY = 0.02
"""How far a varied value goes to each side: of a parameter that share of it, of a rate so many SI units."""

TOLERANCE = 1e-6
"""The allowed difference from single runs, relative to the largest state: both keep theirs to some 1e-9."""

WHAT = text("the runs in the store of a sweep, read back by zarr, equal single runs from the same values")


def swept_runs(model: Model, state: State) -> Check:
    """Return the check of a sweep of 2 × 2 runs, of a parameter and of a rate; ``holds`` is None where none is made."""
    at = named_values(model, state)
    p, u, x = at.params, at.inputs, at.initial
    grid: dict[str, list[float]] = {}
    if first := next((name for name, value in p.items() if value), None):
        grid[first] = [p[first] * (1 - AWAY), p[first] * (1 + AWAY)]
    rate = model.velocities[-1].name
    grid[rate] = [x[rate] - AWAY, x[rate] + AWAY]
    begin = state["t"][0]
    times = np.linspace(begin, begin + DURATION, SAMPLES)
    settings = RunSettings(times=times, start=begin)
    fixed = {name: value for name, value in p.items() if name not in grid}
    start = {name: value for name, value in x.items() if name not in grid}
    try:
        with tempfile.TemporaryDirectory(prefix="lagrangian-", ignore_cleanup_errors=True) as folder:
            path, kept = Path(folder) / "runs.zarr", Recording(reduce=None)
            told: Mapping[str, Any] = {"initial": start, "params": fixed, "inputs": u, "by_name": {}}
            sweep(model, grid, settings, kept, Execution(store=path, threads=1), draws=None, seed=0, **told)
            stored = {name: np.array(array) for name, array in needed("zarr").open_group(path, mode="r").arrays()}
        worst, count = _compared(
            model, stored, settings, grid, {"initial": start, "params": fixed, "inputs": u}, tuple(x)
        )
    except MissingExtra:
        return Check(WHAT, None, "not checked: the package zarr is not installed")
    except Error as error:
        return Check(WHAT, None, f"not checked: {error.what[:160]}")
    if not count:
        return Check(WHAT, None, "not checked: no run reaches its end")
    return Check(WHAT, worst < TOLERANCE, f"largest relative difference {worst:.1e}, {count} runs over {DURATION:g} s")


def _compared(
    model: Model,
    stored: Mapping[str, Any],
    settings: RunSettings,
    grid: Mapping[str, list[float]],
    given: Mapping[str, Mapping[str, float]],
    names: tuple[str, ...],
) -> tuple[float, int]:
    """The largest difference of stored runs from single ones, and how many were compared; it is infinite if a run has
    another length, other values, or a status that says something else."""
    rates = {v.name for v in model.velocities}
    axes = [stored[f"{name}(0)" if name in rates else name] for name in grid]
    shape, worst, count = tuple(len(values) for values in grid.values()), 0.0, 0
    wanted = dict.fromkeys(names, (*shape, SAMPLES)) | {"status": shape}
    if not all(np.array_equal(axis, values) for axis, values in zip(axes, grid.values(), strict=True)):
        return np.inf, 1
    if any(stored[name].shape != size for name, size in wanted.items()):
        return np.inf, 1
    for at in itertools.product(*map(range, shape)):
        varied = {name: values[k] for (name, values), k in zip(grid.items(), at, strict=True)}
        run = simulate(
            model,
            settings,
            initial={**given["initial"], **{n: v for n, v in varied.items() if n in rates}},
            params={**given["params"], **{n: v for n, v in varied.items() if n not in rates}},
            inputs=given["inputs"],
            by_name={},
        )
        if run.success != (stored["status"][at] == 0):
            return np.inf, 1
        if run.success:
            found = np.array([stored[name][at] for name in names])
            worst = float(np.maximum(worst, relative(found - run.y, run.y, np.ones(1))))
            count += 1
    return worst, count
