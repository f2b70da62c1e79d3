"""``lagrangian check``: check one answer, or a folder of answers with statistics of the mistakes."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from lagrangian.check.verb import check_answer, check_folder, read_text
from lagrangian.cli.door import put
from lagrangian.cli.formats import Format, FormatOption, chosen, put_report
from lagrangian.cli.terminal import Example, Force, Json, Output, Width, open_system, standard_input
from lagrangian.derive import derive
from lagrangian.errors import Error
from lagrangian.system import System
from lagrangian.write.tables import check_target

SUMMARIES = [".csv", ".txt", ".json"]
"""The endings of files for the results of a folder."""


def check(
    file: Annotated[
        str,
        typer.Argument(
            metavar="FILE",
            help="A model file. With --example, leave it out and give the answer here.",
            show_default=False,
        ),
    ],
    answer: Annotated[
        str | None,
        typer.Argument(
            metavar="ANSWER",
            help="A file with your answer, a folder of such files, or - for standard input.",
            show_default=False,
        ),
    ] = None,
    example: Example = None,
    hint: Annotated[
        int,
        typer.Option(
            help="How much to reveal: 0 only whether it is right, 1 also the wrong line, 2 also the element and "
            "the step, 3 also the term.",
            min=0,
            max=3,
        ),
    ] = 3,
    format: FormatOption = None,
    json: Json = False,
    width: Width = None,
    output: Output = None,
    answers: Annotated[
        Path | None,
        typer.Option(
            metavar="PATH",
            help="If ANSWER is a folder: write a CSV table with one row per answer to this file.",
            show_default=False,
        ),
    ] = None,
    force: Force = False,
) -> None:
    """Check your own answer: equations, energies or a whole derivation; exit 1 if it is wrong or incomplete.

    \b
    Examples:
      lagrangian check carts.toml answer.txt
      lagrangian check --example lecture-3b - --hint 1 < answer.tex
      lagrangian check carts.toml answers/ -o summary.csv --answers table.csv
    """
    model_file, answer_file = _named(file, answer, example)
    path = None if answer_file == "-" else Path(answer_file)
    if path is not None and path.is_dir():
        _check_folder(open_system(model_file, example), path, hint, format, json, output, answers, force)
        return
    if answers is not None:
        raise Error("--answers is for a folder of answers", fix="name a folder, or leave --answers out", code="E404")
    wanted = chosen(format, json, output, force)
    words = standard_input() if path is None else read_text(path)
    name = "<standard input>" if path is None else answer_file
    verdict = check_answer(derive(open_system(model_file, example).model), words, hint=hint, name=name)
    put_report(verdict.report(), wanted, width, output)
    if not verdict.right:
        raise typer.Exit(1)


def _check_folder(
    system: System,
    path: Path,
    hint: int,
    format: Format | None,
    json: bool,
    output: Path | None,
    answers: Path | None,
    force: bool,
) -> None:
    """Check every answer in a folder; write the counts of mistakes and, if requested, a line for each answer."""
    json = json or format is Format.JSON
    if format not in (None, Format.TEXT, Format.JSON):
        raise Error(
            "the results of a folder can be written as text, CSV or JSON", fix="-o summary.csv, or --json", code="E402"
        )
    for target, endings in ((output, SUMMARIES), (answers, [".csv"])):
        if target is not None:
            check_target(target, endings, overwrite=force)
    folder = check_folder(derive(system.model), path, hint=hint)
    if output is None:
        put(folder.to_json() if json else folder.to_text())
    else:
        kind = ".json" if json else output.suffix.lower()
        put({".json": folder.to_json, ".csv": folder.to_csv, ".txt": folder.to_text}[kind](), output)
        if not json:
            put(folder.to_text())
    if answers is not None:
        put(folder.answers_to_csv(), answers)
    raise typer.Exit(0 if folder.all_right else 1)


def _named(file: str, answer: str | None, example: str | None) -> tuple[str | None, str]:
    """The path of the model file, None if an example is used, and the path of the answer or folder."""
    if example is not None:
        if answer is not None:
            raise Error("with --example, give only the answer", fix="leave the model file out", code="E404")
        return None, file
    if answer is None:
        fix = "name a model file and the answer: lagrangian check pendulum.toml answer.txt"
        raise Error("no answer was given to check", fix=fix, code="E401")
    if file == "-" and answer == "-":
        raise Error(
            "only one of the two arguments can be standard input (-)", fix="name a file for the other", code="E404"
        )
    return file, answer
