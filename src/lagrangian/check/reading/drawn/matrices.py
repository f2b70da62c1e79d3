"""Matrices drawn over several lines with tall brackets, with what stands beside them on any of these lines.

    ⎡ M+m        m l cos θ ⎤
M = ⎢                      ⎥ ,          M = [M+m, m l cos θ; m l cos θ, J + m l²],
    ⎣ m l cos θ  J + m l²  ⎦
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from lagrangian.check.reading.latex.tokens import SYMMETRIC
from lagrangian.check.reading.traced_text import Edit, TracedText

_GROUP = re.compile(r"[⎡⎢⎣](?P<row>[^⎡-⎦\n]{0,400})[⎤⎥⎦]")
_COLUMNS = re.compile(r"[ \t]{2,}|\t|[ \t]*,[ \t]*")
_NAME = re.compile(r"[ ,;]*+[^\W\d]\w{0,15}[ \t]*+=")
"""The name of another matrix."""
MOST = 200
"""The largest number of lines of drawn matrices."""


def without_drawings(written: TracedText) -> TracedText:
    """Return an answer in plain text with matrices between tall brackets on one line each."""
    if "⎡" not in written.text or "⎣" not in written.text:
        return written
    return written.edited(_drawn(written.text))


def _drawn(text: str) -> Iterator[Edit]:
    block: list[str] = []
    start = at = 0
    for line in [*text.split("\n")[: 20 * MOST], ""]:
        groups = list(_GROUP.finditer(line))
        opens = bool(groups) and "⎡" in line
        if groups and (block or opens):
            start = start if block else at
            block.append(line)
            if "⎣" in line and (made := _made(block)) is not None:
                yield start, at + len(line), made
                block = []
        else:
            block = []
        at += len(line) + 1


def _made(block: Sequence[str]) -> str | None:
    """The matrices of a block and what stands between them; None if its lines do not fit together."""
    found = [list(_GROUP.finditer(line)) for line in block]
    count = len(found[0])
    if any(len(x) != count for x in found):
        return None
    parts: list[str] = []
    for k in range(count + 1):
        beside = [_between(line, groups, k).strip() for line, groups in zip(block, found, strict=True)]
        told = [x for x in beside if x]
        if len(told) > 1:
            return None
        parts.append(f"; {told[0].lstrip(' ,;')}" if told and k and _NAME.match(told[0]) else told[0] if told else "")
        if k < count:
            rows = _whole([_COLUMNS.split(groups[k]["row"].strip()) for groups in found if groups[k]["row"].strip()])
            if len({len(row) for row in rows}) != 1:
                return None
            entries = "; ".join(", ".join(row) for row in rows)
            parts.append(f"[{entries.replace('sym.', SYMMETRIC)}]")
    return " ".join(parts)


def _whole(rows: list[list[str]]) -> list[list[str]]:
    """The rows of a matrix; of a symmetric one all, where those from the diagonal on are drawn, and a mark."""
    given = [[x for x in row if x != "sym."] for row in rows]
    if rows == given or any(len(row) != len(rows) - i for i, row in enumerate(given)):
        return rows
    return [[*(given[j][i - j] for j in range(i)), *row] for i, row in enumerate(given)]


def _between(line: str, groups: Sequence[re.Match[str]], k: int) -> str:
    """What stands in front of bracket k of a line, or behind the last."""
    start = groups[k - 1].end() if k else 0
    return line[start : groups[k].start() if k < len(groups) else len(line)]
