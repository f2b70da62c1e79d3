"""What the verbs that search share, `fit` and `optimize`: their unknowns, their limits, and how they end."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated, Any

import typer

from lagrangian.cli.terminal import COMPUTING, INTEGRATION

if TYPE_CHECKING:
    from lagrangian.page.formula import Check

Unknowns = Annotated[
    list[str],
    typer.Argument(
        metavar="FILE UNKNOWNS",
        help="A model file (- is standard input; leave it out with --example), then the unknowns: parameters, states "
        'for their initial values, inputs; with a first guess or without: L, k=80, "theta=30 deg".',
        show_default=False,
    ),
]
Bounds = Annotated[
    list[str] | None,
    typer.Option(
        "--bounds",
        metavar="NAME=LOW:HIGH",
        help='Range of an unknown: k=10:200, "L=10 cm : 1 m". Repeatable.',
        show_default=False,
    ),
]
Rtol = Annotated[
    float | None,
    typer.Option(
        metavar="NUMBER", help="Relative tolerance of the runs, by default 1e-8.", rich_help_panel=INTEGRATION
    ),
]
Atol = Annotated[
    float | None,
    typer.Option(
        metavar="NUMBER", help="Absolute tolerance of the runs, by default 1e-11.", rich_help_panel=INTEGRATION
    ),
]
MaxEvaluations = Annotated[
    int, typer.Option(metavar="N", help="Stop the search after this many runs.", rich_help_panel=COMPUTING)
]


def given_options(**options: Any) -> dict[str, Any]:
    """The options that were given."""
    return {name: value for name, value in options.items() if value is not None}


def concluded(success: bool, checks: Sequence[Check]) -> None:
    """Exit with 1 if a search did not end at a minimum, or if a check of what it found fails."""
    if not success or any(check.holds is False for check in checks):
        raise typer.Exit(1)
