"""Judges one answer of a class and returns plain data: the verdict, the marks, and what the student is told."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from dataclasses import replace
from typing import Any, Literal, TypeAlias, get_args

from lagrangian.advice import Advice, Argument
from lagrangian.check.classes.feedback import comment, feedback_report, in_letters, words_report
from lagrangian.check.classes.marks import lacking, marks
from lagrangian.check.classes.scheme import MarkingScheme
from lagrangian.check.reading import decode_answer, parse_answer
from lagrangian.check.verb import CheckedAnswer, check_answer
from lagrangian.check.verdict import Finding, Mistake, Status
from lagrangian.derive import Derived
from lagrangian.errors import Error, ModelError, ParseError
from lagrangian.model import Model
from lagrangian.records import dataclass, field
from lagrangian.viewed import Brief
from lagrangian.write.report import write_report

_log = logging.getLogger(__name__)

FeedbackFormat: TypeAlias = Literal["text", "markdown", "html"]
"""The formats of the files that students get."""

Record: TypeAlias = dict[str, Any]
"""What is known of one answer after it was judged, as plain data."""


@dataclass(frozen=True, kw_only=True)
class Judging(Brief):
    """How the answers of a class are judged: the scheme, and how much is revealed to whom.

    ``hint`` limits the results, ``told`` the feedback that students get; ``feedback`` is the format of their files.
    Raises `ModelError` for a level or a format that does not exist.
    """

    scheme: MarkingScheme = field(default_factory=MarkingScheme)
    hint: int = 3
    told: int = 3
    feedback: FeedbackFormat | None = None

    def __post_init__(self) -> None:
        for fix, level in ((Advice(Argument("hint", "2")), self.hint), ("told=2", self.told)):  # no --told
            if isinstance(level, bool) or level not in (0, 1, 2, 3):
                raise ModelError(f"a hint has a level from 0 to 3 (got {level})", fix=fix, code="E406")
        known = get_args(FeedbackFormat)
        if self.feedback is not None and self.feedback not in known:
            what = f"feedback is written as {', '.join(known)} (got {self.feedback!r})"
            raise ModelError(what, fix='feedback="html"', code="E406")

    def to_dict(self) -> dict[str, Any]:
        """Return plain data, from which `from_dict` makes it again."""
        return {"scheme": self.scheme.to_dict(), "hint": self.hint, "told": self.told, "feedback": self.feedback}

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Judging:
        """Return what `to_dict` made plain data of."""
        rest = {key: value for key, value in data.items() if key != "scheme"}
        return cls(scheme=MarkingScheme(**data["scheme"]), **rest)


class Judge:
    """Judges answers to one derivation; the derivation and what is found from it are made once."""

    def __init__(self, derivation: Derived, judging: Judging) -> None:
        self.derivation, self.judging = derivation, judging

    def judge(self, file: str, content: bytes) -> Record:
        """Return the record of one answer; a text that cannot be read is a record as well."""
        read = False
        try:
            answer = parse_answer(decode_answer(content, file), self.derivation.model, name=file)
            read = True
            return self._told(file, check_answer(self.derivation, answer))
        except Error as error:
            return untold(file, _in_a_line(error), read=read)
        except Exception as fault:  # a fault of ours in one answer must not cost the others
            _log.warning("the answer '%s' could not be judged", file, exc_info=True)
            words = f"a fault of this program ({type(fault).__name__}); please report it"
            return untold(file, _in_a_line(Error(words)), read=True)

    def _told(self, file: str, verdict: CheckedAnswer) -> Record:
        judging, scheme = self.judging, self.judging.scheme
        lacks = lacking(verdict, self.derivation, scheme.require)
        earned = marks(verdict, self.derivation, scheme)
        moved = scheme.coordinates == "given" and verdict.status is Status.OTHER_COORDINATES
        student = replace(verdict, hint=judging.told)
        report = feedback_report(student, lacks, earned, moved=moved)
        return {
            "file": file,
            "status": verdict.status.value,
            "right": verdict.right and not lacks and not moved,
            "read": True,
            "trouble": "",
            "lacks": list(lacks),
            "moved": moved,
            "lines": [_line(f) for f in verdict.findings],
            "mistakes": [_mistake(m) for m in verdict.mistakes],
            "verdict": replace(verdict, hint=judging.hint).to_dict(),
            "marks": [m.to_dict() | {"title": m.title} for m in earned],
            "comment": list(comment(student, lacks, earned, moved=moved)),
            "feedback": write_report(report, judging.feedback) if judging.feedback else None,
        }


def _in_a_line(error: Error) -> str:
    """What is wrong, where and what would be right, of every place, for a cell of a table: no code and no caret."""
    others = error.others if isinstance(error, ParseError) else ()
    return " Also ".join(_of_one_place(x) for x in (error, *others))


def _of_one_place(error: Error) -> str:
    place, said = error.place, [error.what.rstrip(".")]
    if place is not None and place.line is not None:
        column = "" if place.column is None else f", column {place.column}"
        said.insert(0, f"line {place.line}{column}")
    fix = f" {error.fix[0].upper()}{error.fix[1:].rstrip('.')}" if error.fix else ""
    return f"{': '.join(said)}.{fix}{'' if fix.endswith(('?', '!')) or not fix else '.'}"


def with_page(record: Record, model: Model, judging: Judging) -> Record:
    """The record with a page of feedback, also where there is no verdict and its comment is all that can be told."""
    if judging.feedback is None or record["feedback"] is not None:
        return record
    return {**record, "feedback": write_report(words_report(model, record["comment"]), judging.feedback)}


def untold(file: str, trouble: str, *, read: bool) -> Record:
    """The record of an answer that could not be read, or not be judged."""
    words = "Your answer could not be " + ("judged" if read else "read") + ": " + trouble
    return {
        "file": file,
        "status": None,
        "right": False,
        "read": read,
        "trouble": trouble,
        "lacks": [],
        "moved": False,
        "lines": [],
        "mistakes": [],
        "verdict": None,
        "marks": [],
        "comment": [words],
        "feedback": None,
    }


def _line(finding: Finding) -> dict[str, Any]:
    """A line for statistics: what it states, whether it is right, and the elements and steps that it points to."""
    origins = [o for d in finding.differences for o in d.origins]
    return {
        "line": finding.line.number,
        "kind": finding.line.kind,
        "coordinate": finding.coordinate or finding.line.name,
        "right": finding.status.right,
        "said": finding.status is not Status.INCOMPLETE,
        "follows": finding.follows,
        "elements": sorted({o.element for o in origins}),
        "steps": sorted({o.step for o in origins}),
    }


def _mistake(mistake: Mistake) -> dict[str, Any]:
    return {
        "name": mistake.name,
        "kind": mistake.kind.value,
        "what": in_letters(mistake.what),
        "brief": in_letters(mistake.brief) if mistake.brief is not None else "",
        "hinted": in_letters(mistake.hinted()),
        "step": mistake.step,
        "element": mistake.concerns,
    }
