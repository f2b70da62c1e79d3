"""sin θ is replaced by θ, which gives only the equations of small motions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, Variant, put
from lagrangian.page.formula import Text, text

STEP = 5
WHY = text("A sine is nearly its angle, and a cosine 1, only near zero; the equations of motion hold everywhere.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """In V, in all equations completely, and with products of small quantities dropped."""
    what = _said("", s)
    table = {f: small(f, quadratic=True) for f in s.V.atoms(sp.sin, sp.cos) if s.moves(f)}
    if table:
        yield Variant(what=what, V=put(s.V, table) - s.V)
        if any(isinstance(f, sp.sin) for f in table):  # cos θ = 1 in V leaves the weight out
            yield Variant(what=what, V=put(s.V, {f: small(f) for f in table}) - s.V)
        for kind in (sp.sin, sp.cos):
            some = {f: x for f, x in table.items() if isinstance(f, kind)}
            if 0 < len(some) < len(table):
                yield Variant(what=what, V=put(s.V, some) - s.V)
        yield from _of_one(s, table)
    rows = [s.expand(e.lhs) - s.expand(e.rhs) for e in s.derivation.equations]
    replaced = {f: small(f) for row in rows for f in row.atoms(sp.sin, sp.cos) if s.moves(f)}
    if not replaced:
        return
    changed = [put(row, replaced) for row in rows]
    yield Variant(what=what, rows={i: c - r for i, (c, r) in enumerate(zip(changed, rows, strict=True))})
    linear = first_order(changed, (*s.q, *s.v, *s.a))
    if linear is None:
        return
    yield Variant(what=what, rows={i: c - r for i, (c, r) in enumerate(zip(linear, rows, strict=True))})


def _of_one(s: Ingredients, table: Mapping[Any, sp.Expr]) -> Iterator[Variant]:
    """In the energy of one spring alone, if others hold angles, too."""
    held = [(spring, V) for spring, _, V in s.springs() if V.has(*table)]
    for spring, V in held if len(held) + len(list(s.weights())) > 1 else ():
        what = _said(f"In the energy of {spring.title}, ", s)
        yield Variant(what=what, V=put(V, table) - V, element=spring)
        sines = {f: x for f, x in table.items() if isinstance(f, sp.sin)}
        if V.has(*sines) and len(sines) < len(table):
            yield Variant(what=what, V=put(V, sines) - V, element=spring)


def _said(where: str, s: Ingredients) -> Text:
    """What was done, with the angle if the system has one alone."""
    angles = [q for q in s.q if any(a.has(q) for a in (*s.angles(s.V), *s.angles(s.T)))]
    if len(angles) != 1:
        what = "a sine was replaced by its angle, as if the motion were small."
        return text(where + what if where else what.capitalize())
    begins = (where,) if where else ()
    return text(*begins, sp.sin(angles[0]), " was replaced by ", angles[0], ", as if the motion were small.")


def small(f: sp.Expr, *, quadratic: bool = False) -> sp.Expr:
    """What a sine or cosine is near 0."""
    angle = f.args[0]
    if isinstance(f, sp.sin):
        return sp.S.One * angle  # type: ignore[return-value]
    return 1 - angle**2 / 2 if quadratic else sp.S.One  # type: ignore[operator]


def first_order(rows: Sequence[sp.Expr], moving: Iterable[sp.Expr]) -> list[sp.Expr] | None:
    """The parts up to first order in coordinates, rates and accelerations, all of them in ``moving``.

    None where the rows have no value at 0: 1/r² is of no order in r.
    """
    e = sp.Dummy("e")
    table = {x: e * x for x in moving}
    scaled = [put(row, table) for row in rows]
    found = [put(x, {e: sp.S.Zero}) + put(bounded.diff(x, e), {e: sp.S.Zero}) for x in scaled]
    return None if any(x.has(sp.zoo, sp.nan, sp.oo, -sp.oo) for x in found) else found
