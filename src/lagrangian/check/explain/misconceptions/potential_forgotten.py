"""L = T*: the potential energy is left out of the Lagrangian."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import Name, text

STEP = 4
WHY = text("The Lagrangian is kinetic minus potential energy; springs and weights act through V.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Drop all of V."""
    if s.moves(s.V):
        yield Variant(what=text(Name("V"), " is missing in ", Name("L"), "."), V=-s.V)
