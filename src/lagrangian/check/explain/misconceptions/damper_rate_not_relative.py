"""The force of a damper between two bodies is computed from the rate of only one of them."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import NO_D, Ingredients, Variant, put
from lagrangian.model import Damper
from lagrangian.page.formula import text

STEP = 6
WHY = text(
    "The force of a damper is b times how fast its two ends move relative to each other: the difference of rates that "
    "are counted in the same sense, the sum of those that are counted in opposite ones."
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """For every linear damper: a force from one rate on both ends, the sum of the rates, one without its factor or
    without what is prescribed, or the rate of another coordinate."""
    for element in s.acting:
        if not isinstance(element, Damper) or element.b is None:
            continue
        rate, b, shares = bounded.expand(s.expand(element.rate(s.model))), s.expand(element.b), s.shares(element)
        held = [v for v in s.v if rate.has(v)]
        others = [put(rate, {w: sp.S.Zero for w in held if w != v}) for v in held if len(held) > 1]
        others += [
            put(rate, {v: -v}) for v in (*held[1:], *held[:1]) if len(held) > 1
        ]  # the first sign is rarely slipped
        others += [x for v in held if len(held) > 1 and (x := _without_factor(rate, v)) != rate]
        others += _without_prescribed(s, rate)
        others += [put(rate, {v: w}) for v in held for w in s.v if w not in held]
        others += [put(rate, {v: v + sign * w}) for v in held for w in s.v if w not in held for sign in (-1, 1)]
        for other in dict.fromkeys(others):
            what = text(f"The force of {element.title} is made of ", other, " in place of ", rate, ".")
            change = {i: -b * other * bounded.diff(rate, s.v[i]) - shares.get(i, 0) for i in range(s.n)}
            yield Variant(what=what, Xi={i: x for i, x in change.items() if x != 0}, element=element, stated=NO_D)
            yield from _in_one(s, element, other, change)
            full = {i: -b * other * bounded.diff(other, s.v[i]) - shares.get(i, 0) for i in range(s.n)}
            swapped = rate in s.v and other in s.v
            if swapped:
                here, there = (s.q[s.v.index(x)] for x in (rate, other))
                belongs = ("; it belongs to that of ", here, ", with ", rate, ".")
                said = text(f"{element.title} is counted in the equation of ", there, ", with ", other, *belongs)
                yield Variant(what=said, Xi={i: x for i, x in full.items() if x != 0}, element=element, stated=NO_D)
            yield Variant(what=what, Xi={i: x for i, x in full.items() if x != 0}, element=element, doubt=int(swapped))


def _without_prescribed(s: Ingredients, rate: sp.Expr) -> list[sp.Expr]:
    """A rate without that of an end that is moved in a prescribed way, and with its other sign: φ̇ for φ̇ − u̇."""
    moved = put(rate, dict.fromkeys(s.v, sp.S.Zero))
    return [bounded.expand(rate - moved), bounded.expand(rate - 2 * moved)] if moved != 0 else []


def _without_factor(rate: sp.Expr, v: sp.Expr) -> sp.Expr:
    """A rate in which that of one coordinate has its sign alone: ż − ẋ for ż − ẋ/2."""
    factor = bounded.diff(rate, v)
    return bounded.expand(rate + (-v if factor.could_extract_minus_sign() else v) - factor * v)


def _in_one(s: Ingredients, element: Damper, other: sp.Expr, change: dict[int, sp.Expr]) -> Iterator[Variant]:
    """The same in one equation only, if the damper acts in several."""
    felt = [i for i, x in change.items() if x != 0]
    rate, where = s.expand(element.rate(s.model)), " in the equation of "
    for i in felt if len(felt) > 1 else ():
        what = text(f"The force of {element.title} is made of ", other, " in place of ", rate, where, s.q[i], ".")
        yield Variant(what=what, Xi={i: change[i]}, element=element, coordinate=i)
