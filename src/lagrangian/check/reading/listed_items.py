"""Lists of words and formulas of which some items cannot be read: winch F, drag -b s', rho^2 = s^2 + d^2.

The definitions of new names in such a list are read. The others are no equations of motion, so that they do not decide:
a note says that they were not read.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from lagrangian.check.reading.plain.spans import CONDITIONS
from lagrangian.check.reading.prose.remarks import is_remark
from lagrangian.check.reading.prose.words import Words, function_of
from lagrangian.check.reading.prose.words_or_mathematics import ADDING
from lagrangian.records import dataclass

MOST = 20
"""The largest number of items of a list."""
LONGEST = 1_000
"""The most characters of such a list."""

_MARK = re.compile(r"[()\[\]{}]|[,;](?=\s|$)")
_NAME = r"[^\W\d_²³]\w{0,15}"
_DEFINED = re.compile(
    rf"(?:^|(?<=[:\s]))[ \t]*(?P<name>{_NAME})[ \t]*(?:\^[ \t]?2|²)?[ \t]*=(?![=>])(?P<value>[^=]+)\Z"
)
"""A name, perhaps with words in front of it, and its only value, to the end of an item."""
_FIRST = re.compile(r"[ \t]*(?P<word>[^\W\d_]{2,24})(?![\w(])")
_ALONE = re.compile(r"\s*\w{1,24}\s*")
_VARIED = re.compile(r"(?<!\w)(?:δ|delta[ \t_]?)[^\W\d_]")
_WORDS = re.compile(r"[^\W\d_]{2,24}")
_BLANK = " " * 4
_PLACES = frozenset(["for", "at", "für", "bei", "pour"])
"""Words of conditions that often only say of what something is: bob at the end."""
_CASES = (CONDITIONS - _PLACES) | {"small", "klein", "kleine", "petits"}


@dataclass(frozen=True, slots=True)
class ListedItem:
    """An item of a list, from ``start`` to ``end`` of the row, and whether it is the definition of a new name."""

    start: int
    end: int
    text: str
    defines: bool


def listed_items(row: str, words: Words, known: Callable[[str], bool]) -> list[ListedItem]:
    """Return the items of a row that cannot be read as a whole; none if it is no list, or if one of its items may be an
    equation of motion, go on with what stands before it or say in which case this holds.

    ``known``: whether a name already has a meaning.
    """
    pieces = _pieces(row)
    if not 2 <= len(pieces) <= MOST or len(row) > LONGEST:
        return []
    if holds_in_a_case(row) or not ADDING.isdisjoint(_spoken(row)):
        return []
    items = [ListedItem(a, b, row[a:b], _is_definition(row[a:b], known)) for a, b in pieces]
    told = [x for x in items if "=" not in x.text]
    if not told or not any(_says(x.text, words) for x in told):
        return []
    for k, item in enumerate(items):
        equated = "=" in item.text and not item.defines
        if equated and not (is_remark(item.text) and _PLACES.isdisjoint(_spoken(item.text))):
            return []
        if item.defines and (item.text.endswith(_BLANK) or _is_entry(items[:k], words)):
            return []  # rho = d for x = 0, of which the case was taken off; x, y, v, w = state
        after = items[k + 1] if k + 1 < len(items) else None
        if item.defines and after is not None and "=" not in after.text and not _says(after.text, words):
            return []  # rho = 1, 5 d
    return items


def holds_in_a_case(text: str) -> bool:
    """Whether words say that a text holds only in a case."""
    return not _CASES.isdisjoint(_spoken(text))


def _pieces(row: str) -> list[tuple[int, int]]:
    """Where the parts between commas and semicolons outside brackets begin and end."""
    found: list[tuple[int, int]] = []
    start = depth = 0
    for match in _MARK.finditer(row):
        if match.group() in "([{":
            depth += 1
        elif match.group() in ")]}":
            depth -= 1
        elif depth == 0:
            found.append((start, match.start()))
            start = match.end()
    found.append((start, len(row)))
    return [(a, b) for a, b in found if row[a:b].strip(" \t\n.")]


def _is_entry(before: Sequence[ListedItem], words: Words) -> bool:
    """Whether what stands in front of an item are names that are given values together: phi, om, th = state."""
    alone = [_ALONE.fullmatch(x.text) is not None for x in before[-2:]]
    return alone == [True, True] or (alone[-1:] == [True] and not _says(before[-1].text, words))


def _is_definition(item: str, known: Callable[[str], bool]) -> bool:
    """Whether an item is a new name and its value, perhaps behind words, and no virtual displacement."""
    match = _DEFINED.search(item)
    if match is None or item.count("=") != 1 or known(match["name"]) or _VARIED.search(item):
        return False
    return function_of(match["name"]) is None and match["name"] not in ("δ", "Δ")


def _spoken(text: str) -> set[str]:
    """The words of a text, in small letters."""
    return {x.lower() for x in _WORDS.findall(text)}


def _says(item: str, words: Words) -> bool:
    """Whether an item begins with a word that is no name and no product of names."""
    match = _FIRST.match(item)
    return match is not None and not words.readable(match["word"]) and function_of(match["word"]) is None
