"""A rigid body is treated as a point: ½Jω² is forgotten."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import Name, text

STEP = 2
WHY = text(
    "Track the velocity of the centre of mass as well as the angular velocity: a body that turns has a kinetic "
    "energy of its rotation."
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Drop the rotation of every rigid body, that with one of several rates, and the rotation of all of them."""
    every = [(body, s.rotation(body)) for body in s.bodies if s.rotation(body) != 0]
    for body, energy in every:
        yield Variant(what=text(f"½Jω² of {body.title} is missing."), T=-energy, element=body)
        for j, v in enumerate(s.v):
            own = s.coupling(body, j, j)[1] * v**2 / 2
            alone = all(s.coupling(body, j, k)[1] == 0 for k in range(s.n) if k != j)
            if own != 0 and alone and s.expand(energy - own).has(*s.v):
                what = text(f"What the rotation of {body.title} with ", v, " adds to ", Name("T*"), " is missing.")
                yield Variant(what=what, T=-own, element=body)
    if len(every) > 1:
        yield Variant(what=text("½Jω² is missing for every body."), T=-sp.Add(*[e for _, e in every]))
