"""``lagrangian new``, ``examples``, ``schema``, ``version``: verbs to begin with."""

from __future__ import annotations

import platform
from typing import Annotated

import typer

from lagrangian.cli.door import put
from lagrangian.cli.formats import as_json, check_output
from lagrangian.cli.terminal import Force, Json, Output, example_names


def new(
    name: Annotated[
        str,
        typer.Argument(
            metavar="NAME", help="The example to start from; see `lagrangian examples`.", autocompletion=example_names
        ),
    ],
    json: Json = False,
    output: Output = None,
    force: Force = False,
) -> None:
    """Print a model file to start from.

    \b
    Examples:
      lagrangian new lecture-3b > carts.toml
      lagrangian new pendulum -o pendulum.toml
    """
    from lagrangian import examples

    check_output(output, force, ".json" if json else ".toml")
    text = examples.text(name)
    put(as_json({"name": name, "description": examples.describe(name), "text": text}) if json else text, output)


def list_examples(json: Json = False) -> None:
    """List the built-in examples.

    \b
    Examples:
      lagrangian examples
      lagrangian examples --json
    """
    from lagrangian import examples

    known = {name: examples.describe(name) for name in examples.names()}
    if json:
        put(as_json([{"name": name, "description": words} for name, words in known.items()]))
    else:
        wide = max(map(len, known))
        put([f"{name:<{wide}}  {words}" for name, words in known.items()])


def schema(
    json: Annotated[bool, typer.Option("--json", help="No effect: a schema is always JSON.")] = False,
    output: Output = None,
    force: Force = False,
) -> None:
    """Print the JSON Schema of model files, for editors.

    \b
    Examples:
      lagrangian schema -o lagrangian.schema.json
    """
    from lagrangian import read

    check_output(output, force, ".json")
    put(as_json(read.schema()), output)


def version(json: Json = False) -> None:
    """Print the version.

    \b
    Examples:
      lagrangian version
      lagrangian version --json
    """
    from lagrangian import __version__

    data = {"version": __version__, "python": platform.python_version()}
    put(as_json(data) if json else f"lagrangian {__version__}")
