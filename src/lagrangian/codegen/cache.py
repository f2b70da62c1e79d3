"""A cache of object code on disk.

There is one file per object: a magic line, the SHA-256 of the rest, and the object code. A file is written under a
temporary name and then renamed, so that nobody sees an incomplete file; one whose checksum is wrong is ignored and
written again. If the directory cannot be used (read-only, owned by somebody else, full), nothing is cached: compiling
then always takes its full time.

The directory is ``LAGRANGIAN_CACHE_DIR`` (a relative path starts at the working directory), or the user's cache
directory; an empty value turns the cache off.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import tempfile
from pathlib import Path

import platformdirs

MAGIC = b"lagrangian object 1\n"
SUM = 32  # bytes of a SHA-256
LIMIT = 256 * 2**20  # limit on the total number of bytes; the files written least recently are removed first
_room: dict[Path, int] = {}  # bytes that this process may write before it checks the total size again


def directory() -> Path | None:
    """The directory of the cache, or None if it is turned off."""
    named = os.environ.get("LAGRANGIAN_CACHE_DIR")
    if named is not None:
        return Path(named).expanduser().absolute() if named else None
    return Path(platformdirs.user_cache_dir("lagrangian", appauthor=False)) / "objects"


def read(key: str) -> bytes | None:
    """The object code stored under ``key``, or None if there is no complete one."""
    place = directory()
    if place is None or not _ours(place):
        return None
    try:
        content = (place / f"{key}.o").read_bytes()
    except OSError:  # missing or unreadable: in both cases it is compiled
        return None
    code = content[len(MAGIC) + SUM :]
    whole = content.startswith(MAGIC) and content[len(MAGIC) : len(MAGIC) + SUM] == hashlib.sha256(code).digest()
    return code if whole else None


def write(key: str, code: bytes) -> bool:
    """Store object code under ``key``; return False if the directory cannot be used."""
    place = directory()
    if place is None:
        return False
    beside = None
    try:
        place.mkdir(mode=0o700, parents=True, exist_ok=True)
        if not _ours(place):
            return False
        handle, beside = tempfile.mkstemp(dir=place, suffix=".part")
        with os.fdopen(handle, "wb") as file:
            file.write(MAGIC + hashlib.sha256(code).digest() + code)
        Path(beside).replace(place / f"{key}.o")
    except OSError:  # without a usable cache everything still works
        if beside is not None:
            with contextlib.suppress(OSError):
                Path(beside).unlink()
        return False
    _room[place] = _room.get(place, 0) - len(code)
    if _room[place] < 0:
        _room[place] = _trim(place)
    return True


def _ours(place: Path) -> bool:
    """Whether nobody else can write files there, because code from it is executed."""
    if os.name != "posix":
        return place.is_dir()
    try:
        status = place.stat()
    except OSError:
        return False
    return status.st_uid == os.geteuid() and not status.st_mode & 0o022


def _trim(place: Path) -> int:
    """Remove the oldest files while the total exceeds the limit; return how many bytes may be written before the next
    check."""
    with contextlib.suppress(OSError):  # another process may be trimming as well
        files = [(entry.stat(), entry) for entry in place.iterdir()]
        total = sum(status.st_size for status, _ in files)
        for status, entry in sorted(files, key=lambda pair: pair[0].st_mtime):
            if total <= LIMIT:
                return (LIMIT - total) // 8  # other processes write as well
            entry.unlink()
            total -= status.st_size
    return 0
