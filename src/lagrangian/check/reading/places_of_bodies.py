"""Gives the coordinates that an answer lists by body under the same letters a name each:

box        u = x            n = 0                 box        u_box = x                    n_box = 0
eccentric  u = x + e cos φ  n = e sin φ           eccentric  u_eccentric = x + e cos φ    n_eccentric = e sin φ

Platform                                              Platform
  y = L sin α, ẏ = L α̇ cos α                            y_Platform = L sin α, ẏ_Platform = L α̇ cos α

The same letter for two bodies is a column of a table, or stands below two headings, and is no contradiction.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable

from lagrangian.check.reading.name_patterns import WORD_LETTER
from lagrangian.check.reading.prose.words import function_of
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
_HEADING = re.compile(
    r"[ \t]*+(?:#{1,6}[ ]|[-*•][ ]|\(?\d{1,2}[.)][ ]|\*\*)?(?P<label>[^\W\d_]{3,20}(?:[ ]\w{1,20}){0,4})"
    r"[ ]?(?:\([^()=\n]{0,60}\))?[ :.*]*+"
)
"""A line of words alone, in front of what is said of one body."""
_GIVEN = re.compile(rf"(?<![\w\\'’′^])(?P<name>{WORD_LETTER}{{1,2}})(?:²|\^2)?[ \t]*+=(?![=>])")
_GAP = re.compile(r"(?<=[^\s,;])[ ]{2}(?=[ ]*+[A-Za-z]{1,2}['’′]{0,2}[ \t]*+=(?![=>]))")
"""The space between two such formulas."""
_LATEX = re.compile(r"\\[A-Za-z(\[]|\$")
_WORD = re.compile(r"[^\W\d_]{3,20}")


@dataclass(frozen=True)
class _Row:
    """A row behind the name of a body, or below it: the word that names it, where the row and its formulas begin, and
    these."""

    body: str
    line: int
    start: int
    formulas: str
    below: bool = False

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
    rows, at, heading = list[_Row](), 0, ""
    for number, line in enumerate(lines):
        row = _row(number, at, line, model)
        if row is None and "=" not in line and line.strip():
            heading = _heading(line, model)
        elif row is None and heading and "=" in line:
            row = _Row(heading, number, at, line, below=True)
        rows += [row] if row is not None else []
        at += len(line) + 1
    labelled = {row.line for row in rows}
    rest = "\n".join(line for number, line in enumerate(lines) if number not in labelled and "=" in line)
    names = frozenset[str]().union(*(row.given for row in rows))
    edits = list[Edit]()
    for name in sorted(names):
        form = _form(name)
        bodies = {row.body for row in rows if name in row.given}
        using = {row.body for row in rows if form.search(row.formulas) is not None}
        if len(bodies) < 2 or using > bodies or taken(name) or function_of(name) is not None or form.search(rest):
            continue
        for row in rows:
            edits += [(row.start + m.end(), row.start + m.end(), f"_{row.body}") for m in form.finditer(row.formulas)]
    if edits:
        gaps = (row.start + m.start() for row in rows if not row.below for m in _GAP.finditer(row.formulas))
        edits += [(gap, gap + 1, ",") for gap in gaps]
    return written.edited(edits)


def _form(name: str) -> re.Pattern[str]:
    """A name, perhaps with one or two dots above it."""
    dotted = "|".join(re.escape(unicodedata.normalize("NFC", f"{name}{dot}")) for dot in "\u0307\u0308")
    return re.compile(rf"(?<![\w\\])(?:{dotted}|{re.escape(name)})(?![^\W²³]|[(\u0307\u0308])")


def _heading(line: str, model: Model) -> str:
    """The words of a heading that name a body, with its number; empty for another line."""
    found = _HEADING.fullmatch(line) if len(line) <= LONGEST else None
    said = re.findall(r"\w+", found["label"]) if found is not None else []
    words = {x.lower() for b in model.bodies for x in _WORD.findall(b.name)}
    named = [x for x in said if x.lower() in words]
    return "_".join([*named, *(x for x in said if x.isdigit())]) if named else ""


def _row(number: int, at: int, line: str, model: Model) -> _Row | None:
    """A line as a row behind the name of one body; None if it is none."""
    found = _ROW.match(line) if len(line) <= LONGEST else None
    if found is None:
        return None
    said = {x.lower() for x in _WORD.findall(found["label"])}
    words = {b.name: said & {x.lower() for x in _WORD.findall(b.name)} for b in model.bodies}
    named = [x for x in words.values() if x]
    return _Row(max(named[0], key=len), number, at + found.end(), line[found.end() :]) if len(named) == 1 else None
