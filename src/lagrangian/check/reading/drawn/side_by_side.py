"""Named matrices that are written beside each other over several lines.

M = [ m + n   n c ]     D = [ d     d b   ]       M = [m + n, n c; n c, J]
    [ n c     J   ]         [ d b   d b^2 ]       D = [d, d b; d b, d b^2]
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from lagrangian.check.reading.traced_text import Edit

_GROUP = r"\[[^\[\]=;\n]{1,200}\]"
_FIRST = re.compile(rf"[ \t]*+(?:[^\W\d]\w{{0,15}}[ \t]*+=[ \t]*+{_GROUP}[ \t,;]*+){{1,6}}")
_BELOW = re.compile(rf"[ \t]*+(?:{_GROUP}[ \t,;]*+){{1,6}}")
_NAMED = re.compile(rf"(?P<name>[^\W\d]\w{{0,15}})[ \t]*+=[ \t]*+(?P<row>{_GROUP})")
_ROW = re.compile(_GROUP)
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
        end = k + 1
        named = _NAMED.findall(lines[k]) if "[" in lines[k] and _FIRST.fullmatch(lines[k]) else []
        while named and end < len(lines) and end - k < MOST_ROWS and _is_below(lines[end], len(named)):
            end += 1
        if len(named) > 1 and end > k + 1:
            rows = [[row for _, row in named], *(_ROW.findall(x) for x in lines[k + 1 : end])]
            told = [_matrix(name, [row[j] for row in rows]) for j, (name, _) in enumerate(named)]
            if all(told):
                yield starts[k], starts[end] - 1, "\n".join(x for x in told if x)
        k = end


def _is_below(line: str, count: int) -> bool:
    return _BELOW.fullmatch(line) is not None and len(_ROW.findall(line)) == count


def _matrix(name: str, rows: Sequence[str]) -> str | None:
    """A matrix on one line; None if its rows have not the same number of entries."""
    entries = [_ENTRIES.split(row[1:-1].strip()) for row in rows]
    if len({len(x) for x in entries}) != 1:
        return None
    return f"{name} = [{'; '.join(', '.join(x) for x in entries)}]"
