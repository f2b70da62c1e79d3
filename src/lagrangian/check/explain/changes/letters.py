"""Changes of one letter, function or rate at a site: another one, lost, not squared, of another angle."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction
from functools import cached_property
from itertools import combinations
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.explain.changes.change import LocalChange, Site
from lagrangian.check.explain.changes.ring import Monomial, Sum, TooLong, exponent, minus, plus, put, raised, scaled
from lagrangian.check.explain.changes.sites import Sites
from lagrangian.check.explain.misconceptions.base import partner
from lagrangian.model import Damper
from lagrangian.values.dimensions import LENGTH

MOST_ANGLES = 10
"""The largest number of angles that are tried in place of another."""
FEWEST_GONE = 2
"""The fewest letters of a factor that is gone as a whole."""
RATE = 1.2
"""What it costs more to leave out a letter without which a whole rate is gone: that rate is what was left out."""


class LetterChanges:
    """What may stand in place of each atom of a system: the sum that replaces it, the kind of the change, its cost."""

    def __init__(self, sites: Sites) -> None:
        self.sites = sites
        self.ring = sites.ring
        self.model = sites.model
        self._found: dict[int, list[tuple[Sum, str, float]]] = {}
        self._alike: dict[sp.Symbol, list[sp.Symbol]] = {}
        self._written: dict[tuple[int, int], sp.Expr] = {}
        self._powered: dict[tuple[sp.Expr, int], sp.Expr] = {}
        self._gained: dict[tuple[Monomial, int, int], list[tuple[Monomial, Fraction | int]]] = {}

    def changes(self, places: Iterable[Site]) -> Iterator[LocalChange]:
        """All changes of one atom at every site."""
        for site in places:
            for atom in site.shared_atoms():
                yield from self._at(site, atom)

    def exchanges(self, places: Iterable[Site]) -> Iterator[LocalChange]:
        """Two letters exchanged with each other, at every site that holds both."""
        for site in places:
            held = [a for a in site.atoms() if isinstance(self.ring.atoms[a], sp.Symbol)]
            for a, b in combinations(held, 2):
                p, q = self.ring.atoms[a], self.ring.atoms[b]
                if q not in self.alike(p):  # type: ignore[arg-type]
                    continue
                effect = site.changed(lambda s, a=a, b=b: {_exchanged(m, a, b): c for m, c in s.items()})
                if _is_of_whole(site, effect):
                    yield LocalChange(
                        kind="exchanged", cost=1.9 + site.surcharge, site=site, effect=effect, right=p, written=q
                    )

    def _at(self, site: Site, atom: int) -> Iterator[LocalChange]:
        right = self.ring.atoms[atom]
        exponents = {exponent(m, atom) for s in site.sums() for m in s}
        for k, (instead, kind, cost) in enumerate(self.instead(atom)):
            effect = self._put(site, atom, k, instead)
            if effect is None:
                continue
            if (atom, k) not in self._written:
                self._written[atom, k] = self.ring.expr(instead)
            ratio = self._ratio(site, atom, self._written[atom, k]) if kind == "letter" else None
            if ratio is not None:
                yield LocalChange(
                    kind="factor_missing", cost=cost + site.surcharge, site=site, effect=effect, written=ratio
                )
                continue
            if kind == "lost" and 0 in exponents:  # without a rate, a sum of rates has it nowhere
                kind = "left_out_of_a_sum" if isinstance(right, sp.Derivative) else "lost_in_a_sum"
            times = exponents - {0} if kind.startswith("lost") else set[int]()
            yield LocalChange(
                kind=kind,
                cost=cost + site.surcharge,
                site=site,
                effect=effect,
                right=self._power(right, times.pop() if len(times) == 1 else -1 if times and max(times) < 0 else 1),
                written=self._written[atom, k],
            )
        yield from self._powers(site, atom, exponents)
        if 0 in exponents and isinstance(right, sp.Symbol) and not self._is_of_one_ledger(site, atom):
            for number, kind, cost in ((0, "left_out_of_a_sum", 1.5), (-1, "sign_in_a_sum", 1.7)):
                effect = self._put(site, atom, number - 1, scaled({((atom, 1),): Fraction(1)}, number))
                if effect is not None and number == 0 and (gone := self._factor_gone(site, effect)) is not None:
                    more = cost + site.surcharge
                    yield LocalChange(kind="factor_missing", cost=more, site=site, effect=effect, written=gone)
                elif effect is not None:
                    one = 0.5 if number == -1 and max(map(len, effect.sums())) == 1 else 0.0  # then the term has it
                    more = cost + one + site.surcharge + (RATE if number == 0 and self._holds_rate(site, atom) else 0.0)
                    yield LocalChange(kind=kind, cost=more, site=site, effect=effect, right=right)

    def _ratio(self, site: Site, atom: int, other: sp.Expr) -> sp.Expr | None:
        """The ratio that is gone if another letter, by which an atom is divided or which it divides, stands in its
        place: then no such letter is left that could stand there."""
        if not isinstance(self.ring.atoms[atom], sp.Symbol) or not isinstance(other, sp.Symbol):
            return None
        own = self.ring.atom(other)
        pairs = {(exponent(m, atom), exponent(m, own)) for s in site.sums() for m in s}
        pairs = {(a, b) for a, b in pairs if a}
        if not pairs or any(a * b >= 0 or abs(a) > abs(b) for a, b in pairs):
            return None
        times = {a for a, _ in pairs}
        return (self.ring.atoms[atom] / other) ** min(times, key=abs) if len(times) == 1 else None

    def _factor_gone(self, site: Site, effect: Site) -> sp.Expr | None:
        """The whole factor, (R − r)²/r², that goes with one letter of it; None if what is left has letters of it."""
        gone: set[sp.Expr] = set()
        for whole, change in zip(site.sums(), effect.sums(), strict=True):
            if not whole:
                continue
            left = plus(whole, change)
            vanished = {k for m in whole for k, _ in m} - {k for m in left for k, _ in m}
            letters = {x for k in vanished if isinstance(x := self.ring.atoms[k], sp.Symbol)}
            if not left or len(letters) < FEWEST_GONE or len(letters) < len(vanished):
                return None
            ratio = bounded.cancel(self.ring.expr(whole) / self.ring.expr(left))
            if not ratio.free_symbols or not ratio.free_symbols <= letters or ratio.atoms(AppliedUndef):
                return None
            gone.add(bounded.factored(ratio) or ratio)
        return gone.pop() if len(gone) == 1 else None

    def _is_of_one_ledger(self, site: Site, atom: int) -> bool:
        """Whether all of V, of T* or of Ξ has a letter and nothing else: without g, a kinetic energy and a weight are
        the kinetic energy alone."""
        held = [[atom in dict(m) for m in s] for s in (site.T, site.V, *site.Xi.values()) if s]
        return len(held) > 1 and any(all(x) for x in held) and all(all(x) or not any(x) for x in held)

    def _holds_rate(self, site: Site, atom: int) -> bool:
        """Whether a rate stands in T* only beside a letter: L θ̇ of (L θ̇ + ż)², so that who leaves out L leaves out the
        rate."""
        rates = {k for m in site.T for k, _ in m if isinstance(self.ring.atoms[k], sp.Derivative)}
        return any(all(exponent(m, atom) for m in site.T if exponent(m, k)) for k in rates)

    def _powers(self, site: Site, atom: int, exponents: set[int]) -> Iterator[LocalChange]:
        """The square of an atom for the atom, and the other way round."""
        if max(exponents) == 2:

            def once(s: Sum) -> Sum:
                return {_with(m, atom, 1) if exponent(m, atom) == 2 else m: c for m, c in s.items()}

            yield from self._of(site, once, "not_squared", 1.6, atom)
        if exponents <= {0, 1} and not isinstance(self.ring.atoms[atom], sp.Derivative):

            def twice(s: Sum) -> Sum:
                return {_with(m, atom, 2) if exponent(m, atom) == 1 else m: c for m, c in s.items()}

            turned = isinstance(self.ring.atoms[atom], (sp.sin, sp.cos))
            yield from self._of(site, twice, "squared", 3.4 if turned else 2.4, atom)

    def _of(self, site: Site, change: object, kind: str, cost: float, atom: int) -> Iterator[LocalChange]:
        effect = site.changed(change)  # type: ignore[arg-type]
        if _is_of_whole(site, effect):
            yield LocalChange(
                kind=kind, cost=cost + site.surcharge, site=site, effect=effect, right=self.ring.atoms[atom]
            )

    def _put(self, site: Site, atom: int, place: int, instead: Sum) -> Site | None:
        """What a site gains with ``instead`` in place of an atom; ``place`` numbers what stands instead of this atom.

        What a monomial gains is found once: the same monomials stand in many sites.
        """
        known, one = self._gained, Fraction(1)

        def gained(s: Sum) -> Sum:
            total: Sum = {}
            for m, c in s.items():
                key = (m, atom, place)
                if key not in known:
                    known[key] = list(minus(put({m: one}, atom, instead), {m: one}).items())
                for new, number in known[key]:
                    value = c if number == 1 else -c if number == -1 else c * number
                    if new in total:
                        value += total[new]
                    if value:
                        total[new] = value
                    else:
                        del total[new]
            return total

        try:
            effect = site.gaining(gained)
        except TooLong:
            return None
        return effect if _is_of_whole(site, effect) else None

    # -- what may stand instead --------------------------------------------------------------------------------------

    def instead(self, atom: int) -> list[tuple[Sum, str, float]]:
        """What may stand in place of an atom."""
        if atom not in self._found:
            expr = self.ring.atoms[atom]
            listed = [(self.ring.of(x), kind, cost) for x, kind, cost in self._listed(expr)]
            self._found[atom] = [(s, kind, cost) for s, kind, cost in listed if s]
        return self._found[atom]

    def _listed(self, expr: sp.Expr) -> Iterator[tuple[sp.Expr, str, float]]:
        if isinstance(expr, sp.Symbol):
            for other in self.alike(expr):
                yield other, "letter", 2.0
            yield sp.S.One, "lost", 1.7
            yield 1 / expr, "inverted", 2.8
        elif isinstance(expr, (sp.sin, sp.cos)):
            yield from self._turned(expr)
        elif isinstance(expr, sp.Derivative):
            order = 2 if expr in self.sites.of.a else 1
            for other in self.sites.of.a if order == 2 else self.sites.of.v:
                if other != expr:
                    yield other, "acceleration" if order == 2 else "rate", 2.2
            if order == 1:
                yield sp.S.One, "lost", 2.0
        elif isinstance(expr, AppliedUndef):
            others = (
                [x for x in self.sites.of.q if x != expr]
                if expr in self.sites.of.q
                else [u.symbol for u in self.model.inputs if u.symbol != expr]
            )
            for other in others:
                yield other, "letter", 2.2
            if expr in self.sites.of.q:
                yield sp.S.One, "lost", 2.0
                for length in self.lengths:
                    yield length, "letter", 2.4
        elif isinstance(expr, sp.Pow):
            yield sp.S.One, "lost", 2.4

    def _turned(self, expr: sp.Expr) -> Iterator[tuple[sp.Expr, str, float]]:
        """What may stand in place of a sine or cosine."""
        function: Any = type(expr)
        angle: Any = expr.args[0]
        yield partner(expr), "sine_cosine", 1.8
        yield -partner(expr), "sine_cosine", 2.1
        yield sp.S.One, "lost", 1.9
        for wrong in self.angles_for(angle):
            yield (
                function(wrong),
                "angle",
                1.55 if len(sp.Add.make_args(wrong)) == len(sp.Add.make_args(angle)) else 1.9,
            )
        yield (angle, "small_angle", 2.2) if function is sp.sin else (sp.S.One, "small_angle", 2.4)
        yield function(2 * angle), "double_angle", 2.6
        yield function(angle / 2), "double_angle", 2.8
        yield sp.tan(angle), "tangent", 2.3

    def angles_for(self, angle: sp.Expr) -> list[sp.Expr]:
        """Other angles that may be taken for one: parts of it, with other signs, and the others of the system."""
        parts = list(sp.Add.make_args(bounded.expand(angle)))
        found: list[sp.Expr] = []
        if len(parts) > 1:
            found += [angle - p for p in parts]
            found += [angle - 2 * p for p in parts]
        for x in self.turning:
            if not angle.has(x):
                found += [x, angle + x, angle - x]
        found += [x for x in self.every_angle if x not in (angle, -angle)]
        for p in self.fixed_angles:
            if not angle.has(p):
                found += [p, angle + p, angle - p]
        return [x for x in dict.fromkeys(found) if x not in (0, angle, -angle) and not x.is_number][:MOST_ANGLES]

    @cached_property
    def every_angle(self) -> list[sp.Expr]:
        """The angles of all sines and cosines of the system, and sums and differences of those that turn."""
        found = [a.args[0] for a in self.ring.atoms if isinstance(a, (sp.sin, sp.cos))]
        found += [s for p, q in combinations(self.turning, 2) for s in (p - q, p + q)]
        return list(dict.fromkeys(x for x in found if x in self._angles or x.free_symbols))  # type: ignore[misc]

    @cached_property
    def _angles(self) -> set[sp.Expr]:
        return set(self.sites.of.angles(self.sites.of.T + self.sites.of.V + sp.Add(*self.sites.of.Xi)))

    @cached_property
    def turning(self) -> list[sp.Expr]:
        """The coordinates inside sines and cosines."""
        return [q for q in self.sites.of.q if any(a.has(q) for a in self._angles)]

    @cached_property
    def fixed_angles(self) -> list[sp.Symbol]:
        """The parameters inside sines and cosines."""
        symbols = [p.symbol for p in self.model.parameters]
        energy = self.sites.of.T + self.sites.of.V + sp.Add(*self.sites.of.Xi)
        every: list[Any] = [f.args[0] for f in energy.atoms(sp.sin, sp.cos)]
        return [p for p in symbols if any(a.coeff(p).is_number and a.coeff(p) != 0 for a in every)]

    @cached_property
    def _kinds(self) -> dict[sp.Symbol, object]:
        """What decides which parameters may be taken for each other: the unit if it is known, else the first letter."""
        dims = self.sites.of.dimensions
        found: dict[sp.Symbol, object] = {}
        for p in self.model.parameters:
            dim = dims.of(p.symbol) if dims is not None else None
            found[p.symbol] = dim.known if dim is not None and not dim.unknown else p.name[0].lower()
        return found

    def alike(self, symbol: sp.Symbol) -> list[sp.Symbol]:
        """The parameters that may be taken for one."""
        if symbol not in self._alike:
            self._alike[symbol] = self._alike_found(symbol)
        return self._alike[symbol]

    def _alike_found(self, symbol: sp.Symbol) -> list[sp.Symbol]:
        if symbol not in self._kinds:
            return []
        own = self._kinds[symbol]
        letter = str(symbol)[0].lower()
        role = next((r for r in self._roles if symbol in r), frozenset[sp.Symbol]())
        return [
            p
            for p, kind in self._kinds.items()
            if p != symbol and (kind == own or str(p)[0].lower() == letter or p in role)
        ]

    @cached_property
    def _roles(self) -> list[frozenset[sp.Symbol]]:
        """Letters that play the same part: those of the bodies, of the springs, of the dampers."""
        s = self.sites.of
        known = {p.symbol for p in self.model.parameters}
        constants: list[list[Any]] = [[b.mass for b in s.bodies], [k.k for k, _, _ in s.springs() if k.k is not None]]
        constants.append([e.b for e in s.resisting if isinstance(e, Damper) and e.b is not None])
        return [frozenset(x for x in group if x in known) for group in constants]

    @cached_property
    def lengths(self) -> list[sp.Symbol]:
        """The parameters that are lengths, as far as the units are known."""
        dims = self.sites.of.dimensions
        if dims is None:
            return [p.symbol for p in self.model.parameters if p.name[0].lower() in "lrdhabse"]
        found: list[sp.Symbol] = []
        for p in self.model.parameters:
            dim = dims.of(p.symbol)
            if dim is not None and not dim.unknown and dim.known == LENGTH.known:
                found.append(p.symbol)
        return found

    def factors(self, places: Iterable[Site]) -> Iterator[LocalChange]:
        """A length too much or too little, once or squared, in every site; a cosine below a fraction line."""
        for site in places:
            yield from self._divisors(site)
            for p in (*self.lengths, *self.sites.of.ratios):
                a = self.ring.atom(p)
                powers = {exponent(m, a) for s in site.sums() for m in s}
                held, most = min(powers, default=0), max(powers, default=0)
                for e in (1, -1, 2, -2):
                    effect = site.changed(lambda s, a=a, e=e: {raised(m, a, e): c for m, c in s.items()})
                    cost = (1.9 if abs(e) == 1 else 2.2) + site.surcharge
                    yield LocalChange(
                        kind=("divisor_missing" if most <= -e else "foreign_factor")
                        if e > 0
                        else ("factor_missing" if held >= -e else "divided_by"),
                        cost=cost,
                        site=site,
                        effect=effect,
                        right=p,
                        written=self._power(p, abs(e)),
                    )

    def _divisors(self, site: Site) -> Iterator[LocalChange]:
        """1/cos θ once, twice or squared too much or too little, where it stands."""
        for a in site.atoms():
            if not isinstance(self.ring.atoms[a], sp.cos) or max(exponent(m, a) for s in site.sums() for m in s) >= 0:
                continue
            for e in (1, 2, -1, -2):
                effect = site.changed(lambda s, a=a, e=e: {raised(m, a, e): c for m, c in s.items()})
                kind = "foreign_factor" if e < 0 else "factor_missing"
                written = self._power(self.ring.atoms[a], -abs(e))
                yield LocalChange(kind=kind, cost=1.8 + site.surcharge, site=site, effect=effect, written=written)

    def _power(self, base: sp.Expr, times: int) -> sp.Expr:
        """A power of a letter or of another atom, which is made once: it stands in the words of many changes."""
        if (base, times) not in self._powered:
            self._powered[base, times] = base**times
        return self._powered[base, times]


def _is_of_whole(site: Site, effect: Site) -> bool:
    """Whether a change does something in two of T*, V and Ξ where a site names both energies, and else not in both
    energies: what changes the weight alone of "the kinetic energy and the weight" a narrower site has."""
    if effect.empty:
        return False
    if site.T and site.V:
        return sum(map(bool, (effect.T, effect.V, any(effect.Xi.values())))) >= 2
    return not (effect.T and effect.V)


def _exchanged(m: tuple[tuple[int, int], ...], a: int, b: int) -> tuple[tuple[int, int], ...]:
    table = {a: b, b: a}
    return tuple(sorted((table.get(x, x), e) for x, e in m))


def _with(m: tuple[tuple[int, int], ...], atom: int, exponent: int) -> tuple[tuple[int, int], ...]:
    return tuple((a, exponent if a == atom else e) for a, e in m)
