r"""Redraws formulas that a program drew with the signs of a keyboard alone, with the pieces that are made for it.

              2                          2
    /d       \      k*x        ⎛d       ⎞      k*x
    |--(x(t))|  = - ---        ⎜──(x(t))⎟  = - ───
    \dt      /       m         ⎝dt      ⎠       m

SymPy draws so without Unicode. Each sign is replaced by one sign, so that every place stays what it is.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from lagrangian.check.reading.drawn.layout import BARS
from lagrangian.check.reading.traced_text import Edit, TracedText

HIGHEST, WIDEST, LARGEST, TOTAL = 80, 4_000, 60_000, 1_000_000
"""The most lines, columns and places of a drawing, and places of all drawings of an answer."""

_TYPED = re.compile(r"[ \t]*(?:>>>|In ?\[|Out ?\[)|.*[^\x00-\x7f]")
"""A line that is no part of such a drawing: a prompt, or other letters."""
_RATE = re.compile(r"d ?[A-Za-z]?\w{0,20}\Z")
_ROUND = {"/": {"/": "⎛", "|": "⎜", "\\": "⎝"}, "\\": {"\\": "⎞", "|": "⎟", "/": "⎠"}}
_SQUARE = {"[": "⎡⎢⎣", "]": "⎤⎥⎦"}
_ARROW = "↪"
_Grid = list[list[str]]


def with_drawn_pieces(written: TracedText) -> TracedText:
    """Return an answer in which drawings with a derivative by the time have fraction bars, brackets and roots as in
    Unicode."""
    if "--" not in written.text or "dt" not in written.text:
        return written
    return written.edited(_redrawn(written.text))


def _redrawn(text: str) -> Iterator[Edit]:
    start, lines, at, left, cut = 0, list[str](), 0, TOTAL, False
    for line in [*text.split("\n"), ""]:
        if line.strip() and not _TYPED.match(line):
            start = start if lines else at
            lines.append(line)
        elif lines:
            size = len(lines) * max(map(len, lines))
            if 2 < len(lines) <= HIGHEST and size <= min(LARGEST, left) and max(map(len, lines)) <= WIDEST:
                left -= size
                goes_on = cut and all(line.startswith(">") for line in lines)
                made = _pieces(lines, goes_on=goes_on) if goes_on or _has_rate(lines) else lines
                yield start, at - 1, "\n".join(made)
                cut = made[0].rstrip().endswith(_ARROW)
            lines = []
        at += len(line) + 1


def _pieces(lines: Sequence[str], *, goes_on: bool) -> list[str]:
    """A drawing with the pieces of Unicode; ``goes_on``: it is the rest of one that is cut at the edge of a window."""
    width = max(map(len, lines))
    grid = [list(line.ljust(width).replace("\t", " ")) for line in lines]
    ends = [len(line.rstrip()) - 1 for line in lines]
    for row, end in zip(grid, ends, strict=True):
        row[0] = _ARROW if goes_on else row[0]
        if all(line.endswith(" >", 0, k + 1) for line, k in zip(lines, ends, strict=True)):
            row[end] = _ARROW
    _draw_roots(grid)
    for column in range(width):
        _draw_brackets(grid, column)
    _draw_bars(grid)
    return ["".join(row)[: len(line)] for row, line in zip(grid, lines, strict=True)]


def _has_rate(lines: Sequence[str]) -> bool:
    """Whether a bar has a d above and dt below, with a power or without."""
    for k in range(1, len(lines) - 1):
        for bar in re.finditer(r"-{2,}", lines[k]):
            span = slice(*bar.span())
            below = (lines[j][span].strip() for j in range(k + 1, min(k + 3, len(lines))))
            if _RATE.match(lines[k - 1][span].strip()) and any(x in ("dt", "dt2") for x in below):
                return True
    return False


def _draw_roots(grid: _Grid) -> None:
    r"""Roots: \/ at the foot, / upwards, _ above."""
    for foot in range(1, len(grid)):
        for column in range(len(grid[0]) - 1):
            if grid[foot][column] != "\\" or grid[foot][column + 1] != "/":
                continue
            row, at = foot, column + 1
            while row > 0 and at + 1 < len(grid[0]) and grid[row - 1][at + 1] == "/":
                row, at = row - 1, at + 1
            if row == 0 or at + 1 >= len(grid[0]) or grid[row - 1][at + 1] != "_":
                continue
            grid[foot][column] = "╲"
            for k in range(foot - row + 1):
                grid[foot - k][column + 1 + k] = "╱"


def _draw_brackets(grid: _Grid, column: int) -> None:
    """The tall brackets of a column: the round ones, and the square ones of a matrix."""
    row = 0
    while row < len(grid) - 1:
        sign = grid[row][column]
        end = row + 1
        if sign in _SQUARE:
            while end < len(grid) and grid[end][column] == sign:
                end += 1
            if end - row > 1:
                first, middle, last = _SQUARE[sign]
                for k in range(row, end):
                    grid[k][column] = first if k == row else last if k == end - 1 else middle
        elif sign in _ROUND:
            pieces = _ROUND[sign]
            closing = "\\" if sign == "/" else "/"
            while end < len(grid) and grid[end][column] == "|":
                end += 1
            if end < len(grid) and grid[end][column] == closing:
                end += 1
                for k in range(row, end):
                    grid[k][column] = pieces[grid[k][column]]
            else:
                end = row + 1
        row = end


def _draw_bars(grid: _Grid) -> None:
    """Fraction bars: minus signs with something right above and right below."""
    for k in range(1, len(grid) - 1):
        for bar in re.finditer(r"-{1,4000}", "".join(grid[k])):
            above, below = (set(grid[j][bar.start() : bar.end()]) - {" "} for j in (k - 1, k + 1))
            if bar.end() - bar.start() == 1 and (above | below) & (BARS | set("-_⎛⎜⎝⎞⎟⎠⎡⎢⎣⎤⎥⎦")):
                continue
            if above and below:
                grid[k][bar.start() : bar.end()] = "─" * (bar.end() - bar.start())
