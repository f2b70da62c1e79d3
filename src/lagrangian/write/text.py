"""Writes a derivation as Unicode text for a terminal, with boxes around results."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.errors import ModelError
from lagrangian.write.breaking import STEP, break_lines
from lagrangian.write.document import (
    Block,
    Boxed,
    CheckLines,
    Details,
    Display,
    Document,
    HeadingBlock,
    Inline,
    Paragraph,
    Section,
    TableBlock,
)
from lagrangian.write.expression_tree import Glyph, Grid, Math, Word, equality, tokens
from lagrangian.write.lines import chains, measure
from lagrangian.write.unicode_math import columns, join, unicode

NARROWEST = 40
GAP = 3
"""The space between the columns of a table."""
MOST_LINES = 5
"""The approximate number of lines that a cell of a table may take."""
LONG_WORD = 16
"""In a table, words of at least this many columns may be broken."""
SHORT_COLUMNS = 6
"""A left-hand side of at most this many columns always leaves room for a formula beside it."""


class Title(str):
    """A line that is a title; a terminal shows it bold."""

    __slots__ = ()


def page(document: Document, width: int) -> str:
    """Return a document as Unicode text of at most ``width`` columns."""
    return "\n".join(page_rows(document, width)) + "\n"


def page_rows(document: Document, width: int) -> list[str]:
    """Return the lines of a document as text of at most ``width`` columns, unless a single symbol is longer.

    Titles are of the class `Title`. Raises `ModelError` for a width below 40.
    """
    if width < NARROWEST:
        raise ModelError(f"a width of {width} columns is too narrow", fix=f"use {NARROWEST} or more", code="E406")
    title = " ".join(clean(document.title).split())
    lines: list[str] = [*map(Title, wrap((title,), width)), "═" * min(width, max(columns(title), 1))]
    for section in document.sections:
        lines += ["", *_section(section, width, document.brief)]
    return [type(line)(line.rstrip().replace("\u00a0", " ")) for line in lines]


def _section(section: Section, width: int, brief: bool) -> list[str]:
    number = f"{section.number}  " if section.number is not None else ""
    title = Title(number + "".join(clean(x) if isinstance(x, str) else unicode(x) for x in section.title))
    lines: list[str] = [title] if brief else [title, "─" * min(width, columns(title))]
    previous: Block | None = None
    for block in section.blocks:
        if previous is not None and not brief and not (_tight(previous) and _tight(block)):
            lines.append("")
        lines += list(_block(block, width))
        previous = block
    return lines


def _tight(block: Block) -> bool:
    return isinstance(block, Display) or (isinstance(block, Paragraph) and block.role in ("what", "why", "see"))


def _block(block: Block, width: int) -> Iterator[str]:
    match block:
        case HeadingBlock(text):
            yield from map(Title, wrap((*text,), width))
        case Paragraph(text, role):
            lead: Inline = ("Why: ",) if role == "why" else ()
            yield from wrap((*lead, *text), width)
        case Display():
            for line in display(block, width - 4):
                yield "    " + line
        case Boxed(displays):
            yield from _box(displays, width)
        case TableBlock():
            yield from _table(block, width)
        case CheckLines(verdicts):
            for verdict in verdicts:
                figure = f" ({verdict.figure})" if verdict.figure else ""
                yield from wrap((f"{verdict.mark} ", *verdict.what, clean(figure)), width, hang=2)
        case Details(summary, blocks):
            yield from wrap(summary, width)
            for inner in blocks:
                yield from _block(inner, width)


# -- words ----------------------------------------------------------------------------------------------------------


def clean(words: str) -> str:
    """Replace characters that would move the cursor or change the direction of writing."""
    return "".join(c if c.isprintable() or c in " \u00a0" else " " for c in words)


def wrap(text: Inline, width: int, hang: int = 0) -> list[str]:
    """Wrap words and formulas; a formula is broken only if it is longer than a line."""
    lines, line = [], ""
    for word in _split(text):
        shown = "".join(x if isinstance(x, str) else unicode(x) for x in word)
        candidate = f"{line} {shown}" if line.strip() else line + shown
        if columns(candidate) <= width:
            line = candidate
            continue
        if line.strip() and (columns(shown) <= width - hang or len(word) == 1):
            lines.append(line.rstrip())
            line = ""
        pieces = [t for x in word for t in ([Glyph("leaf", Word(x))] if isinstance(x, str) else tokens(x))]
        room = width - columns(line) - 1 if line.strip() else width - (hang if lines else 0)
        rows = [join(row.tokens) for row in break_lines(pieces, width - hang, measure, first=room)]
        rows[0] = f"{line} {rows[0]}" if line.strip() else rows[0]
        cut = [part for row in rows for part in _fitting(row, width - hang)]
        lines += [" " * (hang if lines or i else 0) + x for i, x in enumerate(cut[:-1])]
        line = " " * (hang if lines else 0) + cut[-1]
    return [*lines, line] if line.strip() or not lines else lines


def _split(text: Inline) -> list[list[str | Math]]:
    """Split words into runs of letters and formulas without spaces between them."""
    words: list[list[str | Math]] = [[]]
    for part in text:
        if not isinstance(part, str):
            words[-1].append(part)
            continue
        for i, run in enumerate(clean(part).split(" ")):
            if i:
                words.append([])
            if run:
                words[-1].append(run)
    return words


def _fitting(word: str, width: int) -> list[str]:
    """Break a word anywhere if it is longer than a line."""
    parts, part = [], ""
    for c in word:
        if columns(part + c) > width:
            parts.append(part)
            part = ""
        part += c
    return [*parts, part]


# -- formulas -------------------------------------------------------------------------------------------------------


def display(formula: Display, width: int) -> list[str]:
    """Write a chain of equal sides: on one line if it fits, otherwise on a line per side, aligned at the equals
    signs."""
    if any(isinstance(side, Grid) for side in formula.sides):
        lines = _matrix(formula.sides, width)
    else:
        lines = _chain(formula.sides, width)
    if formula.note:
        note = _words(formula.note)
        if len(lines) == 1 and columns(lines[0]) + columns(note) + 5 <= width:
            lines = [f"{lines[0]}   ({note})"]
        else:
            lines += ["  " + line for line in wrap((f"({note})",), width - 2, hang=1)]
    return lines


def _chain(sides: tuple[Math, ...], width: int) -> list[str]:
    whole = unicode(equality(sides))
    if columns(whole) <= width:
        return [whole]
    head, *rest = sides
    left = unicode(head)
    if rest and columns(left) <= max(width // 4, SHORT_COLUMNS):
        hang = columns(left) + 3
        lines: list[str] = []
        for i, side in enumerate(rest):
            first = (left if i == 0 else " " * columns(left)) + " = "
            lines += _broken(side, first, hang, width)
        return lines
    lines = _broken(head, "", 2, width)
    for side in rest:
        if columns(lines[-1]) + 3 + columns(unicode(side)) <= width:
            lines[-1] += " = " + unicode(side)
        else:
            lines += _broken(side, "  = ", 4, width)
    return lines


def _broken(side: Math, first: str, indent: int, width: int) -> list[str]:
    rows = break_lines(list(tokens(side)), width - indent, measure, first=width - columns(first))
    return [(" " * (indent + STEP * row.depth) if i else first) + join(row.tokens) for i, row in enumerate(rows)]


def _matrix(sides: tuple[Math, ...], width: int) -> list[str]:
    """Write matrices as blocks side by side, or entry by entry if they are too wide."""
    blocks = [_grid(side) if isinstance(side, Grid) else [unicode(side)] for side in sides]
    height = max(len(b) for b in blocks)
    if sum(columns(b[0]) for b in blocks) + 3 * (len(blocks) - 1) <= width:
        middle = (height - 1) // 2
        lines = []
        for row in range(height):
            parts = []
            for block in blocks:
                at = row - middle + (len(block) - 1) // 2
                parts.append(block[at] if 0 <= at < len(block) else " " * columns(block[0]))
            lines.append((" = " if row == middle else "   ").join(parts))
        return lines
    return [line for sides_of_entry in chains(sides, 0) for line in _chain(sides_of_entry, width)]


def _grid(grid: Grid) -> list[str]:
    cells = [[unicode(x) for x in row] for row in grid.rows]
    widths = [max(columns(row[j]) for row in cells) for j in range(len(cells[0]))] if cells else []
    body = ["   ".join(_centred(c, w) for c, w in zip(row, widths, strict=True)) for row in cells]
    if len(body) == 1:
        return [f"[ {body[0]} ]"]
    lefts = ["⎡", *["⎢"] * (len(body) - 2), "⎣"]
    rights = ["⎤", *["⎥"] * (len(body) - 2), "⎦"]
    return [f"{a} {line} {b}" for a, line, b in zip(lefts, body, rights, strict=True)]


def _centred(cell: str, width: int) -> str:
    free = width - columns(cell)
    return " " * (free // 2) + cell + " " * (free - free // 2)


def _box(displays: tuple[Display, ...], width: int) -> Iterator[str]:
    """Write formulas in a frame, each with its number at the right."""
    numbers = max(len(f"({d.number})") for d in displays) + 2 if len(displays) > 1 else 0
    inner = width - 6 - numbers
    rows: list[tuple[str, str]] = []
    for i, formula in enumerate(displays):
        lines = display(formula, inner)
        if i and (len(lines) > 1 or len(rows) > i):
            rows.append(("", ""))
        tags = [""] * (len(lines) - 1) + [f"({formula.number})" if numbers else ""]
        rows += list(zip(lines, tags, strict=True))
    span = max(columns(line) for line, _ in rows) + numbers
    yield "┌" + "─" * (span + 4) + "┐"
    for line, tag in rows:
        yield "│  " + line + " " * (span - columns(line) - columns(tag)) + tag + "  │"
    yield "└" + "─" * (span + 4) + "┘"


# -- tables ---------------------------------------------------------------------------------------------------------


def _table(table: TableBlock, width: int) -> Iterator[str]:
    count = len(table.header)
    if count == 0:
        return
    rows = (table.header, *table.rows)
    widths = [max(columns(_words(row[j])) for row in rows) for j in range(count)]
    least = [max(widths[j] // MOST_LINES, *(_least(row[j]) for row in rows)) for j in range(count)]
    room = width - GAP * (count - 1)
    if sum(least) > room:
        yield from _listed(table, width)
        return
    while sum(widths) > room:
        free = [j for j in range(count) if widths[j] > least[j]]
        widest = max(free, key=lambda j: widths[j])
        others = max((widths[j] for j in free if j != widest), default=0)
        widths[widest] -= max(1, min(sum(widths) - room, widths[widest] - max(others, least[widest])))
    for i, row in enumerate(rows):
        wrapped = [wrap(cell, w) if cell else [""] for cell, w in zip(row, widths, strict=True)]
        for k in range(max(len(lines) for lines in wrapped)):
            parts = [lines[k] if k < len(lines) else "" for lines in wrapped]
            yield (" " * GAP).join(p + " " * (w - columns(p)) for p, w in zip(parts, widths, strict=True)).rstrip()
        if i == 0:
            yield (" " * GAP).join("─" * w for w in widths)


def _listed(table: TableBlock, width: int) -> Iterator[str]:
    """Write a table that is too wide row by row: its first cell, and below it the other cells with their headings."""
    for i, row in enumerate(table.rows):
        if i:
            yield ""
        yield from wrap(row[0], width)
        for head, cell in zip(table.header[1:], row[1:], strict=True):
            if cell:
                yield from ("  " + line for line in wrap((*head, ": ", *cell), width - 2, hang=2))


def _least(cell: Inline) -> int:
    """The number of columns that a cell needs so that its words and formulas stay whole, except very long words."""
    return max(
        (
            columns(_words(tuple(word)))
            if any(not isinstance(x, str) for x in word)
            else min(columns(_words(tuple(word))), LONG_WORD)
            for word in _split(cell)
        ),
        default=0,
    )


def _words(cell: Inline) -> str:
    return "".join(clean(x) if isinstance(x, str) else unicode(x) for x in cell)
