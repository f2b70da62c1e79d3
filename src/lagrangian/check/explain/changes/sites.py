"""All places of a system's derivation at which a mistake can be made: bodies, weights, springs, forces, terms, rows."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import cached_property
from itertools import combinations
from typing import Any

import sympy as sp

from lagrangian.check.explain.changes import alike
from lagrangian.check.explain.changes.change import Site, Words
from lagrangian.check.explain.changes.ring import Monomial, Sum, SumRing, TooLong, add, minus, plus, scaled, times
from lagrangian.check.explain.misconceptions.base import Ingredients
from lagrangian.model import Damper, Element, time
from lagrangian.page.formula import Name, Partial, Total

MOST_TERMS = 60
"""A part with more terms is changed only as a whole."""


class Sites:
    """The ingredients of a system's equations as sums in one ring, and the sites made of them."""

    def __init__(self, ingredients: Ingredients) -> None:
        self.of = ingredients
        self.model = ingredients.model
        self.ring = SumRing(self.model)
        self.n = ingredients.n

    def sum(self, expr: Any) -> Sum:
        """An expression as a folded sum."""
        return self.ring.fold(self.ring.of(sp.sympify(expr)))

    def difference(self, new: sp.Expr, old: sp.Expr, *, still: bool = False) -> Sum | None:
        """new − old as a sum; None if that is too long. With ``still``, terms that do not move are left out."""
        try:
            found = minus(self.ring.of(self.of.expand(new)), self.ring.of(old))
        except TooLong:
            return None
        return self.ring.moving(found) if still else found

    # -- sums -------------------------------------------------------------------------------------------------------

    @cached_property
    def translations(self) -> dict[Any, Sum]:
        """½ m v² of every body."""
        return {b: self.sum(self.of.translation(b)) for b in self.of.bodies}

    @cached_property
    def rotations(self) -> dict[Any, Sum]:
        """½ ωᵀ I ω of every rigid body that turns."""
        found = {b: self.sum(self.of.rotation(b)) for b in self.of.bodies}
        return {b: x for b, x in found.items() if x}

    @cached_property
    def kinetic(self) -> dict[Any, Sum]:
        """Both together, for every body."""
        return {b: plus(x, self.rotations.get(b, {})) for b, x in self.translations.items()}

    @cached_property
    def all_kinetic(self) -> Sum:
        """T*."""
        return plus(*self.kinetic.values(), *self.others.values())

    @cached_property
    def weights(self) -> dict[Any, tuple[Element, Sum]]:
        """Gravity and m g h of every body; constant heights are left out."""
        found: dict[Any, tuple[Element, Sum]] = {}
        for gravity, body, energy in self.of.weights():
            moving = self.ring.moving(self.sum(energy))
            found[body] = (gravity, plus(found[body][1], moving) if body in found else moving)
        return found

    @cached_property
    def energies(self) -> dict[Element, Sum]:
        """The potential energy of everything else: springs, energies given as they are."""
        heavy = {g for g, _ in self.weights.values()}
        found: dict[Element, Sum] = {}
        for element in self.model.elements:
            if element.ledger == "V" and element not in heavy:
                found[element] = self.ring.moving(self.sum(self.of.expand(element.potential(self.model))))
        return {e: x for e, x in found.items() if x}

    @cached_property
    def others(self) -> dict[Element, Sum]:
        """Kinetic co-energies that are no body's."""
        bodies = set(self.of.bodies)
        kinetic = [e for e in self.model.elements if e.ledger == "T*" and e not in bodies]
        found = {e: self.sum(self.of.kinetic(e)) for e in kinetic}
        return {e: x for e, x in found.items() if x}

    @cached_property
    def shares(self) -> dict[Element, dict[int, Sum]]:
        """What every force, torque and damper adds to every Ξ_i."""
        return {e: {i: self.sum(x) for i, x in self.of.shares(e).items()} for e in self.of.acting}

    def momentum_rates(self, T: Sum, i: int) -> tuple[dict[str, Sum], Sum]:
        """d/dt ∂T/∂ξ̇_i by the motion that makes it, "a" the accelerations or the index k of ξ̇_k, and −∂T/∂ξ_i."""
        ring, s = self.ring, self.of
        p = ring.slope(T, s.v[i])
        parts: dict[str, Sum] = {"a": {}}
        for k in range(self.n):
            add(parts["a"], times(ring.slope(p, s.v[k]), ring.of(s.a[k])))
            moved = times(ring.slope(p, s.q[k]), ring.of(s.v[k]))
            if moved:
                parts[str(k)] = moved
        if explicit := ring.slope(p, time):
            parts["t"] = explicit
        return parts, scaled(ring.slope(T, s.q[i]), -1)

    @cached_property
    def element_rows(self) -> dict[Element, dict[int, Sum]]:
        """The terms of every element in every left-hand side, folded; those of Ξ with the sign that they have there."""
        found: dict[Element, dict[int, Sum]] = {}
        for element, T in [*self.kinetic.items(), *self.others.items()]:
            rows: dict[int, Sum] = {}
            for i in range(self.n):
                parts, slope = self.momentum_rates(T, i)
                rows[i] = self.ring.fold(plus(*parts.values(), slope))
            found[element] = rows
        for gravity, V in self.weights.values():
            self._add_slopes(found, gravity, V)
        for element, V in self.energies.items():
            self._add_slopes(found, element, V)
        for element, shares in self.shares.items():
            found[element] = {i: scaled(x, -1) for i, x in shares.items()}
        return {e: {i: x for i, x in rows.items() if x} for e, rows in found.items()}

    def _add_slopes(self, found: dict[Element, dict[int, Sum]], element: Element, V: Sum) -> None:
        rows = found.setdefault(element, {})
        for i in range(self.n):
            rows[i] = self.ring.fold(plus(rows.get(i, {}), self.ring.slope(V, self.of.q[i])))

    @cached_property
    def rows(self) -> list[Sum]:
        """The left-hand sides of all equations, left minus right, folded."""
        return [self.ring.fold(plus(*[r.get(i, {}) for r in self.element_rows.values()])) for i in range(self.n)]

    # -- sites ------------------------------------------------------------------------------------------------------

    def parts(self) -> Iterator[Site]:
        """Whole parts: what each body, weight, spring and force adds."""
        for b in self.of.bodies:
            yield from self._of_body(b)
        for element, T in self.others.items():
            yield Site(
                words=(f"the kinetic energy of {element.title}",),
                brief=(f"the kinetic energy of {element.title}",),
                step=2,
                element=element,
                T=T,
            )
        for element, V in self.energies.items():
            words = (f"the energy of {element.title}",)
            yield Site(words=words, brief=words, step=3, element=element, V=V)
        for element, shares in self.shares.items():
            words = (f"what {element.title} adds to ", Name("Xi"))
            yield Site(words=words, brief=words, step=6, element=element, Xi=shares)
            if len(shares) > 1:
                for i, x in shares.items():
                    own: Words = (f"what {element.title} adds to the equation of ", self.of.q[i])
                    yield Site(words=own, brief=own, step=6, element=element, coordinate=i, Xi={i: x}, surcharge=0.05)
            yield from alike.all_but_one(element, shares, self.of.q)

    def _of_body(self, b: Any) -> Iterator[Site]:
        title = b.title
        T, J = self.translations[b], self.rotations.get(b, {})
        brief: Words = (f"the kinetic energy of {title}",)
        if T:
            words = (f"the kinetic energy ½mv² of {title}" if J else f"the kinetic energy of {title}",)
            yield Site(words=words, brief=brief, step=2, element=b, T=T, sign_cost=0.9)
        if J:
            words = (f"the kinetic energy of the rotation of {title}",)
            yield Site(words=words, brief=brief, step=2, element=b, T=J, sign_cost=0.9)
        if T and J:
            yield Site(words=brief, brief=brief, step=2, element=b, T=self.kinetic[b], surcharge=0.1, sign_cost=0.9)
        if b in self.weights:
            gravity, V = self.weights[b]
            words = (f"the weight of {title}",)
            yield Site(words=words, brief=words, step=3, element=gravity, V=V, body=title)
            if T or J:
                words = (f"the kinetic energy and the weight of {title}",)
                yield Site(
                    words=words, brief=words, step=2, element=b, T=self.kinetic[b], V=V, surcharge=0.3, sign_cost=0.9
                )

    def wholes(self) -> Iterator[Site]:
        """T*, V, all weights, all springs, and everything together."""
        T = self.all_kinetic
        weights = plus(*[x for _, x in self.weights.values()])
        V = plus(weights, *self.energies.values())
        Xi = {i: plus(*[s[i] for s in self.shares.values() if i in s]) for i in range(self.n)}
        if len(self.translations) + len(self.rotations) + len(self.others) > 1:
            yield Site(words=(Name("T*"),), brief=(Name("T*"),), step=2, T=T, surcharge=0.1)
        yield from alike.products({self.ring.atom(v) for v in self.of.v}, self.kinetic, self.translations)
        yield from alike.bodies(self.of.bodies, self.kinetic, self.translations, self.weights)
        yield from alike.springs(self.energies)
        yield from alike.forces(self.shares, self.of.q)
        if len(self.weights) > 1:
            gravity = next(iter(self.weights.values()))[0]
            words: Words = ("the weights",)
            yield Site(words=words, brief=words, step=3, element=gravity, V=weights, surcharge=0.1)
        if len(self.energies) > 1:
            words = ("the energies of the springs",)
            yield Site(words=words, brief=words, step=3, V=plus(*self.energies.values()), surcharge=0.1)
        if len(self.energies) + len(self.weights) > 1:
            yield Site(words=(Name("V"),), brief=(Name("V"),), step=3, V=V, surcharge=0.15)
        resisting = [self.shares[e] for e in self.of.resisting if e in self.shares]
        if len(resisting) > 1:
            own = {i: plus(*[s[i] for s in resisting if i in s]) for i in range(self.n)}
            dampers = all(isinstance(e, Damper) for e in self.of.resisting if e in self.shares)
            words = (f"what {'the dampers' if dampers else 'all resistances'} add to ", Name("Xi"))
            yield Site(words=words, brief=words, step=6, Xi={i: x for i, x in own.items() if x}, surcharge=0.1)
        if len(self.shares) > 1:
            words = ("the work of all non-conservative forces",)
            yield Site(words=words, brief=words, step=6, Xi={i: x for i, x in Xi.items() if x}, surcharge=0.2)
        words = ("the whole derivation",)
        yield Site(
            words=words, brief=words, step=1, T=T, V=V, Xi={i: x for i, x in Xi.items() if x}, surcharge=0.2, whole=True
        )

    def terms(self) -> Iterator[Site]:
        """Single terms of every part."""
        for site in list(self.parts()):
            if (
                site.only is not None
                or (site.T and site.V)
                or (site.Xi and site.coordinate is None and len(site.Xi) > 1)
            ):
                continue
            for name in ("T", "V"):
                yield from self._terms_of(site, name, getattr(site, name))
            for i, x in site.Xi.items():
                for m, c in x.items() if 1 < len(x) <= MOST_TERMS else ():
                    yield replace(
                        site,
                        Xi={i: {m: c}},
                        words=self._term(m, abs(c), site),
                        coordinate=i,
                        surcharge=0.5,
                        single=True,
                    )

    def _terms_of(self, site: Site, name: str, whole: Sum) -> Iterator[Site]:
        if 2 < len(whole) <= MOST_TERMS:
            for moves in (True, False):
                yield from self._alike(site, name, whole, moves)
        if 1 < len(whole) <= MOST_TERMS:
            for m, c in whole.items():
                changed: Any = {name: {m: c}}
                yield replace(site, **changed, words=self._term(m, c, site), surcharge=0.65, single=True)

    def _alike(self, site: Site, name: str, whole: Sum, moves: bool) -> Iterator[Site]:
        """The terms of one motion, or with the same letters."""
        groups: dict[Monomial, Sum] = {}
        for m, c in whole.items():
            key = tuple((a, e) for a, e in m if self.ring.changes(a) == moves)
            groups.setdefault(key, {})[m] = c
        for key, x in groups.items():
            if key and 1 < len(x) < len(whole):
                changed: Any = {name: x}
                words: Words = ("the terms with ", self.ring.product(key), " of ", *site.words)
                yield replace(site, **changed, words=words, surcharge=0.35)

    def _term(self, m: Monomial, c: Any, site: Site) -> Words:
        return ("the term ", self.ring.expr({m: c}), " of ", *site.words)

    def in_rows(self) -> Iterator[Site]:
        """Parts of single equations: the terms of one motion, of one element, single terms; d/dt and ∂T*/∂ξ."""
        for element, rows in self.element_rows.items():
            for i, x in rows.items():
                if element.ledger == "Ξ" or len(x) > MOST_TERMS:
                    continue
                words: Words = (f"what {element.title} adds to the equation of ", self.of.q[i])
                yield Site(
                    words=words,
                    brief=words,
                    step=5,
                    element=element,
                    coordinate=i,
                    rows={i: x},
                    surcharge=0.4,
                )
        yield from alike.in_rows(self.energies, self.element_rows, self.of.q)
        for i, row in enumerate(self.rows):
            yield from self._of_row(i, row)
            yield from self._derivatives(i)
        yield from self._entries()

    def _entries(self) -> Iterator[Site]:
        """The two equal entries of a symmetric matrix of two coordinates: of ξ̈_j in equation i and of ξ̈_i in j."""
        s = self.of
        for moving in (s.a, s.v, s.q):
            atoms = [self.ring.atom(x) for x in moving]
            for i, j in combinations(range(self.n), 2):
                found = {row: self._alone(row, atoms[by]) for row, by in ((i, j), (j, i))}
                if not all(found.values()):
                    continue
                words: Words = ("the terms with ", moving[j], " in the equation of ", s.q[i], " and with ", moving[i])
                words = (*words, " in that of ", s.q[j])
                brief: Words = ("the equations of ", s.q[i], " and ", s.q[j])
                of_terms = {self.element_of(row, m) for row, x in found.items() for m in x}
                element = of_terms.pop() if len(of_terms) == 1 else None
                yield Site(words=words, brief=brief, step=5, element=element, rows=found, surcharge=0.45)

    def _alone(self, row: int, atom: int) -> Sum:
        """The terms of a row with one moving atom, once, that is no sine's argument, and no other rate."""
        rates = {self.ring.atom(x) for x in (*self.of.v, *self.of.a)} - {atom}
        held = {m: c for m, c in self.rows[row].items() if dict(m).get(atom) == 1}
        return {m: c for m, c in held.items() if not any(a in rates for a, _ in m)}

    def _of_row(self, i: int, row: Sum) -> Iterator[Site]:
        if len(row) > MOST_TERMS:
            return
        brief: Words = ("the equation of ", self.of.q[i])
        groups: dict[Monomial, Sum] = {}
        for m, c in row.items():
            key = tuple((a, e) for a, e in m if self.ring.changes(a))
            groups.setdefault(key, {})[m] = c
            element = self.element_of(i, m)
            words: Words = ("the term ", self.ring.expr({m: c}), " of the equation of ", self.of.q[i])
            own: Words = (
                (f"a term that comes from {element.title} in the equation of ", self.of.q[i])
                if element
                else ("a term of ", *brief)
            )
            yield Site(
                words=words,
                brief=own,
                step=self.step_of(element),
                element=element,
                coordinate=i,
                rows={i: {m: c}},
                surcharge=0.6,
                single=True,
            )
        for key, x in groups.items():
            if key and 1 < len(x) < len(row):
                words = ("the terms with ", self.ring.product(key), " of the equation of ", self.of.q[i])
                ledgers = {e.ledger if (e := self.element_of(i, m)) is not None else None for m in x}
                yield Site(
                    words=words,
                    brief=("the terms of ", *brief),
                    step=6 if ledgers == {"Ξ"} else 5,
                    coordinate=i,
                    rows={i: x},
                    surcharge=0.5,
                )

    def element_of(self, i: int, m: Monomial) -> Element | None:
        """The element from which a term comes, if it is one."""
        found = [e for e, rows in self.element_rows.items() if m in rows.get(i, {})]
        return found[0] if len(found) == 1 else None

    def step_of(self, element: Element | None) -> int:
        """The step in which a single term of an equation is made."""
        return 6 if element is not None and element.ledger == "Ξ" else 5

    def _derivatives(self, i: int) -> Iterator[Site]:
        """The parts of d/dt ∂T*/∂ξ̇_i, and −∂T*/∂ξ_i; of all bodies, then of each."""
        every = [(None, self.all_kinetic)]
        T, q, v = Name("T*"), self.of.q[i], self.of.v[i]
        for body, energy in [*every, *(self.kinetic.items() if len(self.kinetic) > 1 else ())]:
            parts, slope = self.momentum_rates(energy, i)
            extra = 0.0 if body is None else 0.15
            of: Words = () if body is None else (f" of {body.title}",)
            adds: Words = ("what ", *((T,) if body is None else (body.title,)), " adds to the equation of ", q)
            step: dict[str, Any] = {
                "step": 5,
                "element": body,
                "coordinate": i,
                "surcharge": extra,
                "sign_cost": 0.9,
            }
            if slope:
                words: Words = (Partial(T, q), *of)
                yield Site(words=words, brief=adds, rows={i: slope}, **step)
            moved = plus(*[x for k, x in parts.items() if k != "a"])
            for k, x in parts.items():
                if k in ("a", "t") or not x:
                    continue
                rate = self.of.v[int(k)]
                words = ("what ", rate, " adds to ", Total(Partial(T, v)), *of)
                both = all(slope.get(m) == -c for m, c in x.items())
                against: Words = (Partial(T, q), *of) if both else ()
                yield Site(words=words, brief=adds, rows={i: x}, against=against, **step)
            if sum(bool(x) for k, x in parts.items() if k != "a") > 1:
                words = ("what the changing coefficients add to ", Total(Partial(T, v)), *of)
                yield Site(words=words, brief=adds, rows={i: moved}, **step)
            if slope and moved:
                both = self.ring.fold(plus(slope, moved))
                if both:
                    words = ("the velocity terms", *of, " in the equation of ", q)
                    yield Site(words=words, brief=adds, rows={i: both}, **step)
