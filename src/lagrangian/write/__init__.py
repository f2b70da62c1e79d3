"""A derivation written out for people: text, Markdown, LaTeX, HTML, and plain data for JSON.

`lay_out` makes a Document of it, in one of three notations; a writer for each format renders the Document. This is the
only room that knows page markup.
"""

from typing import TYPE_CHECKING

from lagrangian.lazily import lazily

if TYPE_CHECKING:
    from lagrangian.write.data import to_dict
    from lagrangian.write.document import Document
    from lagrangian.write.files import check_free, write_file, write_with
    from lagrangian.write.formats import FORMATS, NOTATIONS, to_json
    from lagrangian.write.html import to_html, to_html_fragment
    from lagrangian.write.latex import to_latex
    from lagrangian.write.layout import lay_out
    from lagrangian.write.markdown import to_markdown
    from lagrangian.write.quantities import Notation
    from lagrangian.write.report import ReportFormat, report_fragment, report_rows, write_report
    from lagrangian.write.text import Title, page_rows, to_text
else:
    __getattr__ = lazily(
        __name__,
        {
            "data": "to_dict",
            "document": "Document",
            "formats": "FORMATS NOTATIONS to_json",
            "files": "check_free write_file write_with",
            "html": "to_html to_html_fragment",
            "latex": "to_latex",
            "layout": "lay_out",
            "markdown": "to_markdown",
            "quantities": "Notation",
            "report": "ReportFormat report_fragment report_rows write_report",
            "text": "Title page_rows to_text",
        },
    )

__all__ = [
    "FORMATS",
    "NOTATIONS",
    "Document",
    "Notation",
    "ReportFormat",
    "Title",
    "check_free",
    "lay_out",
    "page_rows",
    "report_fragment",
    "report_rows",
    "to_dict",
    "to_html",
    "to_html_fragment",
    "to_json",
    "to_latex",
    "to_markdown",
    "to_text",
    "write_file",
    "write_report",
    "write_with",
]
