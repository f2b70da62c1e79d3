"""A wrong equation that is meant as the sum or the difference of two right ones, compared with that and not with one.

(J + M R²) ψ̈ + … = τ − u + b β̇      the equation of ψ less that of β: −u is no mistake in it, nor are terms of β missing
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import lru_cache

import sympy as sp

from lagrangian import bounded
from lagrangian.check.difference import differences, likeness, voted
from lagrangian.check.explain.quoted import LINE
from lagrangian.check.explain.reaction_not_drawn import as_balances_of_bodies
from lagrangian.check.explain.terms_alone import MOST_TOLD, term_mistake
from lagrangian.check.reference import Reference, terms
from lagrangian.check.verdict import Finding, Mistake, TermDifference, Verdict
from lagrangian.page.formula import text
from lagrangian.records import dataclass

FEWEST = 3
"""The fewest terms in which a line differs from a single right equation that may be meant as another."""
MOST_COORDINATES = 4
"""With more coordinates there are too many sums of two equations."""
MOST_TERMS = 120
"""The most terms of a right equation that is added to another one."""


@dataclass(frozen=True, eq=False)
class MeantCombination:
    """A finding that is compared with ``i`` ± ``j``, the places of two right equations."""

    finding: Finding
    i: int
    j: int
    sign: int

    @property
    def mistakes(self) -> tuple[Mistake, ...]:
        """The terms that differ, as mistakes."""
        return tuple(term_mistake(self.finding, d) for d in self.finding.differences)


def meant_combinations(
    truth: Reference, findings: Sequence[Finding], left: Sequence[int], *, half: bool = False
) -> dict[int, MeantCombination]:
    """The wrong equations that differ in one or two terms from a sum or a difference of two right ones, and in more
    than twice as many from any of these, by the places of their findings.

    ``left`` are the places of those that no mistake explains. Another line must be the equation of one of the two.
    ``half`` as many, and of two, are few enough where only the comparison is chosen, and in balances of bodies of
    which more than one thing would have to be wrong: a force between two of them stands in both.
    """
    if truth.derivation.multipliers or not 1 < truth.n <= MOST_COORDINATES:
        return {}
    names = [c.name for c in truth.model.coordinates]
    found: dict[int, MeantCombination] = {}
    for k in left:
        f = findings[k]
        if len(f.differences) < FEWEST - half or terms(f.line.expr) > MOST_TERMS:
            continue
        beside = {x.coordinate for m, x in enumerate(findings) if x.line.kind == "equation" and m != k}
        tried = [
            (meant, i, j, sign)
            for i, j, sign in _pairs(truth.n)
            if {names[i], names[j]} & beside and (meant := _compared(truth, f.line.expr, i, j, sign))
        ]
        best = min(tried, key=lambda x: len(x[0]), default=None)
        if best is None or len(best[0]) > MOST_TOLD or 2 * len(best[0]) >= len(f.differences) + half:
            continue
        meant, i, j, sign = best
        q = truth.derivation.coordinates
        note = text("as the equation of ", q[i], " and that of " if sign > 0 else " less that of ", q[j])
        told = replace(f, differences=meant, coordinate=None, note=note, elements=())
        found[k] = MeantCombination(told, i, j, sign)
    return found


def _pairs(n: int) -> Iterator[tuple[int, int, int]]:
    """Two places and a sign: every sum, and every difference."""
    for i in range(n):
        for j in range(i + 1, n):
            yield i, j, -1
            yield i, j, 1


@lru_cache(maxsize=100)
def _compared(truth: Reference, expr: sp.Expr, i: int, j: int, sign: int) -> tuple[TermDifference, ...]:
    """The terms in which a line differs from two right equations together; none where it cannot be compared. They are
    kept, as a line is compared again when its mistakes are known."""
    if max(terms(truth.rows[i]), terms(truth.rows[j])) > MOST_TERMS:
        return ()
    both: sp.Expr = truth.rows[i] + sign * truth.rows[j]
    mine, right = truth.form(expr), truth.form(both)
    if mine is None or right is None:
        return ()
    (like,) = likeness(mine, [right])
    like = voted(truth, expr, right, like)
    if like.factor not in (1, -1):
        return ()
    found, others = (differences(truth, mine, right, like.factor, x, expr) for x in (i, j))
    origins = [tuple(dict.fromkeys((*a.origins, *b.origins))) for a, b in zip(found, others, strict=False)]
    told = tuple(replace(d, coordinate=None, origins=o) for d, o in zip(found, origins, strict=False))
    return _as_one(expr, told)


def _as_one(expr: sp.Expr, told: tuple[TermDifference, ...]) -> tuple[TermDifference, ...]:
    """Two terms that are missing as one that is not what it should be, if they make a product of it: β̇² sin β should
    be (ψ̇ + β̇)² sin β."""
    if len(told) != MOST_TOLD or any(d.kind != "missing" for d in told):
        return told
    lacking: sp.Expr = told[0].term + told[1].term
    own = (t for t in sp.Add.make_args(bounded.expand(expr)) if bounded.letters(t) <= bounded.letters(lacking))
    for t in own:
        whole = bounded.factored(bounded.expand(t + lacking))
        if isinstance(whole, sp.Mul) and not any(x.is_Add for x in whole.args) and t.has(sp.Derivative):
            origins = tuple(dict.fromkeys((*told[0].origins, *told[1].origins)))
            return (replace(told[0], kind="coefficient", term=whole, written=t, origins=origins),)
    return told


def as_combinations(
    truth: Reference, findings: Sequence[Finding], left: Sequence[Finding], *, half: bool = False
) -> tuple[tuple[Finding, ...], list[MeantCombination]]:
    """The findings, with those ``left`` open that are meant so in place of them."""
    places = [k for k, f in enumerate(findings) if any(f is x for x in left)]
    found = meant_combinations(truth, findings, places, half=half)
    return tuple(found[k].finding if k in found else f for k, f in enumerate(findings)), list(found.values())


def with_sums_compared(truth: Reference, verdict: Verdict) -> Verdict:
    """The verdict with wrong equations of which no mistake speaks compared with the sum that they are: the balance of a
    cart with the force F between it and a slider is the equation of the cart less that of the slider."""
    verdict = as_balances_of_bodies(truth, verdict)
    told = {int(x["number"]) for m in verdict.mistakes for x in LINE.finditer(str(m.what))}
    rows = {m.coordinate for m in verdict.mistakes} - {None}
    left = [f for f in verdict.open_equations if f.line.number not in told and f.coordinate not in rows]
    if not verdict.mistakes or not left or verdict.motion:
        return verdict
    return replace(verdict, findings=as_combinations(truth, verdict.findings, left, half=True)[0])
