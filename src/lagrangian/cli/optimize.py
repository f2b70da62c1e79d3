"""``lagrangian optimize``: the parameters, initial values and inputs that make a run best."""

from __future__ import annotations

from typing import Annotated

import typer

from lagrangian.cli.assignments import assignments, guesses, ranges
from lagrangian.cli.formats import FormatOption, chosen, put_report
from lagrangian.cli.searching import Atol, Bounds, MaxEvaluations, Rtol, Unknowns, concluded, given_options
from lagrangian.cli.simulate import Method, Timeout, input_signal, save_plot
from lagrangian.cli.terminal import (
    COMPUTING,
    Duration,
    Example,
    Force,
    Initial,
    InputSignals,
    Json,
    Output,
    Parameters,
    Plot,
    Step,
    Width,
    file_and_rest,
    open_system,
)

Final = Annotated[
    str | None,
    typer.Option(metavar="EXPRESSION", help='Cost at the end of the run: "(x - 1)^2".', show_default=False),
]
Integral = Annotated[
    str | None,
    typer.Option(
        metavar="EXPRESSION", help='Cost that is integrated along the run: "F^2 + 10*theta^2".', show_default=False
    ),
]
Reach = Annotated[
    list[str] | None,
    typer.Option(
        "--reach",
        metavar="WHAT=VALUE",
        help='What an expression must be at the end: theta=0, "x\'=0". Repeatable.',
        show_default=False,
    ),
]
Tolerance = Annotated[
    float,
    typer.Option(
        metavar="NUMBER",
        help="The search ends when a step improves the cost by less than this fraction.",
        rich_help_panel=COMPUTING,
    ),
]


def optimize(
    given: Unknowns,
    example: Example = None,
    duration: Duration = None,
    final: Final = None,
    integral: Integral = None,
    reach: Reach = None,
    bounds: Bounds = None,
    initial: Initial = None,
    values: Parameters = None,
    inputs: InputSignals = None,
    format: FormatOption = None,
    json: Json = False,
    width: Width = None,
    output: Output = None,
    plot: Plot = None,
    force: Force = False,
    method: Method = None,
    step: Step = None,
    rtol: Rtol = None,
    atol: Atol = None,
    tolerance: Tolerance = 1e-9,
    max_evaluations: MaxEvaluations = 500,
    timeout: Timeout = None,
) -> None:
    """Find the parameters, initial values and inputs that make a run best; exit 1 if the search finds no minimum.

    \b
    Examples:
      lagrangian optimize car.toml k b --integral "acc^2" -d 10 --bounds b=0:500
      lagrangian optimize cart.toml F -d 1 --integral "F^2" --reach x=1 -i F=0
      lagrangian optimize cart.toml F -i F=@first.csv -d 2 --final "x^2" --json
    """
    from lagrangian.cli.simulate import PICTURES
    from lagrangian.write.tables import check_target

    wanted = chosen(format, json, output, force)
    if plot is not None:
        check_target(plot, list(PICTURES), overwrite=force)
    file, unknowns = file_and_rest(given, example, "=" in given[0])
    found = open_system(file, example).optimize(
        guesses(unknowns),
        duration,
        final=final,
        integral=integral,
        reach=assignments(reach, "--reach"),
        bounds=ranges(bounds, "--bounds"),
        initial=assignments(initial, "--init"),
        params=assignments(values, "--set"),
        inputs={name: input_signal(name, value) for name, value in assignments(inputs, "--input").items()},
        **given_options(method=method, step=step, rtol=rtol, atol=atol, timeout=timeout),
        tolerance=tolerance,
        max_evaluations=max_evaluations,
    )
    save_plot(found.run, plot)
    put_report(found.report(), wanted, width, output)
    concluded(found.success, found.checks)
