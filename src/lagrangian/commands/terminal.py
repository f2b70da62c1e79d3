"""What every command shares with the terminal: how a model is opened, and how results are put out."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from lagrangian.errors import Error

if TYPE_CHECKING:
    from lagrangian.system import System

File = Annotated[str, typer.Argument(help="A model file; - is standard input.", show_default=False)]
OptionalFile = Annotated[str | None, typer.Argument(help="A model file; - is standard input.", show_default=False)]
Example = Annotated[
    str | None, typer.Option("--example", "-e", help="Use a built-in example instead of a file.", show_default=False)
]
Output = Annotated[
    Path | None, typer.Option("--output", "-o", help="Write here instead of standard output.", show_default=False)
]


def open_system(file: str | None, example: str | None = None) -> System:
    """Return the system of a model file (``-`` is standard input) or of a built-in example; one of the two is given."""
    if (file is None) == (example is None):
        raise typer.BadParameter("name a model file, or a built-in example with --example NAME")
    from lagrangian import examples
    from lagrangian.system import load, loads

    if example is not None:
        return loads(examples.text(example), name=f"<example {example}>")
    assert file is not None
    if file == "-":
        return loads(standard_input(), name="<standard input>")
    return load(file)


def standard_input() -> str:
    """Return the text of standard input; raises `Error` where it is closed."""
    if sys.stdin is None:
        raise Error("standard input is closed", fix="name a model file, or pipe one in", code="E702")
    from lagrangian import read

    data = sys.stdin.buffer.read(read.MAX_BYTES + 1)
    return read.decode(data, "<standard input>")


def put(text: str, output: Path | None) -> None:
    """Write text, ended by a newline, to a file (whole or not at all) or to standard output."""
    text = text if text.endswith("\n") else text + "\n"
    if output is None:
        sys.stdout.write(text)
        sys.stdout.flush()
    else:
        from lagrangian.write import write_file

        write_file(output, text)


def say(words: str) -> None:
    """Talk: a line on standard error."""
    sys.stderr.write(words + "\n")
