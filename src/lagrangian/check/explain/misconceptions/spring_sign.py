"""A spring has the wrong sign."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import Name, text

STEP = 3
WHY = text("A stretched or compressed spring stores energy, and its force pulls back.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Reverse every spring, then its force in one equation only."""
    for spring, _, V in s.springs():
        what = text(f"The energy of {spring.title} has the wrong sign in ", Name("V"), ".")
        yield Variant(what=what, V=-2 * V, element=spring)
        rows = [i for i, q in enumerate(s.q) if V.has(q)]
        for i in rows if len(rows) > 1 else ():
            what = text(f"The force of {spring.title} has the wrong sign in the equation of ", s.q[i], ".")
            yield Variant(what=what, V=-2 * V, only=frozenset({i}), element=spring, coordinate=i)
