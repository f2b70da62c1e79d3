"""Writes a derivation as Markdown with LaTeX mathematics between dollar signs, for GitHub and notebooks."""

from __future__ import annotations

import re
from collections.abc import Iterator

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
    TableBlock,
)
from lagrangian.write.tex import WEB
from lagrangian.write.tex_lines import boxed, displayed
from lagrangian.write.text import clean

_SPECIAL = re.compile(r"([\\`*_{}\[\]#|$~+!])")


def page(document: Document) -> str:
    """Return a document as Markdown."""
    blocks = [f"# {escape(document.title)}"]
    for section in document.sections:
        number = f"{section.number}. " if section.number is not None else ""
        blocks.append(f"## {number}{inline(section.title)}")
        for block in section.blocks:
            blocks += _block(block)
    return "\n\n".join(blocks) + "\n"


def escape(words: str) -> str:
    """Escape any text for Markdown: no markup, no HTML, no mathematics."""
    safe = clean(words).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return _SPECIAL.sub(r"\\\1", safe)


def inline(text: Inline) -> str:
    """Return words and mathematics within a line."""
    return "".join(escape(x) if isinstance(x, str) else f"${WEB.latex(x)}$" for x in text)


def _block(block: Block) -> Iterator[str]:
    match block:
        case HeadingBlock(text):
            yield f"### {inline(text)}"
        case Paragraph(text, role):
            yield f"*Why:* {inline(text)}" if role == "why" else _start(inline(text))
        case Display(sides, _, _, note):
            yield f"$$\n{displayed(WEB, sides)}\n$$"
            if note:
                yield f"({inline(note)})"
        case Boxed(displays):
            lines = boxed(WEB, [(d.sides, d.number) for d in displays])
            body = " \\\\\n".join(lines)
            yield f"$$\n\\boxed{{\\begin{{aligned}}\n{body}\n\\end{{aligned}}}}\n$$"
        case TableBlock(header, rows):
            lines = [_row(header), "|" + " --- |" * len(header), *[_row(row) for row in rows]]
            yield "\n".join(lines)
        case CheckLines(verdicts):
            yield "\n".join(
                f"- {v.mark} {inline(v.what)}" + (f" ({escape(v.figure)})" if v.figure else "") for v in verdicts
            )
        case Details(summary, blocks):
            yield f"*{inline(summary)}*"
            for inner in blocks:
                yield from _block(inner)


def _row(cells: tuple[Inline, ...]) -> str:
    return "| " + " | ".join(inline(cell) for cell in cells) + " |"


def _start(line: str) -> str:
    """Escape the beginning of a paragraph that looks like a list item or a rule."""
    return re.sub(
        r"\A(\s*)([-=]|\d+[.)])",
        lambda m: m[1] + ("\\" + m[2] if not m[2][0].isdigit() else m[2][:-1] + "\\" + m[2][-1]),
        line,
    )
