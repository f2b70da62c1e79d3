"""½mv² of the centre of mass of a rigid body is forgotten."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.model import RigidBody
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
            swings = {j: a for j in turning if (a := s.coupling(body, j, j)[0]) != 0}
            for j, inertia in swings.items():
                rate = (" with ", s.v[j]) if len(swings) > 1 else ()
                swing = text("the swing of that centre", *rate, " adds to J is missing.")
                what = text(f"J of {body.title} is about its centre of mass: what ", *swing.parts)
                for own in dict.fromkeys(inertia * w**2 / 2 for w in (s.v[j], *_driven(s, body, s.v[j]))):
                    if own != s.translation(body):
                        yield Variant(what=what, T=-own, element=body)


def _driven(s: Ingredients, body: RigidBody, v: sp.Expr) -> list[sp.Expr]:
    """The whole angular velocity of a body in the plane that turns with this rate and with a given one: φ̇ + Ω."""
    omega = s.omega(body)
    given = [w - v for w in omega if len(omega) == 1]
    return [omega[0] for x in given if x != 0 and not x.has(*s.v)]
