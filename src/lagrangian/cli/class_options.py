"""The options of ``lagrangian check`` that are for a folder of answers."""

from __future__ import annotations

from dataclasses import fields
from enum import StrEnum
from pathlib import Path

from lagrangian.errors import Error
from lagrangian.records import dataclass


class Allowed(StrEnum):
    """Which coordinates an answer may have."""

    ANY = "any"
    GIVEN = "given"


class FeedbackKind(StrEnum):
    """The formats of the files for students."""

    TEXT = "text"
    MARKDOWN = "markdown"
    HTML = "html"


@dataclass(frozen=True)
class ClassOptions:
    """The options that are only for a folder of answers."""

    require: str | None = None
    coordinates: Allowed = Allowed.ANY
    points: str | None = None
    feedback: Path | None = None
    feedback_format: FeedbackKind = FeedbackKind.HTML
    answers: Path | None = None
    moodle: Path | None = None
    gradescope: Path | None = None
    roster: Path | None = None
    store: Path | None = None
    processes: int | None = None

    def refuse(self) -> None:
        """Raise `Error` if any option is given, because there is only one answer."""
        for field in fields(self):
            if getattr(self, field.name) != field.default:
                option = "--" + field.name.replace("_", "-")
                fix = f"name a folder, or leave {option} out"
                raise Error(f"{option} is for a folder of answers", fix=fix, code="E404")

    @property
    def for_students(self) -> bool:
        """Whether anything is written that students get."""
        return any(x is not None for x in (self.feedback, self.moodle, self.gradescope))
