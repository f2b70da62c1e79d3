"""The results of `System.check` and `Derivation.check`: the verdict on an answer, with the methods that write it."""

from __future__ import annotations

import csv
import io
import json
from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from lagrangian import check
from lagrangian.advice import Advice, Argument
from lagrangian.check.reading import Answer, parse_answer
from lagrangian.derive import Derived
from lagrangian.errors import Error, ModelError
from lagrangian.model import Model
from lagrangian.page.report import Report
from lagrangian.read import MAX_BYTES, decode
from lagrangian.viewed import Brief, cut
from lagrangian.write.written import Written


@dataclass(frozen=True, eq=False, kw_only=True)
class CheckedAnswer(Written, check.Verdict):
    """Whether an answer is right, in what sense, or where it is wrong and why; see `lagrangian.check.Verdict`."""

    model: Model

    def report(self) -> Report[Model]:
        """Return the verdict as words and tables; ``hint`` limits how much it reveals."""
        return check.report(self, self.model)

    def __repr__(self) -> str:
        """Name the system and the verdict; ``print`` shows the whole result."""
        return cut(f"<CheckedAnswer, {self.model.name}: {self.status.value}>")


def check_answer(derivation: Derived, answer: Any, *, hint: int = 3, name: str | None = None) -> CheckedAnswer:
    """Check an answer: text or LaTeX, an `Answer` that was read, SymPy equations, or energies by name.

    ``hint`` limits how much the result reveals: 0 right or wrong, 1 the line, 2 the element and the step, 3 the term.
    ``name`` is the file of the answer, for messages. Raises `ParseError`, with the place, if a text cannot be read.
    """
    if isinstance(hint, bool) or hint not in (0, 1, 2, 3):
        raise ModelError(f"a hint has a level from 0 to 3 (got {hint})", fix=Advice(Argument("hint", "2")), code="E406")
    if isinstance(answer, str):
        answer = parse_answer(answer, derivation.model, name=name)
    lines = check.lines_of(answer) if isinstance(answer, Answer) else check.lines_from(answer)
    return CheckedAnswer(**vars(check.check(derivation, lines, hint=hint)), model=derivation.model)


@dataclass(frozen=True)
class FolderRow(Brief):
    """One answer of a folder: its file and the verdict, or the reason why there is no verdict.

    ``read`` says whether its text could be read.
    """

    file: str
    verdict: CheckedAnswer | None
    trouble: str = ""
    read: bool = True

    @property
    def said(self) -> str:
        """The verdict in words."""
        if self.verdict is not None:
            return self.verdict.status.value
        return "cannot be judged" if self.read else "cannot be read"

    @property
    def mistakes(self) -> tuple[str, ...]:
        """The names of the mistakes; "unexplained" if it is wrong and none was found; empty below hint level 2."""
        if self.verdict is None:
            return ("unjudged",) if self.read else ("unreadable",)
        if self.verdict.status.right:
            return ()
        if self.verdict.status is check.Status.INCOMPLETE:
            return ("incomplete",)
        if self.verdict.hint < 2:
            return ("wrong",)
        return tuple(m.name for m in self.verdict.mistakes) or ("unexplained",)

    def cells(self) -> list[str]:
        """The row in the table of answers; the hint level limits how much it reveals."""
        v = self.verdict
        told = v is not None and v.hint >= 1
        right = sum(f.status.right for f in v.findings) if v is not None and told else ""
        lines = len(v.findings) if v is not None and told else ""
        first = v.first_wrong.line.number if v is not None and told and v.first_wrong is not None else ""
        return [self.file, self.said, str(right), str(lines), str(first), " ".join(self.mistakes), self.trouble]

    def to_dict(self) -> dict[str, Any]:
        """Return plain data."""
        found = self.verdict.to_dict() if self.verdict is not None else None
        return {"file": self.file, "verdict": found, "mistakes": list(self.mistakes), "trouble": self.trouble or None}


@dataclass(frozen=True)
class CheckedFolder(Brief):
    """The verdicts on a folder of answers, and how often each mistake occurred, the most frequent first."""

    rows: tuple[FolderRow, ...]

    @property
    def all_right(self) -> bool:
        """Whether every answer could be read and is right."""
        return all(row.verdict is not None and row.verdict.right for row in self.rows)

    @property
    def counts(self) -> dict[str, int]:
        """The number of answers with each mistake."""
        found = Counter(name for row in self.rows for name in dict.fromkeys(row.mistakes))
        return dict(sorted(found.items(), key=lambda x: (-x[1], x[0])))

    def to_csv(self) -> str:
        """Return the counts as CSV: mistake, answers, share of all answers, the files."""
        rows: list[list[str]] = []
        for name, count in self.counts.items():
            files = [r.file for r in self.rows if name in r.mistakes]
            rows.append([name, str(count), f"{count / len(self.rows):.3f}", " ".join(files)])
        return _csv(["mistake", "answers", "share", "files"], rows)

    def answers_to_csv(self) -> str:
        """Return CSV with a row per answer: file, verdict, right lines, lines, first wrong line, mistakes, trouble."""
        head = ["file", "verdict", "right lines", "lines", "first wrong line", "mistakes", "trouble"]
        return _csv(head, [row.cells() for row in self.rows])

    def to_text(self) -> str:
        """Return a line per answer, then the counts."""
        wide = max(len(row.file) for row in self.rows)
        lines = []
        for row in self.rows:
            named = [m for m in row.mistakes if m not in ("incomplete", "wrong")]
            detail = row.trouble or ", ".join(named)
            lines.append(f"{row.file:<{wide}}  {row.said}{': ' if detail else ''}{detail}")
        right = sum(row.verdict is not None and row.verdict.right for row in self.rows)
        lines += ["", f"{right} of {len(self.rows)} right"]
        lines += [f"{count:>4}  {name}" for name, count in self.counts.items()]
        return "\n".join(lines) + "\n"

    def to_json(self) -> str:
        """Return everything as JSON text."""
        data = {"answers": [row.to_dict() for row in self.rows], "counts": self.counts}
        return json.dumps(data, ensure_ascii=False, indent=1, allow_nan=False) + "\n"


def _csv(head: list[str], rows: list[list[str]]) -> str:
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(head)
    writer.writerows(rows)
    return out.getvalue()


def check_folder(derivation: Derived, folder: Path, *, hint: int = 3) -> CheckedFolder:
    """Check every file in a folder, in the order of their names; a file that cannot be read is reported in its row.

    Raises `Error` if the folder contains no files.
    """
    files = sorted(p for p in folder.iterdir() if p.is_file() and not p.name.startswith("."))
    if not files:
        raise Error(f"the folder '{folder}' holds no answers", fix="put one answer in each file", code="E702")
    return CheckedFolder(tuple(_row(derivation, path, hint) for path in files))


def _row(derivation: Derived, path: Path, hint: int) -> FolderRow:
    try:
        answer = parse_answer(read_text(path), derivation.model, name=path.name)
    except Error as error:
        return FolderRow(path.name, None, _in_a_line(error), read=False)
    try:
        return FolderRow(path.name, check_answer(derivation, answer, hint=hint))
    except Error as error:
        return FolderRow(path.name, None, _in_a_line(error))


def _in_a_line(error: Error) -> str:
    return " ".join(str(error).split())


def read_text(path: Path) -> str:
    """Return the text of an answer's file; raises `Error` if it cannot be read."""
    try:
        with path.open("rb") as file:
            data = file.read(MAX_BYTES + 1)
    except OSError as error:
        what = f"cannot read '{path}': {(error.strerror or str(error)).lower()}"
        raise Error(what, fix="check the path; - is standard input", code="E702") from error
    return decode(data, str(path))
