"""Finds the place of every key and value in a TOML text.

`tomllib` returns values without places. This module reads the same text, after `tomllib` accepted it, and records for
each path (``("spring", 0, "k")``) where its key and its value begin. If it meets something unknown, it stops, and what
it has found remains.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import TypeAlias

from lagrangian.errors import Place
from lagrangian.quantities.source import Source, printable
from lagrangian.records import dataclass

Path: TypeAlias = tuple[str | int, ...]

_SPACE = re.compile(r"(?:[ \t\r\n]|#[^\n]*)*")
_INLINE_SPACE = re.compile(r"[ \t]*")
_BARE = re.compile(r"[A-Za-z0-9_-]+")
_STRING = re.compile(
    r'"""(?:[^\\]|\\[\s\S])*?"{3,5}' + r"|'''[\s\S]*?'{3,5}" + r'|"(?:[^"\\\n]|\\.)*"' + r"|'[^'\n]*'",
)
_SCALAR = re.compile(r"[^,\]}\n#]*")
_ESCAPE = re.compile(r"\\(?:u[0-9A-Fa-f]{4}|U[0-9A-Fa-f]{8}|.)")

_JOINED = re.compile(r"\\[ \t]*\n\s*")


@dataclass(frozen=True)
class Spot:
    """Offsets in the text: of the key (or of the header of a table), of the value and, for a string, of its content."""

    key: int
    value: int
    inside: tuple[int, int] | None = None


class _Lost(Exception):
    """Something unknown was met."""


class Index:
    """The places in one file. ``duplicates`` are keys that occur twice: (path, first offset, second offset)."""

    def __init__(self, text: str, file: str) -> None:
        self.text, self.file = text, file
        self.spots: dict[Path, Spot] = {}
        self.duplicates: list[tuple[Path, int, int]] = []
        self._lines = [0, *(m.end() for m in re.finditer("\n", text))]
        self._counts: dict[Path, int] = {}
        try:
            self._walk()
        except (_Lost, IndexError):
            self.complete = False
        else:
            self.complete = True

    # -- places -------------------------------------------------------------------------------------------------

    def place(self, offset: int) -> Place:
        """Return the place of an offset in the file."""
        offset = max(0, min(offset, len(self.text)))
        low, high = 0, len(self._lines)
        while high - low > 1:
            middle = (low + high) // 2
            low, high = (middle, high) if self._lines[middle] <= offset else (low, middle)
        start = self._lines[low]
        end = self.text.find("\n", start)
        line = self.text[start : end if end >= 0 else len(self.text)].rstrip("\r")
        return Place(self.file, low + 1, offset - start + 1, printable(line))

    def of_key(self, path: Path) -> Place:
        """Return the place of a key, or of the innermost surrounding table that is known."""
        return self.place(self._nearest(path).key)

    def of_value(self, path: Path) -> Place:
        """Return the place of a value, or of the innermost surrounding item that is known."""
        spot = self.spots.get(path)
        return self.of_key(path) if spot is None else self.place(spot.value)

    def offset(self, path: Path) -> int:
        """Return the offset of a key, for sorting in the order of the file."""
        return self._nearest(path).key

    def _nearest(self, path: Path) -> Spot:
        while path and path not in self.spots:
            path = path[:-1]
        return self.spots.get(path, Spot(0, 0))

    def source(self, path: Path, text: str, what: str) -> Source:
        """Return the text of a string value with the place of its first character."""
        spot = self.spots.get(path)
        if spot is None or spot.inside is None:
            return Source(text, what, self.of_value(path))
        start, end = spot.inside
        raw = self.text[start:end]
        if "\\" in raw and '"' in self.text[start - 2 : start]:
            offsets = _offsets(raw, start)
            return Source(text, what, self.place(start), lambda i: self.place(offsets[min(i, len(offsets) - 1)]))
        return Source(text, what, self.place(start), lambda i: self.place(start + i))

    # -- reading ------------------------------------------------------------------------------------------------

    def _walk(self) -> None:
        at, table = 0, ()
        text = self.text
        while (at := self._skip(_SPACE, at)) < len(text):
            if text.startswith("[[", at):
                keys, end = self._keys(self._skip(_INLINE_SPACE, at + 2))
                path = (*self._resolve([k for k, _ in keys[:-1]]), keys[-1][0])
                number = self._counts.get(path, 0)
                self._counts[path] = number + 1
                self.spots.setdefault(path, Spot(at, at))
                table = (*path, number)
                self.spots[table] = Spot(at, at)
                at = self._expect("]]", end)
            elif text[at] == "[":
                keys, end = self._keys(self._skip(_INLINE_SPACE, at + 1))
                table = self._resolve([k for k, _ in keys])
                self._note(table, Spot(keys[-1][1], at))
                at = self._expect("]", end)
            else:
                at = self._pair(table, at)

    def _resolve(self, keys: Sequence[str]) -> Path:
        """The path of a header, in which every array of tables has the number of its last element."""
        path: Path = ()
        for key in keys:
            path = (*path, key)
            if path in self._counts:
                path = (*path, self._counts[path] - 1)
        return path

    def _note(self, path: Path, spot: Spot) -> None:
        if path in self.spots and path:
            self.duplicates.append((path, self.spots[path].key, spot.key))
        else:
            self.spots[path] = spot

    def _skip(self, pattern: re.Pattern[str], at: int) -> int:
        match = pattern.match(self.text, at)
        return match.end() if match else at

    def _expect(self, what: str, at: int) -> int:
        at = self._skip(_INLINE_SPACE, at)
        if not self.text.startswith(what, at):
            raise _Lost
        return at + len(what)

    def _keys(self, at: int) -> tuple[list[tuple[str, int]], int]:
        keys: list[tuple[str, int]] = []
        while True:
            at = self._skip(_INLINE_SPACE, at)
            if self.text[at] in "\"'":
                match = _STRING.match(self.text, at)
                name = "" if match is None else _unescaped(match.group())
            else:
                match = _BARE.match(self.text, at)
                name = "" if match is None else match.group()
            if match is None:
                raise _Lost
            keys.append((name, at))
            at = self._skip(_INLINE_SPACE, match.end())
            if not self.text.startswith(".", at):
                return keys, at
            at += 1

    def _pair(self, table: Path, at: int) -> int:
        keys, end = self._keys(at)
        path = (*table, *(k for k, _ in keys))
        value = self._skip(_INLINE_SPACE, self._expect("=", end))
        for i in range(1, len(keys)):
            self.spots.setdefault((*table, *(k for k, _ in keys[:i])), Spot(keys[0][1], value))
        return self._value(path, keys[-1][1], value)

    def _value(self, path: Path, key: int, at: int) -> int:
        c = self.text[at]
        if c in "\"'":
            match = _STRING.match(self.text, at)
            if match is None:
                self._note(path, Spot(key, at))
                raise _Lost
            width = 3 if match.group()[:3] in ('"""', "'''") else 1
            start, end = at + width, match.end() - width
            if width == 3 and self.text[start] == "\n":
                start += 1
            self._note(path, Spot(key, at, (start, end)))
            return match.end()
        self._note(path, Spot(key, at))
        if c == "[":
            at, number = self._skip(_SPACE, at + 1), 0
            while self.text[at] != "]":
                at = self._skip(_SPACE, self._value((*path, number), at, at))
                number += 1
                if self.text[at] == ",":
                    at = self._skip(_SPACE, at + 1)
                elif self.text[at] != "]":
                    raise _Lost
            return at + 1
        if c == "{":
            at = self._skip(_SPACE, at + 1)
            while self.text[at] != "}":
                at = self._skip(_SPACE, self._pair(path, at))
                if self.text[at] == ",":
                    at = self._skip(_SPACE, at + 1)
                elif self.text[at] != "}":
                    raise _Lost
            return at + 1
        end = self._skip(_SCALAR, at)
        if end == at:
            raise _Lost
        return end


def _unescaped(quoted: str) -> str:
    inside = quoted[1:-1]
    if quoted[0] == "'" or "\\" not in inside:
        return inside
    return _ESCAPE.sub(lambda m: _character(m.group()), inside)


def _character(escape: str) -> str:
    if escape[1] in "uU":
        code = int(escape[2:], 16)
        return chr(code) if code < 0x110000 else "\ufffd"
    return {"b": "\b", "t": "\t", "n": "\n", "f": "\f", "r": "\r"}.get(escape[1], escape[1])


def _offsets(raw: str, start: int) -> list[int]:
    """The offset in the file of each character of a string with escapes, and of its end."""
    offsets: list[int] = []
    at = 0
    while at < len(raw):
        if (joined := _JOINED.match(raw, at)) is not None:  # a backslash at the end of a line removes the line break
            at = joined.end()
            continue
        offsets.append(start + at)
        match = _ESCAPE.match(raw, at)
        at = match.end() if match else at + 1
    return [*offsets, start + len(raw)]
