"""The parts of T*, or of V, that an answer lists and never adds up: each against the energy of what it is of."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import sympy as sp

from lagrangian import bounded
from lagrangian.check.reading.summed_energies import ADDED, things_with
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.stated import harmless
from lagrangian.check.verdict import AnsweredLine, Finding, Status, Verdict, inserted
from lagrangian.read.letters import key

_ADDED = {ADDED[kind]: kind for kind in ADDED}


def is_added(line: AnsweredLine) -> bool:
    """Whether a line is the sum of listed parts, which the answer does not write."""
    return line.text in _ADDED


def without_parts(lines: Sequence[AnsweredLine]) -> tuple[AnsweredLine, ...]:
    """The lines without listed parts: nobody else uses their names, so nothing is told in these."""
    listed = frozenset[str]().union(*(x.names for x in lines if is_added(x)))
    return tuple(x for x in lines if x.kind != "definition" or key(x.name or "") not in listed)


def with_parts_judged(truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict) -> Verdict:
    """The verdict with a finding for each part that was added up; if one is wrong, the sum follows from it.

    An energy is a sum of terms, each with one inertia, stiffness or weight as a factor: a part is right if it has all
    terms with the letters of its body, or of its springs. A constant in V is no mistake.
    """
    findings = list(verdict.findings)
    for whole in [f for f in findings if is_added(f.line)]:
        parts = [x for x in lines if x.kind == "definition" and key(x.name or "") in whole.line.names]
        right = {} if truth.values else _right_parts(truth, whole.line.kind, dict(enumerate(parts)))
        wrong = [parts[k] for k, x in right.items() if not _is_right(truth, whole.line, parts[k].expr - x)]
        told = {(f.line.number, f.line.text): f.status for f in findings if f.line.kind == "definition"}
        blamed = [x for x in parts if told.get((x.number, x.text)) is Status.WRONG]
        if whole.status.right:
            right, wrong = {k: x for k, x in right.items() if parts[k] not in wrong}, []
        differing = whole.differences if len(wrong) == 1 and not blamed else ()
        for k in right:
            one, bad = parts[k], any(parts[k] is x for x in wrong)
            if (one.number, one.text) not in told:
                status = Status.WRONG if bad else Status.RIGHT
                findings = inserted(findings, Finding(one, status, None, None, differing if bad else ()))
        follows = bool(wrong or blamed) and not whole.status.right
        findings = [replace(f, follows=True) if f is whole and follows else f for f in findings]
    return replace(verdict, findings=tuple(findings))


def _is_right(truth: Reference, whole: AnsweredLine, rest: sp.Expr) -> bool:
    """Whether what a part has too much changes nothing."""
    return zero_everywhere(truth, rest) or harmless(truth, replace(whole, expr=rest), rest) is not None


def _right_parts(truth: Reference, kind: str, parts: Mapping[int, AnsweredLine]) -> dict[int, sp.Expr]:
    """What each part should be; nothing if something has letters in several parts, or some term belongs to none."""
    energy = truth.expand(getattr(truth, kind))
    things = things_with(truth.model, kind)
    held = {k: {key(str(x)) for x in bounded.letters(truth.expand(x.expr))} for k, x in parts.items()}
    letters = {key(str(x)): x for x in bounded.letters(energy)}
    mine = {k: [own for own in things if own & held[k]] for k in parts}
    if any(sum(own in listed for listed in mine.values()) != 1 for own in things):
        return {}
    every = {letters[x] for own in things for x in own if x in letters}
    found: dict[int, sp.Expr] = {}
    for k, listed in mine.items():
        kept = {letters[x] for own in listed for x in own if x in letters}
        found[k] = energy.subs(dict.fromkeys(every - kept, 0))
    total = sp.Add(*found.values())
    return found if zero_everywhere(truth, total - energy) else {}


def without_added(verdict: Verdict) -> Verdict:
    """The verdict without the sums that the answer does not write, unless nothing else says what is wrong in one."""
    kept = tuple(f for f in verdict.findings if not is_added(f.line) or not (f.status.right or f.follows))
    return replace(verdict, findings=kept)
