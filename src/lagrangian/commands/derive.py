"""``lagrangian derive``: the seven steps, written out."""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated

import typer

from lagrangian import write
from lagrangian.commands.terminal import Example, OptionalFile, Output, open_system, put, say
from lagrangian.derivation import Derivation


class Format(StrEnum):
    """What is written: text, markup, or data."""

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


def derive(
    file: OptionalFile = None,
    example: Example = None,
    format: Annotated[Format, typer.Option("--format", "-f", help="What to write.")] = Format.TEXT,
    notation: Annotated[Notation, typer.Option(help="Whose letters.")] = Notation.LECTURE,
    brief: Annotated[bool, typer.Option("--brief", help="The one-page checklist.")] = False,
    full: Annotated[bool, typer.Option("--full", help="Write out what is too long to read.")] = False,
    width: Annotated[int, typer.Option(help="Columns of the text.", min=40, max=400)] = 80,
    output: Output = None,
) -> None:
    """Derive the equations of motion, step by step; exit 1 if a check does not hold."""
    derivation = open_system(file, example).derive()
    put(_written(derivation, format, notation, brief, full, width), output)
    if any(check.holds is False for check in derivation.verified):
        say("a check at the end of the derivation does not hold; see its ✗")
        raise typer.Exit(1)


def _written(derivation: Derivation, format: Format, notation: Notation, brief: bool, full: bool, width: int) -> str:
    columns = {"width": width} if format is Format.TEXT else {}
    return write.FORMATS[format.value](derivation, notation=notation.value, brief=brief, full=full, **columns)
