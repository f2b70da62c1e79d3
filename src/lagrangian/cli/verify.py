"""``lagrangian verify``: check the equations and the code by independent routes."""

from __future__ import annotations

from typing import Annotated

import typer

from lagrangian.cli.formats import FormatOption, chosen, put_report
from lagrangian.cli.terminal import Example, Force, Json, OptionalFile, Output, Width, open_system


def verify(
    file: OptionalFile = None,
    example: Example = None,
    states: Annotated[
        int, typer.Option(metavar="N", help="Number of random states at which to compare.", min=1, max=100_000)
    ] = 100,
    seed: Annotated[int, typer.Option(metavar="N", help="Seed of the random states.")] = 1,
    exports: Annotated[
        bool,
        typer.Option(
            "--exports",
            help="Also run exports in Octave and other programs that are installed, hold a run and its files, a "
            "sweep's store, the picture and an animation, and read the printed page back.",
        ),
    ] = False,
    format: FormatOption = None,
    json: Json = False,
    width: Width = None,
    output: Output = None,
    force: Force = False,
) -> None:
    """Check the equations, the compiled code, its exports and the linearization; exit 1 if a check fails.

    \b
    Examples:
      lagrangian verify carts.toml
      lagrangian verify --example double-pendulum --states 1000
      lagrangian verify carts.toml --exports
      lagrangian verify carts.toml --json
    """
    wanted = chosen(format, json, output, force)
    from lagrangian.verify.report import verification_report

    system = open_system(file, example)
    checks = system.verify(states=states, seed=seed, exports=exports)
    put_report(verification_report(system.model, checks, exports=exports), wanted, width, output)
    if any(check.holds is False for check in checks):
        raise typer.Exit(1)
