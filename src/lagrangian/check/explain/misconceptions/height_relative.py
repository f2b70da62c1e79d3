"""The height of a child is measured from its parent, which moves."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import text

STEP = 3
WHY = text("The height h is relative to an arbitrary but fixed reference: the whole way from there to the body counts.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """For every body attached to something that moves up or down; and with every coordinate left out of a height."""
    for gravity, body, V in s.weights():
        n = [s.expand(x) for x in gravity.direction]
        carried = sp.Add(*[-a * p for a, p in zip(n, s.parent(body), strict=True)])
        mg = s.expand(body.mass) * s.expand(gravity.g)
        what = text(f"The height of {body.title} is measured from what carries it, which moves itself.")
        if s.moves(carried) and bounded.expand(V - mg * carried) != 0:
            yield Variant(what=what, V=-mg * carried, element=gravity, body=body.title)
        pieces = [x for x in sp.Add.make_args(bounded.expand(V)) if s.moves(x)]
        if len(pieces) > 1:
            for piece in pieces:
                if bounded.expand(piece - mg * carried) != 0:
                    what = text(f"Of the height of {body.title} the part with ", piece / mg, " is missing.")
                    yield Variant(what=what, V=-piece, element=gravity, body=body.title)
