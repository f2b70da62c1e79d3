"""Results of an ensemble on disk, chunk by chunk, so that a kill loses at most the chunks under way.

A Zarr group (format 3) with one array a result over the ensemble's shape, coordinates beside them, and the array
``done``: one byte a chunk, plain and uncompressed. A chunk's results are written first, each file beside its place
and renamed into it, its byte last: a chunk is done or it is not. The group's attributes hold what the task is; another
task is never carried on in the same store.
"""

from __future__ import annotations

import contextlib
import errno
import os
import shutil
import tempfile
import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.errors import Error, MissingExtra, RunError
from lagrangian.simulate.portions import Portions
from lagrangian.simulate.study import Values

FORMAT = 1
KEY = "lagrangian"
DONE = "done"
NOT_RUN = -128
"""Status of a run that nobody has done yet."""


def library() -> Any:
    """The module zarr; raises `MissingExtra` where it is not installed."""
    try:
        import zarr
    except ImportError:
        raise MissingExtra(
            "zarr is not installed, and results are kept on disk with it", fix="pip install 'lagrangian[sweep]'"
        ) from None
    return zarr


@dataclass(frozen=True)
class Variable:
    """An array of a store: type, names of its axes, shape, and words about it (units, long_name)."""

    dtype: str
    dims: tuple[str, ...]
    shape: tuple[int, ...]
    words: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Plan:
    """What a store will hold.

    ``results``: arrays whose first axes are the ensemble's; ``coordinates``: other arrays with their values, given as
    portions to be written one after the other along the first axis; ``task``: what is done, as plain data: two tasks
    are the same where this is equal.
    """

    portions: Portions
    results: Mapping[str, Variable]
    coordinates: Mapping[str, tuple[Variable, Sequence[Any] | Iterator[NDArray[Any]]]]
    task: Mapping[str, Any]
    words: Mapping[str, Any] = field(default_factory=dict)


class Store:
    """A sink on disk; use it as a context, so that it is closed. One process at a time may write to it.

    ``done`` (chunks,): which chunks are there.
    """

    def __init__(self, path: Path, group: Any, portions: Portions) -> None:
        self.path, self.group, self.portions = path, group, portions
        self._file = _alone(path, len(portions))
        os.lseek(self._file, 0, os.SEEK_SET)
        marks = np.frombuffer(os.read(self._file, len(portions)), np.uint8)
        if len(marks) != len(portions):
            self.close()
            raise RunError(
                f"'{path}' is damaged: its list of finished chunks is cut off", code="E803", fix="start anew"
            )
        self.done = marks.astype(bool)
        self._arrays = {name: group[name] for name in group.attrs[KEY]["results"]}

    def __enter__(self) -> Store:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Let go of the store, so that another process may write to it."""
        if self._file >= 0:
            os.close(self._file)
            self._file = -1

    def write(self, index: int, box: tuple[slice, ...], values: Values) -> None:
        """Write the results of a chunk, then its mark."""
        with _explained(self.path, "write", self._kept):
            for name, array in self._arrays.items():
                sizes = tuple(part.stop - part.start for part in box)
                array[(*box, ...)] = values[name].reshape(*sizes, *values[name].shape[1:])
            os.lseek(self._file, index, os.SEEK_SET)
            os.write(self._file, b"\x01")
        self.done[index] = True

    def _kept(self) -> str:
        ranges = map(self.portions.range, np.flatnonzero(self.done).tolist())
        safe = sum(stop - start for start, stop in ranges)
        return f"{safe} runs are safely there: make room, then go on with resume"


def create(path: Path, plan: Plan, *, overwrite: bool = False) -> Store:
    """Make a store at ``path``, whole or not at all; an existing one is replaced only with ``overwrite``."""
    zarr = library()
    if path.exists() and not overwrite:
        raise Error(
            f"'{path}' exists",
            fix="go on where it stopped with resume, replace it with overwrite, or take another name",
            code="E802",
        )
    with _explained(path, "make"):
        if not path.resolve().parent.is_dir():
            raise Error(f"cannot write '{path}': there is no folder '{path.parent}'", fix="make it first", code="E801")
        beside = Path(tempfile.mkdtemp(dir=path.resolve().parent, prefix=f".{path.name[:100]}.", suffix=".part"))
        try:
            beside.chmod(0o777 & ~_umask())
            _fill(zarr, beside, plan)
            if path.exists():
                _remove(path)
            beside.rename(path)
        finally:
            shutil.rmtree(beside, ignore_errors=True)
    return Store(path, zarr.open_group(path, mode="r+"), plan.portions)


def _fill(zarr: Any, path: Path, plan: Plan) -> None:
    kept = {"format": FORMAT, "block": list(plan.portions.block), "results": list(plan.results), "task": plan.task}
    kept["coordinates"] = list(plan.coordinates)
    group = zarr.create_group(path, attributes={**plan.words, KEY: kept})
    squeezed = zarr.codecs.BloscCodec(cname="lz4", clevel=5, shuffle="shuffle")  # of smooth curves: fast, and smallest
    for name, variable in plan.results.items():
        extra = variable.shape[len(plan.portions.block) :]
        fill = np.nan if variable.dtype.startswith("float") else NOT_RUN if name == "status" else 0
        _array(group, name, variable, chunks=(*plan.portions.block, *extra), fill_value=fill, compressors=[squeezed])
    for name, (variable, values) in plan.coordinates.items():
        array, at = _array(group, name, variable, chunks=_chunks(variable.shape)), 0
        if not variable.shape:
            array[()] = next(iter(values))
            continue
        for part in values:
            array[at : at + len(part)] = part
            at += len(part)
    count = len(plan.portions)
    _array(group, DONE, Variable("uint8", ("chunk",), (count,)), chunks=(count,), compressors=None, fill_value=0)
    marks = path / DONE / "c" / "0"
    marks.parent.mkdir()
    marks.write_bytes(bytes(count))
    with warnings.catch_warnings():  # zarr says that the listing is its own extension of the format; xarray expects it
        warnings.simplefilter("ignore")
        zarr.consolidate_metadata(path)


def _array(group: Any, name: str, variable: Variable, **more: Any) -> Any:
    return group.create_array(
        name,
        shape=variable.shape,
        dtype=variable.dtype,
        dimension_names=variable.dims,
        attributes=dict(variable.words),
        **more,
    )


def _chunks(shape: tuple[int, ...]) -> tuple[int, ...]:
    """Chunks of a coordinate: up to a million numbers along its first axis."""
    return (max(1, min(shape[0], 1 << 20)), *shape[1:]) if shape else ()


def resume(path: Path, plan: Plan) -> Store:
    """Open the store at ``path`` to go on with the same task; there must be one, of this task."""
    zarr = library()
    group, kept = _kept(zarr, path, "r+")
    differing = differences(kept["task"], dict(plan.task))
    if differing:
        raise RunError(
            f"'{path}' holds another task: " + "; ".join(differing),
            code="E803",
            fix="repeat the task it was made for, or take another name for this one",
        )
    return Store(path, group, Portions(plan.portions.shape, tuple(kept["block"])))


def read(path: Path) -> Any:
    """The Zarr group of a store, to read."""
    return _kept(library(), path, "r")[0]


def _kept(zarr: Any, path: Path, mode: str) -> tuple[Any, dict[str, Any]]:
    """The group at a path, and what its maker wrote about it."""
    if not path.exists():
        raise Error(f"there is no '{path}'", fix="start without resume", code="E801")
    try:
        group = zarr.open_group(path, mode=mode)
        kept = group.attrs[KEY]
    except (KeyError, ValueError, FileNotFoundError, FileExistsError, NotADirectoryError):
        raise Error(f"'{path}' is no store of a sweep", fix="name one that a sweep made", code="E803") from None
    if kept.get("format") != FORMAT:
        raise Error(
            f"'{path}' has format {kept.get('format')}, known is {FORMAT}", fix="use the version it is of", code="E803"
        )
    return group, kept


def differences(before: Mapping[str, Any], now: Mapping[str, Any]) -> list[str]:
    """What two tasks differ in, in words: ``rtol was 1e-09, is 1e-06``."""
    found = []
    for key in dict.fromkeys([*before, *now]):
        old, new = before.get(key), now.get(key)
        if isinstance(old, Mapping) and isinstance(new, Mapping):
            found += [f"{key} {words}" for words in differences(old, new)]
        elif old != new:
            found.append(f"{key} was {_short(old)}, is {_short(new)}")
    return found


def _short(value: Any) -> str:
    text = "absent" if value is None else str(value)
    return text if len(text) <= 60 else text[:59] + "…"


@contextlib.contextmanager
def _explained(path: Path, verb: str, kept: Any = None) -> Iterator[None]:
    """Turn what the operating system refuses into an `Error` that says what is safe."""
    try:
        yield
    except OSError as trouble:
        reason = (trouble.strerror or str(trouble)).lower()
        full = trouble.errno in (errno.ENOSPC, errno.EDQUOT)
        fix = kept() if kept is not None else "make room" if full else "check the place and its permissions"
        raise Error(f"cannot {verb} '{path}': {reason}", fix=fix, code="E801") from trouble


def _alone(path: Path, chunks: int) -> int:
    """Open the list of finished chunks for this process alone; the operating system lets go of it when that ends."""
    with _explained(path, "open"):
        file = os.open(path / DONE / "c" / "0", os.O_RDWR | getattr(os, "O_BINARY", 0))
    try:
        if os.name == "posix":
            import fcntl

            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        else:
            import msvcrt

            os.lseek(file, chunks, os.SEEK_SET)  # behind the end: what is locked cannot be read by others
            msvcrt.locking(file, msvcrt.LK_NBLCK, 1)  # type: ignore[attr-defined]
    except OSError as trouble:
        os.close(file)
        if trouble.errno not in (errno.EWOULDBLOCK, errno.EACCES, errno.EAGAIN, errno.EDEADLK):
            reason = (trouble.strerror or str(trouble)).lower()
            raise Error(f"'{path}' cannot be locked: {reason}", fix="use a local disk", code="E801") from trouble
        raise Error(
            f"another process is writing to '{path}'", fix="wait for it, or take another name", code="E801"
        ) from None
    return file


def _remove(path: Path) -> None:
    """Remove a store that nobody writes to; anything else that stands at its place is left alone."""
    if not (path.is_dir() and (path / "zarr.json").is_file()):
        raise Error(f"'{path}' is no store and is not replaced", fix="remove it yourself, or name another", code="E801")
    if (path / DONE / "c" / "0").is_file():
        os.close(_alone(path, 0))
    shutil.rmtree(path)


def _umask() -> int:
    """The mask of permissions of new files; there is no way to read it but to set it."""
    mask = os.umask(0o022)
    os.umask(mask)
    return mask
