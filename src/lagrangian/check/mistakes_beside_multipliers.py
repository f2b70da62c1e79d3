"""Mistakes in equations with multipliers: sought in what is written, or where the constraints hold."""

from __future__ import annotations

from collections.abc import Sequence

from lagrangian.check.held import held
from lagrangian.check.mistakes import NamedMistakes, mistakes
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine, Finding, Status


def mistakes_beside_multipliers(
    truth: Reference, lines: Sequence[AnsweredLine], findings: Sequence[Finding]
) -> NamedMistakes:
    """The mistakes behind the wrong equations of a system with constraints.

    Where a constraint is put in, terms vanish, and what is missing then may seem more than what was left out. So one
    mistake that explains equations into which none was put goes first.
    """
    forces = [m.symbol for m in truth.derivation.multipliers.values()]
    wrong = [f.line for f in findings if f.status is Status.WRONG and f.line.kind == "equation"]
    if all(line.expr.has(*forces) for line in wrong):
        named = mistakes(truth, lines, findings)
        if len(named.told) == 1 and named.sure and not named.left:
            return named
    return mistakes(held(truth) or truth, lines, findings)
