"""L = T*: the potential energy left out of the Lagrangian."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.check.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import Name, text

STEP = 4
WHY = text("The Lagrangian is kinetic minus potential energy; springs and weights act through V.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """No V at all."""
    if s.moves(s.V):
        yield Variant(what=text(Name("V"), " is missing in ", Name("L"), "."), V=-s.V)
