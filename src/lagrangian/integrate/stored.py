"""Reads results from a store: a finished chunk contains exactly what was written, or there is a specific error.

`zarr` treats a missing file as values that nobody wrote; here every file is first compared with its mark.
"""

from __future__ import annotations

import contextlib
import errno
import hashlib
from collections.abc import Callable, Iterator, Mapping
from types import EllipsisType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.advice import Advice
from lagrangian.errors import Error, MissingExtra, RunError
from lagrangian.integrate.checksums import AGAIN, DONE, RESUME, StoreDocument, finished, open_document
from lagrangian.integrate.places import ObjectPath, StorePlace, for_zarr
from lagrangian.integrate.status import RunStatus
from lagrangian.records import dataclass

LISTED = 3
"""The number of damaged chunks that are listed."""


def library() -> Any:
    """The module zarr; raises `MissingExtra` if it is not installed."""
    try:
        import zarr
    except ImportError:
        raise MissingExtra(
            "storing results on disk needs the package zarr, which is not installed",
            fix="pip install 'lagrangian[sweep]'",
        ) from None
    return zarr


@contextlib.contextmanager
def explained(path: StorePlace, verb: str, kept: Callable[[], str] | None = None) -> Iterator[None]:
    """Convert errors of the operating system to an `Error` that says which results are safe."""
    try:
        yield
    except OSError as trouble:
        reason = (trouble.strerror or str(trouble)).lower()
        full = trouble.errno in (errno.ENOSPC, errno.EDQUOT)
        fix = kept() if kept is not None else "make room" if full else "check the place and its permissions"
        raise Error(f"cannot {verb} '{path}': {reason}", fix=fix, code="E801") from trouble
    except Error:
        raise
    except Exception as trouble:  # a service of object storage has its own classes of errors
        if not isinstance(path, ObjectPath) or type(trouble).__module__.split(".")[0] in ("builtins", "zarr"):
            raise
        fix = kept() if kept is not None else "check the address and the permissions"
        raise Error(f"cannot {verb} '{path}': {trouble}", fix=fix, code="E801") from trouble


def fill(dtype: str, name: str) -> float | int:
    """The value that stands for a missing result."""
    return np.nan if dtype.startswith("float") else int(RunStatus.NOT_RUN) if name == "status" else -1


def opened(document: StoreDocument, mode: str) -> dict[str, Any]:
    """The arrays of a store. Chunks are written even if they contain only the fill value, so a missing chunk is
    lost."""
    zarr = library()
    with explained(document.path, "open"), zarr.config.set({"array.write_empty_chunks": True}):
        group = zarr.open_group(for_zarr(document.path), mode=mode, use_consolidated=True)
        return {name: group[name] for name in document.arrays if name != DONE}


def lost_chunks(document: StoreDocument, lost: Mapping[int, str]) -> str:
    """Say how many chunks of a store are damaged, and which."""
    ranges = map(document.portions.range, lost)
    runs = sum(stop - start for start, stop in ranges)
    files = ", ".join(list(lost.values())[:LISTED]) + (", …" if len(lost) > LISTED else "")
    chunks = f"{len(lost)} damaged chunk{'s' if len(lost) > 1 else ''}"
    return f"'{document.path}' has {chunks} ({runs} runs): {files}"


def whole(array: Any, right: str) -> NDArray[Any] | None:
    """All values of a coordinate, or None if they do not have that checksum."""
    try:
        values = np.asarray(array[...])
    except ValueError:
        return None
    return values if hashlib.blake2b(values.tobytes(), digest_size=8).hexdigest() == right else None


@dataclass(frozen=True, eq=False)
class StoredResult:
    """A result in a store; ``[...]`` reads all of it, with the fill value for runs that are not done or lost."""

    stored: Stored
    name: str
    array: Any

    @property
    def shape(self) -> tuple[int, ...]:
        """The ensemble's shape followed by that of the result."""
        return tuple(self.array.shape)

    def __getitem__(self, _: EllipsisType) -> NDArray[Any]:
        """Read all values; raises `RunError` if one is damaged, and `Error` if it cannot be read."""
        with explained(self.stored.document.path, "read"):
            return self._values()

    @property
    def blocks(self) -> tuple[tuple[int, ...], ...]:
        """The sizes of the chunks along each axis."""
        shape, chunks = self.shape, self.array.chunks
        return tuple(tuple(min(c, n - k) for k in range(0, n, c)) for n, c in zip(shape, chunks, strict=True))

    def block(self, place: tuple[int, ...]) -> NDArray[Any]:
        """Read one chunk, all bytes checked; ``place`` is its number along each axis."""
        document = self.stored.document
        grid = document.portions.grid
        index = int(np.ravel_multi_index(place[: len(grid)], grid)) if grid else 0
        box = (*document.portions.box(index), ...)
        with explained(document.path, "read"):
            if self.stored.done[index]:
                marks = np.where(np.arange(len(self.stored.marks))[:, None] == index, self.stored.marks, 0)
                if lost := document.unfit(marks, [self.name], every_byte=True):
                    raise self.stored.error(lost)
                return np.asarray(self.array[box])
            lost_here = self.name == "status" and index in self.stored.lost
            value = RunStatus.LOST if lost_here else fill(str(self.array.dtype), self.name)
            return np.full([sizes[k] for sizes, k in zip(self.blocks, place, strict=True)], value, self.array.dtype)

    def lazily(self) -> Any:
        """A Dask array of the chunks."""
        try:
            import dask.array
        except ImportError:
            raise MissingExtra("reading lazily needs the package dask", fix="pip install 'lagrangian[sweep]'") from None
        dtype = self.array.dtype

        def read(block_id: tuple[int, ...]) -> NDArray[Any]:
            return self.block(block_id)

        if not self.shape:
            return dask.array.from_array(self[...])
        return dask.array.map_blocks(read, chunks=self.blocks, dtype=dtype, meta=np.empty([0] * len(self.shape), dtype))

    def _values(self) -> NDArray[Any]:
        document, done = self.stored.document, self.stored.done
        marks = self.stored.marks * done[:, None]
        if lost := document.unfit(marks, [self.name]):
            raise self.stored.error(lost)
        try:
            if done.all():
                return np.asarray(self.array[...])
            values = np.full(self.shape, fill(str(self.array.dtype), self.name), self.array.dtype)
            for index in np.flatnonzero(done).tolist():
                box = (*document.portions.box(index), ...)
                values[box] = self.array[box]
        except ValueError:  # the checksum at the end of a chunk does not match its content
            if lost := document.unfit(marks, [self.name], every_byte=True):
                raise self.stored.error(lost) from None
            raise
        if self.name == "status":
            for index in self.stored.lost:
                values[document.portions.box(index)] = RunStatus.LOST
        return values


class Stored:
    """The contents of a store, as far as it was finished when it was opened.

    Opening it checks the metadata, the coordinates, and that every finished chunk exists with the checksum with which
    it was written; reading a result checks the chunks themselves. With ``lost``, every byte is checked, and damaged
    chunks are omitted. Raises `Error` if there is no store, and `RunError` (E804) if it is damaged.
    """

    def __init__(self, path: StorePlace, *, lost: bool = False) -> None:
        library()
        with explained(path, "read"):
            self.document = open_document(path)
            self.marks = self.document.marks(self._marks_file())
            self.arrays = opened(self.document, "r")
            self.coordinates = {name: self._coordinate(name) for name in self.document.kept["coordinates"]}
            self.lost = self.document.unfit(self.marks, every_byte=lost)
        if self.lost and not lost:
            raise self.error(self.lost)
        self.done = finished(self.marks)
        self.done[list(self.lost)] = False

    @property
    def results(self) -> dict[str, StoredResult]:
        """The results, which are read when they are accessed."""
        return {name: StoredResult(self, name, self.arrays[name]) for name in self.document.results}

    def said(self) -> str:
        """A description of the damage."""
        return lost_chunks(self.document, self.lost)

    def error(self, lost: Mapping[int, str]) -> RunError:
        """The error that describes the damage."""
        return RunError(
            lost_chunks(self.document, lost),
            fix=Advice(
                "repeat the sweep with ",
                RESUME,
                ", which computes only these again; or read the others in Python with "
                f"Ensemble.of_store('{self.document.path}', lost=True)",
            ),
            code="E804",
        )

    def _marks_file(self) -> bytes:
        file = self.document.marks_file
        data = file.read_bytes() if file.exists() else None
        if data is None or len(data) != 8 * len(self.document.portions) * len(self.document.results):
            raise RunError(
                f"'{self.document.path}' is damaged: its list of finished chunks, "
                f"'{DONE}/c/0', is {'missing' if data is None else 'cut off'}",
                fix=Advice("repeat the sweep with ", RESUME, ", which computes again what is not listed"),
                code="E804",
            )
        return data

    def _coordinate(self, name: str) -> NDArray[Any]:
        values = whole(self.arrays[name], self.document.kept["coordinates"][name])
        if values is None:
            raise RunError(
                f"'{self.document.path}' is damaged: the values of '{name}' are not what was written",
                fix=Advice("repeat the sweep with ", RESUME, ", which writes them again; or ", AGAIN),
                code="E804",
            )
        return values
