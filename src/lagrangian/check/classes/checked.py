"""A class that was checked: the rows, the counts, and the tables and files that are written from them."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

from lagrangian.check.classes.counts import ClassCount, counted
from lagrangian.check.classes.feedback import number
from lagrangian.check.classes.judge import FeedbackFormat, Judging
from lagrangian.check.classes.marks import PartMark
from lagrangian.check.classes.rows import ClassRow
from lagrangian.check.classes.students import Roster, Student, unanswered
from lagrangian.check.classes.tables import gradescope_csv, harmless, maximum_of, moodle_csv, to_csv
from lagrangian.errors import Error, ModelError
from lagrangian.records import dataclass
from lagrangian.viewed import cut
from lagrangian.write.files import check_free, write_file

FILES_APART = "; "
"""What stands between the files in a cell: their names have blanks."""
ENDINGS: dict[FeedbackFormat, str] = {"text": ".txt", "markdown": ".md", "html": ".html"}
"""The ending of a feedback file in every format."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CheckedClass:
    """The verdicts on the answers of a class, and what went wrong how often.

    ``rows`` are the answers in the order of their files. ``roster`` is the list of the class, if one was given.
    ``reused`` is the number of answers that were not judged again, ``damaged`` the number of stored verdicts that could
    not be used.
    """

    name: str
    rows: tuple[ClassRow, ...]
    judging: Judging
    roster: Roster | None = None
    reused: int = 0
    damaged: int = 0

    @property
    def all_right(self) -> bool:
        """Whether every answer could be read and is right, with all that is required."""
        return all(row.right for row in self.rows)

    @property
    def counts(self) -> dict[str, int]:
        """The number of answers with each mistake, by name, the most frequent first."""
        found = Counter(name for row in self.rows for name in dict.fromkeys(row.mistakes))
        return dict(sorted(found.items(), key=lambda x: (-x[1], x[0])))

    @cached_property
    def statistics(self) -> tuple[ClassCount, ...]:
        """How many answers have each mistake, and went wrong in each step and with each element, in sentences."""
        return counted(self.rows)

    @property
    def parts(self) -> tuple[tuple[str, float], ...]:
        """The parts that have points, in words, and the most that each can get."""
        return tuple((PartMark(part, 0, of).title, of) for part, of in self.judging.scheme.points.items())

    @property
    def absent(self) -> tuple[Student, ...]:
        """The students of the list without an answer."""
        return () if self.roster is None else unanswered(self.roster, [row.student for row in self.rows])

    # -- tables -----------------------------------------------------------------------------------------------------

    def to_csv(self) -> str:
        """Return the counts as CSV: kind, name, answers, share of all answers, sentence, files."""
        rows = [
            [
                c.kind,
                c.name,
                str(c.count),
                f"{c.count / c.of:.3f}",
                c.sentence,
                FILES_APART.join(map(harmless, c.files)),
            ]
            for c in self.statistics
        ]
        return to_csv(["kind", "name", "answers", "share", "sentence", "files"], rows)

    def answers_to_csv(self) -> str:
        """Return CSV with a row per answer: file, verdict, right lines, lines, first wrong line, mistakes, what it
        lacks, points, trouble."""
        head = ["file", "verdict", "right lines", "lines", "first wrong line", "mistakes", "lacks", "points", "trouble"]
        return to_csv(head, [[harmless(row.file), *row.cells()[1:]] for row in self.rows])

    def to_moodle(self) -> str:
        """Return the points and comments as CSV that Moodle imports: as grading worksheet, or into the gradebook.

        If ``roster`` is the worksheet of the assignment, its lines are kept. Raises `ModelError` without points.
        """
        self._need_points("Moodle")
        return moodle_csv(self.rows, self.roster)

    def to_gradescope(self) -> str:
        """Return the points as CSV with the columns of Gradescope's scores. Raises `ModelError` without points."""
        self._need_points("Gradescope")
        return gradescope_csv(self.rows, self.parts, self.roster)

    def _need_points(self, where: str) -> None:
        if not self.judging.scheme.points:
            fix = 'points={"T": 2, "V": 2, "equations": 4}'
            raise ModelError(f"{where} wants grades, and no points were given", fix=fix, code="E401")

    def to_text(self) -> str:
        """Return a line per answer, then the counts in sentences."""
        wide = max(len(row.file) for row in self.rows)
        lines = [self._line(row, wide) for row in self.rows]
        right = sum(row.right for row in self.rows)
        lines += ["", f"{right} of {len(self.rows)} right"]
        if self.judging.scheme.points:
            scored = [row.points for row in self.rows if row.points is not None]
            if scored:
                mean = number(sum(scored) / len(scored))
                without = len(self.rows) - len(scored)
                left_out = f", without {without} that could not be read or judged" if without else ""
                lines.append(f"{mean} of {number(self.judging.scheme.total)} points on average{left_out}")
        lines += [f"no answer of {s.full_name or s.identifier or s.email or s.number}" for s in self.absent]
        if self.roster is not None:
            fits = {row.file: len(self.roster.fitting(row.file)) for row in self.rows if row.student is None}
            lines += [f"{file} {_belongs(count)}" for file, count in fits.items()]
        lines += self._scaled()
        if self.damaged:
            are = "verdict was" if self.damaged == 1 else "verdicts were"
            lines.append(f"{self.damaged} stored {are} damaged and not used")
        last = ""
        for count in self.statistics:
            lines += [""] if count.kind != last else []
            lines.append(count.sentence)
            last = count.kind
        return "\n".join(lines) + "\n"

    def _scaled(self) -> list[str]:
        """What is said if Moodle's worksheet has another maximum grade than the sum of the points."""
        total = self.judging.scheme.total
        if self.roster is None or not total:
            return []
        found = {maximum_of(self.roster.header, line) for line in self.roster.lines} - {None, total}
        return [f"grades for Moodle: {number(total)} points are its maximum grade {number(x)}" for x in found if x]

    def _line(self, row: ClassRow, wide: int) -> str:
        points = f"{number(row.points):>6}" if row.most and row.points is not None else " " * 6 if row.most else ""
        return f"{row.file:<{wide}}{points}  {row.said}{': ' if row.detail else ''}{row.detail}"

    def to_dict(self) -> dict[str, Any]:
        """Return plain data: the answers, the counts and the statistics."""
        return {
            "answers": [row.to_dict() for row in self.rows],
            "counts": self.counts,
            "statistics": [c.to_dict() for c in self.statistics],
        }

    def to_json(self) -> str:
        """Return everything as JSON text."""
        return json.dumps(self.to_dict(), ensure_ascii=False, indent=1, allow_nan=False) + "\n"

    # -- files ------------------------------------------------------------------------------------------------------

    def write_feedback(self, folder: str | Path, *, overwrite: bool = False) -> tuple[Path, ...]:
        """Write a file for every student into a folder, which is made if it does not exist; return the paths.

        Every file is written completely or not at all, and none unless all may be written. Raises `Error` if one
        exists (unless ``overwrite``), and `ModelError` if the class was checked without ``feedback``.
        """
        if self.judging.feedback is None:
            raise ModelError("no feedback was made", fix='check_class(…, feedback="html")', code="E401")
        targets = feedback_files(Path(folder), [row.file for row in self.rows], self.judging.feedback)
        made(Path(folder))
        check_feedback(targets, overwrite=overwrite)
        return tuple(write_file(path, row.feedback or "") for path, row in zip(targets, self.rows, strict=True))

    def __repr__(self) -> str:
        """Name the system and say how many answers are right."""
        right = sum(row.right for row in self.rows)
        return cut(f"<CheckedClass, {self.name}: {right} of {len(self.rows)} right>")

    def __str__(self) -> str:
        """Return the class as text."""
        return self.to_text()


def _belongs(count: int) -> str:
    """What is said of an answer to whose name so many students of the list fit, none or several."""
    return (
        f"fits {count} students of the list: put the ID number into its name"
        if count
        else "belongs to nobody in the list"
    )


def feedback_files(folder: Path, files: Sequence[str], format: FeedbackFormat) -> list[Path]:
    """The paths of the feedback files: named as the answers, with their endings where two would have one name."""
    bare = [Path(file).parts[0] if "/" in file else Path(file).stem for file in files]
    often = Counter(name.casefold() for name in bare)
    names = [b if often[b.casefold()] == 1 else file.replace("/", "_") for b, file in zip(bare, files, strict=True)]
    return [folder / f"{name}{ENDINGS[format]}" for name in names]


def check_feedback(targets: Sequence[Path], *, overwrite: bool) -> None:
    """Raise `Error`, before long work begins, if a feedback file cannot be written or exists (unless
    ``overwrite``)."""
    for path in targets:
        if path.parent.is_dir():
            check_free(path, overwrite=overwrite)
        elif path.parent.exists():
            raise Error(f"'{path.parent}' is not a folder", fix="name a folder for the feedback", code="E801")


def made(folder: Path) -> None:
    """Make a folder if it does not exist; raises `Error` if that is impossible."""
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        what = f"cannot make the folder '{folder}': {(error.strerror or str(error)).lower()}"
        raise Error(what, fix="make the folder above it first", code="E801") from error
