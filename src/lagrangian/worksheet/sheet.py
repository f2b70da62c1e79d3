"""The two sheets of a system: the questions, with what is given in words and letters, and the solution."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import Any, Literal, TypeAlias, cast, get_args

from lagrangian.derivation import Derivation, derive_and_verify
from lagrangian.derive import pages
from lagrangian.errors import ModelError
from lagrangian.look.heading import head_picture
from lagrangian.model import Model
from lagrangian.page.formula import Check, text
from lagrangian.page.report import Part, Report
from lagrangian.read import dumps, loads
from lagrangian.records import dataclass, field
from lagrangian.structured.choose import derive_in_form
from lagrangian.viewed import cut
from lagrangian.worksheet.dice import checked_seed
from lagrangian.worksheet.given import asked, given
from lagrangian.worksheet.proof import sheet_checks
from lagrangian.worksheet.variant import variant_of
from lagrangian.write import check_free, html_page, latex, markdown, write_file
from lagrangian.write import text as plain_text
from lagrangian.write.document import Document
from lagrangian.write.quantities import Notation
from lagrangian.write.report import lay_out_report

SheetFormat: TypeAlias = Literal["text", "markdown", "latex", "html"]
"""The formats of sheets."""

ENDINGS: dict[SheetFormat, str] = {"text": ".txt", "markdown": ".md", "latex": ".tex", "html": ".html"}


@dataclass(frozen=True, eq=False)
class Worksheet:
    """An exercise: a question sheet, its solution, and the model file against which answers are checked.

    ``seed`` is None for the system itself; otherwise ``changes`` say how the variant differs from it, and
    ``substantial`` whether by more than letters, values and coordinates; if not, ``reason`` says why.
    """

    model: Model
    seed: int | None = None
    changes: tuple[str, ...] = ()
    substantial: bool = False
    reason: str = ""
    notation: Notation = field(default="lecture", kw_only=True)

    @cached_property
    def derivation(self) -> Derivation:
        """The derivation, which is the solution."""
        return derive_and_verify(self.model)

    def to_toml(self) -> str:
        """Return the model file, with which `lagrangian check` judges answers to this sheet."""
        return dumps(self.model)

    def to_dict(self) -> dict[str, Any]:
        """Return plain data: the name, the seed, what was changed, and why no more than that."""
        own = {"changes": list(self.changes), "substantial": self.substantial, "reason": self.reason}
        return {"name": self.model.name, "seed": self.seed, **own}

    def question(self, format: SheetFormat = "text") -> str:
        """Return the question sheet: figure, what is given in words and letters, and the seven steps.

        Raises `ModelError` for an unknown format.
        """
        _check_format(format)
        document = self._document(format)
        if format == "html":
            return html_page.page(document, "questions")
        if format == "latex":
            return latex.page(document)
        return markdown.page(document) if format == "markdown" else plain_text.page(document, 80)

    def solution(self, format: SheetFormat = "text", *, brief: bool = False) -> str:
        """Return the solution sheet: the derivation, whole or ``brief``. Raises `ModelError` for an unknown format."""
        _check_format(format)
        return pages.FORMATS[format](self.derivation, notation=self.notation, brief=brief, full=False)

    def verify(self) -> tuple[Check, ...]:
        """Hold the sheets against the model file, which is read again as whoever checks answers reads it.

        The solution must be a right answer to the file, in every format, and the question sheet must print the values
        of the file. ``holds`` is None for what cannot be read back, and the figure says why.
        """

        def question(format: str) -> str:
            return self.question(cast("SheetFormat", format))

        def solution(format: str, brief: bool) -> str:
            return self.solution(cast("SheetFormat", format), brief=brief)

        return sheet_checks(lambda: derive_in_form(loads(self.to_toml()).model()), question, solution)

    def save(
        self,
        folder: str | Path,
        stem: str,
        *,
        format: SheetFormat = "html",
        brief: bool = False,
        overwrite: bool = False,
    ) -> tuple[Path, ...]:
        """Write ``stem``-questions, ``stem``-solution and ``stem``.toml into a folder; return their paths.

        Every file is written completely or not at all. Raises `Error` if one exists, unless ``overwrite``.
        """
        targets = sheet_files(Path(folder), stem, format)
        for path in targets:
            check_free(path, overwrite=overwrite)
        texts = (self.question(format), self.solution(format, brief=brief), self.to_toml())
        return tuple(write_file(path, words) for path, words in zip(targets, texts, strict=True))

    def __repr__(self) -> str:
        """Name the system and the changes."""
        return cut(f"<Worksheet, {self.model.name}{': ' if self.changes else ''}{'; '.join(self.changes)}>")

    def __str__(self) -> str:
        """Return the question sheet as text."""
        return self.question()

    # -- the question sheet -----------------------------------------------------------------------------------------

    def _document(self, format: SheetFormat) -> Document:
        picture = head_picture(self.model)
        drawn = picture is not None and not picture.trouble
        seen = picture.description.partition(" Coordinates: ")[0] if picture is not None and drawn else ""
        parts = [
            Part(text("What is given"), tuple(given(self.model, seen))),
            Part(text("What is asked"), tuple(asked(self.model))),
        ]
        page = lay_out_report(Report(self.model.name, self.model, tuple(parts)), notation=self.notation)
        return replace(page, picture=picture if drawn and format in ("html", "latex") else None)


def _check_format(format: object) -> None:
    if format not in get_args(SheetFormat):
        fix = f"use one of {', '.join(get_args(SheetFormat))}"
        raise ModelError(f"a sheet is not written as {format!r}", fix=fix, code="E406")


def sheet_files(folder: Path, stem: str, format: SheetFormat) -> tuple[Path, Path, Path]:
    """The paths of the two sheets and of the model file."""
    ending = ENDINGS[format]
    return folder / f"{stem}-questions{ending}", folder / f"{stem}-solution{ending}", folder / f"{stem}.toml"


def worksheet(model: Model, *, seed: int | None = None, notation: Notation = "lecture") -> Worksheet:
    """Return the exercise of a system or, with a seed, of a variant of it; see `lagrangian.System.worksheet`."""
    if seed is None:
        return Worksheet(model, notation=notation)
    found = variant_of(model, checked_seed(seed))
    return Worksheet(found.model, seed, found.changes, found.substantial, found.reason, notation=notation)
