"""What is told of wrong terms that were made in values of an answer's own names: their lines, and the terms there."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.sides_said import EQUATION, ON_LEFT, ON_RIGHT
from lagrangian.check.reading.marked_values import MarkedValue
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
    """A wrong term of an equation, the value in which it was made, and what is wrong there."""

    finding: Finding
    term: TermDifference
    of: MarkedValue
    own: TermDifference


def with_made(verdict: Verdict, found: Sequence[Made]) -> Verdict:
    """The verdict, with these terms told at their values; equations with no other wrong term follow."""
    moved = {(id(x.finding), id(x.term)) for x in found}
    findings: list[Finding] = []
    for f in verdict.findings:
        left = tuple(d for d in f.differences if (id(f), id(d)) not in moved)
        touched = len(left) < len(f.differences)
        findings.append(replace(f, differences=left or f.differences, follows=f.follows or not left) if touched else f)
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
        mistakes=tuple(_said(m, found) for m in verdict.mistakes),
        alternatives=tuple(_said(m, found) for m in verdict.alternatives),
    )


def _by_line(found: Sequence[Made]) -> dict[tuple[int, str], list[Made]]:
    lines: dict[tuple[int, str], list[Made]] = {}
    for x in found:
        lines.setdefault((x.of.line, x.of.name), []).append(x)
    return lines


def _said(mistake: Mistake, found: Sequence[Made]) -> Mistake:
    """A mistake whose first sentence speaks of a term of an equation, with the line and the term of the value."""
    parts = mistake.what.parts
    begins = _BEGINS.match(parts[0]) if len(parts) > 2 and isinstance(parts[0], str) else None
    if begins is None or not isinstance(parts[1], sp.Expr):
        return mistake
    spoken = parts[1]
    made = [x for x in found if any(_same(spoken, y) for y in (x.term.term, x.term.written))]
    made = [x for x in made if mistake.coordinate in (None, x.finding.coordinate)]
    if len(made) != 1:
        return mistake
    first = f"In line {made[0].of.line}{':' if begins['what'].lower().startswith('in') else ','} "
    return replace(mistake, what=text(first + begins["what"].lower(), *_of_value(parts[1:], made[0])))


def _of_value(parts: Sequence[str | Left | Verbatim], made: Made) -> Iterator[str | Left | Verbatim]:
    """The rest of a sentence, with the terms of the value for those of the equation."""
    before: str | Left | Verbatim = ""
    for part in parts:
        named = isinstance(before, str) and before.endswith(EQUATION)
        right = isinstance(before, str) and before.endswith(_RIGHT)
        if isinstance(part, str):
            said = part.removesuffix(EQUATION).replace(f"{ON_LEFT} ", "").replace(f"{ON_RIGHT} ", "")
            yield from [said] if said else []
        elif isinstance(part, sp.Expr) and not named:
            wrong = made.term.kind != "missing" and not right and _same(part, made.term.written)
            own = made.own.written if wrong else made.own.term if _same(part, made.term.term) else part
            yield own
        elif not named:
            yield part
        before = part


def _same(one: sp.Expr, other: sp.Expr) -> bool:
    """Whether two terms are the same but for a sign."""
    return other != 0 and any(bounded.expand(one - sign * other) == 0 for sign in (1, -1))
