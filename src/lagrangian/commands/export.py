"""``lagrangian export``: the dynamics as source code."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from lagrangian import write
from lagrangian.commands.terminal import Example, OptionalFile, open_system, say
from lagrangian.compiled import sources
from lagrangian.errors import Error


class Language(StrEnum):
    """What source code is written in."""

    C = "c"
    PYTHON = "python"


def export(
    to: Annotated[Language, typer.Option("--to", help="The language.")],
    file: OptionalFile = None,
    example: Example = None,
    output: Annotated[Path, typer.Option("--output", "-o", help="The folder to write into.")] = Path(),
    name: Annotated[str, typer.Option(help="What the files and functions are called.")] = "dynamics",
) -> None:
    """Write the dynamics as source code that needs nothing of this package."""
    try:
        output.mkdir(parents=True, exist_ok=True)
    except OSError as trouble:
        raise Error(f"cannot make the folder '{output}': {trouble.strerror}", code="E801") from None
    for file_name, text in sources(open_system(file, example).model, to.value, name).items():
        say(f"wrote {write.write_file(output / file_name, text)}")
