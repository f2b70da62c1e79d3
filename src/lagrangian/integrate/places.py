"""Where a store is: a local folder, or a place in object storage (``s3://bucket/sweep.zarr``) through fsspec.

Object storage has no folders, no locks and no renaming: an object is written completely or not at all, and replaced the
same way. `ObjectPath` has the part of `pathlib.Path` that stores need.
"""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path, PurePosixPath
from typing import Any, TypeAlias, TypeVar

from lagrangian.errors import Error, MissingExtra
from lagrangian.records import dataclass, field

T = TypeVar("T")
R = TypeVar("R")

REQUESTS = 16
"""The number of requests to object storage at a time."""


@dataclass(frozen=True)
class ObjectPath:
    """A place in object storage: the URL of a store, and the names below it. Its errors are `OSError`."""

    url: str
    below: PurePosixPath = field(default_factory=PurePosixPath)

    def __str__(self) -> str:
        """Return the URL."""
        return f"{self.url}/{self.below}" if self.below.parts else self.url

    def __truediv__(self, name: str) -> ObjectPath:
        return ObjectPath(self.url, self.below / name)

    def joinpath(self, *names: str) -> ObjectPath:
        """Return a place below this one."""
        return ObjectPath(self.url, self.below.joinpath(*names))

    def relative_to(self, other: ObjectPath) -> PurePosixPath:
        """Return the names by which this place is reached from another."""
        return self.below.relative_to(other.below)

    @property
    def name(self) -> str:
        """The last name."""
        return str(self).rpartition("/")[2]

    def is_file(self) -> bool:
        """Return whether there is an object."""
        return bool(self._asked("isfile"))

    def is_dir(self) -> bool:
        """Return whether there are objects below."""
        return bool(self._asked("isdir"))

    def is_symlink(self) -> bool:
        """Return False: object storage has no links."""
        return False

    def exists(self) -> bool:
        """Return whether there is an object here or below."""
        return bool(self._asked("exists"))

    def iterdir(self) -> Iterator[ObjectPath]:
        """Return what is directly below."""
        names = {str(entry).rstrip("/").rpartition("/")[2] for entry in self._asked("ls", detail=False)}
        return (self / name for name in sorted(names))

    def read_bytes(self) -> bytes:
        """Return the content of the object."""
        return self._asked("cat_file")

    def read_range(self, start: int, stop: int) -> bytes:
        """Return part of the object."""
        return self._asked("cat_file", start=start, end=stop)

    def size(self) -> int:
        """Return the size of the object in bytes."""
        return int(self._asked("size"))

    def write_bytes(self, data: bytes) -> None:
        """Write the object completely or not at all."""
        self._asked("pipe_file", data)

    def unlink(self, missing_ok: bool = False) -> None:
        """Remove the object."""
        try:
            self._asked("rm_file")
        except FileNotFoundError:
            if not missing_ok:
                raise

    def remove_tree(self) -> None:
        """Remove everything below."""
        if self.exists():
            self._asked("rm", recursive=True)

    def _asked(self, request: str, *given: Any, **named: Any) -> Any:
        """Ask the file system; errors of its libraries that are not `OSError` become one."""
        files, path = _files(str(self))
        try:
            return getattr(files, request)(path, *given, **named)
        except OSError:
            raise
        except Exception as trouble:  # each service has its own classes of errors
            raise OSError(f"{type(trouble).__name__}: {trouble}") from trouble


StorePlace: TypeAlias = Path | ObjectPath


def place(store: str | Path) -> StorePlace:
    """Return the place of a store: text with ``://`` is in object storage, except for ``file://``.

    Raises `MissingExtra` if the package for its service is not installed, and `Error` if there is no such service, or
    if the URL contains a password.
    """
    if not isinstance(store, (str, Path)):
        raise Error(
            f"a store must be text or a Path (got {type(store).__name__})", fix='such as "sweep.zarr"', code="E801"
        )
    text = str(store)
    if isinstance(store, Path) or "://" not in text:
        return Path(store)
    if text.startswith("file://"):
        return Path(text.removeprefix("file://"))
    user, at, _ = text.partition("://")[2].partition("/")[0].rpartition("@")
    if at and ":" in user:
        raise Error(
            "the URL of the store contains a password, which messages and files would show",
            fix="leave it out: credentials come from where the service's package looks for them",
            code="E801",
        )
    if "::" in text:
        raise Error(
            f"'{text}' is a chain of places", fix="use the URL of one place: s3://bucket/sweep.zarr", code="E801"
        )
    _files(text)
    return ObjectPath(text.rstrip("/"))


def _files(url: str) -> tuple[Any, str]:
    """The file system of a URL, and the path in it."""
    try:
        import fsspec
    except ImportError:
        raise MissingExtra(
            "a store at a URL needs the package fsspec, which is not installed", fix="pip install 'lagrangian[sweep]'"
        ) from None
    try:
        return fsspec.core.url_to_fs(url, use_listings_cache=False)
    except ImportError as trouble:
        raise MissingExtra(f"a store at '{url}' needs another package: {trouble}", fix="install it with pip") from None
    except ValueError as trouble:
        raise Error(
            f"'{url}' is not a place: {trouble}", fix="s3://bucket/sweep.zarr, or a folder", code="E801"
        ) from None


def for_zarr(where: StorePlace) -> Path | str:
    """The place as zarr wants it."""
    return where if isinstance(where, Path) else str(where)


def tail(file: StorePlace, count: int) -> tuple[int, bytes]:
    """The size of a file in bytes, and its last bytes."""
    if isinstance(file, ObjectPath):
        size = file.size()
        return size, file.read_range(max(0, size - count), size)
    with file.open("rb") as opened:
        size = opened.seek(0, 2)
        opened.seek(max(0, size - count))
        return size, opened.read()


def put(file: StorePlace, data: bytes) -> None:
    """Write a file completely or not at all."""
    if isinstance(file, ObjectPath):
        file.write_bytes(data)
        return
    file.parent.mkdir(parents=True, exist_ok=True)
    beside = file.with_name(f".{file.name}.part")
    beside.write_bytes(data)
    beside.replace(file)


def remove_tree(folder: StorePlace) -> None:
    """Remove everything in a folder, if it is there."""
    if isinstance(folder, ObjectPath):
        folder.remove_tree()
    else:
        shutil.rmtree(folder, ignore_errors=True)


def each(where: StorePlace, function: Callable[[T], R], items: Iterable[T]) -> list[R]:
    """Apply a function that reads files to all items; in object storage, many requests run at a time."""
    if isinstance(where, Path):
        return [function(item) for item in items]
    with ThreadPoolExecutor(REQUESTS) as pool:
        return list(pool.map(function, items))
