"""Finds the sum of rates in a wrong T* or L that is not squared: ½ m (ẏ + r φ̇) for ½ m (ẏ + r φ̇)²."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.reference import Reference, terms
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.stated import harmless, right_value
from lagrangian.check.verdict import AnsweredLine, Mistake, Verdict
from lagrangian.page.formula import text

MOST_TERMS = 60
"""The most terms of a line in which such a sum is sought."""
LEFT_TO_TERMS = frozenset(["term_replaced", "term_alone"])
"""Mistakes that only say which term differs."""
WHY = text("T* has the square of the whole velocity: of every component, with all its terms.")


def with_sum_not_squared(truth: Reference, verdict: Verdict) -> Verdict:
    """The verdict on an answer without a better explanation, in which one sum that is not squared makes T* or L
    wrong."""
    wrong = [f.line for f in verdict.open_findings]
    energies = [line for line in wrong if line.kind in ("T", "L")]
    open_ = len(verdict.mistakes) < 2 and all(m.name in LEFT_TO_TERMS for m in verdict.mistakes)
    if not open_ or verdict.hint == 0 or len({line.number for line in energies}) != 1 or energies[0] is not wrong[0]:
        return verdict
    line = energies[0]
    found = list(_sums(truth, line)) if terms(line.expr) <= MOST_TERMS else []
    if len(found) != 1:
        return verdict
    what = text(f"In {line.title}, the sum ", found[0], " is not squared.")
    brief = text(f"A square is missing in {line.title}.")
    mistake = Mistake("sum_not_squared", what, WHY, 2, brief=brief)
    return replace(verdict, mistakes=(mistake,), alternatives=(), sure=True)


def _sums(truth: Reference, line: AnsweredLine) -> Iterator[sp.Expr]:
    """The sums of rates in a line with the squares of which it is right."""
    right = right_value(truth, line, None)
    for whole in sorted(line.expr.atoms(sp.Add), key=sp.default_sort_key) if right is not None else ():
        parts = [cast("sp.Expr", x) for x in whole.args]
        rated = [x for x in parts if _is_linear(truth, x)]
        given = [x for x in parts if rated and not x.has(*(c.rate for c in truth.model.coordinates))]
        for own in {sp.Add(*rated), sp.Add(*rated, *given)}:  # a given motion has terms without rates
            if not isinstance(own, sp.Add):
                continue
            squared = cast("sp.Expr", line.expr.xreplace({whole: whole - own + own**2}))
            rest = squared - cast("sp.Expr", right)
            if zero_everywhere(truth, rest) or harmless(truth, line, rest) is not None:
                yield own


def _is_linear(truth: Reference, term: sp.Expr) -> bool:
    """Whether a term is linear in the rates."""
    rates = [c.rate for c in truth.model.coordinates if term.has(c.rate)]
    slopes = [bounded.diff(term, x) for x in rates]
    linear = bool(rates) and not any(x.has(*rates) for x in slopes)
    return linear and bounded.expand(term - sp.Add(*[x * s for x, s in zip(rates, slopes, strict=True)])) == 0
