"""Right answers in coordinates of their own in which the constraints hold by themselves: x = l sin(β + θ)/sin β."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from lagrangian.check.constraints.without_constraints import breaking_constraints, without_constraints
from lagrangian.check.coordinates.chart import system_coordinates, with_own_quantities
from lagrangian.check.judged import judged_lines
from lagrangian.check.reading.line_forms import accelerates
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake, Status, Verdict, inserted
from lagrangian.model.rows import rows_of
from lagrangian.page.formula import text

WHY_PLACE = text("Choose a position that the sketch shows, and compare it with what the formulas give.")


def right_in_own_coordinates(truth: Reference, lines: Sequence[AnsweredLine], hint: int) -> Verdict | None:
    """The verdict on an answer that is right in the coordinates in which it gives those of the system; None if it is
    not, or if anything in it is not judged there: an equation with a multiplier, or a name that nothing explains."""
    own = without_constraints(truth, lines)
    if own is None or len(_unjudged(own.lines)) > len(_unjudged(lines)):
        return None
    named = {c.name: c.symbol for c in truth.model.coordinates}
    said = [named[x.name] - x.expr for x in lines if x.kind == "definition" and x.name in named]
    placed = [x.expr for x in lines if x.kind in ("equation", "identity") and not accelerates(x.expr)]
    new = any(c.name not in named for c in own.truth.model.coordinates)
    if not new or not all(zero_everywhere(own.truth, own.change.put(expr)) for expr in (*said, *placed)):
        return None
    judged = judged_lines(own.truth, with_own_quantities(own.truth, own.lines, system_coordinates(own.truth)))
    if not judged.status.right:
        return None
    return Verdict(
        Status.OTHER_COORDINATES,
        judged.findings,
        notes=(own.change.told, *judged.notes),
        hint=hint,
        motion=judged.motion,
    )


def off_constraints(truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict) -> Verdict | None:
    """The verdict on a wrong answer in coordinates of its own with which the constraints do not hold: that is its first
    mistake, and what it writes in them follows."""
    if verdict.status is not Status.WRONG or (own := breaking_constraints(truth, lines)) is None:
        return None
    said = [x for x in lines if x.kind == "definition" and x.name in {c.name for c in truth.model.coordinates}]
    titles = {row.element.title for row in rows_of(truth.model)}
    element = next(iter(titles)) if len(titles) == 1 else None
    held = f" do not satisfy {element or 'a constraint'}."
    what = text("Your formulas ", *own.change.words.parts[1:], held)
    brief = text("Your formulas for the coordinates", held)
    mistake = Mistake("constraint_in_own_coordinates", what, WHY_PLACE, 1, element, None, brief)
    judged = judged_lines(own.truth, with_own_quantities(own.truth, own.lines, system_coordinates(own.truth)))
    fit = {(f.line.number, f.line.text) for f in judged.findings if f.status.right}
    findings = [replace(f, follows=f.follows or (f.line.number, f.line.text) in fit) for f in verdict.findings]
    findings = [replace(f, differences=()) for f in findings]
    findings = [f for f in findings if not any((f.line.number, f.line.text) == (x.number, x.text) for x in said)]
    for line in {(x.number, x.text): x for x in said}.values():
        findings = inserted(findings, Finding(line, Status.WRONG))
    return replace(verdict, findings=tuple(findings), mistakes=(mistake,), alternatives=(), sure=True)


def _unjudged(lines: Sequence[AnsweredLine]) -> list[AnsweredLine]:
    """The statements that say something."""
    return [x for x in lines if x.kind == "statement" and x.expr != 0]
