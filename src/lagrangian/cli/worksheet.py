"""``lagrangian worksheet``: question sheets, solutions and variants."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from lagrangian.cli.door import put, say
from lagrangian.cli.formats import ENDINGS, Format, Notation, NotationOption, as_json
from lagrangian.cli.progress import status
from lagrangian.cli.terminal import OUTPUT, Example, Force, Json, OptionalFile, open_system, output_option
from lagrangian.errors import Error
from lagrangian.write import check_free

if TYPE_CHECKING:
    from lagrangian.worksheet import Worksheet

MAX_VARIANTS = 1000
"""The most variants of one command."""


class SolutionLength(StrEnum):
    """How much of the derivation the solution sheet has."""

    BRIEF = "brief"
    FULL = "full"


Variants = Annotated[
    int,
    typer.Option(metavar="N", help="Write this many variants instead of the system itself.", min=0, max=MAX_VARIANTS),
]
Seed = Annotated[
    int,
    typer.Option(metavar="N", help="Seed of the first variant; each further variant has the next number.", min=0),
]
SolutionOption = Annotated[SolutionLength, typer.Option(help="The whole derivation, or the checklist.")]
SheetFormat = Annotated[
    Format | None,
    typer.Option(
        "--format",
        "-f",
        help="Format of the sheets. By default, text on standard output and html in a folder.",
        show_default=False,
        rich_help_panel=OUTPUT,
    ),
]
Verify = Annotated[
    bool,
    typer.Option("--verify", help="Read every sheet back and hold it against its model file; exit 1 if one differs."),
]
Folder = Annotated[
    Path | None,
    output_option("Write question sheets, solutions and model files into this folder.", metavar="DIR"),
]


def worksheet(
    file: OptionalFile = None,
    example: Example = None,
    variants: Variants = 0,
    seed: Seed = 1,
    solution: SolutionOption = SolutionLength.FULL,
    format: SheetFormat = None,
    notation: NotationOption = Notation.LECTURE,
    folder: Folder = None,
    verify: Verify = False,
    json: Json = False,
    force: Force = False,
) -> None:
    """Write an exercise: a question sheet, its solution, and random variants of the same difficulty.

    Without -o, the question sheet of the system goes to standard output. --json says what was written and changed.

    \b
    Examples:
      lagrangian worksheet --example cart-pole
      lagrangian worksheet carts.toml -f html -o sheets/
      lagrangian worksheet carts.toml --variants 30 --seed 100 -f latex -o sheets/
      lagrangian worksheet carts.toml --variants 30 -o sheets/ --verify
    """
    if format is Format.JSON:
        raise Error("a sheet is not written as JSON", fix="--format html", code="E402")
    if folder is not None and folder.suffix.lower() in ENDINGS and not folder.is_dir():
        what = f"-o names the folder of the sheets, and '{folder}' has the name of a file"
        raise Error(what, fix="-o sheets/, with the format in -f", code="E402")
    if folder is None and variants:
        raise Error("variants are written into a folder", fix="-o sheets/", code="E401")
    from lagrangian.worksheet import sheet_files

    system = open_system(file, example)
    if folder is None:
        _put_question(system.worksheet(notation=notation.value), (format or Format.TEXT).value, json, verify)
        return
    stem = re.sub(r"[^A-Za-z0-9._-]+", "-", example or Path(file or "").stem).strip("-.") or "system"
    kind = (format or Format.HTML).value
    seeds = [seed + k for k in range(variants)] or [None]
    stems = [stem if s is None else f"{stem}-{s}" for s in seeds]
    _make(folder)
    for name in stems:
        for path in sheet_files(folder, name, kind):
            check_free(path, overwrite=force)
    progress = status.counted("sheets")
    written: list[dict[str, Any]] = []
    for k, (one, name) in enumerate(zip(seeds, stems, strict=True)):
        progress(k, len(seeds))
        sheet = system.worksheet(seed=one, notation=notation.value)
        paths = sheet.save(folder, name, format=kind, brief=solution is SolutionLength.BRIEF, overwrite=force)
        written.append(
            {**sheet.to_dict(), "files": [str(path) for path in paths], **(_checked(sheet) if verify else {})}
        )
        if not json:
            _tell(name, sheet)
            for path in paths:
                say(f"wrote {path}")
    _end(written, json=json, verified=verify)


def _put_question(sheet: Worksheet, format: Any, json: bool, verify: bool) -> None:
    """Write the question sheet to standard output."""
    question, checks = sheet.question(format), _checked(sheet) if verify else {}
    put(as_json({**sheet.to_dict(), "question": question, **checks}) if json else question)
    _exit_unless_held([checks])


def _checked(sheet: Worksheet) -> dict[str, Any]:
    """The checks of a sheet as plain data; what does not hold, and what could not be checked, is said."""
    found = sheet.verify()
    for check in found:
        if not check.holds:
            say(f"{'✗' if check.holds is False else '–'} {sheet.model.name}: {check.what} ({check.figure})")
    return {"checks": [{"what": str(c.what), "holds": c.holds, "figure": c.figure} for c in found]}


def _end(written: Sequence[Mapping[str, Any]], *, json: bool, verified: bool) -> None:
    """Write what was written as JSON, or say that nothing was read back; then what the checks found."""
    if json:
        put(as_json(written))
    elif not verified:
        say("not read back: --verify holds every sheet against its model file")
    _exit_unless_held(written)


def _exit_unless_held(written: Sequence[Mapping[str, Any]]) -> None:
    """Say how many checks hold, and exit with 1 if one does not."""
    found = [check["holds"] for sheet in written for check in sheet.get("checks", ())]
    if found:
        say(f"{sum(holds is True for holds in found)} of {len(found)} checks hold")
    if False in found:
        raise typer.Exit(1)


def _tell(name: str, sheet: Worksheet) -> None:
    """Say what a variant changes, and whether a copied solution of the original would be wrong."""
    if sheet.seed is None:
        return
    copied = f" ({sheet.reason}; a solution of the original may be right here, in other letters)"
    say(f"{name}: {'; '.join(sheet.changes)}{'' if sheet.substantial else copied}")


def _make(folder: Path) -> None:
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        what = f"cannot make the folder '{folder}': {(error.strerror or str(error)).lower()}"
        raise Error(what, fix="make the folder above it first", code="E801") from error
