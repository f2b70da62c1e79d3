"""Which pieces of two sums differ, and which of them belong together.

Pieces that share a monomial in normal form belong together: sin² θ and ½ − ½ cos 2θ are equal there. Where what belongs
together is not equal, equal pieces are taken out, and each of the others is paired with the right one that it should
be.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.check.terms.pieces import Summand, motion, rates
from lagrangian.derive.algebra import Form
from lagrangian.derive.algebra.form import Key
from lagrangian.model import time
from lagrangian.records import dataclass, field

Monomial = tuple[Any, int]

NOWHERE = -1
"""The place of a right piece that is a part of several."""


@dataclass(frozen=True, eq=False)
class TermItem:
    """A piece with its normal form, in which the denominators of both sums are cleared."""

    piece: Summand
    form: Form
    mine: bool

    @property
    def monomials(self) -> frozenset[Monomial]:
        """The monomials of its normal form, with their harmonics."""
        return frozenset((h, m) for h, p in self.form.parts.items() for m in p)


@dataclass(frozen=True, eq=False)
class PieceMatch:
    """Pieces that were written, and the right ones that belong in their place."""

    written: list[TermItem] = field(default_factory=list)
    right: list[TermItem] = field(default_factory=list)


def connected(items: Sequence[TermItem]) -> list[list[TermItem]]:
    """The items in groups that have no monomial in common."""
    home: dict[Monomial, int] = {}
    parent = list(range(len(items)))

    def root(k: int) -> int:
        while parent[k] != k:
            parent[k] = k = parent[parent[k]]
        return k

    for k, item in enumerate(items):
        for m in item.monomials:
            parent[root(k)] = root(home.setdefault(m, k))
    groups: dict[int, list[TermItem]] = {}
    for k, item in enumerate(items):
        groups.setdefault(root(k), []).append(item)
    return [*groups.values()]


def unequal(group: Sequence[TermItem]) -> list[TermItem]:
    """What is left of items that belong together when all that is equal is taken out; nothing if their sums are."""
    if _sum(group) is None:
        return []
    left = list(group)
    for one in group:
        if not any(x is one for x in left):
            continue
        signed = [(x, x.form if x.mine is one.mine else -x.form) for x in left if x is not one]
        same = next((x for x, form in signed if (form + one.form).is_zero), None)
        if same is not None:
            left = [x for x in left if x is not one and x is not same]
    if len(left) < len(group):
        return [x for part in connected(left) for x in unequal(part)]
    return left


def _sum(items: Sequence[TermItem]) -> Form | None:
    """What was written less what is right, None for zero."""
    if not items:
        return None
    total = items[0].form.algebra.total([x.form if x.mine else -x.form for x in items])
    return None if total.is_zero else total


def is_partly_cancelled(own: Sequence[TermItem]) -> bool:
    """Whether a part of pieces vanishes in their sum, as of a sin² θ + b cos² θ."""
    total = own[0].form.algebra.total([x.form for x in own])
    left = {(h, m) for h, p in total.parts.items() for m in p}
    return any(not x.monomials <= left for x in own)


def number_between(form: Form, other: Form) -> sp.Rational | None:
    """The number by which one form is a multiple of another; None if it is none."""
    mine, theirs = (
        {(h, m): sp.Rational(int(c), f.den) for h, p in f.parts.items() for m, c in p.items()} for f in (form, other)
    )
    if not theirs or mine.keys() != theirs.keys():
        return None
    (first, *more) = {mine[k] / theirs[k] for k in mine}
    return None if more else cast("sp.Rational", first)


def matched(wrong: Sequence[TermItem]) -> list[PieceMatch]:
    """Every wrong piece with the right one that it should be: a multiple, one with the same motion, with a sine in
    place of a cosine, or with the same letters."""
    own, right = [x for x in wrong if x.mine], [x for x in wrong if not x.mine]
    found: list[PieceMatch] = []
    for alike in _multiples(own):
        theirs = [x for x in right if number_between(x.form, alike[0].form) is not None]
        if len(alike) > 1 and theirs:
            found.append(_odd_one(alike, theirs))
            own, right = [x for x in own if x not in alike], [x for x in right if x not in theirs]
    for s in list(own):
        multiples = ((number_between(s.form, r.form), r) for r in right)
        times = [(abs(n) != 1, r) for n, r in multiples if n is not None]
        if times:
            r = min(times, key=lambda x: x[0])[1]
            own.remove(s)
            right.remove(r)
            found.append(PieceMatch([s], [r]))
    ways: tuple[tuple[Callable[[TermItem], Any], bool], ...] = (
        (_moving, False),
        (lambda x: _without_functions(motion(x.piece.expr)), True),
        (lambda x: (_acts(x), rates(x.piece.expr)), True),
        (lambda x: (_acts(x), _letters(x.piece.expr)), True),
        (lambda x: (_acts(x), None), True),
    )
    for key, alone in ways:
        for k in dict.fromkeys(key(x) for x in own):
            s, r = [x for x in own if key(x) == k], [x for x in right if key(x) == k]
            if not r or (key is ways[-1][0] and not _alike(s[0], r[0])):
                continue
            if len(s) + len(r) > 2 and (each := _one_by_one(s, r)) is not None:
                found += each
            elif len(s) + len(r) > 2 and alone:
                continue
            else:
                found.append(PieceMatch(s, r))
            own, right = [x for x in own if x not in s], [x for x in right if x not in r]
    return [*found, *(PieceMatch([x], []) for x in own), *(PieceMatch([], [x]) for x in right)]


def _multiples(items: Sequence[TermItem]) -> list[list[TermItem]]:
    """The items in groups of numbers times the same."""
    groups: list[list[TermItem]] = []
    for x in items:
        home = next((g for g in groups if number_between(x.form, g[0].form) is not None), None)
        if home is None:
            groups.append([x])
        else:
            home.append(x)
    return groups


def _odd_one(own: Sequence[TermItem], right: Sequence[TermItem]) -> PieceMatch:
    """Of several multiples of the same that should add up to ``right``, the one with the simplest number too much or
    too little: of 1/8 + 1/48 in place of 1/6 it is 1/48, which should be 1/24."""
    base = own[0].form  # M sin 2α and M sin α cos α are multiples as forms, not as they are written
    theirs, mine = ([cast("sp.Rational", number_between(x.form, base)) for x in items] for items in (right, own))
    total = sp.Add(*theirs) - sp.Add(*mine)
    numbers = [cast("sp.Rational", total / n + 1) for n in mine]
    k = min(range(len(own)), key=lambda j: abs(numbers[j].p) + numbers[j].q)
    one = own[k]
    if numbers[k] == 0:
        return PieceMatch([one], [])
    piece = Summand(NOWHERE, cast("sp.Expr", numbers[k] * one.piece.expr))
    return PieceMatch([one], [TermItem(piece, one.form.scaled(Fraction(int(numbers[k].p), int(numbers[k].q))), False)])


def _one_by_one(own: Sequence[TermItem], right: Sequence[TermItem]) -> list[PieceMatch] | None:
    """Pieces with right ones that are all the same multiple of them; None if they are not."""
    if len(own) != len(right):
        return None
    for first in right:
        times = first.piece.expr / own[0].piece.expr
        of = {x.piece.expr: x for x in right}
        found = [(x, of.get(times * x.piece.expr)) for x in own]
        if None not in (r for _, r in found):
            return [PieceMatch([x], [r]) for x, r in found if r is not None]
    return None


def _moving(item: TermItem) -> frozenset[Key]:
    return item.form.keys()


def _without_functions(expr: sp.Expr) -> sp.Expr:
    """A product with cosines in place of all sines."""
    return cast("sp.Expr", expr.replace(sp.sin, sp.cos))


def _letters(expr: sp.Expr) -> sp.Expr:
    """The letters of a piece, without numbers and without what moves."""
    return cast("sp.Expr", (expr / motion(expr)).as_coeff_Mul()[1])


def _acts(item: TermItem) -> bool:
    """Whether an input, τ of τ/l, is a factor of a piece: no term of the motion belongs in its place."""
    known = item.form.algebra.generators
    functions = [f for f in sp.Mul.make_args(item.piece.expr) if isinstance(f, AppliedUndef)]
    return any(getattr(known.table[known.index(f)], "role", None) == "input" for f in functions)


def _alike(one: TermItem, other: TermItem) -> bool:
    """Whether two pieces have a letter in common."""
    return bool((one.piece.expr.free_symbols & other.piece.expr.free_symbols) - {time})
