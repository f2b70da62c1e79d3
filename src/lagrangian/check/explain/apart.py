"""In which term two sums differ: two formulas in different arrangements do not show that m e φ̇ ṡ is missing."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.changes.ring import Monomial, SumRing, TooLong, minus
from lagrangian.check.explain.misconceptions import Ingredients
from lagrangian.check.explain.own_terms import term_replaced
from lagrangian.model import time
from lagrangian.page.formula import Left

MOST_LACKING = 2
"""The most terms that are added to what is written, to say what is right."""
MOST = 4
"""The most pieces that are told as one term."""


def told_apart(s: Ingredients, right: sp.Expr, written: sp.Expr) -> tuple[str | Left, ...]:
    """The one term of a sum that is missing, too much or another one, as the end of a sentence; nothing where all
    terms differ, or in several ways."""
    ring: SumRing = s.kept("ring", lambda: SumRing(s.model))
    try:
        own, theirs = ring.of(bounded.expand(written)), ring.of(bounded.expand(right))
        folded = ring.fold(minus(theirs, own))
    except TooLong:
        return ()
    pieces = {m: (own.get(m, Fraction(0)), own.get(m, Fraction(0)) + c) for m, c in folded.items() if c}
    shared = [m for m in own if m not in pieces]
    if not pieces or not shared or len(pieces) > MOST:
        return ()
    pair = _pair(ring, pieces)
    if pair is None:
        return ()
    if 0 not in pair and any(sp.fraction(x)[1].free_symbols for x in pair):
        return (": the term ", pair[0], " should be ", pair[1], ".")
    if pair[1] != 0 and (number := bounded.cancel(pair[0] / pair[1])).is_number and number not in (0, -1):
        return (": the term ", pair[0], " should be ", cast("sp.Expr", pair[0] / number), ".")
    first, *more = term_replaced(*pair)[1].parts
    return (": " + str(first)[:1].lower() + str(first)[1:], *cast("list[str | Left]", more))


def _pair(ring: SumRing, pieces: dict[Monomial, tuple[Fraction, Fraction]]) -> tuple[sp.Expr, sp.Expr] | None:
    """What is written and what belongs there, where this is one term: all missing, all too much, all times a number, or
    one in place of another."""
    ratios = {w / r if r else None for w, r in pieces.values()}
    of_one = len(pieces) == 2 and sorted((w == 0, r == 0) for w, r in pieces.values()) == [(False, True), (True, False)]
    if len(ratios) > 1 and not of_one:
        return None
    W, R = (ring.expr({m: x[k] for m, x in pieces.items() if x[k]}) for k in (0, 1))
    return cast("sp.Expr", sp.factor_terms(W)), cast("sp.Expr", sp.factor_terms(R))


def rescales(apart: Sequence[str | Left]) -> bool:
    """Whether a term is told to be another one or too much: what is written and one more term would not show it."""
    return bool(apart) and not str(apart[-1]).startswith(" is missing")


def beside(s: Ingredients, right: sp.Expr, written: sp.Expr) -> sp.Expr:
    """What is right, as what is written and the few terms that this lacks, if these are few: (h θ̇ + ṡ)² + s² θ̇²."""
    ring: SumRing = s.kept("ring", lambda: SumRing(s.model))
    try:
        own = ring.of(bounded.expand(written))
        lacking = ring.fold(minus(ring.of(bounded.expand(right)), own))
    except TooLong:
        return right
    if any(own.get(m) == -c for m, c in lacking.items()):
        return right  # what is too much is not shown as taken away again
    found = cast("sp.Expr", written + ring.expr(lacking))
    plain = all(not isinstance(f, sp.Pow) or not f.base.is_Add for x in sp.Add.make_args(written) for f in x.args)
    closer = plain or len(lacking) == 1 or bounded.operations(found) < bounded.operations(right)
    return found if len(lacking) <= MOST_LACKING and closer else right


def folded(s: Ingredients, expr: sp.Expr) -> sp.Expr:
    """An energy without cos² + sin², if that is shorter."""
    ring: SumRing = s.kept("ring", lambda: SumRing(s.model))
    try:
        found = ring.expr(ring.fold(ring.of(bounded.expand(expr))))
    except TooLong:
        return expr
    return found if bounded.operations(found) <= bounded.operations(expr) else expr


def moving_part(s: Ingredients, right: sp.Expr, written: sp.Expr) -> sp.Expr:
    """An energy or a square without squares of what time alone gives, which change no equation, (e Ω sin Ωt)² beside
    (ẏ + e Ω cos Ωt)²; as it is if what is written has them, or if it has none."""
    moving = [*s.q, *s.v]
    idle = [x for x in sp.Add.make_args(bounded.expand(right)) if x.has(time) and not x.has(*moving)]
    if not idle or any(x.has(time) and not x.has(*moving) for x in _bare(written)):
        return right
    factors = list(sp.Mul.make_args(right))
    sums = [k for k, f in enumerate(factors) if isinstance(f, sp.Add)]
    if len(sums) != 1:
        return right
    factors[sums[0]] = sp.Add(*[x for x in sp.Add.make_args(factors[sums[0]]) if x.has(*moving) or not x.has(time)])
    return cast("sp.Expr", sp.Mul(*factors))


def _bare(written: sp.Expr) -> tuple[sp.Expr, ...]:
    """The terms of a sum, and of one in a product, as they are written."""
    parts = [x for f in sp.Mul.make_args(written) for x in sp.Add.make_args(f) if isinstance(f, sp.Add)]
    return tuple(parts) if parts else sp.Add.make_args(written)
