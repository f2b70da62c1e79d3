"""``lagrangian export``: write the dynamics for other programs."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from lagrangian import write
from lagrangian.cli.door import put, say
from lagrangian.cli.formats import as_json
from lagrangian.cli.terminal import Example, Force, Json, OptionalFile, open_system
from lagrangian.errors import Error


class Language(StrEnum):
    """What is written: source code in a language, files of another program, or the integrator as WebAssembly."""

    C = "c"
    PYTHON = "python"
    JAVASCRIPT = "javascript"
    WASM = "wasm"
    MATLAB = "matlab"
    JAX = "jax"
    CASADI = "casadi"
    JULIA = "julia"
    SIMULINK = "simulink"
    MODELICA = "modelica"
    FMU2 = "fmu2"
    FMU3 = "fmu3"


def export(
    to: Annotated[
        Language, typer.Option("--to", metavar="TARGET", help=f"The language or the program: {', '.join(Language)}.")
    ],
    file: OptionalFile = None,
    example: Example = None,
    output: Annotated[
        Path, typer.Option("--output", "-o", metavar="FOLDER", help="Folder to write the files into.")
    ] = Path(),
    name: Annotated[
        str, typer.Option(metavar="NAME", help="Name of the files and prefix of the functions.")
    ] = "dynamics",
    json: Json = False,
    force: Force = False,
) -> None:
    """Write the dynamics for other programs: source code, MATLAB functions, FMUs, pages.

    The files run without this package.

    \b
    Examples:
      lagrangian export carts.toml --to c -o out
      lagrangian export --example robot-arm --to python --name arm
      lagrangian export -e double-pendulum --to matlab --name pendulum -o matlab
      lagrangian export -e double-pendulum --to wasm -o page
    """
    if output.exists() and not output.is_dir():
        raise Error(f"'{output}' is a file, not a folder", fix="name a folder with -o: -o out", code="E801")
    from lagrangian.export import exported_files
    from lagrangian.model.without_friction import check_no_friction

    model = open_system(file, example).model
    check_no_friction(model, "there is nothing to export")
    files = {output / title: text for title, text in exported_files(model, to.value, name).items()}
    if output.is_dir():
        for path in files:
            write.check_free(path, overwrite=force)
    try:
        output.mkdir(parents=True, exist_ok=True)
    except OSError as trouble:
        raise Error(f"cannot make the folder '{output}': {(trouble.strerror or '').lower()}", code="E801") from None
    for path, text in files.items():
        write.write_file(path, text)
        say(f"wrote {path}")
    say(_proof(to.value))
    if json:
        put(as_json({"language": to.value, "files": [str(path) for path in files]}))


def _proof(to: str) -> str:
    """What is known of the numbers of an export, and what checks them."""
    from lagrangian.verify.foreign.checks import NOT_RUN, RUNNERS

    if to == "wasm":
        return "not checked yet: lagrangian verify --exports runs it within the page that moves"
    if to in NOT_RUN:
        return f"not checked: {NOT_RUN[to]}"
    option = " --exports" if to in RUNNERS else ""
    return f"not checked yet: lagrangian verify{option} runs the export and compares its numbers"
