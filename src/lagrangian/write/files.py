"""Files that are written completely or not at all."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable
from pathlib import Path

from lagrangian.advice import Advice, Argument
from lagrangian.errors import Error


def write_file(path: str | os.PathLike[str], text: str | bytes) -> Path:
    """Write ``text`` as UTF-8, or bytes, to ``path`` and return the path; a device or pipe is written to directly.

    Raises the same errors as `write_with`.
    """
    given = Path(path)
    if given.exists() and not given.is_file() and not given.is_dir():
        return _into(given, _bytes(text))
    return write_with(path, lambda beside: beside.write_bytes(_bytes(text)))


def write_with(path: str | os.PathLike[str], fill: Callable[[Path], object]) -> Path:
    """Let ``fill`` write a temporary file next to ``path``, which then replaces ``path``; return the path.

    Readers see either the old file or the new one, and the old one survives a full disk. The permissions of an existing
    file are kept. Raises `Error` for a missing folder, a path that is not a file, missing permission, and a full disk.
    """
    target = _target(path)
    folder = target.parent
    if target.exists() and not target.is_file():
        raise Error(f"'{path}' is a device; only text can be written to it", fix="name a file", code="E801")
    beside: Path | None = None
    try:
        mode = target.stat().st_mode & 0o777 if target.exists() else 0o666 & ~_umask()
        handle, name = tempfile.mkstemp(dir=folder, prefix=f".{target.name[:100]}.", suffix=".part")
        os.close(handle)
        beside = Path(name)
        fill(beside)
        with beside.open("rb+") as file:
            os.fsync(file.fileno())
        beside.chmod(mode)
        beside.replace(target)
        beside = None
    except OSError as problem:
        reason = (problem.strerror or str(problem)).lower()
        raise Error(f"cannot write '{path}': {reason}", fix=_advice(problem), code="E801") from problem
    finally:
        if beside is not None:
            beside.unlink(missing_ok=True)
    return Path(path)


def check_free(path: str | os.PathLike[str], *, overwrite: bool) -> None:
    """Raise `Error`, before long work begins, if ``path`` cannot be written: it is a folder, or its folder does not
    exist.

    An existing file is an error, too, unless ``overwrite``.
    """
    if _target(path).is_file() and not overwrite:
        fix = Advice("choose another name, or replace it: ", Argument("overwrite", "True"))
        raise Error(f"'{path}' exists already", fix=fix, code="E802")


def _target(path: str | os.PathLike[str]) -> Path:
    """The file that a path refers to after links are followed; raises `Error` if there can be none."""
    target = Path(os.path.realpath(path))
    if target.is_dir():
        raise Error(f"'{path}' is a folder", fix="name a file in it", code="E801")
    if not target.parent.is_dir():
        what = f"cannot write '{path}': there is no folder '{target.parent}'"
        raise Error(what, fix="make the folder first", code="E801")
    return target


def _bytes(text: str | bytes) -> bytes:
    return text.encode("utf-8") if isinstance(text, str) else text


def _into(device: Path, content: bytes) -> Path:
    """Write directly to a device or a named pipe, which must never be replaced by a file."""
    try:
        with device.open("wb") as file:
            file.write(content)
    except OSError as problem:
        raise Error(f"cannot write '{device}': {(problem.strerror or str(problem)).lower()}", code="E801") from problem
    return device


def _umask() -> int:
    """The permission mask of new files; the only way to read it is to set it."""
    mask = os.umask(0o022)
    os.umask(mask)
    return mask


def _advice(problem: OSError) -> str | None:
    if isinstance(problem, PermissionError):
        return "choose a folder you may write to"
    return "the file that was there is unchanged"
