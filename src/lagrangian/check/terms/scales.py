"""The factor with which most terms of an equation are those of a right one: it was divided by m (R − r), or by m alone.

Every term has a vote: terms with the same motion, such as all that hold φ̈, are compared as a whole, and one by one if
they differ as a whole.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np
import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.reference import Reference
from lagrangian.check.rows import same_values
from lagrangian.check.terms.pieces import Summand, WrittenTerm, motion, pieces, rates, written_terms
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.records import dataclass

MOST_CANDIDATES = 12
MOST_ALIKE = 8
"""The most terms and pieces with the same motion that are divided by others."""
PART = 0.9
"""The vote of terms of which only all pieces agree one by one, or their share of it."""
UNLIKELY = 1.5
"""The votes that a quotient of letters has less."""


@dataclass(frozen=True, eq=False)
class VotedScale:
    """A factor of a right equation, its values at the states, and how many terms of the other one speak for it."""

    factor: sp.Expr
    values: Array
    votes: float


def scales(truth: Reference, expr: sp.Expr, right: Sequence[sp.Expr]) -> list[VotedScale]:
    """The factors with which terms of ``expr`` are those of the right sum, those with the most votes first."""
    terms = pieces(written_terms(expr)), pieces(right)
    if not terms[0] or not terms[1]:
        return []
    own, theirs = ([p for t in x for p in t.pieces] for x in terms if x)
    factors = _candidates(terms[0], terms[1])
    exprs = [*factors, *(p.expr for p in own), *(p.expr for p in theirs)]
    values = CompiledExpressions(exprs).at(truth.states)
    mine, rights = np.split(values[len(factors) :], [len(own)])
    accelerations = [c.acceleration for c in truth.model.coordinates]
    found: list[VotedScale] = []
    for factor, v in zip(factors, values[: len(factors)], strict=True):
        if np.isfinite(v).all() and v.all():
            votes = _votes(_Groups(own, mine), _Groups(theirs, v * rights), accelerations)
            found.append(VotedScale(factor, v, votes - UNLIKELY * _is_quotient(factor)))
    return sorted(found, key=lambda x: (-round(x.votes, 6), x.factor != 1, x.factor != -1, bounded.size(x.factor)))


class _Groups:
    """The values of pieces by their motion, and of these by their rates."""

    def __init__(self, found: Sequence[Summand], values: Array) -> None:
        self.values = values
        self.of: dict[sp.Expr, dict[sp.Expr, list[int]]] = {}
        for k, p in enumerate(found):
            self.of.setdefault(rates(p.expr), {}).setdefault(motion(p.expr), []).append(k)

    def whole(self, of_rates: sp.Expr) -> Array:
        """The sum of all pieces with the same rates."""
        return np.sum([self.values[k] for x in self.of.get(of_rates, {}).values() for k in x], axis=0)


def _votes(own: _Groups, right: _Groups, accelerations: Sequence[sp.Expr]) -> float:
    """How many motions of an equation are right, those with accelerations first."""
    votes = 0.0
    for of_rates, motions in own.of.items():
        weight = 1.01 if of_rates.has(*accelerations) else 1.0
        if of_rates in right.of and same_values(own.whole(of_rates), right.whole(of_rates)):
            votes += weight * len(motions)
            continue
        others = right.of.get(of_rates, {})
        votes += weight * sum(_vote(own.values[k], right.values[others.get(m, [])]) for m, k in motions.items())
    return votes


def _candidates(own: Sequence[WrittenTerm], right: Sequence[WrittenTerm]) -> list[sp.Expr]:
    """The quotients of terms with the same motion and of their pieces, the most frequent first, and ±1."""
    theirs = _by_motion(right)
    seen = Counter(x / y for m, found in _by_motion(own).items() for x in found for y in theirs.get(m, ()))
    listed = [f for f, _ in seen.most_common() if not f.has(AppliedUndef) and f.is_finite is not False]
    return list(dict.fromkeys([*listed[:MOST_CANDIDATES], sp.S.One, sp.S.NegativeOne]))


def _by_motion(terms: Sequence[WrittenTerm]) -> dict[sp.Expr, list[sp.Expr]]:
    """The terms that have one motion, their parts that do, and all pieces."""
    found: dict[sp.Expr, dict[sp.Expr, None]] = {}
    for term in terms:
        for x in (term, *term.parts):
            motions = {motion(p.expr) for p in x.pieces}
            if len(motions) == 1:
                found.setdefault(motions.pop(), {})[x.expr] = None
        for p in term.pieces:
            found.setdefault(motion(p.expr), {})[p.expr] = None
    return {m: [*x][:MOST_ALIKE] for m, x in found.items()}


def _is_quotient(factor: sp.Expr) -> bool:
    """Whether a factor is a quotient of letters: equations are divided, or multiplied, but seldom both."""
    return all(x.free_symbols for x in sp.fraction(factor))


def _vote(own: Array, right: Array) -> float:
    """1 for terms that are right as a whole, otherwise the share of them that is found among the right ones."""
    if not len(right):
        return 0.0
    if same_values(own.sum(axis=0), right.sum(axis=0)):
        return 1.0
    return PART * sum(any(same_values(x, y) for y in right) for x in own) / max(len(own), len(right))
