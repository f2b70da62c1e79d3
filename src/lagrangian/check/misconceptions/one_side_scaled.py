"""Only one side of an equation is multiplied or divided."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian.check.misconceptions.base import Ingredients, Variant, letters
from lagrangian.page.formula import Name, text

STEP = 5
WHY = text("An equation stays true only when every term on both sides is multiplied by the same factor.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Multiply or divide the inertia terms, or Ξ, of every equation by 2 or by a parameter of its inertia."""
    for i in range(s.n):
        own = s.momenta[i].diff(s.v[i])
        rest = s.rate(s.momenta[i]) - s.T.diff(s.q[i])
        force = s.V.diff(s.q[i]) - s.Xi[i]
        factors: list[sp.Expr] = letters(own)
        factors += [p**2 for p in factors]
        if not s.moves(own):
            factors.append(own)
        for f in dict.fromkeys([*factors, *(1 / f for f in factors), sp.Integer(2), sp.S.Half]):
            if force == 0 or f == 1:
                continue
            what = text("In the equation of ", s.q[i], " only some terms were multiplied by ", f, ".")
            yield Variant(what=what, rows={i: (f - 1) * rest}, coordinate=i, stated=frozenset())
            if s.Xi[i] != 0:
                what = text("In the equation of ", s.q[i], " only ", Name("Xi"), " was multiplied by ", f, ".")
                yield Variant(what=what, Xi={i: (f - 1) * s.Xi[i]}, coordinate=i, stated=frozenset())
