"""Tells a wrong term as it stands in an equation: times the factor of this equation, or in a denominator.

J stands there in φ̈ = (τ − b φ̇)/J, which is solved for its acceleration.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import sympy as sp

from lagrangian import bounded
from lagrangian.check.align import Alignment
from lagrangian.check.explain.changes.change import LocalChange, Site
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import Mistake, Verdict
from lagrangian.page.formula import text


def as_it_stands(truth: Reference, change: LocalChange, under: Alignment | None) -> tuple[LocalChange, sp.Expr | None]:
    """A change and the factor by which the term in its words is multiplied, if there is one."""
    row = change.site.coordinate
    factor = under.factor(truth, row) if under is not None and row is not None else None
    if under is None or row is None or factor is None or sp.fraction(factor)[1].is_number:
        return change, factor
    site = _in_denominator(truth, change.site, under.exprs[under.rows.index(row)])
    return (change, factor) if site is None else (replace(change, site=site), None)


def _in_denominator(truth: Reference, site: Site, written: sp.Expr) -> Site | None:
    """The place of a term with the only acceleration for which an equation is solved; None for any other."""
    term = site.words[1] if site.single and len(site.words) > 2 else None
    held = [c for c in truth.model.coordinates if isinstance(term, sp.Expr) and term.has(c.acceleration)]
    if site.coordinate is None or not isinstance(term, sp.Expr) or len(held) != 1:
        return None
    if not bounded.diff(written, held[0].acceleration).is_number:
        return None
    own = bounded.cancel(term / held[0].acceleration)
    of = truth.model.coordinates[site.coordinate].symbol
    return replace(site, words=("the denominator's term ", own, " of the equation of ", of), rows={})


def with_denominators_named(truth: Reference, verdict: Verdict) -> Verdict:
    """The verdict; what is wrong in a term m s θ̈/(J + m s) of an equation that is solved for θ̈ is told of the term m s
    in the denominator, as the acceleration itself stands alone."""
    moving = [c.acceleration for c in truth.model.coordinates]
    exprs = [f.line.expr for f in verdict.open_equations]
    solved = [a for a in moving if any(x.has(a) and bounded.diff(x, a).is_number for x in exprs)]
    if not solved:
        return verdict
    mistakes, others = (tuple(_named_below(m, solved) for m in x) for x in (verdict.mistakes, verdict.alternatives))
    return replace(verdict, mistakes=mistakes, alternatives=others)


def _named_below(mistake: Mistake, solved: Sequence[sp.Expr]) -> Mistake:
    parts = list(mistake.what.parts)
    for k, (before, term) in enumerate(pairwise(parts)):
        if not isinstance(term, sp.Expr) or not str(before).lower().endswith("in the term "):
            continue
        if (below := _summand_below(term, solved)) is not None:
            start = str(before)[: -len("in the term ")]
            words = "In the denominator, in the term " if not start else f"{start}in the denominator, in the term "
            parts[k : k + 2] = [words, below]
            return replace(mistake, what=text(*parts))
    return mistake


def _summand_below(term: sp.Expr, solved: Sequence[sp.Expr]) -> sp.Expr | None:
    """The term of a denominator that multiplies an acceleration in a fraction with this denominator."""
    above, below = sp.fraction(term)
    for a in solved:
        factor = bounded.cancel(above / a)
        if above.has(a) and not factor.has(a) and factor in sp.Add.make_args(bounded.expand(below)):
            return factor
    return None
