"""``lagrangian linearize``: A, B, C, D about a point, with poles, modes and stability."""

from __future__ import annotations

from typing import Annotated

import typer

from lagrangian.cli.assignments import point
from lagrangian.cli.formats import FormatOption, chosen, put_report
from lagrangian.cli.terminal import (
    AtPoint,
    ConstantInputs,
    Example,
    FixedAtPoint,
    Force,
    Json,
    OptionalFile,
    Output,
    Parameters,
    Width,
    open_system,
)


def linearize(
    file: OptionalFile = None,
    example: Example = None,
    at: AtPoint = None,
    values: Parameters = None,
    inputs: ConstantInputs = None,
    outputs: Annotated[
        list[str] | None,
        typer.Option(
            "--output-of", metavar="EXPRESSION", help="An output y: an expression, or name=expression. Repeatable."
        ),
    ] = None,
    operating_point: Annotated[
        bool, typer.Option("--operating-point", help="Linearize even if the point is not an equilibrium.")
    ] = False,
    fixed: FixedAtPoint = None,
    symbols: Annotated[
        bool, typer.Option("--symbols", help="Add the matrices with the parameters as symbols.")
    ] = False,
    format: FormatOption = None,
    json: Json = False,
    width: Width = None,
    output: Output = None,
    force: Force = False,
) -> None:
    """Linearize about an equilibrium: A, B, C, D, poles, modes, stability.

    \b
    Examples:
      lagrangian linearize --example cart-pole
      lagrangian linearize cart.toml -s M=2 --output-of "tip=x + l*sin(theta)"
      lagrangian linearize cart.toml --symbols -o cart.html
    """
    wanted = chosen(format, json, output, force)
    found = open_system(file, example).linearize(
        **point(at, values, inputs, fixed), outputs=_outputs(outputs), operating_point=operating_point
    )
    put_report(found.report(symbols=symbols), wanted, width, output)


def _outputs(given: list[str] | None) -> dict[str, str] | None:
    """Name → expression; an expression without a name is its own name."""
    if not given:
        return None
    named = (item.partition("=") for item in given)
    return {left.strip(): (right if equals else left).strip() for left, equals, right in named}
