"""One answer of a class: what was found, as plain data with names."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from lagrangian.check.classes.judge import Record
from lagrangian.check.classes.students import Student
from lagrangian.check.verdict import Status
from lagrangian.records import dataclass
from lagrangian.viewed import cut


@dataclass(frozen=True)
class ClassRow:
    """One answer: its file, its student if a list was given, the record of the check, and the most points.

    ``hint`` limits what is told of it: 0 right or wrong, 1 which line, 2 the mistakes.
    """

    file: str
    record: Record
    most: float = 0.0
    hint: int = 3
    student: Student | None = None

    @property
    def right(self) -> bool:
        """Whether the answer is right, has what is required, and is in coordinates that are allowed."""
        return bool(self.record["right"])

    @property
    def read(self) -> bool:
        """Whether its text could be read."""
        return bool(self.record["read"])

    @property
    def status(self) -> Status | None:
        """The verdict, or None if there is none; a right answer that lacks a required part is incomplete."""
        if self.record["status"] is None:
            return None
        found = Status(self.record["status"])
        return Status.INCOMPLETE if found.right and self.lacks else found

    @property
    def said(self) -> str:
        """The verdict in words."""
        if self.status is not None:
            return self.status.value
        return "cannot be judged" if self.read else "cannot be read"

    @property
    def trouble(self) -> str:
        """Why it has no verdict."""
        return str(self.record["trouble"])

    @property
    def lacks(self) -> tuple[str, ...]:
        """The required parts that it does not have."""
        return tuple(self.record["lacks"])

    @property
    def verdict(self) -> Mapping[str, Any] | None:
        """The verdict as plain data, see `CheckedAnswer.to_dict`."""
        return self.record["verdict"]

    @property
    def comment(self) -> tuple[str, ...]:
        """What the student is told, in short."""
        return tuple(self.record["comment"])

    @property
    def feedback(self) -> str | None:
        """The page for the student, if one was asked for."""
        return self.record["feedback"]

    @property
    def marks(self) -> Sequence[Mapping[str, Any]]:
        """The points for every part."""
        return self.record["marks"]

    @property
    def points(self) -> float | None:
        """The sum of the points; None without a verdict, because then somebody must look at it."""
        return None if self.status is None else round(sum(m["points"] for m in self.marks), 2)

    @property
    def mistakes(self) -> tuple[str, ...]:
        """The names of the mistakes, at hint level 2 their kinds; "unexplained" if it is wrong and none was found;
        "wrong" below level 2."""
        if self.status is None:
            return ("unjudged",) if self.read else ("unreadable",)
        if self.status is Status.INCOMPLETE:
            return ("incomplete",)
        if self.status.right:
            return ("other_coordinates",) if self.record["moved"] else ()
        if self.hint < 2:
            return ("wrong",)
        which = "name" if self.hint >= 3 else "kind"
        return tuple(dict.fromkeys(m[which] for m in self.record["mistakes"])) or ("unexplained",)

    @property
    def detail(self) -> str:
        """What is said after the verdict: the trouble, the mistakes, what is missing."""
        if self.trouble:
            return self.trouble
        named = [m.replace("_", " ") for m in self.mistakes if m not in ("incomplete", "wrong", "other_coordinates")]
        moved = ["not the coordinates asked for"] if self.record["moved"] else []
        return ", ".join([*named, *moved, *(f"lacks {x}" for x in self.lacks)])

    def cells(self) -> list[str]:
        """The row in the table of answers; the hint level limits how much it reveals."""
        lines = self.record["lines"] if self.status is not None and self.hint >= 1 else None
        right = str(sum(x["right"] for x in lines)) if lines is not None else ""
        count = str(len(lines)) if lines is not None else ""
        first = next((str(x["line"]) for x in lines or () if not x["right"]), "")
        points = "" if not self.most or self.points is None else f"{self.points:g}"
        named = [" ".join(self.mistakes), ", ".join(self.lacks), points, self.trouble]
        return [self.file, self.said, right, count, first, *named]

    def to_dict(self) -> dict[str, Any]:
        """Return plain data."""
        return {
            "file": self.file,
            "verdict": self.verdict,
            "right": self.right,
            "mistakes": list(self.mistakes),
            "lacks": list(self.lacks),
            "points": self.points if self.most else None,
            "marks": [dict(m) for m in self.marks] if self.hint >= 1 else [],
            "trouble": self.trouble or None,
        }

    def __repr__(self) -> str:
        """Name the file and the verdict."""
        return cut(f"<ClassRow {self.file}: {self.said}>")
