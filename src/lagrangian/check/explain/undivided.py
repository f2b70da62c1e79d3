"""Finds rows that were divided or multiplied, but not in all terms."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product
from typing import cast

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.align import CONSTANT, Alignment
from lagrangian.check.explain.changes.pool import Pool
from lagrangian.check.explain.divided_otherwise import divided_otherwise
from lagrangian.check.explain.right_terms import RightTerm, right_terms
from lagrangian.check.explain.search import SMALL
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import Mistake
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.page.formula import text
from lagrangian.records import dataclass

WHY = text("An equation stays true only if every term on both sides is divided or multiplied by the same.")
MOST_DIVISORS = 40


@dataclass(frozen=True, eq=False)
class Undivided:
    """A term of equation ``row`` that was divided (or ``multiplied``) by ``only`` where ``others`` were by ``by``."""

    row: int
    term: RightTerm
    by: sp.Expr
    only: sp.Expr
    multiplied: bool
    others: int

    @property
    def cost(self) -> float:
        """How unlikely it is that this was the mistake."""
        alone = 0.8 if self.others == 1 else 0.0  # of two terms the other one may as well have a factor too much
        return 1.8 + self.term.cost + (0.0 if self.only == 1 else 0.4) + (0.6 if self.multiplied else 0.0) + alone

    def mistake(self, truth: Reference) -> Mistake:
        """The mistake in words."""
        q, name = truth.derivation.coordinates[self.row], truth.model.coordinates[self.row].name
        done, kind = ("multiplied", "not_multiplied") if self.multiplied else ("divided", "not_divided")
        term = self.term.expr
        term = -term if term.could_extract_minus_sign() else term
        plural = isinstance(term, sp.Add)
        short = (" only by ", self.only, ".") if self.only != 1 else (" were not." if plural else " was not.",)
        which = "the terms " if plural else "the term "
        what = text("The equation of ", q, f" was {done} by ", self.by, f", but {which}", term, *short)
        brief = text("Not all terms of the equation of ", q, f" were {done} by the same.")
        element = self.term.element.title if self.term.element is not None else None
        return Mistake(kind, what, WHY, 5, element, name, brief)


def undivided(pool: Pool, found: Sequence[Alignment]) -> Undivided | None:
    """The term that was not divided as the others, the likeliest; None unless that is all that is wrong."""
    listed = [u for a in found if not a.solved for u in _under(pool, a)]
    return min(listed, key=lambda u: u.cost, default=None)


def _under(pool: Pool, a: Alignment) -> Iterator[Undivided]:
    """The explanations under one correspondence: one row that is scaled and wrong, all others right."""
    truth = pool.truth
    size = 1e-9 * (1 + np.abs(truth.W[list(a.rows)]).max(axis=1))
    wrong = np.flatnonzero(np.abs(a.rest).max(axis=1) > size)
    if len(wrong) != 1 or (np.abs(a.factors[wrong[0]]) == 1).all():
        return
    j = int(wrong[0])
    i, right = a.rows[j], right_terms(pool, "equation", a.rows[j])
    with np.errstate(all="ignore"):
        times = a.rest[j] / right.values + 1.0  # what the term is larger than it should be
    blocks = times.reshape(len(times), -1, truth.states.motions)
    same = np.abs(blocks - blocks[:, :, :1]) <= CONSTANT * (1 + np.abs(blocks[:, :, :1]))
    steady = np.isfinite(times).all(axis=1) & same.all(axis=(1, 2))
    if (by := _divisor(pool, a, j)) is None:
        return
    if (several := divided_otherwise(pool, a, j, by)) is not None:
        yield Undivided(i, several[0], by, several[1], multiplied=False, others=len(pool.sites.rows[i]))
    for k in np.flatnonzero(steady):
        if k_only := _share(pool, times[k], by):
            done, only = k_only
            multiplied = sp.fraction(by)[1] != 1
            by_all, by_one = (1 / by, 1 / only) if multiplied else (done, only)
            others = len(pool.sites.rows[i]) - len(sp.Add.make_args(bounded.expand(right.terms[k].expr)))
            yield Undivided(i, right.terms[k], by_all, by_one, multiplied, others)


def _divisor(pool: Pool, a: Alignment, j: int) -> sp.Expr | None:
    """What equation j was divided by, without its sign: a product of letters, or the inertia of its coordinate."""
    truth, i = pool.truth, a.rows[j]
    factor = a.factor(truth, i)
    if factor is not None:
        return bounded.cancel(1 / factor.as_coeff_Mul()[1] / abs(factor.as_coeff_Mul()[0]))
    inertia = truth.expand(cast("sp.Expr", truth.derivation.mass_matrix[i, i]))
    values = CompiledExpressions([inertia]).at(truth.states)[0]
    with np.errstate(all="ignore"):
        fits = np.abs(np.abs(values * a.factors[j]) - 1.0) <= SMALL
    return inertia if fits.all() else None


def _share(pool: Pool, times: Array, by: sp.Expr) -> tuple[sp.Expr, sp.Expr] | None:
    """``by`` and the part of it by which a term was divided that is ``times`` what it should be."""
    parts = list(_parts(by))
    values = CompiledExpressions([by / p for p in parts]).at(pool.truth.states)
    for p, v in zip(parts, values, strict=True):
        if p != by and (np.abs(v - times) <= SMALL * (1 + np.abs(v))).all():
            return by, p
    return None


def _parts(by: sp.Expr) -> Iterator[sp.Expr]:
    """The divisors of a product, 1 first."""
    powers = [f.as_base_exp() for f in sp.Mul.make_args(by)]
    if not all(e.is_Integer for _, e in powers):
        yield sp.S.One
        return
    listed = [[b**k for k in range(0, int(e) + (1 if e > 0 else -1), 1 if e > 0 else -1)] for b, e in powers]
    for _, chosen in zip(range(MOST_DIVISORS), product(*listed), strict=False):
        yield sp.Mul(*chosen)
