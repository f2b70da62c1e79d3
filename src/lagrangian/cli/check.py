"""``lagrangian check``: check one answer, or a folder of answers with statistics of the mistakes."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from lagrangian.cli.class_options import Allowed, ClassOptions, FeedbackKind
from lagrangian.cli.formats import FormatOption, chosen, put_report
from lagrangian.cli.terminal import Example, Force, Json, Output, Width, open_system, standard_bytes
from lagrangian.errors import Error

CLASS = "A folder of answers"
"""The group of options for a folder in the help."""


def _of_class(metavar: str, help: str, **limits: Any) -> Any:
    """An option of that group."""
    return typer.Option(metavar=metavar, help=help, show_default=False, rich_help_panel=CLASS, **limits)


ModelFile = Annotated[
    str,
    typer.Argument(
        metavar="FILE",
        help="A model file. With --example, leave it out and give the answer here.",
        show_default=False,
    ),
]
AnswerPath = Annotated[
    str | None,
    typer.Argument(
        metavar="ANSWER",
        help="A file with your answer, a folder of such files, or - for standard input.",
        show_default=False,
    ),
]
Hint = Annotated[
    int,
    typer.Option(
        metavar="LEVEL",
        help="How much to reveal: 0 only whether it is right, 1 also the wrong line, 2 also the element and "
        "the step, 3 also the term.",
        min=0,
        max=3,
    ),
]
Require = Annotated[
    str | None, _of_class("PARTS", "Parts without which a right answer is incomplete: equations,T,V,L,Xi.")
]
Coordinates = Annotated[
    Allowed,
    typer.Option(help="Whether an answer in other coordinates than the model's is accepted.", rich_help_panel=CLASS),
]
Points = Annotated[
    str | None, _of_class("POINTS", "Points by part, T=2,V=2,Xi=2,equations=4, or a TOML file with them.")
]
Feedback = Annotated[
    Path | None,
    _of_class("DIR", "Write a file for every student to this folder; --hint then limits what students are told."),
]
FeedbackFormat = Annotated[FeedbackKind, typer.Option(help="Format of the files of --feedback.", rich_help_panel=CLASS)]
AnswersTable = Annotated[Path | None, _of_class("PATH", "Write a CSV table with a row for every answer to this file.")]
MoodleTable = Annotated[Path | None, _of_class("PATH", "Write the grades and comments for Moodle to this CSV file.")]
GradescopeTable = Annotated[
    Path | None, _of_class("PATH", "Write the points in the columns of Gradescope to this CSV file.")
]
Roster = Annotated[
    Path | None, _of_class("PATH", "The list of the class: Moodle's grading worksheet, or a roster, as CSV.")
]
Store = Annotated[
    Path | None, _of_class("PATH", "Keep the verdicts in this file, and judge only answers that are new or changed.")
]
Processes = Annotated[
    int | None, _of_class("N", "Processes that judge answers; by default as many as speed it up.", min=1)
]


def check(
    file: ModelFile,
    answer: AnswerPath = None,
    example: Example = None,
    hint: Hint = 3,
    format: FormatOption = None,
    json: Json = False,
    width: Width = None,
    output: Output = None,
    require: Require = None,
    coordinates: Coordinates = Allowed.ANY,
    points: Points = None,
    feedback: Feedback = None,
    feedback_format: FeedbackFormat = FeedbackKind.HTML,
    answers: AnswersTable = None,
    moodle: MoodleTable = None,
    gradescope: GradescopeTable = None,
    roster: Roster = None,
    store: Store = None,
    processes: Processes = None,
    force: Force = False,
) -> None:
    """Check your own answer: equations, energies or a whole derivation; exit 1 if it is wrong or incomplete.

    \b
    Examples:
      lagrangian check carts.toml answer.txt
      lagrangian check --example lecture-3b - --hint 1 < answer.tex
      lagrangian check carts.toml answers/ -o summary.csv --answers table.csv
      lagrangian check carts.toml answers/ --points T=2,V=2 --feedback replies/
    """
    from lagrangian.check.reading import decode_answer, read_text
    from lagrangian.check.verb import check_answer
    from lagrangian.cli.check_class import check_folder
    from lagrangian.structured.choose import derive_in_form

    model_file, answer_file = _named(file, answer, example)
    path = None if answer_file == "-" else Path(answer_file)
    options = ClassOptions(
        require, coordinates, points, feedback, feedback_format, answers, moodle, gradescope, roster, store, processes
    )
    if path is not None and path.is_dir():
        check_folder(open_system(model_file, example), path, options, hint, format, json, output, force)
        return
    options.refuse()
    wanted = chosen(format, json, output, force)
    words = decode_answer(standard_bytes(), "<standard input>") if path is None else read_text(path)
    name = "<standard input>" if path is None else answer_file
    verdict = check_answer(derive_in_form(open_system(model_file, example).model), words, hint=hint, name=name)
    put_report(verdict.report(), wanted, width, output)
    if not verdict.right:
        raise typer.Exit(1)


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
