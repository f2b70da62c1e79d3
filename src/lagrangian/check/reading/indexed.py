"""Writes statements with an index out: κ_i = k a²/(m_i l²) for i = 1, 2 is one for κ_1 and one for κ_2."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

from lagrangian.check.reading.plain.rows import AnswerRow

_INDEX = re.compile(r"_(?:\{(?P<braced>[ijkn])\}|(?P<bare>[ijkn])(?![A-Za-z0-9]))")
_NUMBERS = r"(?:=|\\in|∈)\s*\\?\{?\s*(?P<numbers>\d(?:[\s,\d]|\\[,;]|\\[lc]?dots|…|\.{3}){0,60})\\?\}?\s*\Z"
_COUNTED = re.compile(rf"\s*(?:for\s+|\\text\{{[^{{}}]{{0,9}}\}})?(?P<index>[ijkn])\s*{_NUMBERS}")
_BEHIND = re.compile(
    rf"(?<=\S)(?:\s*,)?\s+(?:for\s+|with\s+|where\s+|für\s+|mit\s+|pour\s+|[(])(?P<index>[ijkn])\s*{_NUMBERS}"
)
_STEM = re.compile(r"(?P<stem>\\?(?<![^\W\d_])[^\W\d_]+)_(?:\{(?:[ijkn])\}|[ijkn](?![A-Za-z0-9]))")

MOST = 9
"""The largest index."""


def without_indices(rows: Sequence[AnswerRow], known: Callable[[str], bool]) -> list[AnswerRow]:
    """Return the rows in which no letter is an index.

    The numbers are those that the answer says, i = 1, 2, or with which it uses a name: κ_1. ``known`` says whether a
    name belongs to the system.
    """
    said = [(row, _COUNTED.match(row.text) or _BEHIND.search(row.text)) for row in rows]
    counted = {m["index"]: m["numbers"] for _, m in said if m is not None}
    rows = [row if m is None or m.start() == 0 else replace(row, text=row.text[: m.start()]) for row, m in said]
    whole = "\n".join(row.text for row in rows)
    found: list[AnswerRow] = []
    expanded: set[str] = set()
    for row in rows:
        letters = {m["braced"] or m["bare"] for m in _INDEX.finditer(row.text)}
        numbers = list(_numbers(row.text, whole, counted)) if len(letters) == 1 and "=" in row.text else []
        named = any(known(m.group().replace("{", "").replace("}", "").lstrip("\\")) for m in _STEM.finditer(row.text))
        if not numbers or named:
            found.append(row)
            continue
        expanded |= letters
        found += [replace(row, text=_INDEX.sub(lambda m, n=n: _put(m, n), row.text)) for n in numbers]
    return [x for x in found if (m := _COUNTED.match(x.text)) is None or m["index"] not in expanded]


def counted_names(name: str, names: Sequence[str]) -> list[str]:
    """The names that have a number in the place of the index of another: kappa_1 for kappa_i."""
    stem = re.fullmatch(r"(.+)_[ijkn]", name)
    return [] if stem is None else [x for x in names if re.fullmatch(rf"{re.escape(stem[1])}_?\d", x)]


def _put(match: re.Match[str], number: str) -> str:
    letter = match["braced"] or match["bare"]
    return match.group().replace(letter, number)


def _numbers(text: str, whole: str, counted: dict[str, str]) -> Iterator[str]:
    """The numbers that the index of a statement takes: those that are said, or those with which its names are used."""
    letter = next(m["braced"] or m["bare"] for m in _INDEX.finditer(text))
    if letter in counted:
        listed = [int(x) for x in re.findall(r"\d", counted[letter])]
        whole_range = re.search(r"dots|…|\.{3}", counted[letter]) is not None and len(listed) > 1
        yield from map(str, range(listed[0], listed[-1] + 1) if whole_range else listed[:MOST])
        return
    stem = _STEM.match(text.strip())
    if stem is not None:
        used = re.findall(rf"(?<![A-Za-z]){re.escape(stem['stem'])}_?\{{?(\d)(?!\d)", whole)
        yield from sorted(set(used))[:MOST]
