"""``lagrangian sweep``: simulate all combinations of values and random draws."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from lagrangian.cli.assignments import assignments, names
from lagrangian.cli.door import StandardOutput, ask, put, say
from lagrangian.cli.formats import as_json
from lagrangian.cli.progress import status
from lagrangian.cli.simulate import PICTURES, integration_options, save_plot
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
    JsonSummary,
    MaxStep,
    MaxSteps,
    Parameters,
    Plot,
    Rtol,
    Step,
    file_and_rest,
    open_system,
    output_option,
)
from lagrangian.cli.wording import in_options
from lagrangian.errors import Error
from lagrangian.integrate.method_names import MACHINE
from lagrangian.interrupts import interrupts

if TYPE_CHECKING:
    from lagrangian.integrate.estimate import SweepEstimate
    from lagrangian.simulate.ensemble import Ensemble

STORE = ".zarr"
LISTED = 10
"""The number of failures that are listed."""


FileAndValues = Annotated[
    list[str],
    typer.Argument(
        metavar="FILE VALUES",
        help="A model file (- is standard input; leave it out with --example), then what varies: k=10:80:50, "
        "k=1:80:20:log, m2=1kg,2kg, 'b~normal(1, 0.1)'.",
        show_default=False,
    ),
]
OutputsOf = Annotated[
    list[str] | None,
    typer.Option(
        "--output-of",
        metavar="WHAT",
        help="What to keep of each run: the final (if no word is given), max, min, mean, rms or range of an "
        'expression: "max theta1", "rms x-y", "reach=max L1*sin(theta1)". Repeatable.',
    ),
]
Inputs = Annotated[
    list[str] | None,
    typer.Option("--input", "-i", metavar="NAME=VALUE", help='An input: "tau=3*sin(t)". Repeatable.'),
]
Draws = Annotated[
    int | None, typer.Option(metavar="N", help="Number of random draws, if anything is drawn.", show_default=False)
]
Seed = Annotated[int, typer.Option(metavar="N", help="Seed of the random draws.")]
Results = Annotated[
    str | None,
    output_option(
        "Write results to this file (.nc, .csv, .parquet) or .zarr store, which may be in object storage "
        "(s3://bucket/a.zarr); - writes CSV to standard output."
    ),
]
Resume = Annotated[
    bool,
    typer.Option("--resume", help="Continue an interrupted sweep in its .zarr store.", rich_help_panel=OUTPUT),
]
Method = Annotated[str, typer.Option(metavar="NAME", help=f"One of {', '.join(MACHINE)}.", rich_help_panel=INTEGRATION)]
Times = Annotated[
    int,
    typer.Option(
        metavar="N",
        help="Number of evenly spaced times that max, mean, … are taken over.",
        min=2,
        rich_help_panel=INTEGRATION,
    ),
]
Threads = Annotated[
    int | None, typer.Option(metavar="N", help="Cores to use; all by default.", min=1, rich_help_panel=COMPUTING)
]
Memory = Annotated[int, typer.Option(metavar="MIB", help="Memory for trajectories.", min=1, rich_help_panel=COMPUTING)]
Estimated = Annotated[
    bool,
    typer.Option(
        "--estimate",
        help="Simulate a few runs and say how long all will take and how large the results will be; on a terminal, "
        "then ask whether to go on, elsewhere do no more.",
        rich_help_panel=COMPUTING,
    ),
]
Scheduler = Annotated[
    str | None,
    typer.Option(
        metavar="ADDRESS",
        help="Address of a Dask scheduler: tcp://host:8786.",
        show_default=False,
        rich_help_panel=COMPUTING,
    ),
]


def sweep(
    given: FileAndValues,
    example: Example = None,
    duration: Duration = None,
    outputs: OutputsOf = None,
    initial: Initial = None,
    fixed: Fixed = None,
    values: Parameters = None,
    inputs: Inputs = None,
    draws: Draws = None,
    seed: Seed = 0,
    output: Results = None,
    plot: Plot = None,
    resume: Resume = False,
    json: JsonSummary = False,
    force: Force = False,
    method: Method = "dop853",
    step: Step = None,
    rtol: Rtol = None,
    atol: Atol = None,
    max_step: MaxStep = None,
    times: Times = 1001,
    max_steps: MaxSteps = 10_000_000,
    threads: Threads = None,
    memory: Memory = 256,
    scheduler: Scheduler = None,
    estimate: Estimated = False,
) -> None:
    """Simulate every combination of values and keep a few numbers of each run; exit 1 if all runs fail.

    \b
    Examples:
      lagrangian sweep carts.toml k=10:100:50 m2=1:3:20 -d 10 -o sweep.nc
      lagrangian sweep cart.toml 'm~normal(0.2, 0.02)' --draws 1000 -o sweep.zarr
      lagrangian sweep carts.toml k=10:100:50 --output-of "max x1" --json
    """
    file, grid = file_and_rest(given, example, "=" in given[0])
    _check_targets(output, plot, resume, force)
    system = open_system(file, example)
    with _unless_declined():
        runs = system.sweep(
            duration,
            grid,
            initial=assignments(initial, "--init"),
            fixed=names(fixed) if fixed else None,
            params=assignments(values, "--set"),
            inputs=assignments(inputs, "--input"),
            draws=draws,
            seed=seed,
            outputs=_outputs(outputs),
            times=times,
            **integration_options(method, step, rtol, atol, max_step, max_steps),
            **_executing(memory, threads, scheduler, estimate),
            **_store_options(output, resume, force),
        )
    interrupts.advice = ""
    _put(runs, output, force, json)
    save_plot(runs, plot)
    if runs.status.size and (runs.status < 0).all():
        raise typer.Exit(1)


def _executing(memory: int, threads: int | None, scheduler: str | None, estimate: bool) -> dict[str, Any]:
    """Return the options that say how runs are computed."""
    return {
        "memory": memory * 2**20,
        "threads": threads,
        "scheduler": scheduler,
        "progress": status.counted("runs"),
        "confirm": _go_on if estimate else None,
    }


def _go_on(estimate: SweepEstimate) -> bool:
    """Say what the sweep will take; on a terminal, ask whether to go on."""
    with status.aside():
        answer = ask(f"{estimate}: go on? [y/N] ")
        if answer is None:
            put(str(estimate))
        return answer in ("y", "yes")


@contextlib.contextmanager
def _unless_declined() -> Iterator[None]:
    """End the command with status 0 if the user does not want the sweep."""
    from lagrangian.integrate.estimate import NotStarted

    try:
        yield
    except NotStarted:
        raise typer.Exit(0) from None


def _is_store(output: str | None) -> bool:
    return output is not None and Path(output).suffix == STORE


def _store_options(output: str | None, resume: bool, force: bool) -> dict[str, Any]:
    """Return the options of a sweep that is stored as it is computed, and say how one that is interrupted goes on."""
    if not _is_store(output):
        return {}
    interrupts.advice = f"finished results stay in {output}: continue with --resume"
    return {"store": output, "resume": resume, "overwrite": force and not resume}


def _check_targets(output: str | None, plot: Path | None, resume: bool, force: bool) -> None:
    """Raise `Error`, before anything is computed, if a file cannot be written, or cannot be resumed."""
    from lagrangian.simulate.ensemble import ENDINGS
    from lagrangian.write.tables import check_target

    if output is not None and not _is_store(output) and output != "-":
        if resume:
            raise Error("only a .zarr store can be resumed", fix="-o sweep.zarr --resume", code="E802")
        check_target(Path(output), [STORE, *ENDINGS], overwrite=force)
    if plot is not None:
        check_target(plot, PICTURES, overwrite=force)
    if output is None and resume:
        raise Error("--resume continues a .zarr store, but -o names none", fix="-o sweep.zarr --resume", code="E401")


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


def _put(runs: Ensemble, output: str | None, force: bool, json: bool) -> None:
    from lagrangian.cli.sweep_summary import figures, summary
    from lagrangian.simulate.ensemble import write_csv

    piped = output is not None and output == "-"
    if output is not None and not piped and not _is_store(output):
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
    if output is not None and output != "-":
        say(f"wrote {output}: {runs.count} runs")
