"""Holds a short run and the files it is saved to against routes that share nothing with them.

The run of our own integrator is compared with one by SciPy's DOP853, which calls the compiled right-hand side from
Python; its energies with those of the compiled system at the recorded states. Every file is read back by its own
package, and must hold the very numbers of the run.
"""

from __future__ import annotations

import csv
import tempfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from lagrangian.errors import Error, MissingExtra
from lagrangian.model import Model
from lagrangian.page.formula import Check, text
from lagrangian.simulate.settings import RunSettings
from lagrangian.simulate.simulation import simulate
from lagrangian.simulate.trajectory import Trajectory
from lagrangian.verify.slopes import too_long
from lagrangian.verify.states import State, named_values, relative
from lagrangian.write.tables import needed

Array: TypeAlias = NDArray[np.float64]

DURATION = 0.1
"""The length of the run [s]."""

SAMPLES = 5
"""Its instants."""

TOLERANCE = 1e-6
"""The allowed difference of two runs, relative to the largest state: both keep theirs to some 1e-9."""

ROUNDING = 1e-9
"""The allowed relative difference of energies, which are computed twice from the same states."""

MOST_CALLS = 30_000
"""Calls of the right-hand side after which the other run is given up."""


class RunFunctions(Protocol):
    """The compiled functions that a run is compared with."""

    @property
    def rhs(self) -> Callable[..., Array]: ...  # noqa: D102
    @property
    def energies(self) -> Callable[..., tuple[Array, Array]]: ...  # noqa: D102


class _GivenUp(Exception):
    """The other run takes too many calls."""


def recorded_runs(model: Model, functions: RunFunctions, state: State) -> tuple[Check, ...]:
    """Return the check of a run from a state, and that of the files of it; ``holds`` is None where none was made."""
    ran = text("a run by machine code equals one by SciPy's DOP853, and its energies are those of its states")
    kept = text("the files of a run hold its numbers to the last digit")
    if why := "friction that may stick has no one right-hand side" if model.frictions else too_long(model):
        return Check(ran, None, f"not checked: {why}"), Check(kept, None, "not checked: there is no run")
    try:
        run = _run(model, state)
    except Error as error:
        return Check(ran, None, f"not checked: {error.what}"), Check(kept, None, "not checked: there is no run")
    return _as_scipy(run, functions, state, ran), _as_saved(run, kept)


def _run(model: Model, state: State) -> Trajectory:
    at = named_values(model, state)
    begin = state["t"][0]
    times = np.linspace(begin, begin + DURATION, SAMPLES)
    settings = RunSettings(times=times, start=begin, method="dop853")
    return simulate(model, settings, initial=at.initial, params=at.params, inputs=at.inputs, by_name={})


def _as_scipy(run: Trajectory, functions: RunFunctions, state: State, what: Any) -> Check:
    """The check of a run beside one by another integrator."""
    from scipy.integrate import solve_ivp

    if not run.success:
        return Check(what, None, f"not checked: {run.message}")
    u, p, calls = np.array(state["u"]), np.array(state["p"]), 0

    def rates(t: float, x: Array) -> Array:
        nonlocal calls
        calls += 1
        if calls > MOST_CALLS:
            raise _GivenUp
        return functions.rhs(t, x, u=u, p=p)

    try:
        other = solve_ivp(
            rates, (run.t[0], run.t[-1]), run.y[:, 0], "DOP853", run.t, rtol=1e-10, atol=1e-12, first_step=1e-6
        )
    except (_GivenUp, Error) as trouble:
        said = trouble.what if isinstance(trouble, Error) else f"the other run takes over {MOST_CALLS} calls"
        return Check(what, None, f"not checked: {said}")
    if not other.success:
        return Check(what, None, f"not checked: the other run ends early ({other.message})")
    apart = relative(run.y - other.y, other.y, np.ones(1))
    n = len(state["q"])
    T, V = functions.energies(run.y[:n].T, run.y[n:].T, u=u, p=p, t=run.t)
    off = relative(np.array([run.kinetic - T, run.potential - V]), T, V) if np.any(T) or np.any(V) else 0.0
    figure = f"largest relative difference {apart:.1e} over {DURATION:g} s, of energies {off:.1e}"
    return Check(what, apart < TOLERANCE and off < ROUNDING, figure)


def _as_saved(run: Trajectory, what: Any) -> Check:
    """The check of the files: read back by their packages, they are what the run holds."""
    expected = {"t": run.t, **dict(zip(run.states, run.y, strict=True)), "energy.kinetic": run.kinetic}
    right, wrong, missing = list[str](), list[str](), list[str]()
    with tempfile.TemporaryDirectory(prefix="lagrangian-", ignore_cleanup_errors=True) as folder:
        for ending, read in READERS.items():
            try:
                found = read(run.save(Path(folder) / f"run{ending}"), tuple(expected))
            except MissingExtra:
                missing.append(ending)
                continue
            same = all(np.array_equal(found[name], values) for name, values in expected.items())
            (right if same else wrong).append(ending)
    said = [f"{', '.join(names)} {words}" for names, words in ((wrong, "differ"), (right, "read back")) if names]
    if missing:
        said.append(f"not checked: {', '.join(missing)}, whose packages are not installed")
    return Check(what, not wrong, "; ".join(said))


Columns: TypeAlias = Mapping[str, Array]


def _csv(path: Path, names: Sequence[str]) -> Columns:
    with path.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in names}


def _netcdf(path: Path, names: Sequence[str]) -> Columns:
    with needed("h5py").File(path, "r") as file:
        return {name: np.array(file[name]) for name in names}


def _parquet(path: Path, names: Sequence[str]) -> Columns:
    table = needed("pyarrow.parquet").read_table(path)
    return {name: table[name].to_numpy() for name in names}


def _npz(path: Path, names: Sequence[str]) -> Columns:
    with np.load(path) as file:
        return {name: file[name] for name in names}


READERS: dict[str, Callable[[Path, Sequence[str]], Columns]] = {
    ".csv": _csv,
    ".nc": _netcdf,
    ".parquet": _parquet,
    ".npz": _npz,
}
"""What reads a file back, by its ending."""
