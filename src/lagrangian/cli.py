"""The command: one verb a command, data on standard output, talk on standard error, exit 0, 1 or 2."""

from __future__ import annotations

import contextlib
import json
import os
import sys
from dataclasses import replace
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from lagrangian import examples, read, write
from lagrangian.compiled import sources
from lagrangian.derivation import Derivation
from lagrangian.errors import Error, ModelError
from lagrangian.system import System, load, loads

app = typer.Typer(
    name="lagrangian",
    help="Equations of motion by the Lagrangian approach: every step shown, every result checked.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)


class Format(StrEnum):
    """What a derivation is written as."""

    TEXT = "text"
    MARKDOWN = "markdown"
    LATEX = "latex"
    HTML = "html"
    JSON = "json"


class Notation(StrEnum):
    """Whose letters: ξ, T*, Ξ of the lecture; q, T, Q of physics; M, C, g, τ of robotics."""

    LECTURE = "lecture"
    PHYSICS = "physics"
    ROBOTICS = "robotics"


File = Annotated[str, typer.Argument(help="A model file; - is standard input.", show_default=False)]
Output = Annotated[
    Path | None, typer.Option("--output", "-o", help="Write here instead of standard output.", show_default=False)
]


def _open(file: str) -> System:
    if file == "-":
        return loads(_standard_input(), name="<standard input>")
    return load(file)


def _standard_input() -> str:
    if sys.stdin is None:
        raise Error("standard input is closed", fix="name a model file, or pipe one in", code="E702")
    data = sys.stdin.buffer.read(read.MAX_BYTES + 1)
    return read.decode(data, "<standard input>")


def _put(text: str, output: Path | None) -> None:
    text = text if text.endswith("\n") else text + "\n"
    if output is None:
        sys.stdout.write(text)
        sys.stdout.flush()
    else:
        write.write_file(output, text)


@app.command()
def derive(
    file: Annotated[str | None, typer.Argument(help="A model file; - is standard input.", show_default=False)] = None,
    example: Annotated[
        str | None, typer.Option("--example", "-e", help="Derive a built-in example instead of a file.")
    ] = None,
    format: Annotated[Format, typer.Option("--format", "-f", help="What to write.")] = Format.TEXT,
    notation: Annotated[Notation, typer.Option(help="Whose letters.")] = Notation.LECTURE,
    brief: Annotated[bool, typer.Option("--brief", help="The one-page checklist.")] = False,
    full: Annotated[bool, typer.Option("--full", help="Write out what is too long to read.")] = False,
    width: Annotated[int, typer.Option(help="Columns of the text.", min=40, max=400)] = 80,
    output: Output = None,
) -> None:
    """Derive the equations of motion, step by step; exit 1 if a check does not hold."""
    if (file is None) == (example is None):
        raise typer.BadParameter("name a model file, or a built-in example with --example NAME")
    if example is not None:
        system = loads(examples.text(example), name=f"<example {example}>")
    else:
        assert file is not None
        system = _open(file)
    derivation = system.derive()
    _put(_written(derivation, format, notation, brief, full, width), output)
    if not all(check.holds for check in derivation.verified):
        sys.stderr.write("a check at the end of the derivation does not hold; see its ✗\n")
        raise typer.Exit(1)


def _written(derivation: Derivation, format: Format, notation: Notation, brief: bool, full: bool, width: int) -> str:
    columns = {"width": width} if format is Format.TEXT else {}
    return write.FORMATS[format.value](derivation, notation=notation.value, brief=brief, full=full, **columns)


@app.command()
def verify(
    file: File,
    states: Annotated[int, typer.Option(help="Random states to compare at.", min=1, max=100_000)] = 100,
    seed: Annotated[int, typer.Option(help="Which random states.")] = 1,
) -> None:
    """Check the equations by independent routes; exit 1 if one does not hold."""
    derivation = _open(file).derive()
    verified = replace(derivation, verified=derivation.verify(states=states, seed=seed))
    sys.stdout.write(write.verdicts(verified))
    if not all(check.holds for check in verified.verified):
        raise typer.Exit(1)


class Language(StrEnum):
    """What source code is written in."""

    C = "c"
    PYTHON = "python"


@app.command()
def export(
    file: File,
    to: Annotated[Language, typer.Option("--to", help="The language.")],
    output: Annotated[Path, typer.Option("--output", "-o", help="The folder to write into.")] = Path(),
    name: Annotated[str, typer.Option(help="What the files and functions are called.")] = "dynamics",
) -> None:
    """Write the dynamics as source code that needs nothing of this package."""
    try:
        output.mkdir(parents=True, exist_ok=True)
    except OSError as trouble:
        raise Error(f"cannot make the folder '{output}': {trouble.strerror}", code="E801") from None
    for file_name, text in sources(_open(file).model, to.value, name).items():
        sys.stderr.write(f"wrote {write.write_file(output / file_name, text)}\n")


@app.command()
def new(
    name: Annotated[str, typer.Argument(help="The example to start from; see `lagrangian examples`.")],
    output: Output = None,
) -> None:
    """Print a model file to start from."""
    _put(examples.text(name), output)


@app.command("examples")
def list_examples() -> None:
    """List the built-in examples."""
    names = examples.names()
    wide = max(len(name) for name in names)
    for name in names:
        sys.stdout.write(f"{name:<{wide}}  {examples.describe(name)}\n")


@app.command()
def schema(output: Output = None) -> None:
    """Print the JSON Schema of model files, for editors."""
    _put(json.dumps(read.schema(), ensure_ascii=False, indent=2), output)


@app.command()
def version() -> None:
    """Print the version."""
    from lagrangian import __version__

    sys.stdout.write(f"lagrangian {__version__}\n")


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
