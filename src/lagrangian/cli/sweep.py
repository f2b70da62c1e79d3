"""``lagrangian sweep``: simulate all combinations of values and random draws."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from lagrangian.cli.assignments import assignments
from lagrangian.cli.door import StandardOutput, put, say
from lagrangian.cli.formats import as_json
from lagrangian.cli.progress import status
from lagrangian.cli.simulate import PICTURES
from lagrangian.cli.sweep_summary import figures, summary
from lagrangian.cli.terminal import (
    COMPUTING,
    INTEGRATION,
    OUTPUT,
    Atol,
    Duration,
    Example,
    Fixed,
    Force,
    Initial,
    MaxStep,
    MaxSteps,
    Parameters,
    Plot,
    Rtol,
    Step,
    open_system,
)
from lagrangian.cli.wording import in_options
from lagrangian.errors import Error
from lagrangian.integrate import METHODS
from lagrangian.interrupts import interrupts
from lagrangian.simulate.ensemble import ENDINGS, Ensemble, write_csv
from lagrangian.write.files import write_with
from lagrangian.write.tables import check_target

STORE = ".zarr"
LISTED = 10
"""The number of failures that are listed."""


def sweep(
    given: Annotated[
        list[str],
        typer.Argument(
            metavar="FILE VALUES",
            help="A model file (- is standard input; leave it out with --example), then what varies: k=10:80:50, "
            "k=1:80:20:log, m2=1kg,2kg, 'b~normal(1, 0.1)'.",
            show_default=False,
        ),
    ],
    example: Example = None,
    duration: Duration = None,
    outputs: Annotated[
        list[str] | None,
        typer.Option(
            "--output-of",
            metavar="WHAT",
            help="What to keep of each run: the final (if no word is given), max, min, mean, rms or range of an "
            'expression: "max theta1", "rms x-y", "reach=max L1*sin(theta1)". Repeatable.',
        ),
    ] = None,
    initial: Initial = None,
    fixed: Fixed = None,
    values: Parameters = None,
    inputs: Annotated[
        list[str] | None,
        typer.Option("--input", "-i", metavar="NAME=VALUE", help='An input: "tau=3*sin(t)". Repeatable.'),
    ] = None,
    draws: Annotated[
        int | None, typer.Option(metavar="N", help="Number of random draws, if anything is drawn.", show_default=False)
    ] = None,
    seed: Annotated[int, typer.Option(metavar="N", help="Seed of the random draws.")] = 0,
    output: Annotated[
        Path | None,
        typer.Option(
            "--output",
            "-o",
            metavar="PATH",
            help="Write results to this file (.nc, .csv, .parquet) or .zarr store; - writes CSV to standard output.",
            rich_help_panel=OUTPUT,
        ),
    ] = None,
    plot: Plot = None,
    resume: Annotated[
        bool,
        typer.Option("--resume", help="Continue an interrupted sweep in its .zarr store.", rich_help_panel=OUTPUT),
    ] = False,
    json: Annotated[bool, typer.Option("--json", help="Write the summary as JSON.", rich_help_panel=OUTPUT)] = False,
    force: Force = False,
    method: Annotated[
        str, typer.Option(metavar="NAME", help=f"One of {', '.join(METHODS)}.", rich_help_panel=INTEGRATION)
    ] = "dop853",
    step: Step = None,
    rtol: Rtol = 1e-9,
    atol: Atol = 1e-12,
    max_step: MaxStep = None,
    times: Annotated[
        int,
        typer.Option(
            metavar="N",
            help="Number of evenly spaced times that max, mean, … are taken over.",
            min=2,
            rich_help_panel=INTEGRATION,
        ),
    ] = 1001,
    max_steps: MaxSteps = 10_000_000,
    threads: Annotated[
        int | None, typer.Option(metavar="N", help="Cores to use; all by default.", min=1, rich_help_panel=COMPUTING)
    ] = None,
    memory: Annotated[
        int, typer.Option(metavar="MIB", help="Memory for trajectories.", min=1, rich_help_panel=COMPUTING)
    ] = 256,
    scheduler: Annotated[
        str | None,
        typer.Option(
            metavar="ADDRESS",
            help="Address of a Dask scheduler: tcp://host:8786.",
            show_default=False,
            rich_help_panel=COMPUTING,
        ),
    ] = None,
) -> None:
    """Simulate every combination of values and keep a few numbers of each run; exit 1 if all runs fail.

    \b
    Examples:
      lagrangian sweep carts.toml k=10:100:50 m2=1:3:20 -d 10 -o sweep.nc
      lagrangian sweep cart.toml 'm~normal(0.2, 0.02)' --draws 1000 --output-of "max x" -o sweep.zarr
      lagrangian sweep carts.toml k=10:100:50 -d 10 --json
    """
    if example is None and "=" in given[0]:
        fix = "name a model file first, or a built-in example with --example NAME"
        raise Error(f"'{given[0]}' is not a model file", fix=fix, code="E401")
    file, grid = (None, given) if example is not None else (given[0], given[1:])
    stored = output is not None and output.suffix == STORE
    if output is not None and not stored and str(output) != "-":
        if resume:
            raise Error("only a .zarr store can be resumed", fix="-o sweep.zarr --resume", code="E802")
        check_target(output, [STORE, *ENDINGS], overwrite=force)
    if plot is not None:
        check_target(plot, PICTURES, overwrite=force)
    if output is None and resume:
        raise Error("--resume continues a .zarr store, but -o names none", fix="-o sweep.zarr --resume", code="E401")
    system = open_system(file, example)
    options: dict[str, Any] = {"method": method, "rtol": rtol, "atol": atol, "times": times, "threads": threads}
    options["max_steps"] = max_steps
    if stored:
        options |= {"store": output, "resume": resume, "overwrite": force}
    if step is not None:
        options["step"] = step
    if max_step is not None:
        options["max_step"] = max_step
    if stored:
        interrupts.advice = f"finished results stay in {output}: continue with --resume"
    runs = system.sweep(
        duration,
        grid,
        initial=assignments(initial, "--init"),
        fixed=fixed,
        params=assignments(values, "--set"),
        inputs=assignments(inputs, "--input"),
        draws=draws,
        seed=seed,
        outputs=_outputs(outputs),
        memory=memory * 2**20,
        scheduler=scheduler,
        progress=status.counted("runs"),
        **options,
    )
    interrupts.advice = ""
    _put(runs, output, stored, force, json)
    if plot is not None:
        figure, kind = runs.figure(), plot.suffix.lower().removeprefix(".")
        write_with(plot, lambda beside: figure.savefig(beside, format=kind, dpi=150))
        say(f"wrote {plot}")
    if runs.status.size and (runs.status < 0).all():
        raise typer.Exit(1)


def _outputs(given: list[str] | None) -> dict[str, str] | None:
    """Name → expression and reduction; an output without a name is its own name."""
    if not given:
        return None
    found: dict[str, str] = {}
    for item in given:
        name, equals, asked = item.partition("=")
        key = name.strip() if equals and name.strip().isidentifier() else item.strip()
        if key in found:
            raise Error(f"'{key}' is given twice with --output-of", fix="give only one of the two", code="E404")
        found[key] = asked.strip() if key != item.strip() else item.strip()
    return found


def _put(runs: Ensemble, output: Path | None, stored: bool, force: bool, json: bool) -> None:
    piped = output is not None and str(output) == "-"
    if output is not None and not piped and not stored:
        runs.save(output, overwrite=force)
    if piped:
        write_csv(runs, StandardOutput())
    elif json:
        put(as_json(figures(runs)))
    elif output is None:
        put(summary(runs))
    for notice in runs.notices:
        say(f"note: {in_options(notice)}")
    failures = runs.failures(LISTED)
    if failures:
        count = int((runs.status < 0).sum())
        say(f"{count} of {runs.count} runs failed" + (f"; the first {LISTED}:" if count > LISTED else ":"))
        for failure in failures:
            say(f"  {failure}")
    if output is not None and str(output) != "-":
        say(f"wrote {output}: {runs.count} runs")
