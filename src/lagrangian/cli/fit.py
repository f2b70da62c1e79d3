"""``lagrangian fit``: the parameters and initial values whose runs fit measured data."""

from __future__ import annotations

import re
from typing import Annotated, Any

import typer

from lagrangian.cli.assignments import assignments, guesses, names, ranges
from lagrangian.cli.formats import FormatOption, chosen, put_report
from lagrangian.cli.searching import Atol, Bounds, MaxEvaluations, Rtol, Unknowns, concluded, given_options
from lagrangian.cli.simulate import Method, Timeout, input_signal
from lagrangian.cli.table_files import named_columns
from lagrangian.cli.terminal import (
    INTEGRATION,
    Example,
    Force,
    Initial,
    InputSignals,
    Json,
    Output,
    Parameters,
    Step,
    Width,
    file_and_rest,
    open_system,
)
from lagrangian.errors import Error

Data = Annotated[
    list[str] | None,
    typer.Option(
        "--data",
        metavar="TABLE",
        help="A CSV file of measured data: its first line has t and names or expressions, with units if not SI: "
        "t, theta [deg], x'. Empty cells are samples that are missing. Repeatable: one run each.",
        show_default=False,
    ),
]
Columns = Annotated[
    list[str] | None,
    typer.Option(
        "--columns",
        metavar="NAME[,NAME]",
        help="The columns to fit; all by default. Repeatable.",
        show_default=False,
    ),
]
Sigma = Annotated[
    list[str] | None,
    typer.Option(
        "--sigma",
        metavar="[NAME=]VALUE",
        help="Standard deviation of the noise: 0.02 for all columns, or theta=0.02 for one. Estimated if not given. "
        "Repeatable.",
        show_default=False,
    ),
]
Start = Annotated[
    str | None,
    typer.Option(
        metavar="TIME",
        help="When the runs begin; by default at their first time.",
        show_default=False,
        rich_help_panel=INTEGRATION,
    ),
]


def fit(
    given: Unknowns,
    example: Example = None,
    data: Data = None,
    columns: Columns = None,
    sigma: Sigma = None,
    bounds: Bounds = None,
    initial: Initial = None,
    values: Parameters = None,
    inputs: InputSignals = None,
    format: FormatOption = None,
    json: Json = False,
    width: Width = None,
    output: Output = None,
    force: Force = False,
    start: Start = None,
    method: Method = None,
    step: Step = None,
    rtol: Rtol = None,
    atol: Atol = None,
    max_evaluations: MaxEvaluations = 500,
    timeout: Timeout = None,
) -> None:
    """Find the parameters and initial values whose runs fit measured data best; exit 1 if the search finds no minimum.

    \b
    Examples:
      lagrangian fit pendulum.toml L theta=0.5 --data swing.csv
      lagrangian fit carts.toml k=80 b --data a.csv --data b.csv --sigma 0.002
      lagrangian fit carts.toml k --data run.csv --columns x1,x2r --json
    """
    wanted = chosen(format, json, output, force)
    file, unknowns = file_and_rest(given, example, "=" in given[0])
    if not data:
        raise Error("no measured data were given", fix="--data swing.csv, with columns such as t,theta", code="E401")
    tables = [_asked(named_columns(path), names(columns), path) for path in data]
    found = open_system(file, example).fit(
        tables if len(tables) > 1 else tables[0],
        guesses(unknowns),
        initial=assignments(initial, "--init"),
        params=assignments(values, "--set"),
        inputs={name: input_signal(name, value) for name, value in assignments(inputs, "--input").items()},
        sigma=_sigma(sigma),
        bounds=ranges(bounds, "--bounds"),
        **given_options(start=start, method=method, step=step, rtol=rtol, atol=atol, timeout=timeout),
        max_evaluations=max_evaluations,
    )
    put_report(found.report(), wanted, width, output)
    concluded(found.success, found.checks)


def _asked(table: dict[str, Any], asked: list[str], path: str) -> dict[str, Any]:
    """The columns to fit, with the times."""
    if missing := [name for name in asked if name not in table]:
        there = ", ".join(table)
        raise Error(f"'{path}' has no column '{missing[0][:64]}'", fix=f"its columns are {there[:300]}", code="E402")
    dotted = [name for name in table if re.search(r"[^\W\d]\w*\.", name)]
    if dotted and not asked:
        kept = ",".join(name for name in table if name not in (*dotted, "t", "time")) or "theta"
        what = f"the column '{dotted[0][:64]}' of '{path}' is neither a name nor an expression"
        raise Error(what, fix=f"say which columns to fit: --columns {kept[:200]}", code="E402")
    return {name: x for name, x in table.items() if not asked or name in asked or name in ("t", "time")}


def _sigma(given: list[str] | None) -> Any:
    """One standard deviation for all columns, or one for each by name."""
    if not given:
        return None
    return given[0] if len(given) == 1 and "=" not in given[0] else assignments(given, "--sigma")
