"""``lagrangian linearize``: A, B, C, D about a point, poles, modes and what they say of stability."""

from __future__ import annotations

from typing import Annotated

import typer

from lagrangian import write
from lagrangian.commands.assignments import assignments
from lagrangian.commands.derive import Format
from lagrangian.commands.terminal import Example, OptionalFile, Output, open_system, put


def linearize(
    file: OptionalFile = None,
    example: Example = None,
    at: Annotated[
        list[str] | None, typer.Option("--at", help='A coordinate or rate there: x2=0, "theta=12 deg".')
    ] = None,
    values: Annotated[list[str] | None, typer.Option("--set", help='A parameter\'s value: k=80, "m1=2 kg".')] = None,
    inputs: Annotated[list[str] | None, typer.Option("--input", help="An input's constant value: F=2.")] = None,
    outputs: Annotated[
        list[str] | None, typer.Option("--outputs", help="What is measured: an expression, or name=expression.")
    ] = None,
    operating_point: Annotated[
        bool, typer.Option("--operating-point", help="Take a point that is no equilibrium as it is.")
    ] = False,
    symbols: Annotated[bool, typer.Option("--symbols", help="Add the matrices with parameters as letters.")] = False,
    format: Annotated[Format, typer.Option("--format", "-f", help="What to write.")] = Format.TEXT,
    json: Annotated[bool, typer.Option("--json", help="Write data, as --format json.")] = False,
    width: Annotated[int, typer.Option(help="Columns of the text.", min=40, max=400)] = 80,
    output: Output = None,
) -> None:
    """Linearize about an equilibrium: A, B, C, D, poles, modes, stability."""
    found = open_system(file, example).linearize(
        assignments(at, "--at"),
        params=assignments(values, "--set"),
        inputs=assignments(inputs, "--input"),
        outputs=_outputs(outputs),
        operating_point=operating_point,
    )
    put(write.write_report(found.report(symbols=symbols), "json" if json else format.value, width=width), output)


def _outputs(given: list[str] | None) -> dict[str, str] | None:
    """Name → expression; an expression without a name is its own name."""
    if not given:
        return None
    named = (item.partition("=") for item in given)
    return {left.strip(): (right if equals else left).strip() for left, equals, right in named}
