"""What Newton's laws of the bodies say of a line: of which bodies it is the balance, and which known force is wrong.

    Σ ṗ·e = Σ F·e        a force along e           Σ Ḣ + (r_G − r_P) × ṗ = Σ M        a moment about P

The forces of weights, springs, dampers and inputs are known, those that hold the bodies are not. A line is c times the
balance of some bodies if its accelerations are; then what it says of the known forces can be read off, even if it has
forces with names of its own.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import combinations
from typing import cast

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.reference import Reference
from lagrangian.derive.reasons.loads import PassedOn, applied_loads, on_body
from lagrangian.derive.reasons.motion import Moving, moving
from lagrangian.derive.sampling import SETS, Array, CompiledExpressions
from lagrangian.model import Element, Gravity
from lagrangian.records import dataclass

MOST_PARTS = 7
"""Of more parts than this, translations and rotations, only single ones are balanced."""
MOST_POINTS = 8
"""The most points about which moments are taken."""
NEAR = 1e-8
"""The relative size of what is rounding."""


@dataclass(frozen=True, eq=False)
class Balance:
    """The inertia of some bodies along a direction or about a point, and the known forces on them, at every state.

    ``slopes`` are those of the inertia with every acceleration, one state after another. Of forces that are ``shared``,
    known by a deflection alone, it is not known on which of more bodies they act. ``turned`` is the inertia without
    accelerations, of which ``inertias`` are the summands.
    """

    moment: bool
    inertia: Array
    slopes: Array
    loads: Mapping[Element, Array]
    formulas: tuple[Mapping[Element, sp.Expr], ...]
    shared: frozenset[Element]
    turned: Array
    inertias: tuple[sp.Expr, ...]

    def of_rates(self, accelerations: Sequence[sp.Expr]) -> sp.Expr:
        """What of the inertia has no acceleration: centripetal, Coriolis and gyroscopic terms."""
        still = dict.fromkeys(accelerations, sp.S.Zero)
        return cast("sp.Expr", sp.Add(*(cast("sp.Expr", bounded.replaced(x, still)) for x in self.inertias)))

    def formula(self, element: Element) -> sp.Expr:
        """What a force adds to the balance."""
        return bounded.expand(sp.Add(*(x.get(element, sp.S.Zero) for x in self.formulas)))


@dataclass(frozen=True, eq=False)
class Match:
    """A balance of which a line is a multiple but for its known forces, and how often it counts each of these.

    ``scale`` is the multiple; ``counts`` are 1 for a force as it is, 0 for one that the line does not have under its
    own letters; each by the set of parameters.
    """

    balance: Balance
    scale: Array
    counts: Mapping[Element, Array]

    @property
    def wrong(self) -> dict[Element, Array]:
        """The forces that are neither right nor left out."""
        return {e: x for e, x in self.counts.items() if not (_all(x, 1) or _all(x, 0))}

    def excess(self, elements: Sequence[Element]) -> Array:
        """By how much the line is wrong at every state, if it is in the forces of some elements alone."""
        wrong = [self._by_states(1 - self.counts[e]) * self.balance.loads[e] for e in elements]
        return self._by_states(self.scale) * np.sum(wrong, axis=0)

    def share(self, element: Element) -> Array:
        """What a force adds to the line, left minus right, as the line has it, at every state."""
        return -self._by_states(self.scale * self.counts[element]) * self.balance.loads[element]

    def _by_states(self, values: Array) -> Array:
        return np.repeat(values, self.balance.inertia.size // SETS)

    @property
    def omitted(self) -> tuple[Element, ...]:
        """The forces that the line does not have under their own letters, in the order of the system."""
        return tuple(e for e, x in self.counts.items() if _all(x, 0))


class FreeBodies:
    """All balances of a system that are compared with the lines of an answer."""

    def __init__(self, truth: Reference) -> None:
        self.truth = truth
        self.accelerations = [c.acceleration for c in truth.model.coordinates]
        self.known = truth.names | {d.symbol for d in truth.model.definitions}
        self.balances: list[Balance]
        try:
            self.balances = list(_Balancing(truth).all())
        except bounded.TooLarge:  # then nothing is told of balances
            self.balances = []
        self.with_rates = [b for b in self.balances if np.abs(b.turned).max() > NEAR]

    def matches(self, line: sp.Expr, known: Mapping[sp.Basic, Array]) -> list[Match]:
        """The balances of which a line, with forces of its own that are ``known``, is a multiple in its inertia."""
        if (sampled := self._sampled(line, known)) is None:
            return []
        values, slopes = sampled
        found = (_match(b, values) for b in self.balances if proportional(b.slopes, slopes))
        return [m for m in found if m is not None]

    def without_rates(self, line: sp.Expr, known: Mapping[sp.Basic, Array]) -> tuple[Balance, Array] | None:
        """The one balance, and its multiple, of which a line has the accelerations and the forces that it has of it
        rightly, and none of the terms with products of rates; None if there is none."""
        if not self.with_rates or (sampled := self._sampled(line, known)) is None:
            return None
        values, slopes = sampled
        for b in self.with_rates:
            if not proportional(b.slopes, slopes):
                continue
            found = _match(replace(b, inertia=b.inertia - b.turned), values)
            if found is not None and not found.wrong:
                return b, found.scale
        return None

    def _sampled(self, line: sp.Expr, known: Mapping[sp.Basic, Array]) -> tuple[Array, Array] | None:
        """The values of a line with accelerations, and its slopes by these, at every state; None if there are none."""
        if not line.has(*self.accelerations):
            return None
        compiled = CompiledExpressions([line])
        values = compiled.at(self.truth.states, known)[0]
        slopes = compiled.slopes(self.accelerations).at(self.truth.states, known)
        return (values, slopes) if np.isfinite(values).all() and np.isfinite(slopes).all() else None

    def is_of_some(self, line: sp.Expr) -> bool:
        """Whether a line has the accelerations of some bodies, and not those of an equation of motion: it is the
        balance of these, and lacks what only the others have."""
        if not line.has(*self.accelerations):
            return False
        states = self.truth.states
        known = {x: np.zeros(states.size) for x in bounded.letters(line) if x not in self.known}
        rows = CompiledExpressions([line, *self.truth.rows]).slopes(self.accelerations).at(states, known)
        own, *whole = rows.reshape(len(self.truth.rows) + 1, len(self.accelerations), -1)
        if not np.isfinite(rows).all() or any(proportional(own, x) for x in whole):
            return False
        return any(proportional(b.slopes, own) for b in self.balances)


def free_bodies(truth: Reference) -> FreeBodies:
    """The balances of a system, made once."""
    key = ("free bodies",)
    if key not in truth.others:
        truth.others[key] = FreeBodies(truth)  # type: ignore[assignment]
    return cast("FreeBodies", truth.others[key])


def _all(values: Array, number: float) -> bool:
    return bool(np.abs(values - number).max() <= 1e-6)


def proportional(one: Array, other: Array) -> bool:
    """Whether values are the same multiple of others at all states with the same parameters."""
    for a, b in zip(_by_sets(one), _by_sets(other), strict=True):
        size = float(np.linalg.norm(a) * np.linalg.norm(b))
        if size == 0 or abs(float((a * b).sum())) < size * (1 - 1e-12):
            return False
    return True


def _by_sets(values: Array) -> Array:
    """Values (…, S) by the set of parameters: (sets, …)."""
    return np.moveaxis(values.reshape(*values.shape[:-1], SETS, -1), -2, 0)


def _match(balance: Balance, line: Array) -> Match | None:
    """How often a line with the inertia of a balance counts its forces; None if it has others, or that is not clear."""
    listed = list(balance.loads)
    basis = np.array([balance.inertia, *(-balance.loads[e] for e in listed)])
    counts: list[Array] = []
    scales: list[float] = []
    for rows, values in zip(_by_sets(basis), _by_sets(line), strict=True):
        scale = np.abs(rows).max(axis=1)
        if (scale == 0).any():
            return None
        found, _, rank, _ = np.linalg.lstsq((rows / scale[:, None]).T, values, rcond=1e-10)
        left = np.abs(values - found @ (rows / scale[:, None])).max()
        if rank < len(rows) or left > NEAR * np.abs(values).max():
            return None
        weights = found / scale
        counts.append(weights[1:] / weights[0])
        scales.append(float(weights[0]))
    return Match(balance, np.array(scales), {e: np.array([x[k] for x in counts]) for k, e in enumerate(listed)})


@dataclass(frozen=True, eq=False)
class _Part:
    """The translation of a body or of a mass in it, or a rotation: momentum rate, forces by element, arm."""

    turning: bool
    place: tuple[sp.Expr, ...]
    rate: tuple[sp.Expr, ...]
    loads: Mapping[Element, tuple[sp.Expr, ...]]
    columns: tuple[tuple[sp.Expr, ...], ...]


class _Balancing:
    """Makes the balances of a system."""

    def __init__(self, truth: Reference) -> None:
        self.truth = truth
        self.accelerations = [c.acceleration for c in truth.model.coordinates]
        context = truth.derivation.shares.context
        bodies = moving(context)
        applied = applied_loads(context, bodies)
        self.passed: tuple[PassedOn, ...] = applied.passed

        def expr(x: object) -> sp.Expr:
            return truth.expand(cast("sp.Expr", x))

        def part(m: Moving) -> Iterator[_Part]:
            loads: dict[Element, tuple[sp.Expr, ...]] = {}
            for load in applied.loads:
                if load.body is m.body:
                    own = on_body(context, [load], m)
                    added = [expr(x.expr()) for x in own]
                    before = loads.get(load.element, (sp.S.Zero,) * len(added))
                    loads[load.element] = tuple(a + b for a, b in zip(before, added, strict=True))
            place = tuple(expr(x) for x in truth.model.position(m.body.at))
            rate = tuple(expr(x.expr()) for x in m.momentum_rate)
            columns = tuple(tuple(expr(x.expr()) for x in column) for column in m.columns)
            mass = expr(m.body.mass)
            several = not m.turning and isinstance(mass, sp.Add)
            for share in (x / mass for x in mass.args) if several else (sp.S.One,):
                weighed = {
                    e: tuple(x * share if isinstance(e, Gravity) else x for x in force) for e, force in loads.items()
                }
                yield _Part(m.turning, place, tuple(x * share for x in rate), weighed, columns)

        parts = [p for m in bodies for p in part(m)]
        self.parts = [p for p in parts if any(x != 0 for x in p.rate)]

    def all(self) -> Iterator[Balance]:
        """Along every coordinate, along fixed and turning axes, and about points."""
        yield from self._along_coordinates()
        yield from self._along_axes()
        yield from self._about_points()

    def _along_coordinates(self) -> Iterator[Balance]:
        for j, c in enumerate(self.truth.model.coordinates):
            passed = {p.element: p.effort * sp.diff(p.rate, c.rate) for p in self.passed if p.rate.has(c.rate)}
            own = [p for p in self.parts if any(x != 0 for x in p.columns[j])]
            terms = [_Term(p.turning, *_dot(p, p.columns[j])) for p in own]
            yield from self._sums(terms, {e: self.truth.expand(x) for e, x in passed.items()})

    def _along_axes(self) -> Iterator[Balance]:
        own = [p for p in self.parts if not p.turning]
        for axis in self._axes(own):
            yield from self._sums([_Term(False, *_dot(p, axis)) for p in own], {})
        for p in self.parts:
            if p.turning and len(p.rate) > 1:  # Euler's equations, along the axes of the body
                for k, rate in enumerate(p.rate):
                    yield from self._sums([_Term(True, rate, {e: x[k] for e, x in p.loads.items()})], {})

    def _axes(self, parts: Sequence[_Part]) -> Iterator[tuple[sp.Expr, ...]]:
        """The fixed axes, and in the plane the directions in which coordinates move the parts, and across these."""
        size = len(parts[0].rate) if parts else 0
        yield from (tuple(sp.S(int(i == k)) for i in range(size)) for k in range(size))
        for column in dict.fromkeys(x for p in parts for x in p.columns) if size == 2 else ():
            if column[0] == 0 or column[1] == 0:
                continue
            length = sp.sqrt(column[0] ** 2 + column[1] ** 2)
            yield column[0] / length, column[1] / length
            yield -column[1] / length, column[0] / length

    def _about_points(self) -> Iterator[Balance]:
        model = self.truth.model
        if model.dimension != 2:
            return
        places = [tuple(self.truth.expand(x) for x in model.position(p)) for p in model.points]
        for at in list(dict.fromkeys([(sp.S.Zero, sp.S.Zero), *places]))[:MOST_POINTS]:
            terms: list[_Term] = []
            for p in self.parts:
                if p.turning:
                    terms.append(_Term(True, p.rate[0], {e: x[0] for e, x in p.loads.items()}))
                    continue
                arm = [x - y for x, y in zip(p.place, at, strict=True)]
                cross = (-arm[1], arm[0])
                terms.append(_Term(True, *_dot(p, cross)))
            yield from self._sums(terms, {})

    def _sums(self, terms: Sequence[_Term], passed: Mapping[Element, sp.Expr]) -> Iterator[Balance]:
        """The balances of all groups of parts."""
        if not terms:
            return
        states, n = self.truth.states, len(self.accelerations)
        elements = list(dict.fromkeys([*(e for t in terms for e in t.loads), *passed]))
        inertias = CompiledExpressions([t.inertia for t in terms])
        inertia = inertias.at(states)
        turned = inertias.at(states, dict.fromkeys(self.accelerations, np.zeros(states.size)))
        slopes = inertias.slopes(self.accelerations).at(states).reshape(len(terms), n, -1)
        zero = sp.S.Zero
        exprs = [*(t.loads.get(e, zero) for t in terms for e in elements), *(passed.get(e, zero) for e in elements)]
        loads = CompiledExpressions(exprs).at(states).reshape(len(terms) + 1, len(elements), states.size)
        if not all(np.isfinite(x).all() for x in (inertia, slopes, loads)):
            return
        most = len(terms) if len(terms) <= MOST_PARTS else 1
        for size in range(1, most + 1):
            for group in map(list, combinations(range(len(terms)), size)):
                whole = slopes[group].sum(axis=0)
                force = loads[[*group, len(terms)]].sum(axis=0)
                acting = {e: force[k] for k, e in enumerate(elements) if np.abs(force[k]).max() > NEAR}
                if np.abs(whole).max() > NEAR:
                    moment, formulas = any(terms[i].moment for i in group), tuple(terms[i].loads for i in group)
                    shared = frozenset(passed if size < len(terms) else ())
                    exprs, still = tuple(terms[i].inertia for i in group), turned[group].sum(axis=0)
                    own = (*formulas, passed)
                    yield Balance(moment, inertia[group].sum(axis=0), whole, acting, own, shared, still, exprs)


@dataclass(frozen=True, eq=False)
class _Term:
    """What one part adds to a balance."""

    moment: bool
    inertia: sp.Expr
    loads: Mapping[Element, sp.Expr]


def _dot(part: _Part, axis: Sequence[sp.Expr]) -> tuple[sp.Expr, dict[Element, sp.Expr]]:
    def along(vector: Sequence[sp.Expr]) -> sp.Expr:
        return sp.Add(*(a * b for a, b in zip(vector, axis, strict=True)))

    return along(part.rate), {e: along(force) for e, force in part.loads.items()}
