"""Checksums of everything in a store of results, and a mark for every chunk, so that damage is detected.

The root document ``zarr.json`` contains a *seal*: checksums of each of our attributes and of the metadata of each
array. Every chunk of a result ends with its own checksum (crc32c). The array ``done`` contains a *mark* for every chunk
of every result, computed from the seal, the name of the result, the number of the chunk and that checksum, and from a
checksum of the whole file. A chunk that is missing, truncated, or from another place, result or store does not match
its mark. The first half of a mark is checked without reading the file.
"""

from __future__ import annotations

import hashlib
import json
import zlib
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.advice import Advice, Argument
from lagrangian.errors import Error, RunError
from lagrangian.integrate.chunks import Portions
from lagrangian.integrate.places import StorePlace, each, tail
from lagrangian.records import dataclass

FORMAT = 2
KEY = "lagrangian"
DONE = "done"
ROOT = "zarr.json"
CHECKSUM = 4
"""The number of bytes at the end of a chunk's file that contain its checksum."""

RESUME, OVERWRITE = Argument("resume", "True"), Argument("overwrite", "True")
"""The remedy for a store that exists but cannot be used."""
AGAIN = Advice("restore it from a copy, or start anew with ", OVERWRITE)

Marks = NDArray[np.uint64]


@dataclass(frozen=True)
class StoreDocument:
    """The root document of a store after checks: ``kept`` is what its creator wrote, ``arrays`` the metadata of its
    arrays."""

    path: StorePlace
    kept: Mapping[str, Any]
    arrays: Mapping[str, Mapping[str, Any]]

    @property
    def results(self) -> list[str]:
        """The names of the results."""
        return self.kept["results"]

    @property
    def portions(self) -> Portions:
        """How the results are divided into chunks."""
        block = tuple(self.kept["block"])
        return Portions(tuple(self.arrays["status"]["shape"][: len(block)]), block)

    @property
    def marks_file(self) -> StorePlace:
        """The file of the marks, with 8 bytes for every result of every chunk, which are 0 if it is not done."""
        return self.path / DONE / "c" / "0"

    def marks(self, data: bytes) -> Marks:
        """The marks in the bytes of the file (chunks, results); missing ones are 0."""
        shape = (len(self.portions), len(self.results))
        whole = data[: 8 * shape[0] * shape[1]]
        return np.frombuffer(whole.ljust(8 * shape[0] * shape[1], b"\0"), "<u8").astype(np.uint64).reshape(shape)

    def chunk(self, name: str, index: int) -> StorePlace:
        """The file of a chunk of a result."""
        return self.path.joinpath(name, "c", *self._number(name, index))

    def _number(self, name: str, index: int) -> list[str]:
        grid = self.portions.grid
        number = [int(k) for k in np.unravel_index(index, grid)] if grid else []
        number += [0] * (len(self.arrays[name]["shape"]) - len(number))
        return list(map(str, number))

    def mark(self, name: str, index: int) -> int:
        """The mark of a chunk on disk: from its place and its stored checksum, then from the checksum of its bytes."""
        data = self.chunk(name, index).read_bytes()
        return self._place(name, index, len(data), data[-CHECKSUM:]) << 32 | zlib.crc32(data)

    def _place(self, name: str, index: int, size: int, end: bytes) -> int:
        said = canonical([self.kept["seal"]["seal"], name, index, size]) + end
        return 1 | int.from_bytes(hashlib.blake2b(said, digest_size=4).digest(), "little")  # 0 means "not done"

    def _fits(self, name: str, index: int, mark: int, every_byte: bool) -> bool:
        try:
            if every_byte:
                return self.mark(name, index) == mark
            return self._place(name, index, *tail(self.chunk(name, index), CHECKSUM)) == mark >> 32
        except FileNotFoundError:
            return False

    def unfit(self, marks: Marks, names: Iterable[str] = (), *, every_byte: bool = False) -> dict[int, str]:
        """The finished chunks of which a file (of the results ``names``, or of all) does not match its mark, and these
        files.

        Existence, length and stored checksum of the files are checked, or, with ``every_byte``, the whole content.
        """
        columns = [(self.results.index(name), name) for name in names or self.results]

        def wrong(index: int) -> str | None:
            for column, name in columns:
                if not self._fits(name, index, int(marks[index, column]), every_byte):
                    there = "is not what was written" if self.chunk(name, index).exists() else "is missing"
                    return f"'{'/'.join([name, 'c', *self._number(name, index)])}' {there}"
            return None

        indices = np.flatnonzero(finished(marks)).tolist()
        found = zip(indices, each(self.path, wrong, indices), strict=True)
        return {index: words for index, words in found if words is not None}


def finished(marks: Marks) -> NDArray[np.bool_]:
    """Which chunks are done: those with a mark for every result."""
    return np.asarray(marks.all(axis=1))


def open_document(path: StorePlace) -> StoreDocument:
    """Read and check the root document of a store; raise `Error` if there is none, and `RunError` if it is damaged."""
    if not path.exists():
        raise Error(f"there is no '{path}'", fix="name a store that a sweep made", code="E801")
    root = parsed(path)
    kept = _at(root, "attributes", KEY)
    if root is None or not kept:
        raise Error(f"'{path}' is not a store of a sweep: {found(path)}", fix="name one that a sweep made", code="E803")
    if kept.get("format") != FORMAT:
        raise Error(
            f"'{path}' has format {kept.get('format')!r:.20}, known is {FORMAT}",
            fix=Advice("use the version of lagrangian that made it, or start anew with ", OVERWRITE),
            code="E803",
        )
    sealed, now = _at(kept, "seal"), seal(root)
    wrong = [name for name in sealed if name != "seal" and sealed[name] != now.get(name)]
    if not wrong and sealed.get("seal") != _of_all(sealed):
        wrong = [f"{KEY}.seal"]
    if wrong:
        more = f" (and {len(wrong) - 1} more)" if len(wrong) > 1 else ""
        raise RunError(
            f"'{path}' is damaged: in its {ROOT}, '{wrong[0]:.60}'{more} is not what was written",
            fix=Advice("undo the change, ", AGAIN),
            code="E804",
        )
    return StoreDocument(
        path, kept, {name: _at(root, "consolidated_metadata", "metadata", name) for name in _members(kept)}
    )


def seal(root: Mapping[str, Any]) -> dict[str, str]:
    """Checksums of everything important in a root document, by name; ``seal`` is the checksum of all of them.

    Attributes that somebody added are ignored.
    """
    kept = _at(root, "attributes", KEY)
    said: dict[str, Any] = {f"{KEY}.{k}": v for k, v in kept.items() if k not in ("seal", "task")}
    said |= {f"{KEY}.task.{k}": v for k, v in _at(kept, "task").items()}
    for name in _members(kept):
        array = _at(root, "consolidated_metadata", "metadata", name)
        said |= {f"{k} of {name}": v for k, v in array.items() if k != "attributes"}
        said |= {f"{k} of {name}": v for k, v in _at(array, "attributes").items()}
    about = {k: v for k, v in _at(root, "consolidated_metadata").items() if k != "metadata"}
    said["group"] = [about, {k: v for k, v in root.items() if k not in ("attributes", "consolidated_metadata")}]
    sums = {name: checksum(canonical(value)) for name, value in said.items()}
    return {**sums, "seal": _of_all(sums)}


def _of_all(sums: Mapping[str, str]) -> str:
    return checksum(canonical({name: value for name, value in sums.items() if name != "seal"}))


def _members(kept: Mapping[str, Any]) -> list[str]:
    results, coordinates = kept.get("results"), kept.get("coordinates")
    return [
        *([r for r in results if isinstance(r, str)] if isinstance(results, list) else []),
        *(coordinates if isinstance(coordinates, dict) else {}),
        DONE,
    ]


def _at(data: Any, *keys: str) -> dict[str, Any]:
    """The mapping at nested keys; an empty one if there is none."""
    for key in keys:
        data = data.get(key) if isinstance(data, dict) else None
    return data if isinstance(data, dict) else {}


def canonical(data: Any) -> bytes:
    """Plain data as bytes, which do not depend on the order of mappings."""
    return json.dumps(data, sort_keys=True, separators=(",", ":")).encode()


def checksum(data: bytes) -> str:
    """A checksum of 16 hexadecimal digits."""
    return hashlib.blake2b(data, digest_size=8).hexdigest()


def parsed(path: StorePlace) -> dict[str, Any] | None:
    """The root document of a Zarr group as plain data, or None if it is missing or cannot be read."""
    try:
        root = json.loads((path / ROOT).read_bytes())
    except (FileNotFoundError, NotADirectoryError, ValueError, RecursionError):
        return None
    return root if isinstance(root, dict) else None


def found(path: StorePlace) -> str:
    """A description of what is at a path that is not one of our stores."""
    if path.is_file():
        return "it is a file"
    if not path.is_dir():
        return "it is not a folder"
    names = sorted(entry.name for entry in path.iterdir())
    listed = ", ".join(names[:3]) + (", …" if len(names) > 3 else "")
    if not names:
        return "it is an empty folder"
    if ROOT not in names:
        return f"it is a folder without {ROOT} ({listed})"
    root = parsed(path)
    if root is None:
        return f"its {ROOT} cannot be read"
    if root.get("node_type") == "array":
        return "it is a Zarr array of another program"
    members = ", ".join(name for name in names if name != ROOT)[:60]
    return f"it is a Zarr group of another program ({members or 'empty'})"
