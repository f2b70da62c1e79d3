"""What the checker says of an answer, as data and in words."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any

import sympy as sp

from lagrangian.page.formula import Text
from lagrangian.page.plain import plain
from lagrangian.viewed import Brief


class Status(StrEnum):
    """The verdicts, best first."""

    RIGHT = "right"
    EQUIVALENT = "right, but scaled, reordered or combined"
    OTHER_COORDINATES = "right in other coordinates"
    SAME_MOTION = "same motion, but not Lagrange's form"
    INCOMPLETE = "incomplete"
    WRONG = "wrong"

    @property
    def right(self) -> bool:
        """Whether nothing is wrong with the answer and nothing is missing."""
        return self not in (Status.INCOMPLETE, Status.WRONG)


@dataclass(frozen=True)
class AnsweredLine(Brief):
    """One line of an answer: what it states, and as what. ``expr`` is the energy, the force, or left minus right."""

    kind: str
    expr: sp.Expr
    number: int
    name: str | None = None
    text: str = ""

    @property
    def title(self) -> str:
        """The line in words."""
        what = {"T": "T*", "V": "V", "L": "L", "D": "D"}.get(self.kind)
        if self.kind in ("Xi", "p", "p-rate", "slope"):
            letter = {"Xi": "Ξ", "p": "∂L/∂ξ̇", "p-rate": "d/dt ∂L/∂ξ̇", "slope": "∂L/∂ξ"}[self.kind]
            what = f"{letter} of {self.name}"
        return f"line {self.number}" + (f" ({what})" if what else "")


@dataclass(frozen=True)
class TermOrigin(Brief):
    """Where a term comes from: the element in words, and the step that puts it in."""

    element: str
    step: int

    def to_dict(self) -> dict[str, Any]:
        """Return plain data."""
        return {"element": self.element, "step": self.step}


@dataclass(frozen=True)
class TermDifference(Brief):
    """A term that differs from the best matching right line: missing, extra, or with another coefficient.

    ``term`` is what the right line has (what the answer has, where it is extra); ``written`` what the answer has in
    its place, 0 where it is missing. ``coordinate`` is the equation's.
    """

    kind: str
    term: sp.Expr
    written: sp.Expr
    coordinate: str | None
    origins: tuple[TermOrigin, ...] = ()

    def to_dict(self) -> dict[str, Any]:
        """Return plain data."""
        return {
            "kind": self.kind,
            "term": plain(self.term),
            "written": plain(self.written),
            "coordinate": self.coordinate,
            "origins": [o.to_dict() for o in self.origins],
        }


@dataclass(frozen=True)
class Mistake(Brief):
    """A misconception that explains the answer: its name, what was done, why it is wrong, and where."""

    name: str
    what: Text
    why: Text
    step: int
    element: str | None = None
    coordinate: str | None = None

    def to_dict(self) -> dict[str, Any]:
        """Return plain data."""
        return {
            "name": self.name,
            "what": str(self.what),
            "why": str(self.why),
            "step": self.step,
            "element": self.element,
            "coordinate": self.coordinate,
        }


@dataclass(frozen=True)
class Finding(Brief):
    """What was found of one line: whether it is right, as what, and how it differs.

    ``coordinate`` is the equation it is, or was meant to be; ``note`` says what is special about it.
    """

    line: AnsweredLine
    status: Status
    note: Text | None = None
    coordinate: str | None = None
    differences: tuple[TermDifference, ...] = ()
    follows: bool = False

    def to_dict(self) -> dict[str, Any]:
        """Return plain data."""
        return {
            "line": self.line.number,
            "kind": self.line.kind,
            "name": self.line.name,
            "text": self.line.text,
            "verdict": self.status.value,
            "right": self.status.right,
            "note": str(self.note) if self.note is not None else None,
            "coordinate": self.coordinate,
            "follows": self.follows,
            "differences": [d.to_dict() for d in self.differences],
        }


@dataclass(frozen=True)
class Verdict:
    """What the checker says of an answer.

    ``status`` is the whole's; ``findings`` are the lines', in order; ``mistakes`` are the misconceptions that explain
    what is wrong, the likeliest first; ``combination[j]`` says for equation j of the answer how much of every right
    equation is in it; ``change`` writes the answer's coordinates in the system's. ``hint`` is how much the words give
    away: 0 right or not, 1 the line, 2 the element and the step, 3 the term.
    """

    status: Status
    findings: tuple[Finding, ...]
    mistakes: tuple[Mistake, ...] = ()
    alternatives: tuple[Mistake, ...] = ()
    combination: tuple[tuple[sp.Expr, ...], ...] | None = None
    change: Mapping[sp.Expr, sp.Expr] = field(default_factory=dict)
    notes: tuple[Text, ...] = ()
    hint: int = 3

    @property
    def right(self) -> bool:
        """Whether the answer is right, in whatever shape."""
        return self.status.right

    @property
    def mistake(self) -> Mistake | None:
        """The likeliest mistake, where one was found that explains everything."""
        return self.mistakes[0] if self.mistakes else None

    @property
    def first_wrong(self) -> Finding | None:
        """The first line that is wrong."""
        return next((f for f in self.findings if not f.status.right), None)

    def to_dict(self) -> dict[str, Any]:
        """Return plain data for JSON, as much as the hint level gives away."""
        data: dict[str, Any] = {"right": self.right, "verdict": self.status.value, "hint": self.hint}
        if self.hint >= 1:
            data["lines"] = [_at(f.to_dict(), self.hint) for f in self.findings]
            data["notes"] = [str(n) for n in self.notes]
            data["change"] = {plain(k): plain(v) for k, v in self.change.items()}
            data["combination"] = (
                [[plain(x) for x in row] for row in self.combination] if self.combination is not None else None
            )
        if self.hint >= 2:
            data["mistakes"] = [m.to_dict() for m in self.mistakes]
            data["alternatives"] = [m.to_dict() for m in self.alternatives]
        return data


def _at(finding: dict[str, Any], hint: int) -> dict[str, Any]:
    """A finding without what a lower hint does not tell."""
    if hint >= 3:
        return finding
    kept = {k: v for k, v in finding.items() if k != "differences"}
    if hint == 2:
        kept["elements"] = sorted({o["element"] for d in finding["differences"] for o in d["origins"]})
        kept["steps"] = sorted({o["step"] for d in finding["differences"] for o in d["origins"]})
    return kept
