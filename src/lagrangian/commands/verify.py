"""``lagrangian verify``: the equations checked by independent routes."""

from __future__ import annotations

import sys
from typing import Annotated

import typer

from lagrangian import write
from lagrangian.analyze.verify.report import verification_report
from lagrangian.commands.terminal import Example, OptionalFile, open_system


def verify(
    file: OptionalFile = None,
    example: Example = None,
    states: Annotated[int, typer.Option(help="Random states to compare at.", min=1, max=100_000)] = 100,
    seed: Annotated[int, typer.Option(help="Which random states.")] = 1,
) -> None:
    """Check the equations, the compiled code, its exports and the linearization; exit 1 if a check fails."""
    system = open_system(file, example)
    checks = system.verify(states=states, seed=seed)
    sys.stdout.write(write.write_report(verification_report(system.model, checks)))
    if any(check.holds is False for check in checks):
        raise typer.Exit(1)
