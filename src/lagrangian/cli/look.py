"""``lagrangian look``: the schematic of a system, and a page on which it moves."""

from __future__ import annotations

import tempfile
import webbrowser
from pathlib import Path
from typing import Annotated

import typer

from lagrangian.cli.assignments import assignments
from lagrangian.cli.door import put, say
from lagrangian.cli.formats import as_json
from lagrangian.cli.terminal import Example, Force, Json, OptionalFile, open_system, output_option

ListOption = list[str] | None


KINDS = "ball, cart, box, wheel, disk, disc, link, plate, bar, none"
"""`lagrangian.model.hints.BODY_KINDS`, written here so that help does not wait for models."""


def look(
    file: OptionalFile = None,
    example: Example = None,
    pose: Annotated[
        ListOption,
        typer.Option(metavar="NAME=VALUE", help='Draw with this coordinate: "theta=30 deg". Repeatable.'),
    ] = None,
    kind: Annotated[
        ListOption,
        typer.Option(metavar="BODY=KIND", help=f"Draw a body as this: {KINDS}. Repeatable."),
    ] = None,
    hide: Annotated[
        ListOption, typer.Option(metavar="NAME", help="Leave out this element or coordinate. Repeatable.")
    ] = None,
    trail: Annotated[
        ListOption, typer.Option(metavar="POINT", help="Show the path of this point in motion. Repeatable.")
    ] = None,
    output: Annotated[
        Path | None,
        output_option(
            "Write the page (.html) or the schematic (.svg, .tex, .png) to this file instead of opening the page."
        ),
    ] = None,
    no_browser: Annotated[
        bool, typer.Option("--no-browser", help="Only print where the page is; do not open the browser.")
    ] = False,
    json: Json = False,
    force: Force = False,
) -> None:
    """Draw the system and open a page on which it moves, with sliders, plots and equations.

    \b
    Examples:
      lagrangian look carts.toml
      lagrangian look --example double-pendulum -o pendulum.html
      lagrangian look carts.toml -o carts.svg --pose "x1=20 cm"
    """
    picture = open_system(file, example).look(
        pose=assignments(pose, "--pose"), kinds=assignments(kind, "--kind"), hide=hide, trail=trail
    )
    if output is not None:
        path = picture.save(output, overwrite=force)
    else:
        path = picture.save(_private() / "look.html")
        if not no_browser and webbrowser.open(path.as_uri()):
            say(f"opened {path}")
    for words in picture.missing:
        say(f"note: {words}")
    if json:
        found = {"file": str(path), "description": picture.description, "missing": list(picture.missing)}
        put(as_json(found))
    elif output is None:
        put(str(path))
    else:
        say(f"wrote {path}")


def _private() -> Path:
    """A new folder that no other user can read; it stays, because the browser reads from it when it reloads."""
    return Path(tempfile.mkdtemp(prefix="lagrangian-"))
