"""``lagrangian simulate``: one run, with its summary, data and picture."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from lagrangian.cli.assignments import assignments, names
from lagrangian.cli.door import fail, put, say
from lagrangian.cli.formats import as_json
from lagrangian.cli.table_files import times_and_values
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
    InputSignals,
    JsonSummary,
    MaxStep,
    MaxSteps,
    OptionalFile,
    Parameters,
    Plot,
    Rtol,
    Step,
    open_system,
    output_option,
)
from lagrangian.cli.wording import in_options
from lagrangian.errors import Error
from lagrangian.integrate.method_names import MACHINE, SCIPY

if TYPE_CHECKING:
    from lagrangian.simulate.ensemble import Ensemble
    from lagrangian.simulate.trajectory import Trajectory

PICTURES = (".png", ".pdf", ".svg", ".jpg")

Results = Annotated[
    Path | None,
    output_option("Write the results to this file (.csv, .nc, .parquet, .npz); - writes CSV to standard output."),
]
Reactions = Annotated[
    list[str] | None,
    typer.Option(
        "--reactions",
        metavar="NAME[,NAME]",
        help="Add the forces and torques of joints to the results and the picture: constraints, points or bodies by "
        "name, or 'B on rod 1 in axes of rod 2'.",
        rich_help_panel=OUTPUT,
    ),
]
Samples = Annotated[
    int | None,
    typer.Option(
        metavar="N", help="Number of evenly spaced times in the results; 1001 by default.", rich_help_panel=OUTPUT
    ),
]
Method = Annotated[
    str | None,
    typer.Option(
        metavar="NAME",
        help=f"One of {', '.join(MACHINE)} (machine code; dop853 by default), {', '.join(SCIPY)} (SciPy).",
        rich_help_panel=INTEGRATION,
    ),
]
MaxEvents = Annotated[
    int, typer.Option(metavar="N", help="Stop the run after this many events.", rich_help_panel=COMPUTING)
]
Timeout = Annotated[
    float | None,
    typer.Option(metavar="SECONDS", help="Stop the run after this much computing time.", rich_help_panel=COMPUTING),
]


def simulate(
    file: OptionalFile = None,
    example: Example = None,
    duration: Duration = None,
    init: Initial = None,
    fixed: Fixed = None,
    set_: Parameters = None,
    input_: InputSignals = None,
    output: Results = None,
    reactions: Reactions = None,
    plot: Plot = None,
    samples: Samples = None,
    json: JsonSummary = False,
    force: Force = False,
    method: Method = None,
    step: Step = None,
    rtol: Rtol = None,
    atol: Atol = None,
    max_step: MaxStep = None,
    max_steps: MaxSteps = 10_000_000,
    max_events: MaxEvents = 100_000,
    timeout: Timeout = None,
) -> None:
    """Simulate the system and print a summary; exit 1 if the run stopped early (its results up to then are kept).

    \b
    Examples:
      lagrangian simulate --example double-pendulum --duration 10 --plot run.png
      lagrangian simulate carts.toml -d 10 --set k=80 --init "x2=0.4 m" -o run.csv
      lagrangian simulate cart.toml -d "500 ms" -i "F=3*sin(t)" --method taylor
    """
    from lagrangian import dynamics

    _check_targets(output, plot, force)
    system = open_system(file, example)
    asked = names(reactions)
    for name in asked:
        dynamics.check_joint(system.model, name)
    run = system.simulate(
        duration,
        **start_values(init, fixed, set_, input_),
        **integration_options(method, step, rtol, atol, max_step, max_steps),
        samples=samples,
        timeout=timeout,
        max_events=max_events,
    )
    if asked:
        run.reactions = asked
    save_plot(run, plot)
    _put(run, output, json, force)
    if run.audit.missed and run.success:
        say(f"note: {in_options(run.audit.missed)}")
    end(run)


def _check_targets(output: Path | None, plot: Path | None, force: bool) -> None:
    """Raise `Error`, before anything is computed, if the results or a picture cannot be written."""
    from lagrangian.write.tables import ENDINGS, check_target

    for path, endings in ((plot, PICTURES), (output, [*ENDINGS])):
        if path is not None and str(path) != "-":
            check_target(path, list(endings), overwrite=force)


def start_values(
    initial: list[str] | None, fixed: list[str] | None, parameters: list[str] | None, signals: list[str] | None
) -> dict[str, Any]:
    """Return what --init, --fixed, --set and --input say, as the options of `lagrangian.System.simulate`."""
    return {
        "initial": assignments(initial, "--init"),
        "fixed": names(fixed) if fixed else None,
        "params": assignments(parameters, "--set"),
        "inputs": {name: input_signal(name, value) for name, value in assignments(signals, "--input").items()},
    }


def integration_options(
    method: str | None,
    step: str | None,
    rtol: float | None,
    atol: float | None,
    max_step: str | None,
    max_steps: int,
) -> dict[str, Any]:
    """Return the options of the group Integration, as those of `lagrangian.System.simulate`."""
    longest = math.inf if max_step is None else max_step
    return {"method": method, "step": step, "rtol": rtol, "atol": atol, "max_step": longest, "max_steps": max_steps}


def save_plot(runs: Trajectory | Ensemble, path: Path | None) -> None:
    """Draw a picture of what was computed into a file, if one is named."""
    if path is None:
        return
    from lagrangian.write import write_with

    figure, kind = runs.figure(), path.suffix.lower().removeprefix(".")
    write_with(path, lambda beside: figure.savefig(beside, format=kind, dpi=150))
    say(f"wrote {path}")


def _put(run: Trajectory, output: Path | None, json: bool, force: bool) -> None:
    """Write the results into their file, and the summary or the results to standard output."""
    from lagrangian.cli.run_summary import figures, summary

    piped = output is not None and str(output) == "-"
    if output is not None and not piped:
        say(f"wrote {run.save(output, overwrite=force)}")
    put(run.to_csv() if piped else as_json(figures(run)) if json else summary(run))
    for notice in run.notices:
        say(f"note: {notice}")


def end(run: Trajectory) -> None:
    """Exit with 1 if a run stopped early, after the reason."""
    if not run.success:
        fail(in_options(run.message))
        raise typer.Exit(1)


def input_signal(name: str, value: str) -> Any:
    """Return an input as given, or read the table of ``@force.csv``, which has a time and a value on each line."""
    if not value.startswith("@"):
        return value
    path, _, kind = value[1:].strip().partition(" ")
    if kind.strip() not in ("", "hold", "linear"):
        what = f"--input {name}=@FILE may be followed by 'hold' or 'linear' (got '{kind.strip()[:40]}')"
        raise Error(what, fix=f"--input '{name}=@{path} hold'", code="E406")
    return (*times_and_values(path), kind.strip() or "linear")
