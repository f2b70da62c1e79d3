"""Right answers in coordinates of their own in which the constraints hold by themselves: x = l sin(β + θ)/sin β."""

from __future__ import annotations

from collections.abc import Sequence

from lagrangian.check.constraints.without_constraints import without_constraints
from lagrangian.check.coordinates.chart import system_coordinates, with_own_quantities
from lagrangian.check.judged import judged_lines
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Status, Verdict


def right_in_own_coordinates(truth: Reference, lines: Sequence[AnsweredLine], hint: int) -> Verdict | None:
    """The verdict on an answer that is right in the coordinates in which it gives those of the system; None if it is
    not, or if anything in it is not judged there: an equation with a multiplier, or a name that nothing explains."""
    own = without_constraints(truth, lines)
    if own is None or len(_unjudged(own.lines)) > len(_unjudged(lines)):
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


def _unjudged(lines: Sequence[AnsweredLine]) -> list[AnsweredLine]:
    """The statements that say something."""
    return [x for x in lines if x.kind == "statement" and x.expr != 0]
