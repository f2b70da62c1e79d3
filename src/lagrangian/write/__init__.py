"""Writers of pages in text, Markdown, LaTeX and HTML, and of tables in files.

A page is a Document in one of three notations; each format has a writer. Only this package contains page markup.
"""

from typing import TYPE_CHECKING

from lagrangian.lazily import lazily

if TYPE_CHECKING:
    from lagrangian.write.document import Document
    from lagrangian.write.files import check_free, write_file, write_with
    from lagrangian.write.quantities import NOTATIONS, Notation
    from lagrangian.write.report import ReportFormat, report_fragment, report_rows, write_report
    from lagrangian.write.text import Title, page_rows
    from lagrangian.write.written import Written
else:
    __getattr__ = lazily(
        __name__,
        {
            "document": "Document",
            "files": "check_free write_file write_with",
            "quantities": "NOTATIONS Notation",
            "report": "ReportFormat report_fragment report_rows write_report",
            "text": "Title page_rows",
            "written": "Written",
        },
    )

__all__ = [
    "NOTATIONS",
    "Document",
    "Notation",
    "ReportFormat",
    "Title",
    "Written",
    "check_free",
    "page_rows",
    "report_fragment",
    "report_rows",
    "write_file",
    "write_report",
    "write_with",
]
