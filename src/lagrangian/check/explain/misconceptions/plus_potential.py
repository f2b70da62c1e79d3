"""L = T* + V."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import Minus, Name, Terms, text

STEP = 4
WHY = text("The Lagrangian is kinetic minus potential energy.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Reverse the whole of V; of the stated lines, only L shows it. Of one spring or weight that is rather said."""
    if s.moves(s.V):
        parts = [*s.weights(), *s.springs()]
        right = Terms((Name("T*"), Minus(Name("V"))))
        what = text("You took ", Name("L"), " = ", Terms((Name("T*"), Name("V"))), " in place of ", right, ".")
        yield Variant(what=what, V=-2 * s.V, stated=frozenset({"L"}), doubt=int(len(parts) == 1))
