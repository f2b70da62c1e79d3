"""The acceleration of another coordinate is left out of an equation."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import text

STEP = 5
WHY = text(
    "∂L/∂ξ̇ often contains several rates, and d/dt turns each of them into an acceleration: coordinates are "
    "coupled by inertia."
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Yield each coupling in one equation, each in both, and all of them."""
    every = {}
    for i in range(s.n):
        for j in range(i + 1, s.n):
            coupling = bounded.diff(s.momenta[i], s.v[j])
            if coupling == 0:
                continue
            one, other = -coupling * s.a[j], -coupling * s.a[i]
            every[i] = every.get(i, 0) + one
            every[j] = every.get(j, 0) + other
            what = text(s.a[j], " is missing in the equation of ", s.q[i], ".")
            yield Variant(what=what, rows={i: one}, coordinate=i)
            what = text(s.a[i], " is missing in the equation of ", s.q[j], ".")
            yield Variant(what=what, rows={j: other}, coordinate=j)
            what = text(s.a[i], " and ", s.a[j], " are not coupled.")
            yield Variant(what=what, rows={i: one, j: other})
    if every:
        yield Variant(what=text("Every equation contains only its own acceleration."), rows=every)
