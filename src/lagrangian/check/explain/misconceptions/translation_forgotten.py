"""½mv² of the centre of mass of a rigid body is forgotten."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import text

STEP = 2
WHY = text(
    "J is about the centre of mass; if the centre of mass itself moves, the kinetic energy of that motion counts as "
    "well. (Or take J about a fixed axis, which contains both.)"
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Drop the motion of the centre of mass of every rigid body."""
    for body in s.bodies:
        if s.rotation(body) != 0 and s.translation(body) != 0:
            yield Variant(what=text(f"½mv² of {body.title} is missing."), T=-s.translation(body), element=body)
            turning = [j for j, v in enumerate(s.v) if any(w.has(v) for w in s.omega(body))]
            swings = {j: own for j in turning if (own := s.coupling(body, j, j)[0] * s.v[j] ** 2 / 2) != 0}
            for j, own in swings.items():
                rate = (" with ", s.v[j]) if len(swings) > 1 else ()
                swing = text("the swing of that centre", *rate, " adds to J is missing.")
                if own != s.translation(body):
                    what = text(f"J of {body.title} is about its centre of mass: what ", *swing.parts)
                    yield Variant(what=what, T=-own, element=body)
