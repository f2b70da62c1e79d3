"""``lagrangian equilibria``: where a system can stay at rest."""

from __future__ import annotations

from typing import Annotated

import typer

from lagrangian import write
from lagrangian.commands.assignments import assignments
from lagrangian.commands.derive import Format
from lagrangian.commands.terminal import Example, OptionalFile, Output, open_system, put


def equilibria(
    file: OptionalFile = None,
    example: Example = None,
    box: Annotated[
        list[str] | None, typer.Option("--box", help='Where to look: theta1=-pi:pi, "x=0 m : 30 cm".')
    ] = None,
    values: Annotated[list[str] | None, typer.Option("--set", help='A parameter\'s value: k=80, "m1=2 kg".')] = None,
    inputs: Annotated[list[str] | None, typer.Option("--input", help="An input's constant value: F=2.")] = None,
    samples: Annotated[int | None, typer.Option(help="How many starts; as many as it takes unless given.")] = None,
    format: Annotated[Format, typer.Option("--format", "-f", help="What to write.")] = Format.TEXT,
    json: Annotated[bool, typer.Option("--json", help="Write data, as --format json.")] = False,
    width: Annotated[int, typer.Option(help="Columns of the text.", min=40, max=400)] = 80,
    output: Output = None,
) -> None:
    """Find the equilibria in a box of coordinates, each with its residual and its stability."""
    found = open_system(file, example).equilibria(
        inputs=assignments(inputs, "--input"),
        params=assignments(values, "--set"),
        box={name: _ends(name, side) for name, side in assignments(box, "--box").items()},
        samples=samples,
    )
    put(write.write_report(found.report(), "json" if json else format.value, width=width), output)


def _ends(name: str, side: str) -> tuple[str, str]:
    low, colon, high = (part.strip() for part in side.partition(":"))
    if not (low and colon and high):
        raise typer.BadParameter(f"the box of '{name}' is not low:high, as in --box {name}=-1:1")
    return low, high
