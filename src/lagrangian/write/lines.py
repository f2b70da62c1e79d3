"""Breaks long formulas into lines for a page; LaTeX, Markdown and MathML use the same breaks.

Widths are counted in columns of the Unicode text, which is also a good measure of the typeset formula.
"""

from __future__ import annotations

from lagrangian.records import dataclass
from lagrangian.write.breaking import BrokenRow, break_lines
from lagrangian.write.expression_tree import (
    Glyph,
    Grid,
    Letter,
    Math,
    Number,
    Numeral,
    Quotient,
    Radical,
    Word,
    equality,
    tokens,
)
from lagrangian.write.unicode_math import columns, token, unicode


@dataclass(frozen=True)
class Line:
    """A line of a formula: the part left of the alignment, whether an equals sign follows, the rest, and the
    indentation."""

    left: tuple[Glyph, ...]
    equals: bool
    right: tuple[Glyph, ...]
    steps: int = 0


def measure(piece: Glyph) -> int:
    """The width of a token in a line of text."""
    return columns(token(piece))


def set_columns(piece: Glyph) -> int:
    """The width of a token where fractions are typeset, with the numerator over the denominator."""
    match piece.math:
        case Quotient(over, under) if piece.role == "leaf":
            return max(_set(over), _set(under))
        case Radical(of) if piece.role == "leaf":
            return 1 + _set(of)
        case _:
            return measure(piece)


def _set(math: Math) -> int:
    return sum(set_columns(t) for t in tokens(math))


def chain(sides: tuple[Math, ...], width: int, *, aligned: bool = False) -> list[Line]:
    """Break a chain of equalities: one line if it fits, otherwise a line per side, aligned at the first equals sign.

    If it is ``aligned``, its equals sign is at the alignment in any case, as for one of several chains.
    """
    first, *rest = sides
    if sum(_set(side) + 3 for side in sides) - 3 <= width:
        if aligned and rest:
            return [Line(tuple(tokens(first)), True, tuple(tokens(equality(tuple(rest)))))]
        return [Line((), False, tuple(tokens(equality(sides))))]
    left = tuple(tokens(first))
    span = _set(first)
    lines: list[Line] = []
    if rest and span <= width // 3:
        for i, side in enumerate(rest):
            for k, row in enumerate(_rows(side, width - span - 3)):
                lines.append(Line(left if i == k == 0 else (), k == 0, tuple(row.tokens), row.depth + (k > 0)))
        return lines
    for k, row in enumerate(_rows(first, width)):
        lines.append(Line((), False, tuple(row.tokens), row.depth + (k > 0)))
    for side in rest:
        last = lines[-1].right
        if sum(set_columns(t) for t in (*last, *tokens(side))) + 6 <= width:
            lines[-1] = Line((), False, (*last, Glyph("sign", text="="), *tokens(side)), lines[-1].steps)
            continue
        for k, row in enumerate(_rows(side, width - 3)):
            lines.append(Line((), k == 0, tuple(row.tokens), 1 + row.depth + (k > 0)))
    return lines


def _rows(side: Math, width: int) -> list[BrokenRow]:
    return break_lines(list(tokens(side)), width, set_columns, flat=False)


def lines(sides: tuple[Math, ...], width: int) -> list[Line]:
    """Break any formula into lines; a matrix that is too wide is written entry by entry."""
    parts = chains(sides, width)
    if len(parts) == 1 and any(
        isinstance(side, Grid) for side in sides
    ):  # it fits when its rows are placed below each other
        return [Line((), False, tuple(tokens(equality(sides))))]
    return [line for part in parts for line in chain(part, width, aligned=len(parts) > 1)]


def chains(sides: tuple[Math, ...], width: int) -> list[tuple[Math, ...]]:
    """A chain for every entry of a matrix that is too wide; anything else remains one chain."""
    if not any(isinstance(side, Grid) and grid_columns(side) + 8 > width for side in sides):
        return [sides]
    made: list[tuple[Math, ...]] = []
    for side in sides[1:]:
        if not isinstance(side, Grid):
            made.append((sides[0], side))
            continue
        listed = entries(side)
        zero = Number("0")
        rest = sum(x == zero for _, x in listed) > 2
        made += [(*(entry(sides[0], i) for i in at), x) for at, x in listed if not rest or x != zero]
        made += [(Word("all other entries are 0"),)] if rest else []
    return made


def grid_columns(grid: Grid) -> int:
    """The width of a matrix whose entries are three columns apart."""
    if not grid.rows:
        return 2
    wide = [max(columns(unicode(row[j])) for row in grid.rows) for j in range(len(grid.rows[0]))]
    return sum(wide) + 3 * (len(wide) - 1) + 4


def entries(grid: Grid) -> list[tuple[tuple[str, ...], Math]]:
    """The entries of a matrix with their indices: 12 for row 1, column 2; a column has one index.

    Two equal entries of a symmetric matrix are listed once, with both indices: 12 and 21.
    """
    comma = "," if len(grid.rows) > 9 or any(len(row) > 9 for row in grid.rows) else ""
    made: list[tuple[tuple[str, ...], Math]] = []
    for i, row in enumerate(grid.rows, 1):
        for j, x in enumerate(row, 1):
            at = (f"{i}{comma}{j}",) if len(row) > 1 else (str(i),)
            if grid.symmetric and i < j:
                at += (f"{j}{comma}{i}",)
            if not (grid.symmetric and i > j):
                made.append((at, x))
    return made


def entry(name: Math, index: str) -> Math:
    """The name of a matrix with the index of an entry."""
    if isinstance(name, Numeral):
        name = name.of
    if isinstance(name, Letter):
        return Letter(
            name.base, (*name.sub, *index.split(",")), name.dots, name.star, name.bold, name.literal, name.apart
        )
    return name
