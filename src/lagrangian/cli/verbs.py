"""The verbs of the command, with a line of help for each; the file of a verb is imported only when the verb is used."""

from __future__ import annotations

import re
from functools import cached_property
from importlib import import_module
from typing import Any

import typer
import typer.core

VERBS = {
    "derive": ("derive", "derive", "Derive the equations of motion, step by step; exit 1 if a check fails."),
    "verify": (
        "verify",
        "verify",
        "Check the equations, the compiled code, its exports and the linearization; exit 1 if a check fails.",
    ),
    "check": (
        "check",
        "check",
        "Check your own answer: equations, energies or a whole derivation; exit 1 if it is wrong or incomplete.",
    ),
    "worksheet": (
        "worksheet",
        "worksheet",
        "Write an exercise: a question sheet, its solution, and random variants of the same difficulty.",
    ),
    "export": (
        "export",
        "export",
        "Write the dynamics for other programs: source code, MATLAB functions, FMUs, pages.",
    ),
    "compare": (
        "compare",
        "compare",
        "Compare the equations of two systems; exit 0 if both describe the same motion, 1 if they differ.",
    ),
    "linearize": ("linearize", "linearize", "Linearize about an equilibrium: A, B, C, D, poles, modes, stability."),
    "regulate": (
        "regulate",
        "regulate",
        "Find the linear-quadratic regulator about an equilibrium: law, gains, closed-loop poles; exit 1 if a check "
        "fails.",
    ),
    "equilibria": (
        "equilibria",
        "equilibria",
        "Find the equilibria within given ranges of the coordinates, and whether each is stable.",
    ),
    "conserved": (
        "conserved",
        "conserved",
        "Find conserved quantities: momenta, total momenta and energy, each proved and checked along a simulated run.",
    ),
    "simulate": (
        "simulate",
        "simulate",
        "Simulate the system and print a summary; exit 1 if the run stopped early (its results up to then are kept).",
    ),
    "animate": (
        "animate",
        "animate",
        "Write an animation of a run: SVG, HTML, GIF or a video; exit 1 if the run stopped early (it is shown up to "
        "then).",
    ),
    "sweep": (
        "sweep",
        "sweep",
        "Simulate every combination of values and keep a few numbers of each run; exit 1 if all runs fail.",
    ),
    "fit": (
        "fit",
        "fit",
        "Find the parameters and initial values whose runs fit measured data best; exit 1 if the search finds no "
        "minimum.",
    ),
    "optimize": (
        "optimize",
        "optimize",
        "Find the parameters, initial values and inputs that make a run best; exit 1 if the search finds no minimum.",
    ),
    "look": ("look", "look", "Draw the system and open a page on which it moves, with sliders, plots and equations."),
    "web": (
        "lagrangian.web.verb",
        "web",
        "Write models, read their equations and check answers in the browser, on this computer alone.",
    ),
    "new": ("start", "new", "Print a model file to start from."),
    "examples": ("start", "list_examples", "List the built-in examples."),
    "schema": ("start", "schema", "Print the JSON Schema of model files, for editors."),
    "version": ("start", "version", "Print the version."),
}
"""Name → file (with its full name if it is in another room), function, and the first line of the help."""


_ENDING = re.compile(r"[;.] [Ee]xit \d")
"""The text before the exit codes in the line of a verb, which the list of verbs omits."""


def _flags_off(params: list[Any]) -> list[Any]:
    """Let flags that are not given be False: Typer's own, such as --help, are None, and to convert that to a bool
    Typer imports pydantic, which takes longer than most of these verbs."""
    for param in params:
        if getattr(param, "is_bool_flag", False) and param.default is None:
            param.default = False
    return params


class Grouped(typer.core.TyperCommand):
    """A verb whose help lists its options by group, in the order in which the groups first appear."""

    def get_params(self, ctx: Any) -> list[Any]:
        """Return the options and arguments."""
        return _flags_off(super().get_params(ctx))

    def format_options(self, ctx: Any, formatter: Any) -> None:
        """Write the arguments, then the options of every group."""
        groups: dict[str, list[tuple[str, str]]] = {}
        for param in self.get_params(ctx):
            if (record := param.get_help_record(ctx)) is None:
                continue
            if param.param_type_name == "argument":
                groups.setdefault("Arguments", []).append((record[0].partition(" <")[0], record[1]))
            else:
                groups.setdefault(getattr(param, "rich_help_panel", None) or "Options", []).append(record)
        for name, records in groups.items():
            with formatter.section(name):
                formatter.write_dl(records)


class Deferred(typer.core.TyperCommand):
    """A verb of which only the name and the line of help are known until it is used."""

    def __init__(self, name: str, file: str, function: str, help: str) -> None:
        super().__init__(name, help=help, short_help=_ENDING.split(help)[0].rstrip(".") + ".")
        self._file, self._function = file, function

    @cached_property
    def verb(self) -> Any:
        """The actual command with its options."""
        alone = typer.Typer(add_completion=False, pretty_exceptions_enable=False, rich_markup_mode=None)
        file = self._file if "." in self._file else f"lagrangian.cli.{self._file}"
        alone.command(self.name, cls=Grouped)(getattr(import_module(file), self._function))
        return typer.main.get_command(alone)

    def make_context(self, *arguments: Any, **options: Any) -> Any:
        """Return the context of the actual command, which runs from here on."""
        return self.verb.make_context(*arguments, **options)

    def get_params(self, ctx: Any) -> list[Any]:
        """Return the options and arguments of the actual command."""
        return self.verb.get_params(ctx)


class Verbs(typer.core.TyperGroup):
    """All verbs, in the order of the list."""

    def __init__(self, **attributes: Any) -> None:
        super().__init__(**attributes)
        self.commands = {name: Deferred(name, *where) for name, where in VERBS.items()}

    def get_params(self, ctx: Any) -> list[Any]:
        """Return the options of the command itself."""
        return _flags_off(super().get_params(ctx))
