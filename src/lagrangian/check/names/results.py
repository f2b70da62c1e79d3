"""Forces of constraints that an answer only states as results: λ = m g cos θ − m R θ̇², beside equations without λ."""

from __future__ import annotations

from collections.abc import Sequence, Set

import sympy as sp

from lagrangian import bounded
from lagrangian.check.verdict import AnsweredLine
from lagrangian.model import Model
from lagrangian.page.formula import text

FORCE = text("the force of the constraint")
"""What is said of a result that is right; its sign and its scale are a choice, as those of every multiplier."""


def results_in(model: Model, known: Set[sp.Basic], equations: Sequence[AnsweredLine]) -> dict[sp.Basic, AnsweredLine]:
    """The equations λ = … without accelerations, by a name λ that is not ``known`` and that no other equation uses."""
    used = [bounded.letters(line.expr) - known for line in equations]
    found: dict[sp.Basic, AnsweredLine] = {}
    for k, (line, new) in enumerate(zip(equations, used, strict=True)):
        alone = len(new) == 1 and not any(new & others for j, others in enumerate(used) if j != k)
        if alone and not line.expr.has(*(c.acceleration for c in model.coordinates)):
            (s,) = new
            if line.expr.diff(s) in (1, -1):
                found[s] = line
    return found


def is_factor_of_forces(name: sp.Basic, lines: Sequence[AnsweredLine]) -> bool:
    """Whether a name may be that of a multiplier: all lines are linear in it, and none has its rate."""
    return not any(
        any(d.args[0] == name for d in line.expr.atoms(sp.Derivative)) or bounded.diff(line.expr, name).has(name)
        for line in lines
        if line.expr.has(name)
    )
