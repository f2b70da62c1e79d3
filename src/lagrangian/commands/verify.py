"""``lagrangian verify``: the equations checked by independent routes."""

from __future__ import annotations

import sys
from dataclasses import replace
from typing import Annotated

import typer

from lagrangian import write
from lagrangian.analyze.motion import verify_motion
from lagrangian.commands.terminal import Example, OptionalFile, open_system


def verify(
    file: OptionalFile = None,
    example: Example = None,
    states: Annotated[int, typer.Option(help="Random states to compare at.", min=1, max=100_000)] = 100,
    seed: Annotated[int, typer.Option(help="Which random states.")] = 1,
) -> None:
    """Check the equations by independent routes; exit 1 if one does not hold."""
    system = open_system(file, example)
    if system.model.floating:  # nothing can be derived: the programs are checked
        report = verify_motion(system.model, states=states, seed=seed)
        sys.stdout.write(write.write_report(report))
        if not all(check.holds for part in report.parts for check in part.checks):
            raise typer.Exit(1)
        return
    derivation = system.derive()
    verified = replace(derivation, verified=derivation.verify(states=states, seed=seed))
    sys.stdout.write(write.verdicts(verified))
    if not all(check.holds for check in verified.verified):
        raise typer.Exit(1)
