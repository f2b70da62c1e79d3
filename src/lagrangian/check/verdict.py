"""The verdict on an answer, as data and in words."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from enum import StrEnum
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.check.hints import MistakeKind, advised, hinted, kind_of
from lagrangian.page.formula import Left, Text, text
from lagrangian.page.plain import plain
from lagrangian.records import dataclass, field
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
        """Whether nothing is wrong or missing in the answer."""
        return self not in (Status.INCOMPLETE, Status.WRONG)


_SQUARE = re.compile(r"(?:²|(?:\^|\*\*)[ ]?\{?[ ]?2[ ]?\}?)[ \t$&]*\Z")
"""How the left side of a statement ends that is a square."""
_FUNCTION = re.compile(r"[ \t$]*\\?(?P<of>sin|cos|tan)[ \t]*(?:\(|\\left\(|[ {\\]|(?=[^\x00-\x7f]))[^=+\n]{1,30}=")
"""How a definition begins that says what the sine of a name is."""
IS_MISSING = " is missing"
"""What is said behind the name of what an answer lacks."""
WOULD_BE_RIGHT = "would be right"
"""What a note says that gives the remedy."""
_IN_LINE = re.compile(r"In line (\d{1,6})\b")
"""How words begin that speak of one line."""
OWN_SLOPES = ("T-rate", "T-slope", "V-slope", "D-slope")
"""The kinds of lines that give derivatives of the answer's own T*, V and D that equations add up."""
OWN_DERIVATIVES = ("T-p", *OWN_SLOPES)
DERIVED = ("p-rate", "slope", "left", *OWN_DERIVATIVES)
"""d/dt ∂L/∂ξ̇, ∂L/∂ξ, the first less the second, and derivatives of the answer's own T*, V and D."""


@dataclass(frozen=True)
class AnsweredLine(Brief):
    """One line of an answer: what kind it is and what it states. ``expr`` is the energy, the force, or left minus
    right.

    ``beside``: what the words around it say that it is, "rest", "check", "case" or "aside"; see `reading.side_remarks`.
    ``names``: the keys of the names in it as it is written. ``senses``: what words say of forces in it; see
    `reading.said.senses`. ``sides``: left and right of an equation as they were read.
    """

    kind: str
    expr: sp.Expr
    number: int
    name: str | None = None
    text: str = ""
    beside: frozenset[str] = frozenset()
    names: frozenset[str] = frozenset()
    senses: frozenset[tuple[str, str, str]] = frozenset()
    sides: tuple[sp.Expr, sp.Expr] | None = field(default=None, repr=False, compare=False)
    summands: tuple[tuple[tuple[sp.Expr, ...], ...], ...] = field(default=(), compare=False, repr=False)
    """Its terms with their factors as they are written; see `reading.summands`."""
    words: str = field(default="", compare=False, repr=False)
    """The words around it in the same line: "velocity of the bob", "about the hinge"."""
    near: frozenset[str] = field(default=frozenset(), repr=False)
    """The values and kinds of motion of which it, or the lines above it, speak; see `reading.prose.values_said`."""

    @property
    def title(self) -> str:
        """The line in words."""
        what = {"T": "T*", "V": "V", "L": "L", "D": "D"}.get(self.kind)
        if self.kind in ("Xi", "p", "p-rate", "slope"):
            letter = {"Xi": "Ξ", "p": "∂L/∂ξ̇", "p-rate": "d/dt ∂L/∂ξ̇", "slope": "∂L/∂ξ"}[self.kind]
            what = f"{letter} of {self.name}"
        return f"line {self.number}" + (f" ({what})" if what else "")

    @property
    def of_square(self) -> bool:
        """Whether a definition gives the square of its name: ω² = k/m."""
        return self.kind == "definition" and _SQUARE.search(self.text.partition("=")[0]) is not None

    def of_function(self, symbol: sp.Expr) -> sp.Expr:
        """The sine, cosine or tangent of a name of which a definition gives that, sin α = h/s; else its symbol."""
        found = _FUNCTION.match(self.text) if self.kind == "definition" else None
        return getattr(sp, found["of"])(symbol) if found is not None else symbol

    @property
    def opening(self) -> str:
        """The line in words at the beginning of a sentence."""
        return f"{self.title[:1].upper()}{self.title[1:]}"


def keys_of(lines: Sequence[AnsweredLine]) -> list[tuple[int, str, int]]:
    """What identifies each line: its number, its text, and which it is of those that stand in the same text."""
    seen: Counter[tuple[int, str, bool]] = Counter()
    found: list[tuple[int, str, int]] = []
    for line in lines:
        judged = line.kind not in ("definition", "statement")
        seen[line.number, line.text, judged] += 1
        count = seen[line.number, line.text, judged]
        found.append((line.number, line.text, count if judged else -count))
    return found


@dataclass(frozen=True)
class TermOrigin(Brief):
    """The origin of a term: the element in words, and the step in which it enters."""

    element: str
    step: int

    def to_dict(self) -> dict[str, Any]:
        """Return plain data."""
        return {"element": self.element, "step": self.step}


@dataclass(frozen=True)
class TermDifference(Brief):
    """A term that differs from the most similar right line: missing, superfluous, or with another coefficient.

    ``term`` is the term of the right line (or of the answer, if it is superfluous); ``written`` is what the answer has
    instead, 0 if it is missing. ``coordinate`` is that of the equation.
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
    """A mistake that explains the answer: its name, what was done, why it is wrong, and where.

    ``brief`` says what kind of thing is wrong without the term itself, for a hint. ``body`` is the body whose weight
    is wrong, where the element is gravity.
    """

    name: str
    what: Text
    why: Text
    step: int
    element: str | None = None
    coordinate: str | None = None
    brief: Text | None = None
    body: str | None = None

    @property
    def kind(self) -> MistakeKind:
        """What kind of mistake it is."""
        return kind_of(self.name)

    @property
    def concerns(self) -> str | None:
        """The element, or the body on which gravity acts."""
        return self.body or self.element

    def hinted(self, coordinate: Left | None = None) -> Text:
        """The mistake by its kind and place, without its term; ``coordinate`` is how its coordinate is written."""
        return hinted(self.kind, self.step, self.concerns, coordinate or self.coordinate, self.brief)

    @property
    def advice(self) -> str:
        """What to look at, by the kind and the step alone."""
        return advised(self.kind, self.step)

    def to_dict(self, hint: int = 3) -> dict[str, Any]:
        """Return plain data; below hint level 3 the kind and the place alone."""
        told = hint >= 3
        data: dict[str, Any] = {
            "name": self.name if told else self.kind.value,
            "kind": self.kind.value,
            "what": str(self.what),
            "why": str(self.why) if told else self.advice,
            "step": self.step,
            "element": self.concerns,
            "coordinate": self.coordinate,
            "brief": str(self.hinted()),
        }
        return data if told else {k: v for k, v in data.items() if k != "what"}


@dataclass(frozen=True)
class Finding(Brief):
    """The finding for one line: whether it is right, in what sense, and how it differs.

    ``coordinate`` is that of the equation, as it is or was meant to be; ``note`` adds anything special about it.
    """

    line: AnsweredLine
    status: Status
    note: Text | None = None
    coordinate: str | None = None
    differences: tuple[TermDifference, ...] = ()
    follows: bool = False
    elements: tuple[str, ...] = ()
    """The elements that add to the right equation, for a wrong one."""
    clash: str = ""
    """The line that it does not fit, where nothing says which of the two is right."""

    @property
    def kinds(self) -> list[str]:
        """In which ways its terms differ, each once."""
        return list(dict.fromkeys(d.kind for d in self.differences))

    @property
    def is_open(self) -> bool:
        """Whether the line is wrong, and not only because one above it is: here the answer goes wrong."""
        return self.status is Status.WRONG and not self.follows

    def told(self, hint: int) -> Text | None:
        """The note that a hint level allows: below 3, none of a wrong line with a formula beyond ±a name."""
        shown = self.note is None or self.status.right or hint >= 3 or _names_only(self.note)
        return self.note if shown else None

    def to_dict(self, hint: int = 3) -> dict[str, Any]:
        """Return plain data; below hint level 3 without the terms that differ."""
        note = self.told(hint)
        data: dict[str, Any] = {
            "line": self.line.number,
            "kind": self.line.kind,
            "name": self.line.name,
            "text": self.line.text,
            "verdict": self.status.value,
            "right": self.status.right,
            "note": str(note) if note is not None else None,
            "coordinate": self.coordinate,
            "follows": self.follows,
        }
        if hint >= 3:
            return data | {"differences": [d.to_dict() for d in self.differences]}
        if hint == 2:
            origins = [o for d in self.differences for o in d.origins]
            data |= {"elements": sorted({o.element for o in origins}), "steps": sorted({o.step for o in origins})}
            data["kinds"] = self.kinds
        return data


@dataclass(frozen=True)
class Verdict:
    """The verdict on an answer.

    ``status`` is that of the whole answer; ``findings`` are those of the lines, in order; ``mistakes`` are the
    misconceptions that explain what is wrong, the most likely first; ``sure``: none of them is far-fetched.
    ``motion``: the last equations of motion that the answer states are right and complete, whatever else is not.
    ``combination[j]`` contains the factors of all right equations in equation j of the answer; ``change`` expresses the
    answer's coordinates in those of the system.
    ``hint`` limits how much the result reveals: 0 right or wrong, 1 the line, 2 the element and the step, 3 the term.
    ``unjudged`` are the numbers of lines with formulas above the first wrong one that have no verdict, ``partly`` those
    that have one on a part of them alone.
    """

    status: Status
    findings: tuple[Finding, ...]
    mistakes: tuple[Mistake, ...] = ()
    alternatives: tuple[Mistake, ...] = ()
    combination: tuple[tuple[sp.Expr, ...], ...] | None = None
    change: Mapping[sp.Expr, sp.Expr] = field(default_factory=dict)
    notes: tuple[Text, ...] = ()
    hint: int = 3
    sure: bool = True
    motion: bool = False
    unjudged: tuple[int, ...] = ()
    partly: tuple[int, ...] = ()

    @property
    def right(self) -> bool:
        """Whether the answer is right, in whatever sense."""
        return self.status.right

    @property
    def mistake(self) -> Mistake | None:
        """The most likely mistake, if one was found that explains everything."""
        return self.mistakes[0] if self.mistakes else None

    @property
    def told(self) -> tuple[Text, ...]:
        """The notes that the hint level allows: below 3, none of a wrong answer that says with what it would be right,
        or with a formula beyond ±a name."""
        if self.right or self.hint >= 3:
            return self.notes
        return tuple(n for n in self.notes if _names_only(n) and WOULD_BE_RIGHT not in str(n))

    @property
    def missing(self) -> tuple[Text, ...]:
        """The names of what an incomplete answer lacks, where they are known."""
        found: list[Text] = []
        for *first, last in (note.parts for note in self.notes if self.status is Status.INCOMPLETE):
            if isinstance(last, str) and IS_MISSING in last:
                parts = [x for x in (*first, last.partition(IS_MISSING)[0]) if x != ""]
                named = [
                    str(x).replace("The ", "the ", 1) if k == 0 and isinstance(x, str) else x
                    for k, x in enumerate(parts)
                ]
                found.append(text(*named))
        return tuple(found)

    def concerned(self, mistake: Mistake) -> list[str]:
        """The element of a mistake, or those from which differences come, in its equation and its ledger, less those
        of other mistakes.

        L and the left-hand sides hold what comes from T* and V, never what comes from Ξ.
        """
        if mistake.concerns:
            return [mistake.concerns]
        ledgers = {0: (2, 3, 6), 1: (2, 3, 6), 4: (2, 3), 5: (2, 3)}.get(mistake.step, (mistake.step,))
        others = {(m.element, m.step) for m in self.mistakes if m is not mistake and m.element}
        found: list[tuple[str, int]] = []
        line = _IN_LINE.match(str(mistake.what))
        for f in self.findings:
            if line is not None and f.line.number != int(line[1]):
                continue
            elsewhere = f.line.kind == "equation" and mistake.coordinate is not None
            if f.follows or (elsewhere and f.coordinate != mistake.coordinate):
                continue
            origins = [o for d in f.differences for o in d.origins if o.step in ledgers]
            found += [(o.element, o.step) for o in origins]
        listed = [*dict.fromkeys(element for element, _ in [x for x in found if x not in others] or found)]
        return listed if len(listed) <= 3 else []  # some of many would be a guess

    @property
    def right_lines(self) -> int:
        """How many lines are right, of whatever kind."""
        return sum(f.status.right for f in self.findings)

    @property
    def count_right(self) -> int:
        """How many energies and equations are right."""
        return sum(f.status.right for f in self.findings if f.line.kind in ("T", "V", "L", "equation"))

    @property
    def open_findings(self) -> tuple[Finding, ...]:
        """The lines where the answer goes wrong: those that are wrong and follow from none."""
        return tuple(f for f in self.findings if f.is_open)

    @property
    def open_equations(self) -> list[Finding]:
        """The wrong equations that follow from no other line."""
        return [f for f in self.open_findings if f.line.kind == "equation"]

    @property
    def first_wrong(self) -> Finding | None:
        """The first line that is wrong and follows from none; if none is, the first that says nothing."""
        left = [f for f in self.findings if not f.status.right]
        wrong = [f for f in left if f.status is Status.WRONG]
        return next((f for f in wrong if not f.follows), next(iter(wrong or left), None))

    def to_dict(self) -> dict[str, Any]:
        """Return plain data for JSON; the hint level limits how much it reveals."""
        data: dict[str, Any] = {"right": self.right, "verdict": self.status.value, "hint": self.hint}
        if self.hint >= 1:
            shown = self.right or self.hint >= 3
            rows = self.combination if shown else None
            data["lines"] = [f.to_dict(self.hint) for f in self.findings]
            data["motion"] = self.motion or self.right
            data["notes"] = [str(n) for n in self.told]
            data["change"] = {plain(k): plain(v) for k, v in self.change.items()} if shown else {}
            data["combination"] = [[plain(x) for x in row] for row in rows] if rows is not None else None
        if self.hint >= 2:
            data["sure"] = self.sure
            data["mistakes"] = [m.to_dict(self.hint) | {"elements": self.concerned(m)} for m in self.mistakes]
            data["alternatives"] = [m.to_dict() for m in self.alternatives] if self.hint >= 3 else []
        return data


def _names_only(note: Text) -> bool:
    """Whether all formulas of a note are names, with a sign or without: others may hold what is missing."""
    formulas = [x for x in note.parts if isinstance(x, sp.Expr)]
    unsigned = [-x if x.could_extract_minus_sign() else x for x in formulas]
    return all(isinstance(x, (sp.Symbol, sp.Number, sp.Derivative, AppliedUndef)) for x in unsigned)


def inserted(findings: Sequence[Finding], new: Finding) -> list[Finding]:
    """The findings with one more, before those of lines below it and of what is judged in the same line."""
    lines = [(f.line.number, f.line.kind != "definition") for f in findings]
    place = next((k for k, x in enumerate(lines) if x > (new.line.number, False)), len(findings))
    return [*findings[:place], new, *findings[place:]]
