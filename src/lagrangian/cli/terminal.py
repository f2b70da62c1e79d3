"""Options that several verbs share, and the function that opens a model."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from lagrangian.cli.door import NARROWEST, USUAL, WIDEST
from lagrangian.errors import Error, Place

if TYPE_CHECKING:
    from lagrangian.system import System


OUTPUT, INTEGRATION, COMPUTING = "Output", "Integration", "Computing"
"""The groups of options in the help of a verb, after its own options."""


def example_names(begun: str) -> list[str]:
    """Return the names of examples that begin with the given letters, for completion by the shell."""
    from lagrangian import examples

    return [name for name in examples.names() if name.startswith(begun)]


def output_option(help: str, metavar: str = "PATH") -> Any:
    """The option -o of a verb that writes something of its own."""
    return typer.Option("--output", "-o", metavar=metavar, help=help, show_default=False, rich_help_panel=OUTPUT)


File = Annotated[str, typer.Argument(metavar="FILE", help="A model file; - is standard input.", show_default=False)]
OptionalFile = Annotated[
    str | None, typer.Argument(metavar="FILE", help="A model file; - is standard input.", show_default=False)
]
Example = Annotated[
    str | None,
    typer.Option(
        "--example",
        "-e",
        metavar="NAME",
        help="Use a built-in example instead of a file.",
        show_default=False,
        autocompletion=example_names,
    ),
]
Width = Annotated[
    int | None,
    typer.Option(
        metavar="COLUMNS",
        help=f"Width of the text in columns. By default, that of the terminal, or {USUAL}.",
        min=NARROWEST,
        max=WIDEST,
        show_default=False,
        rich_help_panel=OUTPUT,
    ),
]
Json = Annotated[bool, typer.Option("--json", help="Write the result as JSON.", rich_help_panel=OUTPUT)]
JsonSummary = Annotated[bool, typer.Option("--json", help="Write the summary as JSON.", rich_help_panel=OUTPUT)]
Output = Annotated[
    Path | None,
    output_option("Write to this file instead of standard output."),
]
Force = Annotated[bool, typer.Option("--force", help="Overwrite an existing file.", rich_help_panel=OUTPUT)]
Parameters = Annotated[
    list[str] | None,
    typer.Option("--set", "-s", metavar="NAME=VALUE", help='Value of a parameter: k=80, "m1=2 kg". Repeatable.'),
]
ConstantInputs = Annotated[
    list[str] | None,
    typer.Option("--input", "-i", metavar="NAME=VALUE", help="Constant value of an input: F=2. Repeatable."),
]

AtPoint = Annotated[
    list[str] | None,
    typer.Option(
        "--at",
        metavar="NAME=VALUE",
        help='Value of a coordinate or rate at the equilibrium: x2=0, "theta=12 deg". Repeatable.',
    ),
]
FixedAtPoint = Annotated[
    list[str] | None,
    typer.Option(
        "--fixed",
        metavar="NAME[,NAME]",
        help="The point is a guess, to be moved onto the constraints; these coordinates stay. Repeatable.",
    ),
]

InputSignals = Annotated[
    list[str] | None,
    typer.Option(
        "--input",
        "-i",
        metavar="NAME=VALUE",
        help='An input: tau=2, "tau=3*sin(t)", "F=-k*x", or a table of times and values: F=@force.csv (straight '
        'lines between them), "F=@force.csv hold" (steps). Repeatable.',
    ),
]

# -- shared by `simulate`, `animate` and `sweep` ---------------------------------------------------------------------

Duration = Annotated[
    str | None,
    typer.Option(
        "--duration",
        "-d",
        metavar="TIME",
        help='How long to simulate: 10, "500 ms". By default, as the model file says.',
        show_default=False,
    ),
]
Initial = Annotated[
    list[str] | None,
    typer.Option(
        "--init",
        metavar="NAME=VALUE",
        help='Initial value of a coordinate or rate: "theta1=30 deg", "x\'=0.1". Repeatable.',
    ),
]
Fixed = Annotated[
    list[str] | None,
    typer.Option(
        "--fixed",
        metavar="NAME[,NAME]",
        help="Coordinates that stay as given where constraints move the others at the start. Repeatable.",
        show_default=False,
    ),
]
Plot = Annotated[
    Path | None,
    typer.Option(
        metavar="PATH",
        help="Draw a picture into this file (.png, .pdf, .svg, .jpg).",
        show_default=False,
        rich_help_panel=OUTPUT,
    ),
]
Step = Annotated[
    str | None,
    typer.Option(metavar="TIME", help='Step of rk4 and gauss4: 0.01, "10 ms".', rich_help_panel=INTEGRATION),
]
Rtol = Annotated[
    float | None,
    typer.Option(metavar="NUMBER", help="Relative tolerance, by default 1e-9.", rich_help_panel=INTEGRATION),
]
Atol = Annotated[
    float | None,
    typer.Option(metavar="NUMBER", help="Absolute tolerance, by default 1e-12.", rich_help_panel=INTEGRATION),
]
MaxStep = Annotated[
    str | None, typer.Option(metavar="TIME", help='Longest step: 0.01, "10 ms".', rich_help_panel=INTEGRATION)
]
MaxSteps = Annotated[
    int, typer.Option(metavar="N", help="Stop a run after this many steps.", rich_help_panel=COMPUTING)
]


def open_system(file: str | None, example: str | None = None) -> System:
    """Return the system of a model file (``-`` is standard input) or of a built-in example; exactly one must be
    given."""
    if (file is None) == (example is None):
        what = "no model was given" if file is None else "both a file and --example were given"
        raise Error(what, fix="name a model file, or a built-in example with --example NAME", code="E401")
    from lagrangian.system import example as built_in
    from lagrangian.system import load, loads

    if example is not None:
        return built_in(example)
    assert file is not None
    if file == "-":
        return loads(standard_input(), name="<standard input>")
    if file in example_names("") and not Path(file).exists():
        fix = f"--example {file} for the built-in example, or `lagrangian new {file} > {file}.toml` for a file of it"
        raise Error("there is no such file", place=Place(file), fix=fix, code="E702")
    return load(file)


def file_and_rest(given: list[str], example: str | None, no_file: bool) -> tuple[str | None, list[str]]:
    """Return the path of the model file, None if an example is used, and the other words; ``no_file`` says that the
    first word cannot be a file."""
    if example is not None:
        return None, given
    if no_file:
        fix = "name a model file first, or a built-in example with --example NAME"
        raise Error(f"'{given[0]}' is not a model file", fix=fix, code="E401")
    return given[0], given[1:]


def standard_input() -> str:
    """Return the text of standard input; raises `Error` if it is closed, or no text."""
    from lagrangian import read

    return read.decode(standard_bytes(), "<standard input>")


def standard_bytes() -> bytes:
    """Return what standard input holds, up to the largest size that is read; raises `Error` if it is closed."""
    if sys.stdin is None:
        raise Error("standard input is closed", fix="name a model file, or pipe a model into the command", code="E702")
    from lagrangian import read

    return sys.stdin.buffer.read(read.MAX_BYTES + 1)
