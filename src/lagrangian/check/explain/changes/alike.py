"""Sites of several elements of one kind that go together: bodies of the same mass, the two strands of a belt."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.changes.change import Site, Words
from lagrangian.check.explain.changes.ring import Sum, plus
from lagrangian.check.explain.misconceptions.base import Ingredients, put
from lagrangian.model import Element, time
from lagrangian.page.formula import Name, Partial, Total

MOST_SHARES = 5
"""A force that adds to more equations is not left out of all but one."""


def bodies(
    listed: Sequence[Any],
    kinetic: Mapping[Any, Sum],
    translations: Mapping[Any, Sum],
    weights: Mapping[Any, tuple[Element, Sum]],
) -> Iterator[Site]:
    """Several bodies of the same mass together, if there are others."""
    groups: dict[Any, list[Any]] = {}
    for b in listed:
        groups.setdefault(b.mass, []).append(b)
    for group in groups.values():
        if 1 < len(group) < len(listed):
            names = _names(group)
            words: Words = (f"the kinetic energy of {names}",)
            own = tuple(kinetic[b] for b in group)
            made = {"words": words, "brief": words, "element": group[0], "members": own}
            yield Site(**made, step=2, T=plus(*own), surcharge=0.1, sign_cost=0.9)
            moved = tuple(translations[b] for b in group)
            if moved != own and all(moved):
                words = (f"the kinetic energies ½mv² of {names}",)
                brief = (f"the kinetic energies of {names}",)
                made |= {"words": words, "brief": brief, "members": moved}
                yield Site(**made, step=2, T=plus(*moved), surcharge=0.1, sign_cost=0.9)
            own = tuple(weights[b][1] for b in group if b in weights)
            words = (f"the weights of {names}",)
            made |= {"words": words, "brief": words, "members": own}
            yield Site(**made, step=3, V=plus(*own), surcharge=0.1)


def springs(energies: Mapping[Element, Sum]) -> Iterator[Site]:
    """Springs of the same energy together, if there are others."""
    for group in _of_one_energy(energies):
        words = (f"the energies of {_names(group)}",)
        V = plus(*[energies[e] for e in group])
        yield Site(words=words, brief=words, step=3, element=group[0], V=V, surcharge=0.1)


def in_rows(
    energies: Mapping[Element, Sum], rows: Mapping[Element, Mapping[int, Sum]], q: Sequence[sp.Expr]
) -> Iterator[Site]:
    """What springs of the same energy add to one equation."""
    for group in _of_one_energy(energies):
        for i, coordinate in enumerate(q):
            if x := plus(*[rows[e].get(i, {}) for e in group]):
                words: Words = (f"what {_names(group)} add to the equation of ", coordinate)
                yield Site(words=words, brief=words, step=5, element=group[0], coordinate=i, rows={i: x}, surcharge=0.4)


def forces(shares: Mapping[Element, Mapping[int, Sum]], q: Sequence[sp.Expr]) -> Iterator[Site]:
    """What all forces, torques and dampers add to one equation, if there are several."""
    for i, coordinate in enumerate(q):
        held = [e for e, x in shares.items() if x.get(i)]
        if len(held) > 1:
            names = _names(held) if len(held) == 2 else "all forces"
            words: Words = (f"what {names} add to the equation of ", coordinate)
            own = tuple(shares[e][i] for e in held)
            made = {"words": words, "brief": words, "element": held[0], "members": own}
            yield Site(**made, step=6, coordinate=i, Xi={i: plus(*own)}, surcharge=0.15)


def all_but_one(element: Element, shares: Mapping[int, Sum], q: Sequence[sp.Expr]) -> Iterator[Site]:
    """What a force adds to all equations but one: its reaction, if both of its ends move with several coordinates."""
    if not 2 < len(shares) <= MOST_SHARES:
        return
    for one in shares:
        Xi = {i: x for i, x in shares.items() if i != one}
        listed = [x for i in Xi for x in (q[i], ", ")][:-1]
        listed[-2] = " and "
        words: Words = (f"what {element.title} adds to the equations of ", *listed)
        yield Site(words=words, brief=words, step=6, element=element, Xi=Xi, surcharge=0.1)


def products(rates: set[int], kinetic: Mapping[Any, Sum], translations: Mapping[Any, Sum]) -> Iterator[Site]:
    """The terms with products of different rates in the kinetic energy of a body, and in its ½mv² alone."""
    for b, whole in kinetic.items():
        for energy, what in ((whole, "the kinetic energy"), (translations[b], "½mv²")):
            mixed = {m: c for m, c in energy.items() if sum(a in rates for a, _ in m) > 1}
            if 1 < len(mixed) < len(energy) and (what != "½mv²" or energy != whole):
                words: Words = (f"the products of different rates in {what} of {b.title}",)
                brief: Words = (f"the kinetic energy of {b.title}",)
                yield Site(words=words, brief=brief, step=2, element=b, T=mixed, surcharge=0.2)


def carried(s: Ingredients, difference: Callable[[sp.Expr, sp.Expr], Sum | None]) -> Iterator[Site]:
    """The products m v_P · (v − v_P) in ½mv² of a body whose place is given from a point P that moves as it is given.

    2·a·b of (a + b)²: of the velocity of P, what no rate brings is no product of different rates.
    """
    for b in s.bodies:
        base = [s.rate(x) for x in s.parent(b)]
        if not any(put(x, dict.fromkeys(s.v, sp.S.Zero)) != 0 for x in base):
            continue
        own = [x - y for x, y in zip(s.velocity(b), base, strict=True)]
        mixed = sp.Add(*[x * y for x, y in zip(base, own, strict=True)])
        T = difference(s.expand(b.mass) * mixed, sp.S.Zero)
        if T:
            point = b.at.parent.name or "the point before"
            brief: Words = (f"the kinetic energy of {b.title}",)
            words = f"the products, in ½mv² of {b.title}, of the velocity of {point} and the velocity relative to it"
            yield Site(words=(words,), brief=brief, step=2, element=b, T=T, surcharge=0.2)


def turned_by_time(s: Ingredients, difference: Callable[[sp.Expr, sp.Expr], Sum | None]) -> Iterator[Site]:
    """What the given part of an angle, β(t) of φ − β, adds to d/dt ∂T*/∂ξ̇_i where its sine and cosine are
    differentiated."""
    for i, (p, v) in enumerate(zip(s.momenta, s.v, strict=True)):
        for angle in s.angles(p):
            if not s.is_carried(angle):
                continue
            given = sp.Add(*[x for x in sp.Add.make_args(bounded.expand(angle)) if not x.has(*s.q)])
            mark = sp.Dummy()
            turned = put(bounded.diff(put(p, {f(angle): f(mark) for f in (sp.sin, sp.cos)}), mark), {mark: angle})
            if x := difference(turned * bounded.diff(given, time), sp.S.Zero):
                words: Words = ("what the given motion in ", angle, " adds to ", Total(Partial(Name("T*"), v)))
                brief: Words = ("the equation of ", s.q[i])
                yield Site(words=words, brief=brief, step=5, coordinate=i, rows={i: x}, sign_cost=0.9)


def _of_one_energy(energies: Mapping[Element, Sum]) -> list[list[Element]]:
    groups: dict[frozenset[Any], list[Element]] = {}
    for element, V in energies.items():
        groups.setdefault(frozenset(V.items()), []).append(element)
    return [group for group in groups.values() if 1 < len(group) < len(energies)]


def _names(group: list[Any]) -> str:
    return " and ".join(x.title for x in group)
