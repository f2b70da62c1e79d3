"""HTML for notebooks: a system, a run, a step of a derivation, its ledger."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from lagrangian.write import html_page
from lagrangian.write.described import system_section
from lagrangian.write.document import Document, HeadPicture, Inline, Paragraph, Section, TableBlock

if TYPE_CHECKING:
    from lagrangian.model import Model


def system_view(model: Model, words: str, picture: HeadPicture | None = None) -> str:
    """Return a system: its picture, its symbols with their values, its elements and its notices."""
    rows = [(element.title, element.ledger) for element in model.elements]
    elements = Section("elements", ("Elements",), (_table(("element", "counted in"), rows),))
    said = Section("summary", ("Description",), (Paragraph((words,)),))
    return html_page.fragment(Document(model.name, (said, system_section(model), elements), picture=picture))


def words_view(title: str, words: Sequence[str]) -> str:
    """Return a title and paragraphs."""
    return html_page.fragment(Document(title, (Section("words", (), tuple(Paragraph((w,)) for w in words)),)))


def table_view(title: str, words: Sequence[str], header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a title, paragraphs and a table."""
    blocks = (*(Paragraph((w,)) for w in words), _table(header, rows))
    return html_page.fragment(Document(title, (Section("table", (), blocks),)))


def _table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> TableBlock:
    def cells(row: Sequence[str]) -> tuple[Inline, ...]:
        return tuple((cell,) if cell else () for cell in row)

    return TableBlock(cells(header), tuple(cells(row) for row in rows))
