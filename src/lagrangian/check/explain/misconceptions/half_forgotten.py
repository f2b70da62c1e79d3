"""T* = m v² instead of ½ m v²."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import Name, text

STEP = 2
WHY = text(
    "The kinetic co-energy is one half of the mass times the velocity squared, plus one half of J times the "
    "angular velocity squared."
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """For every body, for its translation and its rotation separately, and for all bodies."""
    for body in s.bodies:
        translation, rotation = s.translation(body), s.rotation(body)
        if rotation != 0:
            what = text(f"The ½ of ½Jω² of {body.title} is missing.")
            yield Variant(what=what, T=rotation, element=body)
        mass = s.expand(body.mass)
        inertia: Any = bounded.expand(rotation).coeff(mass) if mass.is_Symbol else sp.S.Zero
        if inertia.could_extract_minus_sign():
            continue  # J about the pivot, less what ½mv² has: nobody writes either
        what = text(f"The ½ of ½mv² of {body.title} is missing.")
        yield Variant(what=what, T=translation, element=body)
        if rotation != 0:
            what = text("The ½ of ", Name("T*"), f" of {body.title} is missing.")
            yield Variant(what=what, T=translation + rotation, element=body)
    if len(s.bodies) > 1 or any(x != 0 for x in (s.V, *s.Xi)):
        yield Variant(what=text("The ½ is missing in every kinetic energy."), T=s.T + sp.S.Zero)
