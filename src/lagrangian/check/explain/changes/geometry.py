"""Changes of the geometry: a piece of a position, a rate in a velocity, an angular velocity."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import cached_property
from itertools import combinations
from typing import Any, cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.changes.change import LocalChange, Site, Words, made
from lagrangian.check.explain.changes.gains import Gains
from lagrangian.check.explain.changes.pieces import (
    along_turning_axes,
    instead_of_angle,
    instead_of_piece,
    instead_of_segment,
    segment,
)
from lagrangian.check.explain.changes.ring import ONE, Sum, TooLong, minus, plus, scaled
from lagrangian.check.explain.changes.sites import Sites
from lagrangian.check.explain.misconceptions.base import half_square
from lagrangian.check.explain.misconceptions.base import put as replaced
from lagrangian.page.formula import Name

AXES = "xyz"
MOST_PIECES = 16
"""A position with more pieces is not changed piece by piece."""
MOST_ALIKE = 2
"""The largest number of letters that are tried in the place of another in one piece."""


class GeometryChanges:
    """All changes of positions, velocities and angular velocities of a system."""

    def __init__(self, sites: Sites, lengths: Sequence[sp.Symbol]) -> None:
        self.sites = sites
        self.s = sites.of
        self.lengths = list(lengths)
        self.gains = Gains(sites)
        self._found: dict[Any, tuple[sp.Rational, bool]] = {}

    def changes(self) -> Iterator[LocalChange]:
        """All of them; those whose sums would be too long are left out."""
        for b in self.s.bodies:
            yield from self._positions(b)
            yield from self._velocities(b)
            yield from self._turning(b)
        yield from self._rates_everywhere()

    # -- bodies -------------------------------------------------------------------------------------------------------

    def _positions(self, b: Any) -> Iterator[LocalChange]:
        """A piece of the position left out, with the wrong sign, sine for cosine, without its number."""
        position = [bounded.expand(x) for x in self.s.position(b)]
        pieces = [(c, p) for c, x in enumerate(position) for p in sp.Add.make_args(x) if self.s.moves(p)]
        if not 0 < len(pieces) <= MOST_PIECES:
            return
        for c, p in pieces:
            along: Words = (f" along {AXES[c]}",) if len(position) > 1 else ()
            words: Words = (f"the position of {b.title}", *along)
            brief: Words = (f"the position of {b.title}",)
            first = 0.01 if any(k == c for k, _ in pieces[1:]) and (c, p) == pieces[0] else 0.0  # x − y: the sign of y
            for instead, kind, cost in instead_of_piece(p):
                yield from self._moved(b, [(c, p, instead)], kind, cost + first, words, brief, p, instead)
            for old, new in self._other_letters(p):
                yield from self._moved(b, [(c, p, replaced(p, {old: new}))], "letter", 2.1, words, brief, old, new)
        groups: dict[Any, list[tuple[int, sp.Expr]]] = {}
        for c, p in pieces:
            groups.setdefault(segment(p), []).append((c, p))
        for key, group in groups.items():
            words = (f"the position of {b.title}",)
            every = [*instead_of_segment(key, [p for _, p in group])]
            if len(position) == 2 and len(group) == 2:
                (c, x), (_, y) = group
                across = [(-y, x), (y, -x)] if c == 0 else [(y, -x), (-y, x)]
                every += [([*pair], "segment_direction", 1.95, key, None) for pair in across]
            every += instead_of_angle([p for _, p in group], self._turning_angles)
            for instead, kind, cost, right, written in every:
                moved = [(c, p, other) for (c, p), other in zip(group, instead, strict=True)]
                yield from self._moved(b, moved, kind, cost, words, words, right, written)

    def _other_letters(self, piece: sp.Expr) -> Iterator[tuple[sp.Symbol, sp.Symbol]]:
        """The lengths of a piece, each with a length of the same first letter."""
        for p in [p for p in self.lengths if piece.has(p)]:
            alike = [x for x in self.lengths if x != p and x.name[0].lower() == p.name[0].lower()]
            yield from ((p, x) for x in alike[:MOST_ALIKE])

    @cached_property
    def _turning_angles(self) -> list[sp.Expr]:
        """The coordinates by which the positions of bodies turn."""
        turned = [a for b in self.s.bodies for x in self.s.position(b) for a in self.s.angles(x)]
        return [q for q in self.s.q if any(a.has(q) for a in turned)]

    def _moved(
        self,
        b: Any,
        pieces: Sequence[tuple[int, sp.Expr, sp.Expr]],
        kind: str,
        cost: float,
        words: Words,
        brief: Words,
        right: Any,
        written: Any,
    ) -> Iterator[LocalChange]:
        """The change of the speed alone, and of the speed and the height, with other ``pieces`` of the position: the
        component, what belongs there and what stands there."""
        ring, shift = self.sites.ring, dict[int, Any]()
        for c, old, new in pieces:
            shift[c] = plus(shift.get(c, {}), minus(ring.of(new), ring.of(old)))
        V, faster = self.gains.of_height(b, shift), {c: ring.rate(x) for c, x in shift.items()}
        T = self.gains.of_speed(b, faster)
        if T is None:
            return
        site = Site(words=words, brief=brief, step=2, element=b)
        if V:
            yield made(kind, cost, site, {"T": T, "V": V}, right, written)
            yield made(kind, cost + 0.5, _in(site, "height", 3), {"V": V}, right, written)
        moves = T and any(plus(ring.of(x), faster.get(c, {})) for c, x in enumerate(self.s.velocity(b)))
        if moves or (T and self.s.rotation(b) == 0):  # otherwise its ½mv² is missing
            rates = [self.s.rate(x) if isinstance(x, sp.Expr) and self.s.moves(x) else x for x in (right, written)]
            yield made(kind, cost + 0.2, _in(site, "velocity", 2), {"T": T}, *rates)

    def _velocities(self, b: Any) -> Iterator[LocalChange]:
        """A rate left out or with the wrong sign in one component; speeds added as numbers."""
        velocity = [bounded.expand(x) for x in self.s.velocity(b)]
        own = self.s.translation(b)
        mass = self.s.expand(b.mass)
        brief: Words = (f"the velocity of {b.title}",)
        parts = {(c, v): x - replaced(x, {v: sp.S.Zero}) for c, x in enumerate(velocity) for v in self.s.v if x.has(v)}
        sums = {key: self.sites.ring.of(part) for key, part in parts.items()}
        for c in range(len(velocity)):
            rates = [v for k, v in parts if k == c]
            for v in rates:
                part, moved = parts[c, v], sums[c, v]
                twice = self.gains.of_square(mass, moved)
                yield from self._gained(b, twice, "velocity_part_twice", 2.3, brief, brief, part)
                words: Words = (f"the velocity of {b.title} along {AXES[c]}",)
                sign = 1.61 if len(rates) > 1 and v == rates[0] else 1.6  # ẋ − ẏ for ẋ + ẏ: the sign of ẏ was slipped
                for number, kind, cost in ((-1, "velocity_part_left_out", 1.5), (-2, "velocity_part_sign", sign)):
                    T = self.gains.of_speed(b, {c: scaled(moved, number)})
                    yield from self._gained(b, T, kind, cost, words, brief, part)
        yield from self._carried(b, velocity, own, mass)
        rates = [v for v in self.s.v if any(x.has(v) for x in velocity)]
        rates = rates if len(rates) > 1 else []
        parallel = 2 <= len(rates) <= 3 and self._parallel(velocity, rates)
        told: set[tuple[Any, Any]] = set()
        for v in rates[1:] if parallel and len(rates) == 2 else rates:  # ẋ − ẏ for ẋ + ẏ: the sign of ẏ was slipped
            turned = {c: scaled(x, -2) for (c, w), x in sums.items() if w == v}
            cost = 1.55 if parallel else 1.7
            right, against = self._against([velocity], v)
            if (right, against) not in told:
                told.add((right, against))
                T = self.gains.of_speed(b, turned)
                yield from self._gained(b, T, "rate_sign", cost, brief, brief, right, against)
        if 2 <= len(rates) <= 3 and not parallel:
            yield from self._as_numbers(b, velocity, rates, own, mass, brief)

    def _carried(self, b: Any, velocity: list[sp.Expr], own: sp.Expr, mass: sp.Expr) -> Iterator[LocalChange]:
        """A part of a velocity that no rate brings, such as Ω x in axes that turn, left out or with the wrong sign."""
        turned = along_turning_axes(self.s.position(b), velocity, self.s.q)
        words: Words = (f"the velocity of {b.title}", " along axes that turn" if turned else "")
        of = [self.sites.ring.expr(self.sites.sum(x)) for x in turned] or velocity
        parts = [(c, p) for c, x in enumerate(of) for p in sp.Add.make_args(x) if p != 0 and not p.has(*self.s.v)]
        for c, part in parts if len(parts) <= MOST_PIECES else ():
            for number, kind, cost in ((-1, "velocity_part_left_out", 1.55), (-2, "velocity_part_sign", 1.65)):
                changed = tuple(cast("sp.Expr", x + number * part) if k == c else x for k, x in enumerate(of))
                yield from self._kinetic(b, half_square(mass, changed), own, kind, cost, words, words[:1], part)

    def _as_numbers(
        self, b: Any, velocity: list[sp.Expr], rates: list[Any], own: sp.Expr, mass: sp.Expr, brief: Words
    ) -> Iterator[LocalChange]:
        """½ m (Σ ± |∂v/∂ξ̇| ξ̇)²: the speeds added as numbers instead of as vectors; on one line they are numbers."""
        if sum(x.has(*rates) for x in velocity) < 2:
            return
        speeds: list[sp.Expr] = []
        for v in rates:
            square = self.sites.sum(sp.Add(*[bounded.diff(x, v) ** 2 for x in velocity]))
            if not square:
                return
            speeds.append(self.sites.ring.root(square))
        for signs in ((1, 1, 1), (1, -1, 1), (1, 1, -1), (1, -1, -1)):
            if len(rates) == 2 and signs[2] < 0:
                continue
            total = sp.Add(*[g * s * v for g, s, v in zip(signs, speeds, rates, strict=False)])
            cost = 1.3 if signs == (1, 1, 1) else 1.6
            yield from self._kinetic(b, mass / 2 * total**2, own, "speeds_as_numbers", cost, brief, brief, None, total)

    def _against(self, velocities: Sequence[Sequence[sp.Expr]], v: Any) -> tuple[sp.Expr, sp.Expr | Words]:
        """Which rate has the wrong sign against which where that of ``v`` is turned in velocities.

        Of two, either may be told: that which has a factor, h θ̇ beside ṡ; otherwise the second.
        """

        def product(velocity: Sequence[sp.Expr], w: Any, by: Any) -> Any:
            return self.sites.sum(sp.Add(*[bounded.diff(x, w) * bounded.diff(x, by) for x in velocity]))

        others = [w for w in self.s.v if w != v and any(product(x, v, w) for x in velocities)]
        if len(others) != 1:
            return v, ("the other rates",)
        pair = [w for w in self.s.v if w == v or w in others]
        plain = [all(set(product(x, w, w)) <= {ONE} for x in velocities) for w in pair]
        return (pair[0], pair[1]) if plain == [False, True] else (pair[1], pair[0])

    def _parallel(self, velocity: list[sp.Expr], rates: list[Any]) -> bool:
        """Whether what every rate adds to a velocity points along the same line, which is that of no axis."""
        if sum(x.has(*rates) for x in velocity) < 2:
            return False
        first, *others = [[bounded.diff(x, v) for x in velocity] for v in rates]
        pairs = list(combinations(range(len(velocity)), 2))
        try:
            return not any(self.sites.sum(first[j] * w[k] - first[k] * w[j]) for w in others for j, k in pairs)
        except TooLong:
            return False

    def _rates_everywhere(self) -> Iterator[LocalChange]:
        """A rate taken as absolute or relative: ξ̇_i ± ξ̇_j in place of ξ̇_i, in one body or in all of T*."""
        for v in self.s.v:
            coupled = (
                [b for b in self.s.bodies if any(x.has(v) and x.has(*others) for x in self.s.velocity(b))]
                if (others := [w for w in self.s.v if w != v])
                else []
            )
            if len(coupled) < 2:
                continue
            words: Words = (Name("T*"),)
            right, against = self._against([self.s.velocity(b) for b in coupled], v)
            T = self.gains.of_rate(self.s.T, v, -v)
            yield from self._gained(None, T, "rate_sign", 1.2, words, words, right, against)
        for v, w in ((v, w) for v in self.s.v for w in self.s.v if v != w):
            for sign in (1, -1):
                for b in self.s.bodies:
                    old = self.s.kinetic(b)
                    if old.has(v):
                        words = (f"the kinetic energy of {b.title}",)
                        T = self.gains.of_rate(old, v, v + sign * w)
                        yield from self._gained(b, T, "rate", 1.6, words, words, *self._quoted((b,), v, w, sign))
                if self.s.T.has(v):
                    words, every = (Name("T*"),), tuple(self.s.bodies)
                    T = self.gains.of_rate(self.s.T, v, v + sign * w)
                    yield from self._gained(None, T, "rate", 1.7, words, words, *self._quoted(every, v, w, sign))

    def _quoted(self, bodies: tuple[Any, ...], v: Any, w: Any, sign: int) -> tuple[sp.Expr, sp.Expr]:
        """What belongs there and what stands there where ξ̇_i + g ξ̇_j is put in place of ξ̇_i, with g = ±1.

        In a·(ξ̇_i − g ξ̇_j) that leaves a·ξ̇_i: ż stands where ẋ − ż belongs. Where all speeds and angular velocities that
        hold ξ̇_i have the same multiple of ξ̇_j beside it, and T* of what is no body as well, this is quoted with it;
        otherwise ξ̇_i and what was put in its place.
        """
        if (bodies, v, w) not in self._found:
            self._found[bodies, v, w] = self._beside(bodies, v, w)
        held, leads = self._found[bodies, v, w]
        return (sign * w - v if held == -sign and leads else v + held * w), v + (held + sign) * w

    def _beside(self, bodies: tuple[Any, ...], v: Any, w: Any) -> tuple[sp.Rational, bool]:
        """The multiple of ξ̇_j that stands beside ξ̇_i everywhere, else 0, and whether all ξ̇_i have the sign −."""
        speeds = [x for b in bodies for x in (*self.s.velocity(b), *self.s.omega(b)) if x.has(v)]
        pairs = [(bounded.diff(x, w), bounded.diff(x, v)) for x in speeds]
        own = [self.s.kinetic(e) for e in self.sites.others] if bodies == tuple(self.s.bodies) else []
        pairs += [(bounded.diff(x, v, w), bounded.diff(x, v, v)) for x in own if x.has(v)]
        ratio = self._ratio(pairs)
        negative = bool(ratio) and bool(speeds)
        negative = negative and all(x.could_extract_minus_sign() for _, x in pairs[: len(speeds)])
        return cast("sp.Rational", sp.Rational(ratio.numerator, ratio.denominator)), negative

    def _ratio(self, pairs: Sequence[tuple[sp.Expr, sp.Expr]]) -> Fraction:
        """The number that all quotients are; 0 if they are none or differ."""
        of = self.sites.ring.of
        if not pairs or any(a == 0 or b == 0 for a, b in pairs):
            return Fraction(0)
        try:
            sums = [(of(a), of(b)) for a, b in pairs]
        except TooLong:
            return Fraction(0)
        first, by = sums[0]
        m = next(iter(by), None)
        ratio = first.get(m, Fraction(0)) / by[m] if m is not None else Fraction(0)
        return ratio if all(a == scaled(b, ratio) for a, b in sums) else Fraction(0)

    def _turning(self, b: Any) -> Iterator[LocalChange]:
        """Another angular velocity; m L² in place of J; an inertia where there is none."""
        omega = self.s.omega(b)
        words: Words = (f"the angular velocity of {b.title}",)
        mass, ring = self.s.expand(b.mass), self.sites.ring
        rates = list(self.s.v)
        if omega and len([w for w in omega if w != 0]) == 1 and b.axes is not None:
            [(axis, right)] = [(k, w) for k, w in enumerate(omega) if w != 0]
            rates += [right] if right not in rates else []
            for instead, cost in self._other_rates(right):
                T = self.gains.of_turning(b, axis, minus(ring.of(instead), ring.of(right)))
                yield from self._gained(b, T, "omega", cost, words, words, right, instead)
            for length in self.lengths:
                yield from self._inertias(b, right, mass * length**2)
        for length in self.lengths:
            full = mass * length**2
            for v in rates:
                where: Words = (f"the kinetic energy of {b.title}",)
                T = self.gains.of_square(full, ring.of(v))
                if T:
                    site = Site(words=where, brief=where, step=2, element=b, T=T)
                    yield LocalChange(
                        kind="inertia_added",
                        cost=2.5,
                        site=site,
                        effect=site,
                        free=True,
                        positive=True,
                        right=full,
                        written=v,
                    )

    def _inertias(self, b: Any, omega: sp.Expr, full: sp.Expr) -> Iterator[LocalChange]:
        ring = self.sites.ring
        square, own = self.gains.of_square(full, ring.of(omega)), ring.of(self.s.rotation(b))
        names: dict[Any, float] = {
            sp.Integer(1): 1.9,
            sp.Rational(1, 2): 2.0,
            sp.Rational(2, 5): 2.2,
            sp.Rational(1, 3): 2.0,
            sp.Rational(1, 12): 2.0,
            sp.Rational(1, 4): 2.3,
            sp.Rational(2, 3): 2.4,
            sp.Rational(4, 3): 2.4,
            sp.Rational(1, 6): 2.4,
            sp.Rational(1, 24): 2.4,
            sp.Rational(1, 48): 2.4,
        }
        words: Words = (f"the moment of inertia of {b.title}",)
        for number, cost in names.items():
            T = minus(scaled(square, Fraction(number.p, number.q)), own) if square is not None else None
            yield from self._gained(b, T, "inertia_form", cost, words, words, None, number * full)

    def _other_rates(self, right: sp.Expr) -> list[tuple[sp.Expr, float]]:
        """Other angular velocities: the right one and a rate too much, likelier than any other."""
        v = self.s.v
        found: list[sp.Expr] = [*v, *(x for a, b in combinations(v, 2) for x in (a + b, a - b))]
        for r in self.lengths[:4]:
            found += [x / r for x in v]
        ratios = [a / b for a in self.lengths[:4] for b in self.lengths[:4] if a != b]
        found += [r * x for r in ratios for x in v]
        found += [replaced(right, {x: sp.S.Zero}) for x in v]
        by = [bounded.diff(right, x) for x in v if right.has(x)]
        more = [right + g * c * x for c in (*by, sp.S.One) for x in v if not right.has(x) for g in (1, -1)]
        rolled = [right + g * x / r for r in self.lengths[:4] for x in v if not right.has(x) for g in (1, -1)]
        turned = [x for x in self._turned(right, v) if len(by) > 1]
        listed = {**dict.fromkeys(found, 1.8), **dict.fromkeys(rolled, 1.7), **dict.fromkeys(turned, 1.5)}
        listed |= {**dict.fromkeys(more, 1.5), **dict.fromkeys(v, 1.45)}
        return [(x, cost) for x, cost in listed.items() if x not in (0, right, -right)]

    def _turned(self, right: sp.Expr, v: Sequence[Any]) -> Iterator[sp.Expr]:
        """An angular velocity with another sign of each rate, begun with the sign of the right one: it is squared."""
        held = [x for x in v if right.has(x)]
        for x in held:
            other = replaced(right, {x: -x})
            yield other if x != held[0] else replaced(right, {w: -w for w in held[1:]})

    # -- what they have in common -------------------------------------------------------------------------------------

    def _kinetic(
        self,
        b: Any,
        new: sp.Expr,
        old: sp.Expr,
        kind: str,
        cost: float,
        words: Words,
        brief: Words,
        right: Any,
        written: Any = None,
    ) -> Iterator[LocalChange]:
        yield from self._gained(b, self.sites.difference(new, old), kind, cost, words, brief, right, written)

    def _gained(
        self, b: Any, T: Sum | None, kind: str, cost: float, words: Words, brief: Words, right: Any, written: Any = None
    ) -> Iterator[LocalChange]:
        """What a kinetic energy gains."""
        if T:
            yield made(kind, cost, Site(words=words, brief=brief, step=2, element=b), {"T": T}, right, written)


def _in(site: Site, what: str, step: int) -> Site:
    words: Words = (f"the {what} of {site.element.title}" if site.element is not None else what,)
    return Site(words=words, brief=words, step=step, element=site.element, body=site.body)
