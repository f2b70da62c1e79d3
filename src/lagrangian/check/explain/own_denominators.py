"""Tells a wrong factor of the acceleration for which an equation is solved by the term of its denominator.

ÿ = (F + m g)/(m + M y/l)        In the denominator, the term M y/l stands where M y²/l² belongs.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import cast

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.known_beside import Slip
from lagrangian.check.explain.own_terms import OwnTerm, term_replaced
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import Mistake
from lagrangian.derive.sampling import CompiledExpressions
from lagrangian.page.formula import text

WHY = text("The denominator is what multiplies the acceleration in the equation of motion: compare both, term by term.")
NEAR = 1e-9
"""The relative difference of values that is rounding."""


def mistake_of(truth: Reference, own: Slip, exprs: Sequence[sp.Expr]) -> Mistake:
    """A wrong term of equations in words: of an acceleration that is solved for, the term of its denominator."""
    said = own.mistake(truth)
    moving = [c.acceleration for c in truth.model.coordinates]
    if not isinstance(own, OwnTerm) or own.instead is None or own.row is None or own.term != moving[own.row]:
        return said
    mass = bounded.expand(truth.expand(bounded.diff(truth.rows[own.row], own.term)))
    for below in sorted({f.base for x in exprs for f in x.atoms(sp.Pow) if f.exp == -1}, key=sp.default_sort_key):
        right, written = (set(sp.Add.make_args(bounded.expand(x))) for x in (mass, below))
        pair = [sp.Add(*(a - b)) for a, b in ((written, right), (right, written))]
        one = all(len(a - b) < 2 for a, b in ((written, right), (right, written)))
        if not one or not written & right or not _is_same(truth, below * own.instead[0] / own.term, mass):
            continue
        name, what = term_replaced(*cast("list[sp.Expr]", pair))
        first, *more = what.parts
        words = (f"{str(first)[:1].lower()}{str(first)[1:]}", *more)
        of = truth.derivation.coordinates[own.row]
        what = text("In the denominator of the equation of ", of, ": ", *words)
        return replace(said, name=name, what=what, why=WHY)
    return said


def _is_same(truth: Reference, one: sp.Expr, other: sp.Expr) -> bool:
    """Whether two expressions have the same values."""
    a, b = CompiledExpressions([truth.put(truth.expand(x)) for x in (one, other)]).at(truth.states)
    return bool(np.isfinite(a).all() and np.abs(a - b).max() <= NEAR * np.abs(b).max())
