"""``lagrangian animate``: one run as moving pictures, in a file."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from lagrangian.cli.assignments import names
from lagrangian.cli.door import put, say
from lagrangian.cli.formats import as_json
from lagrangian.cli.progress import status
from lagrangian.cli.simulate import end, start_values
from lagrangian.cli.terminal import (
    OUTPUT,
    Duration,
    Example,
    Fixed,
    Force,
    Initial,
    InputSignals,
    Json,
    OptionalFile,
    Parameters,
    open_system,
    output_option,
)
from lagrangian.cli.wording import in_options
from lagrangian.errors import Error

if TYPE_CHECKING:
    from lagrangian.simulate.animation import Animation
    from lagrangian.simulate.trajectory import Trajectory

SAMPLES = 2001
"""The number of samples of a run; between them, the animation follows smooth curves."""


MotionFile = Annotated[
    Path | None,
    output_option("The file to write (.svg, .html, .gif, .mp4, .webm); - writes SVG to standard output."),
]
Trail = Annotated[
    list[str] | None,
    typer.Option(
        "--trail", metavar="POINT[,POINT]", help="Draw the paths of these points. By default, as the file says."
    ),
]
Speed = Annotated[
    float | None,
    typer.Option(
        metavar="NUMBER",
        help="Seconds of the run shown in a second. By default 1, but slower for very short runs and faster for "
        "long ones.",
        show_default=False,
    ),
]
Fps = Annotated[float, typer.Option(metavar="NUMBER", help="Frames per second.", rich_help_panel=OUTPUT)]
PictureWidth = Annotated[
    float | None,
    typer.Option(metavar="PIXELS", help="Width of the picture.", show_default=False, rich_help_panel=OUTPUT),
]
Dark = Annotated[
    bool, typer.Option("--dark", help="Draw light on dark; for .gif, .mp4 and .webm.", rich_help_panel=OUTPUT)
]
Samples = Annotated[int, typer.Option(metavar="N", help="Number of evenly spaced times at which the run is stored.")]


def animate(
    file: OptionalFile = None,
    example: Example = None,
    output: MotionFile = None,
    duration: Duration = None,
    init: Initial = None,
    fixed: Fixed = None,
    set_: Parameters = None,
    input_: InputSignals = None,
    trail: Trail = None,
    speed: Speed = None,
    fps: Fps = 25.0,
    width: PictureWidth = None,
    dark: Dark = False,
    samples: Samples = SAMPLES,
    json: Json = False,
    force: Force = False,
) -> None:
    """Write an animation of a run: SVG, HTML, GIF or a video; exit 1 if the run stopped early (it is shown up to then).

    SVG plays wherever images do. GIF needs the extra 'animate', videos need ffmpeg besides.

    \b
    Examples:
      lagrangian animate -e double-pendulum -d 10 --trail P2 -o pendulum.svg
      lagrangian animate carts.toml -o carts.gif --set k=80 --speed 0.5
      lagrangian animate cart.toml -d 5 --input "F=3*sin(t)" --fps 50 -o cart.mp4
    """
    if output is None:
        raise Error("no file was given", fix="name one with -o: -o motion.svg, .html, .gif, .mp4 or .webm", code="E401")
    shown = str(output) == "-"
    if not shown:
        from lagrangian.simulate.animation import ENDINGS
        from lagrangian.write.tables import check_target

        check_target(output, list(ENDINGS), overwrite=force)
    system = open_system(file, example)
    run = system.simulate(
        duration,
        **start_values(init, fixed, set_, input_),
        samples=samples,
    )
    points = None if trail is None else names(trail)
    animation = run.animate(speed=speed, trail=points, fps=fps, width=width)
    if shown:
        put(animation.to_svg())
    else:
        animation.save(output, overwrite=force, dark=dark, progress=status.counted("frames"))
        put(as_json(figures(run, animation, output)) if json else summary(animation, output))
    for notice in run.notices:
        say(f"note: {notice}")
    end(run)


def summary(animation: Animation, path: Path) -> list[str]:
    """Return what was written, in a line."""
    motion = animation.motion
    pace = f", {motion.pace}" if motion.pace else ""
    span = f"t = {motion.times[0]:g} … {motion.times[-1]:g} s"
    return [f"wrote {path}: {span}, {animation.frames} frames, {animation.duration:g} s{pace}"]


def figures(run: Trajectory, animation: Animation, path: Path) -> dict[str, Any]:
    """Return the same as data."""
    times = animation.motion.times
    return {
        "name": run.model.name,
        "path": str(path),
        "success": bool(run.success),
        "message": in_options(run.message),
        "notices": [str(notice) for notice in run.notices],
        "start": float(times[0]),
        "end": float(times[-1]),
        "frames": animation.frames,
        "fps": animation.fps,
        "duration": animation.duration,
        "width": animation.width,
        "bytes": path.stat().st_size,
    }
