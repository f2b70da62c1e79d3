"""``lagrangian derive``: write out the seven steps."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from lagrangian import write
from lagrangian.cli.door import put, say
from lagrangian.cli.door import width as columns
from lagrangian.cli.formats import Format, FormatOption, Notation, NotationOption, chosen, put_report
from lagrangian.cli.terminal import Example, Force, Json, OptionalFile, Output, Width, open_system
from lagrangian.errors import Error

if TYPE_CHECKING:
    from lagrangian.derive import Why


class WrittenIn(StrEnum):
    """How the equations are written."""

    AUTO = "auto"
    EXPANDED = "expanded"
    STRUCTURED = "structured"


class Detail(StrEnum):
    """How many steps of the differentiation are written."""

    USUAL = "usual"
    FULL = "full"


def derive(
    file: OptionalFile = None,
    example: Example = None,
    format: FormatOption = None,
    notation: NotationOption = Notation.LECTURE,
    brief: Annotated[bool, typer.Option("--brief", help="Write only the one-page checklist.")] = False,
    full: Annotated[bool, typer.Option("--full", help="Write out even expressions that are too long to read.")] = False,
    detail: Annotated[Detail, typer.Option(help="“full” differentiates term by term in step 5.")] = Detail.USUAL,
    form: Annotated[
        WrittenIn,
        typer.Option(help="“structured” writes the equations in velocities, momenta and forces that are defined once."),
    ] = WrittenIn.AUTO,
    describe: Annotated[
        bool, typer.Option("--describe", help="Begin with what the system looks like, in words.")
    ] = False,
    why: Annotated[
        bool,
        typer.Option("--why", help="Write why the equations hold: F = ma for every mass, and its constraint force."),
    ] = False,
    json: Json = False,
    width: Width = None,
    output: Output = None,
    force: Force = False,
) -> None:
    """Derive the equations of motion, step by step; exit 1 if a check fails.

    \b
    Examples:
      lagrangian derive --example lecture-3b
      lagrangian derive carts.toml --brief
      lagrangian derive carts.toml --notation physics -o carts.tex
      lagrangian derive --example pendulum --why
      lagrangian derive --example robot-arm --form structured
    """
    wanted = chosen(format, json, output, force)
    if describe and wanted not in (Format.TEXT, Format.MARKDOWN):
        what = f"--describe is for text and Markdown; {wanted.value} has the picture, or data, instead"
        raise Error(what, fix="--format markdown", code="E406")
    if why and (brief or describe or detail is not Detail.USUAL):
        option = "--brief" if brief else "--describe" if describe else "--detail"
        what = f"{option} is for the steps of a derivation, and --why writes another page"
        raise Error(what, fix=f"leave {option} out, or --why", code="E406")
    from lagrangian.derive import pages

    derivation = open_system(file, example).derive(detail=detail.value, form=form.value)
    if why:
        _reasons(derivation.why, wanted, notation, full, width, output)
        return
    if wanted is Format.TEXT:
        document = pages.lay_out(derivation, notation=notation.value, brief=brief, full=full, described=describe)
        put(write.page_rows(document, columns(width, output)), output)
    elif wanted is Format.MARKDOWN:
        put(pages.to_markdown(derivation, notation=notation.value, brief=brief, full=full, described=describe), output)
    else:
        put(pages.FORMATS[wanted.value](derivation, notation=notation.value, brief=brief, full=full), output)
    if any(check.holds is False for check in derivation.verified):
        say("a check at the end of the derivation does not hold; see its ✗")
        raise typer.Exit(1)


def _reasons(
    why: Why, wanted: Format, notation: Notation, full: bool, columns: int | None, output: Path | None
) -> None:
    """Write why the equations hold."""
    put_report(why.report(), wanted, columns, output, notation=notation, full=full)
    if any(check.holds is False for check in why.checks):
        say("an equality of the page does not hold; see its ✗")
        raise typer.Exit(1)
