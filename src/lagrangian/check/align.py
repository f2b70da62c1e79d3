"""How the equations of an answer may correspond to the right ones: which to which, divided by what.

An equation P_j that was divided, multiplied or solved is f·(W_i + ΔW_i) with a factor f that depends on the place
alone. It is found without any guess of its form: the quotient of two slopes that are not wrong, if it is constant at
every place.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import lru_cache
from itertools import permutations

import numpy as np
import sympy as sp

from lagrangian.check.reference import Reference
from lagrangian.check.rows import ratio
from lagrangian.check.verdict import AnsweredLine
from lagrangian.derive.sampling import PLACES, SETS, Array, CompiledExpressions
from lagrangian.records import dataclass

CONSTANT = 1e-7
"""The relative spread of a quotient at one place that counts as none."""
LARGEST = 1e100
"""Larger values are not compared: their squares would overflow."""
MOST_FACTORS = 6
MOST_ALIGNMENTS = 24
PLAIN = 0.25
SCALED = 0.7
"""What it costs to take an equation for a scaled one: a factor in one term is likelier than in all others."""


@dataclass(frozen=True, eq=False)
class Alignment:
    """A correspondence: row j of the answer is ``factors[j]`` (S) times the right row ``rows[j]`` and what is wrong.

    ``rest`` is what is wrong, in the terms of the right rows, (k, S); ``doubt`` grows with less likely alignments.
    """

    rows: tuple[int, ...]
    factors: Array
    rest: Array
    doubt: float
    solved: bool = False
    exprs: tuple[sp.Expr, ...] = ()

    def scale(self, truth: Reference, j: int) -> sp.Expr | None:
        """The factor of the answer's equation ``j``, if its form is found."""
        first = float(self.factors[j][0])
        if abs(first) == 1 and (self.factors[j] == first).all():
            return sp.Integer(int(first))
        return self.factor(truth, self.rows[j])

    def factor(self, truth: Reference, i: int) -> sp.Expr | None:
        """The factor of the answer's equation that corresponds to the right row ``i``, if its form is found."""
        if self.solved or i not in self.rows or not self.exprs:
            return None
        j = self.rows.index(i)
        mine, right = truth.form(self.exprs[j]), truth.forms[i]
        found = ratio(mine, right) if mine is not None and right is not None else None
        if found is None:
            return None
        values = CompiledExpressions([found[0]]).at(truth.states)[0]
        return found[0] if np.allclose(values, self.factors[j], rtol=1e-9) else None


def alignments(truth: Reference, exprs: Sequence[sp.Expr], P: Array) -> list[Alignment]:
    """The correspondences of the equations P (k, S), left minus right, the likeliest first."""
    k = len(exprs)
    if not 0 < k <= truth.n:
        return []
    table = _factors(truth, exprs)
    found: list[Alignment] = []
    for rows in _orders(table, k, truth.n):
        options = [table[j][i] for j, i in enumerate(rows)]
        for chosen, votes in _combined(options):
            factors = np.array([f for f, _ in chosen])
            with np.errstate(all="ignore"):
                rest = P / factors - truth.W[list(rows)]
            if np.isfinite(rest).all() and np.abs(rest).max() < LARGEST:
                found.append(Alignment(rows, factors, rest, -votes, exprs=tuple(exprs)))
    found.sort(key=lambda a: a.doubt)
    found = found[:MOST_ALIGNMENTS]
    found += _unsolved(truth, exprs, P)
    return [replace(a, doubt=_doubt(a, place)) for place, a in enumerate(found)]


def _doubt(alignment: Alignment, place: int) -> float:
    """What it costs to take this correspondence: little for equations as they stand, however few terms agree."""
    if _plain(alignment):
        return min(0.25 * place, PLAIN)
    return 0.25 * place + SCALED


def _plain(alignment: Alignment) -> bool:
    """Whether the equations are not scaled, but for their signs."""
    return not alignment.solved and bool((np.abs(alignment.factors) == 1).all())


def _orders(table: Sequence[Sequence[list[tuple[Array, float]]]], k: int, n: int) -> list[tuple[int, ...]]:
    """The likeliest assignments of the answer's equations to the right ones."""
    best = [[max((v for _, v in cell), default=0.0) for cell in row] for row in table]
    if n > 5:
        order = tuple(int(np.argmax(row)) for row in best)
        return [order] if len(set(order)) == k else [tuple(range(k))]
    every = sorted(
        permutations(range(n), k),
        key=lambda p: -sum(best[j][i] for j, i in enumerate(p)) + (p != tuple(sorted(p))) * 0.1,
    )
    return every[:3]


def _combined(options: Sequence[Sequence[tuple[Array, float]]]) -> Iterator[tuple[list[tuple[Array, float]], float]]:
    """Combinations of one factor for each row with the sum of their votes, the best first."""
    partial: list[tuple[list[tuple[Array, float]], float]] = [([], 0.0)]
    for cell in options:
        grown = [([*chosen, f], votes + f[1]) for chosen, votes in partial for f in cell]
        partial = sorted(grown, key=lambda x: -x[1])[:MOST_ALIGNMENTS]
    yield from partial


def _factors(truth: Reference, exprs: Sequence[sp.Expr]) -> list[list[list[tuple[Array, float]]]]:
    """For every pair of an equation and a right row, possible factors with their votes."""
    mine, by = slopes_of_equations(truth, exprs), range(truth.n)
    right = slopes_of(truth)
    return [[agreed(truth, mine[j], right[i]) for i in by] for j in range(len(exprs))]


@lru_cache(maxsize=32)
def slopes_of(truth: Reference) -> Array:
    """The slopes of the right rows, see `slopes_of_equations`, computed once for the systems checked most recently."""
    return slopes_of_equations(truth, truth.rows)


def fit(truth: Reference, lines: Sequence[AnsweredLine]) -> tuple[float, int]:
    """In how many slopes by what moves the lines of an answer agree with the right ones that they resemble most, and
    how many slopes they have."""
    c, u = truth.model.coordinates, truth.model.inputs
    by = [*(x for q in c for x in (q.symbol, q.rate, q.acceleration)), *(x.symbol for x in u)]
    rights = {kind: [x] for kind, x in truth.energies.items()} | {"Xi": list(truth.Xi), "equation": list(truth.rows)}
    found, count = 0.0, 0
    for kind, exprs in rights.items():
        own = [line.expr for line in lines if line.kind == kind]
        if own:
            right, mine = (_slopes(truth, x, by) for x in (exprs, own))
            found += sum(max(agreeing(m, r)[0] for r in right) for m in mine)
            count += sum(int((np.abs(m).max(axis=1) > 0).sum()) for m in mine)
    return found, count


def _slopes(truth: Reference, exprs: Sequence[sp.Expr], by: Sequence[sp.Expr]) -> Array:
    return CompiledExpressions(exprs).slopes(by).at(truth.states).reshape(len(exprs), len(by), truth.states.size)


def slopes_of_equations(truth: Reference, exprs: Sequence[sp.Expr]) -> Array:
    """The slopes of every equation by accelerations, inputs, rates and parameters, and its value at rest, (k, m, S)."""
    model, size = truth.model, truth.states.size
    moving = [
        *(c.acceleration for c in model.coordinates),
        *(u.symbol for u in model.inputs),
        *(c.rate for c in model.coordinates),
    ]
    by = [*moving, *(p.symbol for p in model.parameters if p.symbol not in truth.values)]
    values = _slopes(truth, exprs, by)
    rest = CompiledExpressions(exprs).at(truth.states, dict.fromkeys(moving, np.zeros(size)))
    return np.concatenate([values, rest[:, None]], axis=1)


def agreed(truth: Reference, mine: Array, right: Array) -> list[tuple[Array, float]]:
    """The quotients of slopes that are constant at every place, equal ones counted together; always ±1 as well."""
    size = truth.states.size
    blocks = SETS * PLACES
    with np.errstate(all="ignore"):
        quotient = mine / right
        shaped = quotient.reshape(len(quotient), blocks, -1)
        middle = shaped.mean(axis=2, keepdims=True)
        spread = (np.abs(shaped - middle) > CONSTANT * np.abs(middle)).any(axis=(1, 2))
    held = np.isfinite(quotient).all(axis=1) & ~(np.abs(quotient) < 1e-12).any(axis=1) & ~spread
    found: list[tuple[Array, float]] = [(np.ones(size), 1.5), (-np.ones(size), 0.4)]
    for f, own in zip(quotient[held], middle[held, :, 0], strict=True):
        for place, (other, votes) in enumerate(found):
            if (np.abs(f - other) <= CONSTANT * np.abs(other)).all():
                found[place] = (other, votes + 1.0)
                break
        else:
            same = np.ptp(own) <= CONSTANT * np.abs(own).max()
            found.append((np.repeat(own, size // blocks), 1.0 + (0.2 if same else 0.0)))
    return sorted(found, key=lambda x: -x[1])[:MOST_FACTORS]


def agreeing(mine: Array, right: Array, first: int = 0) -> tuple[float, int | None]:
    """How many slopes (m, S) are the same multiple of the right ones, and the place of one; ±1 counts a bit more.

    The ``first`` slopes count twice."""
    held = (np.abs(right).max(axis=1) > 1e-9) & (np.abs(mine).max(axis=1) > 1e-9)
    places = np.flatnonzero(held)
    with np.errstate(all="ignore"):
        ratios = mine[places] / right[places]
    best: tuple[float, int | None] = (0.0, None)
    for k, own in zip(places, ratios, strict=True):
        if not np.isfinite(own).all():
            continue
        same = (np.abs(ratios - own) <= 1e-8 * np.abs(own)).all(axis=1)
        count = float(same.sum() + same[places < first].sum()) + (
            0.5 if np.ptp(np.abs(own)) == 0 and abs(own[0]) == 1 else 0.0
        )
        if count > best[0]:
            best = count, int(k)
    return best


def agreement(truth: Reference, lines: Sequence[AnsweredLine]) -> float:
    """In how many slopes the lines of an answer agree with the right ones that they resemble most."""
    rights = {"T": [truth.T], "V": [truth.V], "L": [truth.L], "equation": list(truth.rows)}
    total = 0.0
    for kind, exprs in rights.items():
        mine = [line.expr for line in lines if line.kind == kind]
        if mine:
            right = slopes_of(truth) if kind == "equation" else slopes_of_equations(truth, exprs)
            total += sum(max(agreeing(m, r)[0] for r in right) for m in slopes_of_equations(truth, mine))
    return total


def solved(truth: Reference, exprs: Sequence[sp.Expr]) -> bool:
    """Whether there are as many equations as coordinates, more than one, and each holds one acceleration alone."""
    accelerations = [c.acceleration for c in truth.model.coordinates]
    return len(exprs) == truth.n > 1 and all(sum(e.has(a) for a in accelerations) == 1 for e in exprs)


def _unsolved(truth: Reference, exprs: Sequence[sp.Expr], P: Array) -> list[Alignment]:
    """Rows solved for one acceleration each, multiplied back by the right mass matrix."""
    n, size = truth.n, truth.states.size
    if not solved(truth, exprs):
        return []
    accelerations = [c.acceleration for c in truth.model.coordinates]
    mine = CompiledExpressions(exprs).slopes(accelerations).at(truth.states).reshape(n, n, size).transpose(2, 0, 1)
    right = slopes_of(truth)[:, :n].transpose(2, 0, 1)
    try:
        back = right @ np.linalg.inv(mine)
    except np.linalg.LinAlgError:
        return []
    with np.errstate(all="ignore"):
        rest = np.einsum("sij,js->is", back, P) - truth.W
    if not np.isfinite(rest).all() or np.abs(rest).max() > LARGEST:
        return []
    return [Alignment(tuple(range(n)), np.ones((n, size)), rest, 0.0, solved=True)]
