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
            for j, v in enumerate(s.v):
                turned = any(w.has(v) for w in s.omega(body))
                own = s.coupling(body, j, j)[0] * v**2 / 2
                if turned and own not in (0, s.translation(body)):
                    what = text(
                        f"J of {body.title} is about its centre of mass: what the swing of that centre with ",
                        v,
                        " adds to J is missing.",
                    )
                    yield Variant(what=what, T=-own, element=body)
