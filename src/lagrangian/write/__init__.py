"""A derivation written out for people: text, Markdown, LaTeX, HTML, and plain data for JSON.

`lay_out` makes a Document of it, in one of three notations; a writer for each format renders the Document. This is the
only room that knows page markup.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from typing import Any

from lagrangian.derive import Derivation
from lagrangian.write.data import to_dict
from lagrangian.write.document import Document
from lagrangian.write.files import write_file, write_with
from lagrangian.write.html import to_html, to_html_fragment
from lagrangian.write.latex import to_latex
from lagrangian.write.layout import lay_out
from lagrangian.write.markdown import to_markdown
from lagrangian.write.quantities import Notation
from lagrangian.write.report import ReportFormat, report_fragment, write_report
from lagrangian.write.text import to_text, verdicts


def to_json(derivation: Derivation, *, notation: Notation = "lecture", brief: bool = False, full: bool = False) -> str:
    """Return `to_dict` as JSON text."""
    return (
        json.dumps(to_dict(derivation, notation=notation, brief=brief, full=full), ensure_ascii=False, indent=1) + "\n"
    )


FORMATS: Mapping[str, Callable[..., str]] = {
    "text": to_text,
    "markdown": to_markdown,
    "latex": to_latex,
    "html": to_html,
    "json": to_json,
}
"""Every format's writer: ``FORMATS[name](derivation, notation=…, brief=…, full=…) -> str``."""

NOTATIONS: tuple[Any, ...] = ("lecture", "physics", "robotics")
"""The notations that `lay_out` and every writer know."""

__all__ = [
    "FORMATS",
    "NOTATIONS",
    "Document",
    "Notation",
    "ReportFormat",
    "lay_out",
    "report_fragment",
    "to_dict",
    "to_html",
    "to_html_fragment",
    "to_json",
    "to_latex",
    "to_markdown",
    "to_text",
    "verdicts",
    "write_file",
    "write_report",
    "write_with",
]
