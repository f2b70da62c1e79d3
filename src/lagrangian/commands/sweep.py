"""``lagrangian sweep``: many runs, over every combination of values and over draws."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

from lagrangian.commands.assignments import assignments
from lagrangian.commands.simulate import PICTURES
from lagrangian.commands.terminal import Example, open_system, say
from lagrangian.commands.wording import advising_options
from lagrangian.running.ensemble import ENDINGS, Ensemble, write_csv
from lagrangian.simulate.ensemble import Progress
from lagrangian.write.files import write_with
from lagrangian.write.tables import check_target

STORE = ".zarr"
LISTED = 10
"""Failures that are told."""


def sweep(
    given: Annotated[
        list[str],
        typer.Argument(
            metavar="FILE VALUES",
            help="A model file (- is standard input; none with --example), then what varies: k=10:80:50, "
            "k=1:80:20:log, m2=1kg,2kg, 'b~normal(1, 0.1)'.",
            show_default=False,
        ),
    ],
    example: Example = None,
    duration: Annotated[
        str | None, typer.Option("--duration", "-d", help='How long to run: 10, "500 ms".', show_default=False)
    ] = None,
    samples: Annotated[int | None, typer.Option(help="How often to draw what is drawn.", show_default=False)] = None,
    seed: Annotated[int, typer.Option(help="Which draws.")] = 0,
    outputs: Annotated[
        list[str] | None,
        typer.Option(
            "--output-of",
            help='What is kept of a run: "max theta1", "rms x-y", "reach=max L1*sin(theta1)"; final without a word.',
            show_default=False,
        ),
    ] = None,
    values: Annotated[list[str] | None, typer.Option("--set", help="A parameter of all runs: k=80.")] = None,
    initial: Annotated[
        list[str] | None, typer.Option("--init", help='An initial value of all: "theta1=30 deg".')
    ] = None,
    inputs: Annotated[list[str] | None, typer.Option("--input", help='An input of all: "tau=3*sin(t)".')] = None,
    times: Annotated[int, typer.Option(help="Times at which a run is looked at.", min=2)] = 1001,
    method: Annotated[str, typer.Option(help="How runs are integrated.")] = "dop853",
    step: Annotated[str | None, typer.Option(help="Step of a method with fixed steps.", show_default=False)] = None,
    max_step: Annotated[
        str | None, typer.Option("--max-step", help="The longest step: 0.01, '10 ms'.", show_default=False)
    ] = None,
    rtol: Annotated[float, typer.Option(help="Relative tolerance.")] = 1e-9,
    atol: Annotated[float, typer.Option(help="Absolute tolerance.")] = 1e-12,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="A .zarr store, .nc, .csv or .parquet; - is CSV to standard output."),
    ] = None,
    plot: Annotated[
        Path | None, typer.Option("--plot", help="Draw a picture: .png, .pdf or .svg.", show_default=False)
    ] = None,
    resume: Annotated[bool, typer.Option("--resume", help="Go on with a .zarr store where it stopped.")] = False,
    force: Annotated[bool, typer.Option("--force", help="Replace what is there.")] = False,
    scheduler: Annotated[
        str | None, typer.Option(help="Address of a Dask scheduler: tcp://host:8786.", show_default=False)
    ] = None,
    threads: Annotated[int | None, typer.Option(help="Cores to use; all unless given.", min=1)] = None,
    memory: Annotated[int, typer.Option(help="MiB of trajectories held at a time.", min=1)] = 256,
) -> None:
    """Run every combination of values, each for every draw; keep a few numbers of each run. Exit 1 if all runs fail."""
    if example is None and "=" in given[0]:
        raise typer.BadParameter(f"'{given[0]}' is no model file: name one first, or --example NAME")
    file, grid = (None, given) if example is not None else (given[0], given[1:])
    stored = output is not None and output.suffix == STORE
    if output is not None and not stored and str(output) != "-":
        if resume:
            raise typer.BadParameter("only a .zarr store can be resumed: -o sweep.zarr --resume")
        check_target(output, [STORE, *ENDINGS], overwrite=force)
    if plot is not None:
        check_target(plot, PICTURES, overwrite=force)
    if output is None and resume:
        raise typer.BadParameter("--resume goes with -o sweep.zarr")
    system = open_system(file, example)
    options: dict[str, Any] = {"method": method, "rtol": rtol, "atol": atol, "times": times, "threads": threads}
    if stored:
        options |= {"store": output, "resume": resume, "overwrite": force}
    if step is not None:
        options["step"] = step
    if max_step is not None:
        options["max_step"] = max_step
    with advising_options(), _progress() as progress, _interruptible(output if stored else None):
        runs = system.sweep(
            duration,
            grid,
            initial=assignments(initial, "--init"),
            params=assignments(values, "--set"),
            inputs=assignments(inputs, "--input"),
            samples=samples,
            seed=seed,
            outputs=_outputs(outputs),
            memory=memory * 2**20,
            scheduler=scheduler,
            progress=progress,
            **options,
        )
    _put(runs, output, stored, force)
    if plot is not None:
        figure, kind = runs.plot(), plot.suffix.lower().removeprefix(".")
        write_with(plot, lambda beside: figure.savefig(beside, format=kind, dpi=150))
        say(f"wrote {plot}")
    if runs.status.size and (runs.status < 0).all():
        raise typer.Exit(1)


def _outputs(given: list[str] | None) -> dict[str, str] | None:
    """Name → what is kept; what has no name is called after itself."""
    if not given:
        return None
    found: dict[str, str] = {}
    for item in given:
        name, equals, asked = item.partition("=")
        key = name.strip() if equals and name.strip().isidentifier() else item.strip()
        if key in found:
            raise typer.BadParameter(f"'{key}' is asked for twice with --output-of")
        found[key] = asked.strip() if key != item.strip() else item.strip()
    return found


@contextlib.contextmanager
def _progress() -> Iterator[Progress | None]:
    """A bar on a terminal, nothing in a pipe."""
    if not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (TextColumn("runs"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("runs", total=None)
        yield lambda done, count: bar.update(task, completed=done, total=count)


@contextlib.contextmanager
def _interruptible(store: Path | None) -> Iterator[None]:
    try:
        yield
    except KeyboardInterrupt:
        say("interrupted" + ("" if store is None else f"; what is done stays in {store}: go on with --resume"))
        raise typer.Exit(130) from None


def _put(runs: Ensemble, output: Path | None, stored: bool, force: bool) -> None:
    if output is not None and str(output) == "-":
        write_csv(runs, sys.stdout)
    elif output is None:
        sys.stdout.write(summary(runs))
    elif not stored:
        runs.save(output, overwrite=force)
    for notice in runs.notices:
        say(notice)
    failures = runs.failures(LISTED)
    if failures:
        count = int((runs.status < 0).sum())
        say(f"{count} of {runs.count} runs failed" + (f"; the first {LISTED}:" if count > LISTED else ":"))
        for failure in failures:
            say(f"  {failure}")
    if output is not None and str(output) != "-":
        say(f"wrote {output}: {runs.count} runs")


def summary(runs: Ensemble) -> str:
    """What came of the runs, in a few lines: of each result the least, the mean and the greatest, and where."""
    axes = " × ".join(f"{d} ({n})" for d, n in zip(runs.dims, runs.shape, strict=True))
    lines = [f"{runs.name}: {runs.count} runs, {axes}, {runs.settings['method']}"]
    lines += [f"  {n}: {words}" for words, n in runs.counts.items()]
    rows: list[list[str]] = [["", "least", "mean", "greatest", "where"]]
    for name in runs:
        values = runs[name]
        if name in ("status", "reached") or not np.isfinite(values).any():
            continue
        place = np.unravel_index(int(np.nanargmax(values)), values.shape)[: len(runs.shape)]
        where = ", ".join(f"{n} = {x:.6g}" for n, x in runs.at(tuple(int(k) for k in place)).items())
        figures = [f"{f(values):.6g}" for f in (np.nanmin, np.nanmean, np.nanmax)]
        rows.append([name, *figures, where])
    widths = [max(len(row[k]) for row in rows) for k in range(4)]
    for first, *figures, where in rows:
        shown = [figure.rjust(width) for figure, width in zip(figures, widths[1:], strict=True)]
        lines.append("  ".join([first.ljust(widths[0]), *shown, where]).rstrip())
    return "\n".join(lines) + "\n"
