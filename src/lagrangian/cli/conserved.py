"""``lagrangian conserved``: the quantities that are constant along every motion of a system."""

from __future__ import annotations

from typing import Annotated

import typer

from lagrangian.cli.assignments import assignments
from lagrangian.cli.formats import FormatOption, chosen, put_report
from lagrangian.cli.terminal import Example, Force, Json, OptionalFile, Output, Width, open_system


def conserved(
    file: OptionalFile = None,
    example: Example = None,
    values: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            "-s",
            metavar="NAME=VALUE",
            help='Value of a parameter in the simulated run: k=80, "m1=2 kg"; one that is set to 0 vanishes '
            "from the formulas too. Repeatable.",
        ),
    ] = None,
    format: FormatOption = None,
    json: Json = False,
    width: Width = None,
    output: Output = None,
    force: Force = False,
) -> None:
    """Find conserved quantities: momenta, total momenta and energy, each proved and checked along a simulated run.

    \b
    Examples:
      lagrangian conserved --example spherical-pendulum
      lagrangian conserved carts.toml --set k=80 -o conserved.html
    """
    wanted = chosen(format, json, output, force)
    found = open_system(file, example).conserved_quantities(params=assignments(values, "--set"))
    put_report(found.report(), wanted, width, output)
