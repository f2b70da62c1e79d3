"""Tells a wrong term as it stands in an equation: times the factor of this equation, or in a denominator.

J stands there in φ̈ = (τ − b φ̇)/J, which is solved for its acceleration.
"""

from __future__ import annotations

from dataclasses import replace

import sympy as sp

from lagrangian import bounded
from lagrangian.check.align import Alignment
from lagrangian.check.explain.changes.change import LocalChange, Site
from lagrangian.check.reference import Reference


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
