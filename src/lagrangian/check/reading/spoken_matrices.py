"""Reads a matrix whose rows are listed, and words that say what it multiplies and what that gives.

Mass matrix, row by row: [a, b], [c, d]. It multiplies (x'', y'')^T, and the product equals (f, g)^T.
        [a, b; c, d] * [x''; y''] = [f; g]
M = [a, b], [c, d]          M = [a, b; c, d]
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import islice
from unicodedata import normalize

from lagrangian.check.reading.general_matrices import ACCELERATION
from lagrangian.check.reading.programs.session_lists import entries_in
from lagrangian.check.reading.programs.sessions import closes
from lagrangian.check.reading.traced_text import Edit, TracedText

MOST, MOST_ROWS, FAR = 20, 6, 160
"""The most lists of rows, rows of one, and characters of words between them and a column."""

_FIRST = re.compile(
    r"(?:(?P<name>(?<![\\w.])[A-Z]\w{0,3}(?:\([^()\n]{1,12}\))?[ \t]*=)|\brows?\b[^\[\]=\n]{0,40}:"
    r"|\bZeilen?\b[^\[\]=\n]{0,40}:"
    r"|\bmatrix\b[^\[\]=\n]{0,60}:)\s*(?=\[)",
    re.IGNORECASE,
)
"""What stands in front of rows: a name, or words."""
_NEXT = re.compile(r"\s*(?:[,;]|and|und)?\s*(?:(?:row[ ])?\d[.:)]\s*)?(?=\[)")
_WORDS = r"(?:[^\[\](){}=\n]|\n(?![ \t]*\n)|\((?=[^()]{0,20}[a-z]{3})[^()\n]{1,40}\)){0,160}?"
_MULTIPLIES = re.compile(
    rf"{_WORDS}\b(?:multipl(?:ies|ied[ ]by|ying)|times|acts?[ ]on|applied[ ]to|multipliziert(?:[ ]mit)?|mal"
    rf"|with[ ]the[ ]column|and[ ]the[ ]column)\b{_WORDS}(?=[(\[])",
    re.IGNORECASE,
)
_EQUALS = re.compile(
    rf"(?:\^T)?(?:{_WORDS}\b(?:equals?|equal[ ]to|gives?|yields?|is|makes|ergibt|gleich|ist)\b{_WORDS}|\s*=\s*)"
    r"(?=[(\[])",
    re.IGNORECASE,
)
_BEHIND = re.compile(r"(?:\^T)?[ \t]*[.;]?")


def with_spoken_matrices(written: TracedText) -> TracedText:
    """Return an answer in plain text in which such rows are one matrix, and the words an equation. There are as many
    rows as entries in each, and entries in the columns."""
    text = written.text
    return written.edited(_edits(text)) if "[" in text and "\\" not in text and "$" not in text else written


def _edits(text: str) -> Iterator[Edit]:
    at = 0
    for match in islice(_FIRST.finditer(text), MOST):
        rows, end = _rows(text, match.end())
        if match.start() < at or len(rows) < 2 or any(len(row) != len(rows) for row in rows):
            continue
        matrix = f"[{'; '.join(', '.join(row) for row in rows)}]"
        said = _product(text, end, len(rows)) if match["name"] is None else None
        if said is not None:
            (times, equal), at = said
            yield match.end(), at, f"\n{matrix} * [{'; '.join(times)}] = [{'; '.join(equal)}]\n"
        elif match["name"] is not None:
            at = end
            yield match.end(), end, matrix


def _rows(text: str, at: int) -> tuple[list[list[str]], int]:
    """The lists in square brackets that follow each other from a place on, and where the last one ends."""
    rows: list[list[str]] = []
    end = at
    while len(rows) < MOST_ROWS and text[at : at + 1] == "[" and (close := closes(text, at)) > 0:
        if ";" in text[at:close] or "=" in text[at:close]:
            break
        rows.append([text[a:b] for a, b in entries_in(text, at + 1, close)])
        end = close + 1
        following = _NEXT.match(text, end)
        at = following.end() if following is not None else len(text)
    return rows, end


def _product(text: str, at: int, size: int) -> tuple[tuple[list[str], list[str]], int] | None:
    """The columns that a matrix, which ends at a place, multiplies and gives, and where the last one ends."""
    found: list[list[str]] = []
    for form in (_MULTIPLIES, _EQUALS):
        words = form.match(text, at, at + 2 * FAR)
        close = closes(text, words.end()) if words is not None else -1
        entries = [text[a:b] for a, b in entries_in(text, words.end() + 1, close)] if words and close > 0 else []
        if len(entries) != size:
            return None
        found.append(entries)
        at = close + 1
    behind = _BEHIND.match(text, at)
    if not all(ACCELERATION.search(normalize("NFD", x)) for x in found[0]):
        return None
    return (found[0], found[1]), behind.end() if behind is not None else at
