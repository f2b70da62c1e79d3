"""A spring on a relative coordinate is also counted in the equation of what carries it."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import text

STEP = 5
WHY = text(
    "V contains only the relative coordinate, so its derivative by this one is zero: what carries both ends of the "
    "spring moves them along and does not stretch it."
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Add the force of a spring to an equation whose coordinate does not stretch it, with both signs."""
    for spring, _, V in s.springs():
        slopes = {i: bounded.diff(V, q) for i, q in enumerate(s.q)}
        for i, x in slopes.items():
            for force in [y for y in slopes.values() if y != 0] if x == 0 else []:
                what = text(
                    f"{spring.title[:1].upper() + spring.title[1:]} is counted in the equation of ", s.q[i], " as well."
                )
                for sign in (-1, 1):
                    yield Variant(what=what, rows={i: sign * force}, element=spring, coordinate=i, stated=frozenset())
