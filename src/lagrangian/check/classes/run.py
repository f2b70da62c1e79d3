"""Checks the answers of a class: finds the files, judges what is not in the store, and puts the results together."""

from __future__ import annotations

import contextlib
import json
import logging
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path

from lagrangian.check.classes.checked import CheckedClass
from lagrangian.check.classes.judge import Judge, Judging, Record, untold, with_page
from lagrangian.check.classes.processes import Task, judged_by_processes, process_count
from lagrangian.check.classes.rows import ClassRow
from lagrangian.check.classes.scheme import MarkingScheme
from lagrangian.check.classes.store import VerdictStore, fingerprint, key_of
from lagrangian.check.classes.students import MOODLE_FILE, Student, read_roster, student_of
from lagrangian.derive import Derived
from lagrangian.errors import Error, ModelError
from lagrangian.model import Model
from lagrangian.read import MAX_BYTES, dumps
from lagrangian.records import dataclass
from lagrangian.structured.choose import derive_in_form

_log = logging.getLogger(__name__)

ANSWER = "the answer"
"""What every answer is called in messages, because equal ones are judged once."""

Progress = Callable[[int, int], None]
"""A callback with the number of answers that are judged and of all."""


@dataclass(frozen=True)
class AnswerFile:
    """The file of an answer: its name in the results, its content, or why it has none."""

    name: str
    content: bytes
    trouble: str = ""


def answer_files(folder: Path) -> list[AnswerFile]:
    """The files of a folder by name, and the single files in folders that Moodle made for submissions.

    Raises `Error` if there are none.
    """
    found: list[AnswerFile] = []
    try:
        entries = sorted(p for p in folder.iterdir() if not p.name.startswith("."))
    except OSError as error:
        what = f"cannot read '{folder}': {(error.strerror or str(error)).lower()}"
        raise Error(what, fix="name a folder of answers", code="E702") from error
    for path in entries:
        if path.is_file():
            found.append(_content(path, path.name))
        elif path.is_dir() and MOODLE_FILE.fullmatch(path.name):
            found.append(_submitted(path))
    if not found:
        raise Error(f"the folder '{folder}' holds no answers", fix="put one answer in each file", code="E702")
    return found


def _tell_others(folder: Path) -> None:
    """Warn of what lies in a folder of answers and is not read: other folders, links to nothing, pipes."""
    for path in sorted(p for p in folder.iterdir() if not p.name.startswith(".")):
        if path.is_dir() and not MOODLE_FILE.fullmatch(path.name):
            _log.warning("'%s' is a folder, and what is in it is not read", path.name)
        elif path.is_symlink() and not path.exists():
            _log.warning("'%s' is a link to nothing, and is not read", path.name)
        elif not path.is_dir() and not path.is_file():
            _log.warning("'%s' is no file, and is not read", path.name)


def _submitted(folder: Path) -> AnswerFile:
    files = sorted(p for p in folder.iterdir() if p.is_file() and not p.name.startswith("."))
    if len(files) == 1:
        return _content(files[0], f"{folder.name}/{files[0].name}")
    return AnswerFile(f"{folder.name}/", b"", f"the folder holds {len(files)} files; one answer is one file")


def _content(path: Path, name: str) -> AnswerFile:
    try:
        with path.open("rb") as file:
            return AnswerFile(name, file.read(MAX_BYTES + 1))
    except OSError as error:
        return AnswerFile(name, b"", f"cannot read '{path}': {(error.strerror or str(error)).lower()}")


def given_answers(answers: str | Path | Mapping[str, str]) -> list[AnswerFile]:
    """The answers of a folder, or those given as texts by name; raises `Error` if there are none."""
    if isinstance(answers, str | Path):
        found = answer_files(Path(answers))
        _tell_others(Path(answers))
        return found
    if not isinstance(answers, Mapping) or not all(isinstance(x, str) for item in answers.items() for x in item):
        what = "the answers of a class are a folder, or texts by name"
        raise ModelError(what, fix='check_class("answers/"), or check_class({"ann": "m*x\'\' = F"})', code="E406")
    if not answers:
        raise ModelError("there are no answers", fix='check_class({"ann": "m*x\'\' = F"})', code="E702")
    return [AnswerFile(name, text.encode("utf-8", "surrogatepass")) for name, text in answers.items()]


def check_class(
    model: Model,
    answers: str | Path | Mapping[str, str],
    *,
    judging: Judging,
    derivation: Derived | None = None,
    roster: str | Path | None = None,
    store: str | Path | None = None,
    processes: int | None = None,
    progress: Progress | None = None,
) -> CheckedClass:
    """Check the answers of a class; see `lagrangian.Derivation.check_class`."""
    _check_coordinates(judging.scheme, model)
    listed = read_roster(Path(roster)) if roster is not None else None
    files = given_answers(answers)
    students = [listed.find(file.name) if listed else None for file in files]
    _check_once([file.name for file in files], students)
    _log.info("checking %d answers", len(files))
    run = _ClassRun(model, derivation, judging, files, processes, progress)
    with VerdictStore(Path(store)) if store is not None else contextlib.nullcontext() as kept:
        records = run.records(kept)
    rows = tuple(
        ClassRow(file.name, record, judging.scheme.total, judging.hint, student)
        for file, record, student in zip(files, records, students, strict=True)
    )
    damaged = kept.damaged if kept is not None else 0
    return CheckedClass(name=model.name, rows=rows, judging=judging, roster=listed, reused=run.reused, damaged=damaged)


def _check_coordinates(scheme: MarkingScheme, model: Model) -> None:
    known = {c.name for c in model.coordinates}
    for part in scheme.points:
        name = part.partition("_")[2]
        if name and name not in known:
            fix = f"the coordinates are {', '.join(sorted(known))}"
            raise ModelError(
                f"points are given for '{part}', and there is no coordinate '{name}'", fix=fix, code="E402"
            )


def _check_once(files: Sequence[str], students: Sequence[Student | None]) -> None:
    """Raise `Error` if two answers belong to one student of the list, or to one participant by their names."""
    seen: dict[tuple[str, object], str] = {}
    for file, student in zip(files, students, strict=True):
        of_file = student_of(file)
        keys: list[tuple[str, object]] = [("participant", of_file.identifier)] if of_file.identifier else []
        keys += [("row", student.row)] if student is not None else []
        for key in keys:
            if key in seen:
                one = student or of_file
                who = one.full_name or one.identifier or one.email
                what = f"both '{seen[key]}' and '{file}' are answers of {who}"
                raise Error(what, fix="keep one of them in the folder", code="E404")
            seen[key] = file


class _ClassRun:
    """One check of a class: judges the answers that the store does not have."""

    def __init__(
        self,
        model: Model,
        derivation: Derived | None,
        judging: Judging,
        files: Sequence[AnswerFile],
        processes: int | None,
        progress: Progress | None,
    ) -> None:
        self.model, self.derivation, self.judging = model, derivation, judging
        self.files, self.processes, self.progress = files, processes, progress
        self.reused = 0

    def records(self, store: VerdictStore | None) -> list[Record]:
        """Return the records of all answers, in the order of the files."""
        found: dict[int, Record] = {}
        keys: dict[int, str] = {}
        subject = self._subject() if store is not None else ""
        for k, file in enumerate(self.files):
            if file.trouble:
                found[k] = untold(file.name, file.trouble, read=False)
            elif store is not None:
                keys[k] = key_of(file.content, subject)
                if (known := store.get(keys[k])) is not None:
                    found[k] = known
                    self.reused += 1
        alike: dict[bytes, list[int]] = {}
        for k, file in enumerate(self.files):
            if k not in found:
                alike.setdefault(file.content, []).append(k)
        tasks = [(group[0], ANSWER, content) for content, group in alike.items()]
        self._tell(len(found))
        for k, record, final in self._judged(tasks):
            found.update(dict.fromkeys(alike[self.files[k].content], record))
            if store is not None and final:
                store.put(keys[k], record)
            self._tell(len(found))
        records = [{**found[k], "file": file.name} for k, file in enumerate(self.files)]
        return [with_page(record, self.model, self.judging) for record in records]

    def _subject(self) -> str:
        """What a stored verdict depends on besides the answer."""
        return json.dumps([fingerprint(), dumps(self.model), self.judging.to_dict()], sort_keys=True)

    def _judged(self, tasks: Sequence[Task]) -> Iterator[tuple[int, Record, bool]]:
        if not tasks:
            return
        count = process_count(self.processes, len(tasks))
        if count > 1 and (model := self._written()) is not None:
            yield from judged_by_processes(model, self.judging, tasks, count)
            return
        judge = Judge(self.derivation or derive_in_form(self.model), self.judging)
        for k, file, content in tasks:
            yield k, judge.judge(file, content), True

    def _written(self) -> str | None:
        """The text of the model for other processes; None if it cannot be written and one process was not excluded."""
        try:
            return dumps(self.model)
        except Error:
            if self.processes is not None:
                raise
            return None

    def _tell(self, done: int) -> None:
        if self.progress is not None:
            self.progress(done, len(self.files))
