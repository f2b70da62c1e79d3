"""All local changes of a system and their effects at the random states: numbers to be compared with an answer's."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from functools import lru_cache
from typing import Any

import numpy as np
from scipy import sparse

from lagrangian.check.align import LARGEST
from lagrangian.check.explain.candidates import Effects, Wrong, effects_of, ingredients_of
from lagrangian.check.explain.changes.alike import carried, turned_by_time
from lagrangian.check.explain.changes.change import LocalChange
from lagrangian.check.explain.changes.deflections import DeflectionChanges
from lagrangian.check.explain.changes.geometry import GeometryChanges
from lagrangian.check.explain.changes.letters import LetterChanges
from lagrangian.check.explain.changes.ring import Monomial, Sum, TooLong
from lagrangian.check.explain.changes.scales import scales
from lagrangian.check.explain.changes.sites import Sites
from lagrangian.check.explain.changes.slopes import AtomSlopes
from lagrangian.check.explain.changes.sums import SumChanges
from lagrangian.check.explain.changes.turning import TurningChanges
from lagrangian.check.explain.changes.work import WorkChanges
from lagrangian.check.reference import Reference
from lagrangian.derive import Derived
from lagrangian.derive.sampling import Array
from lagrangian.model import Element
from lagrangian.records import dataclass

MOST = 9_000
"""The largest number of changes that are tried, the likeliest first."""
MONOMIALS = 150_000
"""The largest number of monomials in all changes together."""

SAME = 1e-9
"""The relative size of a difference of two effects that is rounding."""


@dataclass(frozen=True, eq=False)
class Possible:
    """A mistake that may explain an answer: a local change or a well-known misconception."""

    cost: float
    change: LocalChange | None = None
    wrong: Wrong | None = None

    @property
    def element(self) -> Element | None:
        """The element that it concerns."""
        if self.change is not None:
            return self.change.site.element
        return self.wrong.variant.element if self.wrong is not None else None

    @property
    def name(self) -> str:
        """The kind of the change, or the name of the misconception."""
        return self.change.kind if self.change is not None else self.wrong.name if self.wrong is not None else ""

    def takes(self, number: Fraction) -> bool:
        """Whether a multiple of it is a mistake of the same kind."""
        if self.change is None or not self.change.free:
            return number == 1
        return number > 0 or not self.change.positive


class Pool:
    """Every possible mistake with what it adds to the rows, T*, V and every Ξ, at every state of the reference.

    ``W`` (C, n, S), ``T`` and ``V`` (C, S), ``Xi`` (C, n, S).
    """

    def __init__(self, truth: Reference) -> None:
        self.truth = truth
        self.effects: Effects = effects_of(truth)
        made = _changes_of(truth.derivation)
        self.sites, changes = made.sites, made.changes
        if not made.all:
            truth.tried_all = False
        W, T, V, Xi = self._values(changes)
        e = self.effects
        self.all = [Possible(c.cost, change=c) for c in changes]
        self.all += [Possible(_cost(w), wrong=w) for w in e.wrongs]
        self.W = np.concatenate([W, e.W])
        self.T, self.V = np.concatenate([T, e.T]), np.concatenate([V, e.V])
        self.L = np.concatenate([T - V, e.L])
        self.Xi = np.concatenate([Xi, e.Xi])
        self.cost = np.array([p.cost for p in self.all])
        self._kept: dict[object, Any] = {}
        count = len(self.all)
        every = [x.reshape(count, -1) for x in (self.W, self.T, self.V, self.Xi)]
        self._choose(np.all([(x.max(axis=1) < LARGEST) & (x.min(axis=1) > -LARGEST) for x in every], axis=0))

    def _choose(self, chosen: Any) -> None:
        """Keep some of the possible mistakes."""
        if chosen.all():
            return
        self.all = [p for p, keep in zip(self.all, chosen, strict=True) if keep]
        for name in ("W", "T", "V", "L", "Xi", "cost"):
            setattr(self, name, getattr(self, name)[chosen])

    def key(self, possible: Possible, times: float) -> tuple[float, ...]:
        """What a multiple of a possible mistake does to the equations, as a few numbers: equal ones do the same."""
        seen = self.kept("seen", self._seen)
        return tuple(float(x) for x in np.round(times * seen[self.places[id(possible)]], 7))

    def together(self, one: Possible, other: Possible) -> Possible | None:
        """The likeliest change of the same kind that does what two do together."""
        seen, kind = self.kept("seen", self._seen), one.change.kind if one.change is not None else None
        both = seen[self.places[id(one)]] + seen[self.places[id(other)]]
        near = np.flatnonzero(np.abs(seen - both).max(axis=1) <= SAME * (1 + np.abs(both).max()))
        found = [p for k in near if (p := self.all[k]).change is not None and p.change.kind == kind]
        return min(found, key=lambda p: p.cost, default=None)

    def momenta(self, i: int) -> Array:
        """What every possible mistake adds to ∂L/∂ξ̇_i, (C, S); 0 for one that is made in an equation alone."""
        return self.kept(("momenta", i), lambda: self._momenta(i))

    def _momenta(self, i: int) -> Array:
        changes = [p.change if p.change is not None and p.change.effect.only is None else None for p in self.all]
        T, table = _table([c.effect.T if c is not None else {} for c in changes])
        found = table @ AtomSlopes(self.truth, self.sites.ring).momenta(T)[:, i]
        own = self.effects.momenta(i)
        place = {id(w): k for k, w in enumerate(self.effects.wrongs)}
        for k, p in enumerate(self.all):
            if p.wrong is not None:
                found[k] = own[place[id(p.wrong)]]
        return np.where(np.isfinite(found).all(axis=1)[:, None], found, 0.0)

    @property
    def places(self) -> dict[int, int]:
        """The place of every possible mistake in the arrays, by its identity."""
        return self.kept("places", lambda: {id(p): k for k, p in enumerate(self.all)})

    def named(self, name: str) -> list[Possible]:
        """The possible mistakes of a kind, in their order."""
        return self.kept("named", self._by_name).get(name, [])

    def _by_name(self) -> dict[str, list[Possible]]:
        found: dict[str, list[Possible]] = {}
        for possible in self.all:
            found.setdefault(possible.name, []).append(possible)
        return found

    @property
    def felt(self) -> Any:
        """Whether every possible mistake changes every row, (C, n)."""
        return self.kept("felt", lambda: np.abs(self.W).max(axis=2) > 1e-9)

    def _seen(self) -> Array:
        """The effects on rows, energies and forces along three random directions."""
        random, count = np.random.default_rng(5), len(self.all)
        everything = [self.W.reshape(count, -1), self.T, self.V, self.Xi.reshape(count, -1)]
        return sum((x @ random.standard_normal((x.shape[1], 3)) for x in everything), np.zeros((count, 3)))

    def kept(self, key: object, make: Callable[[], Any]) -> Any:
        """The result of ``make``, computed once for every key."""
        if key not in self._kept:
            self._kept[key] = make()
        return self._kept[key]

    def _values(self, changes: Sequence[LocalChange]) -> tuple[Array, Array, Array, Array]:
        """The effects of local changes on the rows, T*, V and Ξ."""
        truth, n, size, count = self.truth, self.truth.n, self.truth.states.size, len(changes)
        jets = AtomSlopes(truth, self.sites.ring)
        T, in_T = _table([c.effect.T for c in changes])
        V, in_V = _table([c.effect.V for c in changes])
        lagrange = in_T @ jets.lagrange(T).reshape(len(T), n * size)
        slopes = in_V @ jets.slopes(V).reshape(len(V), n * size)
        W = (lagrange + slopes).reshape(count, n, size)
        felt = np.ones((count, n))
        for k, c in enumerate(changes):
            if c.effect.only is not None:
                felt[k] = [i in c.effect.only for i in range(n)]
        W *= felt[:, :, None]
        Xi = np.zeros((count, n, size))
        for i in range(n):
            own, table = _table([c.effect.Xi.get(i, {}) for c in changes])
            Xi[:, i] = table @ jets.values(own)
            own, table = _table([c.effect.rows.get(i, {}) for c in changes])
            W[:, i] += table @ jets.values(own) - Xi[:, i]
        shown = np.array([c.effect.only is None for c in changes], dtype=float)[:, None]
        moves = {a for a, x in enumerate(self.sites.ring.atoms) if x.has(*self.sites.of.q)}
        felt_in_V = np.array([any(a in moves for a, _ in m) for m in V], dtype=float)[:, None]  # time alone is nothing
        return W, (in_T @ jets.values(T)) * shown, (in_V @ (jets.values(V) * felt_in_V)) * shown, Xi


def _table(sums: Sequence[Sum]) -> tuple[list[Monomial], sparse.csr_matrix]:
    """The monomials of all sums, and the number of each in every sum."""
    index: dict[Monomial, int] = {}
    rows: list[int] = []
    columns: list[int] = []
    values: list[float] = []
    for k, s in enumerate(sums):
        for m, c in s.items():
            rows.append(k)
            columns.append(index.setdefault(m, len(index)))
            values.append(c.numerator / c.denominator)
    return list(index), sparse.csr_matrix((values, (rows, columns)), shape=(len(sums), len(index)))


@dataclass(frozen=True, eq=False)
class Changes:
    """The local changes of a derivation, the likeliest first, and their sites; ``all``: none was left out."""

    sites: Sites
    changes: Sequence[LocalChange]
    all: bool


@lru_cache(maxsize=16)
def _changes_of(derivation: Derived) -> Changes:
    """The changes of a derivation, whatever the values of its parameters and the states where they are compared."""
    sites = Sites(ingredients_of(derivation))
    found: list[LocalChange] = []
    left = MONOMIALS
    try:
        for change in _every(sites):
            left -= sum(map(len, change.effect.sums()))
            if left < 0:
                break
            found.append(change)
    except TooLong:
        left = -1
    return Changes(sites, sorted(found, key=lambda c: c.cost)[:MOST], left >= 0)


def _every(sites: Sites) -> Iterator[LocalChange]:
    """Every change, until their sums are too long."""
    letters = LetterChanges(sites)
    deflections = DeflectionChanges(sites, letters.lengths)
    parts, wholes = [*sites.parts(), *deflections.parts()], list(sites.wholes())
    terms, rows = list(sites.terms()), list(sites.in_rows())
    given = [*carried(sites.of, sites.difference), *turned_by_time(sites.of, sites.difference)]
    yield from scales(sites.n, [*parts, *wholes, *terms, *rows, *given])
    yield from letters.exchanges([*parts, *wholes])
    yield from letters.changes([*parts, *wholes, *terms, *rows])
    yield from letters.factors([*parts, *(w for w in wholes if w.element is not None), *terms, *rows])
    yield from GeometryChanges(sites, letters.lengths).changes()
    yield from deflections.changes()
    yield from TurningChanges(sites).changes()
    yield from SumChanges(sites, letters.lengths).changes()
    yield from WorkChanges(sites, letters.lengths, sites.of.ratios).changes()


FORGOTTEN = (
    "reaction_forgotten",
    "rotation_forgotten",
    "translation_forgotten",
    "gravity_forgotten",
    "element_forgotten",
)
"""What comes before anything else that says the same."""


def _cost(wrong: Wrong) -> float:
    """How unlikely a misconception is; of two that say the same, the one that says it shorter is likelier."""
    rank = FORGOTTEN.index(wrong.name) if wrong.name in FORGOTTEN else wrong.rank
    return 0.9 + 0.006 * rank + 0.6 * wrong.variant.doubt + 0.00002 * len(str(wrong.variant.what))


@lru_cache(maxsize=16)
def pool_of(truth: Reference) -> Pool:
    """All possible mistakes in a system, made once for the systems that were checked most recently."""
    return Pool(truth)
