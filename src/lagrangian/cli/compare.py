"""``lagrangian compare``: compare two systems."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from lagrangian.cli.formats import FormatOption, Notation, NotationOption, chosen, put_report
from lagrangian.cli.terminal import Force, Json, Output, Width, example_names, open_system
from lagrangian.errors import Error

if TYPE_CHECKING:
    from lagrangian.system import System


def compare(
    files: Annotated[
        list[str] | None,
        typer.Argument(metavar="FILE FILE", help="Two model files; - is standard input.", show_default=False),
    ] = None,
    examples: Annotated[
        list[str] | None,
        typer.Option(
            "--example",
            "-e",
            metavar="NAME",
            help="Use a built-in example instead of a file; repeatable.",
            show_default=False,
            autocompletion=example_names,
        ),
    ] = None,
    change: Annotated[
        list[str] | None,
        typer.Option(
            "--change",
            "-c",
            metavar="EQUATION",
            help='Express a coordinate of one system in those of the other: "x2 = x1 + x2r". Repeatable.',
        ),
    ] = None,
    format: FormatOption = None,
    notation: NotationOption = Notation.LECTURE,
    json: Json = False,
    width: Width = None,
    output: Output = None,
    force: Force = False,
) -> None:
    """Compare the equations of two systems; exit 0 if both describe the same motion, 1 if they differ.

    Files come before examples.

    \b
    Examples:
      lagrangian compare -e lecture-3a -e lecture-3b
      lagrangian compare mine.toml -e lecture-3b
      lagrangian compare mine.toml theirs.toml -c "x2 = x1 + x2r" -o both.html
    """
    wanted = chosen(format, json, output, force)
    from lagrangian.compare import compare as compared

    a, b = _two(files or [], examples or [])
    found = compared(a, b, _changes(change))
    put_report(found.report(), wanted, width, output, notation=notation)
    if not found.same:
        raise typer.Exit(1)


def _two(files: list[str], examples: list[str]) -> tuple[System, System]:
    if len(files) + len(examples) != 2:
        raise Error(
            f"exactly two systems can be compared (got {len(files) + len(examples)})",
            fix="name two model files, or examples with -e: lagrangian compare mine.toml -e lecture-3b",
            code="E401",
        )
    if files.count("-") > 1:
        raise Error(
            "only one of the two arguments can be standard input (-)", fix="name a file for the other", code="E404"
        )
    first, second = [open_system(f) for f in files] + [open_system(None, e) for e in examples]
    return first, second


def _changes(given: list[str] | None) -> dict[str, str] | None:
    if not given:
        return None
    found: dict[str, str] = {}
    for item in given:
        left, equals, right = item.partition("=")
        if not equals or not left.strip() or not right.strip():
            raise Error(f"'{item[:60]}' is not a change of coordinates", fix='--change "x2 = x1 + x2r"', code="E406")
        if left.strip() in found:
            name = left.strip()[:60]
            raise Error(f"'{name}' is given twice with --change", fix="give only one of the two", code="E404")
        found[left.strip()] = right
    return found
