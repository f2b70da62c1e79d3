"""Puts a formula that is drawn over several lines on one line: fractions, powers, roots and tall brackets.

       2                ⎛     2  ⎞
      d           - g⋅m⋅⎝l + x   ⎠
    ⎯⎯⎯⎯⎯(x(t)) = ────────────────        d^2/dt^2(x(t)) = ((-g⋅m⋅(l+x^2))/(2))
       2                 2
     dt

A formula has a base line, on which its signs stand. What stands above and below a fraction bar belongs to the fraction;
what stands higher in a gap of the base line is the power of what ends there. Every sign of the drawing is used exactly
once: otherwise it cannot be read.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Sequence

from lagrangian.records import dataclass

BARS = frozenset("─━")
_OPENS = {"⎛": "(", "⎡": "[", "⎧": "{"}
_LEFT = {"⎛": "⎛⎜⎝", "⎡": "⎡⎢⎣", "⎧": "⎧⎨⎩⎪"}
_RIGHT = {"⎛": "⎞⎟⎠", "⎡": "⎤⎥⎦", "⎧": "⎫⎬⎭⎪"}
_FAMILY = {c: first for first, pieces in _LEFT.items() for c in pieces}
_CLOSED = {"(": ")", "[": "]", "{": "}"}
_DERIVES = re.compile(r"[d∂](?P<power>\^\(?2\)?)?[ ]?(?P<of>(?:[^\W\d]\w{0,23})?)\Z")
_BY_TIME = re.compile(r"[d∂]t(?P<power>\^2)?\Z")
TALL = "".join(_FAMILY)
"""The pieces of which tall brackets begin."""
DEEPEST = 30
"""The largest depth of fractions, powers and brackets in each other."""


class LayoutError(Exception):
    """The drawing cannot be put together."""


@dataclass(frozen=True, slots=True)
class _Box:
    """The rows from ``top`` and columns from ``left`` of a drawing, to ``bottom`` and ``right`` without these."""

    top: int
    bottom: int
    left: int
    right: int


def in_line(lines: Sequence[str], *, ascii_bars: bool = False, counted: bool = False) -> str:
    """Return a drawing on one line. Raises `LayoutError` if its signs do not fit together.

    ``ascii_bars``: two or more minus signs between a numerator and a denominator are a fraction bar; ``counted``: the
    columns were counted with the marks above letters.
    """
    layout = _Layout([with_marks_counted(x) for x in lines] if counted else lines, ascii_bars)
    whole = layout.bare(_Box(0, len(layout.rows), 0, layout.width))
    if whole is None:
        raise LayoutError
    written = layout.read(whole, layout.base(whole, 0), 0)
    if len(layout.used) != sum(c != " " for row in layout.rows for c in row):
        raise LayoutError
    return written


def cells(line: str) -> list[str]:
    """The columns of a line: letters with the marks above them."""
    found: list[str] = []
    for c in line:
        if found and unicodedata.combining(c):
            found[-1] += c
        else:
            found.append(" " if c.isspace() else c)
    return found


def with_marks_counted(line: str) -> str:
    """A line in which as many blanks stand behind a word as it has marks, so that what follows is where a program that
    counts them puts it."""
    made: list[str] = []
    owed = 0
    for c in line:
        owed += unicodedata.combining(c) != 0
        if c == " ":
            made.append(" " * owed)
            owed = 0
        made.append(c)
    return "".join(made)


class _Layout:
    """A drawing, and which of its places were read."""

    def __init__(self, lines: Sequence[str], ascii_bars: bool) -> None:
        rows = [cells(line) for line in lines]
        self.width = max(map(len, rows), default=0)
        self.rows = [row + [" "] * (self.width - len(row)) for row in rows]
        self.used: set[tuple[int, int]] = set()
        self.bars = frozenset("-") if ascii_bars else BARS

    def bare(self, box: _Box) -> _Box | None:
        """The part of a box that is not blank."""
        places = [
            (r, c) for r in range(box.top, box.bottom) for c in range(box.left, box.right) if self.rows[r][c] != " "
        ]
        if not places:
            return None
        rows, columns = [r for r, _ in places], [c for _, c in places]
        return _Box(min(rows), max(rows) + 1, min(columns), max(columns) + 1)

    def use(self, row: int, column: int) -> str:
        """Return the sign at a place, which is read now."""
        if (row, column) in self.used:
            raise LayoutError
        self.used.add((row, column))
        return self.rows[row][column]

    def bar(self, row: int, column: int, right: int) -> int:
        """Where a fraction bar ends that begins at a place; the same column if none does."""
        end = column
        while end < right and self.rows[row][end] in self.bars:
            end += 1
        if "-" in self.bars and (end - column < 2 or (column and self.rows[row][column - 1] == "-")):
            return column
        return end

    # -- the base line ------------------------------------------------------------------------------------------------

    def base(self, box: _Box, depth: int) -> int:
        """The base line of a box without blanks around it: the row of the sign that is farthest to the left."""
        if depth > DEEPEST:
            raise LayoutError
        rows = [r for r in range(box.top, box.bottom) if self.rows[r][box.left] != " "]
        signs = [self.rows[r][box.left] for r in rows]
        bars = sorted(((self.bar(r, box.left, box.right) - box.left, r) for r in rows), reverse=True)
        if bars[0][0]:
            if len(bars) > 1 and bars[1][0] == bars[0][0]:
                raise LayoutError
            return bars[0][1]
        if "╲" in signs and len(rows) == 1:
            _, inside = self.root(rows[0], box)
            return self.base(self.bare(inside) or inside, depth + 1)
        if all(x in _FAMILY for x in signs) and len(rows) > 1:
            inside = self.bracket(rows[0], box.left, box)
            if self.rows[rows[0]][box.left] == "⎡":
                behind = self.bare(_Box(box.top, box.bottom, inside.right + 1, box.right))
                return (rows[0] + rows[-1]) // 2 if behind is None else self.base(behind, depth + 1)
            bare = self.bare(inside)
            if bare is None:
                raise LayoutError
            return self.base(bare, depth + 1)
        if len(rows) != 1:
            raise LayoutError
        return rows[0]

    def root(self, row: int, box: _Box) -> tuple[list[tuple[int, int]], _Box]:
        """The places of a root whose foot is in the first column of a box, and what stands under it."""
        at, places = box.left + 1, [(row, box.left)]
        while row >= box.top and at < box.right and self.rows[row][at] == "╱":
            places.append((row, at))
            row, at = row - 1, at + 1
        end = at
        while row >= box.top and end < box.right and self.rows[row][end] == "_":
            places.append((row, end))
            end += 1
        if len(places) < 3 or end == at:
            raise LayoutError
        return places, _Box(row + 1, places[0][0] + 1, at, end)

    def bracket(self, row: int, column: int, box: _Box) -> _Box:
        """What stands between a tall bracket that has a piece at a place and the bracket that closes it."""
        first = _FAMILY[self.rows[row][column]]
        top = bottom = row
        while top > box.top and self.rows[top][column] != first:
            top -= 1
        while bottom + 1 < box.bottom and self.rows[bottom][column] != _LEFT[first][2]:
            bottom += 1
        ends = (first, _LEFT[first][2])
        closing = (_RIGHT[first][0], _RIGHT[first][2])
        depth = 0
        for at in range(column, box.right):
            pair = (self.rows[top][at], self.rows[bottom][at])
            depth += (pair == ends) - (pair == closing)
            if depth == 0:
                if at == column:
                    break
                return _Box(top, bottom + 1, column + 1, at)
        raise LayoutError

    # -- reading ------------------------------------------------------------------------------------------------------

    def read(self, box: _Box, base: int, depth: int) -> str:
        """What stands in a box, from left to right along its base line."""
        if depth > DEEPEST:
            raise LayoutError
        parts: list[str] = []
        at, ended = box.left, -1
        while at < box.right:
            foot = next((r for r in range(box.top, box.bottom) if self.rows[r][at] == "╲"), None)
            sign = self.rows[base][at]
            if (end := self.bar(base, at, box.right)) > at and self.is_fraction(base, at, end, box):
                parts.append(self.fraction(base, at, end, box, depth))
                at = ended = end
            elif foot is not None:
                places, inside = self.root(foot, _Box(box.top, box.bottom, at, box.right))
                for place in places:
                    self.use(*place)
                parts.append(f"sqrt({self.inner(inside, depth)})")
                at = ended = inside.right
            elif sign in _FAMILY:
                inside = self.bracket(base, at, box)
                parts.append(self.bracketed(at, inside, base, depth))
                at = ended = inside.right + 1
            elif sign == " " and self.bare(_Box(box.top, base, at, at + 1)) is not None:
                end = at
                while end < box.right and self.rows[base][end] == " ":
                    end += 1
                if at != ended:
                    raise LayoutError
                power = self.bare(_Box(box.top, base, at, end))
                assert power is not None
                behind = "".join(self.rows[base][power.right : box.right]).lstrip()
                parts.append(self.power(power, depth, apart=behind[:1].isalpha()))
                at = max(power.right, at + 1)
            else:
                parts.append(sign if sign == " " else self.use(base, at))
                at += 1
                ended = at if sign != " " else ended
        return "".join(parts)

    def inner(self, box: _Box, depth: int) -> str:
        """What stands in a box with blanks around it, on its own base line."""
        bare = self.bare(box)
        if bare is None:
            raise LayoutError
        return self.read(bare, self.base(bare, depth + 1), depth + 1)

    def power(self, box: _Box, depth: int, *, apart: bool) -> str:
        """A power with its sign; ``apart``: a name follows, which is no unit of it."""
        written = self.inner(box, depth)
        return f"^{written}" if written.isdigit() and not apart else f"^({written})"

    def is_fraction(self, base: int, at: int, end: int, box: _Box) -> bool:
        """Whether something stands above and below a bar; minus signs may be something else."""
        both = all(self.bare(_Box(a, b, at, end)) is not None for a, b in ((box.top, base), (base + 1, box.bottom)))
        if not both and "-" not in self.bars:
            raise LayoutError
        return both

    def fraction(self, base: int, at: int, end: int, box: _Box, depth: int) -> str:
        for column in range(at, end):
            self.use(base, column)
        above = self.inner(_Box(box.top, base, at, end), depth)
        below = self.inner(_Box(base + 1, box.bottom, at, end), depth)
        derives, by = _DERIVES.match(above), _BY_TIME.match(below)
        if by:
            if not derives or bool(derives["power"]) != bool(by["power"]):
                raise LayoutError
            power = by["power"] or ""
            return f" d{power}{derives['of']}/dt{power} "
        if "=" in above or "=" in below:
            raise LayoutError
        return f"(({above})/({below}))"

    def bracketed(self, at: int, inside: _Box, base: int, depth: int) -> str:
        """What stands between tall brackets, with brackets."""
        for row in range(inside.top, inside.bottom):
            self.use(row, at)
            self.use(row, inside.right)
        opening = _OPENS[self.rows[inside.top][at]]
        bare = self.bare(inside)
        if bare is None:
            raise LayoutError
        if opening == "[":
            return f"[{self.matrix(bare, depth)}]"
        return f"{opening}{self.read(bare, base, depth + 1)}{_CLOSED[opening]}"

    def matrix(self, box: _Box, depth: int) -> str:
        """The entries of a matrix: rows are apart by a blank line, columns by two blanks."""
        rows = _runs([self.bare(_Box(r, r + 1, box.left, box.right)) is None for r in range(box.top, box.bottom)], 1)
        columns = _runs([self.bare(_Box(box.top, box.bottom, c, c + 1)) is None for c in range(box.left, box.right)], 2)
        return "; ".join(
            ", ".join(self.inner(_Box(box.top + a, box.top + b, box.left + c, box.left + d), depth) for c, d in columns)
            for a, b in rows
        )


def _runs(blank: Sequence[bool], apart: int) -> list[tuple[int, int]]:
    """The runs of what is not blank, which ``apart`` or more blanks separate."""
    found: list[tuple[int, int]] = []
    for at, empty in enumerate(blank):
        if empty:
            continue
        if found and at - found[-1][1] < apart:
            found[-1] = (found[-1][0], at + 1)
        else:
            found.append((at, at + 1))
    return found
