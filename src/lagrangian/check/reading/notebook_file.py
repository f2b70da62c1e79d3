"""The text of a Jupyter notebook: what its cells say, one below the other, and what they show."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any


def of_notebook(text: str) -> str | None:
    """Return the text of a notebook's cells and of their outputs in LaTeX or plain text; None if it is no notebook."""
    if not text.lstrip().startswith("{") or '"cells"' not in text:
        return None
    try:
        made = json.loads(text)
    except (ValueError, RecursionError):
        return None
    cells = made.get("cells") if isinstance(made, dict) else None
    if not isinstance(cells, list):
        return None
    return "\n\n".join(x for cell in cells if isinstance(cell, dict) for x in _of_cell(cell)) + "\n"


def _of_cell(cell: dict[str, Any]) -> Iterator[str]:
    if cell.get("cell_type") in ("markdown", "code", "raw"):
        yield _joined(cell.get("source"))
    outputs = cell.get("outputs")
    for output in outputs if isinstance(outputs, list) else ():
        if not isinstance(output, dict) or output.get("output_type") == "error":
            continue
        held = output.get("data")
        data: dict[str, Any] = held if isinstance(held, dict) else {}
        shown = _joined(output.get("text") or data.get("text/latex") or data.get("text/plain"))
        if shown.strip():
            number = output.get("execution_count")
            yield f"Out[{number}]: {shown}" if isinstance(number, int) and "\n" not in shown.strip() else shown


def _joined(lines: Any) -> str:
    listed = lines if isinstance(lines, list) else [lines]
    return "".join(x for x in listed if isinstance(x, str))
