"""Reads tables whose last cells are added up, where a line below says what their sum is.

arm     | about its end      | ma l²/3
disc    | centre, on l       | md l²
        | turns twice        | 4 md r²/2 = 2 md r²
------------------------------------------
sum: I(φ)                                                     I(φ) = (ma l²/3) + (md l²) + (2 md r²)
"""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import islice

from lagrangian.check.reading.prose.words import function_of
from lagrangian.check.reading.traced_text import Edit, TracedText

_ROW = r"^[^\S\n]*+[^\n|│=:]{0,60}[|│][^\n]{1,400}$\n"
_TABLE = re.compile(
    rf"(?P<rows>(?:{_ROW}){{2,20}})(?:^[^\S\n]*+[-=─—–_+|│]{{3,200}}+[^\S\n]*+\n)?"
    r"(?P<last>^[^\S\n|│]*+(?:sum|total|summe|gesamt|somme|total[ ]inertia|[∑Σ])[^\S\n]*+[:=|│][^\S\n|│]*+"
    r"(?P<name>[^\W\d_]\w{0,15})(?P<of>\([^()\n=]{1,30}\))?[^\S\n|│]*+$)",
    re.MULTILINE | re.IGNORECASE,
)
_MOST = 6
"""The most such tables."""
_NAME = re.compile(r"[^\W\d_⁰-⁹²³][^\W⁰-⁹²³]{0,23}")
_WORD = re.compile(r"[A-Za-z]{3,}")


def with_summed_tables(written: TracedText, taken: Callable[[str], bool], told: dict[str, None]) -> TracedText:
    """Return an answer in plain text in which the sum of such a table is a statement; of a cell with several sides the
    last is added, which notes tell. ``taken`` says whether a name belongs to the system."""
    edits: list[Edit] = []
    for match in islice(_TABLE.finditer(written.text), _MOST):
        lines = match["rows"].rstrip("\n").split("\n")
        cells = [re.split(r"[|│]", line.strip().rstrip("|│")) for line in lines]
        values = [row[-1].strip() for row in cells]
        if taken(match["name"]) or len({*map(len, cells)}) > 1 or not all(_is_value(x, taken) for x in values):
            continue
        at = match.start("rows")
        for line, value in zip(lines, values, strict=True):
            edits.append((at, at + len(line), ""))
            at += len(line) + 1
            if "=" in value:
                told.setdefault(f"'{value}' was not judged: its last side was added to {match['name']}.")
        added = " + ".join(f"({x.rpartition('=')[2].strip()})" for x in values)
        edits.append((*match.span("last"), f"{match['name']}{match['of'] or ''} = {added}"))
    return written.edited(edits)


def _is_value(cell: str, taken: Callable[[str], bool]) -> bool:
    """Whether a cell holds a formula in names of the system, or a chain of such."""
    words = [x for x in _WORD.findall(cell) if function_of(x) is None and not taken(x)]
    names = [x for x in _NAME.findall(cell) if function_of(x) is None]
    return not words and any(map(taken, names)) and re.search(r"[:;,<>]", cell) is None
