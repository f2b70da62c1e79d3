"""What is told of wrong terms that were made in values of an answer's own names: their lines, and the terms there."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import cast

import sympy as sp

from lagrangian.check.explain.sides_said import EQUATION, ON_LEFT, ON_RIGHT
from lagrangian.check.reading.marked_values import MarkedValue
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake, Status, TermDifference, Verdict, inserted
from lagrangian.page.formula import Left, Verbatim, text
from lagrangian.records import dataclass

_BEGINS = re.compile(
    r"(?:In line \d{1,4}(?: \([^()]{1,20}\))?(?:, (?:on the \w{1,5}-hand side|with everything on the left-hand side))?"
    r"[,:] )?(?P<what>the term |in the term )\Z",
    re.IGNORECASE,
)
_RIGHT = (" should be ", " belongs ")
"""The words before what should stand there."""


@dataclass(frozen=True, eq=False)
class Made:
    """A wrong term of an equation times ``under``, the value in which it was made, what is wrong there, and whether the
    equation has nothing but names."""

    finding: Finding
    term: TermDifference
    under: sp.Expr
    of: MarkedValue
    own: TermDifference
    alone: bool


def with_made(
    truth: Reference, verdict: Verdict, found: Sequence[Made], differing: Mapping[int, Sequence[TermDifference]]
) -> Verdict:
    """The verdict, with these terms told at their values; equations with no other of the ``differing`` terms follow."""
    findings: list[Finding] = []
    for f in verdict.findings:
        moved = [x.term for x in found if x.finding is f]
        left = [d for d in differing.get(id(f), ()) if not any(d is x for x in moved)]
        shown = tuple(d for d in f.differences if any(d is x for x in left))
        findings.append(replace(f, differences=shown or f.differences, follows=not left) if moved else f)
    for (number, name), same in _by_line(found).items():
        first = same[0]
        line = AnsweredLine("definition", sp.Symbol(name), number, name, first.of.text)
        own = tuple(dict.fromkeys(x.own for x in same))
        note = None if first.of.at is None else text(f"row {first.of.at[0] + 1} of {name}")
        new = Finding(line, Status.WRONG, note, first.finding.coordinate, own)
        findings = inserted(findings, new)
    return replace(
        verdict,
        findings=tuple(findings),
        mistakes=tuple(_said(truth, m, found) for m in verdict.mistakes),
        alternatives=tuple(_said(truth, m, found) for m in verdict.alternatives),
    )


def _by_line(found: Sequence[Made]) -> dict[tuple[int, str], list[Made]]:
    lines: dict[tuple[int, str], list[Made]] = {}
    for x in found:
        lines.setdefault((x.of.line, x.of.name), []).append(x)
    return lines


def _said(truth: Reference, mistake: Mistake, found: Sequence[Made]) -> Mistake:
    """A mistake whose first sentence speaks of a term of an equation, with the line and the term of the value."""
    begins, spoken, *rest = (*mistake.what.parts, "", "")
    opening = _BEGINS.match(begins) if isinstance(begins, str) else None
    if opening is None or not isinstance(spoken, sp.Expr):
        return mistake
    same = _Same(truth)
    made = [x for x in found if any(same(spoken, y, x.under) for y in (x.term.term, x.term.written))]
    made = [x for x in made if mistake.coordinate in (None, x.finding.coordinate)]
    if len(made) != 1:
        return mistake
    first = f"In line {made[0].of.line}{':' if opening['what'].lower().startswith('in') else ','} "
    return replace(mistake, what=text(first + opening["what"].lower(), *_of_value(same, [spoken, *rest], made[0])))


def _of_value(same: _Same, parts: Sequence[str | Left | Verbatim], made: Made) -> Iterator[str | Left | Verbatim]:
    """The rest of a sentence, with the terms of the value for those of the equation."""
    before: str | Left | Verbatim = ""
    for part in parts:
        named = isinstance(before, str) and before.endswith(EQUATION)
        right = isinstance(before, str) and before.endswith(_RIGHT)
        if isinstance(part, str):
            said = part.removesuffix(EQUATION).replace(f"{ON_LEFT} ", "").replace(f"{ON_RIGHT} ", "")
            yield from [said] if said else []
        elif isinstance(part, sp.Expr) and not named:
            wrong = made.term.kind != "missing" and not right and same(part, made.term.written, made.under)
            own = made.own.written if wrong else made.own.term
            yield own if wrong or same(part, made.term.term, made.under) else part
        elif not named:
            yield part
        before = part


@dataclass(frozen=True)
class _Same:
    truth: Reference

    def __call__(self, one: sp.Expr, other: sp.Expr, under: sp.Expr) -> bool:
        """Whether a term is another one, divided by something, but for a sign."""
        if other == 0 or one.is_Atom:
            return False
        mine, divided = self.truth.expand(one), cast("sp.Expr", other / under)
        return any(zero_everywhere(self.truth, mine - sign * divided) for sign in (1, -1))
