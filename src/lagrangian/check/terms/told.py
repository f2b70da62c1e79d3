"""How the terms of a sum, as they were written, differ from those of a right sum.

Both sums are multiplied out into pieces, and those that differ are paired, see `matched`. What is told are the written
terms and the terms of the right sum; pieces of them only where the rest of a term is right.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set
from functools import lru_cache
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.reference import Reference
from lagrangian.check.terms.matched import PieceMatch, TermItem, connected, is_partly_cancelled, matched, unequal
from lagrangian.check.terms.pieces import WrittenTerm, denominator, motion, pieces, written_terms
from lagrangian.model import time
from lagrangian.records import dataclass

LONGER = 1.3
"""How many times the operations of a product one may have that belongs in its place."""


@dataclass(frozen=True, eq=False)
class Pair:
    """What was ``written`` where ``right`` belongs, both in the scale of what was written; 0 for what is not there.

    ``unscaled`` is the right term in its own scale, or what was written if there is none.
    """

    written: sp.Expr
    right: sp.Expr
    unscaled: sp.Expr

    @property
    def kind(self) -> str:
        """missing, extra, sign or coefficient."""
        if self.written == 0:
            return "missing"
        return "extra" if self.right == 0 else "sign" if self.written == -self.right else "coefficient"


def pairs(truth: Reference, expr: sp.Expr, right: Sequence[sp.Expr], factor: sp.Expr) -> list[Pair] | None:
    """The differences between ``expr`` and ``factor`` times the sum of ``right``; None if they have no normal form."""
    theirs = _scaled_pieces(tuple(right), factor)
    found = _compared(truth, _own_pieces(expr), theirs, right, factor)
    if found is not None or (form := truth.form(expr)) is None:
        return found
    return _compared(truth, pieces([t.expr for t in form.terms()]), theirs, right, factor)


@lru_cache(maxsize=500)
def _own_pieces(expr: sp.Expr) -> list[WrittenTerm] | None:
    """The pieces of a sum, kept: it is compared with several groupings of the right terms."""
    return pieces(written_terms(expr))


@lru_cache(maxsize=500)
def _scaled_pieces(right: tuple[sp.Expr, ...], factor: sp.Expr) -> list[WrittenTerm] | None:
    """The pieces of right terms times a factor, kept: many lines are compared with the same."""
    return pieces([scaled_term(t, factor) for t in right])


def _compared(
    truth: Reference,
    own: list[WrittenTerm] | None,
    theirs: list[WrittenTerm] | None,
    right: Sequence[sp.Expr],
    factor: sp.Expr,
) -> list[Pair] | None:
    """The differences; None if what was written is too long or holds the same sine in several forms."""
    if own is None or theirs is None:
        return None
    below = denominator(p.expr for t in (*own, *theirs) for p in t.pieces)
    items: list[TermItem] = []
    for mine, group in ((True, own), (False, theirs)):
        for p in (p for t in group for p in t.pieces):
            form = truth.form(below * p.expr)
            if form is None or form.opaque():
                return None
            items.append(TermItem(p, form, mine))
    groups = connected(items)
    wrong = [m for group in groups for m in unequal(group)]
    if not wrong:
        return []
    if any(map(is_partly_cancelled, connected([x for x in wrong if x.mine]))):
        return None
    sums = _Sums(own, theirs, right, factor)
    found = sums.told(groups, wrong)
    return found if len(found) < 2 or (one := sums.one_term(wrong)) is None else [one]


def scaled_term(term: sp.Expr, factor: sp.Expr) -> sp.Expr:
    """A right term in the scale of what was written, a product again if that is one."""
    if abs(factor) == 1:
        return cast("sp.Expr", factor * term)
    product = cast("sp.Expr", factor * term)
    cleared = bounded.cancel(product) if sp.fraction(product)[1].has(sp.Add) or isinstance(term, sp.Add) else product
    return cast("sp.Expr", sp.factor_terms(cleared))


@dataclass(frozen=True, eq=False)
class _Sums:
    """Both sums with their pieces, in the scale of what was written; ``right`` are the unscaled right terms."""

    own: Sequence[WrittenTerm]
    theirs: Sequence[WrittenTerm]
    right: Sequence[sp.Expr]
    factor: sp.Expr

    def told(self, groups: Sequence[Sequence[TermItem]], wrong: Sequence[TermItem]) -> list[Pair]:
        """What is wrong as pairs, in the order of what was written, and then what is missing."""
        found: list[tuple[int, Pair]] = []
        for k, j in self._alone_with(groups):
            inside = [x for x in wrong if x.piece.of == (k if x.mine else j)]
            if len(self._listed(matched(inside))) > 1:
                found.append((k, self._by_whole(self.own[k].expr, [j])))
                wrong = [x for x in wrong if x not in inside]
        found += self._listed(matched(wrong))
        return self._joined([pair for _, pair in sorted(found, key=lambda x: x[0])])

    def _listed(self, matches: Sequence[PieceMatch]) -> list[tuple[int, Pair]]:
        """The matches as pairs in whole terms where they can be, with the places of the terms."""
        left = list(matches)
        found: list[tuple[int, Pair]] = []
        for k, term in enumerate(self.own):
            for pair, part in self._of_term(term, left):
                found.append((k, pair))
                left = [m for m in left if not any(m is x for x in part)]
        for j, right in enumerate(self.theirs):
            part = [m for m in left if not m.written and m.right[0].piece.of == j]
            if part and len(part) == len(right.pieces):
                found.append((len(self.own), Pair(sp.S.Zero, right.expr, self.right[j])))
                left = [m for m in left if not any(m is x for x in part)]
        found += [(min((x.piece.of for x in m.written), default=len(self.own)), self._of_pieces(m)) for m in left]
        return found

    def _joined(self, found: Sequence[Pair]) -> list[Pair]:
        """The pairs, with a term too much and the only missing one that has the same letters as one."""
        out = list(found)
        for extra in (x for x in found if x.right == 0):
            alike = [x for x in out if 0 in (x.written, x.right) and _letters_of(x) == _letters_of(extra)]
            missing = [x for x in alike if x.written == 0]
            if len(alike) == 2 and missing:
                out[out.index(extra)] = Pair(extra.written, missing[0].right, missing[0].unscaled)
                out.remove(missing[0])
        return out

    def _alone_with(self, groups: Sequence[Sequence[TermItem]]) -> list[tuple[int, int]]:
        """The places of written terms that have monomials in common with one right term, and of this one, alone."""
        touched: dict[tuple[bool, int], set[tuple[bool, int]]] = {}
        for group in groups:
            together = {(x.mine, x.piece.of) for x in group}
            for one in together:
                touched.setdefault(one, set()).update(together)
        pairs_of = ((k, j) for (mine, k), x in touched.items() if mine and len(x) == 2 for own, j in x if not own)
        return [(k, j) for k, j in pairs_of if len(touched[False, j]) == 2]

    def _of_term(self, term: WrittenTerm, left: Sequence[PieceMatch]) -> Iterator[tuple[Pair, list[PieceMatch]]]:
        """A term as a whole, if no piece of it is right, or its parts; a square as another square."""
        part = [m for m in left if m.written and all(any(x.piece is p for p in term.pieces) for x in m.written)]
        wrong = [x for m in part for x in m.written]
        rights = [x for m in part for x in m.right]
        if not part:
            return
        if len(wrong) == len(term.pieces) and (pair := self._as_a_whole(term.expr, part, rights)) is not None:
            yield pair, part
            return
        if not term.parts and (other := self._product_like(term, [*rights, *wrong])) is not None:
            yield self._pair(term.expr, other), part
        for inner in term.parts:
            yield from self._of_term(inner, part)

    def _as_a_whole(self, term: sp.Expr, part: Sequence[PieceMatch], rights: Sequence[TermItem]) -> Pair | None:
        """A term of which no piece is right: too much, a multiple of what belongs there, or in place of right terms."""
        if not rights:
            return self._pair(term, sp.S.Zero)
        if all(len(m.written) == len(m.right) == 1 for m in part):
            times = {cast("sp.Expr", m.right[0].piece.expr / m.written[0].piece.expr) for m in part}
            if len(times) == 1 and _is_simple(one := times.pop()):
                return self._pair(term, cast("sp.Expr", one * term))
        whole = self._whole(rights)
        return self._by_whole(term, whole) if whole is not None else None

    def _whole(self, rights: Sequence[TermItem]) -> list[int] | None:
        """The right terms of which these are all pieces; None if some of their pieces are not among them."""
        of = sorted({x.piece.of for x in rights})
        return of if of and of[0] >= 0 and len(rights) == sum(len(self.theirs[j].pieces) for j in of) else None

    def _of_pieces(self, match: PieceMatch) -> Pair:
        """A match by its pieces or, if these are all pieces of right terms, by those."""
        written = cast("sp.Expr", sp.Add(*[x.piece.expr for x in match.written]))
        whole = self._whole(match.right)
        if whole is not None:
            return self._by_whole(written, whole)
        return self._pair(written, cast("sp.Expr", sp.factor_terms(sp.Add(*[x.piece.expr for x in match.right]))))

    def _by_whole(self, written: sp.Expr, whole: Sequence[int]) -> Pair:
        """What was written where right terms belong; where these are a product of it, it is told as such."""
        right = cast("sp.Expr", sp.Add(*[self.theirs[j].expr for j in whole]))
        sums = written.has(sp.Add) + right.has(sp.Add)
        if written != 0 and sums != 1:
            times = cast("sp.Expr", right / written)
            times = bounded.cancel(times) if sums else times
            right = cast("sp.Expr", times * written) if _is_simple(times) else right
        return Pair(written, right, cast("sp.Expr", sp.Add(*[self.right[j] for j in whole])))

    def _pair(self, written: sp.Expr, right: sp.Expr) -> Pair:
        unscaled = (right if right != 0 else written) / self.factor
        return Pair(written, right, unscaled if abs(self.factor) == 1 else bounded.cancel(unscaled))

    def _product_like(self, term: WrittenTerm, lacking: Sequence[TermItem]) -> sp.Expr | None:
        """A product with a sum, with what it lacks, if that is a product as short as it is; None if not."""
        outside = [f for f in sp.Mul.make_args(term.expr) if not f.is_number and not f.has(sp.Add)]
        if not any(isinstance(f.as_base_exp()[0], sp.Add) for f in sp.Mul.make_args(term.expr)):
            return None
        if any(denominator([x.piece.expr / sp.Mul(*outside)]) != denominator([x.piece.expr]) for x in lacking):
            return None
        if not {motion(x.piece.expr) for x in lacking} <= {motion(p.expr) for p in term.pieces}:
            return None
        other = term.expr + sp.Add(*[-x.piece.expr if x.mine else x.piece.expr for x in lacking])
        found = bounded.factored(other)
        if found is None or isinstance(found, sp.Add):
            return None
        for whole in (t.expr for t in self.theirs):
            if whole.has(sp.Add) and bounded.expand(whole - found) == 0:
                return whole
        moving = sorted(found.atoms(AppliedUndef, sp.Derivative), key=sp.default_sort_key, reverse=True)
        sums = {x for t in self.right for x in t.atoms(sp.Add)}
        short = cast("sp.Expr", sp.Mul(*[_collected(f, moving, sums) for f in sp.Mul.make_args(found)]))
        return short if bounded.operations(short) <= LONGER * bounded.operations(term.expr) else None

    def one_term(self, wrong: Sequence[TermItem]) -> Pair | None:
        """The one product with a sum that would have to be another product for all to be right."""
        found = [(t.expr, x) for t in self.own if (x := self._product_like(t, wrong)) is not None]
        if not found:
            return None
        return self._pair(*min(found, key=lambda x: bounded.operations(x[1]) - bounded.operations(x[0])))


def _letters_of(pair: Pair) -> set[Any]:
    return (pair.written + pair.right).free_symbols - {time}


def _is_simple(factor: sp.Expr) -> bool:
    """Whether a factor is a product of letters and numbers."""
    return all(f.as_base_exp()[0].is_Atom for f in sp.Mul.make_args(factor))


def _collected(factor: sp.Expr, moving: Sequence[sp.Expr], sums: Set[sp.Basic]) -> sp.Expr:
    """A power of a sum with what belongs to the same rate put together, in known sums: R ψ̇ − (R − r) φ̇."""
    base, exponent = factor.as_base_exp()
    if not isinstance(base, sp.Add):
        return factor
    found = sp.collect(base, moving)
    negative = [x for x in found.atoms(sp.Add) if x not in sums and -x in sums]
    table = {x: sp.Mul(-1, -x, evaluate=False) for x in negative}
    return cast("sp.Expr", found.xreplace(table) ** exponent)
