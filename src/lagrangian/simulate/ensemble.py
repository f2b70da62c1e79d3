"""The class `Ensemble`: the results of many runs, returned by `system.ensemble` and `system.sweep`."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray

from lagrangian.calls import ENSEMBLE, Guided
from lagrangian.errors import NoSuchEntry, RunError, did_you_mean
from lagrangian.integrate.observe import DRIFTED
from lagrangian.integrate.places import place
from lagrangian.integrate.status import RunStatus, endings_of, reason_of
from lagrangian.integrate.stored import Stored, StoredResult
from lagrangian.records import dataclass
from lagrangian.simulate.plot import check_no_file
from lagrangian.simulate.variation import SAMPLE, TIME
from lagrangian.view.many import SweptAxis, SweptResult, draw_many
from lagrangian.viewed import Entries, cut
from lagrangian.write.files import write_with
from lagrangian.write.tables import check_target, needed

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SHOWN = 20
"""The default number of failures that are listed."""

ROWS = 1 << 15
"""The number of rows that are written together."""

UNDONE = (RunStatus.NOT_RUN, RunStatus.LOST)
"""The statuses of runs without results."""


@dataclass(frozen=True)
class Failure:
    """A run that failed: its place along the axes, the varied values, and when and why it ended."""

    index: tuple[int, ...]
    values: Mapping[str, float]
    reached: float
    reason: str

    def __str__(self) -> str:
        """Return ``k = 10, m2 = 3: stopped at t = 0.5 s: the limit on the number of steps was reached``."""
        where = ", ".join(f"{name} = {x:.6g}" for name, x in self.values.items()) or f"run {self.index}"
        return f"{where}: stopped at t = {self.reached:.6g} s: {self.reason}"


class Ensemble(Guided, Mapping[str, NDArray[Any]]):
    """The results of many runs by name, as arrays over the axes of the ensemble; NaN if a run failed.

    ``dims`` and ``shape`` are the axes; ``coordinates`` are the varied values: name → (axes, values); ``times`` are the
    times of samples. ``runs["max theta1"]`` is an array of this shape; ``runs["theta1"]`` is short for it if there is
    only one result for theta1. Samples have time as their last axis. ``status`` says how each run ended. If a terminal
    event ends a run, or its events accumulate (status −4), results are taken over the part that was simulated.
    """

    _guide = ENSEMBLE

    def __init__(
        self,
        name: str,
        arrays: Mapping[str, Any],
        dims: Mapping[str, tuple[str, ...]],
        coordinates: Mapping[str, tuple[tuple[str, ...], NDArray[np.float64]]],
        words: Mapping[str, Mapping[str, Any]],
        settings: Mapping[str, Any],
        notices: tuple[str, ...] = (),
    ) -> None:
        self.notices = notices
        self.name, self._arrays, self._dims, self._words = name, arrays, dims, words
        self.coordinates, self.settings = Entries(dict(coordinates), "coordinates"), settings
        self.dims, self.shape = dims["status"], tuple(arrays["status"].shape)

    @classmethod
    def of_store(cls, path: str | Path, *, lost: bool = False) -> Ensemble:
        """Open the results in a store, finished or not; arrays are read from disk when they are needed.

        Raises `Error` if there is no store, and `RunError` (code E804) if it is damaged. With ``lost``, damaged runs
        are NaN with status −127, and the others can be read.
        """
        stored = Stored(place(path), lost=lost)
        task = stored.document.kept["task"]
        members = stored.arrays
        dims = {name: tuple(array.metadata.dimension_names or ()) for name, array in members.items()}
        coordinates = {name: (dims[name], values) for name, values in stored.coordinates.items()}
        words = {name: dict(array.attrs) for name, array in members.items()}
        notices = (stored.said(),) if stored.lost else ()
        return cls(task["system"], stored.results, dims, coordinates, words, task, notices)

    # -- results ------------------------------------------------------------------------------------------------

    def __getitem__(self, name: str) -> NDArray[Any]:
        if name in self._arrays:
            return np.asarray(self._arrays[name][...])
        short = [full for full in self._arrays if full.partition(" ")[2] == name]
        if len(short) == 1:
            return np.asarray(self._arrays[short[0]][...])
        if name in self.coordinates:
            return self.coordinates[name][1]
        known = [*self._arrays, *self.coordinates]
        fix = f"use one of {', '.join(short)}" if short else did_you_mean(name, known) or f"known: {', '.join(known)}"
        raise NoSuchEntry(f"there is no result '{name}'", fix=fix, code="E402")

    def axes_of(self, name: str) -> tuple[str, ...]:
        """Return the names of the axes of a result."""
        return self._dims[name]

    def words_of(self, name: str) -> Mapping[str, Any]:
        """Return what is known of a result or a varied value: its long name, and its unit if it has one."""
        return self._words.get(name, {})

    def __contains__(self, name: object) -> bool:
        return name in self._arrays

    def get(self, name: str, default: Any = None) -> Any:
        """Return the result with this full name, or ``default``."""
        if name not in self._arrays:
            return default
        return self[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._arrays)

    def __len__(self) -> int:
        return len(self._arrays)

    @property
    def times(self) -> NDArray[np.float64]:
        """The times of the samples [s]; empty if no samples were stored."""
        return self.coordinates[TIME][1] if TIME in self.coordinates else np.empty(0)

    @property
    def count(self) -> int:
        """The number of runs."""
        return int(np.prod(self.shape))

    @property
    def drift(self) -> Mapping[str, NDArray[np.float64]]:
        """How far every run came from its constraints, arrays by name; empty for a system without any.

        ``position`` and ``velocity``: the largest residuals at the ends of steps before they are corrected; ``left``:
        the largest afterwards; ``margin``: by how much the constraints are independent, at least.
        """
        return Entries({name.split()[1]: self[name] for name in self if name in DRIFTED}, "drift")

    # -- how it went --------------------------------------------------------------------------------------------

    @property
    def status(self) -> NDArray[np.int8]:
        """How each run ended: 0 at its end, 1 by a terminal event, negative for a failure."""
        return self["status"]

    @property
    def success(self) -> bool:
        """Whether every run reached its end or a terminal event."""
        return bool((self.status >= 0).all())

    @property
    def counts(self) -> dict[str, int]:
        """The number of runs for each way of ending, in words."""
        values, counts = np.unique(self.status, return_counts=True)
        return {reason_of(int(v)): int(n) for v, n in sorted(zip(values, counts, strict=True), key=lambda x: -x[1])}

    @property
    def endings(self) -> tuple[str, ...]:
        """How the runs ended, in words: ``all reached the end``, or ``2 of 3: a terminal event``, ….

        >>> from lagrangian import example
        >>> example("pendulum").ensemble(0.1, params={"L": [1, 2]}).endings
        ('all reached the end',)
        """
        return endings_of(self.counts, self.count)

    def failures(self, most: int = SHOWN) -> list[Failure]:
        """The first runs that failed, with the varied values and the reason for each."""
        status = self.status
        numbers = np.flatnonzero((status < 0) & ~np.isin(status, UNDONE))[:most]
        reached = self["reached"]
        found = []
        for number in numbers:
            index = tuple(int(k) for k in np.unravel_index(number, self.shape)) if self.shape else ()
            found.append(Failure(index, self.at(index), float(reached[index]), reason_of(int(status[index]))))
        return found

    def at(self, index: tuple[int, ...]) -> dict[str, float]:
        """The varied values of one run: name → value."""
        place = dict(zip(self.dims, index, strict=True))
        return {
            name: float(values[tuple(place[d] for d in dims)])
            for name, (dims, values) in self.coordinates.items()
            if set(dims) <= set(place)
        }

    def __repr__(self) -> str:
        """Summarize the runs: their number, axes, ends and results."""
        axes = " × ".join(f"{d} {n}" for d, n in zip(self.dims, self.shape, strict=True))
        sizes = f" ({axes})" if axes else ""
        ends = "; ".join(self.endings)
        kept = ", ".join(n for n in self if n not in ("status", "reached", *DRIFTED))
        said = "".join(f"; notice: {notice}" for notice in self.notices)
        return cut(
            f"<Ensemble {self.name!r}: {self.count} runs{sizes}, {self.settings['method']}; {ends}; {kept}{said}>"
        )

    def _repr_html_(self) -> str:
        from lagrangian.write.views import table_view

        axes = " × ".join(f"{d} {n}" for d, n in zip(self.dims, self.shape, strict=True))
        kept = ", ".join(n for n in self if n not in ("status", "reached"))
        words = [f"{self.count} runs{f' ({axes})' if axes else ''}, {self.settings['method']}", f"results: {kept}"]
        rows = [(reason, str(n)) for reason, n in self.counts.items()]
        return table_view(self.name, [*words, *map(str, self.notices)], ("how the runs ended", "runs"), rows)

    # -- taking it elsewhere ------------------------------------------------------------------------------------

    def to_xarray(self, *, lazy: bool = False) -> Any:
        """Return an ``xarray.Dataset`` with units and long names.

        With ``lazy``, the results are Dask arrays of the chunks of the store, each read and checked when it is needed.
        Raises `RunError` if the results are not in a store.
        """
        xarray = needed("xarray")
        made = xarray.Dataset(
            {n: (self._dims[n], self._lazy(n) if lazy else self[n], dict(self._words.get(n, {}))) for n in self},
            {n: (dims, values, dict(self._words.get(n, {}))) for n, (dims, values) in self.coordinates.items()},
            {"title": f"{self.name}: {self.count} runs", "method": self.settings["method"]},
        )
        for name, array in made.variables.items():
            array.attrs.setdefault("long_name", str(name))
        return made

    def _lazy(self, name: str) -> Any:
        """A result as a Dask array."""
        stored = self._arrays[name]
        if isinstance(stored, StoredResult):
            return stored.lazily()
        fix = 'store="sweep.zarr", or leave out lazy'
        raise RunError("only results in a store are read lazily", fix=fix, code="E501")

    def columns(self) -> dict[str, NDArray[Any]]:
        """Everything as columns of equal length, varied values and results; a row per run (with samples, per run and
        time).

        An axis along which nothing named varies is numbered from 0.
        """
        dims = {name: self._dims[name] for name in self} | {name: d for name, (d, _) in self.coordinates.items()}
        values = {name: self[name] for name in self} | {name: v for name, (_, v) in self.coordinates.items()}
        sizes: dict[str, int] = {}
        for name in self:
            sizes.update(zip(dims[name], values[name].shape, strict=True))
        counted = {d: np.arange(n) for d, n in sizes.items() if d not in self.coordinates}
        dims |= {d: (d,) for d in counted}
        order = [*counted, *self.coordinates, *self]
        return {name: _spread(counted.get(name, values.get(name)), dims[name], sizes) for name in order}

    def to_pandas(self) -> Any:
        """Return a ``pandas.DataFrame`` of `columns`."""
        return needed("pandas").DataFrame(self.columns())

    def plot(self, *names: str) -> Figure:
        """Return a pyplot figure of results over the varied values; by default, of all results with one number per run.

        One axis gives curves, two axes give maps, and samples give histograms; samples over an axis are shown as median
        and band. Failed runs are marked by red crosses. Notebooks show the figure, ``plt.show()`` opens it, and
        ``runs.plot().savefig(…)`` writes it.
        """
        return self._drawn(names, shown=True)

    def figure(self, *names: str) -> Figure:
        """Return the same figure as `plot` without using pyplot, for programs, threads and servers."""
        return self._drawn(names, shown=False)

    def _drawn(self, names: tuple[str, ...], *, shown: bool) -> Figure:
        for name in names:
            check_no_file(name, "runs.plot")
        drawn = names or tuple(
            n
            for n in self
            if self._dims[n] == self.dims and n not in ("status", "reached", *DRIFTED) and "count" not in n.split()
        )
        if not drawn:
            raise RunError("none of the results is a single number per run", fix='reduce=("final", "max")', code="E501")
        axes = [d for d in self.dims if d != SAMPLE]
        return draw_many(
            f"{self.name}: {self.count} runs",
            tuple(SweptAxis(*self._shown(d, self._along(d))) for d in axes),
            tuple(SweptResult(*self._shown(n, self._over(n))) for n in drawn),
            failed=self._failed(),
            shown=shown,
        )

    def _failed(self) -> str:
        """The number of failed runs and the reasons, in words; empty if there are none."""
        status = self.status
        lost = status[(status < 0) & (status != RunStatus.NOT_RUN)]
        ways = ", ".join(reason_of(int(s)) for s in np.unique(lost)[:3])
        return f"{lost.size} of {self.count} runs FAILED: {ways}" if lost.size else ""

    def _along(self, axis: str) -> NDArray[Any]:
        """The values along an axis: its own, or those of the single quantity that varies along it, or numbers."""
        own = [values for dims, values in self.coordinates.values() if dims == (axis,)]
        if axis in self.coordinates or len(own) == 1:
            return self.coordinates[axis][1] if axis in self.coordinates else own[0]
        return np.arange(self.shape[self.dims.index(axis)])

    def _over(self, name: str) -> NDArray[Any]:
        values = self[name]
        if values.shape != self.shape:
            raise RunError(
                f"'{name}' is not a single number per run",
                fix="reduce it, for example with 'max' or 'final'",
                code="E501",
            )
        return values

    def _shown(self, name: str, values: NDArray[Any]) -> tuple[str, str, NDArray[Any]]:
        """Label, unit and values for a plot, with angles in degrees."""
        label = name
        if name in self.dims and name not in self.coordinates:
            label = next((n for n, (dims, _) in self.coordinates.items() if dims == (name,)), name)
        full = next((n for n in self._arrays if n.partition(" ")[2] == name), name) if name not in self._words else name
        unit = str(self._words.get(label, self._words.get(full, {})).get("units", ""))
        return (label, "deg", np.degrees(values)) if unit == "rad" else (label, unit, values)

    def save(self, path: str | Path, *, overwrite: bool = False) -> Path:
        """Write everything to a ``.csv``, ``.parquet`` (as `columns`) or ``.nc`` file (as `to_xarray`), completely or
        not at all.

        Raises `Error` if the file exists (unless ``overwrite``) or cannot be written.
        """
        target = Path(path)
        check_target(target, list(ENDINGS), overwrite=overwrite)
        return write_with(target, lambda beside: ENDINGS[target.suffix.lower()](self, beside))


def _spread(values: Any, dims: tuple[str, ...], sizes: Mapping[str, int]) -> NDArray[Any]:
    """Broadcast an array over some axes to all axes, and flatten it."""
    shape = [sizes[d] if d in dims else 1 for d in sizes]
    ordered = np.transpose(values, [dims.index(d) for d in sizes if d in dims])
    return np.broadcast_to(ordered.reshape(shape), tuple(sizes.values())).reshape(-1)


def _netcdf(runs: Ensemble, path: Path) -> None:
    """NetCDF 4, made in memory because HDF5 crashes on a full disk. ``coordinates`` are named as in the CF
    conventions."""
    netcdf, data, memory = needed("h5netcdf"), runs.to_xarray(), io.BytesIO()
    beside = [name for name, values in data.coords.items() if (name,) != values.dims and " " not in name]
    with netcdf.File(memory, "w") as file:
        file.dimensions = dict(data.sizes)
        for name, variable in data.variables.items():
            made = file.create_variable(name, variable.dims, data=variable.values)
            made.attrs.update(variable.attrs)
            along = [c for c in beside if name in data.data_vars and set(data[c].dims) <= set(variable.dims)]
            if along:
                made.attrs["coordinates"] = " ".join(along)
        file.attrs.update(data.attrs)
    path.write_bytes(memory.getbuffer())


def _parquet(runs: Ensemble, path: Path) -> None:
    pa, pq = needed("pyarrow"), needed("pyarrow.parquet")
    pq.write_table(pa.table(runs.columns()), path)


def _csv(runs: Ensemble, path: Path) -> None:
    with path.open("w", encoding="utf-8", newline="") as file:
        write_csv(runs, file)


class Writable(Protocol):
    """An object to which text can be written piece by piece."""

    def write(self, text: str, /) -> object:
        """Write a piece of text."""
        ...


def write_csv(runs: Ensemble, file: Writable) -> None:
    """Write a line of names and a line for each row; numbers have all their digits."""
    columns = runs.columns()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(columns)
    count = len(next(iter(columns.values())))
    for start in range(0, count, ROWS):
        writer.writerows(zip(*[c[start : start + ROWS].tolist() for c in columns.values()], strict=True))


ENDINGS: Mapping[str, Callable[[Ensemble, Path], None]] = {".csv": _csv, ".nc": _netcdf, ".parquet": _parquet}
"""The function that writes a file, for each ending of its name."""
