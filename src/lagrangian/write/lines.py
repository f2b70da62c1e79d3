"""Long formulas cut into lines for a page: LaTeX, Markdown and MathML share the cuts.

Widths are columns of the Unicode text, a fair measure of the set formula too.
"""

from __future__ import annotations

from dataclasses import dataclass

from lagrangian.write.glyphs import columns, token, unicode
from lagrangian.write.math import Grid, Letter, Math, Token, Value, break_lines, equality, tokens


@dataclass(frozen=True)
class Line:
    """A line of a formula: what stands left of the alignment, the equals sign or not, what follows, set in or not."""

    left: tuple[Token, ...]
    equals: bool
    right: tuple[Token, ...]
    indented: bool = False


def measure(piece: Token) -> int:
    """Columns of a token."""
    return columns(token(piece))


def chain(sides: tuple[Math, ...], width: int, *, aligned: bool = False) -> list[Line]:
    """Cut a chain of equalities: one line if it fits, else a line a side under the first equals sign.

    An ``aligned`` one has its equals sign at the alignment in any case, as one of several chains.
    """
    whole = equality(sides)
    if columns(unicode(whole)) <= width and not aligned:
        return [Line((), False, tuple(tokens(whole)))]
    first, *rest = sides
    left = tuple(tokens(first))
    span = columns(unicode(first))
    lines: list[Line] = []
    if rest and span <= width // 3:
        for i, side in enumerate(rest):
            for k, cut in enumerate(break_lines(list(tokens(side)), width - span - 3, measure)):
                lines.append(Line(left if i == k == 0 else (), k == 0, tuple(cut), k > 0))
        return lines
    for k, cut in enumerate(break_lines(list(left), width, measure)):
        lines.append(Line((), False, tuple(cut), k > 0))
    for side in rest:
        last = lines[-1].right
        if sum(measure(t) for t in (*last, *tokens(side))) + 6 <= width:
            lines[-1] = Line((), False, (*last, Token("sign", text="="), *tokens(side)), lines[-1].indented)
            continue
        for k, cut in enumerate(break_lines(list(tokens(side)), width - 3, measure)):
            lines.append(Line((), k == 0, tuple(cut), True))
    return lines


def lines(sides: tuple[Math, ...], width: int) -> list[Line]:
    """Cut any formula into lines, entry by entry where it is a matrix that is too wide."""
    parts = chains(sides, width)
    if len(parts) == 1 and any(isinstance(side, Grid) for side in sides):  # it fits, rows below each other
        return [Line((), False, tuple(tokens(equality(sides))))]
    return [line for part in parts for line in chain(part, width, aligned=len(parts) > 1)]


def chains(sides: tuple[Math, ...], width: int) -> list[tuple[Math, ...]]:
    """A matrix that is too wide becomes a chain for every entry; anything else stays one chain."""
    if not any(isinstance(side, Grid) and grid_columns(side) + 8 > width for side in sides):
        return [sides]
    made: list[tuple[Math, ...]] = []
    for side in sides[1:]:
        made += [(entry(sides[0], i), x) for i, x in entries(side)] if isinstance(side, Grid) else [(sides[0], side)]
    return made


def grid_columns(grid: Grid) -> int:
    """Columns that a matrix takes, its entries three apart."""
    if not grid.rows:
        return 2
    wide = [max(columns(unicode(row[j])) for row in grid.rows) for j in range(len(grid.rows[0]))]
    return sum(wide) + 3 * (len(wide) - 1) + 4


def entries(grid: Grid) -> list[tuple[str, Math]]:
    """The entries of a matrix with their indices: 12 for row 1, column 2; a column's with one index."""
    many = len(grid.rows) > 9 or any(len(row) > 9 for row in grid.rows)
    made: list[tuple[str, Math]] = []
    for i, row in enumerate(grid.rows, 1):
        for j, x in enumerate(row, 1):
            made.append((f"{i}{',' if many else ''}{j}" if len(row) > 1 else str(i), x))
    return made


def entry(name: Math, index: str) -> Math:
    """The name of a matrix with an entry's index."""
    if isinstance(name, Value):
        name = name.of
    if isinstance(name, Letter):
        return Letter(
            name.base, (*name.sub, *index.split(",")), name.dots, name.star, name.bold, name.literal, name.apart
        )
    return name
