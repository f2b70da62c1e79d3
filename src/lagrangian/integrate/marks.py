"""The list of finished chunks of a store that is being written, which only one process at a time may change.

On a disk, the process holds a lock, and the mark of a chunk is written in its place. In object storage there are no
locks: a process writes its name beside the list when it begins, and looks whether it still stands there before every
mark. So a sweep whose process was killed can be resumed at once, and if its process is still alive, that one stops.
"""

from __future__ import annotations

import errno
import os
import uuid
from pathlib import Path
from typing import Protocol

from lagrangian.errors import Error
from lagrangian.integrate.checksums import DONE, Marks, StoreDocument
from lagrangian.integrate.places import ObjectPath, put
from lagrangian.integrate.stored import explained

WRITER = "writer"
"""The object beside the list in which the process that writes to the store has its name."""


class MarksFile(Protocol):
    """The list of finished chunks. ``data`` is what it contained when it was opened."""

    data: bytes

    def write(self, marks: Marks, index: int) -> None:
        """Write the marks of a chunk."""
        ...

    def whole(self, marks: Marks) -> None:
        """Write all marks, because the list had a wrong length."""
        ...

    def close(self) -> None:
        """Release the store."""
        ...


def marks_file(document: StoreDocument) -> MarksFile:
    """The list of finished chunks, taken by this process; raises `Error` if another one holds it."""
    file = document.marks_file
    return OnDisk(file) if isinstance(file, Path) else InObjects(file)


class OnDisk:
    """The list in a file."""

    def __init__(self, file: Path) -> None:
        self._file = alone(file)
        os.lseek(self._file, 0, os.SEEK_SET)
        self.data = os.read(self._file, os.fstat(self._file).st_size)

    def write(self, marks: Marks, index: int) -> None:
        """Write the marks of a chunk in their place."""
        os.lseek(self._file, index * marks[index].nbytes, os.SEEK_SET)
        os.write(self._file, marks[index].astype("<u8").tobytes())

    def whole(self, marks: Marks) -> None:
        """Cut the file; truncated parts are filled with zeros, which means "not done"."""
        os.ftruncate(self._file, marks.nbytes)

    def close(self) -> None:
        """Release the lock."""
        if self._file >= 0:
            os.close(self._file)
            self._file = -1


class InObjects:
    """The list as an object, which is written anew for every chunk."""

    def __init__(self, file: ObjectPath) -> None:
        self._writer, self._file, self._name = ObjectPath(file.url) / DONE / WRITER, file, uuid.uuid4().hex.encode()
        self._writer.write_bytes(self._name)
        self.data = file.read_bytes() if file.exists() else b""

    def write(self, marks: Marks, index: int) -> None:
        """Write all marks, if no other process has taken the store."""
        try:
            name = self._writer.read_bytes()
        except FileNotFoundError:
            name = b""
        if name != self._name:
            raise Error(
                f"another process is writing to '{self._file.url}'",
                fix="let it go on: what this one has finished stays there",
                code="E801",
            )
        put(self._file, marks.astype("<u8").tobytes())

    def whole(self, marks: Marks) -> None:
        """Write all marks."""
        self.write(marks, 0)

    def close(self) -> None:
        """Do nothing: the next process puts its own name here."""


def alone(marks: Path) -> int:
    """Lock the list of finished chunks for this process; the operating system releases it when the process ends."""
    path = marks.parents[2]
    with explained(path, "open"):
        marks.parent.mkdir(parents=True, exist_ok=True)
        file = os.open(marks, os.O_RDWR | os.O_CREAT | getattr(os, "O_BINARY", 0), 0o666)
    try:
        if os.name == "posix":
            import fcntl

            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        else:
            import msvcrt

            os.lseek(
                file, 1 << 30, os.SEEK_SET
            )  # far beyond the end of the file, because others cannot read what is locked
            msvcrt.locking(file, msvcrt.LK_NBLCK, 1)  # type: ignore[attr-defined]
    except OSError as trouble:
        os.close(file)
        if trouble.errno not in (errno.EWOULDBLOCK, errno.EACCES, errno.EAGAIN, errno.EDEADLK):
            reason = (trouble.strerror or str(trouble)).lower()
            raise Error(f"'{path}' cannot be locked: {reason}", fix="use a local disk", code="E801") from trouble
        raise Error(
            f"another process is writing to '{path}'", fix="wait for it, or use another name", code="E801"
        ) from None
    return file
