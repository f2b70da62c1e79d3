"""Gives the coordinates that an answer lists by body under the same letters a name each:

box        u = x            n = 0                 box        u_box = x                    n_box = 0
eccentric  u = x + e cos φ  n = e sin φ           eccentric  u_eccentric = x + e cos φ    n_eccentric = e sin φ

The same letter for two bodies is a column of a table, and no contradiction.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from lagrangian.check.reading.traced_text import Edit, TracedText
from lagrangian.model import Model
from lagrangian.records import dataclass

LONGEST, MOST_LINES = 300, 200
"""The most characters of a row, and the most lines of an answer."""
_ROW = re.compile(
    r"[ \t]*+(?:[-*•+–][ \t]++)?(?P<label>[^\W\d_]{3,20}(?:[ ][^\W\d_]{1,20}){0,2})"
    r"(?:[ \t]?:[ \t]++|[ ]{2}[ \t]*+|\t++)"
    r"(?=[A-Za-z]{1,2}['’′]{0,2}[ \t]*+=(?![=>]))"
)
_GIVEN = re.compile(r"(?<![\w\\'’′^])(?P<name>[A-Za-z]{1,2})[ \t]*+=(?![=>])")
_GAP = re.compile(r"(?<=[^\s,;])[ ]{2}(?=[ ]*+[A-Za-z]{1,2}['’′]{0,2}[ \t]*+=(?![=>]))")
"""The space between two such formulas."""
_LATEX = re.compile(r"\\[A-Za-z(\[]|\$")
_WORD = re.compile(r"[^\W\d_]{3,20}")


@dataclass(frozen=True)
class _Row:
    """A row behind the name of a body: the word that names it, where the row and its formulas begin, and these."""

    body: str
    line: int
    start: int
    formulas: str

    @property
    def given(self) -> frozenset[str]:
        """The letters that it gives values."""
        return frozenset(m["name"] for m in _GIVEN.finditer(self.formulas))


def with_places_of_bodies(written: TracedText, model: Model, taken: Callable[[str], bool]) -> TracedText:
    """Return an answer in which such letters have the name of their body as an index.

    Each is given a value behind the names of two bodies, is no name of the system, which ``taken`` tells, and stands
    in no other line with an equals sign.
    """
    lines = written.text.split("\n")
    if len(lines) > MOST_LINES or _LATEX.search(written.text) is not None:
        return written
    rows, at = list[_Row](), 0
    for number, line in enumerate(lines):
        rows += [row] if (row := _row(number, at, line, model)) is not None else []
        at += len(line) + 1
    labelled = {row.line for row in rows}
    rest = "\n".join(line for number, line in enumerate(lines) if number not in labelled and "=" in line)
    names = frozenset[str]().union(*(row.given for row in rows))
    edits = list[Edit]()
    for name in sorted(names):
        form = re.compile(rf"(?<![\w\\]){name}(?![\w(])")
        bodies = {row.body for row in rows if name in row.given}
        if len(bodies) < 2 or taken(name) or form.search(rest) is not None:
            continue
        for row in rows:
            edits += [(row.start + m.end(), row.start + m.end(), f"_{row.body}") for m in form.finditer(row.formulas)]
    if edits:
        edits += [
            (row.start + m.start(), row.start + m.start() + 1, ",") for row in rows for m in _GAP.finditer(row.formulas)
        ]
    return written.edited(edits)


def _row(number: int, at: int, line: str, model: Model) -> _Row | None:
    """A line as a row behind the name of one body; None if it is none."""
    found = _ROW.match(line) if len(line) <= LONGEST else None
    if found is None:
        return None
    said = {x.lower() for x in _WORD.findall(found["label"])}
    words = {b.name: said & {x.lower() for x in _WORD.findall(b.name)} for b in model.bodies}
    named = [x for x in words.values() if x]
    return _Row(max(named[0], key=len), number, at + found.end(), line[found.end() :]) if len(named) == 1 else None
