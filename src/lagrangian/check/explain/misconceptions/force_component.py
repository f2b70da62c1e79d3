"""A force is counted completely although only one component does work, or a component is left out."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, Variant, put
from lagrangian.page.formula import text

STEP = 6
WHY = text(
    "Only the part of a force along the motion does work: F times the cosine of the angle between them, times the "
    "distance."
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Drop the sines and cosines of every contribution, and drop one of its terms."""
    for element in s.acting:
        for i, x in s.shares(element).items():
            trig = dict.fromkeys(x.atoms(sp.sin, sp.cos), sp.S.One)
            what = text(f"{element.title[:1].upper() + element.title[1:]} is counted whole, whatever its direction.")
            if not trig:
                continue
            yield Variant(what=what, Xi={i: put(x, trig) - x}, element=element, coordinate=i)
            pieces = sp.Add.make_args(bounded.expand(x))
            for piece in pieces if len(pieces) > 1 else ():
                what = text("The part ", piece, f" of what {element.title} adds is missing.")
                yield Variant(what=what, Xi={i: -piece}, element=element, coordinate=i)
