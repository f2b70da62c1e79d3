"""T* = m v² in place of ½ m v²."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian.check.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import Name, text

STEP = 2
WHY = text("Kinetic energy is one-half mass times velocity-squared, and one-half J times angular velocity squared.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Every body, its translation and its rotation apart, and all together."""
    for body in s.bodies:
        translation, rotation = s.translation(body), s.rotation(body)
        if rotation != 0:
            what = text(f"The ½ of ½Jω² of {body.title} is missing.")
            yield Variant(what=what, T=rotation, element=body)
        what = text(f"The ½ of ½mv² of {body.title} is missing.")
        yield Variant(what=what, T=translation, element=body)
        if rotation != 0:
            what = text("The ½ of ", Name("T*"), f" of {body.title} is missing.")
            yield Variant(what=what, T=translation + rotation, element=body)
    if len(s.bodies) > 1 or any(x != 0 for x in (s.V, *s.Xi)):
        yield Variant(what=text("The ½ of every energy of motion is missing."), T=s.T + sp.S.Zero)
