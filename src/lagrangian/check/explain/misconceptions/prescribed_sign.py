"""A prescribed motion is counted the other way: the turntable turns backwards."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant, put
from lagrangian.model import time
from lagrangian.page.formula import text

STEP = 2
WHY = text(
    "A body in a frame that moves has the frame's velocity on top of its own; the sign of that part follows from the "
    "sense in which the frame moves."
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """For every parameter that says how fast something is carried: its sign reversed in the energies and in Ξ."""
    rest = dict.fromkeys(s.v, sp.S.Zero)
    carried = [put(x, rest) for body in s.bodies for x in (*s.velocity(body), *s.omega(body))]
    for p in s.model.parameters:
        if not any(x.has(p.symbol) for x in carried) or not _is_fast(s, p.symbol):
            continue
        table = {p.symbol: -p.symbol}
        energies = [sp.expand(put(x, table) - x) for x in (s.T, s.V)]
        if energies[0] == 0:
            continue
        forces = {i: put(x, table) - x for i, x in enumerate(s.Xi) if put(x, table) != x}
        said = "the prescribed motion goes the other way."
        what = text(p.symbol, " has the wrong sign in the velocities: ", said)
        if not _turns(s, p.symbol):  # U sin Ωt
            what = text("The rate of the prescribed motion has the wrong sign: it goes the other way.")
        yield Variant(what=what, T=energies[0], V=energies[1], Xi=forces)


def _turns(s: Ingredients, p: sp.Symbol) -> bool:
    """Whether a parameter is how fast something turns, with what moves on it, and no letter of a given way."""
    places = [x for body in s.bodies for place in s.position(body) for x in sp.Add.make_args(sp.expand(place))]
    rest = dict.fromkeys(s.v, sp.S.Zero)
    rates = [x for body in s.bodies for w in s.omega(body) for x in sp.Add.make_args(sp.expand(put(w, rest)))]
    return any(x.has(p) and x.has(*s.q) for x in places) or any(x.has(p) and not x.has(time) for x in rates)


def _is_fast(s: Ingredients, p: sp.Symbol) -> bool:
    """Whether a parameter stands beside the time, as Ω in Ω t, or turns a body; a carried arm does neither."""
    turned = [x for body in s.bodies for x in s.omega(body)]
    products = [m for body in s.bodies for x in s.position(body) for m in x.atoms(sp.Mul)]
    return any(x.has(p) for x in turned) or any(
        p in m.args and any(f.as_base_exp()[0] == time for f in m.args) for m in products
    )
