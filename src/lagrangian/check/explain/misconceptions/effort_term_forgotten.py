"""One term of a force or torque is left out, such as the back-EMF of a motor."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import text

STEP = 6
WHY = text(
    "Every term of a force acts on the motion: a motor that turns also takes away the torque of its back-EMF, "
    "and a term in a rate is a force as well."
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Drop one term of every contribution, unless the term is only a component."""
    for element in s.acting:
        for i, x in s.shares(element).items():
            pieces = sp.Add.make_args(bounded.expand(x))
            for piece in pieces if len(pieces) > 1 and not x.has(sp.sin, sp.cos, sp.tan) else ():
                what = text("The term ", piece, f" of what {element.title} adds is forgotten.")
                yield Variant(what=what, Xi={i: -piece}, element=element, coordinate=i)
