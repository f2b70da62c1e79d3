"""The students behind the files of answers, and the lists of a class that learning platforms export."""

from __future__ import annotations

import csv
import io
import re
import unicodedata
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from lagrangian.errors import Error
from lagrangian.read import MAX_BYTES, decode
from lagrangian.records import dataclass
from lagrangian.viewed import Brief

MOODLE_FILE = re.compile(r"(?P<name>[^/]+)_(?P<number>\d+)_assignsubmission_[a-z]+(_.*|/.*)?", re.DOTALL)
"""How Moodle names the files, or folders, of submissions: the name, the number of the participant, the kind."""

COLUMNS = {
    "identifier": ("identifier",),
    "name": ("full name", "name"),
    "first": ("first name", "firstname"),
    "last": ("last name", "surname", "lastname"),
    "number": ("id number", "idnumber", "sid", "student id"),
    "email": ("email address", "email"),
}
"""The columns of a list that say who somebody is, as Moodle and Gradescope call them."""


@dataclass(frozen=True)
class Student(Brief):
    """Who wrote an answer, as far as it is known.

    ``identifier`` is Moodle's "Participant 123"; ``row`` is the line of the list in which the student was found.
    """

    name: str = ""
    identifier: str = ""
    number: str = ""
    email: str = ""
    first: str = ""
    last: str = ""
    row: int | None = None

    @property
    def full_name(self) -> str:
        """The whole name."""
        return self.name or f"{self.first} {self.last}".strip()


@dataclass(frozen=True)
class Roster(Brief):
    """The list of a class: its header and lines as they stand in the file, and the students in them."""

    header: tuple[str, ...]
    lines: tuple[tuple[str, ...], ...]
    students: tuple[Student, ...]

    def find(self, file: str) -> Student | None:
        """The student to whom a file belongs; None if there is none, or more than one.

        A file belongs to whom its name names: participant number, ID number, email address, or full name.
        """
        found = self.fitting(file)
        return found[0] if len(found) == 1 else None

    def fitting(self, file: str) -> list[Student]:
        """All students to whom a file may belong, by the first kind of name that fits one; else those by any."""
        own = student_of(file)
        several: list[Student] = []
        named = {_plain(x) for x in (own.name, own.identifier, _stem(file)) if x}
        for which in ("identifier", "number", "email", "full_name"):
            found = [s for s in self.students if (value := _plain(str(getattr(s, which)))) and value in named]
            if len(found) == 1:
                return found
            several = several or found
        found = [s for s in self.students if s.email and _plain(s.email.partition("@")[0]) in named]
        return found if len(found) == 1 else several or found


def student_of(file: str) -> Student:
    """What the name of a file says about its student: Moodle's pattern, otherwise the name without its ending."""
    found = MOODLE_FILE.fullmatch(file)
    if found is None:
        return Student(name=_stem(file))
    return Student(name=found["name"], identifier=f"Participant {found['number']}")


def _stem(file: str) -> str:
    return Path(file).parts[0] if "/" in file else Path(file).stem


def _plain(text: str) -> str:
    """A name for comparison: no accents, no case, one kind of separator."""
    bare = "".join(c for c in unicodedata.normalize("NFKD", text) if not unicodedata.combining(c))
    return re.sub(r"[\s_.,-]+", " ", bare).strip().casefold()


def read_roster(path: Path) -> Roster:
    """Read a list of a class as CSV: Moodle's grading worksheet or gradebook export, or Gradescope's roster.

    Raises `Error` if it cannot be read, or if no column says who the students are.
    """
    try:
        with path.open("rb") as file:
            data = file.read(MAX_BYTES + 1)
    except OSError as error:
        what = f"cannot read '{path}': {(error.strerror or str(error)).lower()}"
        raise Error(what, fix="name the list that Moodle or Gradescope exports", code="E702") from error
    text = decode(data, str(path)).lstrip("\ufeff")
    try:
        rows = [row for row in csv.reader(io.StringIO(text), strict=True) if any(cell.strip() for cell in row)]
    except csv.Error as error:
        raise Error(f"'{path}' is not CSV: {error}", fix="export the list as CSV, comma separated") from error
    header = tuple(cell.strip() for cell in rows[0]) if rows else ()
    at = columns_of(header)
    if not at.keys() & {"identifier", "name", "last", "number", "email"}:
        what = f"no column of '{path}' says who the students are"
        fix = "it needs one of: Identifier, Full name, ID number, SID, Email address"
        raise Error(what, fix=fix, code="E702")
    lines = tuple((*row, *[""] * (len(header) - len(row))) for row in rows[1:])
    students = tuple(_student(line, at, k) for k, line in enumerate(lines))
    return Roster(header, lines, students)


def columns_of(header: Sequence[str]) -> dict[str, int]:
    """Where the columns of a header are that say who somebody is."""
    names = [cell.strip().casefold() for cell in header]
    return {key: names.index(n) for key, known in COLUMNS.items() for n in reversed(known) if n in names}


def _student(line: Sequence[str], at: Mapping[str, int], row: int) -> Student:
    return Student(**{key: line[k].strip() for key, k in at.items()}, row=row)


def unanswered(roster: Roster, found: Iterable[Student | None]) -> tuple[Student, ...]:
    """The students of a list without an answer."""
    rows = {s.row for s in found if s is not None}
    return tuple(s for s in roster.students if s.row not in rows)
