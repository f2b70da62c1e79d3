"""Two parameters of the same kind are confused: L₁ for L₂, k₁ for k₂."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, Variant, put
from lagrangian.page.formula import Name, text

STEP = 2
WHY = text("Every element has its own length, stiffness or damping; keep to the letters of the sketch.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """For every pair of parameters with the same first letter: exchange them everywhere, or use one for the other."""
    symbols = [p.symbol for p in s.model.parameters]
    for p, q in combinations(symbols, 2):
        if p.name[0].lower() != q.name[0].lower():
            continue
        both = {p: q, q: p}
        yield _put(s, both, text(p, " and ", q, " are exchanged."))
        for a, b in ((p, q), (q, p)):
            yield _put(s, {a: b}, text(b, " stands in place of ", a, "."))
            for part in ("T", "V"):
                energy = s.T if part == "T" else s.V
                change = put(energy, {a: b}) - energy
                if change == 0:
                    continue
                what = text(b, " stands in place of ", a, " in ", Name("T*" if part == "T" else "V"), ".")
                gone = int(not put(energy, {a: b}).has(b))  # r₂ for r₁ in (r₁/r₂)²: rather the ratio was forgotten
                yield (
                    Variant(what=what, T=change, doubt=gone)
                    if part == "T"
                    else Variant(what=what, V=change, doubt=gone)
                )
            yield from _in_elements(s, a, b)


def _put(s: Ingredients, table: dict[sp.Symbol, sp.Symbol], what: object) -> Variant:
    forces = {i: put(x, table) - x for i, x in enumerate(s.Xi) if put(x, table) != x}
    return Variant(what=what, T=put(s.T, table) - s.T, V=put(s.V, table) - s.V, Xi=forces)  # type: ignore[arg-type]


def _in_elements(s: Ingredients, a: sp.Symbol, b: sp.Symbol) -> Iterator[Variant]:
    for element in s.model.elements:
        T = s.kinetic(element)
        V = s.expand(element.potential(s.model))
        what = text(b, " stands in place of ", a, f" in {element.title}.")
        in_T, in_V = put(T, {a: b}), put(V, {a: b})
        if T.has(a):
            yield Variant(what=what, T=in_T - T, element=element, doubt=int(not in_T.has(b)))
        if V.has(a):
            yield Variant(what=what, V=in_V - V, element=element, doubt=int(not in_V.has(b)))
        if element.ledger == "Ξ":
            shares = s.shares(element)
            changed = {i: put(x, {a: b}) - x for i, x in shares.items() if x.has(a)}
            if changed:
                gone = int(not any(bounded.expand(put(x, {a: b})).has(b) for x in shares.values()))
                yield Variant(what=what, Xi=changed, element=element, doubt=gone)
