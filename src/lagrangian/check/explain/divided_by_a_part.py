"""An equation that is divided by a part of what it should be divided by: u″ = x″ − [k u + …]/M₂ for …/(M₂ + m)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import cast

import numpy as np
import sympy as sp

from lagrangian.check.explain.combined_rows import is_mass
from lagrangian.check.held import held
from lagrangian.check.reference import Reference
from lagrangian.check.rows import small
from lagrangian.check.verdict import Finding, Mistake
from lagrangian.derive.sampling import CompiledExpressions
from lagrangian.page.formula import text

MOST_PARTS, MOST_MASSES = 4, 8
"""The most denominators of a line, and the most masses that may be missing in one."""
WHY = text("What is divided by is all that multiplies the acceleration in the equation: every mass that is moved.")
NAME = "divided_by_a_part"


def divided_by_a_part(truth: Reference, findings: Sequence[Finding]) -> Mistake | None:
    """The mistake if the only wrong line that follows from none lacks several terms and would be right with one mass
    more in a denominator; None otherwise."""
    wrong = [f for f in findings if f.is_open]
    on = held(truth) if truth.derivation.multipliers else truth
    if len(wrong) != 1 or wrong[0].line.kind != "equation" or on is None:
        return None
    (finding,) = wrong
    if len(finding.differences) < 2 or any(d.kind != "missing" for d in finding.differences):
        return None
    tried = list(_with_more(truth, finding.line.expr))
    values = CompiledExpressions([x for _, _, x in tried]).at(on.states, on.accelerations) if tried else ()
    scale = CompiledExpressions([finding.line.expr]).at(on.states)[0]
    for (below, whole, _), own in zip(tried, values, strict=True):
        if small(own, float(np.abs(scale).max())):
            what = text(f"{finding.line.opening} is divided by ", below, "; it should be divided by ", whole, ".")
            brief = text(f"What {finding.line.title} is divided by is not right.")
            return Mistake(NAME, what, WHY, 5, None, finding.coordinate, brief)
    return None


def _with_more(truth: Reference, expr: sp.Expr) -> Iterator[tuple[sp.Expr, sp.Expr, sp.Expr]]:
    """A denominator, itself with a mass more, and the expression with this in its place."""
    masses = [p.symbol for p in truth.model.parameters if is_mass(truth, p.symbol)][:MOST_MASSES]
    parts = sorted((x for x in expr.atoms(sp.Pow) if x.exp == -1), key=sp.default_sort_key)[:MOST_PARTS]
    for part in parts:
        below = cast("sp.Expr", part.base)
        for mass in masses:
            if not below.has(mass) and any(below.has(x) for x in masses):
                whole = below + mass
                yield below, whole, cast("sp.Expr", expr.xreplace({part: 1 / whole}))
