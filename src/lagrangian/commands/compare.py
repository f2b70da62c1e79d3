"""``lagrangian compare``: two systems side by side."""

from __future__ import annotations

from typing import Annotated

import typer

from lagrangian import write
from lagrangian.commands.derive import Format, Notation
from lagrangian.commands.terminal import Output, open_system, put
from lagrangian.comparison import compare as compared
from lagrangian.system import System


def compare(
    files: Annotated[
        list[str] | None, typer.Argument(help="Two model files; - is standard input.", show_default=False)
    ] = None,
    examples: Annotated[
        list[str] | None,
        typer.Option("--example", "-e", help="A built-in example in place of a file.", show_default=False),
    ] = None,
    change: Annotated[
        list[str] | None,
        typer.Option("--change", "-c", help='A coordinate of one in those of the other: "x2 = x1 + x2r".'),
    ] = None,
    format: Annotated[Format, typer.Option("--format", "-f", help="What to write.")] = Format.TEXT,
    notation: Annotated[Notation, typer.Option(help="Whose letters.")] = Notation.LECTURE,
    json: Annotated[bool, typer.Option("--json", help="Write data.")] = False,
    width: Annotated[int, typer.Option(help="Columns of the text.", min=40, max=400)] = 80,
    output: Output = None,
) -> None:
    """Compare two systems, row by row; exit 0 if they are the same motion, 1 if they differ.

    Files come before examples: ``lagrangian compare mine.toml -e lecture-3b``.
    """
    a, b = _two(files or [], examples or [])
    found = compared(a, b, _changes(change))
    written = Format.JSON.value if json else format.value
    put(write.write_report(found.report(), written, notation=notation.value, width=width), output)
    if not found.same:
        raise typer.Exit(1)


def _two(files: list[str], examples: list[str]) -> tuple[System, System]:
    if len(files) + len(examples) != 2:
        raise typer.BadParameter(
            f"name two systems to compare (got {len(files) + len(examples)}): model files, or examples with -e NAME"
        )
    if files.count("-") > 1:
        raise typer.BadParameter("only one of the two can be standard input")
    first, second = [open_system(f) for f in files] + [open_system(None, e) for e in examples]
    return first, second


def _changes(given: list[str] | None) -> dict[str, str] | None:
    if not given:
        return None
    found: dict[str, str] = {}
    for item in given:
        left, equals, right = item.partition("=")
        if not equals or not left.strip() or not right.strip():
            raise typer.BadParameter(f"'{item[:60]}' is no change of coordinates: write --change \"x2 = x1 + x2r\"")
        if left.strip() in found:
            raise typer.BadParameter(f"'{left.strip()[:60]}' is given twice in --change")
        found[left.strip()] = right
    return found
