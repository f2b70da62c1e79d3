"""Wrong answers in coordinates of their own: what is wrong is told in these."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from lagrangian import bounded
from lagrangian.check.constraints.without_constraints import without_constraints
from lagrangian.check.coordinates.stated import in_stated_coordinates
from lagrangian.check.coordinates.tried import ProposedChange
from lagrangian.check.explain.definitions import with_wrong_definitions
from lagrangian.check.explain.mistakes import mistakes
from lagrangian.check.explain.own_terms import foreign_names
from lagrangian.check.judged import judged_lines
from lagrangian.check.names.spelling import Spelling
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Status, Verdict, keys_of
from lagrangian.page.formula import Text, text

OF_PLACES = ("constraint_", "identity_")
"""How the names of mistakes begin that are no mistakes of equations of motion."""


def wrong_in_stated_coordinates(truth: Reference, spelling: Spelling, verdict: Verdict) -> Verdict | None:
    """The verdict on a wrong answer in coordinates that it defines, if its mistakes are found in these."""
    if (own := in_stated_coordinates(truth, spelling.lines)) is None:
        return None
    found = wrong_in(own.truth, own.lines, own.change, spelling.notes, verdict)
    return found if found is not None and found.mistakes else None


def wrong_without_constraints(truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict) -> Verdict | None:
    """The verdict on a wrong answer in coordinates in which the constraints hold, if its mistakes are found so.

    Right equations with multipliers, from which a wrong one was reduced, are left out if nothing else explains it.
    """
    if verdict.status is not Status.WRONG or any(m.name.startswith(OF_PLACES) for m in verdict.mistakes):
        return None
    used = tuple(lines)
    own = without_constraints(truth, used)
    if own is None and not verdict.mistakes:
        used = _without_right_rows(truth, lines, verdict)
        own = without_constraints(truth, used)
    if own is None:
        return None
    keys, of_line = keys_of([f.line for f in verdict.findings]), dict(zip(map(id, lines), keys_of(lines), strict=True))
    wrong = {key for key, f in zip(keys, verdict.findings, strict=True) if f.status is Status.WRONG}
    stated = [of_line[id(x)] for x in used if x.kind not in ("definition", "statement")]
    moved = dict(zip(stated, (x for x in own.lines if x.kind != "definition"), strict=True))
    unjudged = {key: x.expr == 0 for key, x in moved.items() if x.kind == "statement"}
    if any(not unjudged.get(key, True) for key in wrong):
        return None
    found = wrong_in(own.truth, own.lines, own.change, (), verdict)
    if found is None or not (found.mistakes or found.count_right > verdict.count_right):
        return None
    judged = {id(f.line): f for f in found.findings}
    there = {key: judged[id(x)] for key, x in moved.items() if id(x) in judged}
    held = text("true where the constraints hold")
    there |= {
        key: replace(f, status=Status.RIGHT, note=held)
        for key, f in zip(keys, verdict.findings, strict=True)
        if unjudged.get(key)
    }
    blamed = [f for f in found.findings if f.line.kind == "definition"]
    told = {f.line.number for f in blamed}
    findings = [there.get(key, f) for key, f in zip(keys, verdict.findings, strict=True)]
    findings = [f for f in findings if f.line.kind != "definition" or f.line.number not in told]
    findings = sorted([*findings, *blamed], key=lambda f: f.line.number)
    return replace(found, findings=tuple(findings), notes=(text("Read ", *own.change.words.parts, "."),))


def _without_right_rows(truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict) -> tuple[AnsweredLine, ...]:
    """The lines without right equations that have a multiplier: a name that the system does not have."""
    right = {(f.line.number, f.line.text) for f in verdict.findings if f.status.right and f.line.kind == "equation"}
    forces = {m.symbol for m in truth.derivation.multipliers.values()}
    forced = [x for x in lines if x.expr.has(*forces) or foreign_names(truth, x.expr)]
    return tuple(x for x in lines if (x.number, x.text) not in right or not any(x is y for y in forced))


def wrong_in(
    other: Reference, lines: Sequence[AnsweredLine], change: ProposedChange, notes: Sequence[Text], verdict: Verdict
) -> Verdict | None:
    """The verdict on lines in the coordinates of another reference; None if they are right there."""
    lines = [x for x in lines if x.expr == 0 or bounded.expand(change.put(x.expr)) != 0]  # others say the change
    judged = judged_lines(other, lines)
    if judged.status.right:  # equal only in double precision
        return None
    named = mistakes(other, lines, judged.findings)
    note = text("Your coordinates were read ", *change.words.parts, ".")
    return Verdict(
        judged.status,
        with_wrong_definitions(judged.findings, named.blamed),
        named.told,
        named.others,
        change=change.table,
        notes=(*notes, note),
        hint=verdict.hint,
        sure=named.sure,
        motion=judged.motion,
    )
