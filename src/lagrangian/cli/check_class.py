"""``lagrangian check MODEL FOLDER``: every answer in a folder is judged, and files are written."""

from __future__ import annotations

from pathlib import Path

import typer

from lagrangian.check.classes import (
    CheckedClass,
    Judging,
    answer_files,
    check_class,
    check_feedback,
    feedback_files,
    scheme_of,
)
from lagrangian.cli.class_options import ClassOptions
from lagrangian.cli.door import put, say
from lagrangian.cli.formats import Format
from lagrangian.cli.progress import status
from lagrangian.errors import Error
from lagrangian.system import System
from lagrangian.write.tables import check_target

SUMMARIES = [".csv", ".txt", ".json"]
"""The endings of files for the results of a folder."""


def check_folder(
    system: System,
    path: Path,
    options: ClassOptions,
    hint: int,
    format: Format | None,
    json: bool,
    output: Path | None,
    force: bool,
) -> None:
    """Check every answer in a folder; write the statistics and whatever the options ask for."""
    json = json or format is Format.JSON
    _check_targets(path, options, format, output, force)
    scheme = scheme_of(options.points, options.require, options.coordinates.value)
    if (options.moodle or options.gradescope) and not scheme.points:
        raise Error("grades need points", fix="--points T=2,V=2,Xi=2,equations=4", code="E401")
    judging = Judging(
        scheme=scheme,
        hint=3 if options.for_students else hint,
        told=hint,
        feedback=options.feedback_format.value if options.feedback is not None else None,
    )
    found = check_class(
        system.model,
        path,
        judging=judging,
        roster=options.roster,
        store=options.store,
        processes=options.processes,
        progress=status.counted("answers"),
    )
    _write(found, options, json, output, force)
    raise typer.Exit(0 if found.all_right else 1)


def _check_targets(path: Path, options: ClassOptions, format: Format | None, output: Path | None, force: bool) -> None:
    """Raise `Error`, before anything is judged, if a file cannot be written or exists."""
    if format not in (None, Format.TEXT, Format.JSON):
        what = "the results of a folder can be written as text, CSV or JSON"
        raise Error(what, fix="-o summary.csv, or --json", code="E402")
    tables = [(x, [".csv"]) for x in (options.answers, options.moodle, options.gradescope)]
    for target, endings in ((output, SUMMARIES), *tables):
        if target is not None:
            check_target(target, endings, overwrite=force)
    if options.feedback is None:
        return
    if options.feedback.resolve() == path.resolve():
        raise Error("the feedback would lie among the answers", fix="name another folder for it", code="E404")
    names = [file.name for file in answer_files(path)]
    check_feedback(feedback_files(options.feedback, names, options.feedback_format.value), overwrite=force)


def _write(found: CheckedClass, options: ClassOptions, json: bool, output: Path | None, force: bool) -> None:
    if options.feedback is not None:
        found.write_feedback(options.feedback, overwrite=force)
    for target, table in (
        (options.answers, found.answers_to_csv),
        (options.moodle, found.to_moodle),
        (options.gradescope, found.to_gradescope),
    ):
        if target is not None:
            put(table(), target)
    if output is None:
        put(found.to_json() if json else found.to_text())
    else:
        kind = ".json" if json else output.suffix.lower()
        put({".json": found.to_json, ".csv": found.to_csv, ".txt": found.to_text}[kind](), output)
        if not json:
            put(found.to_text())
    if found.reused:
        say(f"{found.reused} of {len(found.rows)} answers were judged before")
