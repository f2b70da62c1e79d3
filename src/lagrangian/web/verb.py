"""``lagrangian web``: the app in the browser."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from lagrangian.cli.door import put, say
from lagrangian.cli.formats import as_json
from lagrangian.cli.progress import status
from lagrangian.errors import MissingExtra


def web(
    file: Annotated[
        Path | None,
        typer.Argument(
            metavar="FILE", help="A model file to open. It is read once, and never written.", show_default=False
        ),
    ] = None,
    port: Annotated[
        int,
        typer.Option(
            metavar="N", help="The port of 127.0.0.1; a free one by default.", min=0, max=65535, show_default=False
        ),
    ] = 0,
    no_browser: Annotated[
        bool, typer.Option("--no-browser", help="Only print the address; do not open the browser.")
    ] = False,
    json: Annotated[bool, typer.Option("--json", help="Write the address as JSON to standard output.")] = False,
) -> None:
    """Write models, read their equations and check answers in the browser, on this computer alone.

    \b
    Examples:
      lagrangian web
      lagrangian web carts.toml
      lagrangian web --port 8765 --no-browser
    """
    try:
        import starlette  # noqa: F401
        import uvicorn  # noqa: F401
    except ImportError:
        what = "the app needs starlette and uvicorn, which are not installed"
        raise MissingExtra(what, fix="pip install 'lagrangian[web]'") from None
    from lagrangian.web.app import Desk
    from lagrangian.web.serve import serve

    model = None if file is None else (file.name, read_model(file))
    status.hide()
    serve(Desk(model), port, _announce if json else say, say, browser=not no_browser)


def _announce(address: str) -> None:
    put(as_json({"address": address}))


def read_model(path: Path) -> str:
    """Return the text of a model file, which may contain mistakes. Raises `Error` if it cannot be read as text."""
    from lagrangian.check.reading import read_text

    return read_text(path)
