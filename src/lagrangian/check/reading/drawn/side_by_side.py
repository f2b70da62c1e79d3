"""Named matrices that are written beside each other over several lines.

M = [ m + n   n c ]     D = [ d     d b   ]       M = [m + n, n c; n c, J]
    [ n c     J   ]         [ d b   d b^2 ]       D = [d, d b; d b, d b^2]

The names may stand on any line, each on one.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from lagrangian.check.reading.traced_text import Edit

_GROUP = r"\[[^\[\]=;\n]{1,200}\]"
_LINE = re.compile(rf"[ \t]*+(?:(?:[^\W\d]\w{{0,15}}[ \t]*+=[ \t]*+)?{_GROUP}[ \t,;]*+){{1,6}}")
_ITEM = re.compile(rf"(?:(?P<name>[^\W\d]\w{{0,15}})[ \t]*+=[ \t]*+)?(?P<row>{_GROUP})")
_ENTRIES = re.compile(r"[ \t]{2,}|[ \t]*,[ \t]*")
MOST_ROWS = 6


def side_by_side(text: str) -> Iterator[Edit]:
    """Statements of one matrix each in place of lines with the rows of several."""
    lines = text.split("\n")
    starts = [0]
    for line in lines:
        starts.append(starts[-1] + len(line) + 1)
    k = 0
    while k < len(lines):
        first, end = _items(lines[k]), k + 1
        rows = [first]
        while first and end < len(lines) and len(rows) < MOST_ROWS and _is_below(rows, below := _items(lines[end])):
            rows.append(below)
            end += 1
        named = ["".join(row[j][0] for row in rows) for j in range(len(first))]
        if len(named) > 1 and len(rows) > 1 and all(named):
            told = [_matrix(name, [row[j][1] for row in rows]) for j, name in enumerate(named)]
            if all(told):
                yield starts[k], starts[end] - 1, "\n".join(x for x in told if x)
        k = end


def _items(line: str) -> list[tuple[str, str]]:
    """The rows of matrices on a line that consists of these, each with the name in front of it."""
    return _ITEM.findall(line) if "[" in line and _LINE.fullmatch(line) else []


def _is_below(above: Sequence[Sequence[tuple[str, str]]], row: Sequence[tuple[str, str]]) -> bool:
    """Whether rows of the same matrices stand on a line: each of them is named once."""
    if len(row) != len(above[0]):
        return False
    return not any(name and any(x[j][0] for x in above) for j, (name, _) in enumerate(row))


def _matrix(name: str, rows: Sequence[str]) -> str | None:
    """A matrix on one line; None if its rows have not the same number of entries."""
    entries = [_ENTRIES.split(row[1:-1].strip()) for row in rows]
    if len({len(x) for x in entries}) != 1:
        return None
    return f"{name} = [{'; '.join(', '.join(x) for x in entries)}]"
