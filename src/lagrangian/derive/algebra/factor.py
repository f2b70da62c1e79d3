"""Finds short sums of products, the factored shape of a polynomial, by trial.

A `Tree` is a product coefficient · monomial · ∏ (sum)^power. Its cost is what ``sympy.count_ops`` would count. The
candidates are the plain sum, SymPy's factorization, and the results of factoring each symbol out of the terms that
contain it.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false, reportUnknownArgumentType=false

from __future__ import annotations

from collections.abc import Callable, Iterable
from fractions import Fraction
from functools import lru_cache
from math import gcd, lcm
from typing import Any, cast

import sympy as sp

from lagrangian.derive.algebra.monomials import common_divisor, digits, packed
from lagrangian.records import dataclass

Flat = dict[int, Fraction]
"""A polynomial over display letters: packed monomial → rational coefficient."""

FACTOR_TERMS = 16
"""SymPy's factorization is not used for sums with more terms …"""
FACTOR_LETTERS = 8
"""… or with more symbols."""
SEARCH = 40_000
"""The number of terms that one search may examine before the remaining sums stay as they are."""
FACTOR_DEGREES = 14
"""… or if the degrees in the symbols add up to more."""
WIDE = 4
WIDE_TERMS = 9
"""Up to this many terms, factoring out each of `WIDE` symbols is tried; above, only the most frequent one."""


@dataclass(frozen=True, slots=True)
class Tree:
    """coefficient · monomial · ∏ sums_i^power_i; a sum is an ordered tuple of trees. ``cost`` is in operations."""

    coefficient: Fraction
    monomial: int
    sums: tuple[tuple[tuple[Tree, ...], int], ...]
    cost: int


class Shortener:
    """Finds short trees; ``cost_of`` is the number of operations inside a symbol (0 for x, 1 for sin θ)."""

    def __init__(self, cost_of: Callable[[int], int], affords: Callable[[int], bool] = lambda _: True) -> None:
        self.cost_of, self.affords = cost_of, affords
        self.budget = SEARCH
        self._memo: dict[frozenset[tuple[int, Fraction]], Tree] = {}
        self._factors: dict[object, list[tuple[Flat, int]] | None] = {}

    # -- making -----------------------------------------------------------------------------------------------------

    def product(self, coefficient: Fraction, monomial: int, sums: Iterable[tuple[tuple[Tree, ...], int]] = ()) -> Tree:
        """Return a product with its cost."""
        sums = tuple(sums)
        cost = factors = 0
        for i, e in digits(monomial):
            cost += self.cost_of(i) + (e not in (1, -1))
            factors += 1
        for terms, power in sums:
            cost += sum(t.cost for t in terms) + len(terms) - 1 + (power != 1)
            factors += 1
        factors += (abs(coefficient.numerator) != 1 or factors == 0) + (coefficient.denominator != 1)
        return Tree(coefficient, monomial, sums, cost + factors - 1)

    def times(self, tree: Tree, coefficient: Fraction, monomial: int) -> Tree:
        """Return a multiple of a tree, with the same sums."""
        return self.product(tree.coefficient * coefficient, tree.monomial + monomial, tree.sums)

    def summed(self, trees: Iterable[Tree]) -> Tree:
        """Return a sum of trees as one tree; a single tree is returned unchanged."""
        flat: list[Tree] = []
        for t in trees:
            bare = t.coefficient == 1 and t.monomial == 0 and len(t.sums) == 1 and t.sums[0][1] == 1
            flat += t.sums[0][0] if bare else (t,)
        if len(flat) == 1:
            return flat[0]
        return self.product(Fraction(1), 0, [(tuple(flat), 1)])

    # -- searching --------------------------------------------------------------------------------------------------

    def short(self, poly: Flat) -> Tree:
        """Return the shortest tree that is found for a polynomial other than zero.

        Denominators of only some terms stay with these terms, J/R² + m, unless (J + m R²)/R² is shorter.
        """
        best = self._outside(poly, whole=False)
        denominators = {c.denominator for c in poly.values()}
        if 1 < len(denominators) <= len(poly) <= FACTOR_TERMS:
            scale = lcm(*denominators)
            tree = self._outside({m: c * scale for m, c in poly.items()}, whole=False)
            tree = self.times(tree, Fraction(1, scale), 0)
            bare = poly.get(common_divisor(poly), Fraction(1)).denominator > 1  # ½ (1 + 4 c² x²), not ½ + 2 c² x²
            if tree.cost < best.cost + bare:
                best = tree
        if len(poly) > 1 and any(e < 0 for m in poly for _, e in digits(m)):
            over_all = self._outside(poly, whole=True)
            if (over_all.cost, -len(over_all.sums)) < (best.cost, -len(best.sums)):
                return over_all
        return best

    def _outside(self, poly: Flat, *, whole: bool) -> Tree:
        """Return the common factor of all terms times the rest in short form."""
        coefficient, monomial, rest = primitive(poly, whole=whole)
        if len(rest) == 1:
            return self.product(coefficient, monomial)
        return self.times(self._short(rest), coefficient, monomial)

    def _short(self, poly: Flat) -> Tree:
        key = frozenset(poly.items())
        if (known := self._memo.get(key)) is not None:
            return known
        best = self.summed(self.product(c, m) for m, c in ordered(poly))
        self.budget -= 1 + len(poly)
        if self.budget < 0 or not self.affords(1 + len(poly)):
            return best
        if len(poly) > 2 or any(abs(e) > 1 for m in poly for _, e in digits(m)):
            for candidate in self._candidates(poly):
                if candidate.cost < best.cost:
                    best = candidate
        self._memo[key] = best
        return best

    def factored(self, poly: Flat) -> Tree | None:
        """Return the product of the irreducible factors; None if there is only one besides the common factor."""
        coefficient, monomial, rest = primitive(poly, whole=False)
        factors = self._factorized(rest)
        if factors is None:
            return None
        sums: list[tuple[tuple[Tree, ...], int]] = []
        for factor, power in factors:
            tree = self.short(factor)
            coefficient *= tree.coefficient**power
            monomial += tree.monomial * power
            sums += [(terms, k * power) for terms, k in tree.sums]
        return self.product(coefficient, monomial, sums)

    def _candidates(self, poly: Flat) -> Iterable[Tree]:
        apart = components(poly)
        if len(apart) > 1:
            yield self.summed(self.short(p) for p in apart)
            return
        product = self.factored(poly)
        if product is not None:
            yield product
        counts: dict[int, int] = {}
        for m in poly:
            for i, e in digits(m):
                letter = i if e > 0 else ~i
                counts[letter] = counts.get(letter, 0) + 1
        wanted = sorted((letter for letter, n in counts.items() if n > 1), key=lambda i: (-counts[i], i))
        for letter in wanted[: WIDE if len(poly) <= WIDE_TERMS else 1]:
            yield self.split(poly, letter)
        for groups in partitions(poly):
            yield self.summed(self.short(g) for g in groups)

    def split(self, poly: Flat, letter: int) -> Tree:
        """Return symbol·(…) + the rest; ``~i`` selects the terms that are divided by symbol i."""
        i, sign = (letter, 1) if letter >= 0 else (~letter, -1)
        inside: Flat = {}
        outside: Flat = {}
        for m, c in poly.items():
            (inside if any(j == i and e * sign > 0 for j, e in digits(m)) else outside)[m] = c
        parts = [(self.short(p), lead(p)) for p in (inside, outside) if p]
        return self.summed(t for t, _ in sorted(parts, key=lambda x: x[1]))

    def _factorized(self, poly: Flat) -> list[tuple[Flat, int]] | None:
        """SymPy's factors with their powers, None if there is nothing to gain."""
        letters = sorted({i for m in poly for i, _ in digits(m)})
        if len(poly) > FACTOR_TERMS or len(letters) > FACTOR_LETTERS:
            return None
        below = {i for m in poly for i, e in digits(m) if e < 0}
        if any(i in below and e > 0 for m in poly for i, e in digits(m)):
            return None
        scale = lcm(*(c.denominator for c in poly.values()))
        shape = {tuple(abs(dict(digits(m)).get(i, 0)) for i in letters): int(c * scale) for m, c in poly.items()}
        key = frozenset(shape.items())
        if sum(max(m[i] for m in shape) for i in range(len(letters))) > FACTOR_DEGREES:
            return None
        if key not in self._factors:
            self.budget -= 200
            self._factors[key] = _factors(key, len(letters))
        found = self._factors[key]
        if found is None:
            return None
        named = [
            (
                {
                    int(packed((letters[k], -e if letters[k] in below else e) for k, e in digits(m))): c
                    for m, c in f.items()
                },
                p,
            )
            for f, p in found
        ]
        sign = Fraction(1, scale)
        return [({0: sign}, 1), *named] if sign != 1 else named


@lru_cache(maxsize=4096)
def _factors(terms: frozenset[tuple[tuple[int, ...], int]], letters: int) -> list[tuple[Flat, int]] | None:
    """The irreducible factors over the integers, with symbols numbered 0, 1, …; None if there is only one."""
    shape = dict(terms)
    ring = sp.polys.rings.PolyRing([f"x{k}" for k in range(letters)], sp.ZZ)
    linear = [k for k in range(letters) if max(m[k] for m in shape) == 1]
    if linear:  # A·x + B: a factor without x divides A and B, and the one with x is then the rest
        k = min(linear, key=lambda k: sum(m[k] for m in shape))
        A = {(*m[:k], 0, *m[k + 1 :]): c for m, c in shape.items() if m[k]}
        B = {m: c for m, c in shape.items() if not m[k]}
        if ring.from_dict(A).gcd(ring.from_dict(B)) == 1:
            return None
    content, found = cast(
        "tuple[Any, list[tuple[dict[tuple[int, ...], Any], int]]]", ring.from_dict(shape).factor_list()
    )
    if len(found) == 1 and found[0][1] == 1:
        return None
    listed = [({int(packed(enumerate(m))): Fraction(int(c)) for m, c in f.items()}, int(power)) for f, power in found]
    return [({0: Fraction(int(content))}, 1), *listed] if content != 1 else listed


def components(poly: Flat) -> list[Flat]:
    """Return the parts without common symbols, such as (x₁ − x₂)² and (y₁ − y₂)²; no factor contains symbols of two."""
    parts: list[tuple[set[int], Flat]] = []
    for m, c in poly.items():
        letters, terms = {i for i, _ in digits(m)}, {m: c}
        apart: list[tuple[set[int], Flat]] = []
        for other, others in parts:
            if letters & other:
                letters, terms = letters | other, {**others, **terms}
            else:
                apart.append((other, others))
        parts = [*apart, (letters, terms)]
    return sorted((terms for _, terms in parts), key=lead)


def partitions(poly: Flat) -> list[list[Flat]]:
    """Return groupings of the terms by symbols of which every term contains exactly one, such as L1², L2², L3².

    Such a family of symbols is built from each symbol of the first term; groups are in the order of their first terms.
    """
    holders: dict[tuple[int, int], set[int]] = {}
    for m in poly:
        for pair in digits(m):
            holders.setdefault(pair, set()).add(m)
    found: dict[frozenset[tuple[int, int]], list[Flat]] = {}
    first = min(poly, key=order)
    for start in digits(first):
        family, covered = [start], set(holders[start])
        for pair, terms in sorted(holders.items(), key=lambda x: (-len(x[1]), x[0])):
            if pair[1] == start[1] and not terms & covered:
                family.append(pair)
                covered |= terms
        if 1 < len(family) < len(poly) and len(covered) == len(poly):
            groups = [{m: c for m, c in poly.items() if m in holders[pair]} for pair in family]
            found[frozenset(family)] = sorted(groups, key=lead)
    return list(found.values())


def primitive(poly: Flat, *, whole: bool = True) -> tuple[Fraction, int, Flat]:
    """Return coefficient, monomial and the rest, which has no common factor and mostly plus signs.

    Common denominators of numbers are always taken out, those of symbols only with ``whole``.
    """
    monomial = common_divisor(poly)
    if not whole:
        shared = {i: all(dict(digits(m)).get(i, 0) < 0 for m in poly) for i, e in digits(monomial) if e < 0}
        monomial = int(packed((i, e) for i, e in digits(monomial) if shared.get(i, True)))
    numerator = 0
    for c in poly.values():
        numerator = gcd(numerator, c.numerator)
    denominators = {c.denominator for c in poly.values()}
    coefficient = Fraction(numerator, gcd(*denominators))
    negative = 2 * sum(c < 0 for c in poly.values())
    if negative > len(poly) or (negative == len(poly) and poly[min(poly, key=order)] < 0):
        coefficient = -coefficient
    return coefficient, monomial, {m - monomial: c / coefficient for m, c in poly.items()}


def order(monomial: int) -> tuple[tuple[int, int], ...]:
    """The key that sorts monomials by their first symbol, higher powers first."""
    return tuple((i, -e) for i, e in digits(monomial)) or ((1 << 30, 0),)


def lead(poly: Flat) -> tuple[tuple[int, int], ...]:
    """The key of the first monomial of a polynomial."""
    return min(order(m) for m in poly)


def ordered(poly: Flat) -> list[tuple[int, Fraction]]:
    """The terms in the order of their monomials."""
    return sorted(poly.items(), key=lambda x: order(x[0]))
