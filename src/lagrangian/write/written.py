"""The base class of results that can be written in several formats."""

from __future__ import annotations

import json
from typing import Any

from lagrangian.model import Model
from lagrangian.page.report import Report
from lagrangian.viewed import Brief, cut
from lagrangian.write.quantities import Notation
from lagrangian.write.report import report_fragment, write_report


class Written(Brief):
    """A result with a report, which can be written as text, Markdown, LaTeX, HTML and plain data."""

    def report(self) -> Report[Model]:
        """Return the report of this result: words, formulas and tables."""
        raise TypeError(f"{type(self).__name__} has no report")

    def to_text(self, *, notation: Notation = "lecture", full: bool = False, width: int = 80) -> str:
        """Return Unicode text for a terminal of ``width`` columns; ``full`` writes out what is too long to read."""
        return write_report(self.report(), "text", notation=notation, full=full, width=width)

    def to_markdown(self, *, notation: Notation = "lecture", full: bool = False) -> str:
        """Return Markdown with LaTeX mathematics."""
        return write_report(self.report(), "markdown", notation=notation, full=full)

    def to_latex(self, *, notation: Notation = "lecture", full: bool = False) -> str:
        """Return a complete LaTeX article."""
        return write_report(self.report(), "latex", notation=notation, full=full)

    def to_html(self, *, notation: Notation = "lecture", full: bool = False) -> str:
        """Return one self-contained HTML page."""
        return write_report(self.report(), "html", notation=notation, full=full)

    def to_dict(self) -> dict[str, Any]:
        """Return plain data that can be written as JSON."""
        return dict(self.report().data)

    def to_json(self) -> str:
        """Return `to_dict` as JSON text."""
        return json.dumps(self.to_dict(), ensure_ascii=False, indent=1, allow_nan=False) + "\n"

    def _repr_html_(self) -> str:
        return report_fragment(self.report())

    def __str__(self) -> str:
        """Return the result as text."""
        return self.to_text()

    def __repr__(self) -> str:
        """Return the title in angle brackets; ``print`` shows the whole result."""
        return cut(f"<{self.report().title}>")
