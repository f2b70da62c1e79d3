"""Two masses (or inertias) are confused."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import Name, text

STEP = 2
WHY = text("Every particle has its own mass, with the velocity and the height of that particle.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """For every pair of bodies: exchange the masses, or use one mass in the other's kinetic energy or weight."""
    for a, b in combinations(s.bodies, 2):
        m, M = s.expand(a.mass), s.expand(b.mass)
        if m == M or m == 0 or M == 0:
            continue
        unit = {a: s.translation(a) / m, b: s.translation(b) / M}
        height = {body: V / s.expand(body.mass) for _, body, V in s.weights()}
        dT = (M - m) * unit[a] + (m - M) * unit[b]
        dV = (M - m) * height.get(a, 0) + (m - M) * height.get(b, 0)
        what = text(f"The masses of {a.title} and {b.title} are exchanged.")
        yield Variant(what=what, T=dT, V=dV, element=a)
        yield Variant(
            what=text(f"The masses of {a.title} and {b.title} are exchanged in ", Name("T*"), "."), T=dT, element=a
        )
        if dV != 0:
            yield Variant(
                what=text(f"The masses of {a.title} and {b.title} are exchanged in ", Name("V"), "."), V=dV, element=a
            )
        for one, own, other in ((a, m, M), (b, M, m)):
            what = text(f"The kinetic energy of {one.title} has the mass ", other, " in place of ", own, ".")
            yield Variant(what=what, T=(other - own) * unit[one], element=one)
            if one in height:
                what = text(f"The weight of {one.title} has the mass ", other, " in place of ", own, ".")
                yield Variant(what=what, V=(other - own) * height[one], element=one)
