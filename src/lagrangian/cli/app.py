"""The Typer application: the group of all verbs, and the function that runs a verb with its arguments."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable
from difflib import get_close_matches
from typing import Annotated

import typer

from lagrangian.cli.verbs import Verbs
from lagrangian.errors import Error

NAME = "lagrangian"

COMPLETING = "_LAGRANGIAN_COMPLETE"
"""The environment variable that a shell sets when it asks for completions."""

app = typer.Typer(
    name=NAME,
    cls=Verbs,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)


def _version(wanted: bool) -> None:
    if wanted:
        from lagrangian.cli.start import version

        version()
        raise typer.Exit


@app.callback()
def verbs(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    """Equations of motion by the Lagrangian approach: every step shown, every result checked.

    \b
    Examples:
      lagrangian derive --example lecture-3b          the seven steps, written out
      lagrangian new lecture-3b -o carts.toml         a model file to start from
      lagrangian simulate carts.toml -d 10 -o run.csv

    Every verb has examples of its own: lagrangian simulate --help.
    """


def invoked(arguments: list[str]) -> int:
    """Run the verb named by the arguments; return the exit code."""
    command = typer.main.get_command(app)
    if COMPLETING in os.environ:
        command.main(args=arguments, prog_name=NAME)
    try:
        with command.make_context(NAME, list(arguments) or ["--help"]) as context:
            command.invoke(context)
    except typer.Exit as stop:
        return stop.exit_code if arguments else 2
    except _MISUSE as wrong:
        raise _said(wrong) from None
    return 0


def _near_choice(what: str) -> list[str]:
    """The value nearest to one that is not among the choices of an option: 'c' for 'cc'."""
    listed, choices = _CHOICES.search(what), []
    if listed is None:
        return choices
    choices, given = re.findall("'([^']*)'", listed["known"]), listed["given"].lower()
    begins = [choice for choice in choices if given and (given.startswith(choice) or choice.startswith(given))]
    return [f"'{choice}'" for choice in get_close_matches(given, choices, n=2, cutoff=0.6) or begins]


def _similar(what: str, options: Iterable[str]) -> list[str]:
    """Those of the options that Typer offers which are similar to the one that was given, not only by their dashes."""
    given = what.rpartition(" ")[2].strip("-'")
    return [x for x in options if get_close_matches(given, [x.strip("-")], cutoff=0.6)]


_CHOICES = re.compile(r"'(?P<given>[^']*)' is not one of (?P<known>'.*')")

_MISUSE: type[Exception] = typer.BadParameter.__mro__[1]
"""Typer's base class of all errors in options and arguments, which has no public name."""


def _said(wrong: Exception) -> Error:
    """Convert an error of Typer to one of ours: what is wrong, and how to fix it."""
    what, context = str(getattr(wrong, "message", wrong)), getattr(wrong, "ctx", None)
    if isinstance(wrong, typer.BadParameter):
        what = wrong.format_message()
    what = " ".join(what.replace("Value error, ", "").replace("Input should be", "it should be").split())
    near = _similar(what, getattr(wrong, "possibilities", None) or []) or _near_choice(what)
    verb = context.command_path if context is not None else NAME
    fix = f"Did you mean {' or '.join(near)}?" if near else f"`{verb} --help` shows what it takes, with examples"
    return Error(what[:1].lower() + what[1:].rstrip("."), fix=fix)
