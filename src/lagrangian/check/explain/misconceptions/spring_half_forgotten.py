"""V = k δ² instead of ½ k δ², so that the force is twice too large."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import text

STEP = 3
WHY = text("The force of a spring is the slope of its energy: is a factor missing in the energy, or one too much?")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """For every spring, and for all of them; also with the factor ½ applied twice."""
    springs = list(s.springs())
    for spring, _, V in springs:
        yield Variant(what=text(f"The ½ in the energy of {spring.title} is missing."), V=V, element=spring)
        yield Variant(
            what=text(f"Half of what {spring.title} adds is missing: its ½ counts twice."), V=-V / 2, element=spring
        )
    if len(springs) > 1:
        yield Variant(
            what=text("The ½ is missing in the energy of every spring."), V=sp.Add(*[V for _, _, V in springs])
        )
