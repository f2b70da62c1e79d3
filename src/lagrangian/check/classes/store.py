"""Verdicts kept in a file, so that an answer is judged once: a line of JSON for each, with its own checksum.

    {"sum": "<SHA-256 of the rest>", "key": "<SHA-256 of answer, model and options>", "record": {…}}

Lines are only appended. A line that was cut off or damaged is not used, and its answer is judged again.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any, TextIO

from lagrangian.errors import Error

KIND = "verdicts of lagrangian"
"""The first line of a store names its kind, so that no other file is taken for one."""

FORMAT = 1
"""Changes whenever the records do."""


@cache
def fingerprint() -> str:
    """The checksum of the program that judges, so that a newer one does not repeat the verdicts of an older."""
    total = hashlib.sha256()
    for file in sorted(Path(__file__).parent.parent.rglob("*.py")):
        total.update(file.read_bytes())
    return total.hexdigest()


def key_of(content: bytes, subject: str) -> str:
    """The key of an answer: its content, and ``subject``, the model and the options, must be equal."""
    total = hashlib.sha256()
    for part in (str(FORMAT).encode(), content, subject.encode()):
        total.update(len(part).to_bytes(8, "big") + part)
    return total.hexdigest()


class VerdictStore:
    """The records of answers by key, in a file to which new ones are appended; use it in a ``with`` block.

    ``damaged`` is the number of lines that cannot be used. Raises `Error` if the file is not a store, or if it cannot
    be read or written.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.damaged = 0
        self._records: dict[str, Mapping[str, Any]] = {}
        self._file: TextIO | None = None

    def __enter__(self) -> VerdictStore:
        try:
            text = self.path.read_text(encoding="utf-8", errors="replace") if self.path.exists() else ""
            self._read(text)
            self._file = self.path.open("a", encoding="utf-8", newline="\n")
            if not text:
                self._write(json.dumps({"kind": KIND, "format": FORMAT}))
            elif not text.endswith("\n"):  # a line that was cut off
                self._write("")
        except OSError as error:
            raise self._refused(error) from error
        return self

    def __exit__(self, *_: object) -> None:
        if self._file is not None:
            self._file.close()

    def _refused(self, error: OSError) -> Error:
        what = f"cannot keep verdicts in '{self.path}': {(error.strerror or str(error)).lower()}"
        return Error(what, fix="name a file that may be written", code="E801")

    def _read(self, text: str) -> None:
        if not text:
            return
        first, _, rest = text.partition("\n")
        if _loaded(first).get("kind") != KIND:
            what = f"'{self.path}' is not a file of verdicts"
            raise Error(what, fix="name another file, or one that does not exist yet", code="E803")
        for line in rest.splitlines():
            data = _loaded(line)
            if data and data.get("sum") == _sum(data):
                self._records[str(data["key"])] = data["record"]
            elif line.strip():
                self.damaged += 1

    def get(self, key: str) -> dict[str, Any] | None:
        """Return the record with a key, if there is one."""
        found = self._records.get(key)
        return dict(found) if found is not None else None

    def put(self, key: str, record: Mapping[str, Any]) -> None:
        """Append a record; it is in the file when this returns."""
        data: dict[str, Any] = {"key": key, "record": record}
        try:
            self._write(json.dumps({"sum": _sum(data), **data}, ensure_ascii=True))
        except OSError as error:
            raise self._refused(error) from error

    def _write(self, line: str) -> None:
        assert self._file is not None
        self._file.write(line + "\n")
        self._file.flush()


def _loaded(line: str) -> dict[str, Any]:
    try:
        data = json.loads(line)
    except ValueError:
        return {}
    return data if isinstance(data, dict) and (set(data) >= {"key", "record"} or "kind" in data) else {}


def _sum(data: Mapping[str, Any]) -> str:
    kept = json.dumps([data.get("key"), data.get("record")], ensure_ascii=True, sort_keys=True)
    return hashlib.sha256(kept.encode()).hexdigest()
