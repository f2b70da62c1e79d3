"""``lagrangian new``, ``examples``, ``schema``, ``version``: what to start from."""

from __future__ import annotations

import json
import sys
from typing import Annotated

import typer

from lagrangian.commands.terminal import Output, put


def new(
    name: Annotated[str, typer.Argument(help="The example to start from; see `lagrangian examples`.")],
    output: Output = None,
) -> None:
    """Print a model file to start from."""
    from lagrangian import examples

    put(examples.text(name), output)


def list_examples() -> None:
    """List the built-in examples."""
    from lagrangian import examples

    names = examples.names()
    wide = max(len(name) for name in names)
    for name in names:
        sys.stdout.write(f"{name:<{wide}}  {examples.describe(name)}\n")


def schema(output: Output = None) -> None:
    """Print the JSON Schema of model files, for editors."""
    from lagrangian import read

    put(json.dumps(read.schema(), ensure_ascii=False, indent=2), output)


def version() -> None:
    """Print the version."""
    from lagrangian import __version__

    sys.stdout.write(f"lagrangian {__version__}\n")
