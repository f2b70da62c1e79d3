"""A prescribed motion is counted the other way: the turntable turns backwards."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant, put
from lagrangian.page.formula import text

STEP = 2
WHY = text(
    "A body in a frame that moves has the frame's velocity on top of its own; the sign of that part follows from the "
    "sense in which the frame moves."
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """For every parameter in the velocities of bodies at rest: its sign reversed in the energies and in Ξ."""
    rest = dict.fromkeys(s.v, sp.S.Zero)
    carried = [put(x, rest) for body in s.bodies for x in (*s.velocity(body), *s.omega(body))]
    for p in s.model.parameters:
        if not any(x.has(p.symbol) for x in carried):
            continue
        table = {p.symbol: -p.symbol}
        energies = [sp.expand(put(x, table) - x) for x in (s.T, s.V)]
        if energies[0] == 0:
            continue
        forces = {i: put(x, table) - x for i, x in enumerate(s.Xi) if put(x, table) != x}
        what = text(p.symbol, " has the wrong sign in the velocities: the prescribed motion goes the other way.")
        yield Variant(what=what, T=energies[0], V=energies[1], Xi=forces)
