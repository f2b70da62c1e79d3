"""The verdicts on the definitions of an answer: those that are right, and those from which wrong lines follow."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from dataclasses import replace

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.axes_meant import along_turned_axes
from lagrangian.check.explain.bodies_said import Blamed
from lagrangian.check.explain.columns_said import columns, right_columns, senses_of
from lagrangian.check.explain.energies_of_several import energy_of_several
from lagrangian.check.explain.quantities import Sayable
from lagrangian.check.explain.said_wrongly import PLACED, SaidWrongly, right_quantities
from lagrangian.check.explain.which_said import as_said, letters_meant
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Finding, Status, inserted
from lagrangian.model import time
from lagrangian.page.formula import text
from lagrangian.read.letters import key

_FROM = re.compile(r"\b(?:distance|radius|lever arm|abstand|entfernung|hebelarm|rayon)\b", re.IGNORECASE)
"""Words of what is counted from a given place."""


def with_wrong_definitions(findings: Sequence[Finding], blamed: Blamed | None) -> tuple[Finding, ...]:
    """The findings with wrong definitions in their places, and what follows from them marked so."""
    if blamed is None:
        return tuple(findings)
    after = {(line.number, line.text) for line in (*blamed.because, *blamed.later)}
    wrong = [f.status is Status.WRONG and (f.line.number, f.line.text) in after for f in findings]
    found = [
        replace(f, follows=f.follows or below, note=None if below and f.line.kind == "definition" else f.note)
        for f, below in zip(findings, wrong, strict=True)
    ]
    lines = {(p.line.number, p.line.text): Finding(p.line, Status.WRONG) for p in blamed.said}
    names = {key(p.line.name or "") for p in blamed.said}
    rated = {key(p.line.name or "") for p in blamed.said if _has_wrong_rate(p)}
    numbers = {number for number, _ in lines}
    found = [f for f in found if not (_says_it_itself(f, names, rated) and f.line.number in numbers)]
    found = [
        replace(f, status=Status.WRONG, note=None, follows=True) if _says_it_itself(f, names, rated) else f
        for f in found
    ]
    for line in blamed.later:
        lines.setdefault((line.number, line.text), Finding(line, Status.WRONG, follows=True))
    of_value = {(p.line.number, p.line.text) for p in blamed.said if p.line.kind == "definition"}
    found = [replace(f, differences=()) if (f.line.number, f.line.text) in of_value else f for f in found]
    for at, new in lines.items():
        if at not in [(f.line.number, f.line.text) for f in found if f.status is Status.WRONG]:
            found = inserted(found, new)
    return tuple(found)


def _says_it_itself(finding: Finding, names: Collection[str], rated: Collection[str]) -> bool:
    """Whether a line is only right because one of the names has the value that it has, r ω = R φ̇, or one of those that
    are ``rated`` its rate: ẋ = … below x = …."""
    line = finding.line
    if not finding.status.right or not line.names & frozenset(names):
        return False
    of_rate = line.kind == "identity" and bool(line.names & frozenset(rated))
    return line.expr == 0 or (of_rate and bounded.expand(line.expr) == 0)


def _has_wrong_rate(said: SaidWrongly) -> bool:
    """Whether not only the value but also the rate of a name is wrong."""
    return said.right is not None and bounded.expand(bounded.diff(said.line.expr - said.right, time)) != 0


def with_right_definitions(
    truth: Reference, lines: Sequence[AnsweredLine], findings: Sequence[Finding]
) -> tuple[Finding, ...]:
    """The findings with the definitions that are right for a quantity of the system, in their places."""
    told = {(f.line.number, f.line.text) for f in findings}
    parts: dict[tuple[int, str], list[AnsweredLine]] = {}
    for line in lines:
        if line.kind == "definition" and (line.number, line.text) not in told:
            parts.setdefault((line.number, line.text), []).append(line)
    found, turned = list(findings), along_turned_axes(truth, lines)
    senses = senses_of(truth, columns(lines))
    alone = [(x, _right(truth, x, id(x) in turned, findings)) for same in parts.values() for x in same]
    letters, of_line = letters_meant(alone, truth), {id(x): right for x, right in alone}
    for same in parts.values():
        held = columns(same)
        every = [as_said(truth, x[0], right_columns(truth, x, senses), letters) for x in held] or [
            as_said(truth, x, of_line[id(x)], letters) for x in same
        ]
        if not all(every):
            several = {energy_of_several(truth, x) for x in same}
            if len(several) == 1 and (of := several.pop()) is not None:
                found = inserted(found, Finding(same[0], Status.RIGHT, text(f"the {of}")))
            continue
        words = {str(text(*q.words)): q.words for quantities in every for q in quantities}
        note = text("the ", *next(iter(words.values()))) if len(words) == 1 else None
        found = inserted(found, Finding(same[0], Status.RIGHT, note))
    return tuple(found)


def _right(truth: Reference, line: AnsweredLine, turned: bool, findings: Sequence[Finding]) -> list[Sayable]:
    """The quantities that a definition has right; a position may be counted from another place, unless words say from
    where, or a wrong T* moves with this distance."""
    if found := right_quantities(truth, line, turned=turned):
        return found
    placed = [q for q in right_quantities(truth, line, but=True) if q.kind in (*PLACED, "potential")]
    if any(q.kind in PLACED for q in placed) and (_FROM.search(line.words) or _moves_wrongly(truth, line, findings)):
        placed = [q for q in placed if q.kind not in PLACED]
    return [
        replace(q, words=(*q.words, ", but for a constant" if q.kind == "potential" else ", from another place"))
        for q in placed
    ]


def _moves_wrongly(truth: Reference, line: AnsweredLine, findings: Sequence[Finding]) -> bool:
    """Whether a wrong T* or L has a distance as a factor of rates: ½ m ρ² φ̇² of a ρ that may be a height by chance."""
    rates = [c.rate for c in truth.model.coordinates]
    if not line.expr.is_Add:
        return False
    wrong = [f.line.expr for f in findings if f.status is Status.WRONG and f.line.kind in ("T", "L")]
    terms = (t for x in wrong for t in sp.Add.make_args(x))
    return any(t.has(line.expr) and t.has(*rates) for t in terms)
