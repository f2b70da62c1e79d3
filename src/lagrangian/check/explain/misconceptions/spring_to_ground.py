"""A spring between two bodies is treated as one between a body and the ground."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, Variant, put
from lagrangian.page.formula import text

STEP = 3
WHY = text("Be careful: the Δx of a spring between two bodies is the motion of one relative to the other.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """For every linear spring: only one coordinate of its deflection, or a relative coordinate made absolute."""
    for spring, extension, V in s.springs():
        held = [q for q in s.q if extension.has(q)]
        if spring.k is None or not held:
            continue
        title, k = spring.title[:1].upper() + spring.title[1:], s.expand(spring.k)
        if not any(bounded.diff(extension, q).has(*s.q) for q in held):
            for q, p in ((q, p) for q in held for p in s.q if p not in held and not _moves_alone(s, q, p)):
                what = text(f"{title} is stretched by ", q + p, ", as if to the ground.")
                yield Variant(what=what, V=k * put(extension, {q: q + p}) ** 2 / 2 - V, element=spring)
        if len(held) < 2:
            continue
        if not any(bounded.diff(extension, q).has(*s.q) for q in held):
            each = sp.Add(*[(bounded.diff(extension, q) * q) ** 2 for q in held])
            what = text(
                f"The parts of the deflection of {spring.title} were squared one by one: the mixed term is missing."
            )
            yield Variant(what=what, V=k * each / 2 - V, element=spring)
        for q in held:
            own = put(extension, {p: sp.S.Zero for p in held if p != q})
            if own.has(sp.nan, sp.zoo):
                continue
            what = text(f"{title} is stretched by ", _alone(own, q), " alone.")
            yield Variant(what=what, V=k * own**2 / 2 - V, element=spring)


def _moves_alone(s: Ingredients, q: sp.Expr, p: sp.Expr) -> bool:
    """Whether a body moves with one coordinate and not with another: then the first is not counted from the second, and
    their sum is no motion against the ground that could be meant."""
    rates = dict(zip(s.q, s.v, strict=True))
    energies = [s.translation(b) + s.rotation(b) for b in s.bodies]
    return any(T.has(rates[q]) and not T.has(rates[p]) for T in energies)


def _alone(deflection: sp.Expr, q: sp.Expr) -> sp.Expr:
    """What one coordinate adds to a deflection, without its sign: R φ of y − R φ; q itself if it is not linear."""
    slope = bounded.diff(deflection, q)
    added = bounded.expand(slope * q)
    return q if slope.has(q) else -added if added.could_extract_minus_sign() else added
