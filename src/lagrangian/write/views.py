"""Pieces of HTML for notebooks: a system, a run, a step of a derivation, its ledger."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from lagrangian.write import html
from lagrangian.write.document import Document, Inline, Paragraph, Section, Table
from lagrangian.write.layout import lay_out, system_section

if TYPE_CHECKING:
    from lagrangian.derive import Derivation
    from lagrangian.model import Model


def system_view(model: Model, words: str) -> str:
    """Return a system: its symbols with their values, the elements, and what is to be known of it."""
    rows = [(element.title, element.ledger) for element in model.elements]
    elements = Section("elements", ("Elements",), (_table(("element", "booked in"), rows),))
    said = Section("summary", ("Description",), (Paragraph((words,)),))
    return html.fragment(Document(model.name, (said, system_section(model), elements)))


def words_view(title: str, words: Sequence[str]) -> str:
    """Return a title and paragraphs."""
    return html.fragment(Document(title, (Section("words", (), tuple(Paragraph((w,)) for w in words)),)))


def table_view(title: str, words: Sequence[str], header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a title, paragraphs and a table."""
    blocks = (*(Paragraph((w,)) for w in words), _table(header, rows))
    return html.fragment(Document(title, (Section("table", (), blocks),)))


def section_view(derivation: Derivation, anchor: str) -> str:
    """Return one section of a derivation's page, such as ``step-6``."""
    page = lay_out(derivation, details=True)
    return html.fragment(Document(page.title, tuple(s for s in page.sections if s.anchor == anchor)))


def _table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> Table:
    def cells(row: Sequence[str]) -> tuple[Inline, ...]:
        return tuple((cell,) if cell else () for cell in row)

    return Table(cells(header), tuple(cells(row) for row in rows))
