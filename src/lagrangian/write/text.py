"""A derivation as Unicode text for a terminal: 80 columns, boxes around results."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.derive import Derivation
from lagrangian.errors import ModelError
from lagrangian.write.document import (
    Block,
    Boxed,
    Details,
    Display,
    Document,
    Heading,
    Inline,
    Paragraph,
    Section,
    Table,
    Verdicts,
)
from lagrangian.write.glyphs import columns, join, unicode
from lagrangian.write.layout import lay_out
from lagrangian.write.lines import chains, measure
from lagrangian.write.math import Grid, Math, break_lines, equality, tokens
from lagrangian.write.quantities import Notation

NARROWEST = 40
_KEPT = "\u00a0"
"""A space inside a formula, where a line is broken last."""


def to_text(
    derivation: Derivation,
    *,
    notation: Notation = "lecture",
    brief: bool = False,
    full: bool = False,
    width: int = 80,
) -> str:
    """Return the derivation as Unicode text of at most ``width`` columns, where its symbols allow it.

    Raises `ModelError` for an unknown notation and a width under 40.
    """
    if width < NARROWEST:
        raise ModelError(f"a width of {width} columns is too narrow", fix=f"use {NARROWEST} or more", code="E406")
    return page(lay_out(derivation, notation=notation, brief=brief, full=full), width)


def page(document: Document, width: int) -> str:
    """Return a document as Unicode text of at most ``width`` columns."""
    title = " ".join(clean(document.title).split())
    lines = [*wrap((title,), width), "═" * min(width, max(columns(title), 1))]
    for section in document.sections:
        lines += ["", *_section(section, width, document.brief)]
    return "\n".join(line.rstrip().replace(_KEPT, " ") for line in lines) + "\n"


def verdicts(derivation: Derivation, *, notation: Notation = "lecture", width: int = 80) -> str:
    """Return what was verified, a mark and a figure each, and what is to be known of the system."""
    sections = {s.anchor: s.blocks for s in lay_out(derivation, notation=notation).sections}
    blocks = [*sections.get("verified", ()), *sections.get("notices", ())]
    lines = [line for block in blocks for line in _block(block, width)]
    return "\n".join(line.rstrip().replace(_KEPT, " ") for line in lines) + "\n"


def _section(section: Section, width: int, brief: bool) -> list[str]:
    number = f"{section.number}  " if section.number is not None else ""
    title = number + "".join(x if isinstance(x, str) else unicode(x) for x in section.title)
    lines = [title] if brief else [title, "─" * min(width, columns(title))]
    previous: Block | None = None
    for block in section.blocks:
        if previous is not None and not brief and not (_tight(previous) and _tight(block)):
            lines.append("")
        lines += list(_block(block, width))
        previous = block
    return lines


def _tight(block: Block) -> bool:
    return isinstance(block, Display) or (isinstance(block, Paragraph) and block.role in ("what", "why"))


def _block(block: Block, width: int) -> Iterator[str]:
    match block:
        case Heading(text):
            yield from wrap((*text,), width)
        case Paragraph(text, role):
            lead: Inline = ("Why: ",) if role == "why" else ()
            yield from wrap((*lead, *text), width)
        case Display():
            for line in display(block, width - 4):
                yield "    " + line
        case Boxed(displays):
            yield from _box(displays, width)
        case Table():
            yield from _table(block, width)
        case Verdicts(verdicts):
            for verdict in verdicts:
                figure = f" ({verdict.figure})" if verdict.figure else ""
                yield from wrap(("✓ " if verdict.holds else "✗ ", *verdict.what, clean(figure)), width, hang=2)
        case Details(summary, blocks):
            yield from wrap(summary, width)
            for inner in blocks:
                yield from _block(inner, width)


# -- words ----------------------------------------------------------------------------------------------------------


def clean(words: str) -> str:
    """Words without characters that would move the cursor or turn the direction of writing."""
    return "".join(c if c.isprintable() or c in " \u00a0" else " " for c in words)


def wrap(text: Inline, width: int, hang: int = 0) -> list[str]:
    """Wrap words and formulas; a formula is only broken where it is longer than a line."""
    pieces = "".join(clean(x) if isinstance(x, str) else unicode(x).replace(" ", _KEPT) for x in text)
    lines: list[str] = []
    line = ""
    for word in pieces.split(" "):
        for part in _fitting(word, width - hang):
            candidate = f"{line} {part}" if line.strip() else line + part
            if columns(candidate) > width and line.strip():
                lines.append(line.rstrip())
                candidate = " " * hang + part
            line = candidate
    return [*lines, line] if line.strip() or not lines else lines


def _fitting(word: str, width: int) -> list[str]:
    """A word, cut where it is longer than a line: at the spaces of a formula, else anywhere."""
    if columns(word) <= width:
        return [word]
    if _KEPT in word:
        return [part for piece in word.split(_KEPT) for part in _fitting(piece, width)]
    parts, part = [], ""
    for c in word:
        if columns(part + c) > width:
            parts.append(part)
            part = ""
        part += c
    return [*parts, part]


# -- formulas -------------------------------------------------------------------------------------------------------


def display(formula: Display, width: int) -> list[str]:
    """A chain of equal sides in lines: on one line if it fits, else a line a side under the equals sign."""
    if any(isinstance(side, Grid) for side in formula.sides):
        lines = _matrix(formula.sides, width)
    else:
        lines = _chain(formula.sides, width)
    if formula.note:
        note = "".join(clean(x) if isinstance(x, str) else unicode(x) for x in formula.note)
        if len(lines) == 1 and columns(lines[0]) + columns(note) + 5 <= width:
            lines = [f"{lines[0]}   ({note})"]
        else:
            lines += wrap((f"({note})",), width)
    return lines


def _chain(sides: tuple[Math, ...], width: int) -> list[str]:
    whole = unicode(equality(sides))
    if columns(whole) <= width:
        return [whole]
    head, *rest = sides
    left = unicode(head)
    if rest and columns(left) <= width // 3:
        hang = columns(left) + 1
        lines: list[str] = []
        for i, side in enumerate(rest):
            first = (left if i == 0 else " " * (hang - 1)) + " = "
            lines += _broken(side, first, hang + 4, width)
        return lines
    lines = _broken(head, "", 4, width)
    for side in rest:
        if columns(lines[-1]) + 3 + columns(unicode(side)) <= width:
            lines[-1] += " = " + unicode(side)
        else:
            lines += _broken(side, "  = ", 6, width)
    return lines


def _broken(side: Math, first: str, indent: int, width: int) -> list[str]:
    cut = break_lines(list(tokens(side)), width - indent, measure, first=width - columns(first))
    rows = [first + join(cut[0])]
    return rows + [" " * indent + join(row) for row in cut[1:]]


def _matrix(sides: tuple[Math, ...], width: int) -> list[str]:
    """Matrices as blocks side by side; entry by entry where they are too wide."""
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
    """Formulas in a frame, each with its number at the right."""
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


def _table(table: Table, width: int) -> Iterator[str]:
    gap = 3
    count = len(table.header)
    texts = [[_words(cell) for cell in row] for row in (table.header, *table.rows)]
    if count == 0:
        return
    widths = [max(columns(row[j]) for row in texts) for j in range(count)]
    room = width - gap * (count - 1)
    while sum(widths) > room:
        widest = max(range(count), key=lambda j: widths[j])
        others = sorted(widths)[-2] if count > 1 else 0
        widths[widest] -= max(1, min(sum(widths) - room, widths[widest] - others))
    cells = (table.header, *table.rows)
    for i, row in enumerate(cells):
        wrapped = [wrap(cell, w) if cell else [""] for cell, w in zip(row, widths, strict=True)]
        for k in range(max(len(lines) for lines in wrapped)):
            parts = [lines[k] if k < len(lines) else "" for lines in wrapped]
            yield (" " * gap).join(p + " " * (w - columns(p)) for p, w in zip(parts, widths, strict=True)).rstrip()
        if i == 0:
            yield (" " * gap).join("─" * w for w in widths)


def _words(cell: Inline) -> str:
    return "".join(clean(x) if isinstance(x, str) else unicode(x) for x in cell)
