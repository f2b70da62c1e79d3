"""Groups the terms of one class in the best possible way.

Inertia is written with a term for each acceleration, (…) ẍ₁ + (…) ẍ₂, or with a term for each harmonic and sum of
accelerations, … (2θ̈₁ + θ̈₂) cos θ₂; products of rates are treated in the same way. The best grouping is short, not
nested too deeply for a reader, and does not scatter an acceleration over many places.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable
from fractions import Fraction
from typing import TYPE_CHECKING

from lagrangian.derive.algebra.factor import Flat, Shortener, Tree, lead, order, ordered, primitive
from lagrangian.derive.algebra.monomials import digits, packed
from lagrangian.derive.algebra.variables import Sum, Symbolic, Trig
from lagrangian.page.formula import TermKind

if TYPE_CHECKING:
    from lagrangian.derive.algebra.generators import Generators

DEEP = 2
"""The depth of nested parentheses that is still easy to read."""
NESTED = 4
"""The penalty, in operations, for a deeper parenthesis."""
SHALLOW = 4
"""The penalty, in operations, for nesting in terms with rates, which read best with one harmonic per term."""
SCATTERED = 2
"""The penalty, in operations, for each place of an acceleration."""
REPEATED = 2
"""In momenta, the penalty, in operations, for each further term with the same rate outside a sum."""
MIN_HARMONIC_TERMS = 12
"""With more terms, grouping inertia by harmonics is tried, too."""
VERY_LONG = 150
"""With more terms, only the groupings that need no search are tried."""

Way = list[Tree]
"""One term a tree."""


def role_of(generators: Generators, letter: int) -> str:
    """Return "trig", "function", or the role of the symbol; a function of parameters counts as a parameter."""
    entry = generators.table[letter]
    if isinstance(entry, Symbolic):
        return entry.role
    if not entry.moving:
        return "parameter"
    return "trig" if isinstance(entry, Trig) else "function"


def letters(tree: Tree) -> set[int]:
    """Return all symbols that occur in a tree."""
    found = {i for i, _ in digits(tree.monomial)}
    for terms, _ in tree.sums:
        for t in terms:
            found |= letters(t)
    return found


class Grouper:
    """Groups the terms of a class; ``shortener`` makes each group short."""

    def __init__(self, generators: Generators, shortener: Shortener) -> None:
        self.generators, self.shortener = generators, shortener

    def grouped(self, kind: TermKind, poly: Flat, long: bool) -> Way:
        """Return the terms of one class in the best possible grouping; of equally good ones, the first."""
        if len(poly) == 1:
            return [self.shortener.short(poly)]
        if not self.generators.affords(len(poly) // 10):  # three groupings, each with its parts made short
            return [self.shortener.product(c, m) for m, c in ordered(poly)]
        if kind == "inertia":
            return self._leading(self._best(self._carried(poly, "acceleration", long), kind))
        ways = {
            "velocity": self._velocity,
            "damping": self._damping,
            "input": self._inputs,
            "stiffness": self._springs,
        }
        return [self._facing(tree) for tree in self._best(ways.get(kind, self._gravity)(poly, long), kind)]

    # -- what is tried ----------------------------------------------------------------------------------------------

    def _carried(self, poly: Flat, role: str, long: bool) -> Iterable[Way]:
        """Terms that are linear in accelerations, or in rates: grouped by each, or by sums shared by several masses."""
        yield self._sorted(self._entries(poly, role), role)
        if not long:
            return
        harmonics: dict[int, Flat] = {}
        for m, c in poly.items():
            harmonics.setdefault(self._only("trig")(m), {})[m] = c
        shared = [self._shared(g, role) for g in harmonics.values()]
        alone = [self._entries(g, role) if not h else s for (h, g), s in zip(harmonics.items(), shared, strict=True)]
        for ways in (alone, shared, [self._shared(poly, role)]):
            yield self._sorted([tree for way in ways for tree in way], role)

    def _velocity(self, poly: Flat, long: bool) -> Iterable[Way]:
        yield self._by(poly, self._only("trig"))
        if len(poly) > VERY_LONG:
            return
        yield self._by(poly, self._only("rate"))
        yield self._by(poly, self._but("trig", "rate"), merge=True)
        if long:
            yield self._shared(poly, "rate")

    def _damping(self, poly: Flat, long: bool) -> Iterable[Way]:
        if any(self.role(i) in ("trig", "coordinate", "function") for m in poly for i, _ in digits(m)):
            yield from self._carried(poly, "rate", long)
            yield self._by(poly, self._only("trig"))
        else:
            yield from self._springs(poly, long)

    def _springs(self, poly: Flat, _: bool) -> Iterable[Way]:
        """k (x₁ − x₂), grouped by spring or by coordinate, with low powers first: k x + k₃ x³."""
        for way in (
            self._by(poly, self._but("coordinate", "rate", "input", "function"), merge=True),
            self._whole(poly),
            self._by(poly, self._only("coordinate", "rate")),
        ):
            yield sorted(way, key=self._degree)

    def _inputs(self, poly: Flat, _: bool) -> Iterable[Way]:
        yield self._by(poly, self._only("input"))
        yield self._by(poly, self._only("trig", "coordinate", "rate", "function"))

    def _gravity(self, poly: Flat, _: bool) -> Iterable[Way]:
        yield self._by(poly, self._only("trig", "coordinate"))
        if any(self._driven(i) for m in poly for i, _ in digits(m)):
            yield self._by(
                poly, lambda m: int(packed((i, e) for i, e in digits(m) if self._turns(i) and not self._driven(i)))
            )
        if any(self.role(i) == "function" for m in poly for i, _ in digits(m)):
            yield self._whole(poly, spread=True)
        if len(poly) == 2 and any(not self.generators.moving(m) for m in poly):
            yield [self.shortener.short(poly)]  # m g L (1 − cos θ)

    # -- judging ----------------------------------------------------------------------------------------------------

    def _best(self, ways: Iterable[Way], kind: TermKind) -> Way:
        """The grouping of lowest cost: operations, plus penalties for nesting and scattering."""

        def cost(way: Way) -> int:
            total = sum(1 + self._cost(t, kind) for t in way)
            if kind == "inertia":
                total += SCATTERED * sum(self.role(i) == "acceleration" for t in way for i in letters(t))
            if kind == "damping":
                bare = [i for t in way for i, _ in digits(t.monomial) if self.role(i) == "rate"]
                total += REPEATED * (len(bare) - len(set(bare)))
            return total

        return min(ways, key=cost)

    def _cost(self, tree: Tree, kind: TermKind) -> int:
        deep = self._depth(tree)
        shallow = SHALLOW * max(0, deep - 1) if kind in ("velocity", "damping") else 0
        return tree.cost + NESTED * max(0, deep - DEEP) + shallow

    def _depth(self, tree: Tree) -> int:
        """The depth of nested parentheses; a sum of parameters that is a symbol counts as one."""
        own = any(isinstance(self.generators.table[i], Sum) for i, _ in digits(tree.monomial))
        return max((1 + max(self._depth(t) for t in terms) for terms, _ in tree.sums), default=int(own))

    def _sorted(self, way: Way, role: str) -> Way:
        """In the order of the accelerations; sums of these without a harmonic come first."""

        def key(tree: Tree) -> tuple[object, ...]:
            own = sorted(i for i in letters(tree) if self.role(i) == role)
            return (sum(self.role(i) == "trig" for i, _ in digits(tree.monomial)) * spread, own)

        holders = [i for t in way for i in letters(t) if self.role(i) == role]
        spread = len(holders) > len(set(holders))
        return sorted(way, key=key)

    def _leading(self, way: Way) -> Way:
        """Avoid a minus at the beginning of a sum if another of its terms can come first."""
        if way[0].coefficient > 0:
            return way
        first = next((i for i, t in enumerate(way) if t.coefficient > 0), 0)
        return [way[first], *way[:first], *way[first + 1 :]]

    def _facing(self, tree: Tree) -> Tree:
        """The sum 1 − L₀/l, not L₀/l − 1, and g − a ω² cos ωt, with the sign in front of it."""
        for k, (terms, power) in enumerate(tree.sums):
            bare = [t for t in terms if not t.sums and not t.monomial]
            driven = all(self._driven(i) for t in terms for i in letters(t) if self.generators.is_moving(i))
            steady = [t for t in terms if not any(self.generators.is_moving(i) for i in letters(t))]
            if power % 2 and len(terms) == 2 and [t.coefficient < 0 for t in (steady if driven else bare)] == [True]:
                turned = tuple(self.shortener.times(t, Fraction(-1), 0) for t in terms)
                sums = (*tree.sums[:k], (turned, power), *tree.sums[k + 1 :])
                return self.shortener.product(-tree.coefficient, tree.monomial, sums)
        return tree

    def _degree(self, tree: Tree) -> int:
        """The highest power of the coordinates and rates that multiplies a tree or one of its terms."""
        own = sum(e for i, e in digits(tree.monomial) if self.role(i) in ("coordinate", "rate") and e > 0)
        return own + sum(power * max(self._degree(t) for t in terms) for terms, power in tree.sums if power > 0)

    # -- dealing out ------------------------------------------------------------------------------------------------

    def _entries(self, poly: Flat, role: str) -> Way:
        """A term for each acceleration, with a factor as short as possible or split by harmonic, as in the entries
        of M."""
        carries, harmonic = self._only(role), self._only("trig")
        by_carried: dict[int, dict[int, Flat]] = {}
        for m, c in poly.items():
            by_carried.setdefault(carries(m), {}).setdefault(harmonic(m), {})[m - carries(m)] = c
        way: Way = []
        kind: TermKind = "inertia" if role == "acceleration" else "damping"
        for carried, groups in by_carried.items():
            order_of = sorted(groups.items(), key=lambda x: (x[0] != 0, lead(x[1])))
            entry = self.shortener.summed(self.shortener.short(g) for _, g in order_of)
            whole = self.shortener.short({m: c for g in groups.values() for m, c in g.items()})
            best = self._best(([self.shortener.times(t, Fraction(1), carried)] for t in (whole, entry)), kind)
            way += best
        return way

    def _shared(self, poly: Flat, role: str) -> Way:
        """(Σ masses and lengths) · (Σ accelerations), with the same accelerations in one term and no nesting."""
        carries = self._only(role)
        by_rest: dict[int, Flat] = {}
        for m, c in poly.items():
            by_rest.setdefault(m - carries(m), {})[carries(m)] = c
        alike: dict[Hashable, tuple[Flat, Flat]] = {}
        for rest, carried in by_rest.items():
            number = primitive(carried)[0]
            plain = {m: c / number for m, c in carried.items()}
            alike.setdefault(frozenset(plain.items()), ({}, plain))[0][rest] = number
        way: Way = []
        for rests, carried in sorted(
            alike.values(), key=lambda x: lead({m + n: c for m, c in x[0].items() for n in x[1]})
        ):
            one, other = self.shortener.short(rests), self.shortener.short(carried)
            number, monomial = one.coefficient * other.coefficient, one.monomial + other.monomial
            way.append(self.shortener.product(number, monomial, one.sums + other.sums))
        return way

    def _by(self, poly: Flat, key: Callable[[int], int], *, merge: bool = False) -> Way:
        """One tree per group, in the order of first terms; with ``merge``, groups that differ by a factor are
        combined."""
        groups: dict[int, Flat] = {}
        for m, c in poly.items():
            groups.setdefault(key(m), {})[m] = c
        dealt = list(groups.values())
        if merge:
            alike: dict[Hashable, Flat] = {}
            for g in groups.values():
                first = g[min(g, key=order)]
                cofactor = frozenset((m - key(m), c / first) for m, c in g.items())
                alike.setdefault(cofactor, {}).update(g)
            dealt = list(alike.values())
        return [tree for g in sorted(dealt, key=lead) for tree in self._whole(g)]

    def _whole(self, poly: Flat, *, spread: bool = False) -> Way:
        """The best factored sum, each of whose terms is one term; with ``spread``, the common factor is multiplied in.

        k (x₁ − x₂) stays one term; g (m₁ L₁ sin θ₁ + m₂ L₂ sin θ₂) is spread into two.
        """
        tree = self.shortener.short(poly)
        if len(tree.sums) != 1 or tree.sums[0][1] != 1:
            return [tree]
        plain = tree.monomial == 0 and (abs(tree.coefficient) == 1 or tree.coefficient.numerator == 1)
        if not (plain or spread):
            return [tree]
        return [self.shortener.times(t, tree.coefficient, tree.monomial) for t in tree.sums[0][0]]

    # -- letters ----------------------------------------------------------------------------------------------------

    def role(self, letter: int) -> str:
        """Return the role of a symbol, see `role_of`."""
        return role_of(self.generators, letter)

    def _only(self, *roles: str) -> Callable[[int], int]:
        """The part of a monomial that consists of symbols with these roles."""
        role = self.role
        return lambda m: int(packed((i, e) for i, e in digits(m) if role(i) in roles))

    def _but(self, *roles: str) -> Callable[[int], int]:
        role = self.role
        return lambda m: int(packed((i, e) for i, e in digits(m) if role(i) not in roles))

    def _turns(self, letter: int) -> bool:
        return self.role(letter) in ("trig", "coordinate")

    def _driven(self, letter: int) -> bool:
        """Whether a symbol is a sine or cosine that depends only on time, such as cos ωt."""
        entry = self.generators.table[letter]
        return isinstance(entry, Trig) and entry.moving and not self.generators.by_coordinates(entry.harmonic[0])
