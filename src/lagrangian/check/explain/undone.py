"""Refuses two mistakes of which one undoes the other: "the ½ of a spring is missing" beside its right force.

Who has the right term of a spring in a line has not made the mistake that would change it there; that a second mistake
would take the change back again is arithmetic. So each of two mistakes in a line must show in the terms in which that
line differs.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np
import sympy as sp
from scipy.optimize import lsq_linear

from lagrangian import bounded
from lagrangian.check.explain.changes.pool import Pool
from lagrangian.check.explain.search import Explanation, Told, without_constant
from lagrangian.check.stated import index_of
from lagrangian.check.verdict import Finding, Status
from lagrangian.derive.sampling import SETS, Array, CompiledExpressions
from lagrangian.records import dataclass

NEAR = 1e-7
"""The relative size of what is rounding."""
MOST_TERMS = 24
"""The most terms of a line that are compared with what a mistake changes in it."""


@dataclass(frozen=True, eq=False)
class _Line:
    """What a wrong line is of, the coordinate of its equation or Ξ, and the values of the terms in which it differs."""

    kind: str
    i: int | None
    terms: Array


class Undone:
    """The terms in which the wrong lines of an answer differ, to hold several mistakes against."""

    def __init__(self, pool: Pool, findings: Sequence[Finding]) -> None:
        self.pool = pool
        self._wrong = [f for f in findings if f.status is Status.WRONG and f.differences]

    @cached_property
    def _lines(self) -> list[_Line]:
        return [x for f in self._wrong if (x := self._line(f)) is not None]

    def _line(self, finding: Finding) -> _Line | None:
        kind, truth = finding.line.kind, self.pool.truth
        i = index_of(truth, finding.line.name if kind == "Xi" else finding.coordinate)
        if kind not in ("T", "V", "L", "Xi", "equation") or (kind in ("Xi", "equation") and i is None):
            return None
        put = truth.expand
        terms = [
            truth.put(put(x))
            for d in finding.differences
            for x in sp.Add.make_args(bounded.expand(put(d.written) - put(d.term)))
        ]
        if not terms or len(terms) > MOST_TERMS or any(x.free_symbols - truth.names for x in terms):
            return None
        values = CompiledExpressions(terms).at(truth.states)
        values = without_constant(values) if kind in ("V", "L") else values
        return _Line(kind, i, values) if np.isfinite(values).all() else None

    def holds(self, explanation: Explanation) -> bool:
        """Whether one of several mistakes takes back what another one changes in a line that is right there."""
        told = explanation.told
        return len(told) > 1 and any(self._undo(line, told) for line in self._lines)

    def _undo(self, line: _Line, told: Sequence[Told]) -> bool:
        """Whether mistakes that lead to a line change more than the terms in which it differs."""
        made = np.array([float(t.times) * self._effects(line)[self.pool.places[id(t.mistake)]] for t in told])
        felt = np.abs(made).max(axis=1) > NEAR * np.abs(made).max()
        whole, rest = made.sum(axis=0), line.terms.sum(axis=0)
        scale = _scale(whole, rest)
        if felt.sum() < 2 or scale is None:
            return False
        terms = line.terms * scale
        size = np.abs(made).max()
        return any(np.abs(_within(terms / size, own / size)).max() > NEAR for own in made[felt])

    def _effects(self, line: _Line) -> Array:
        """What every possible mistake adds to such a line."""
        pool = self.pool
        if line.kind in ("V", "L"):
            return pool.kept(("line", line.kind), lambda: without_constant(pool.V if line.kind == "V" else pool.L))
        return pool.T if line.kind == "T" else (pool.Xi if line.kind == "Xi" else pool.W)[:, line.i]


def _within(terms: Array, own: Array) -> Array:
    """What a mistake changes besides a part of each of some terms."""
    found = lsq_linear(terms.T, own, (0.0, 1.0), method="bvls", tol=1e-14)
    return own - found.x @ terms


def _scale(whole: Array, rest: Array) -> Array | None:
    """By what a line is multiplied, a constant for each set of parameters; None if that is not so."""
    sizes = np.abs(rest).max()
    if not np.isfinite(whole).all() or sizes == 0 or np.abs(whole).max() == 0:
        return None
    one, other = whole.reshape(SETS, -1), rest.reshape(SETS, -1)
    factors = (one * other).sum(axis=1) / np.maximum((other * other).sum(axis=1), 1e-300)
    if np.abs(factors[:, None] * other - one).max() > NEAR * np.abs(one).max():
        return None
    return np.repeat(factors, one.shape[1])
