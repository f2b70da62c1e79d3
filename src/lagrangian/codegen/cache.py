"""Object code kept on disk between runs.

One file an object: a magic line, the SHA-256 of what follows, then the object code. Files are written beside their
place and renamed into it, so that readers and other writers never see half a file; one that does not match its sum is
taken for absent and written again. A directory that cannot be used (read-only, somebody else's, full) means that
nothing is kept: compiling then takes its full time, and that is all.

The directory is ``LAGRANGIAN_CACHE_DIR`` (a relative one counts from the working directory), or the user's cache
directory; the empty text turns keeping off.
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
LIMIT = 256 * 2**20  # bytes kept in all; the least recently written go first
_room: dict[Path, int] = {}  # bytes this process may write to a directory before it looks again what is there


def directory() -> Path | None:
    """Where object code is kept, or None if keeping is turned off."""
    named = os.environ.get("LAGRANGIAN_CACHE_DIR")
    if named is not None:
        return Path(named).expanduser().absolute() if named else None
    return Path(platformdirs.user_cache_dir("lagrangian", appauthor=False)) / "objects"


def read(key: str) -> bytes | None:
    """The object code kept under ``key``, or None if there is none that is whole."""
    place = directory()
    if place is None or not _ours(place):
        return None
    try:
        content = (place / f"{key}.o").read_bytes()
    except OSError:  # not there, or not readable: both mean "compile it"
        return None
    code = content[len(MAGIC) + SUM :]
    whole = content.startswith(MAGIC) and content[len(MAGIC) : len(MAGIC) + SUM] == hashlib.sha256(code).digest()
    return code if whole else None


def write(key: str, code: bytes) -> bool:
    """Keep object code under ``key``; False if the directory cannot be used."""
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
    except OSError:  # the promise of this module: no cache, no complaint
        if beside is not None:
            with contextlib.suppress(OSError):
                Path(beside).unlink()
        return False
    _room[place] = _room.get(place, 0) - len(code)
    if _room[place] < 0:
        _room[place] = _trim(place)
    return True


def _ours(place: Path) -> bool:
    """Whether nobody else can put files there: code read from it is run."""
    if os.name != "posix":
        return place.is_dir()
    try:
        status = place.stat()
    except OSError:
        return False
    return status.st_uid == os.geteuid() and not status.st_mode & 0o022


def _trim(place: Path) -> int:
    """Remove the oldest files while all together exceed the limit; return after how many bytes to look again."""
    with contextlib.suppress(OSError):  # another process may be trimming too
        files = [(entry.stat(), entry) for entry in place.iterdir()]
        total = sum(status.st_size for status, _ in files)
        for status, entry in sorted(files, key=lambda pair: pair[0].st_mtime):
            if total <= LIMIT:
                return (LIMIT - total) // 8  # other processes write as well
            entry.unlink()
            total -= status.st_size
    return 0
