"""Changes of deflections: of a spring, and of a spring with the damper beside it, which feels the same motion."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.changes.change import LocalChange, Site, Words, made
from lagrangian.check.explain.changes.pieces import instead_of_piece
from lagrangian.check.explain.changes.ring import Sum, TooLong, minus, plus, scaled, times
from lagrangian.check.explain.changes.sites import Sites
from lagrangian.check.explain.misconceptions.base import Ingredients, partner
from lagrangian.check.explain.misconceptions.base import put as replaced
from lagrangian.model import Damper, Spring
from lagrangian.records import dataclass

MOST_PIECES = 16
"""A deflection with more pieces is not changed piece by piece."""
MOST_WAYS = 4
TOGETHER = 0.3
"""What a change of a spring and of the damper beside it costs more than one of the spring alone."""


@dataclass(frozen=True, eq=False)
class Strut:
    """Linear springs k of one deflection δ with, where there are any, linear dampers b that feel δ′."""

    springs: tuple[Spring, ...]
    deflection: sp.Expr
    dampers: tuple[Damper, ...] = ()

    @property
    def title(self) -> str:
        """What it is called in a sentence."""
        *first, last = [x.title for x in (*self.springs, *self.dampers)]
        return f"{', '.join(first)} and {last}" if first else last

    @property
    def spring(self) -> Spring:
        """The first spring."""
        return self.springs[0]


def struts(s: Ingredients) -> list[Strut]:
    """Every linear spring, and every linear spring with each damper that is parallel to it; all that are parallel."""
    springs = [(e, bounded.expand(x)) for e, x, _ in s.springs() if e.k is not None]
    linear = [e for e in s.acting if isinstance(e, Damper) and e.b is not None]
    dampers = [(e, bounded.expand(s.expand(e.rate(s.model)))) for e in linear]
    found = [Strut((e,), x) for e, x in springs]
    for e, x in springs:
        rate = bounded.expand(s.rate(x))
        beside = [d for d, r in dampers if r in (rate, bounded.expand(-rate))]
        found += [Strut((e,), x, (d,)) for d in beside]
        alike = tuple(k for k, y in springs if y in (x, bounded.expand(-x)))
        if len(alike) > 1 and alike[0] is e:
            found.append(Strut(alike, x))
            found += [Strut(alike, x, tuple(beside))] if beside else []
    return found


def _different(listed: Iterator[tuple[sp.Expr, str, float]], whole: sp.Expr) -> Iterator[tuple[sp.Expr, str, float]]:
    """The deflections that are neither ``whole`` nor its negative, each once, but for its sign: that is squared."""
    seen: set[sp.Expr] = {sp.S.Zero, whole, -whole}
    for other, kind, cost in sorted(listed, key=lambda x: x[2]):
        if other not in seen and not other.has(sp.zoo, sp.nan):
            seen |= {other, bounded.expand(-other)}
            yield other, kind, cost


def _forwards(deflection: sp.Expr, right: sp.Expr, q: Sequence[sp.Expr]) -> sp.Expr:
    """A deflection as one would write it, with the signs of the right one, z − x for z − x/2, and x + y for −x − y: its
    sign is squared."""
    shared = [x for x in q if deflection.has(x) and right.has(x)]
    signs = [(bounded.diff(deflection, x) * bounded.diff(right, x)).could_extract_minus_sign() for x in shared]
    if not isinstance(deflection, sp.Add) and not isinstance(right, sp.Add):
        turned = deflection.could_extract_minus_sign() and not right.could_extract_minus_sign()
    elif 2 * sum(signs) != len(signs):
        turned = 2 * sum(signs) > len(signs)
    else:
        turned = all(x.could_extract_minus_sign() for x in sp.Add.make_args(deflection))
    return -deflection if turned else deflection


class DeflectionChanges:
    """All changes of deflections in a system, and what may happen to a spring and a damper together."""

    def __init__(self, sites: Sites, lengths: Sequence[sp.Symbol]) -> None:
        self.sites = sites
        self.s = sites.of
        self.lengths = list(lengths)
        self.struts = struts(self.s)

    def parts(self) -> Iterator[Site]:
        """What springs and the dampers beside them do, everywhere and in each equation."""
        for strut in self.struts:
            if not strut.dampers or any(k not in self.sites.energies for k in strut.springs):
                continue
            held = [self.sites.shares.get(d, {}) for d in strut.dampers]
            shares = {i: plus(*[x[i] for x in held if i in x]) for i in sorted({i for x in held for i in x})}
            words: Words = (f"what {strut.title} add",)
            V = plus(*[self.sites.energies[k] for k in strut.springs])
            yield Site(words=words, brief=words, step=3, element=strut.spring, V=V, Xi=shares, surcharge=TOGETHER)
            for i, q in enumerate(self.s.q):
                rows = [self.sites.element_rows[k].get(i, {}) for k in strut.springs]
                own = plus(*rows, scaled(shares.get(i, {}), -1))
                if own and i in shares and len(shares) > 1:
                    words = (f"what {strut.title} add to the equation of ", q)
                    yield Site(
                        words=words,
                        brief=words,
                        step=5,
                        element=strut.spring,
                        coordinate=i,
                        rows={i: own},
                        surcharge=0.1 + TOGETHER,
                    )

    def changes(self) -> Iterator[LocalChange]:
        """Another deflection; the chain rule left out."""
        for strut in self.struts:
            yield from self._deflections(strut)
            yield from self._inner(strut)

    def _deflections(self, strut: Strut) -> Iterator[LocalChange]:
        """Another deflection of a spring, and of the damper beside it."""
        whole = strut.deflection
        words: Words = (f"the deflection of {strut.title}",)
        more = TOGETHER if strut.dampers else 0.0
        olds = self._damping(strut, whole)
        for other, kind, cost in _different(self._others(whole), whole):
            V = self._energy(strut, other)
            Xi = self._forces(strut, other, olds)
            said = _forwards(other, whole, self.s.q)
            if V and (not strut.dampers or Xi):
                site = Site(words=words, brief=words, step=3, element=strut.spring)
                yield made(kind, cost + more, site, {"V": V, "Xi": Xi}, whole, said)
            if kind in ("deflection_left_out", "deflection_sign"):
                yield from self._in_the_force(strut, kind, cost + more + 0.2, other)
            elif other.free_symbols <= whole.free_symbols and all(other.has(q) == whole.has(q) for q in self.s.q):
                yield from self._in_the_force(strut, kind, cost + more + 0.2, said)

    def _in_the_force(self, strut: Strut, kind: str, cost: float, other: sp.Expr) -> Iterator[LocalChange]:
        """Another deflection in the force k δ + b δ′ alone, which acts where it should: ∂δ/∂ξ_i is right."""
        whole = strut.deflection
        slopes = {i: bounded.diff(whole, q) for i, q in enumerate(self.s.q) if whole.has(q)}
        if len(slopes) < 2:
            return
        force = self._force(strut, cast("sp.Expr", other - whole))
        rows = {i: self.sites.ring.of_both(force, slope) for i, slope in slopes.items()}
        rows = {i: x for i, x in rows.items() if x}
        if len(rows) > 1:
            words: Words = (f"the deflection in the force of {strut.title}",)
            site = Site(words=words, brief=words, step=5, element=strut.spring)
            yield made(kind, cost, site, {"rows": rows}, whole, other)

    def _others(self, whole: sp.Expr) -> Iterator[tuple[sp.Expr, str, float]]:
        """What may be taken for a deflection: a piece left out or with the wrong sign; another coordinate."""
        pieces = sp.Add.make_args(whole)
        if 1 < len(pieces) <= MOST_PIECES:
            for p in pieces:
                yield cast("sp.Expr", whole - p), "deflection_left_out", 1.4
                yield cast("sp.Expr", whole - 2 * p), "deflection_sign", 1.5
        for q in [q for q in self.s.q if whole.has(q)]:
            others = [x for x in self.s.q if x != q]
            for x in (*others, *(q + x for x in others), *(q - x for x in others)):
                yield replaced(whole, {q: x}), "deflection", 1.9
        for q in self.s.q:
            yield q, "deflection", 2.0
        for p in [p for p in self.lengths if whole.has(p)]:
            for r in [x for x in self.lengths if x != p]:
                for x in (p + r, p - r, r - p):
                    yield replaced(whole, {p: x}), "deflection", 1.9
            for q in [q for q in self.s.q if whole.has(q)]:
                for f in (sp.sin, sp.cos, sp.tan):
                    yield f(q) * p, "deflection", 2.0
        for q in [q for q in self.s.q if whole.has(q)]:
            yield sp.sin(q), "deflection", 2.0
            yield sp.tan(q), "deflection", 2.0
        for f in sorted(whole.atoms(sp.sin, sp.cos), key=sp.default_sort_key):
            size = whole.coeff(f)
            if size != 0:
                yield size * partner(f), "deflection", 1.9
                yield size * f, "deflection", 1.9
        for p, q in combinations(self.s.q, 2):
            yield p - q, "deflection", 2.0
        for x, cost in (*((x, 1.9) for x in (*self.s.carried, *self._ways())), *((x, 2.1) for x in self.lengths)):
            yield whole + x, "deflection", cost
            yield whole - x, "deflection", cost
        for x in self._further(whole):
            yield x, "deflection", 1.8
        for p in pieces if len(pieces) > 1 else ():
            for r in [x for x in self.lengths if p.has(x)]:
                for x in (x for x in self.lengths if x != r):
                    yield cast("sp.Expr", whole - p + replaced(p, {r: x})), "deflection", 1.6
        for p in pieces:
            for x, kind, cost in instead_of_piece(p):
                if kind not in ("piece_left_out", "piece_sign"):
                    yield cast("sp.Expr", whole - p + x), kind, cost + 0.2

    def _stiffness(self, strut: Strut) -> sp.Expr:
        """The sum of all k."""
        return sp.Add(*[self.s.expand(e.k) for e in strut.springs])

    def _resistance(self, strut: Strut) -> sp.Expr:
        """The sum of all b."""
        return sp.Add(*[self.s.expand(d.b) for d in strut.dampers])

    def _force(self, strut: Strut, deflection: sp.Expr) -> sp.Expr:
        """k δ + b δ′."""
        force = self._stiffness(strut) * deflection
        if not strut.dampers:
            return force
        return force + self._resistance(strut) * self.s.rate(deflection)

    def _energy(self, strut: Strut, other: sp.Expr) -> Sum | None:
        """What another deflection adds to ½ k δ²."""
        ring, k = self.sites.ring, self._stiffness(strut) / 2
        if other.atoms(sp.Pow) or strut.deflection.atoms(sp.Pow):  # √(x² + a²)² is x², and a² does not move
            return self.sites.difference(k * other**2, k * strut.deflection**2, still=True)
        try:
            k, new, old = (ring.of(x) for x in (k, other, strut.deflection))
            return ring.moving(times(k, times(minus(new, old), plus(new, old))))
        except TooLong:
            return None

    def _damping(self, strut: Strut, deflection: sp.Expr) -> list[sp.Expr]:
        """−b δ′ ∂δ/∂ξ_i of the damper with a deflection; nothing without a damper."""
        if not strut.dampers:
            return []
        force = -self._resistance(strut) * self.s.rate(deflection)
        held = [deflection.has(q) for q in self.s.q]
        return [force * bounded.diff(deflection, q) if h else sp.S.Zero for q, h in zip(self.s.q, held, strict=True)]

    def _forces(self, strut: Strut, other: sp.Expr, olds: Sequence[sp.Expr]) -> dict[int, Sum]:
        """What another deflection adds to −b δ′ ∂δ/∂ξ_i of the damper."""
        found: dict[int, Sum] = {}
        for i, (new, old) in enumerate(zip(self._damping(strut, other), olds, strict=True)):
            if (new != 0 or old != 0) and (extra := self.sites.difference(new, old)):
                found[i] = extra
        return found

    def _further(self, whole: sp.Expr) -> list[sp.Expr]:
        """The positions of bodies that go on from a deflection, x + l sin θ of what hangs at x: the spring is tied to
        another body."""
        pieces = set(sp.Add.make_args(whole))
        every = dict.fromkeys(bounded.expand(x) for b in self.s.bodies for x in self.s.position(b))
        return [x for x in every if pieces < set(sp.Add.make_args(x))][:MOST_WAYS]

    def _ways(self) -> list[sp.Expr]:
        """The ways r φ of points on drums and pulleys: pieces of positions that are a length times a coordinate."""
        pieces = [p for b in self.s.bodies for x in self.s.position(b) for p in sp.Add.make_args(bounded.expand(x))]
        found = [p for p in pieces if any(bounded.diff(p, q) in (x, -x) for q in self.s.q for x in self.lengths)]
        return list(dict.fromkeys(found))[:MOST_WAYS]

    def _inner(self, strut: Strut) -> Iterator[LocalChange]:
        """The chain rule left out: ∂(½kδ²)/∂ξ_i without ∂δ/∂ξ_i, or with a part of it; the same for b δ′ ∂δ/∂ξ_i."""
        extension = strut.deflection
        force = self._force(strut, extension)
        for i, q in enumerate(self.s.q):
            slope = bounded.expand(bounded.diff(extension, q)) if extension.has(q) else sp.S.Zero
            if slope == 0:
                continue
            others: list[sp.Expr] = [sp.S.One, -sp.S.One, *sp.Add.make_args(slope), -slope]
            for f in slope.atoms(sp.sin, sp.cos):
                others += [replaced(slope, {f: sp.S.One}), replaced(slope, {f: partner(f)})]
            for other in dict.fromkeys(others):
                row = self.sites.difference(force * other, force * slope) if other != slope else None
                if row:
                    yield self._of_chain_rule(strut, i, {"rows": {i: row}}, slope, other)

    def _of_chain_rule(self, strut: Strut, i: int, sums: dict[str, Any], slope: sp.Expr, other: sp.Expr) -> LocalChange:
        q = self.s.q[i]
        energies = "energy" if len(strut.springs) == 1 else "energies"
        words: Words = ("∂/∂", q, f" of the {energies} of {strut.title}")
        more = 0.0
        if strut.dampers:
            words = (f"what {strut.title} add to the equation of ", q)
            more = TOGETHER
        site = Site(words=words, brief=words, step=5, element=strut.spring, coordinate=i)
        back = 0.1 if other == -1 and slope != -1 else 0.0
        return made("inner_derivative", 1.9 + more + back, site, sums, slope, other)
