"""``lagrangian equilibria``: find the equilibria of a system."""

from __future__ import annotations

from typing import Annotated

import typer

from lagrangian.cli.assignments import assignments, ranges
from lagrangian.cli.formats import FormatOption, chosen, put_report
from lagrangian.cli.terminal import (
    ConstantInputs,
    Example,
    Force,
    Json,
    OptionalFile,
    Output,
    Parameters,
    Width,
    open_system,
)


def equilibria(
    file: OptionalFile = None,
    example: Example = None,
    box: Annotated[
        list[str] | None,
        typer.Option(
            "--box",
            metavar="NAME=LOW:HIGH",
            help='Range of a coordinate to search: theta1=-pi:pi, "x=0 m : 30 cm". Repeatable.',
        ),
    ] = None,
    values: Parameters = None,
    inputs: ConstantInputs = None,
    starts: Annotated[
        int | None,
        typer.Option(metavar="N", help="Number of starting points of the search. By default, as many as are needed."),
    ] = None,
    format: FormatOption = None,
    json: Json = False,
    width: Width = None,
    output: Output = None,
    force: Force = False,
) -> None:
    """Find the equilibria within given ranges of the coordinates, and whether each is stable.

    \b
    Examples:
      lagrangian equilibria --example double-pendulum
      lagrangian equilibria arm.toml --box theta1=-pi:pi --set m1=2 --input tau=3
      lagrangian equilibria arm.toml --json
    """
    wanted = chosen(format, json, output, force)
    found = open_system(file, example).equilibria(
        inputs=assignments(inputs, "--input"),
        params=assignments(values, "--set"),
        box=ranges(box, "--box"),
        starts=starts,
    )
    put_report(found.report(), wanted, width, output)
