"""Finds the mistakes that explain an answer: one, or two together, whose effects are what is wrong in it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction

import numpy as np
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.align import Alignment
from lagrangian.check.explain.changes.pool import Pool, Possible
from lagrangian.derive.sampling import SETS, Array
from lagrangian.model import Gravity
from lagrangian.records import dataclass

SMALL = 1e-7
"""The relative size below which a rest counts as explained."""
PARALLEL = 1e-9
"""1 − |cos| below which two vectors count as parallel."""
LARGEST_DENOMINATOR = 24
PLAIN = (Fraction(-1), Fraction(-2), Fraction(1), Fraction(-1, 2), Fraction(-3, 4), Fraction(3))
"""Left out, other sign, twice, half, a quarter and four times (m L²/12 for m L²/3): what is tried in pairs."""
BLOCK = 200_000
"""The largest number of multiplications in one product of matrices."""
EXOTIC = 4.6
"""A single mistake that costs more may be less likely than two plain ones."""
MOST_FOR_PAIRS = 6
"""The number of correspondences of rows for which pairs are tried."""
PAIR = 1.0
"""What a pair costs besides its two mistakes."""
KIN = 0.4
"""What a pair of the same kind spares: whoever does not know something makes the mistake everywhere."""


@dataclass(frozen=True, eq=False)
class Told:
    """One mistake with its multiple."""

    mistake: Possible
    times: Fraction
    cost: float


@dataclass(frozen=True, eq=False)
class Explanation:
    """Mistakes that together are what is wrong, under one correspondence of the rows (None for a line)."""

    told: tuple[Told, ...]
    cost: float
    under: Alignment | None = None


def singles(pool: Pool, E: Sequence[Array], rest: Array) -> list[Explanation]:
    """The single mistakes whose effects are a multiple of ``rest``, the cheapest first.

    ``E`` are the effects (C, S) on each of the k quantities whose rests are ``rest`` (k, S).
    """
    [found] = _singles(pool, E, [rest], [None], np.sum([squared(e) for e in E], axis=0))
    return found


def _singles(
    pool: Pool, E: Sequence[Array], rests: Sequence[Array], under: Sequence[Alignment | None], squares: Array
) -> list[list[Explanation]]:
    """The same for several rests at once, each under its own alignment; ``squares`` (C,) are |E|².

    cos ∠(E, rest) = Σ_j E_j·rest_j / (|E| |rest|): a product of two matrices for all rests and effects.
    """
    r = np.array([x.reshape(len(E), -1) for x in rests])
    with np.errstate(all="ignore"):
        norms = np.sqrt(squares)
        unit = r / np.linalg.norm(r, axis=(1, 2), keepdims=True)
        along = sum(_product(e, unit[:, j].T) for j, e in enumerate(E)) / norms[:, None]
    parallel = (np.abs(along) > 1 - PARALLEL) & (norms > 0)[:, None]
    return [_multiples(pool, E, x, map(int, np.flatnonzero(parallel[:, a])), under[a], norms) for a, x in enumerate(r)]


def _multiples(
    pool: Pool, E: Sequence[Array], r: Array, places: Iterable[int], under: Alignment | None, norms: Array
) -> list[Explanation]:
    """The single mistakes at some places of the pool of which a simple multiple is ``r`` (k, S)."""
    size = np.abs(r).max()
    found: list[Explanation] = []
    doubt = under.doubt if under is not None else 0.0
    for k in places:
        own = np.array([e[k] for e in E])
        times = float((own * r).sum()) / float(norms[k]) ** 2
        if np.abs(times * own - r).max() > SMALL * size:
            continue
        number = simple_number(times)
        if number is None or not pool.all[k].takes(number):
            continue
        cost = float(pool.cost[k]) + _oddness(number, pool.all[k])
        found.append(Explanation((Told(pool.all[k], number, cost),), cost + doubt, under))
    return sorted(found, key=lambda e: e.cost)


def _product(effects: Array, units: Array) -> Array:
    """Effects (C, S) times units (S, A), in blocks: BLAS gives larger ones threads, which mostly wait."""
    step = max(1, BLOCK // units.size)
    return np.concatenate([effects[i : i + step] @ units for i in range(0, max(len(effects), 1), step)])


def squared(effects: Array) -> Array:
    """The sum of the squares of each of the effects (C, S), shape (C,)."""
    return np.einsum("cs,cs->c", effects, effects)


def in_rows(
    pool: Pool, rests: Sequence[Array], under: Sequence[Alignment], rows: Sequence[int]
) -> list[list[Explanation]]:
    """The single mistakes that explain each of several rests of some of the system's rows, the cheapest first."""
    E = [pool.W[:, i] for i in rows]
    squares = np.sum([pool.kept(("squares", i), lambda i=i: squared(pool.W[:, i])) for i in rows], axis=0)
    return _singles(pool, E, rests, under, squares)


def without_constant(values: Array) -> Array:
    """Values minus the value at the first state with the same parameters."""
    shaped = values.reshape(*values.shape[:-1], SETS, -1)
    return (shaped - shaped[..., :1]).reshape(values.shape)


def simple_number(times: float) -> Fraction | None:
    """The simple fraction that a multiple is; None if it is none."""
    number = Fraction(times).limit_denominator(LARGEST_DENOMINATOR)
    near = abs(float(number) - times) <= SMALL * max(1.0, abs(times))
    return number if near and number != 0 else None


def _oddness(number: Fraction, possible: Possible) -> float:
    """What a multiple costs: leaving out is likelier than another sign, and that than another number."""
    if possible.change is None or not possible.change.free or number == -1:
        return 0.0
    if number == -2:
        return possible.change.site.sign_cost
    if number in (1, Fraction(-1, 2)):
        return 0.3
    if number in (Fraction(-3, 4), Fraction(3)):
        return 1.2  # a quarter, four times: rather a length or a speed that is squared
    return (
        0.9 if number.denominator <= 6 and abs(number.numerator) <= 6 and -2 <= number <= 3 else 1.6
    )  # nothing counts 7 times, or −3 times


class Vectors:
    """The different effects of a pool on some rows, for pairs: every plain multiple of every change."""

    def __init__(self, pool: Pool, E: Array) -> None:
        flat = E.reshape(len(E), -1)
        felt = np.flatnonzero(np.abs(flat).max(axis=1, initial=0.0) > 1e-12)
        index, times, odd = pool.kept("plain", lambda: _plain(pool))
        held = np.isin(index, felt)
        index, times, cost = index[held], times[held], pool.cost[index[held]] + odd[held]
        probe = np.random.default_rng(11).standard_normal((3, flat.shape[1]))
        seen = (flat @ probe.T)[index] * times[:, None]
        likely = np.argsort(cost, kind="stable")
        _, first = np.unique(np.round(seen[likely], 9), axis=0, return_index=True)
        keep = likely[np.sort(first)]
        self.pool, self.flat, self.probe = pool, flat, probe
        self.index, self.times, self.cost, self.seen = index[keep], times[keep], cost[keep], seen[keep]
        self.order = np.argsort(self.seen[:, 0])
        self.sorted = self.seen[self.order, 0]

    def pairs(self, rest: Array, under: Alignment | None = None, most: float = 9.0) -> list[Explanation]:
        """The pairs whose effects add up to ``rest``, the cheapest first."""
        r = rest.reshape(-1)
        size = float(np.abs(r).max())
        target = self.probe @ r
        wanted = target[0] - self.seen[:, 0]
        slack = 1e-8 * (np.abs(self.seen[:, 0]) + abs(target[0]) + size)
        low = np.searchsorted(self.sorted, wanted - slack)
        high = np.searchsorted(self.sorted, wanted + slack)
        found: list[tuple[float, int, int]] = []
        for a in np.flatnonzero(high > low):
            for b in self.order[low[a] : min(high[a], low[a] + 40)]:
                cost = float(self.cost[a] + self.cost[b]) + PAIR
                if b <= a or cost > most or self.index[a] == self.index[b]:
                    continue
                left = np.abs(self.seen[a] + self.seen[b] - target)
                if (left <= 1e-7 * (np.abs(target) + size)).all():
                    found.append((cost, int(a), int(b)))
        doubt = under.doubt if under is not None else 0.0
        sure = [(c - _kinship(*t), t) for c, t in self._sure(sorted(found)[:60], r, size) if not self._is_no_pair(*t)]
        return [Explanation(t, c + doubt, under) for c, t in sorted(sure, key=lambda x: x[0])]

    def _sure(
        self, found: Sequence[tuple[float, int, int]], r: Array, size: float
    ) -> Iterator[tuple[float, tuple[Told, Told]]]:
        for cost, a, b in found:
            both = self.flat[self.index[a]] * self.times[a] + self.flat[self.index[b]] * self.times[b]
            if np.abs(both - r).max() <= SMALL * size:
                yield cost, (self._told(a), self._told(b))

    def _is_no_pair(self, one: Told, other: Told) -> bool:
        """Whether nobody makes both mistakes: an element changed in one of two, or a letter left out twice of a row."""
        changes = [t.mistake.change for t in (one, other)]
        left_out = [c.right for c in changes if c is not None and c.kind == "left_out_of_a_sum"]
        places = [self.pool.places[id(t.mistake)] for t in (one, other)]
        twice = len(left_out) == 2 and left_out[0] == left_out[1]
        return _half_changed(one, other) or (twice and bool(self.pool.felt[places].all(axis=0).any()))

    def _told(self, a: int) -> Told:
        number = Fraction(float(self.times[a])).limit_denominator(LARGEST_DENOMINATOR)
        return Told(self.pool.all[self.index[a]], number, float(self.cost[a]))


def _plain(pool: Pool) -> tuple[Array, Array, Array]:
    """The place of every possible mistake with each plain multiple that it takes, the multiple and its oddness."""
    every = [(k, t) for k, possible in enumerate(pool.all) for t in PLAIN if possible.takes(t)]
    odd = [_oddness(t, pool.all[k]) for k, t in every]
    return np.array([k for k, _ in every], int), np.array([float(t) for _, t in every]), np.array(odd)


def _half_changed(one: Told, other: Told) -> bool:
    """Whether an element is counted twice, and changed in one of both: P s beside P R is one term P s too much, and so
    is m g y beside M g y. A damper is not given two other velocities at once, either."""
    if one.mistake.name == other.mistake.name == "damper_other_velocity":
        return one.mistake.element is not None and one.mistake.element is other.mistake.element
    if "element_twice" not in (one.mistake.name, other.mistake.name):
        return False
    if one.mistake.element is not None and one.mistake.element == other.mistake.element:
        return True
    weights = [x.mistake.wrong.variant.V for x in (one, other) if x.mistake.wrong is not None]
    if len(weights) < 2 or 0 in weights or not any(isinstance(x.mistake.element, Gravity) for x in (one, other)):
        return False
    return not bounded.cancel(weights[0] / weights[1]).atoms(AppliedUndef)


def _kinship(one: Told, other: Told) -> float:
    """What it spares if the same mistake was made twice, as in the heights of two bodies."""
    return KIN if one.mistake.name == other.mistake.name and one.times == other.times else 0.0


def first_explained(pool: Pool, found: Sequence[Alignment]) -> list[Explanation]:
    """The explanations of all rows at once: single mistakes, and pairs where no single one is plausible."""
    best: list[Explanation] = []
    for rows in dict.fromkeys(a.rows for a in found):
        own = [a for a in found if a.rows == rows]
        best += [e for each in in_rows(pool, [a.rest for a in own], own, rows) for e in each]
    best.sort(key=lambda e: e.cost)
    if best and best[0].cost <= EXOTIC:
        return best
    vectors: dict[tuple[int, ...], Vectors] = {}
    pairs: list[Explanation] = []
    for a in found[:MOST_FOR_PAIRS]:
        if a.rows not in vectors:
            vectors[a.rows] = pool.kept(("vectors", a.rows), lambda rows=a.rows: Vectors(pool, pool.W[:, list(rows)]))
        pairs += vectors[a.rows].pairs(a.rest, a)
    return sorted([*best, *pairs], key=lambda e: e.cost)


def by_rows(pool: Pool, found: Sequence[Alignment]) -> list[Explanation]:
    """Explanations of every wrong row on its own, put together; nothing unless all are explained."""
    for a in found:
        told: list[Told] = []
        total = 0.0
        for j, i in enumerate(a.rows):
            if np.abs(a.rest[j]).max() <= 1e-9 * (1 + np.abs(pool.truth.W[i]).max()):
                continue
            [one] = in_rows(pool, [a.rest[[j]]], [a], [i])
            if not one or one[0].cost > EXOTIC:
                vectors: Vectors = pool.kept(("vectors", (i,)), lambda i=i: Vectors(pool, pool.W[:, [i]]))
                one = sorted([*one, *vectors.pairs(a.rest[[j]], a)], key=lambda e: e.cost)
            if not one:
                break
            told += [t for t in one[0].told if all(t.mistake is not x.mistake for x in told)]
            total += one[0].cost
        else:
            if told and reproduces(pool, told, a):
                return [Explanation(tuple(told), total, a)]
    return []


def reproduces(pool: Pool, told: Sequence[Told], under: Alignment) -> bool:
    """Whether mistakes, made in the right equations, lead to all equations of the answer."""
    place = pool.places
    made = sum(float(t.times) * pool.W[place[id(t.mistake)]][list(under.rows)] for t in told)
    return bool((np.abs(made - under.rest) <= SMALL * (np.abs(under.rest).max() + np.abs(pool.truth.W).max())).all())
