"""The format of the output, which an option or the ending of the file determines, and whether a file may be written."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from lagrangian.cli.door import put, width
from lagrangian.cli.terminal import OUTPUT
from lagrangian.errors import Error

if TYPE_CHECKING:
    from lagrangian.page.report import Report


class Format(StrEnum):
    """The format of the output: text, markup, or data."""

    TEXT = "text"
    MARKDOWN = "markdown"
    LATEX = "latex"
    HTML = "html"
    JSON = "json"


class Notation(StrEnum):
    """The symbols used: ξ, T*, Ξ of the lecture; q, T, Q of physics; M, C, g, τ of robotics."""

    LECTURE = "lecture"
    PHYSICS = "physics"
    ROBOTICS = "robotics"


ENDINGS = {
    ".txt": Format.TEXT,
    ".md": Format.MARKDOWN,
    ".tex": Format.LATEX,
    ".html": Format.HTML,
    ".htm": Format.HTML,
    ".json": Format.JSON,
}
"""The format for each ending of a file name."""

FormatOption = Annotated[
    Format | None,
    typer.Option(
        "--format",
        "-f",
        help="Output format. By default, the one that the file name in -o implies, otherwise text.",
        show_default=False,
        rich_help_panel=OUTPUT,
    ),
]
NotationOption = Annotated[
    Notation,
    typer.Option(
        "--notation",
        help="Symbols to use: ξ, T*, Ξ (lecture: the textbook procedure in steps 0 to 6), q, T, Q (physics) "
        "or M, C, g, τ (robotics).",
        rich_help_panel=OUTPUT,
    ),
]


def chosen(format: Format | None, as_data: bool, output: Path | None, force: bool) -> Format:
    """Return the output format: the one of the option, else that of the ending of the file name, else text.

    Raises `Error` if the file exists (unless ``force``), if the ending is unknown and there is no option, or if the
    option and the ending, or two options, contradict each other.
    """
    if as_data and format not in (None, Format.JSON):
        raise Error(f"--json and --format {format} contradict each other", fix="give only one of the two", code="E404")
    said = Format.JSON if as_data else format
    if output is None:
        return said or Format.TEXT
    check_output(output, force)
    if output.exists() and not output.is_file():  # a device or a pipe
        return said or Format.TEXT
    named = ENDINGS.get(output.suffix.lower())
    if said is None and named is None:
        fix = f"end it in {', '.join(ENDINGS)}, or say what to write with --format"
        raise Error(f"the ending of '{output}' does not name a known format", fix=fix, code="E402")
    if said is not None and named not in (None, said):
        fix = f"end it in {next(e for e, kind in ENDINGS.items() if kind is said)}, or leave the option out"
        raise Error(f"'{output}' ends like {named}, but {said} is to be written", fix=fix, code="E402")
    return said or named or Format.TEXT


def check_output(output: Path | None, force: bool, ending: str = "") -> None:
    """Raise `Error` if a file cannot be written, has the wrong ending, or exists already (unless ``force``)."""
    if output is None:
        return
    from lagrangian.write.files import check_free

    check_free(output, overwrite=force)
    device = output.exists() and not output.is_file()
    if ending and output.suffix.lower() != ending and not device:
        what = f"the ending of '{output.name}' does not fit: {ending[1:].upper()} is to be written"
        raise Error(what, fix=f"-o {output.with_suffix(ending)}", code="E402")


def as_json(data: Any) -> str:
    """Return data as JSON text; a number that is not finite becomes null, because JSON has no such numbers."""
    return json.dumps(_finite(data), ensure_ascii=False, indent=1, allow_nan=False)


def _finite(data: Any) -> Any:
    if isinstance(data, float):
        return data if math.isfinite(data) else None
    if isinstance(data, Mapping):
        return {key: _finite(value) for key, value in data.items()}
    return [_finite(x) for x in data] if isinstance(data, list | tuple) else data


def put_report(
    report: Report,
    format: Format,
    columns: int | None,
    output: Path | None,
    *,
    notation: Notation = Notation.LECTURE,
    full: bool = False,
) -> None:
    """Write a report to a file or to standard output; ``full`` writes out what is too long to read."""
    from lagrangian import write

    if format is Format.TEXT:
        put(write.report_rows(report, notation=notation.value, full=full, width=width(columns, output)), output)
    else:
        put(write.write_report(report, format.value, notation=notation.value, full=full), output)
