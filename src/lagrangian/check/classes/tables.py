"""The tables of a class as CSV: the answers, Moodle's grading worksheet, and the columns of Gradescope's scores."""

from __future__ import annotations

import csv
import html
import io
from collections.abc import Iterable, Sequence

from lagrangian.check.classes.feedback import number
from lagrangian.check.classes.rows import ClassRow
from lagrangian.check.classes.students import Roster, Student, student_of

MOODLE = (
    "Identifier",
    "Full name",
    "ID number",
    "Email address",
    "Grade",
    "Maximum grade",
    "Last modified (grade)",
    "Feedback comments",
)
"""The columns of Moodle's offline grading worksheet that an import needs or reads.

Source: Moodle's `mod/assign/feedback/offline/importer.php` needs "Identifier", "Grade" and "Last modified (grade)",
and reads the columns of the feedback plugins, "Feedback comments" among them.
"""

GRADE, MOST, COMMENTS = "Grade", "Maximum grade", "Feedback comments"

LONGEST_NUMBER = 15
"""Characters from which the digits of a cell are no grade."""

GRADESCOPE = ("First Name", "Last Name", "SID", "Email", "Total Score", "Max Points", "Status")
"""The columns with which Gradescope's table of scores begins; one for every question follows."""


def to_csv(header: Sequence[str], rows: Iterable[Sequence[str]], *, end: str = "\n") -> str:
    """Return a table as CSV."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator=end)
    writer.writerow(header)
    writer.writerows(rows)
    return out.getvalue()


def harmless(cell: str) -> str:
    """A cell from a file name that no spreadsheet takes for a formula."""
    return f"'{cell}" if cell[:1] in ("=", "+", "-", "@", "\t", "\r") else cell


def moodle_csv(rows: Sequence[ClassRow], roster: Roster | None) -> str:
    """Return the grades and comments as Moodle's grading worksheet.

    With the worksheet that Moodle exported as ``roster`` its lines are kept, and only the grade and the comment are
    filled in. The grade is the share of the points times the worksheet's maximum grade, if that is a number above 0.
    An answer that could not be judged gets a comment and no grade.
    """
    if roster is None:
        return to_csv(MOODLE, [_moodle_line(row) for row in rows], end="\r\n")
    header = list(roster.header)
    for name in (GRADE, COMMENTS):
        if name not in header:
            header.append(name)
    grade, comments = header.index(GRADE), header.index(COMMENTS)
    lines = [[*line, *[""] * (len(header) - len(line))] for line in roster.lines]
    for row in rows:
        if row.student is not None and row.student.row is not None:
            line = lines[row.student.row]
            line[grade] = _grade(row, maximum_of(header, line) or row.most)
            line[comments] = _marked_up(row)
    return to_csv(header, lines, end="\r\n")


def _moodle_line(row: ClassRow) -> list[str]:
    own = row.student or student_of(row.file)
    known = [harmless(x) for x in (own.identifier, own.full_name, own.number, own.email)]
    return [*known, _grade(row, row.most), number(row.most), "-", _marked_up(row)]


def _grade(row: ClassRow, most: float) -> str:
    """The points of an answer where its most is another number."""
    return "" if row.points is None else f"{row.points * most / (row.most or 1):.2f}"


def maximum_of(header: Sequence[str], line: Sequence[str]) -> float | None:
    """The maximum grade in a line of Moodle's worksheet, with a point or comma; None if it has none above 0."""
    if MOST not in header:
        return None
    whole, _, part = line[header.index(MOST)].strip().replace(",", ".").partition(".")
    if not (whole.isdecimal() and (not part or part.isdecimal()) and len(whole + part) < LONGEST_NUMBER):
        return None
    return float(f"{whole}.{part or 0}") or None


def _marked_up(row: ClassRow) -> str:
    """The comment as HTML, which is what Moodle takes."""
    return "<br>".join(html.escape(words, quote=False) for words in row.comment)


def gradescope_csv(rows: Sequence[ClassRow], parts: Sequence[tuple[str, float]], roster: Roster | None) -> str:
    """Return the points in the columns of Gradescope's table of scores, a question for each part.

    Students of the list without an answer are in it as "Missing"; an answer that could not be judged is "Ungraded".
    """
    named = [f"{k}: {title} ({of:.1f} pts)" for k, (title, of) in enumerate(parts, 1)]
    most = sum(of for _, of in parts)
    lines = [_gradescope_line(row, len(parts), most) for row in rows]
    if roster is not None:
        with_answer = {row.student.row for row in rows if row.student is not None}
        absent = [s for s in roster.students if s.row not in with_answer]
        lines += [[*_names(s), "", number(most), "Missing", *[""] * len(parts)] for s in absent]
    return to_csv([*GRADESCOPE, *named], lines)


def _gradescope_line(row: ClassRow, parts: int, most: float) -> list[str]:
    names = _names(row.student or student_of(row.file))
    if row.points is None:
        return [*names, "", number(most), "Ungraded", *[""] * parts]
    return [*names, number(row.points), number(most), "Graded", *[number(m["points"]) for m in row.marks]]


def _names(student: Student) -> list[str]:
    first, last = student.first, student.last
    if not (first or last):
        first, _, last = student.name.rpartition(" ")
    return [harmless(x) for x in (first, last, student.number, student.email)]
