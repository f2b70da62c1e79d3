"""The tables of ``docs/errors.md``, made from the enumerations: ``python tools/errors_page.py`` writes the page anew.

A table stands between ``<!-- NAME -->`` and ``<!-- end -->``; everything else on the page is written by hand.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from lagrangian.codes import Code
from lagrangian.integrate.status import RunStatus

PAGE = Path(__file__).parent.parent / "docs" / "errors.md"


def codes() -> Iterator[str]:
    yield "| code | what is wrong | what to know |"
    yield "|---|---|---|"
    for code in Code:
        yield f"| {code} | {code.what} | {code.explanation} |"


def statuses() -> Iterator[str]:
    yield "| status | how the run ended |"
    yield "|---|---|"
    for status in RunStatus:
        yield f"| {status.value:d} | {status.message} |".replace("| -", "| −")


TABLES = {"codes": codes, "statuses": statuses}


def made(page: str) -> str:
    """The page with its tables as the enumerations have them."""
    for name, rows in TABLES.items():
        table = "\n".join(rows())
        pattern = rf"(<!-- {name} -->\n\n).*?(\n\n<!-- end -->)"
        page, found = re.subn(pattern, lambda m, t=table: m[1] + t + m[2], page, flags=re.DOTALL)
        assert found == 1, name
    return page


if __name__ == "__main__":
    PAGE.write_text(made(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
