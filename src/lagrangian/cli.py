"""The command: one verb a command, data on standard output, talk on standard error, exit 0, 1 or 2."""

from __future__ import annotations

import contextlib
import os
import sys

import typer

from lagrangian.commands.verbs import Verbs
from lagrangian.errors import Error, ModelError

app = typer.Typer(
    name="lagrangian",
    cls=Verbs,
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)


@app.callback()
def verbs() -> None:
    """Equations of motion by the Lagrangian approach: every step shown, every result checked."""


def main(arguments: list[str] | None = None) -> int:
    """Run the command; return 0 when all is well, 1 when a check failed, 2 for a mistake in what was given."""
    if sys.stdout is None:  # closed by the shell, as in `lagrangian … >&-`
        sys.stderr.write("[E801] standard output is closed\n")
        return 2
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure") and (stream.encoding or "").lower().replace("-", "") != "utf8":
            stream.reconfigure(encoding="utf-8", errors="replace")  # type: ignore[union-attr]
    try:
        app(args=arguments, prog_name="lagrangian")
    except SystemExit as stop:
        return _flushed(stop.code if isinstance(stop.code, int) else 0)
    except OSError as trouble:
        return _unwritten(trouble)
    except Error as error:
        sys.stderr.write(f"{_kind(error)}{error}\n")
        return 2
    return _flushed(0)


def _flushed(code: int) -> int:
    """``code``, once what was said has left the house: a full disk shows itself only here."""
    try:
        sys.stdout.flush()
    except BrokenPipeError:  # the reader has seen enough, as in `lagrangian … | head`
        _dropped()
    except OSError as trouble:
        return _unwritten(trouble)
    return code


def _unwritten(trouble: OSError) -> int:
    _dropped()
    sys.stderr.write(f"[E801] cannot write to standard output: {(trouble.strerror or str(trouble)).lower()}\n")
    return 2


def _dropped() -> None:
    """Send what is left in the buffer nowhere, so that Python does not try again, and complain, on its way out."""
    with contextlib.suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _kind(error: Error) -> str:
    return "error: " if isinstance(error, ModelError) and not (error.place and error.place.file) else ""


def run() -> None:
    """Entry point of the installed command."""
    sys.exit(main())
