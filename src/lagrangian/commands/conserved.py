"""``lagrangian conserved``: what every motion of a system keeps."""

from __future__ import annotations

from typing import Annotated

import typer

from lagrangian import write
from lagrangian.commands.assignments import assignments
from lagrangian.commands.derive import Format
from lagrangian.commands.terminal import Example, OptionalFile, Output, open_system, put


def conserved(
    file: OptionalFile = None,
    example: Example = None,
    values: Annotated[list[str] | None, typer.Option("--set", help='A parameter\'s value: k=80, "m1=2 kg".')] = None,
    format: Annotated[Format, typer.Option("--format", "-f", help="What to write.")] = Format.TEXT,
    json: Annotated[bool, typer.Option("--json", help="Write data, as --format json.")] = False,
    width: Annotated[int, typer.Option(help="Columns of the text.", min=40, max=400)] = 80,
    output: Output = None,
) -> None:
    """List conserved quantities: momenta, total momenta, energy, each proved and watched along a run."""
    found = open_system(file, example).conserved(params=assignments(values, "--set"))
    put(write.write_report(found.report(), "json" if json else format.value, width=width), output)
