"""``lagrangian check``: is an answer right? One, or a folder of them with a table of what went wrong how often."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from lagrangian.checking import check_answer, check_folder, read_text
from lagrangian.commands.terminal import Example, Output, open_system, put, standard_input
from lagrangian.derive import derive


def check(
    file: Annotated[str, typer.Argument(help="A model file; with --example, the answer.", show_default=False)],
    answer: Annotated[
        str | None,
        typer.Argument(help="A file with an answer, a folder of them, or - for standard input.", show_default=False),
    ] = None,
    example: Example = None,
    hint: Annotated[
        int, typer.Option(help="0 right or not, 1 the line, 2 element and step, 3 the term.", min=0, max=3)
    ] = 3,
    json: Annotated[bool, typer.Option("--json", help="Write data.")] = False,
    width: Annotated[int, typer.Option(help="Columns of the text.", min=40, max=400)] = 80,
    output: Output = None,
    answers: Annotated[
        Path | None,
        typer.Option(help="For a folder: write a table with a line for each answer here.", show_default=False),
    ] = None,
) -> None:
    """Check an answer: equations, energies or a whole derivation; exit 1 if it is wrong or something is missing."""
    model_file, answer_file = _named(file, answer, example)
    derivation = derive(open_system(model_file, example).model)
    path = Path(answer_file)
    if answer_file != "-" and path.is_dir():
        folder = check_folder(derivation, path, hint=hint)
        put(folder.to_json() if json else folder.to_csv() if output is not None else folder.to_text(), output)
        if output is not None and not json:
            put(folder.to_text(), None)
        if answers is not None:
            put(folder.answers_to_csv(), answers)
        raise typer.Exit(0 if folder.all_right else 1)
    if answers is not None:
        raise typer.BadParameter("--answers is for a folder of answers")
    words = standard_input() if answer_file == "-" else read_text(path)
    verdict = check_answer(derivation, words, hint=hint, name="<standard input>" if answer_file == "-" else answer_file)
    put(verdict.to_json() if json else verdict.to_text(width=width), output)
    if not verdict.right:
        raise typer.Exit(1)


def _named(file: str, answer: str | None, example: str | None) -> tuple[str | None, str]:
    """The model file, None where an example stands for it, and the answer's file or folder."""
    if example is not None:
        if answer is not None:
            raise typer.BadParameter("with --example, give the answer alone")
        return None, file
    if answer is None:
        raise typer.BadParameter("name a model file and the answer: lagrangian check pendulum.toml answer.txt")
    if file == "-" and answer == "-":
        raise typer.BadParameter("only one of the two can be standard input")
    return file, answer
