"""Changes of what forces, torques and dampers do: another arm, another equation, another rate in a damper."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import combinations
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.explain.changes.change import LocalChange, Site, Words
from lagrangian.check.explain.changes.ring import Sum, TooLong, minus, scaled
from lagrangian.check.explain.changes.sites import Sites
from lagrangian.check.explain.misconceptions.base import put
from lagrangian.model import Element

MOST_ARMS = 28
NUMBER = 0.95
"""What it costs to forget an arm that is a number, such as 2 of a loose pulley: less than to halve the force."""
GIVEN = 1.0
"""What it costs to leave out of a damper's rate what is given in time: less than to leave out that part of its
force."""
ONE_FACTOR = 0.5
"""What it costs more to take another rate in the force of a damper alone where this shows as one factor, which the arm
may as well lack."""


class WorkChanges:
    """All changes of the generalized forces of a system."""

    def __init__(self, sites: Sites, lengths: Sequence[sp.Symbol], ratios: Sequence[sp.Symbol] = ()) -> None:
        self.sites = sites
        self.s = sites.of
        self.lengths = list(lengths)
        self.ratios = list(ratios)

    def changes(self) -> Iterator[LocalChange]:
        """Every effort with every arm in every equation; shares moved to another equation; other rates in dampers."""
        for element, shares in self.sites.shares.items():
            yield from self._moved(element, shares)
            yield from self._arms(element, shares)
            if element in self.s.resisting:
                yield from self._rates(element)

    def _moved(self, element: Element, shares: dict[int, Sum]) -> Iterator[LocalChange]:
        """A share repeated in an equation that has none, or moved there."""
        for i, x in shares.items():
            for j in range(self.sites.n):
                if j in shares:
                    continue
                words: Words = (f"what {element.title} adds to the equation of ", self.s.q[j])
                site = Site(words=words, brief=words, step=6, element=element, coordinate=j)
                for number in (1, -1):
                    added = scaled(x, number)
                    cost = 2.0 if number == 1 else 2.2
                    yield _change("share_repeated", cost, site, {j: added}, (self.s.q[i],), None)
                    moved = {j: added, i: scaled(x, -1)}
                    yield _change("share_moved", cost - 0.4, site, moved, (self.s.q[i],), None)

    def _arms(self, element: Element, shares: dict[int, Sum]) -> Iterator[LocalChange]:
        """Every effort of an element times every arm, in place of its share or where it has none."""
        ring, arms = self.sites.ring, self.arms
        for effort, right in self._efforts(element, shares):
            yield from self._moved_without_arm(element, shares, effort)
            moved = {arm: ring.of_both(effort, arm) for arm in arms}
            for i in range(self.sites.n):
                words: Words = (f"what {element.title} adds to the equation of ", self.s.q[i])
                added: Words = (f"{element.title} is counted in the equation of ", self.s.q[i])
                site = Site(words=words, brief=words, step=6, element=element, coordinate=i)
                yield from self._half_or_double(effort, right[i], site, i)
                if right[i].is_number and right[i] not in (0, 1, -1) and (extra := self._sum(effort * _unit(right[i]))):
                    yield _change("no_arm", NUMBER, site, {i: extra}, abs(right[i]), None)
                own, number = ring.of_both(effort, right[i]), right[i].is_number and right[i] != 0
                for arm in arms:
                    for sign in (1, -1):
                        if sign * arm == right[i] or (number and arm == 1):
                            continue  # another sign or number is a change of the whole
                        if extra := self._apart(moved[arm], sign, own):
                            place = replace(site, words=added) if right[i] == 0 else site
                            cost = (
                                (1.9 if arm == 1 else 2.1)
                                + (0.0 if sign == 1 else 0.2)
                                + (0.0 if right[i] != 0 else 0.3)
                            )
                            kind = "arm_added" if right[i] == 0 else "no_arm" if sign * arm == 1 else "arm"
                            yield _change(kind, cost, place, {i: extra}, right[i], sign * arm)

    def _apart(self, moved: Sum | None, sign: int, own: Sum | None) -> Sum | None:
        """What a share gains with another arm."""
        if moved is None or own is None:
            return None
        return self.sites.ring.fold(minus(scaled(moved, sign), own))

    def _moved_without_arm(self, element: Element, shares: dict[int, Sum], effort: sp.Expr) -> Iterator[LocalChange]:
        """The effort itself in another equation, in place of the one share that it has."""
        if len(shares) != 1:
            return
        [(i, x)] = shares.items()
        for j in (j for j in range(self.sites.n) if j != i):
            for sign in (1, -1):
                added = self._sum(sign * effort)
                if added and added not in (x, scaled(x, -1)):
                    words: Words = (f"what {element.title} adds to the equation of ", self.s.q[j])
                    site = Site(words=words, brief=words, step=6, element=element, coordinate=j)
                    moved = {j: added, i: scaled(x, -1)}
                    yield _change("share_moved", 1.8 if sign == 1 else 2.0, site, moved, (self.s.q[i],), None)

    def _half_or_double(self, effort: sp.Expr, right: sp.Expr, site: Site, i: int) -> Iterator[LocalChange]:
        """Half an arm and twice an arm that is a length: the force of the middle of a rod, or of its other end."""
        if not right.has(*self.lengths) or self._is_part(effort, site.element):
            return
        for number in (sp.S.Half, sp.Integer(2)):
            if extra := self._sum(effort * (number - 1) * right):
                yield _change("arm", 1.5, site, {i: extra}, right, number * right)

    def _is_part(self, effort: sp.Expr, element: Element | None) -> bool:
        """Whether an effort is a factor of that which an element is given with: half its arm is half of the whole."""
        actions = self.s.actions(element) if element is not None else ()
        return len(actions) == 1 and self.s.expand(actions[0].effort) != effort

    def _efforts(self, element: Element, shares: dict[int, Sum]) -> Iterator[tuple[sp.Expr, list[sp.Expr]]]:
        """The efforts of an element, each with its arm in every equation; one for all components of a vector.

        A force that is given with its arm, F R, is tried as a whole and apart.
        """
        actions = self.s.actions(element)
        if len(actions) == 1:
            rates = [self.s.expand(bounded.diff(actions[0].rate, v)) for v in self.s.v]
            whole, right = self.s.expand(actions[0].effort), [bounded.expand(r) for r in rates]
            yield whole, right
            own = sp.Mul(*[x for x in sp.Mul.make_args(whole) if x in self.lengths])
            if own != 1 and whole.has(*[u.symbol for u in self.s.model.inputs]):
                yield whole / own, [bounded.expand(own * r) for r in right]  # F R is a force with its arm
            return
        ring = self.sites.ring
        held = [
            {a for a, e in m if e == 1 and not isinstance(ring.atoms[a], (sp.sin, sp.cos))}
            for x in shares.values()
            for m in x
        ]
        common = set[int].intersection(*held) if held else set[int]()
        inputs = [ring.atoms[a] for a in common if ring.atoms[a] in {u.symbol for u in self.s.model.inputs}]
        efforts = inputs or [ring.atoms[a] for a in sorted(common) if isinstance(ring.atoms[a], sp.Symbol)][:1]
        for effort in efforts:
            whole = [ring.expr(shares.get(i, {})) for i in range(self.sites.n)]
            yield effort, [bounded.expand(x / effort) for x in whole]

    def _sum(self, expr: sp.Expr) -> Sum | None:
        try:
            return self.sites.sum(expr)
        except TooLong:
            return None

    @property
    def arms(self) -> list[sp.Expr]:
        """1, the lengths, sines and cosines of the system's angles, and both together."""
        every: list[sp.Expr] = [sp.S.One, *self.lengths, *(x for n in self.ratios for x in (n, 1 / n))]
        turned: list[sp.Expr] = []
        for a in self._angles():
            turned += [sp.cos(a), sp.sin(a)]
        every += turned
        every += [r * f for r in self.lengths[:3] for f in turned[:6]]
        every += [1 / r for r in self.lengths[:3]]
        every += [a + b for a, b in combinations(self.lengths[:3], 2)]
        every += [a - b for a, b in combinations(self.lengths[:3], 2)]
        every += [a / b for a in self.lengths[:3] for b in self.lengths[:3] if a != b]
        return list(dict.fromkeys(every))[:MOST_ARMS]

    def _angles(self) -> list[sp.Expr]:
        """The angles that depend on coordinates, then those of inclines and of what is prescribed."""
        energies = self.s.T + self.s.V + sp.Add(*self.s.Xi)
        moving = self.s.angles(energies)
        turned = energies.atoms(sp.sin, sp.cos)
        for body in self.s.bodies:
            turned |= {f for x in self.s.position(body) for f in x.atoms(sp.sin, sp.cos)}
        still = {cast("sp.Expr", f.args[0]) for f in turned if not f.has(AppliedUndef)}
        return [*moving, *sorted(still, key=sp.default_sort_key)]

    def _rates(self, element: Element) -> Iterator[LocalChange]:
        """Another rate in a damper, also in its force alone: a piece left out or with the wrong sign, another rate."""
        for action in self.s.actions(element):
            rate = bounded.expand(self.s.expand(action.rate))
            rate = self.sites.ring.expr(self.sites.sum(rate)) if rate.has(sp.tan) else rate
            effort = self.s.expand(action.effort)
            force = bounded.cancel(-effort / rate) if rate != 0 else None
            if force is None or force.has(*self.s.v):
                continue
            if (factor := _factor(rate)) not in (1, -1):
                Xi = {i: self._sum(x * (1 / factor - 1)) for i, x in self.s.shares(element).items()}
                words: Words = (f"what {element.title} adds to Ξ",)
                site = Site(words=words, brief=words, step=6, element=element)
                yield _change("no_arm", 1.6, site, {i: x for i, x in Xi.items() if x}, factor, None)
            for other, kind, cost in self._other_rates(rate):
                for both in (True, False):
                    found: dict[int, Any] = {}
                    for i, v in enumerate(self.s.v):
                        new = -force * other * bounded.diff(other if both else rate, v)
                        extra = self._sum(new + force * rate * bounded.diff(rate, v))
                        if extra:
                            found[i] = extra
                    if found:
                        words = (f"the rate of {element.title}",)
                        site = Site(words=words, brief=words, step=6, element=element)
                        alone = ONE_FACTOR if not bounded.cancel(rate / other).has(*self.s.v) else 0.3
                        yield _change(kind, cost + (0.0 if both else alone), site, found, rate, other)

    def _other_rates(self, rate: sp.Expr) -> Iterator[tuple[sp.Expr, str, float]]:
        pieces = sp.Add.make_args(rate)
        listed: list[tuple[sp.Expr, str, float]] = []
        if 1 < len(pieces) <= 8:
            for p in pieces:
                left_out = 1.5 if p.has(*self.s.v) else GIVEN
                listed += [(rate - p, "rate_left_out", left_out), (rate - 2 * p, "rate_sign_in_damper", 1.6)]
        v = self.s.v
        if (factor := _factor(rate)).free_symbols:
            listed.append((bounded.expand(rate / factor), "damper_rate", 1.7))
        listed += [(x, "damper_rate", 2.0) for x in v]
        listed += [(x, "damper_rate", 2.1) for a, b in combinations(v, 2) for x in (a - b, a + b)]
        for a in v:
            listed += [(put(rate, {a: x}), "damper_rate", 2.0) for b in v if b != a for x in (b, a + b, a - b)]
        for p in self.s.model.parameters:
            if rate.has(p.symbol):
                listed.append((put(rate, {p.symbol: sp.S.One}), "damper_rate", 2.0))
        carried = [self.s.rate(x) for x in self.s.driven]
        listed += [(rate + g * x, "damper_rate", 1.9) for x in carried for g in (1, -1)]
        seen: set[sp.Expr] = {sp.S.Zero, rate, -rate}
        for other, kind, cost in sorted(listed, key=lambda x: x[2]):
            if other not in seen:
                seen.add(other)
                yield other, kind, cost


def _unit(arm: sp.Expr) -> sp.Expr:
    """What an arm that is a number lacks if only its sign is counted."""
    return cast("sp.Expr", sp.sign(arm) - arm)


def _factor(rate: sp.Expr) -> sp.Expr:
    """The factor of letters that all pieces of a sum have, such as R/r of R α̇/r − R β̇/r; 1 for one piece."""
    pieces = sp.Add.make_args(rate)
    common = set.intersection(*[set(sp.Mul.make_args(p)) for p in pieces]) if len(pieces) > 1 else set[sp.Basic]()
    return cast("sp.Expr", sp.Mul(*[x for x in common if isinstance(x, sp.Expr) and not x.has(AppliedUndef)]))


def _change(kind: str, cost: float, site: Site, Xi: dict[int, Sum], right: Any, written: Any) -> LocalChange:
    effect = Site(words=site.words, brief=site.brief, step=6, element=site.element, coordinate=site.coordinate, Xi=Xi)
    return LocalChange(kind=kind, cost=cost, site=site, effect=effect, right=right, written=written)
