"""Writes the results of an ensemble to disk, chunk by chunk, so that a killed process loses only unfinished chunks.

A store is a Zarr group (format 3) with an array for each result over the ensemble's shape, the coordinates, and the
array ``done`` of marks (`checksums`), which is plain and uncompressed. The results of a chunk are written first, each
file under a temporary name and then renamed; the marks are written last, so a chunk is either done or not. The
attributes of the group describe the task; a store is never continued with another task. Before a store is continued,
all of it is checked, and damaged parts are computed again.
"""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import tempfile
import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.advice import Advice
from lagrangian.errors import Error, RunError
from lagrangian.integrate.checksums import (
    AGAIN,
    DONE,
    FORMAT,
    KEY,
    OVERWRITE,
    RESUME,
    ROOT,
    StoreDocument,
    finished,
    found,
    open_document,
    parsed,
    seal,
)
from lagrangian.integrate.chunks import Portions
from lagrangian.integrate.marks import alone, marks_file
from lagrangian.integrate.observe import Values
from lagrangian.integrate.places import ObjectPath, StorePlace, put, remove_tree
from lagrangian.integrate.stored import explained, fill, library, lost_chunks, opened, whole
from lagrangian.records import dataclass, field


@dataclass(frozen=True)
class Variable:
    """An array in a store: type, names of its axes, shape, and attributes (units, long_name)."""

    dtype: str
    dims: tuple[str, ...]
    shape: tuple[int, ...]
    words: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class ChunkPlan:
    """The contents of a store.

    ``results``: arrays whose first axes are those of the ensemble; ``coordinates``: other arrays with their values, as
    pieces that are written one after another along the first axis; ``task``: a description as plain data, by which two
    tasks are compared.
    """

    portions: Portions
    results: Mapping[str, Variable]
    coordinates: Mapping[str, tuple[Variable, Sequence[Any] | Iterator[NDArray[Any]]]]
    task: Mapping[str, Any]
    words: Mapping[str, Any] = field(default_factory=dict)


class Store:
    """A sink on disk; use it in a ``with`` statement, so that it is closed. Only one process at a time may write to it.

    ``done`` (chunks,): which chunks exist. ``notices``: what was damaged and is repaired.
    """

    def __init__(self, document: StoreDocument) -> None:
        self.path, self.document, self.portions = document.path, document, document.portions
        self.notices: list[str] = []
        with explained(self.path, "open"):
            self._file = marks_file(document)
            self.marks = document.marks(self._file.data)
            if len(self._file.data) != self.marks.nbytes:
                self.notices.append(f"the list of finished chunks in '{self.path}' had a wrong length")
                self._file.whole(self.marks)
        self.done = finished(self.marks)
        self._arrays = opened(document, "r+")

    def __enter__(self) -> Store:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Release the store, so that another process may write to it."""
        self._file.close()

    def write(self, index: int, box: tuple[slice, ...], values: Values) -> None:
        """Write the results of a chunk, then its marks."""
        with explained(self.path, "write", self._kept):
            sizes = tuple(part.stop - part.start for part in box)
            for name in self.document.results:
                self.document.chunk(name, index).unlink(missing_ok=True)  # left by an interruption: never read
            for name in self.document.results:  # status last, because other readers rely on it
                self._arrays[name][(*box, ...)] = values[name].reshape(*sizes, *values[name].shape[1:])
            self._mark(index, [self.document.mark(name, index) for name in self.document.results])
        self.done[index] = True

    def _mark(self, index: int, marks: Sequence[int]) -> None:
        self.marks[index] = marks
        self._file.write(self.marks, index)

    def mend(self, plan: ChunkPlan) -> None:
        """Find all damage: damaged chunks are marked as not done, coordinates and metadata are written again."""
        with explained(self.path, "repair"):
            self._mend_metadata()
            for name, (_, values) in plan.coordinates.items():
                self._mend_coordinate(name, values)
            lost = self.document.unfit(self.marks, every_byte=True)
            for index in lost:
                self._mark(index, [0] * len(self.document.results))
        if lost:
            self.done[list(lost)] = False
            they = "they are" if len(lost) > 1 else "it is"
            self.notices.append(f"{lost_chunks(self.document, lost)}: {they} computed again")

    def _mend_metadata(self) -> None:
        for name, metadata in self.document.arrays.items():
            folder = self.path / name
            if not _holds(parsed(folder), metadata):
                put(folder / ROOT, json.dumps(metadata, indent=2).encode())
                self.notices.append(f"'{name}/{ROOT}' in '{self.path}' was damaged: written again")

    def _mend_coordinate(self, name: str, values: Iterable[Any]) -> None:
        """Write a damaged coordinate again; ``values`` are those of the task."""
        array, right = self._arrays[name], self.document.kept["coordinates"][name]
        if whole(array, right) is not None:
            return
        remove_tree(self.path / name / "c")
        _fill_array(array, values)
        if whole(array, right) is None:
            raise RunError(
                f"'{self.path}' is damaged: the values of '{name}' match neither what was written nor this sweep",
                fix=AGAIN,
                code="E804",
            )
        self.notices.append(f"the values of '{name}' in '{self.path}' were damaged: written again")

    def _kept(self) -> str:
        ranges = map(self.portions.range, np.flatnonzero(self.done).tolist())
        safe = sum(stop - start for start, stop in ranges)
        return Advice(f"{safe} runs are safely there: make room, then go on with ", RESUME)


def create(path: StorePlace, plan: ChunkPlan, *, overwrite: bool = False) -> Store:
    """Make a store at ``path``, completely or not at all; an existing store is replaced only with ``overwrite``.

    Raises `Error` if something other than a store exists there: it is never removed.
    """
    library()
    if _there(path) and not overwrite:
        raise Error(
            f"'{path}' exists",
            fix=Advice("continue it with ", RESUME, ", replace it with ", OVERWRITE, ", or use another name"),
            code="E802",
        )
    if isinstance(path, ObjectPath):
        return _create_objects(path, plan)
    with explained(path, "make"):
        folder = path.resolve().parent
        if not folder.is_dir():
            raise Error(f"cannot write '{path}': there is no folder '{path.parent}'", fix="make it first", code="E801")
        beside = Path(tempfile.mkdtemp(dir=folder, prefix=f".{path.name[:100]}.", suffix=".part"))
        try:
            _fill(beside / "new", plan)
            if os.path.lexists(path):
                _move_away(path, beside / "old")
            try:
                (beside / "new").rename(path)
            except OSError:
                if (beside / "old").exists():
                    (beside / "old").rename(path)
                raise
        finally:
            shutil.rmtree(beside, ignore_errors=True)
    return Store(open_document(path))


def _there(path: StorePlace) -> bool:
    """Whether something is at a place, a link to nothing included."""
    with explained(path, "open"):
        return os.path.lexists(path) if isinstance(path, Path) else path.exists()


def _create_objects(path: ObjectPath, plan: ChunkPlan) -> Store:
    """Make a store in object storage: it is written here and sent there, the root document last, so that a store is
    complete or not there. One that is replaced is removed before, because objects cannot be renamed."""
    with explained(path, "make"), tempfile.TemporaryDirectory(prefix="lagrangian.") as folder:
        here = Path(folder) / "new"
        _fill(here, plan)
        if path.exists():
            _check_ours(path)
            (path / ROOT).unlink(missing_ok=True)
            path.remove_tree()
        files = sorted((f for f in here.rglob("*") if f.is_file()), key=lambda f: f == here / ROOT)
        for file in files:
            path.joinpath(*file.relative_to(here).parts).write_bytes(file.read_bytes())
        return Store(open_document(path))


def _fill(path: Path, plan: ChunkPlan) -> None:
    """Write a new store: empty results, coordinates, no marks; then its seal."""
    zarr = library()
    said = {"format": FORMAT, "block": list(plan.portions.block), "results": list(plan.results), "task": plan.task}
    group = zarr.create_group(path, attributes={**plan.words, KEY: said})
    squeezed = zarr.codecs.BloscCodec(
        cname="lz4", clevel=5, shuffle="shuffle"
    )  # for smooth curves: fast, and with the smallest files
    how: dict[str, Any] = {"compressors": [squeezed, zarr.codecs.Crc32cCodec()]}
    for name, variable in plan.results.items():
        extra = variable.shape[len(plan.portions.block) :]
        missing = fill(variable.dtype, name)
        _array(group, name, variable, chunks=(*plan.portions.block, *extra), fill_value=missing, **how)
    sums, how = {}, {**how, "config": {"write_empty_chunks": True}}
    for name, (variable, values) in plan.coordinates.items():
        array = _array(group, name, variable, chunks=_chunks(variable.shape), **how)
        sums[name] = _fill_array(array, values)
    count = len(plan.portions) * len(plan.results)
    _array(group, DONE, Variable("uint64", ("chunk",), (count,)), chunks=(count,), compressors=None, fill_value=0)
    with warnings.catch_warnings():  # zarr says that the listing is its own extension of the format; xarray expects it
        warnings.simplefilter("ignore")
        zarr.consolidate_metadata(path)
    root = json.loads((path / ROOT).read_bytes())
    root["attributes"][KEY]["coordinates"] = sums
    root["attributes"][KEY]["seal"] = seal(root)
    put(path / ROOT, json.dumps(root, indent=2).encode())
    put(open_document(path).marks_file, bytes(8 * count))


def _fill_array(array: Any, values: Iterable[Any]) -> str:
    """Write pieces one after another along the first axis; return the checksum of all of them."""
    sums, at = hashlib.blake2b(digest_size=8), 0
    for part in values:
        part = np.asarray(part, array.dtype)
        sums.update(np.ascontiguousarray(part).tobytes())
        if array.shape:
            array[at : at + len(part)] = part
            at += len(part)
        else:
            array[()] = part.reshape(())
    return sums.hexdigest()


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
    """The chunks of a coordinate: up to a million numbers along its first axis."""
    return (max(1, min(shape[0], 1 << 20)), *shape[1:]) if shape else ()


def resume(path: StorePlace, plan: ChunkPlan) -> Store:
    """Open the store at ``path`` to continue with the same task.

    All of it is checked: damaged chunks are not ``done``, and ``notices`` says how many there are. Raises `RunError` if
    it belongs to another task, or has damage that cannot be repaired.
    """
    library()
    with explained(path, "open"):
        document = open_document(path)
    differing = differences(document.kept["task"], json.loads(json.dumps(plan.task)))
    if differing:
        raise RunError(
            f"'{path}' belongs to a different sweep: " + "; ".join(differing),
            code="E803",
            fix="repeat the sweep that it was made for, or use another name for this one",
        )
    store = Store(document)
    try:
        store.mend(plan)
    except BaseException:
        store.close()
        raise
    return store


def _holds(there: Any, metadata: Any) -> bool:
    """Whether metadata on disk are ours, perhaps with attributes that somebody added."""
    if not isinstance(there, dict) or not isinstance(metadata, dict):
        return there == metadata
    return all(key in there and _holds(there[key], value) for key, value in metadata.items())


def differences(before: Mapping[str, Any], now: Mapping[str, Any]) -> list[str]:
    """The differences between two tasks in words: ``rtol was 1e-09, is 1e-06``."""
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


def _move_away(path: Path, where: Path) -> None:
    """Move a store that nobody writes to; anything else at its place, or inside it, is left alone."""
    _check_ours(path)
    if (path / DONE / "c" / "0").is_file():
        os.close(alone(path / DONE / "c" / "0"))
    path.rename(where)


def _check_ours(path: StorePlace) -> None:
    """Raise `Error` if something other than a store is at a place, or in the store."""
    root = None if path.is_symlink() else parsed(path)
    attributes = root.get("attributes") if root is not None else None
    kept = attributes.get(KEY) if isinstance(attributes, dict) else None
    if not isinstance(kept, dict) or not {"format", "results", "task"} <= kept.keys():
        what = "it is a link" if path.is_symlink() else found(path)
        raise Error(
            f"'{path}' is not a store of a sweep and is not replaced: {what}",
            fix="remove it yourself, or use another name",
            code="E801",
        )
    ours = {ROOT, DONE, *(name.partition("/")[0] for name in [*kept["results"], *kept["coordinates"]])}
    if others := sorted(entry.name for entry in path.iterdir() if entry.name not in ours):
        raise Error(
            f"'{path}' is not replaced: '{others[0]}' in it was not written by a sweep",
            fix="move that to another place, or use another name",
            code="E801",
        )
