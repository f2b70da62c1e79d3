"""Writes a report as text, Markdown, LaTeX, HTML or JSON."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Literal, TypeAlias, get_args

from lagrangian.errors import ModelError, did_you_mean
from lagrangian.model import Model
from lagrangian.page.report import Part, Report
from lagrangian.write import html_page, latex, markdown, text
from lagrangian.write.blocks import Items
from lagrangian.write.document import Block, Document, Paragraph, Section
from lagrangian.write.quantities import Notation

ReportFormat: TypeAlias = Literal["text", "markdown", "latex", "html", "json"]
"""The formats of a report."""


def lay_out_report(
    report: Report[Model], *, notation: Notation = "lecture", full: bool = False, details: bool = False
) -> Document:
    """Return the document of a report; ``full`` writes out what would be summarized because of its length.

    Raises `ModelError` for an unknown notation.
    """
    items = Items(report.model, notation, brief=False, full=full, details=details)
    sections = [
        Section(f"part-{k}", items.inline(part.title), tuple(_blocks(items, part, f"part-{k}")))
        for k, part in enumerate(report.parts, 1)
    ]
    if items.elided:
        how = "It opens where it stands." if details else "The option “full” writes it out, and the data holds it."
        words = f"⟨n operations⟩ stands for an expression that is too long to read. {how}"
        sections.append(Section("notes", ("Notes",), (Paragraph((words,), "note"),)))
    return Document(report.title, tuple(sections))


def _blocks(items: Items, part: Part, anchor: str) -> Iterator[Block]:
    yield from items.items(part.items, anchor)
    if part.checks:
        yield items.checks(part.checks)


def write_report(
    report: Report[Model],
    format: ReportFormat = "text",
    *,
    notation: Notation = "lecture",
    full: bool = False,
    width: int = 80,
) -> str:
    """Return a report in a format; JSON contains its data. Raises `ModelError` for an unknown format or notation."""
    if format not in get_args(ReportFormat):
        known = get_args(ReportFormat)
        raise ModelError(
            f"there is no format '{format}'", fix=did_you_mean(str(format), known) or f"use one of {', '.join(known)}"
        )
    if format == "json":
        return json.dumps(report.data, ensure_ascii=False, indent=1, allow_nan=False) + "\n"
    document = lay_out_report(report, notation=notation, full=full, details=format == "html")
    if format == "text":
        return text.page(document, width)
    if format == "html":
        return html_page.page(document, "analysis")
    return latex.page(document) if format == "latex" else markdown.page(document)


def report_rows(
    report: Report[Model], *, notation: Notation = "lecture", full: bool = False, width: int = 80
) -> list[str]:
    """Return the lines of a report as text; its titles are of the class `Title`."""
    return text.page_rows(lay_out_report(report, notation=notation, full=full), width)


def report_fragment(report: Report[Model]) -> str:
    """Return a report as a piece of HTML for a notebook."""
    return html_page.fragment(lay_out_report(report, details=True))
