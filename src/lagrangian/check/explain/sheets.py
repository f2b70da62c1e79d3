"""Deals the equations of an answer into sets that are explained together."""

from __future__ import annotations

from collections.abc import Sequence

from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Finding


def sheets(truth: Reference, findings: Sequence[Finding]) -> list[list[AnsweredLine]]:
    """The equations in order, in sets with at most one for each coordinate.

    An answer may hold its equations several times: as they were derived, divided, solved for the accelerations. What
    holds no acceleration is no equation of motion, such as ½ J ṡ²/R beside them, if there are enough others.
    """
    accelerations = [c.acceleration for c in truth.model.coordinates]
    moving = [f for f in findings if f.line.expr.has(*accelerations)]
    found: list[list[AnsweredLine]] = []
    taken: set[str] = set()
    for f in moving if len(moving) >= truth.n else findings:
        if not found or len(found[-1]) == truth.n or f.coordinate in taken:
            found.append([])
            taken = set()
        found[-1].append(f.line)
        taken |= {f.coordinate} if f.coordinate is not None else set()
    return found
